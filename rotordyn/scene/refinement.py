"""Error by refinement: the model is solved once more, finer, at a few speeds.

Finer is one degree more in every element (half the length of standard ones) and a cut-off of the
reduction ``fineness.FINER`` times as high. The change is reported as the error of frequencies,
receptances and orbits. Where it is more than the accuracy asked for, the finer model takes
the place of the first one, ``ROUNDS`` times at most. Responses may err by ``RESPONSES`` times as
much of their peak: an error δ of a frequency moves the flank of a peak of damping ratio ζ by δ/2ζ
of its height.

Theory: docs/theory/refinement.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.scene.scene import Scene

T = TypeVar("T")
ROUNDS = 2
SENSITIVE, CLOSER = 3, 0.7  # speeds at which excitations are closest to poles, so many times
AT_REST = 1e-6  # of the largest motion: a point that moves less stands still, but for rounding
RESPONSES = 10.0  # error of a response over its peak, to that of frequencies: it may be as large


def few_rows(scene: Scene) -> Indices:
    """Return rows of the first and last usable speed, where effects of speed are least and largest,
    and of those nearest to the extremes of tables over speed."""
    speed, extremes = scene.speed[scene.usable], []
    for support in scene.spindle.supports:
        for value in (*support.stiffness.values(), *support.damping.values()):
            if isinstance(value, tuple):
                extremes += [support.speeds[k] for k in (np.argmax(value), np.argmin(value))]
    nearest = (int(np.abs(speed - at).argmin()) for at in dict.fromkeys(extremes))
    return np.unique([0, len(speed) - 1, *nearest])


def sensitive_rows(scene: Scene, distance: Array) -> Indices:
    """Return ``few_rows``, and rows at which excitations are much closer to a pole than there.

    A small error of a pole changes responses most there. ``distance`` (usable, k) from the poles,
    over these.
    """
    rows = few_rows(scene)
    closer = distance < CLOSER * distance[rows].min(axis=0)
    least = np.where(closer, distance, np.inf).min(axis=1, initial=np.inf)
    closest = np.argsort(least, kind="stable")[:SENSITIVE]
    return np.union1d(rows, closest[np.isfinite(least[closest])])


def response_accuracy(scene: Scene) -> float:
    """Return the allowed error of a response over its peak; infinite for given element lengths."""
    if scene.conditions.element_length is not None:
        return math.inf
    return RESPONSES * scene.conditions.accuracy


def solve_accurately(
    scene: Scene, solve: Callable[[Scene], T], error: Callable[[T], float]
) -> tuple[Scene, T]:
    """Refine the model until the ``error`` of its solution is within the accuracy, ``ROUNDS`` times
    at most.

    Returns the model with its solution; ``scene`` itself where ``scene.checks`` are not wanted.
    """
    if not scene.checks.wanted:
        return scene, solve(scene)
    allowed, checks = response_accuracy(scene), scene.checks
    for number in range(ROUNDS):
        solution = solve(scene)
        estimated_error = error(solution)
        if not number:
            checks.first = max(checks.first, estimated_error / allowed)
        if estimated_error <= allowed:
            break
        scene = scene.refined
    else:
        solution = solve(scene)
    checks.add(estimated_error / allowed)
    return scene, solution


def changes(
    scene: Scene,
    values: Callable[[Scene, Indices], Array | Complex],
    axis: int,
    least: float = 0.0,
    rows: Indices | None = None,
) -> Array:
    """Return the largest change of values (few, …, n, …) by the finer model, over their largest
    size, along all axes but ``axis``; ``rows``: speeds at which they are compared, by default few.
    """
    rows = few_rows(scene) if rows is None else rows
    return relative_change(values(scene, rows), values(scene.refined, rows), axis, least)


def relative_change(
    coarse: Array | Complex, fine: Array | Complex, axis: int, least: float = 0.0
) -> Array:
    """Return the largest change of values (…, n, …) over their largest size, along all axes but
    ``axis``. For values of one kind, such as motions of points, that size is at least ``least``
    times the largest of all: what symmetry or a rigid support holds moves by rounding.
    """
    along = tuple(k for k in range(coarse.ndim) if k != axis)
    size = np.abs(fine).max(axis=along, initial=0.0)
    if least:
        size = np.maximum(size, least * size.max(initial=0.0))
    with np.errstate(invalid="ignore"):  # responses without limit
        change = np.abs(fine - coarse).max(axis=along, initial=0.0)
        return np.where(size > 0.0, change / np.where(size > 0.0, size, 1.0), 0.0)
