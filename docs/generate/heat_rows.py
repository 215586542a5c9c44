"""Friction of a bearing by every model, compared with SKF's published model within its range."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from bearings import AngularContactBallBearing, Lubricant, heat
from bearings.heat.skf import inlet_shear, rolling_moment, sliding_moment, starvation
from bearings.materials import STEEL
from docs.generate.marked import table
from docs.generate.rows import number

RPM = math.pi / 30.0
OIL, CELSIUS = Lubricant(68e-6, 8.5e-6), 70.0  # an ISO VG 68, some 20 mm²/s
# Like a 7210 B: 50 × 90 × 20, 40°; balls and grooves are usual for that size, not those of a maker.
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


# SKF catalogue 6000, p. 104: 22208 E at 3500 rpm, oil of 68 mm²/s, Grr 0.26, KZ 5.5 [N mm]. The
# rest from memory [M]: its loads, which give the printed Grr, factors of series 222 E, the oil
# 2.5 mm above the lowest contact with the drag variable VM that a chart gives for it.
ROLLER_SPEED, ROLLER_OIL, ROLLER_FACTOR, ROLLER_SHAPE = 3500.0, 68e-6, 0.26, 5.5
ROLLER_BORE, ROLLER_OUTSIDE = 40e-3, 80e-3
ROLLER_LOADS = 2990.0, 100.0  # radial, axial [N]
ROLLER_R1, ROLLER_R2, ROLLER_S1, ROLLER_S2 = 1.6e-6, 5.84, 3.62e-3, 508.0
ROLLER_WIDTH, ROLLER_CAGE, ROLLER_DRAG = 23.0, 0.8, 3e-5  # B [mm], KL, VM
PUBLISHED = {"φish": 0.85, "φrs": 0.80, "Mrr [N mm]": 437.0}
PUBLISHED_MOMENT = 334.0
PUBLISHED_HEAD = ("22208 E, 3500 rpm", "published:", "computed:", "deviation:")


class RollerMoment(NamedTuple):
    """Moment of the published spherical roller bearing [N·mm]: rolling with its factors, sliding,
    drag in the oil bath; ``factor``: Grr of its loads."""

    inlet: float
    starved: float
    bare: float
    sliding: float
    drag: float
    factor: float

    @property
    def rolling(self) -> float:
        """φish φrs Mrr of the printed Grr [N·mm]."""
        return self.inlet * self.starved * self.bare

    @property
    def total(self) -> float:
        """M [N·mm]."""
        return self.rolling + self.sliding + self.drag


def roller_moment() -> RollerMoment:
    """The published example: factors by the code of ball bearings, variables of roller bearings."""
    speed, pitch = ROLLER_SPEED * RPM, 0.5 * (ROLLER_BORE + ROLLER_OUTSIDE)
    dm, (radial, axial) = pitch * 1e3, ROLLER_LOADS
    sliding = ROLLER_S1 * dm**0.25 * (radial**4 + ROLLER_S2 * axial**4) ** (1.0 / 3.0)
    ratio = (ROLLER_BORE + ROLLER_OUTSIDE) / (ROLLER_OUTSIDE - ROLLER_BORE)
    churned = ROLLER_CAGE * ROLLER_SHAPE * ratio * 1e-12
    return RollerMoment(
        inlet=float(inlet_shear(speed, pitch, ROLLER_OIL)),
        starved=float(
            starvation(speed, ROLLER_OIL, ROLLER_BORE, ROLLER_OUTSIDE, "low bath", ROLLER_SHAPE)
        ),
        bare=1e3 * float(rolling_moment(ROLLER_FACTOR, ROLLER_OIL, speed)),
        sliding=1e3 * float(sliding_moment(sliding, ROLLER_OIL, speed, pitch, 0.05)),
        drag=10.0 * ROLLER_DRAG * churned * ROLLER_WIDTH * dm**4 * ROLLER_SPEED**2,
        factor=ROLLER_R1 * dm**1.85 * (radial + ROLLER_R2 * axial) ** 0.54,
    )


def published_heat_table() -> str:
    """The published friction moment whose parts are all given."""
    found = roller_moment()
    computed = found.inlet, found.starved, found.bare
    rows = [
        (
            name,
            number(known),
            number(value),
            f"{100 * (value / known - 1):+.1f} %".replace("-", "−"),
        )
        for (name, known), value in zip(PUBLISHED.items(), computed, strict=True)
    ]
    known = math.prod(PUBLISHED.values())
    pairs = (
        ("their product [N mm]", known, found.rolling),
        ("Grr of its loads [M]", ROLLER_FACTOR, found.factor),
        ("M with sliding and drag of the oil bath [M] [N mm]", PUBLISHED_MOMENT, found.total),
    )
    for name, printed, value in pairs:
        off = f"{100 * (value / printed - 1):+.1f} %".replace("-", "−")
        rows.append((name, number(printed), number(value), off))
    return table(PUBLISHED_HEAD, rows)


def heat_table() -> str:
    """Moments of the models and their deviation from that of SKF."""
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
