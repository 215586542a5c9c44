"""Stability limits of a model refined until it has all modes at which the cut may chatter.

A slender tool has modes at several times the frequencies that other analyses ask for. A model that
lacks them gives limits that are far too high, most of all between the lobes of the modes it has.
Therefore limits at some speeds are computed once more with a finer model and twice the frequency
range; while they change, all limits are computed with that model. Between modes that are far apart
doubling changes nothing: at the fastest speed and that of the deepest cut (of few speeds, at all
that are checked) limits are computed with the finest model too, which need not go beyond
``HIGHEST``: receptances are not sampled there either. Other analyses only report their errors; this
one runs its checks for every machine of a study: a limit that lacks a mode is no approximation.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.sampling import HIGHEST
from rotordyn.arrays import Indices
from rotordyn.errors import InvalidInput
from rotordyn.scene.scene import Scene

Rows = Indices
ALLOWED = 0.05  # largest change of a limit by a finer model, over the limit
DOUBLINGS = 4  # of the highest frequency
LOOKED_AT = 4  # speeds checked besides that of the deepest cut; of many, in the quicker upper half


class Converged(NamedTuple):
    """Refined ``scene``, its ``limits``, those of every operation (``depths``), and the ``error``:
    largest change of a depth by a finer model, over the smaller depth."""

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
    """Return limits at every usable speed above 0, refined until they change little and no chatter
    is above the highest modes, ``modelled`` [Hz]; ``limits_of``: limits at rows of a scene."""
    best, finer = _unchecked(scene, limits_of, operations), _Finer(limits_of, operations)
    for doubling in range(DOUBLINGS + 1):
        rows = np.flatnonzero(scene.speed[scene.usable] > 0.0)
        to_highest = math.log2(HIGHEST / (2.0 * math.pi * modelled(scene)))
        remaining = max(min(DOUBLINGS - doubling, math.ceil(to_highest)), 1)
        error = _change(scene, remaining, finer, rows, best.depths)
        best, limits = best._replace(error=error), [o for depths in best.depths for o in depths]
        chatter = max((o.frequency for o in limits if math.isfinite(o.depth)), default=0.0)
        if (error <= ALLOWED and chatter <= modelled(scene)) or doubling == DOUBLINGS:
            break
        scene = scene.refined
        try:
            best = _unchecked(scene, limits_of, operations)
        except InvalidInput:  # as in ``_Finer.depth``, at slow speeds: keep the last limits
            break
    scene.checks.add(best.error / ALLOWED)
    return best


def _unchecked(
    scene: Scene, limits_of: Callable[[Scene, Rows], Limits], operations: Sequence[Operation]
) -> Converged:
    """Return limits by one model; their error is NaN."""
    limits = limits_of(scene, np.flatnonzero(scene.speed[scene.usable] > 0.0))
    return Converged(scene, limits, [limits.of(operation) for operation in operations], np.nan)


@dataclass(frozen=True)
class _Finer:
    """Depths [m] at single speeds by finer models; each model and each depth is solved once."""

    limits_of: Callable[[Scene, Rows], Limits]
    operations: Sequence[Operation]
    models: dict[tuple[float, int], Limits] = field(default_factory=dict)
    depths: dict[tuple[int, float, int], float] = field(default_factory=dict)

    def depth(self, scene: Scene, row: int, doublings: int, number: int) -> float:
        """Return the limit [m] of operation ``number`` at a usable speed by a model ``doublings``
        finer; NaN where the speed is too low to resolve waves of its frequencies."""
        speed = float(scene.speed[scene.usable[row]])
        model = speed, scene.finer + doublings
        if model not in self.models:
            refined = scene.at(np.array([speed]))
            for _ in range(doublings):
                refined = refined.refined
            self.models[model] = self.limits_of(refined, np.zeros(1, dtype=np.intp))
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
    all_limits: Sequence[Sequence[Limit]],
) -> float:
    """Return the largest relative change of a limit by a model that is one doubling, or
    ``doublings``, finer."""
    worst = 0.0
    for number, limits in enumerate(all_limits):
        depth = np.array([limit.depth for limit in limits])
        is_long, last = len(rows) > 2 * LOOKED_AT, len(rows) - 1
        first = len(rows) // 2 if is_long else 0
        spread = np.linspace(first, last, LOOKED_AT).round().astype(np.intp)
        deepest = first + depth[first:].argmax()
        by_one = {(int(k), 1) for k in (*spread, deepest)}
        by_finest = {(int(k), doublings) for k in (deepest, *([last] if is_long else spread))}
        for k, count in sorted(by_one | by_finest):
            finer_depth = finer.depth(scene, int(rows[k]), count, number)
            if not math.isnan(finer_depth):
                worst = max(worst, _difference(finer_depth, limits[k].depth))
    return worst


def _difference(depth: float, other_depth: float) -> float:
    """Return the difference over the smaller depth; 0 if both are infinite, or both 0."""
    small, large = sorted((depth, other_depth))
    if small == large:
        return 0.0
    return large / small - 1.0 if small > 0.0 else math.inf
