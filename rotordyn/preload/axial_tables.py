"""Loads and tangents of a bearing along its axis as a table: cubic pieces through solved states."""

from __future__ import annotations

from dataclasses import asdict
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq

from bearings.ball.law import Law
from bearings.bearing import BallBearing
from rotordyn.preload.arrangement import AxialBearing
from rotordyn.preload.axial_ends import begins, missed, turns, without_state
from rotordyn.state.laws import AxialLaw, sloped_table

# Of the free distance of the groove centres of a bearing:
SPACING = 2.0**-10  # of its table
FINER = 2.0 ** np.arange(-22.0, -7.5, 0.25)  # distances of further points from where it loads
CLOSE = 1e-9  # two points of which one is left out: rounding would make the slope between
ROUNDS = 3  # of points: the first, then more where cubic pieces miss others
REACH = 0.25  # deflection: a table begins so far unloaded and ends so far loaded, or farther
FARTHEST = 2.0  # deflection beyond where it loads: there a table ends, whatever its load
NEAR = 2.0**-9  # a table gives the load at rest that near to where the bearing has it
TABLES = 256  # kept: variants and analyses of a case share bearings and speeds


def axial_table(bearing: AxialBearing, speed: float, most: float) -> AxialLaw:
    """Axial loads and tangents of one bearing, up to the load ``most`` [N].

    The way from where it is loaded to the largest deflection is doubled until it has that load
    there, has no state, or exceeds ``FARTHEST``.
    """
    model, growth = bearing.model, (float(bearing.static_growth[0]), float(bearing.growth[0]))
    begin = max(0.0, float(begins(model, *growth)))
    way = REACH * model.free_distance
    while True:
        law, load, whole = _solved(model, bearing.law, growth, speed, begin + way)
        if load >= most or way > FARTHEST * model.free_distance or not whole:
            return law
        way *= 2.0


@lru_cache(TABLES)
def _solved(
    model: BallBearing, balls: Law, growth: tuple[float, float], speed: float, high: float
) -> tuple[AxialLaw, float, bool]:
    """The table of a bearing up to a deflection ``high`` [m], and down to −``high`` where it takes
    thrust both ways, its last load [N], and whether there is a state at its end; ``growth`` [m]:
    static, and all of it at speed."""
    from bearings.ring.tangents import stiffness

    distance = model.free_distance
    low = high / distance if model.both_ways else REACH
    even = np.arange(-round(low / SPACING), round(high / distance / SPACING) + 1) * SPACING
    beside = np.concatenate([-FINER, [0.0], FINER]) + begins(model, *growth) / distance
    d = np.concatenate([even, beside, -beside if model.both_ways else []])
    lowest = max(even[0], float(turns(model, growth[0])) / distance)
    d = np.unique(d.clip(lowest, even[-1]))
    more = d[np.diff(d, prepend=-np.inf) > CLOSE] * distance
    points = np.empty((3, 0))  # deflection, load, slope
    for _ in range(ROUNDS):
        displacement = np.zeros((len(more), 5))
        displacement[:, 0] = more
        state = model.equilibrium(
            displacement=displacement,
            speed=speed,
            static_growth=growth[0],
            growth=growth[1],
            **asdict(balls),
        )
        new = np.stack([more, state.load[:, 0], stiffness(state, "complete")[:, 0, 0]])
        points = np.concatenate([points, new], axis=1)
        points = points[:, np.argsort(points[0])]
        known = np.asarray(np.isfinite(points).all(axis=0))
        if known.sum() < 2:
            raise without_state("a bearing of the spindle", speed, growth[1])
        more = missed(*points[:, known])
        if not more.size:
            break
    if not model.both_ways:
        points[1] = np.maximum(points[1], 0.0)  # rounding does not pull
    law = sloped_table(*points[:, known].tolist())
    return law, float(points[1, known][-1]), bool(known[-1])


def deflection_of(law: AxialLaw, model: BallBearing, load: float, near: float) -> float:
    """Deflection [m] at which the table has a ``load`` [N], about where the bearing has it: with
    another one the preloads of the tables would not balance."""
    if law(near)[0] == load:
        return near
    far = NEAR * model.free_distance
    return float(brentq(lambda d: law(d)[0] - load, near - far, near + far, xtol=1e-18))
