"""The band of the limits, from intervals of stiffness, damping and cutting coefficients."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.modal import UNCHANGED, Change
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import Interval

Array = NDArray[np.float64]
STEPS = (-1.0, -0.5, 0.0, 0.5, 1.0)  # of the interval of stiffness, over which lobes wander


def band(
    limits: Limits,
    operations: Sequence[Operation],
    known: Sequence[Sequence[Limit]],
    interval: Interval,
) -> tuple[Array, Array]:
    """Least and largest limit (s,) [m] over all operations and changes within the interval.

    ``known``: limits of every operation without any change.
    """
    found = [np.array([limit.depth for limit in each]) for each in known]
    for operation in operations:
        for change in _changes(interval):
            if change != UNCHANGED:
                found.append(np.array([own.depth for own in limits.of(operation, change)]))
    every = np.array(found)
    share = interval.coefficients
    return every.min(axis=0) / (1.0 + share), every.max(axis=0) / (1.0 - share)


def _changes(interval: Interval) -> Iterator[Change]:
    stiffness = {1.0 + step * interval.stiffness: None for step in STEPS}
    damping = {1.0 + step * interval.damping: None for step in (-1.0, 1.0)}
    for one, other in product(stiffness, damping):
        yield Change(one, other)
