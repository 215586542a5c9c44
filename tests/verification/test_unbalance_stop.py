"""A stop that closes between two speeds of the case: the refined response has both its sides."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses import PreloadSpec
from tests.oracles.spindles import case

SPEEDS = ["0 rpm", "8000 rpm", "16000 rpm", "24000 rpm"]
STOP = "spindle.sleeves.front.stop_travel"


@pytest.fixture(scope="module")
def machine() -> Any:
    """A milling spindle, a residual unbalance in it, at four speeds."""
    own = case("mfw2310_unbalance")
    return replace(own, analyses={**own.analyses, "preload": PreloadSpec()}).vary(
        {"speeds": SPEEDS, STOP: "45 um"}
    )


@pytest.fixture(scope="module")
def results(machine: Any) -> Any:
    return rotordyn.run(machine)


def test_the_curve_breaks_where_the_stop_closes(results: Any) -> None:
    """One break, where the preload state has the stop; a side of it on either hand, close by."""
    unbalance, preload = results["unbalance"], results["preload"]
    speed, known = unbalance.fine_speed.values, np.isfinite(unbalance.fine_major_axis.values)
    (gap,) = np.flatnonzero(~known.any(axis=1))
    assert known[np.arange(len(speed)) != gap].all()
    (stop,) = preload.stop_speed.values[np.isfinite(preload.stop_speed.values)]
    assert 838.0 < stop < 2513.0
    before, after = speed[gap - 1], speed[gap + 1]
    assert before < stop < after
    assert after - before <= 1e-7 * speed[-1]
    assert speed[gap] == pytest.approx(0.5 * (before + after), rel=1e-12)
    peaks = unbalance.peak_speed.values
    assert not ((peaks >= before) & (peaks <= after)).any()


def test_each_side_has_its_own_response(machine: Any, results: Any) -> None:
    """Open in front of the break and closed behind: the response is that of a case there."""
    found = results["unbalance"]
    speed, force = found.fine_speed.values, found.fine_force_amplitude.values
    (gap,) = np.flatnonzero(~np.isfinite(force).any(axis=1))
    sides = [gap - 1, gap + 1]
    alone = rotordyn.run(replace(machine, speeds=tuple(float(speed[k]) for k in sides)))
    (sleeve,) = np.flatnonzero(np.isfinite(results["preload"].stop_speed.values))
    assert alone["preload"].stop_reached.values[:, sleeve].tolist() == [False, True]
    wanted = alone["unbalance"]
    np.testing.assert_allclose(force[sides], wanted.force_amplitude.values, rtol=1e-6)
    moved = found.fine_major_axis.values[sides]
    np.testing.assert_allclose(moved, wanted.major_axis.values, rtol=1e-6)


def test_without_a_stop_the_curve_is_whole(machine: Any) -> None:
    free = rotordyn.run(machine.vary({STOP: "none"}))["unbalance"]
    assert np.isfinite(free.fine_major_axis.values).all()
