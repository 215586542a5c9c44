"""The compiled door: many states, one after the other; in a chain each may start from the last.

Compiled at its first call, kept on disk for the next process (``bearings.ring.compiled.jit``).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import LawNumbers
from bearings.geometry import Geometry
from bearings.ring.compiled.follow import find
from bearings.ring.compiled.one_state import One, Work, room

Array = NDArray[np.float64]
NEAR = 0.2  # relative change of speed and load from the last state that makes it a start


def find_all(  # noqa: PLR0913 - compiled functions take plain numbers and arrays
    geometry: Geometry,
    law: LawNumbers,
    azimuth: Array,
    scale: Array,
    free: NDArray[np.intp],
    turning: bool,
    one_branch: bool,
    placed: bool,
    full: float,
    given: tuple[Array, Array, Array],
    answer: tuple[Array, Array, Array, Array, NDArray[np.bool_]],
    near: NDArray[np.bool_],
    chained: bool,
) -> None:
    """States of ``given`` = (A₀ (s, 2), speed (s,), load (s, 5)).

    Written into ``answer`` = (d (s, 5), X (s, n, 2), load (s, 5), K (s, 5, 5), found (s,)), where d
    and, if ``near`` (s,), X are the starts. ``chained``: a state starts from the one before where
    load, displacement and speed are close; otherwise every state is found on its own.
    """
    origin, speed, load = given
    d, x, carried, stiffness, found = answer
    w = room(x.shape[1])
    for k in range(len(speed)):
        squared = speed[k] ** 2 if turning else 0.0
        push = geometry.orbit * geometry.nominal * squared
        p = One(
            geometry,
            law,
            azimuth,
            scale,
            free,
            turning,
            one_branch,
            placed,
            full,
            origin[k],
            squared,
            push,
            load[k],
        )
        start = near[k]
        if chained and not start and k and found[k - 1] and _near(p, speed, load, d, k):
            start = True
            _begin(d, x, free, k)
        found[k] = find(p, d[k], x[k], start, w)
        _keep(w, carried[k], stiffness[k])


def _near(p: One, speed: Array, load: Array, d: Array, k: int) -> bool:
    """Whether the last state is close enough to start from."""
    if abs(speed[k] - speed[k - 1]) > NEAR * speed[k]:
        return False
    size, change = 0.0, 0.0
    for j in range(5):
        size = max(size, abs(load[k, j] / p.scale[j]))
        change = max(change, abs(load[k, j] - load[k - 1, j]) / p.scale[j])
    reach = p.geometry.inner_reach + p.geometry.outer_reach
    for j in range(5):
        given = True
        for place in p.free:
            given = given and place != j
        if given and abs(d[k, j] - d[k - 1, j]) * p.scale[j] > 0.01 * NEAR * reach:
            return False
    return change <= NEAR * size


def _begin(d: Array, x: Array, free: NDArray[np.intp], k: int) -> None:
    """The last state as a start."""
    for j in free:
        d[k, j] = d[k - 1, j]
    for ball in range(x.shape[1]):
        x[k, ball, 0], x[k, ball, 1] = x[k - 1, ball, 0], x[k - 1, ball, 1]


def _keep(w: Work, carried: Array, stiffness: Array) -> None:
    for i in range(5):
        carried[i] = w.action[i]
        for j in range(5):
            stiffness[i, j] = w.stiffness[i, j]
