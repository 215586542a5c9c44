"""End stops of sleeves that close and open: springs that push and never pull.

Sleeves held by dry friction do not reach their stops.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.preload.arrangement import SHAFT
from rotordyn.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Stops:
    """End stops at some speeds (s,): springs of a ``stiffness`` [N/m] that push sleeves along the
    axis in a ``direction`` (sleeves,), ±1.

    ``gap`` (s, sleeves) [m]: in the preload state, negative where its force compresses the stop;
    infinite for sleeves that have no stop or do not slide.
    """

    stiffness: float
    direction: Array
    gap: Array

    @classmethod
    def of(cls, scene: Scene, stiffness: float | None, rows: Indices | None = None) -> Stops:
        """Return the stops of a scene at all usable speeds, or at some ``rows`` of them; without a
        stiffness none closes or opens."""
        sleeves = scene.spindle.sleeves
        speeds = len(scene.usable) if rows is None else len(rows)
        none = cls(0.0, np.ones(len(sleeves)), np.full((speeds, len(sleeves)), math.inf))
        if stiffness is None or not sleeves or not scene.spindle.seats:
            return none
        state, chosen = scene.preload, scene.bearing_row[scene.usable]
        chosen = chosen if rows is None else chosen[rows]
        pressed = -state.stop_force[chosen] / stiffness
        gap = np.where(state.stopped[chosen], pressed, state.stop_gaps()[chosen])
        slides = np.isfinite(state.limit[SHAFT + 1 :]) & (state.rubs[SHAFT + 1 :] == 0.0)
        direction = state.network.arrangement.direction[SHAFT + 1 :]
        return cls(stiffness, direction, np.where(slides, gap, math.inf))

    @property
    def act(self) -> Flags:
        """Sleeves whose stops close and open (sleeves,)."""
        return np.asarray(np.isfinite(self.gap).all(axis=0))

    @property
    def closed(self) -> Flags:
        """Stops that are closed in the preload state (s, sleeves)."""
        return np.asarray(self.gap <= 0.0)

    def forces(self, moved: Array) -> tuple[Array, Array]:
        """Return forces on the sleeves whose stops ``act``, displaced along the axis by ``moved``
        (s, t, k) [m], minus those in the preload state and of a linear spring in place of a closed
        stop; and their slopes."""
        gap, sign, closed = (x[..., self.act] for x in (self.gap, self.direction, self.closed))
        gap, closed = gap[:, None], closed[:, None]
        compression = np.minimum(gap + sign * moved, 0.0)
        force = self.stiffness * (sign * (compression - np.minimum(gap, 0.0)) - closed * moved)
        return force, np.asarray(self.stiffness * ((compression < 0.0) - 1.0 * closed))
