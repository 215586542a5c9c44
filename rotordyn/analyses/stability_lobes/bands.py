"""Band of the limits over intervals of stiffness, damping and cutting coefficients."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.allowance import require_time
from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.modal import Change
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import Interval
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.arrays import Array, Indices

Rows = Indices
LEAST, MOST = 2, 64  # parts of half the interval of stiffness
PER_LOBE = 16.0  # parts of the whole interval for every lobe that passes
PER_PEAK = 0.5  # parts of half the interval, by its share over the damping ratio of a peak
HALVINGS = 3  # of a step next to the least limit


def band(
    limits: Limits,
    operations: Sequence[Operation],
    known: Sequence[Sequence[Limit]],
    interval: Interval,
) -> tuple[Array, Array]:
    """Return least and largest limit (s,) [m] over all operations and changes in the interval.

    ``known``: limits of every operation without any change. Where lobes are close, at low speeds, a
    change of stiffness moves several past a speed: its steps are short against the lobes.
    """
    share_of = interval.coefficients
    if share_of and not all(operation.divides for operation in operations):
        factors = 1.0 - share_of, 1.0 + share_of
        scaled = [operation.times(factor) for factor in factors for operation in operations]
        known = [*known, *(limits.of(operation) for operation in scaled)]
        operations, share_of = [*operations, *scaled], 0.0
    nominal = np.array([[limit.depth for limit in values] for values in known])
    least, most = nominal.min(axis=0), nominal.max(axis=0)

    def solve(rows: Rows, share: Array, ratio: float) -> Array:
        """Return the least limits at some speeds, each at a ``share`` of the stiffness interval."""
        require_time("stability_lobes: the band", "broken off")
        change = Change(1.0 + share * interval.stiffness, np.full(len(rows), ratio))
        part = limits.changed(rows, change)
        depth = np.array([[one.depth for one in part.of(operation)] for operation in operations])
        least[rows] = np.minimum(least[rows], depth.min(axis=0))
        most[rows] = np.maximum(most[rows], depth.max(axis=0))
        return np.asarray(depth.min(axis=0))

    parts = _halves(limits, operations, known, interval.stiffness)
    ratios = sorted({1.0 - interval.damping, 1.0 + interval.damping})
    for ratio in ratios if interval.stiffness or interval.damping else ():
        lowest, best = np.full(len(parts), np.inf), np.zeros(len(parts))
        for steps in _steps(interval.stiffness, int(parts.max(initial=0))):
            rows = np.flatnonzero(parts >= steps.of)
            for share in steps.shares:
                _keep(lowest, best, rows, np.full(len(rows), share), partial(solve, ratio=ratio))
        if ratio == ratios[0] and interval.stiffness:  # least damping, lowest limits
            all_rows = np.arange(len(parts))
            for halving in range(1, HALVINGS + 1):
                for side in (-1.0, 1.0):
                    offset = np.clip(best + side / parts / 2.0**halving, -1.0, 1.0)
                    _keep(lowest, best, all_rows, offset, partial(solve, ratio=ratio))
    return least / (1.0 + share_of), most / (1.0 - share_of)


def _keep(
    lowest: Array, place: Array, rows: Rows, share: Array, solve: Callable[[Rows, Array], Array]
) -> None:
    """Solve at shares of the interval; keep the lowest limit of each speed and its ``place``."""
    depth = solve(rows, share)
    better = depth < lowest[rows]
    lowest[rows], place[rows] = (
        np.where(better, new, old[rows]) for new, old in ((depth, lowest), (share, place))
    )


class _Steps(NamedTuple):
    """``shares`` of the interval of stiffness, −1 … 1, needed at speeds where its half is divided
    into ``of`` parts or more."""

    of: int
    shares: list[float]


def _steps(stiffness: float, most: int) -> Iterator[_Steps]:
    """Yield successively finer steps, no share twice."""
    if stiffness == 0.0:
        yield _Steps(0, [0.0])
        return
    parts = LEAST
    yield _Steps(0, [k / parts for k in range(-parts, parts + 1)])
    while parts < most:
        parts *= 2
        yield _Steps(parts, [k / parts for k in range(1 - parts, parts, 2)])


def _halves(
    limits: Limits,
    operations: Sequence[Operation],
    known: Sequence[Sequence[Limit]],
    stiffness: float,
) -> NDArray[np.int_]:
    """Return the number of parts (s,), a power of two, of half the interval at each speed: short
    against the lobes, and against the peaks of the receptance."""
    passing = np.zeros(len(limits.rows))
    for operation, values in zip(operations, known, strict=True):
        frequency = np.array([limit.frequency for limit in values])
        frequency = np.where(np.isnan(frequency), np.nanmax(frequency, initial=0.0), frequency)
        passing = np.maximum(passing, frequency * operation.delays(limits.speed).max(axis=1))
    passing = passing * (math.sqrt(1.0 + stiffness) - math.sqrt(1.0 - stiffness))
    assert isinstance(limits.tip, Tip)
    narrow = PER_PEAK * stiffness / np.abs(limits.tip.least_damped[limits.rows])
    parts = np.clip(np.maximum(0.5 * PER_LOBE * passing, narrow), LEAST, MOST)
    return np.asarray(2 ** np.ceil(np.log2(parts)), dtype=int)
