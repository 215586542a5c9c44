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
from rotordyn.analyses import PreloadSpec
from rotordyn.case.case import Case
from rotordyn.machine.growth import QuadraticInSpeed, RingGrowth
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
