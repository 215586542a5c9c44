"""How far the grooves of a ring give under the loads of all its balls.

Loads Q at angles φ hold the energy ½ Σ Q C(φ, φ) Q, C symmetric. With it goes the shift of the
groove centre that a ball sees: along the normal ∂/∂Q of it, w = Σ C Q, and across it ∂/Q ∂φ,
w' = ∂w/∂φ, by which the deformed surface is turned (theory: flexible rings). A tangent made of
derivatives of an energy is symmetric. Between the angles at which it is known, C is a polynomial.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from bearings.arrays import Array

BEYOND = 0.2  # rad


@dataclass(frozen=True, eq=False, slots=True)
class Pressed:
    """Shifts (s, z, g, 2) [m] of the groove centres of a ring, axial and radial, and what they
    change by (s, z, g, 2, z, g, 2) where balls move against the grooves."""

    shift: Array
    slope: Array


@dataclass(frozen=True, eq=False, slots=True)
class Compliance:
    """Of one ring with z balls evenly around it, known at k angles of each of its g grooves.

    ``between`` (z, z, g·k, g·k) [m/N]: displacement at one ball by load at another; ``own`` (g, k):
    at the place of the load, without what Hertz counts. ``ends`` (g, 2): the angles φ between which
    they are known; ``cardinal`` (k, k): Chebyshev coefficients of the polynomials that are 1 at one
    of the angles. ``outward`` ±1: sign of the radial direction into the ring.
    """

    between: Array
    own: Array
    ends: Array
    cardinal: Array
    outward: float

    def pressed(self, way: Array, load: Array, stiffness: Array) -> Pressed:
        """Shifts by contacts of a ``load`` [N] and a slope ``stiffness`` [N/m] (s, z, g).

        ``way`` (s, z, g, 2) [m]: from every groove centre to its ball.
        """
        _, z, grooves = load.shape
        length = np.sqrt((way * way).sum(axis=-1))
        down = way / np.where(length > 0.0, length, 1.0)[..., None]
        across = self.outward * np.stack([down[..., 1], -down[..., 0]], axis=-1)
        angle = np.arctan2(down[..., 0], self.outward * down[..., 1])
        each = [self._weights(g, angle[..., g]) for g in range(grooves)]
        value, first, second = (
            np.stack([w[order] for w in each], axis=2) for order in range(3)
        )  # (s, z, g, k)
        spread = [self._spread(w) for w in (value, first, second)]
        by_load, by_turn = (
            np.einsum("jkab,skhb->sjkha", self.between, w, optimize=True) for w in spread[:2]
        )
        normal, along, twice = (
            np.einsum("sjga,sjkha->sjgkh", w, by_load, optimize=True) for w in spread
        )
        beside, both = (
            np.einsum("sjga,sjkha->sjgkh", w, by_turn, optimize=True) for w in spread[:2]
        )
        own = [np.einsum("sjgk,gk->sjg", w, self.own) for w in (value, first, second)]
        every = np.arange(z)
        for g in range(grooves):
            there = (slice(None), every, g, every, g)
            normal[there], twice[there] = own[0][..., g], 0.0
            along[there] = beside[there] = 0.5 * own[1][..., g]
            both[there] = 0.5 * own[2][..., g]
        w, turned, bent = (np.einsum("sjgkh,skh->sjg", c, load) for c in (normal, along, twice))
        shift = w[..., None] * down + turned[..., None] * across
        # A ball that moves by dy presses more by ``stiffness`` down·dy, its place turns by
        # across·dy / length.
        pressing = stiffness[..., None] * down
        turning = across / np.where(length > 0.0, length, 1.0)[..., None]
        carried = load[..., None] * turning
        slope = down[:, :, :, :, None, None, None] * (
            normal[:, :, :, None, :, :, None] * pressing[:, None, None, None]
            + beside[:, :, :, None, :, :, None] * carried[:, None, None, None]
        )
        slope += across[:, :, :, :, None, None, None] * (
            along[:, :, :, None, :, :, None] * pressing[:, None, None, None]
            + both[:, :, :, None, :, :, None] * carried[:, None, None, None]
        )
        itself = ((w + bent)[..., None] * across)[..., None] * turning[..., None, :]
        for g in range(grooves):
            slope[:, every, g, :, every, g] += itself[:, :, g].swapaxes(0, 1)
        return Pressed(shift, slope)

    def _weights(self, g: int, angle: Array) -> tuple[Array, Array, Array]:
        """Weights of the known angles (s, z, k) at others, and their derivatives; beyond the ends
        of the groove they go on straight, for ``BEYOND`` at most."""
        low, high = self.ends[g]
        inside = np.clip(angle, low, high)
        beyond = angle - inside
        further = BEYOND * np.tanh(beyond / BEYOND)
        scale = 2.0 / (high - low)
        t = scale * (2.0 * inside - low - high) / 2.0
        value, first, second = (
            np.moveaxis(np.polynomial.chebyshev.chebval(t, table), 0, -1)
            for table in (self.cardinal, *self._derivatives)
        )
        fading = (1.0 / np.cosh(beyond / BEYOND) ** 2)[..., None]
        bending = -2.0 * further[..., None] / BEYOND**2 * fading
        bent = np.where((beyond == 0.0)[..., None], scale**2 * second, scale * first * bending)
        return value + scale * first * further[..., None], scale * first * fading, bent

    @property
    def _derivatives(self) -> tuple[Any, Any]:
        chebder = np.polynomial.chebyshev.chebder
        return chebder(self.cardinal, 1), chebder(self.cardinal, 2)

    def _spread(self, weight: Array) -> Array:
        """Weights (s, z, g, k) among the angles of all grooves (s, z, g, g·k)."""
        states, z, grooves, count = weight.shape
        wide = np.zeros((states, z, grooves, grooves, count))
        for g in range(grooves):
            wide[:, :, g, g] = weight[:, :, g]
        return wide.reshape(states, z, grooves, grooves * count)
