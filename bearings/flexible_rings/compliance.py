"""How far the grooves of a ring give under the loads of all its balls.

Loads Q at angles φ hold the energy ½ Σ Q C(φ, φ) Q, C symmetric. With it goes the shift of the
groove centre that a ball sees: along the normal ∂/∂Q of it, w = Σ C Q, and across it ∂/Q ∂φ,
w' = ∂w/∂φ, by which the deformed surface is turned (theory: flexible rings). A tangent made of
derivatives of an energy is symmetric. Between the angles at which it is known, C is a polynomial.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from bearings.arrays import Array

BEYOND = 0.2  # rad


@dataclass(frozen=True, eq=False, slots=True)
class Pressed:
    """Shifts (s, z, g, 2) [m] of the groove centres of a ring, axial and radial, and what they
    change by (s, z, g, 2, z, g, 2) where balls move against the grooves: in the first of
    ``slopes``, and by further compliances in the others."""

    shift: Array
    slopes: tuple[Array, ...]


class Weights(NamedTuple):
    """Of the angles that are known, at others: ``value`` (s, z, g, k), and derivatives."""

    value: Array
    first: Array
    second: Array


class Coefficients(NamedTuple):
    """Of normal deflections (s, z, g, z, g) [m/N], and their derivatives by the angle that is read
    (``along``; ``bent``, twice), that of the load (``beside``), and ``both``."""

    normal: Array
    along: Array
    bent: Array
    beside: Array
    both: Array


@dataclass(frozen=True, eq=False, slots=True)
class Compliance:
    """Of one ring with z balls evenly around it, known at k angles of each of its g grooves.

    ``between`` (z, z, g·k, g·k) [m/N]: displacement at one ball by load at another, 0 at the place
    of the load; ``own`` (g, k): there, without what Hertz counts. ``ends`` (g, 2): the angles φ
    between which they are known; ``cardinal`` (k, k): Chebyshev coefficients of the polynomials
    that are 1 at one of the angles. ``outward`` ±1: sign of the radial direction into the ring.
    """

    between: Array
    own: Array
    ends: Array
    cardinal: Array
    outward: float

    def alike(self, wave: int) -> Compliance:
        """For one ball that stands for all, loaded alike: ball k answers with cos(wave ψ_k)."""
        around = np.cos(2.0 * np.pi * wave * np.arange(len(self.between)) / len(self.between))
        one = np.einsum("k,kab->ab", around, self.between[0])
        return replace(self, between=one[None, None])

    def pressed(
        self, way: Array, load: Array, stiffness: Array, others: Sequence[Compliance] = ()
    ) -> Pressed:
        """Shifts by contacts of a ``load`` [N] and a slope ``stiffness`` [N/m] (s, z, g).

        ``way`` (s, z, g, 2) [m]: from every groove centre to its ball. ``others``: compliances by
        which further motions of the balls act about this state.
        """
        length = np.sqrt((way * way).sum(axis=-1))
        part = 1.0 / np.where(length > 0.0, length, 1.0)[..., None]
        down = way * part
        across = self.outward * np.stack([down[..., 1], -down[..., 0]], axis=-1)
        weights = self._weights(np.arctan2(down[..., 0], self.outward * down[..., 1]))
        c = self._coefficients(weights)
        w, turned, bent = (
            np.einsum("sjgkh,skh->sjg", each, load) for each in (c.normal, c.along, c.bent)
        )
        # A ball that moves by dy presses more by ``stiffness`` down·dy, its place turns by
        # across·dy / length.
        turning = across * part
        pressing, carried = stiffness[..., None] * down, load[..., None] * turning
        itself = ((w + bent)[..., None] * across)[..., None] * turning[..., None, :]
        slopes = []
        for each in (c, *(other._coefficients(weights) for other in others)):
            slope = _outer(down, each.normal, pressing) + _outer(down, each.beside, carried)
            slope += _outer(across, each.along, pressing) + _outer(across, each.both, carried)
            _add_own(slope, itself)
            slopes.append(slope)
        return Pressed(w[..., None] * down + turned[..., None] * across, (*slopes,))

    def _coefficients(self, weights: Weights) -> Coefficients:
        wide = [_spread(each) for each in weights]
        by_load, by_turn = (
            np.einsum("jkab,skhb->sjkha", self.between, each, optimize=True) for each in wide[:2]
        )
        normal, along, bent = (
            np.einsum("sjga,sjkha->sjgkh", each, by_load, optimize=True) for each in wide
        )
        beside, both = (
            np.einsum("sjga,sjkha->sjgkh", each, by_turn, optimize=True) for each in wide[:2]
        )
        own, slope, curve = (np.einsum("sjgk,gk->sjg", each, self.own) for each in weights)
        for whole, part in (
            (normal, own),
            (along, 0.5 * slope),
            (beside, 0.5 * slope),
            (both, 0.5 * curve),
        ):
            _add_own(whole[:, :, :, None, :, :, None], part[..., None, None])
        return Coefficients(normal, along, bent, beside, both)

    def _weights(self, angle: Array) -> Weights:
        """At angles φ (s, z, g); beyond the ends of the groove they go on straight, for ``BEYOND``
        at most."""
        each = [self._in_groove(g, angle[..., g]) for g in range(angle.shape[2])]
        value, first, second = (np.stack(part, axis=2) for part in zip(*each, strict=True))
        return Weights(value, first, second)

    def _in_groove(self, g: int, angle: Array) -> tuple[Array, Array, Array]:
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


def _spread(weight: Array) -> Array:
    """Weights (s, z, g, k) among the angles of all grooves (s, z, g, g·k)."""
    states, z, grooves, count = weight.shape
    wide = np.zeros((states, z, grooves, grooves, count))
    for g in range(grooves):
        wide[:, :, g, g] = weight[:, :, g]
    return wide.reshape(states, z, grooves, grooves * count)


def _outer(direction: Array, coefficient: Array, by: Array) -> Array:
    """direction (s, z, g, 2) · coefficient (s, z, g, z, g) · by (s, z, g, 2)."""
    scaled = coefficient[..., None] * by[:, None, None]
    return direction[:, :, :, :, None, None, None] * scaled[:, :, :, None]


def _add_own(whole: Array, part: Array) -> None:
    """Add ``part`` (s, z, g, a, b) where ball and groove are the same in (s, z, g, a, z, g, b)."""
    every = np.arange(part.shape[1])
    for g in range(part.shape[2]):
        whole[:, every, g, :, every, g] += part[:, :, g].swapaxes(0, 1)
