"""Changes of a case that change nothing of the machine, and answers that have to stay."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import rotordyn
from bearings import AngularContactBallBearing
from bearings.materials import SILICON_NITRIDE, STEEL
from rotordyn.analyses import CampbellSpec, PreloadSpec, Unbalance, UnbalanceSpec
from rotordyn.case.case import Case
from rotordyn.machine.growth import QuadraticInSpeed, RingGrowth
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.lubrication import Lubrication

RPM = math.pi / 30.0
BALLS = AngularContactBallBearing(
    8e-3, 60e-3, 16, contact_angle=math.radians(18), ball_material=SILICON_NITRIDE
)
OIL = Lubrication(viscosity_40=32e-6, viscosity_100=5.4e-6, temperature=50.0)


def machine(**changes: object) -> Spindle:
    """A pair of bearings, the rear one on a sleeve with a stop."""
    growth = RingGrowth(0.0, QuadraticInSpeed(10e-6, 2000.0))
    spindle = Spindle(
        "pair",
        Shaft(0.0, (Section(0.3, 0.045, 0.02, STEEL),)),
        seats=(
            BearingSeat("a", BALLS, 0.08, 1, growth, radial_damping=500.0),
            BearingSeat("b", BALLS, 0.22, -1, growth, radial_damping=300.0),
        ),
        sleeves=(Sleeve("s", ("b",), Spring(300.0, 8e6), 20e-6),),
        points={"tip": 0.0, "tail": 0.3},
    )
    return replace(spindle, **changes)


@pytest.mark.long
def test_the_speed_of_a_stop_is_of_the_machine_not_of_the_speeds_asked() -> None:
    """Balls ride on films, which follow from the loads at that speed."""
    oiled, found = Conditions(dynamics="frozen", films=OIL), []
    for top in (15000.0, 20000.0):
        case = Case("stop", "", (top * RPM,), {"preload": PreloadSpec()}, oiled, machine())
        found += [rotordyn.run(case)["preload"].stop_speed.values[0]]
    assert found[1] == pytest.approx(found[0], rel=1e-8)


def tabled(support: LinearSupport) -> LinearSupport:
    """With a row between any two rows of its table, on the line that joins them."""

    def more(values: object) -> object:
        if not isinstance(values, tuple):
            return values
        return (*(x for a, b in pairwise(values) for x in (a, 0.7 * a + 0.3 * b)), values[-1])

    entries = (support.stiffness, support.damping)
    stiffness, damping = ({pair: more(k) for pair, k in each.items()} for each in entries)
    return replace(support, speeds=more(support.speeds), stiffness=stiffness, damping=damping)


def poles_of(case: Case, speeds: Iterable[float]) -> np.ndarray:
    """At the first and the last speed [rpm]."""
    asked = {"campbell": replace(case.analyses["campbell"], shapes=False)}
    at = tuple(speed * RPM for speed in speeds)
    found = rotordyn.run(replace(case, speeds=at, analyses=asked, references=()))
    return found["campbell"].pole.values[[0, -1]]


@pytest.mark.long
def test_modes_are_the_same_whatever_speeds_are_asked_between() -> None:
    """A strongly damped one passes others of nearly its shape and frequency."""
    case = rotordyn.load("belt_driven_loads")
    few, many = (poles_of(case, np.linspace(0.0, 9000.0, count)) for count in (2, 5))
    assert many == pytest.approx(few, rel=1e-6)


def test_rows_of_a_table_on_the_line_between_others_change_no_mode() -> None:
    case = rotordyn.load("friswell_oil_films")
    spindle = replace(case.spindle, supports=tuple(map(tabled, case.spindle.supports)))
    few, many = (poles_of(one, (500.0, 4500.0)) for one in (case, replace(case, spindle=spindle)))
    assert many == pytest.approx(few, rel=1e-6)


HELD = {("y", "y"): 3e7, ("z", "z"): 1e7, ("y", "z"): 3e6, ("z", "y"): -2e6}
DAMPED = {("y", "y"): 2e3, ("z", "z"): 8e2}
ROD = Shaft(0.0, (Section(0.4, 0.05, 0.01, STEEL),))


def held(name: str, holds: str = "spindle") -> tuple[LinearSupport, LinearSupport]:
    """Both ends of a rod."""
    return (
        LinearSupport(f"{name}1", 0.05, HELD, DAMPED, holds=holds),
        LinearSupport(f"{name}2", 0.35, HELD, DAMPED, holds=holds),
    )


def mirrored(supports: tuple[LinearSupport, ...]) -> tuple[LinearSupport, ...]:
    """In z: what turns one way turns the other."""
    other = {pair: k if pair[0] == pair[1] else -k for pair, k in HELD.items()}
    return tuple(replace(each, stiffness=other) for each in supports)


def whirling(
    points: tuple[str, ...], at: tuple[str, ...], spindle: Spindle, angle: float = 0.3
) -> np.ndarray:
    """Displacements under an unbalance at each of the points ``at``."""
    asked = UnbalanceSpec(points, tuple(Unbalance(each, 1e-5, angle) for each in at))
    case = Case("rods", "", (300.0, 700.0), {"unbalance": asked}, Conditions(), spindle)
    return rotordyn.run(case)["unbalance"].displacement.values


@pytest.mark.parametrize("ratio", [1.0, -1.0])
def test_a_rotor_that_nothing_joins_to_the_shaft_whirls_as_alone(ratio: float) -> None:
    """Beside an equal one; the other way round it is its own mirror image in z."""
    alone = Spindle("rod", ROD, supports=held("a"), points={"p": 0.2})
    others = held("b", "other") if ratio > 0.0 else mirrored(held("b", "other"))
    both = replace(
        alone,
        supports=(*alone.supports, *others),
        rotors=(Rotor("other", ratio, ROD, points={"q": 0.2}),),
    )
    wanted = whirling(("p",), ("p",), alone)[:, 0]
    found = whirling(("p", "other.q"), ("other.q",), both, 0.3 * ratio)
    assert not found[:, 0].any()
    assert found[:, 1] == pytest.approx(wanted * [1.0, ratio], rel=1e-6)
    if ratio > 0.0:
        found = whirling(("p", "other.q"), ("p", "other.q"), both)
        assert found == pytest.approx(np.stack([wanted, wanted], axis=1), rel=1e-6)


@pytest.mark.parametrize("ratio", [1.5, -1.5])
def test_either_of_two_rotors_may_be_called_the_spindle(ratio: float) -> None:
    """Critical speeds are then in its own turns."""
    rods = ROD, Shaft(0.0, (Section(0.4, 0.03, 0.0, STEEL),))
    joint = LinearSupport("between", 0.2, {("y", "y"): 2e7, ("z", "z"): 2e7}, against="other")
    found = []
    for (first, second), turns in ((rods, ratio), (rods[::-1], 1.0 / ratio)):
        ends = (*held("a"), *held("b", "other"))
        ends = mirrored(ends) if first is not ROD and ratio < 0.0 else ends
        spindle = Spindle(
            "two", first, supports=(*ends, joint), rotors=(Rotor("other", turns, second),)
        )
        at = tuple(np.array([0.0, 3000.0]) * (1.0 if turns == ratio else abs(ratio)))
        asked = {"campbell": CampbellSpec(600.0, shapes=False)}
        results = rotordyn.run(Case("two", "", at, asked, Conditions(accuracy=1e-6), spindle))
        one = results["campbell"]
        found.append((np.sort_complex(one.pole.values), np.sort(one.critical_speed / at[1])))
    assert found[1][0] == pytest.approx(found[0][0], rel=1e-7)
    assert len(found[0][1]) > 1
    assert found[1][1] == pytest.approx(found[0][1], rel=1e-6)
