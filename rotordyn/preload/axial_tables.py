"""Loads and tangents of a bearing along its axis as a table: cubic pieces through solved states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from bearings.ball.law import Law
from bearings.bearing import BallBearing
from rotordyn.arrays import Array
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
TOGETHER = 8  # tables that are solved in one batch


class _Asked(NamedTuple):
    """A table of a ``model`` up to a deflection ``high`` [m], and down to −``high`` where it takes
    thrust both ways; ``growth`` [m]: static, and all of it at ``speed`` [rad/s]."""

    model: BallBearing
    law: Law
    growth: tuple[float, float]
    speed: float
    high: float


class _Found(NamedTuple):
    """A table, its last ``load`` [N], and whether there is a state at its end, ``whole``."""

    law: AxialLaw
    load: float
    whole: bool


_kept: dict[_Asked, _Found] = {}  # the last one that was asked for stands last


def axial_tables(
    bearings: Sequence[AxialBearing], speeds: Sequence[float], most: float
) -> list[AxialLaw]:
    """Axial loads and tangents of bearings, each at a speed of its own [rad/s], up to the load
    ``most`` [N].

    The way from where one is loaded to the largest deflection is doubled until it has that load
    there, has no state, or exceeds ``FARTHEST``.

    Raises
    ------
    NoSolution : a bearing without any state
    """
    asked: list[_Asked] = []
    for one, speed in zip(bearings, speeds, strict=True):
        assert isinstance(one.law, Law)
        growth = float(one.static_growth[0]), float(one.growth[0])
        begin = max(0.0, float(begins(one.model, *growth)))
        high = begin + REACH * one.model.free_distance
        asked.append(_Asked(one.model, one.law, growth, float(speed), high))
    found = solved(asked)
    ways = [REACH * one.model.free_distance for one in bearings]
    while True:
        longer = [
            k
            for k, (table, way) in enumerate(zip(found, ways, strict=True))
            if table.load < most and way <= FARTHEST * asked[k].model.free_distance and table.whole
        ]
        if not longer:
            return [table.law for table in found]
        for k in longer:
            asked[k] = asked[k]._replace(high=asked[k].high + ways[k])
            ways[k] *= 2.0
        for k, table in zip(longer, solved([asked[k] for k in longer]), strict=True):
            found[k] = table


def solved(asked: Sequence[_Asked]) -> list[_Found]:
    """The tables, of alike bearings some together; of the last ones each is made once."""
    found = {one: table for one in asked if (table := _kept.pop(one, None)) is not None}
    alike: dict[tuple[BallBearing, Law], list[_Asked]] = {}
    for one in dict.fromkeys(asked):
        if one not in found:
            alike.setdefault((one.model, one.law), []).append(one)
    for every in alike.values():
        for first in range(0, len(every), TOGETHER):
            part = every[first : first + TOGETHER]
            found |= zip(part, _made(part), strict=True)
    _kept.update(found)
    for old in list(_kept)[:-TABLES]:
        _kept.pop(old, None)
    return [found[one] for one in asked]


def _made(asked: Sequence[_Asked]) -> list[_Found]:
    """Tables of one bearing under one law."""
    from bearings.ring.tangents import stiffness

    model, law = asked[0].model, asked[0].law
    points = [np.empty((3, 0)) for _ in asked]  # deflection, load, slope
    more = [_first_points(one) for one in asked]
    for _ in range(ROUNDS):
        sizes = [len(each) for each in more]
        if not sum(sizes):
            break
        static, growth, speed = (
            np.repeat(values, sizes)
            for values in zip(*((*one.growth, one.speed) for one in asked), strict=True)
        )
        displacement = np.zeros((sum(sizes), 5))
        displacement[:, 0] = np.concatenate(more)
        state = model.equilibrium(
            displacement=displacement,
            speed=speed,
            static_growth=static,
            growth=growth,
            **asdict(law),
        )
        slope = stiffness(state, "complete")[:, 0, 0]
        new = np.stack([displacement[:, 0], state.load[:, 0], slope])
        for k, own in enumerate(np.split(new, np.cumsum(sizes)[:-1], axis=1)):
            if not own.size:
                continue
            points[k] = np.concatenate([points[k], own], axis=1)
            points[k] = points[k][:, np.argsort(points[k][0])]
            known = np.asarray(np.isfinite(points[k]).all(axis=0))
            if known.sum() < 2:
                which = "a bearing of the spindle"
                raise without_state(which, asked[k].speed, asked[k].growth[1])
            more[k] = missed(*points[k][:, known])
    return [_table(model, each) for each in points]


def _first_points(asked: _Asked) -> Array:
    """Deflections [m] of a table, ascending: even ones, and more beside where it loads."""
    model, high = asked.model, asked.high
    distance = model.free_distance
    low = high / distance if model.both_ways else REACH
    even = np.arange(-round(low / SPACING), round(high / distance / SPACING) + 1) * SPACING
    beside = np.concatenate([-FINER, [0.0], FINER]) + begins(model, *asked.growth) / distance
    d = np.concatenate([even, beside, -beside if model.both_ways else []])
    lowest = max(even[0], float(turns(model, asked.growth[0])) / distance)
    d = np.unique(d.clip(lowest, even[-1]))
    return np.asarray(d[np.diff(d, prepend=-np.inf) > CLOSE] * distance)


def _table(model: BallBearing, points: Array) -> _Found:
    """Of points (3, n): deflection, load, slope, without a number where there is no state."""
    known = np.asarray(np.isfinite(points).all(axis=0))
    if not model.both_ways:
        points[1] = np.maximum(points[1], 0.0)  # rounding does not pull
    law = sloped_table(*points[:, known].tolist())
    return _Found(law, float(points[1, known][-1]), bool(known[-1]))


def deflection_of(law: AxialLaw, model: BallBearing, load: float, near: float) -> float:
    """Deflection [m] at which the table has a ``load`` [N], about where the bearing has it: with
    another one the preloads of the tables would not balance."""
    if law(near)[0] == load:
        return near
    far = NEAR * model.free_distance
    return float(brentq(lambda d: law(d)[0] - load, near - far, near + far, xtol=1e-18))
