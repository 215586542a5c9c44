"""The band of the limits, from intervals of stiffness, damping and cutting coefficients."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.modal import UNCHANGED, Change
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import Interval

Array = NDArray[np.float64]
LEAST, MOST = 2, 64  # halves of steps over the interval of stiffness, at most
PER_LOBE = 16.0  # of these as lobes pass: there the least limit is found within 2 %


def band(
    limits: Limits,
    operations: Sequence[Operation],
    known: Sequence[Sequence[Limit]],
    interval: Interval,
) -> tuple[Array, Array]:
    """Least and largest limit (s,) [m] over all operations and changes within the interval.

    ``known``: limits of every operation without any change. Where lobes are close, at low speeds, a
    change of stiffness moves several past a speed: it is looked at in steps short beside them.
    """
    share = interval.coefficients
    if share and not all(each.divides for each in operations):
        factors = 1.0 - share, 1.0 + share
        scaled = [each.times(factor) for factor in factors for each in operations]
        known = [*known, *(limits.of(each) for each in scaled)]
        operations, share = [*operations, *scaled], 0.0
    nominal = np.array([[limit.depth for limit in each] for each in known])
    least, most = nominal.min(axis=0), nominal.max(axis=0)
    for operation, own in zip(operations, known, strict=True):
        wanted = _halves(limits, operation, own, interval.stiffness)
        for steps in _steps(interval.stiffness, int(wanted.max(initial=0))):
            rows = np.flatnonzero(wanted >= steps.of)
            part = replace(limits, rows=limits.rows[rows], speed=limits.speed[rows])
            for change in _changes(steps.shares, interval):
                depth = np.array([limit.depth for limit in part.of(operation, change)])
                least[rows] = np.minimum(least[rows], depth)
                most[rows] = np.maximum(most[rows], depth)
    return least / (1.0 + share), most / (1.0 - share)


class _Steps(NamedTuple):
    """``shares`` of the interval of stiffness, −1 … 1, that are wanted where its half is cut into
    as many parts as ``of`` or more."""

    of: int
    shares: list[float]


def _steps(stiffness: float, most: int) -> Iterator[_Steps]:
    """Ever finer ones, none twice."""
    if stiffness == 0.0:
        yield _Steps(0, [0.0])
        return
    parts = LEAST
    yield _Steps(0, [k / parts for k in range(-parts, parts + 1)])
    while parts < most:
        parts *= 2
        yield _Steps(parts, [k / parts for k in range(1 - parts, parts, 2)])


def _halves(
    limits: Limits, operation: Operation, known: Sequence[Limit], stiffness: float
) -> NDArray[np.int_]:
    """Parts (s,), a power of two, into which half of the interval is cut at each speed."""
    frequency = np.array([limit.frequency for limit in known])
    highest = np.nanmax(frequency, initial=0.0)
    waves = np.where(np.isnan(frequency), highest, frequency)
    waves = waves * operation.delays(limits.speed).max(axis=1)
    passing = waves * (math.sqrt(1.0 + stiffness) - math.sqrt(1.0 - stiffness))
    parts = np.clip(0.5 * PER_LOBE * passing, LEAST, MOST)
    return np.asarray(2 ** np.ceil(np.log2(parts)), dtype=int)


def _changes(shares: Sequence[float], interval: Interval) -> Iterator[Change]:
    damping = {1.0 + step * interval.damping: None for step in (-1.0, 1.0)}
    for share, ratio in product(shares, damping):
        change = Change(1.0 + share * interval.stiffness, ratio)
        if change != UNCHANGED:
            yield change
