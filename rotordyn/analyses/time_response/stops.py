"""End stops of sleeves that close and open: springs that push and never pull.

Sleeves that dry friction holds do not reach theirs.
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
    """Stops at some speeds (s,): springs of a ``stiffness`` [N/m] that push sleeves along the axis
    in a ``direction`` (sleeves,), ±1.

    ``gap`` (s, sleeves) [m]: in the preload state, negative where its force presses the stop
    together; infinite of sleeves that have none or do not slide.
    """

    stiffness: float
    direction: Array
    gap: Array

    @classmethod
    def of(cls, scene: Scene, stiffness: float | None, rows: Indices | None = None) -> Stops:
        """Of a scene at all usable speeds, or at some ``rows`` of them; without a stiffness none
        closes or opens."""
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
        """Those that are closed in the preload state (s, sleeves)."""
        return np.asarray(self.gap <= 0.0)

    def forces(self, moved: Array) -> tuple[Array, Array]:
        """Of the sleeves whose stops ``act``, displaced along the axis by ``moved`` (s, t, k) [m]:
        what resists, less the force in the preload state and that of a spring in the place of a
        closed stop; and its slope."""
        gap, way, closed = (each[..., self.act] for each in (self.gap, self.direction, self.closed))
        gap, closed = gap[:, None], closed[:, None]
        now = np.minimum(gap + way * moved, 0.0)
        force = self.stiffness * (way * (now - np.minimum(gap, 0.0)) - closed * moved)
        return force, np.asarray(self.stiffness * ((now < 0.0) - 1.0 * closed))
