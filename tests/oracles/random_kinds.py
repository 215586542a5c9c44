"""Random bearings of every kind and random questions about them.

Every bearing has its own stream of random numbers, (seed, kind, number), so that any state found
odd can be drawn again alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings import SILICON_NITRIDE, STEEL, BallBearing
from bearings.ring.state import BearingState
from tests.oracles.four_point import Drawing, GrooveOracle
from tests.oracles.known_bearings import HYPOTHESES, SHARINGS
from tests.oracles.known_grooves import angular_contact, deep_groove, four_point, thrust
from tests.oracles.random_states import HIGHEST, RATED

Array = NDArray[np.float64]
KINDS = {
    "angular contact": angular_contact,
    "deep groove": deep_groove,
    "four point": four_point,
    "thrust": thrust,
}
ONE_WAY = ("angular contact", "thrust")
NO_RADIAL_LOAD = np.array([True, False, False, True, True])
SEED = 5


@dataclass(frozen=True)
class Asked:
    """A bearing and states (s,) asked of it; ``shift`` [m]: from its zero of δx to the centred."""

    bearing: BallBearing
    oracle: GrooveOracle
    dynamics: str
    free: NDArray[np.bool_]
    load: Array
    displacement: Array
    speed: Array
    shift: float

    def solve(self, start: BearingState | None = None) -> BearingState:
        """All states in one call."""
        return self.bearing.equilibrium(
            load=np.where(self.free, self.load, np.nan),
            displacement=np.where(self.free, np.nan, self.displacement),
            speed=self.speed,
            dynamics=self.dynamics,
            kinematics=self.oracle.kinematics,
            moment_sharing=self.oracle.moment_sharing,
            start=start,
        )

    def rolled(self) -> Asked:
        """Every question in the place of the next."""
        parts = {n: np.roll(getattr(self, n), 1, axis=0) for n in ("load", "displacement", "speed")}
        rest = (self.bearing, self.oracle, self.dynamics, self.free)
        return Asked(*rest, shift=self.shift, **parts)


def draw(kind: str, number: int, count: int) -> Asked:
    """A bearing of a kind and ``count`` states, by load, by displacement or a mix of both."""
    rng = np.random.default_rng([SEED, list(KINDS).index(kind), number])
    drawing = _drawing(kind, rng)
    how = dict(kinematics=HYPOTHESES[number % 4], moment_sharing=SHARINGS[number // 4 % 4])
    oracle = GrooveOracle(drawing, **how)
    rated = (RATED / oracle.peak.max()) ** 3
    speed = HIGHEST / drawing.pitch_diameter * rng.uniform(size=count)
    speed *= rng.uniform(size=count) > 0.1
    by_load = (5, 5, 0, int(rng.integers(1, 5)))[rng.integers(4)]
    touching, steep = kind in ONE_WAY, kind == "thrust"
    dynamics = ("resultant", "frozen")[rng.integers(2)]
    free = rng.permutation(np.arange(5) < by_load) & (NO_RADIAL_LOAD | (not steep))
    free_travel = drawing.free_distance * math.sin(drawing.contact_angle)
    return Asked(
        bearing=KINDS[kind](drawing),
        oracle=oracle,
        dynamics=dynamics,
        free=free,
        load=_loads(rng, drawing, rated, count, touching, steep),
        displacement=_displacements(rng, drawing, oracle, rated, count, touching),
        speed=speed,
        shift=free_travel if touching else 0.0,
    )


def _drawing(kind: str, rng: np.random.Generator) -> Drawing:
    """4–40 balls of 2–60 mm that do not overlap."""
    balls = round(4.0 * 10.0 ** rng.uniform())
    diameter = 2e-3 * 30.0 ** rng.uniform()
    least = max(1.03 * diameter / math.sin(math.pi / balls), 2.8 * diameter)
    fi, fo = rng.uniform(0.507, 0.56, 2)
    angle = {"angular contact": 15.0, "deep groove": 3.0, "four point": 24.0}.get(kind, 90.0)
    angle = math.radians(angle + rng.uniform(0.0, 20.0 if kind != "thrust" else 0.0))
    shims: dict[str, Any] = {}
    if kind == "four point":
        part = np.sin(angle) * rng.uniform(0.1, 0.97, 2)  # sine of the angle of the arch
        spans = 2.0 * (np.array([fi, fo]) - 0.5) * diameter * part
        shims = dict(inner_shim=float(spans[0]), outer_shim=float(spans[1]))
    return Drawing(
        ball_diameter=diameter,
        pitch_diameter=least * rng.uniform(1.0, 1.4),
        balls=balls,
        contact_angle=angle,
        inner_conformity=float(fi),
        outer_conformity=float(fo),
        ball_material=SILICON_NITRIDE if rng.uniform() < 0.5 else STEEL,
        ring_material=STEEL,
        **shims,
    )


def _loads(
    rng: np.random.Generator,
    drawing: Drawing,
    rated: float,
    count: int,
    one_way: bool,
    steep: bool,
) -> Array:
    """Any direction and four decades of size, up to about the static rating; thrust if steep."""
    way = rng.standard_normal((count, 3)) * (np.array([1.0, 0.0, 0.0]) if steep else 1.0)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    if one_way:
        way[:, 0] = np.abs(way[:, 0]) + 0.5
    share = np.where(
        rng.uniform(size=count) < 0.5, rng.uniform(size=count), 10 ** -rng.uniform(0, 4, count)
    )
    size = share * drawing.balls * rated / 5.0
    moment = 0.15 * drawing.pitch_diameter * rng.uniform(-1.0, 1.0, (count, 2))
    return size[:, None] * np.column_stack([way, moment])


def _displacements(
    rng: np.random.Generator,
    drawing: Drawing,
    oracle: GrooveOracle,
    rated: float,
    count: int,
    touching: bool,
) -> Array:
    """Of the size of the rated approach, beyond the axial play one way or the other."""
    approach = 2e-6 * (rated / oracle.k.min()) ** (2.0 / 3.0)
    size = approach * 10.0 ** rng.uniform(-1.5, 0.0, (count, 1))
    thrown = size * rng.uniform(-1.0, 1.0, (count, 5)) / oracle.lever
    if touching:
        thrown[:, 0] += 0.5 * size[:, 0]
    else:
        thrown[:, 0] += 0.5 * drawing.axial_play * rng.uniform(-1.2, 1.2, count)
    return thrown
