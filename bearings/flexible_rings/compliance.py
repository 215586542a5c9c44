"""How far the grooves of a ring give under the loads of all its balls.

Loads Q at angles φ hold the energy ½ Σ Q C(φ, φ) Q, C symmetric. With it goes the shift of the
groove centre that a ball sees: along the normal ∂/∂Q of it, w = Σ C Q, and across it ∂/Q ∂φ,
w' = ∂w/∂φ, by which the deformed surface is turned (theory: flexible rings). A tangent made of
derivatives of an energy is symmetric. Between the angles at which it is known, C is a polynomial.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bearings.arrays import Array

FADING = 0.2  # rad


@dataclass(frozen=True, eq=False, slots=True)
class Shifts:
    """Shifts (s, z, g, 2) [m] of the groove centres of a ring, axial and radial, and what they
    change by (s, z, g, 2, z, g, 2) where balls move against the grooves: in the first of
    ``slopes``, and by further compliances in the others."""

    shift: Array
    slopes: tuple[Array, ...]


@dataclass(frozen=True, eq=False, slots=True)
class Compliance:
    """Of one ring with z balls evenly around it, known at k angles of each of its g grooves.

    ``between`` (z, z, g·k, g·k) [m/N]: displacement at one ball by load at another, 0 at the place
    of the load; ``own`` (g, k): there, without what Hertz counts. ``limits`` (g, 2): the angles φ
    between which they are known; ``cardinal`` (3, k, k): Chebyshev coefficients of
    the polynomials that are 1 at one of the angles, of their first and second derivatives.
    ``outward`` ±1: sign of the radial direction into the ring.
    """

    between: Array
    own: Array
    limits: Array
    cardinal: Array
    outward: float

    def mirrored(self) -> Compliance:
        """Of the same ring with its neighbours on the other side: φ is −φ, and of two grooves each
        is the other."""
        return replace(self, between=self.between[..., ::-1, ::-1], own=self.own[::-1, ::-1])

    def for_equal_loads(self, harmonic: int) -> Compliance:
        """For one ball that stands for all, loaded alike: ball k answers with cos(harmonic ψ_k)."""
        around = np.cos(2.0 * np.pi * harmonic * np.arange(len(self.between)) / len(self.between))
        one = np.einsum("k,kab->ab", around, self.between[0])
        return replace(self, between=one[None, None])

    def shifts(
        self, way: Array, load: Array, stiffness: Array, others: Sequence[Compliance] = ()
    ) -> Shifts:
        """Shifts by contacts of a ``load`` [N] and a slope ``stiffness`` [N/m] (s, z, g).

        ``way`` (s, z, g, 2) [m]: from every groove centre to its ball. ``others``: compliances by
        which further motions of the balls act about this state.
        """
        length = np.sqrt((way * way).sum(axis=-1))
        part = 1.0 / np.where(length > 0.0, length, 1.0)[..., None]
        down = way * part
        along = self.outward * np.stack([down[..., 1], -down[..., 0]], axis=-1)
        angle = np.arctan2(down[..., 0], self.outward * down[..., 1])
        each = [self._in_groove(g, angle[..., g]) for g in range(angle.shape[2])]
        own = [np.stack([one[k] @ self.own[g] for g, one in enumerate(each)], 2) for k in range(3)]
        value, first, second = (_spread([one[k] for one in each]) for k in range(3))

        pressed = np.einsum("szga,szg->sza", value, load)  # loads at the known angles
        given = np.tensordot(pressed, self.between, ((1, 2), (1, 3)))  # deflections there (s, z, a)
        w = np.einsum("szga,sza->szg", value, given) + own[0] * load
        turned = np.einsum("szga,sza->szg", first, given) + 0.5 * own[1] * load
        bent = np.einsum("szga,sza->szg", second, given)

        # A ball that moves by dy presses more by ``stiffness`` down·dy, and its place turns by
        # along·dy / length. With C read at φ and loaded at φ', dw = C dQ + ∂C/∂φ' Q dφ'
        # + ∂C/∂φ Q dφ; the last cancels against what w' along loses as it turns, −w' down dφ. At
        # the place of a load both angles move together: each has half of a derivative of ``own``.
        turning = along * part
        pressing, carried = stiffness[..., None] * down, load[..., None] * turning
        by = value[..., None] * pressing[:, :, :, None] + first[..., None] * carried[:, :, :, None]
        read = value[..., None] * down[:, :, :, None] + first[..., None] * along[:, :, :, None]
        at_place = _pair(down, own[0][..., None] * pressing + 0.5 * own[1][..., None] * carried)
        at_place += _pair(
            along,
            0.5 * own[1][..., None] * pressing
            + 0.5 * own[2][..., None] * carried
            + (w + bent)[..., None] * turning,
        )
        slopes = [c._slope(read, by) for c in (self, *others)]
        every = np.arange(way.shape[1])
        for slope in slopes:
            for g in range(way.shape[2]):
                slope[:, every, g, :, every, g] += at_place[:, :, g].swapaxes(0, 1)
        return Shifts(w[..., None] * down + turned[..., None] * along, (*slopes,))

    def _slope(self, read: Array, by: Array) -> Array:
        """``read`` · between · ``by``, each (s, z, g, g·k, 2), as (s, z, g, 2, z, g, 2)."""
        states, z, grooves, places, _ = by.shape
        ends = 2 * grooves
        by = np.moveaxis(by, 3, 2).reshape(states, z, places, ends)
        half = self.between.transpose(1, 0, 2, 3).reshape(z, z * places, places) @ by
        half = half.reshape(states, z, z, places, ends).transpose(0, 2, 3, 1, 4)
        read = np.moveaxis(read, 3, 4).reshape(states, z, ends, places)
        whole = read @ half.reshape(states, z, places, z * ends)
        return whole.reshape(states, z, grooves, 2, z, grooves, 2)

    def _in_groove(self, g: int, angle: Array) -> tuple[Array, Array, Array]:
        """Weights (s, z, k) of the known angles at others φ (s, z), and their derivatives; beyond
        the ends of the groove they go on straight, for ``FADING`` at most."""
        low, high = self.limits[g]
        inside = np.clip(angle, low, high)
        beyond = angle - inside
        further = (FADING * np.tanh(beyond / FADING))[..., None]
        scale = 2.0 / (high - low)
        t = scale * (inside - 0.5 * (low + high))
        terms = np.polynomial.chebyshev.chebvander(t, self.cardinal.shape[1] - 1)
        value, first, second = (terms @ table for table in self.cardinal)
        fading = 1.0 / np.cosh(beyond / FADING)[..., None] ** 2
        bending = -2.0 * further / FADING**2 * fading
        straight = (beyond != 0.0)[..., None]
        return (
            value + scale * first * further,
            scale * first * fading,
            np.where(straight, scale * first * bending, scale**2 * second),
        )


def _spread(weights: Sequence[Array]) -> Array:
    """Weights (s, z, k) of each groove among the angles of all (s, z, g, g·k)."""
    count, size = weights[0].shape[-1], len(weights)
    wide = np.zeros((*weights[0].shape[:2], size, size * count))
    for g, weight in enumerate(weights):
        wide[:, :, g, g * count : (g + 1) * count] = weight
    return wide


def _pair(a: Array, b: Array) -> Array:
    return a[..., :, None] * b[..., None, :]
