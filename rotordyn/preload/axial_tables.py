"""Axial load and tangent of a bearing as a table: cubic pieces through solved states."""

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
FINER = 2.0 ** np.arange(-22.0, -7.5, 0.25)  # distances of further points from the onset of load
CLOSE = 1e-9  # of two points as close one is dropped: rounding would set the slope between them
ROUNDS = 3  # of points: the initial ones, then more where cubic pieces are inaccurate
REACH = 0.25  # extent of a table below zero deflection, and at first beyond the onset of load
FARTHEST = 2.0  # extent beyond the onset above which a table is not lengthened, whatever its load
NEAR = 2.0**-9  # distance between the deflections of table and bearing at one load, at most
TABLES = 256  # tables kept: variants and analyses of a case share bearings and speeds
TOGETHER = 8  # tables solved in one batch


class _Request(NamedTuple):
    """Request for the table of a ``model`` up to a deflection ``high`` [m], and down to −``high``
    where it takes thrust both ways; ``growth`` [m]: static and total, at ``speed`` [rad/s]."""

    model: BallBearing
    law: Law
    growth: tuple[float, float]
    speed: float
    high: float


class _Solved(NamedTuple):
    """Table ``law`` with its last ``load`` [N]; ``to_end``: whether the last point asked
    for has a state."""

    law: AxialLaw
    load: float
    to_end: bool


_kept: dict[_Request, _Solved] = {}  # in the order of their last request


def axial_tables(
    bearings: Sequence[AxialBearing], speeds: Sequence[float], most: float
) -> list[AxialLaw]:
    """Return axial loads and tangents of bearings, each at its own speed [rad/s], up to the load
    ``most`` [N].

    The extent from the onset of load to the largest deflection is doubled until the load there is
    at least ``most``, there is no state, or the extent exceeds ``FARTHEST``.

    Raises
    ------
    NoSolution : a bearing without any state
    """
    requests: list[_Request] = []
    for bearing, speed in zip(bearings, speeds, strict=True):
        assert isinstance(bearing.law, Law)
        growth = float(bearing.static_growth[0]), float(bearing.growth[0])
        onset = max(0.0, float(begins(bearing.model, *growth)))
        high = onset + REACH * bearing.model.free_distance
        requests.append(_Request(bearing.model, bearing.law, growth, float(speed), high))
    tables = solved(requests)
    extents = [REACH * bearing.model.free_distance for bearing in bearings]
    while True:
        longer = [
            k
            for k, (table, extent) in enumerate(zip(tables, extents, strict=True))
            if table.load < most
            and extent <= FARTHEST * requests[k].model.free_distance
            and table.to_end
        ]
        if not longer:
            return [table.law for table in tables]
        for k in longer:
            requests[k] = requests[k]._replace(high=requests[k].high + extents[k])
            extents[k] *= 2.0
        for k, table in zip(longer, solved([requests[k] for k in longer]), strict=True):
            tables[k] = table


def solved(requests: Sequence[_Request]) -> list[_Solved]:
    """Return the tables of requests, kept or new; identical bearings are solved in batches."""
    tables = {
        request: table for request in requests if (table := _kept.pop(request, None)) is not None
    }
    groups: dict[tuple[BallBearing, Law], list[_Request]] = {}
    for request in dict.fromkeys(requests):
        if request not in tables:
            groups.setdefault((request.model, request.law), []).append(request)
    for group in groups.values():
        for start in range(0, len(group), TOGETHER):
            part = group[start : start + TOGETHER]
            tables |= zip(part, _solve(part), strict=True)
    _kept.update(tables)
    for oldest in list(_kept)[:-TABLES]:
        _kept.pop(oldest, None)
    return [tables[request] for request in requests]


def _solve(requests: Sequence[_Request]) -> list[_Solved]:
    """Solve the tables of one bearing model under one law."""
    from bearings.ring.tangents import stiffness

    model, law = requests[0].model, requests[0].law
    points = [np.empty((3, 0)) for _ in requests]  # deflection, load, slope
    pending = [_first_points(request) for request in requests]
    for _ in range(ROUNDS):
        sizes = [len(deflections) for deflections in pending]
        if not sum(sizes):
            break
        static, growth, speed = (
            np.repeat(values, sizes)
            for values in zip(*((*r.growth, r.speed) for r in requests), strict=True)
        )
        displacement = np.zeros((sum(sizes), 5))
        displacement[:, 0] = np.concatenate(pending)
        state = model.equilibrium(
            displacement=displacement,
            speed=speed,
            static_growth=static,
            growth=growth,
            **asdict(law),
        )
        slope = stiffness(state, "complete")[:, 0, 0]
        new = np.stack([displacement[:, 0], state.load[:, 0], slope])
        for k, added in enumerate(np.split(new, np.cumsum(sizes)[:-1], axis=1)):
            if not added.size:
                continue
            points[k] = np.concatenate([points[k], added], axis=1)
            points[k] = points[k][:, np.argsort(points[k][0])]
            valid = np.asarray(np.isfinite(points[k]).all(axis=0))
            if valid.sum() < 2:
                which = "a bearing of the spindle"
                raise without_state(which, requests[k].speed, requests[k].growth[1])
            pending[k] = missed(*points[k][:, valid])
    return [_table(model, table) for table in points]


def _first_points(request: _Request) -> Array:
    """Return initial deflections [m] of a table, ascending: uniform, finer at the onset of load."""
    model, high = request.model, request.high
    distance = model.free_distance
    low = high / distance if model.both_ways else REACH
    uniform = np.arange(-round(low / SPACING), round(high / distance / SPACING) + 1) * SPACING
    finer = np.concatenate([-FINER, [0.0], FINER]) + begins(model, *request.growth) / distance
    d = np.concatenate([uniform, finer, -finer if model.both_ways else []])
    lowest = max(uniform[0], float(turns(model, request.growth[0])) / distance)
    d = np.unique(d.clip(lowest, uniform[-1]))
    return np.asarray(d[np.diff(d, prepend=-np.inf) > CLOSE] * distance)


def _table(model: BallBearing, points: Array) -> _Solved:
    """Return the table through ``points`` (3, n): deflection, load, slope; NaN without a state."""
    valid = np.asarray(np.isfinite(points).all(axis=0))
    if not model.both_ways:
        points[1] = np.maximum(points[1], 0.0)  # rounding must not make a bearing pull
    law = sloped_table(*points[:, valid].tolist())
    return _Solved(law, float(points[1, valid][-1]), bool(valid[-1]))


def deflection_of(law: AxialLaw, model: BallBearing, load: float, near: float) -> float:
    """Return the deflection [m] at which the table has a ``load`` [N], near that of the bearing,
    ``near``: with the bearing's own deflection the preloads of the tables would not balance."""
    if law(near)[0] == load:
        return near
    far = NEAR * model.free_distance
    return float(brentq(lambda d: law(d)[0] - load, near - far, near + far, xtol=1e-18))
