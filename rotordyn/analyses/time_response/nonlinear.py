"""Nonlinear forces of the equation: loads of bearings and forces of end stops."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.time_response.bearings import Bearings
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.stops import Stops
from rotordyn.arrays import Array, Flags
from rotordyn.scene.scene import Scene


class Evaluation(NamedTuple):
    """Nonlinear forces (s, 2, r), their slopes (s, 2, r, r), speeds at which every bearing has a
    state (s,), and bearings and stops at the present displacements."""

    force: Array
    slope: Array
    exists: Flags
    where: Nonlinear


@dataclass(frozen=True, eq=False, slots=True)
class Nonlinear:
    """Nonlinear forces on r displacements: five of the rings of every bearing, then one of every
    sleeve whose stop closes and opens."""

    bearings: Bearings
    stops: Stops

    @classmethod
    def of(cls, scene: Scene, equation: Equation) -> Nonlinear:
        """Return the nonlinear forces of a scene with bearings, about its preload state."""
        return cls(Bearings.of(scene), equation.stops)

    @property
    def lever(self) -> Array:
        """Factors from the displacements to lengths (r,)."""
        return np.append(self.bearings.lever, np.ones(self.stops.act.sum()))

    def rows(self, equation: Equation) -> Array:
        """Return rows of the displacements by the coordinates (r, n)."""
        return np.concatenate([equation.rings, equation.sleeves[self.stops.act]])

    def at(self, moved: Array) -> Evaluation:
        """Return forces with displacements ``moved`` (s, 2, r) from the preload state."""
        rings = 5 * len(self.bearings.radius)
        of_rings, of_sleeves = np.split(moved, [rings], axis=-1)
        balls = self.bearings.at(of_rings.reshape(*moved.shape[:2], -1, 5))
        slope = np.zeros((*moved.shape, moved.shape[-1]))
        ring, sleeve = np.arange(rings).reshape(-1, 5), np.arange(rings, moved.shape[-1])
        slope[:, :, ring[:, :, None], ring[:, None]] = balls.slope
        force = balls.force.reshape(of_rings.shape)
        if sleeve.size:
            stop_forces, slope[:, :, sleeve, sleeve] = self.stops.forces(of_sleeves)
            force = np.concatenate([force, stop_forces], axis=-1)
        return Evaluation(force, slope, balls.exists, replace(self, bearings=balls.bearings))
