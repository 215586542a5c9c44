"""Peaks of resonance curves from three samples, and samples about them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.arrays import Array
from rotordyn.numerics.peaks import GROWTH, NARROW, sampled, spread, tops, vertex


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e6])
@pytest.mark.parametrize("samples", [(9.0, 10.0, 11.5), (9.4, 9.9, 10.3), (10.19, 10.2, 10.9)])
def test_three_samples_of_an_oscillator_give_its_peak(
    samples: tuple[float, float, float], scale: float
) -> None:
    """c/√((x − p)² + w²) has its inverse square on a parabola: highest at p, c/w."""
    p, w = 10.2, 0.4
    x = np.array(samples)
    at, height = vertex(x, scale / np.sqrt((x - p) ** 2 + w**2))
    assert at == pytest.approx(p)
    assert height == pytest.approx(scale / w)


def test_a_parabola_below_zero_tells_no_height() -> None:
    """And where its lowest place is."""
    x = np.array([1.0, 2.0, 4.0])
    at, height = vertex(x, 1.0 / np.sqrt((x - 2.4) ** 2 - 0.01))
    assert at == pytest.approx(2.4)
    assert height == np.inf


@pytest.mark.parametrize("centre", [40.0, 4e4])
@pytest.mark.parametrize("width", [0.0, 1e-9, 0.02])
def test_samples_about_a_peak_grow_apart_from_the_width_of_the_peak(
    centre: float, width: float
) -> None:
    """Geometrically, on either side alike, from a quarter of the width, or of the narrowest one
    that is distinguished from none, out to both ends."""
    low, high = 0.5 * centre, 1.8 * centre
    found = spread(centre, width, low, high)
    apart = np.sort(np.abs(found - centre))
    least = max(width, NARROW * centre)
    assert apart[:2] == pytest.approx(0.25 * least, rel=1e-6)
    beyond = (found - centre)[found > centre]
    steps = beyond[beyond > 1.01 * least]
    assert steps[1:] / steps[:-1] == pytest.approx(GROWTH, rel=1e-6)
    assert high / GROWTH < centre + GROWTH * beyond[-1]
    assert found.min() >= low
    assert found.max() <= high


def test_lines_between_samples_follow_an_antiresonance() -> None:
    """Two modes and the dip between them, drawn in straight lines of its logarithm."""

    def solve(x: Array) -> list[Array]:
        modes = (1.0 / (a * a - x * x + 0.02j * a * x) for a in (1.0, 3.0))
        return [np.asarray(x * x * sum(modes))[:, None]]

    start = np.unique(np.concatenate([np.linspace(0.2, 4.0, 20), [1.0, 3.0]]))
    x, (values,) = sampled(start, solve, lambda arrays: np.abs(arrays[0]))
    fine = np.linspace(0.2, 4.0, 4001)
    drawn = np.interp(fine, x, np.log(np.abs(values[:, 0])))
    assert np.abs(drawn - np.log(np.abs(solve(fine)[0][:, 0]))).max() < 0.2
    assert len(x) < 120


def test_straight_lines_of_uneven_samples_and_rounding_are_not_sampled_closer() -> None:
    """A curve of less than 10⁻⁹ of the largest one is rounding."""
    x = np.array([0.5, 0.6, 1.0, 1.1, 2.0, 2.05, 4.0])
    noise = np.array([3.0, 1.0, 5.0, 1.0, 2.0, 0.5, 9.0])

    def both(curve: Array) -> Array:
        def solve(at: Array) -> list[Array]:
            return [np.column_stack([100.0 * np.exp(2.0 * at), np.interp(at, x, curve)])]

        return sampled(x, solve, lambda arrays: np.abs(arrays[0]))[0]

    assert both(1e-10 * noise).tolist() == x.tolist()
    assert len(both(noise)) > len(x)


@pytest.mark.parametrize("start", [[0.5, 0.985, 1.6], [0.5, 0.8, 1.0, 1.2, 1.6]])
def test_the_highest_sample_of_a_flat_peak_is_at_the_peak(start: list[float]) -> None:
    """A damping ratio of 0.1 moves the peak of x²/|1 − x² + 2iζx| to 1/√(1 − 2ζ²); a sample 1 %
    beside it is hardly lower."""

    def solve(x: Array) -> list[Array]:
        return [(x * x / np.abs(1.0 - x * x + 0.2j * x))[:, None]]

    x, (values,) = sampled(np.array(start), solve, lambda arrays: arrays[0])
    assert x[values[:, 0].argmax()] == pytest.approx(1.0 / math.sqrt(0.98), rel=1e-4)


def test_equal_curves_that_differ_by_rounding_have_one_peak() -> None:
    """As |y| and |z| of round orbits: their vertices are one sample, and between two samples a dip
    by rounding makes no second peak."""

    def solve(x: Array) -> list[Array]:
        curve = 1.0 / np.hypot(x - 1.0, 0.01)
        return [np.column_stack([curve, curve * (1.0 + 1e-15 * np.sin(1e3 * x))])]

    x, (values,) = sampled(np.linspace(0.6, 1.5, 12), solve, lambda arrays: arrays[0])
    assert np.diff(x).min() > 1e-9
    for curve in values.T:
        assert tops(curve).size == 1
    twins = np.array([1.0, 2.0, 2.0 * (1.0 - 1e-14), 2.0, 1.0])
    assert tops(twins).size == 1
    assert tops(np.array([1.0, 2.0, 1.99, 2.0, 1.0])).tolist() == [1, 3]


def test_a_gap_parts_peaks_and_no_end_is_one() -> None:
    curve = np.array([5.0, 1.0, 2.0, 1.0, np.nan, 0.0, 3.0, 2.0, 4.0])
    assert tops(curve).tolist() == [2, 6]
    rising = np.array([5.0, 1.0, 3.0, 3.0 * (1.0 - 1e-14), 4.0])
    assert not tops(rising).size
    assert not tops(rising[::-1]).size
