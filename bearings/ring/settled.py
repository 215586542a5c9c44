"""Bearings within a larger Newton iteration whose balls are in balance at every place of the rings.

What ``Iterate`` does step by step, by the compiled solver: dearer for one bearing by itself, for
which that must be loaded, several times cheaper for thousands of iterations.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bearings.arrays import Array, Flags
from bearings.geometry import Geometry
from bearings.ring.assembly import Assembly
from bearings.ring.equilibrium import one_by_one
from bearings.ring.iterate import Parts, parts_of
from bearings.ring.operation import Operation


@dataclass(frozen=True, eq=False, slots=True)
class Settled:
    """A batch of bearings of one model; ``shape`` (…) is that of the batch.

    ``ball`` (2, …, n): centres of the balls that are solved. ``load`` (…, 5) and ``stiffness``
    (…, 5, 5) of the rings; ``error`` (…): 0, NaN where there is no state.
    """

    parts: Parts
    shape: tuple[int, ...]
    ball: Array
    load: Array
    stiffness: Array
    error: Array

    def moved(self, displacement: Array) -> Settled:
        """Rings at ``displacement`` (…, 5), balls sought from where they are."""
        return _solved(self.parts, self.shape, displacement, self.ball)

    def follows(self, before: Settled) -> Flags:
        """Where there is a state: each is found by itself if its neighbour leads astray (…)."""
        return np.asarray(np.isfinite(self.error))


def settled(operation: Operation, assembly: Callable[[Geometry], Assembly]) -> Settled:
    """Bearings at given displacements; ``assembly`` says which of their balls are solved."""
    parts = parts_of(operation, assembly)
    return _solved(parts, operation.shape, operation.displacement, None)


def _solved(
    parts: Parts, shape: tuple[int, ...], displacement: Array, ball: Array | None
) -> Settled:
    count, balls = sum(len(k) for k, _ in parts), parts[0][1].assembly.balls
    d, x = displacement.reshape(count, 5), np.zeros((2, count, balls))
    load, stiffness, error = np.empty((count, 5)), np.empty((count, 5, 5)), np.zeros(count)
    near = None if ball is None else ball.reshape(2, count, balls)
    for k, problem in parts:
        (_, x[:, k], load[k], stiffness[k], exists), _ = one_by_one(
            problem, d[k], None if near is None else near[:, k]
        )
        error[k[~exists]] = np.nan
    return Settled(
        parts,
        shape,
        x.reshape(2, *shape, balls),
        load.reshape(*shape, 5),
        stiffness.reshape(*shape, 5, 5),
        error.reshape(shape),
    )
