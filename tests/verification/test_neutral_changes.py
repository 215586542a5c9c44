"""Changes of a case that change nothing of the machine, and answers that have to stay."""

from __future__ import annotations

import math
from dataclasses import replace

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
