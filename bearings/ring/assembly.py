"""Assembly of the balls around a ring: groove places from ring displacement, ring load from balls.

A ring's displacement is d = (δx, δy, δz, θy, θz), its load f = (Fx, Fy, Fz, My, Mz); ball k lies
at ψ = 2πk/z, from y towards z. At a ball the ring's groove moves axially, radially, and tilts by
φ = θz cos ψ − θy sin ψ about the middle of the groove.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from bearings.arrays import Array
from bearings.ball.plane import Motion, Triple
from bearings.geometry import Geometry

QUARTER_TURN = np.array(  # of (x, y, z, θy, θz) about x
    [[1, 0, 0, 0, 0], [0, 0, 1, 0, 0], [0, -1, 0, 0, 0], [0, 0, 0, 0, 1], [0, 0, 0, -1, 0]]
)
COUPLED = np.array(  # x alone, y with θz, z with θy
    [[1, 0, 0, 0, 0], [0, 1, 0, 0, 1], [0, 0, 1, 1, 0], [0, 0, 1, 1, 0], [0, 1, 0, 0, 1]]
)


@dataclass(frozen=True, eq=False, slots=True)
class Assembly:
    """Balls that are solved, and their maps to the five DOF of the ring.

    ``spread`` (m, 5, n): A = A₀ + spread·d, m = 3 where the inner ring has two grooves, else 2.
    ``gather`` (5, 3, n): f = Σ gather·action. ``pairs`` (3·m·n, 25): K = Σ action-by-A (3·m·n) ·
    pairs. ``azimuth`` (n, 5): the row c = (1, cos ψ, sin ψ, −sin ψ, cos ψ) that maps d to axial,
    radial and tilting motion of the ring at a ball, and ``products`` (n, 5, 5): cᵀ c. Balls that
    are equal by symmetry are solved once: with ``balls`` = 1 the one ball represents all of an
    axially loaded bearing.
    """

    azimuth: Array
    products: Array
    spread: Array
    gather: Array
    pairs: Array

    @property
    def balls(self) -> int:
        """Number of balls that are solved."""
        return self.spread.shape[-1]

    def centres(self, start: Array, displacement: Array) -> Array:
        """A (m, states, balls) from A₀ (2, states) and d (states, 5)."""
        centres = self.moved(displacement)
        centres[:2] += start[:, :, None]
        return centres

    def moved(self, displacement: Array) -> Array:
        """Change of A (m, states, balls) by a displacement (states, 5)."""
        return np.asarray(displacement @ self.spread)

    def load(self, action: Triple) -> Array:
        """f (states, 5) from ball actions, three of (states, balls)."""
        return np.einsum("ikn,ksn->si", self.gather, np.stack(action))

    def stiffness(self, tangent: tuple[Motion, ...]) -> Array:
        """K (states, 5, 5) from the entries (states, balls) of ∂action/∂A (3, m)."""
        states, balls = np.shape(tangent[0][0])
        entries = np.empty((states, 3, len(tangent[0]), balls))
        for i, row in enumerate(tangent):
            for j, entry in enumerate(row):
                entries[:, i, j] = entry
        flat = entries.reshape(states, 1, len(self.pairs))
        return (flat @ self.pairs).reshape(-1, 5, 5)  # state by state: too small for threads


@lru_cache(maxsize=256)
def full_assembly(geometry: Geometry, *, outer: bool = False) -> Assembly:
    """Assembly of all balls, each solved, on the inner or the ``outer`` ring."""
    spread, gather = _maps(geometry, geometry.outer_centre_radius if outer else None)
    return Assembly(*_azimuth(geometry), spread, gather, _pairs(spread, gather))


@lru_cache(maxsize=256)
def axial_assembly(geometry: Geometry) -> Assembly:
    """Assembly of one ball for all: the displacement is purely axial, the tangent is not.

    Sums over the ball angles that vanish for three balls or more are set to exactly zero.
    """
    spread, gather = _maps(geometry)
    rows = _pairs(spread, gather).reshape(-1, geometry.balls, 25).sum(axis=1)
    axial_spread = np.zeros((len(spread), 5, 1))
    axial_spread[0, 0] = 1.0
    sums = (*(part.sum(axis=0)[None] for part in _azimuth(geometry)),)
    azimuth, products, total, pairs = map(
        _without_noise, (*sums, gather.sum(axis=2)[..., None], rows)
    )
    return Assembly(azimuth, products, axial_spread, total, pairs)


@lru_cache(maxsize=256)
def half_assembly(geometry: Geometry) -> Assembly:
    """Assembly of the balls on one side of the plane of y, each counted for its mirror image too.

    The ring moves in that plane alone, which saves up to 9 % of a run. Fz and My are
    exactly zero, and so are the terms of the tangent that couple the planes. The compiled solver
    does not support it: it sums by ``azimuth`` alone and would omit the mirror images.
    """
    spread, gather = _maps(geometry)
    count = geometry.balls // 2 + 1
    multiplicity = np.full(count, 2.0)
    multiplicity[0] = 1.0
    if geometry.balls % 2 == 0:
        multiplicity[-1] = 1.0
    spread, gather = spread[..., :count], multiplicity * gather[..., :count]
    plane = np.array([True, True, False, False, True])
    pairs = _pairs(spread, gather).reshape(-1, 5, 5) * (plane[:, None] == plane)
    gather = plane[:, None, None] * gather
    azimuth, products = (part[:count] for part in _azimuth(geometry))
    return Assembly(azimuth, products, spread, gather, pairs.reshape(-1, 25))


def _maps(geometry: Geometry, radius: float | None = None) -> tuple[Array, Array]:
    """``spread`` and ``gather`` of ``Assembly`` for all balls; ``radius`` of the groove centres."""
    one, cos, sin = _azimuth(geometry)[0].T[:3]
    zero, radius = np.zeros_like(one), geometry.centre_radius if radius is None else radius
    spread = np.array(
        [
            [one, zero, zero, radius * sin, -radius * cos],
            [zero, cos, sin, zero, zero],
            [zero, zero, zero, -sin, cos],
        ]
    )
    parts = 2 if len(geometry.inner_grooves) == 1 else 3
    return spread[:parts], spread.swapaxes(0, 1).copy()  # virtual work


def _azimuth(geometry: Geometry) -> tuple[Array, Array]:
    """``azimuth`` and ``products`` of ``Assembly`` for all balls."""
    angle = 2.0 * np.pi * np.arange(geometry.balls) / geometry.balls
    sin, cos = np.sin(angle), np.cos(angle)
    row = np.stack([np.ones_like(angle), cos, sin, -sin, cos], axis=1)
    return row, row[:, :, None] * row[:, None]


def _pairs(spread: Array, gather: Array) -> Array:
    return np.einsum("ikn,cjn->kcnij", gather, spread).reshape(-1, 25)


def _without_noise(sums: Array) -> Array:
    return np.where(np.abs(sums) > 1e-9 * np.abs(sums).max(), sums, 0.0)


def alike(load: Array, displacement: Array, stiffness: Array) -> Array:
    """Remove rounding from K (…, 5, 5) where load and displacement (…, 5) are axial: both planes
    have the same stiffness and do not couple."""
    axial = ((load == 0.0) & (displacement == 0.0))[..., 1:].all(axis=-1)
    turned = QUARTER_TURN @ stiffness @ QUARTER_TURN.T
    exact = np.where(COUPLED, 0.5 * (stiffness + turned), 0.0)
    return np.where(axial[..., None, None], exact, stiffness)
