"""What missing shortening of the shaft would do to axial loads, against machines solved anew."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.case.model import model
from rotordyn.machine.growth import ComputedShortening
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.unshortened import shortening_load
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import RPM, conditions, mfw2310

LESS = 1e-3  # of the shortening: where it acts to first order
SPEED = 18000.0


def machine(springs: str) -> Spindle:
    whole = replace(mfw2310(), shortening=None)
    if springs == "locked":
        locked = [
            replace(sleeve, spring=replace(sleeve.spring, stiffness=math.inf), stop_travel=math.inf)
            for sleeve in whole.sleeves
        ]
        return replace(whole, sleeves=tuple(locked))
    if springs == "on a support":
        return replace(whole, supports=(LinearSupport("along", 0.3, {("x", "x"): 2e7}),))
    travel = 5e-6 if springs == "at a stop" else math.inf
    friction = 1e5 if springs == "held by friction" else 0.0
    stopped = [replace(each, stop_travel=travel, friction=friction) for each in whole.sleeves]
    return replace(whole, sleeves=tuple(stopped))


def shortened(spindle: Spindle, share: float) -> Spindle:
    """With shortening, of a material that contracts so much less."""
    sections = [
        replace(s, material=replace(s.material, poisson_ratio=share * s.material.poisson_ratio))
        for s in spindle.shaft.sections
    ]
    shaft = Shaft(spindle.shaft.start, tuple(sections))
    return replace(spindle, shaft=shaft, shortening=ComputedShortening(spindle.seats[0].x))


def loads(spindle: Spindle) -> np.ndarray:
    scene = Scene(spindle, conditions(), np.array([SPEED]) * RPM)
    return scene.preload.seat_load()[0]


@pytest.mark.parametrize(
    "springs", ["at a stop", "open", "locked", "held by friction", "on a support"]
)
def test_the_first_order_is_that_of_machines_solved_anew(springs: str) -> None:
    spindle = machine(springs)
    scene = Scene(spindle, conditions(), np.array([SPEED]) * RPM)
    found = shortening_load(scene.preload, 0)
    assert scene.preload.stopped.any() == (springs == "at a stop")
    anew = (loads(shortened(spindle, LESS)) - loads(shortened(spindle, 1e-9))) / LESS
    assert found == pytest.approx(anew, rel=0.01, abs=0.01 * np.abs(anew).max())
    assert np.abs(found).max() > 1.0


def test_it_is_told_where_loads_change_by_a_tenth() -> None:
    def told(spindle: Spindle, rpm: float) -> str:
        scene = Scene(spindle, conditions(), np.array([0.0, rpm]) * RPM)
        assert all(scene.preload.usable)
        return " ".join(words for words in scene.warnings if "shortening" in words)

    locked = machine("locked")
    load = shortening_load(Scene(locked, conditions(), np.array([24000.0]) * RPM).preload, 0)
    worst = int(np.abs(load).argmax())
    said = told(locked, 24000.0)
    assert f"adds about {load[worst]:.0f} N to the " in said
    assert f"of bearing {locked.seats[worst].name} at 24000 rpm: give shortening" in said
    assert not told(locked, 3000.0)
    assert not told(machine("open"), 24000.0)
    assert not told(shortened(locked, 1.0), 24000.0)


def test_it_is_not_told_of_forces_that_no_bearing_feels() -> None:
    """Under the weight alone, with play, loads along the axis are next to none."""
    seats = (
        BearingSeat("front", model("bearings", "qj218"), 0.05),
        BearingSeat("rear", model("bearings", "6012"), 0.35),
    )
    machine = mfw2310(seats=seats, sleeves=(), arrangement=None, shortening=None)
    scene = Scene(machine, conditions(gravity="-y"), np.array([6000.0]) * RPM)
    assert scene.preload.usable.all()
    added, load = shortening_load(scene.preload, 0), scene.preload.seat_load()[0]
    assert 10.0 > np.abs(added).max() > 0.1 * np.abs(load).max()
    assert not [each for each in scene.warnings if "shortening" in each]
