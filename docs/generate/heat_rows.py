"""Friction of a bearing by every model, beside SKF's published one where that is made for."""

from __future__ import annotations

import math

import numpy as np

from bearings import AngularContactBallBearing, Lubricant, heat
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
