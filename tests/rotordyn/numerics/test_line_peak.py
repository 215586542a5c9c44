"""Peaks between the lines of a measured response, of responses whose peaks are known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.numerics.line_peak import line_peak

DEEP = ((800.0, 0.02, 0.5), (1500.0, 0.01, 0.3))  # Hz, damping ratio, share


def response(hertz, ratio):
    """Three modes and a residual flexibility."""
    modes = ((500.0, ratio, 1.0), *DEEP)
    return sum(a / (f**2 - hertz**2 + 2j * z * f * hertz) for f, z, a in modes) - 3e-7


def highest(hertz, values):
    near = np.flatnonzero(np.abs(hertz - 500.0) < 25.0)
    return int(near[np.abs(values[near]).argmax()])


@pytest.mark.parametrize("ratio", [0.001, 0.003, 0.01, 0.03])
@pytest.mark.parametrize("step", [0.5, 1.0, 4.0, 8.0])
def test_a_peak_between_lines_is_found(ratio, step):
    """Half widths from a sixteenth of a line up."""
    fine = np.linspace(480.0, 520.0, 400_001)
    known = np.abs(response(fine, ratio))
    for begin in np.linspace(200.0, 200.0 + step, 7)[:-1]:
        lines = np.arange(begin, 900.0, step)
        values = response(lines, ratio)
        peak = line_peak(lines, values, highest(lines, values))
        assert peak.height == pytest.approx(known.max(), rel=3e-4)
        assert peak.frequency == pytest.approx(fine[known.argmax()], rel=1e-5, abs=10.0 * ratio)


def test_a_broad_peak_beside_another_stays_between_its_lines():
    def both(hertz):
        modes = ((1490.0, 0.035, 1.0), (1685.0, 0.02, 0.9))
        return sum(1.0 / (f**2 - hertz**2 + 2j * z * f * hertz) * a for f, z, a in modes)

    fine = np.arange(1400.0, 1580.0, 0.01)
    known, at = np.abs(both(fine)).max(), fine[np.abs(both(fine)).argmax()]
    for begin in np.arange(100.0, 105.0):
        lines = np.arange(begin, 3000.0, 5.0)
        values = both(lines)
        near = np.flatnonzero(np.abs(lines - at) < 40.0)
        peak = line_peak(lines, values, int(near[np.abs(values[near]).argmax()]))
        assert peak.frequency == pytest.approx(at, abs=1.5)
        assert peak.height == pytest.approx(known, rel=2e-3)


@pytest.mark.parametrize("ratio", [0.001, 0.003, 0.01, 0.03])
@pytest.mark.parametrize("step", [0.5, 1.0, 4.0, 8.0])
def test_noise_leaves_heights_no_worse_than_the_highest_lines(ratio, step):
    """5 % of every line; standard errors are reported."""
    rng, known = np.random.default_rng(3), np.abs(response(np.linspace(480, 520, 40_001), ratio))
    missed, before, told = [], [], []
    for begin in rng.uniform(200.0, 200.0 + step, 60):
        lines = np.arange(begin, 900.0, step)
        noise = rng.standard_normal((2, len(lines)))
        values = response(lines, ratio) * (1.0 + 0.05 * (noise[0] + 1j * noise[1]))
        top = highest(lines, values)
        peak = line_peak(lines, values, top)
        missed.append(peak.height / known.max() - 1.0)
        before.append(abs(values[top]) / known.max() - 1.0)
        if math.isfinite(peak.error):
            told.append(missed[-1] / peak.error)
    assert np.hypot.reduce(missed) <= 1.02 * np.hypot.reduce(before)
    assert len(told) < 10 or 0.2 < np.median(np.abs(told)) < 1.3, np.median(np.abs(told))


@pytest.mark.parametrize("step", [2.0, 8.0, 16.0])
@pytest.mark.parametrize("noise", [0.003, 0.01])
def test_the_standard_error_is_that_of_repeated_measurements(step, noise):
    """Of 300 with noise of the same size on every line, about one mode."""
    rng, known = np.random.default_rng(5), 1.0 / (0.04 * math.sqrt(1.0 - 0.02**2))
    missed, told = [], []
    for begin in rng.uniform(600.0, 600.0 + step, 300):
        lines = np.arange(begin, 1400.0, step)
        values = 1.0 / (1.0 - (lines / 1000.0) ** 2 + 0.04j * lines / 1000.0)
        values += noise * known * rng.standard_normal((len(lines), 2)) @ np.array([1.0, 1.0j])
        peak = line_peak(lines, values, int(np.abs(values).argmax()))
        if math.isfinite(peak.error):
            missed.append(peak.height / known - 1.0)
            told.append(peak.error)
    assert len(told) > 150
    # the fewer the lines the more cautious
    assert 0.9 < np.sqrt(np.mean(np.square(told))) / np.std(missed) < (1.7 if step > 10.0 else 1.2)


def test_lines_that_cannot_tell_the_peak_say_so():
    """A single high line has any height; where lines are close, noise alone hides a fit."""
    wide, close = np.arange(100.0, 900.0, 8.0), np.arange(480.0, 520.0, 0.05)
    rng = np.random.default_rng(1)
    values = 1.0 + 0.5 * rng.standard_normal(len(wide)) + 0.5j * rng.standard_normal(len(wide))
    values[50] = 30.0
    peak = line_peak(wide, values, 50)
    assert peak[:2] == (wide[50], 30.0)
    assert math.isinf(peak.error)
    noise = rng.standard_normal((2, len(close)))
    values = response(close, 0.03) * (1.0 + 0.02 * (noise[0] + 1j * noise[1]))
    top = int(np.abs(values).argmax())
    peak = line_peak(close, values, top)
    assert peak[:2] == (close[top], abs(values[top]))
    assert math.isnan(peak.error)
