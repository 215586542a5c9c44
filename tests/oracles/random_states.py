"""Random bearings from 2 mm to 60 mm balls and random states of them, far into the uncommon.

Every bearing has its own stream of random numbers, (seed, number), so that any state found odd can
be drawn again alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings import SILICON_NITRIDE, STEEL, AngularContactBallBearing
from tests.oracles.ball_equations import Balls
from tests.oracles.known_bearings import HYPOTHESES, SHARINGS

Array = NDArray[np.float64]
RATED = 4.2e9  # Pa, the pressure of the static rating (ISO 76)
HIGHEST = 4.0e6 / 1e3 * math.pi / 30.0  # n·dm, rpm·mm, as ω·dm [m/s]
GROWTH = 50e-6  # m, and at most 0.3 % of the ball


@dataclass(frozen=True)
class Drawn:
    """A bearing, its hypotheses, the load of one ball and approach of both races at the rating."""

    bearing: AngularContactBallBearing
    kinematics: str
    sharing: str
    equations: Balls
    rated_load: float
    rated_approach: float
    friction: float | None = None

    @property
    def how(self) -> dict[str, Any]:
        """Arguments of ``equilibrium`` that name the hypotheses."""
        names = dict(kinematics=self.kinematics, moment_sharing=self.sharing)
        return names | dict(friction=self.friction)


def draw_bearing(rng: np.random.Generator, number: int) -> Drawn:
    """3–60 balls of 2–60 mm that do not overlap; all 16 pairs of hypotheses take turns."""
    balls = round(3.0 * 20.0 ** rng.uniform())
    diameter = 2e-3 * 30.0 ** rng.uniform()
    least = max(1.03 * diameter / math.sin(math.pi / balls), 2.8 * diameter)
    bearing = AngularContactBallBearing(
        ball_diameter=diameter,
        pitch_diameter=least * rng.uniform(1.0, 1.4),
        balls=balls,
        contact_angle=math.radians(rng.choice([0.0, 15.0, 25.0, 40.0, rng.uniform(0.0, 45.0)])),
        inner_conformity=rng.uniform(0.505, 0.58),
        outer_conformity=rng.uniform(0.505, 0.58),
        ball_material=SILICON_NITRIDE if rng.uniform() < 0.5 else STEEL,
    )
    names = HYPOTHESES[number % 4], SHARINGS[number // 4 % 4]
    equations = Balls(bearing, *names)
    load = (RATED / max(equations.inner.pressure, equations.outer.pressure)) ** 3
    approach = sum((load / race.k) ** (2.0 / 3.0) for race in (equations.inner, equations.outer))
    return Drawn(bearing, *names, equations, load, approach)


def draw_speeds(rng: np.random.Generator, drawn: Drawn, count: int, rest: float = 0.03) -> Array:
    """ω [rad/s] up to 4·10⁶ rpm·mm; a share of ``rest`` does not rotate."""
    speed = HIGHEST / drawn.bearing.pitch_diameter * rng.uniform(0.0, 1.0, count)
    return np.where(rng.uniform(size=count) < rest, 0.0, speed)


def draw_growth(rng: np.random.Generator, drawn: Drawn, count: int) -> Array:
    """± 50 µm, less on small balls."""
    most = min(GROWTH, 3e-3 * drawn.bearing.ball_diameter)
    return most * rng.uniform(-1.0, 1.0, count)


def draw_pressing(rng: np.random.Generator, drawn: Drawn, count: int) -> Array:
    """Overlap of the grooves with the ball at rest [m]: 40 % alike in pressure up to 5.5 GPa, 40 %
    alike in the logarithm of the load over five decades, the rest apart by up to half a reach."""
    pressure = 5.5e9 / RATED * rng.uniform(size=count)
    light = 10.0 ** (-5.0 / 3.0 * rng.uniform(size=count))
    apart = -0.5 * min(drawn.equations.li, drawn.equations.lo) * rng.uniform(size=count)
    kind = rng.uniform(size=count)
    relative = np.where(kind < 0.4, pressure, light)
    return np.where(kind < 0.8, drawn.rated_approach * relative**2, apart)


def draw_centres(rng: np.random.Generator, drawn: Drawn, count: int) -> Array:
    """Inner groove centres A (2, count): any overlap, turned by some 6° from the contact angle."""
    length = drawn.equations.li + drawn.equations.lo + draw_pressing(rng, drawn, count)
    angle = drawn.bearing.contact_angle + math.radians(6.0) * rng.standard_normal(count)
    return length * np.array([np.sin(angle), np.cos(angle)])


def draw_loads(rng: np.random.Generator, drawn: Drawn, count: int) -> Array:
    """Loads (count, 5) in any direction up to the static rating, moments up to 0.3 dm/2 · F.

    The rating is the load at which the heaviest ball, at rest, reaches 4.2 GPa: z Q sin α axially
    (α at least 15°) and z Q cos α / 5 radially (Stribeck), joined linearly.
    """
    b = drawn.bearing
    angle = max(b.contact_angle, math.radians(15.0))
    axial = b.balls * drawn.rated_load * math.sin(angle)
    radial = b.balls * drawn.rated_load * math.cos(b.contact_angle) / 5.0
    way = rng.standard_normal((count, 3))
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    share = np.where(
        rng.uniform(size=count) < 0.5,
        rng.uniform(size=count),
        10.0 ** (-4.0 * rng.uniform(size=count)),
    )
    size = share / (np.abs(way[:, 0]) / axial + np.hypot(way[:, 1], way[:, 2]) / radial)
    lever = 0.15 * b.pitch_diameter * rng.uniform(-1.0, 1.0, (count, 2))
    return np.column_stack([size[:, None] * way, size[:, None] * lever])


def draw_displacements(rng: np.random.Generator, drawn: Drawn, count: int) -> Array:
    """Displacements (count, 5) of the size of the rated approach in every freedom, or smaller."""
    size = drawn.rated_approach * 10.0 ** (-1.5 * rng.uniform(size=(count, 1)))
    radius = 0.5 * drawn.bearing.pitch_diameter
    thrown = rng.uniform(-1.0, 1.0, (count, 5)) * [1.0, 0.7, 0.7, 0.7 / radius, 0.7 / radius]
    thrown[:, 0] += 0.5
    return size * thrown
