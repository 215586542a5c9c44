"""What missing shortening of the shaft would do to axial loads, against machines solved again."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.case.model import model
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.added_loads import shift_load, shortening_load, stretch
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
def test_the_first_order_is_that_of_machines_solved_again(springs: str) -> None:
    spindle = machine(springs)
    scene = Scene(spindle, conditions(), np.array([SPEED]) * RPM)
    found = shortening_load(scene.preload, 0)
    assert scene.preload.stopped.any() == (springs == "at a stop")
    anew = (loads(shortened(spindle, LESS)) - loads(shortened(spindle, 1e-9))) / LESS
    assert found == pytest.approx(anew, rel=0.01, abs=0.01 * np.abs(anew).max())
    assert np.abs(found).max() > 1.0


def test_it_is_reported_where_loads_change_by_a_tenth() -> None:
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


def test_it_is_not_reported_of_forces_that_no_bearing_feels() -> None:
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


# --- forces along the axis -----------------------------------------------------------------------

PULL = 25e3  # N


def stepped(x: float, y: float) -> float:
    """Hooke's law over the cylinders of the grinding spindle from x to y [m]: Σ l / (E A)."""
    edges, outer = [0.0, 25e-3, 85e-3, 245e-3, 300e-3, 360e-3], [95e-3, 70e-3, 80e-3, 70e-3, 50e-3]
    total = 0.0
    for left, right, diameter in zip(edges[:-1], edges[1:], outer, strict=True):
        length = max(min(right, y) - max(left, x), 0.0)
        total += length / (210e9 * math.pi / 4.0 * (diameter**2 - 30e-3**2))
    return total


def grinding(**changes: object) -> Spindle:
    found = model("spindles", "grinding_spindle")
    return replace(found, **changes)


def rigid(**changes: object) -> Spindle:
    found = grinding(**changes)
    spring = replace(found.sleeves[0].spring, preload=600.0, stiffness=math.inf)
    return replace(found, sleeves=(replace(found.sleeves[0], spring=spring),))


def test_a_drawbar_shortens_the_shaft_by_the_law_of_hooke() -> None:
    at = [seat.x for seat in grinding().seats]
    bar = Drawbar(PULL, 20e-3, 330e-3)
    whole = -PULL * np.array([stepped(at[0], x) for x in at])
    assert stretch(grinding(drawbar=bar), 0.0, at) == pytest.approx(whole, rel=1e-9)
    assert stretch(grinding(), -PULL, at) == pytest.approx(whole, rel=1e-9)
    assert stretch(grinding(drawbar=bar), PULL, at) == pytest.approx(0.0, abs=1e-15)
    partly = stretch(grinding(drawbar=Drawbar(PULL, 0.1, 0.26)), 0.0, [0.0, *at, 0.36])
    ends = [0.0, 0.0, 0.0, stepped(0.1, 0.258), *[stepped(0.1, 0.26)] * 2]
    assert partly == pytest.approx(-PULL * np.array(ends), rel=1e-9)


@pytest.mark.parametrize("springs", ["locked", "at a stop"])
def test_loads_by_forces_are_those_of_machines_solved_again(springs: str) -> None:
    spindle = machine(springs)
    scene = Scene(spindle, conditions(), np.array([SPEED]) * RPM)
    found = shift_load(scene.preload, 0, lambda x: stretch(spindle, -PULL, x))
    small = stretch(spindle, -PULL * LESS, [seat.x for seat in spindle.seats])
    names = [seat.name for seat in spindle.seats]
    rule = PrescribedShortening(SPEED * RPM, dict(zip(names, small.tolist(), strict=True)))
    anew = (loads(replace(spindle, shortening=rule)) - scene.preload.seat_load()[0]) / LESS
    assert found == pytest.approx(anew, rel=0.01, abs=0.01 * np.abs(anew).max())
    assert np.abs(found).max() > 1.0


def test_drawbar_and_tension_are_named_where_loads_change_by_a_tenth() -> None:
    def said(spindle: Spindle, tension: float = 0.0) -> list[str]:
        scene = Scene(spindle, conditions(tension=tension), np.array([0.0, 12000.0]) * RPM)
        assert scene.preload.usable.all()
        return [each for each in scene.warnings if "between its bearings" in each]

    bar = Drawbar(PULL, 20e-3, 330e-3)
    (sentence,) = said(rigid(drawbar=bar))
    assert sentence.startswith("drawbar makes the shaft 7.4 µm shorter between its bearings")
    turned = rigid(drawbar=bar)
    (listed_from_the_rear,) = said(replace(turned, seats=turned.seats[::-1]))
    assert listed_from_the_rear.startswith("drawbar makes the shaft 7.4 µm shorter")
    added = float(sentence.split("adds about ")[1].split(" N")[0])
    offset = PULL * stepped(51e-3, 269e-3)  # between the pairs
    stiffer = replace(rigid().sleeves[0].spring, preload=0.0, offset=10.05e-6 + offset)
    sleeve = replace(rigid().sleeves[0], spring=stiffer)
    scene = Scene(grinding(sleeves=(sleeve,)), conditions(), np.zeros(1))
    assert added == pytest.approx(scene.preload.seat_load()[0].mean() - 300.0, rel=0.1)
    (pulled,) = said(rigid(), PULL)
    assert pulled.startswith("tension makes the shaft 7.4 µm longer")
    assert not said(rigid())
    weaker = replace(bar, force=10e3)
    assert said(rigid(drawbar=weaker))
    assert not said(grinding(drawbar=weaker)), "a spring takes it up"
    assert not said(rigid(drawbar=Drawbar(500.0, 20e-3, 330e-3)))
    assert not said(rigid(drawbar=bar), PULL), "both cancel between the bearings"
