"""Which mode begins to grow, and how summary and figures say from where."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from rotordyn.analyses.campbell import summary
from rotordyn.analyses.campbell.figures.damping import damping_figure
from rotordyn.analyses.campbell.figures.diagram import draw_unstable
from rotordyn.analyses.campbell.figures.shapes import plane_curve
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import RPM, case
from tests.rotordyn.analyses.campbell.test_campbell import diagram


@cache
def whipping(*rpm: float) -> Any:
    """A shaft with damping that turns with it, its lowest mode held by dampers at the supports."""
    held = tuple(support(name, x, (3e6, 3e6), 1000.0) for name, x in (("a", 0.1), ("b", 0.9)))
    shaft = uniform(1.0, 0.04, supports=held)
    return diagram(replace(shaft, rotor_damping=(0.02,), internal_damping=1.0), rpm, 2500.0)


def test_the_mode_that_crosses_zero_is_named_though_others_grow_farther_up() -> None:
    """Between two speeds, at the upper one of which two modes grow."""
    found = whipping(0.0, 40000.0, 80000.0)
    growing = [name for name, row in zip(found.mode, found.unstable[-1], strict=True) if row]
    assert "bending 1 forward" in growing
    there = whipping(found.stability_threshold / RPM)
    ratio = dict(zip(there.mode, there.damping_ratio[0], strict=True))
    assert ratio["bending 1 forward"] > 1e-3
    assert found.first_to_grow == "bending 4 forward"
    assert ratio[found.first_to_grow] == pytest.approx(0.0, abs=1e-8)


def test_it_is_a_headline_number() -> None:
    found, calm = whipping(0.0, 40000.0, 80000.0), whipping(0.0, 20000.0)
    values = {n.words: n.value for n in summary.numbers(found, case())}
    assert values[summary.UNSTABLE] == pytest.approx(found.stability_threshold / RPM)
    assert summary.UNSTABLE not in {n.words for n in summary.numbers(calm, case())}
    assert summary.UNSTABLE in {n.words for n in summary.lacking(calm)}


def test_a_mode_that_is_stable_again_does_not_grow_on() -> None:
    found = whipping(0.0, 40000.0, 80000.0)
    assert any("4 forward grows by itself from 43792 rpm on" in w for w in summary.warnings(found))
    ratio = found.damping_ratio.copy()
    ratio[-1, found.mode.index(found.first_to_grow)] = 0.01
    again = replace(found, damping_ratio=ratio)
    assert any(w.endswith("grows by itself from 43792 rpm") for w in summary.warnings(again))


def test_a_mode_that_is_stable_between_speeds_of_growth_does_not_grow_on() -> None:
    """Damping of a mode that falls beyond it is told as a share."""
    found = whipping(0.0, 40000.0, 60000.0, 80000.0)
    ratio, first = found.damping_ratio.copy(), found.mode.index(found.first_to_grow)
    ratio[2:, first] = 0.01, -1.0
    between = summary.warnings(replace(found, damping_ratio=ratio))
    assert any(w.endswith("grows by itself from 43792 rpm") for w in between)
    assert any(
        w.endswith("is unstable at 80000 rpm (damping ratio down to -100 %)") for w in between
    )


def test_figures_show_the_mode_grow_from_the_threshold_on() -> None:
    found = whipping(0.0, 40000.0, 80000.0)
    at = found.stability_threshold / RPM
    axes = Figure().subplots()
    draw_unstable(axes, found)
    first = min(line.get_xdata()[np.isfinite(line.get_ydata())].min() for line in axes.get_lines())
    assert first == pytest.approx(at)
    damping = damping_figure(found).axes[0]
    (line,) = (each for each in damping.get_lines() if each.get_label() == found.first_to_grow)
    assert np.interp(at, line.get_xdata(), line.get_ydata()) == pytest.approx(0.0, abs=1e-9)


def test_a_mode_that_is_not_there_has_no_line() -> None:
    assert np.isnan(plane_curve(np.full((4, 2), complex(np.nan, np.nan)))).all()
    assert (plane_curve(np.zeros((4, 2), dtype=complex)) == 0.0).all()
