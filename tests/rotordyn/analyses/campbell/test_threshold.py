"""Which mode begins to grow, and how summary and figures say from where."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from rotordyn.analyses.campbell import summary, threshold
from rotordyn.analyses.campbell.figures.damping import damping_figure
from rotordyn.analyses.campbell.figures.diagram import draw_unstable
from rotordyn.analyses.campbell.figures.shapes import plane_curve, shapes_figure
from rotordyn.modes.branches import Track
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import RPM, case
from tests.rotordyn.analyses.campbell.test_campbell import diagram
from tests.rotordyn.figures import samples


@cache
def whipping(*rpm: float, highest: float = 2500.0) -> Any:
    """A shaft with damping that turns with it, its lowest mode held by dampers at the supports."""
    held = tuple(support(name, x, (3e6, 3e6), 1000.0) for name, x in (("a", 0.1), ("b", 0.9)))
    shaft = uniform(1.0, 0.04, supports=held)
    return diagram(replace(shaft, rotor_damping=(0.02,), internal_damping=1.0), rpm, highest)


def test_the_mode_that_crosses_zero_is_named_though_others_grow_farther_up() -> None:
    """Between two speeds, at the upper one of which two modes grow."""
    found = whipping(0.0, 40000.0, 80000.0)
    growing = [name for name, row in zip(found.mode, found.unstable[-1], strict=True) if row]
    assert "bending 1 forward" in growing
    there = whipping(found.stability_threshold / RPM)
    ratio = dict(zip(there.mode, there.damping_ratio[0], strict=True))
    assert ratio["bending 1 forward"] > 1e-3
    assert found.unstable_mode == "bending 4 forward"
    assert ratio[found.unstable_mode] == pytest.approx(0.0, abs=1e-8)


def test_what_begins_to_grow_above_the_band_is_left_to_a_wider_one() -> None:
    """Bending 4, at 506 Hz, which was called bending 3."""
    wide = whipping(0.0, 40000.0, 80000.0)
    found = whipping(0.0, 40000.0, 80000.0, highest=400.0)
    assert wide.unstable_mode not in found.mode
    assert found.unstable_mode == "bending 1 forward"
    assert found.stability_threshold > 1.1 * wide.stability_threshold
    there = whipping(found.stability_threshold / RPM, highest=400.0)
    ratio = dict(zip(there.mode, there.damping_ratio[0], strict=True))
    assert ratio[found.unstable_mode] == pytest.approx(0.0, abs=1e-8)


def test_a_mode_that_has_left_the_band_begins_to_grow_all_the_same() -> None:
    """Bending 4, at 506 Hz at rest."""
    wide = whipping(0.0, 40000.0, 80000.0)
    found = whipping(0.0, 40000.0, 80000.0, highest=510.0)
    there = whipping(wide.stability_threshold / RPM)
    assert there.frequency[0, there.mode.index(wide.unstable_mode)] > 510.0
    assert found.unstable_mode == wide.unstable_mode
    assert found.stability_threshold == pytest.approx(wide.stability_threshold, rel=1e-4)


def test_frequencies_followed_are_those_of_the_band_and_of_modes_that_leave_it() -> None:
    """About a speed, and little more."""
    pole = np.array([np.nan, 390.0j, 450.0j])
    rising: Any = SimpleNamespace(track=Track(np.array([0.0, 10.0, 20.0]), pole, np.empty((3, 0))))
    assert threshold._highest(400.0, [], 5.0) == pytest.approx(400.0)
    assert threshold._highest(400.0, [rising], 10.0) == pytest.approx(400.0)
    for speed in (12.0, 20.0):
        assert threshold._highest(400.0, [rising], speed) == pytest.approx(454.5)


@pytest.mark.parametrize(
    ("pole", "name"),
    [
        (1e-3 + 300.0j, "bending 2 forward"),
        (1e-3 + 500.0j, "bending 1 forward"),
        (1e-3 + 0.0j, threshold.DIVERGENCE),
        (None, ""),
    ],
)
def test_the_mode_whose_pole_grows_is_that_of_its_frequency(
    pole: complex | None, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two modes whose damping is alike between speeds, lost at the first of these; without
    equilibrium none."""

    def branch(*poles: complex) -> Any:
        track = Track(np.array([0.0, 100.0, 200.0]), np.array([np.nan, *poles]), np.empty((3, 0)))
        return SimpleNamespace(track=track)

    monkeypatch.setattr(threshold, "_fastest_pole", lambda *_: pole)
    one = branch(-2.0 + 490.0j, 2.0 + 510.0j), "bending 1 forward"
    other = branch(-2.0 + 310.0j, 2.0 + 290.0j), "bending 2 forward"
    scene: Any = SimpleNamespace(speed=np.array([0.0, 100.0, 200.0]))
    assert threshold._unstable(scene, 0, 600.0, 150.0, [one, other]) == name


