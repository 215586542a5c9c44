"""Friction of a bearing by every model, beside SKF's published one where that is made for."""

from __future__ import annotations

import math

import numpy as np

from bearings import AngularContactBallBearing, Lubricant, heat
from bearings.heat.skf import inlet_shear, rolling_moment, starvation
from bearings.materials import STEEL
from docs.generate.marked import table
from docs.generate.rows import number

RPM = math.pi / 30.0
OIL, CELSIUS = Lubricant(68e-6, 8.5e-6), 70.0  # an ISO VG 68, some 20 mm²/s
# Like a 7210 B: 50 × 90 × 20, 40°; balls and grooves as usual for that size, not a maker's.
STEEP = AngularContactBallBearing(
    ball_diameter=12.7e-3,
    pitch_diameter=70e-3,
    balls=15,
    contact_angle=math.radians(40.0),
    inner_conformity=0.52,
    outer_conformity=0.53,
    ball_material=STEEL,
)
BORE, OUTSIDE = 50e-3, 90e-3
CASES = ((1000.0, 1000.0), (1000.0, 3000.0), (5000.0, 3000.0), (5000.0, 9000.0), (11000.0, 3000.0))
HEAD = ("axial load [N]:", "speed [rpm]:", "SKF [N mm]:", "`ellipse`:", "`palmgren`:")


# SKF catalogue 6000, p. 104: 22208 E at 3500 rpm, oil of 68 mm²/s, Grr 0.26, KZ 5.5 [N mm]
ROLLER_SPEED, ROLLER_OIL, ROLLER_FACTOR, ROLLER_SHAPE = 3500.0, 68e-6, 0.26, 5.5
ROLLER_BORE, ROLLER_OUTSIDE = 40e-3, 80e-3
PUBLISHED = {"φish": 0.85, "φrs": 0.80, "Mrr [N mm]": 437.0}
PUBLISHED_MOMENT = 334.0
PUBLISHED_HEAD = ("22208 E, 3500 rpm", "published:", "computed:", "deviation:")


def published_heat_table() -> str:
    """The one published friction moment that names all it is made of, as far as the model goes."""
    speed = ROLLER_SPEED * RPM
    computed = (
        float(inlet_shear(speed, 0.5 * (ROLLER_BORE + ROLLER_OUTSIDE), ROLLER_OIL)),
        float(starvation(speed, ROLLER_OIL, ROLLER_BORE, ROLLER_OUTSIDE, "low bath", ROLLER_SHAPE)),
        float(rolling_moment(ROLLER_FACTOR, ROLLER_OIL, speed)) * 1e3,
    )
    rows = [
        (
            name,
            number(known),
            number(value),
            f"{100 * (value / known - 1):+.1f} %".replace("-", "−"),
        )
        for (name, known), value in zip(PUBLISHED.items(), computed, strict=True)
    ]
    rolling = math.prod(computed)
    known = math.prod(PUBLISHED.values())
    off = f"{100 * (rolling / known - 1):+.1f} %".replace("-", "−")
    rows.append(("their product [N mm]", number(known), number(rolling), off))
    rows.append(
        (
            "M with its sliding part [N mm]",
            number(PUBLISHED_MOMENT),
            "its sliding part has a roller bearing's factors",
            "",
        )
    )
    return table(PUBLISHED_HEAD, rows)


def heat_table() -> str:
    """Moments of the models and their deviation from SKF's."""
    return table(HEAD, [_row(speed, load) for speed, load in CASES])


def _row(rpm: float, load: float) -> tuple[str, ...]:
    speed = rpm * RPM
    state = STEEP.equilibrium(load=[load, 0.0, 0.0, 0.0, 0.0], speed=speed)
    known = heat.skf_moment(
        radial=0.0,
        axial=load,
        speed=speed,
        viscosity=OIL.kinematic(CELSIUS),
        bore=BORE,
        outside=OUTSIDE,
        supply="bath",
    )
    published = float(np.asarray(known.total)) * 1e3
    cells = [f"{load:.0f}", f"{rpm:.0f}", number(published)]
    for model in ("ellipse", "palmgren"):
        lost = heat.losses(state, OIL, CELSIUS, oil_factor=2.0, model=model)
        moment = float(lost.moment) * 1e3
        deviation = 100.0 * (moment / published - 1.0)
        cells.append(f"{number(moment)} ({deviation:+.0f} %)".replace("-", "−"))
    return tuple(cells)
