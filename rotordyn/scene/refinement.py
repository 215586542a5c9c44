"""Error by refinement: the model is solved once more, finer, at the first and the last speed.

Finer is one degree more in every element (half the length of standard ones) and a cut-off of the
reduction ``fineness.FINER`` times as high. The change is reported as the error, of frequencies,
receptances and orbits alike. Where it is more than the accuracy asked for, the finer model takes
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
AT_REST = 1e-6  # of the largest motion: a point that moves less stands still, but for rounding
RESPONSES = 10.0  # error of a response over its peak, to that of frequencies: it may be as large


def few_rows(scene: Scene) -> Indices:
    """First and last of the usable speeds: what grows with the speed is least and largest there."""
    return np.unique([0, len(scene.usable) - 1])


def response_accuracy(scene: Scene) -> float:
    """Error over its peak that a response may have; infinite where elements are given."""
    if scene.conditions.element_length is not None:
        return math.inf
    return RESPONSES * scene.conditions.accuracy


def solve_accurately(
    scene: Scene, solve: Callable[[Scene], T], error: Callable[[T], float]
) -> tuple[Scene, T]:
    """The first of ever finer models whose ``error`` is below the accuracy asked for, or the last
    one, and what ``solve`` gives of it; the model as it is where no ``scene.checks`` are wanted."""
    if not scene.checks.wanted:
        return scene, solve(scene)
    allowed, checks = response_accuracy(scene), scene.checks
    for number in range(ROUNDS):
        solution = solve(scene)
        found = error(solution)
        if not number:
            checks.first = max(checks.first, found / allowed)
        if found <= allowed:
            break
        scene = scene.refined
    else:
        solution = solve(scene)
    checks.worst = max(checks.worst, found / allowed)
    return scene, solution


def changes(
    scene: Scene,
    values: Callable[[Scene, Indices], Array | Complex],
    axis: int,
    least: float = 0.0,
) -> Array:
    """Largest change of values (few, …, n, …) by the finer model, over their largest size; along
    all axes but ``axis``."""
    rows = few_rows(scene)
    return relative_change(values(scene, rows), values(scene.refined, rows), axis, least)


def relative_change(
    coarse: Array | Complex, fine: Array | Complex, axis: int, least: float = 0.0
) -> Array:
    """Largest change of values (…, n, …) over their largest size; along all axes but ``axis``.

    Of values that are alike in kind, such as motions of points, those smaller than ``least`` of the
    largest of all count as that large: what symmetry or a rigid support holds moves by rounding.
    """
    along = tuple(k for k in range(coarse.ndim) if k != axis)
    size = np.abs(fine).max(axis=along, initial=0.0)
    if least:
        size = np.maximum(size, least * size.max(initial=0.0))
    with np.errstate(invalid="ignore"):  # responses without limit
        change = np.abs(fine - coarse).max(axis=along, initial=0.0)
        return np.where(size > 0.0, change / np.where(size > 0.0, size, 1.0), 0.0)