def test_growth_above_speeds_without_equilibrium_bounds_the_threshold(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What is between the last speed of no growth and the lowest one of growth is not known."""

    def growth(scene: Any, subsystem: int, highest: float, speed: float) -> float:
        return -1.0 if speed == 0.0 else 1.0 if speed > 60.0 else np.nan

    monkeypatch.setattr(threshold, "_growth", growth)
    scene: Any = None
    at, is_bound = threshold._onset(scene, 0, 600.0, 0.0, 100.0)
    assert is_bound
    assert 60.0 < at <= 100.0


def test_it_is_a_headline_number() -> None:
    found, calm = whipping(0.0, 40000.0, 80000.0), whipping(0.0, 20000.0)
    values = {n.words: n.value for n in summary.numbers(found, case())}
    assert values[summary.UNSTABLE] == pytest.approx(found.stability_threshold / RPM)
    assert summary.UNSTABLE not in {n.words for n in summary.numbers(calm, case())}
    assert summary.UNSTABLE in {n.words for n in summary.lacking(calm)}


def test_a_mode_that_is_stable_again_does_not_grow_on() -> None:
    found = whipping(0.0, 40000.0, 80000.0)
    (said,) = (w for w in summary.warnings(found) if "4 forward is unstable" in w)
    assert "from 43792 rpm on, at 1 of 3 speeds (damping ratio down to" in said
    ratio = found.damping_ratio.copy()
    ratio[-1, found.mode.index(found.unstable_mode)] = 0.01
    again = replace(found, damping_ratio=ratio)
    assert any(w.endswith("is unstable from 43792 rpm") for w in summary.warnings(again))


def test_a_mode_that_is_stable_between_speeds_of_growth_does_not_grow_on() -> None:
    """Damping of a mode that falls beyond it is reported as a share."""
    found = whipping(0.0, 40000.0, 60000.0, 80000.0)
    ratio, first = found.damping_ratio.copy(), found.mode.index(found.unstable_mode)
    ratio[2:, first] = 0.01, -1.0
    between = summary.warnings(replace(found, damping_ratio=ratio))
    said = "is unstable from 43792 rpm, at 1 of 4 speeds, first 80000 rpm (damping ratio down to"
    assert any(w.endswith(f"{said} -100 %)") for w in between)


def test_figures_show_the_mode_grow_from_the_threshold_on() -> None:
    found = whipping(0.0, 40000.0, 80000.0)
    at = found.stability_threshold / RPM
    axes = Figure().subplots()
    draw_unstable(axes, found)
    bands = [line.get_xydata()[np.isfinite(line.get_ydata())] for line in axes.get_lines()]
    begin = min((band[0] for band in bands), key=lambda point: point[0])
    frequency = found.frequency[:, found.mode.index(found.unstable_mode)]
    assert begin == pytest.approx([at, np.interp(at, found.speed / RPM, frequency)])
    damping = damping_figure(found).axes[0]
    (line,) = (each for each in damping.get_lines() if each.get_label() == found.unstable_mode)
    assert np.interp(at, line.get_xdata(), line.get_ydata()) == pytest.approx(0.0, abs=1e-9)


def test_growth_from_the_lowest_speed_on_bounds_the_threshold() -> None:
    """It is 43792 rpm, below the range."""
    found = whipping(50000.0, 60000.0)
    assert found.threshold_is_bound
    assert found.stability_threshold == pytest.approx(50000.0 * RPM)
    (sentence,) = (w for w in summary.warnings(found) if "already" in w)
    assert "is unstable at 50000 rpm already, the lowest speed" in sentence
    (headline,) = (n for n in summary.numbers(found, case()) if n.words == summary.UNSTABLE)
    assert np.isnan(headline.value)
    assert headline.absent == "≤ 50000"
    assert headline.reading == pytest.approx(50000.0)
    labels = [line.get_label() for line in damping_figure(found).axes[0].get_lines()]
    assert "stability threshold" not in labels
    wider = whipping(0.0, 50000.0, 60000.0)
    assert not wider.threshold_is_bound
    assert wider.stability_threshold < 44000.0 * RPM


def test_one_speed_at_which_a_mode_grows_asks_for_lower_ones() -> None:
    alone = whipping(50000.0)
    assert alone.threshold_is_bound
    assert any("add lower speeds to find its threshold" in w for w in summary.warnings(alone))


def test_growth_at_rest_is_a_threshold_of_zero() -> None:
    """Supports that drive the shaft: no lower speed could bound it closer."""
    driven = tuple(support(name, x, (3e6, 3e6), -50.0) for name, x in (("a", 0.1), ("b", 0.9)))
    found = diagram(uniform(1.0, 0.04, supports=driven), (0.0, 1000.0), 400.0)
    assert found.unstable.all(axis=0).any()
    assert found.stability_threshold == 0.0
    assert not found.threshold_is_bound
    assert not any("its threshold" in w for w in summary.warnings(found))


def test_a_mode_that_is_not_there_has_no_line() -> None:
    assert np.isnan(plane_curve(np.full((4, 2), complex(np.nan, np.nan)))).all()
    assert (plane_curve(np.zeros((4, 2), dtype=complex)) == 0.0).all()
    found = whipping(0.0, 40000.0)
    shape = found.shape.copy()
    shape[0] = np.nan
    for axes in shapes_figure(replace(found, shape=shape)).axes[:2]:
        missing, there = (np.isnan(line.get_ydata()) for line in axes.get_lines()[:2])
        assert missing.all()
        assert not there.any()


def test_an_unstable_machine_without_modes_in_the_band_is_reported() -> None:
    """Its threshold is that of a motion beyond the band."""
    some = samples.campbell(5)
    none = dict(damping_ratio=some.damping_ratio[:, :0], frequency=some.frequency[:, :0])
    none |= {"pole": some.pole[:, :0], "overdamped": some.overdamped[:, :0]}
    found = replace(some, mode=(), **none, unstable_mode="bending 1 fw")
    found = replace(found, stability_threshold=0.5 * some.speed[-1], threshold_is_bound=False)
    said = [word for word in summary.warnings(found) if "unstable" in word]
    assert said == [f"bending 1 fw is unstable from {0.5 * some.speed[-1] / RPM:.0f} rpm"]
