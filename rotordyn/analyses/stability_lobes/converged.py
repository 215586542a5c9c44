"""Limits of a model that knows all modes by which the cut may chatter.

A slender tool has modes at several times the frequencies that other analyses ask for. A model that
lacks them gives limits that are far too high, most of all between the lobes of the modes it has.
So limits at some speeds are computed once more with a finer model and twice the frequencies; while
they change, all are computed with that one. Between modes that are far apart doubling changes
nothing: at the fastest speed and that of the deepest cut, of few speeds at all that are looked at,
they are computed with the finest model too, which need not go beyond ``HIGHEST``: receptances are
not looked at there either. Unlike other analyses, whose errors are but told, lobes ask for these
checks of every machine of a study: a limit that lacks a mode is no approximation.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.sampling import HIGHEST
from rotordyn.errors import InvalidInput
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
Rows = NDArray[np.intp]
ALLOWED = 0.05  # of a limit, that it may change
DOUBLINGS = 4  # of the highest frequency
LOOKED_AT = 4  # speeds, beside that of the deepest cut; of many the faster half, which takes less


class Converged(NamedTuple):
    """The ``scene`` that is fine enough, its ``limits`` with ``depths`` of every operation, and the
    ``error``: the largest change of a depth over it by a finer model."""

    scene: Scene
    limits: Limits
    depths: list[list[Limit]]
    error: float


def converged(
    scene: Scene,
    modelled: Callable[[Scene], float],
    limits_of: Callable[[Scene, Rows], Limits],
    operations: Sequence[Operation],
) -> Converged:
    """At every usable speed above 0; ``limits_of`` some rows of a scene, in which modes up to the
    frequency ``modelled`` [Hz] take part, and no chatter is above it."""
    best, finer = _at(scene, limits_of, operations), _Finer(limits_of, operations)
    for doubling in range(DOUBLINGS + 1):
        rows = np.flatnonzero(scene.speed[scene.usable] > 0.0)
        room = math.log2(HIGHEST / (2.0 * math.pi * modelled(scene)))
        left = max(min(DOUBLINGS - doubling, math.ceil(room)), 1)
        error = _change(scene, left, finer, rows, best.depths)
        best, every = best._replace(error=error), [one for each in best.depths for one in each]
        chatter = max((one.frequency for one in every if math.isfinite(one.depth)), default=0.0)
        if (error <= ALLOWED and chatter <= modelled(scene)) or doubling == DOUBLINGS:
            break
        scene = scene.refined
        try:
            best = _at(scene, limits_of, operations)
        except InvalidInput:  # as in ``_Finer.depth``, at slow speeds: what there is and its error
            break
    scene.checks.worst = max(scene.checks.worst, best.error / ALLOWED)
    return best


def _at(
    scene: Scene, limits_of: Callable[[Scene, Rows], Limits], operations: Sequence[Operation]
) -> Converged:
    """Limits of a model, their error not known."""
    limits = limits_of(scene, np.flatnonzero(scene.speed[scene.usable] > 0.0))
    return Converged(scene, limits, [limits.of(each) for each in operations], np.nan)


@dataclass(frozen=True)
class _Finer:
    """Depths at single speeds by finer models, each model and each depth solved once."""

    limits_of: Callable[[Scene, Rows], Limits]
    operations: Sequence[Operation]
    models: dict[tuple[float, int], Limits] = field(default_factory=dict)
    depths: dict[tuple[int, float, int], float] = field(default_factory=dict)

    def depth(self, scene: Scene, row: int, doublings: int, number: int) -> float:
        """Of the operation of this number at a usable speed; NaN where that turns too slowly for
        waves of such frequencies."""
        speed = float(scene.speed[scene.usable[row]])
        model = speed, scene.finer + doublings
        if model not in self.models:
            one = scene.at(np.array([speed]))
            for _ in range(doublings):
                one = one.refined
            self.models[model] = self.limits_of(one, np.zeros(1, dtype=np.intp))
        key = number, *model
        if key not in self.depths:
            try:
                (limit,) = self.models[model].of(self.operations[number])
                self.depths[key] = limit.depth
            except InvalidInput:
                self.depths[key] = math.nan
        return self.depths[key]


def _change(
    scene: Scene,
    doublings: int,
    finer: _Finer,
    rows: Rows,
    found: Sequence[Sequence[Limit]],
) -> float:
    """Largest change of a limit by the finer model, or by one ``doublings`` finer, over the smaller
    of both."""
    worst = 0.0
    for number, known in enumerate(found):
        depth = np.array([limit.depth for limit in known])
        many, last = len(rows) > 2 * LOOKED_AT, len(rows) - 1
        first = len(rows) // 2 if many else 0
        spread = np.linspace(first, last, LOOKED_AT).round().astype(np.intp)
        deepest = first + depth[first:].argmax()
        once = {(int(k), 1) for k in (*spread, deepest)}
        far = {(int(k), doublings) for k in (deepest, *([last] if many else spread))}
        for k, times in sorted(once | far):
            other = finer.depth(scene, int(rows[k]), times, number)
            if not math.isnan(other):
                worst = max(worst, _apart(other, known[k].depth))
    return worst


def _apart(one: float, other: float) -> float:
    """Difference over the smaller depth; none if both are infinite, or both 0."""
    small, large = sorted((one, other))
    if small == large:
        return 0.0
    return large / small - 1.0 if small > 0.0 else math.inf
