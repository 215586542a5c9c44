"""Compliance of the grooves of a ring under the loads of all its balls.

Loads Q at angles φ store the energy ½ Σ Q C(φ, φ) Q, C symmetric. Its derivatives are the shift of
the groove centre at a ball: along the normal ∂/∂Q, w = Σ C Q, and across it ∂/Q ∂φ, w' = ∂w/∂φ, the
rotation of the deformed surface (theory: flexible rings). A tangent made of derivatives of an
energy is symmetric. Between the angles at which it is computed, C is a polynomial.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bearings.arrays import Array

FADING = 0.2  # rad


@dataclass(frozen=True, eq=False, slots=True)
class Compliance:
    """Compliance of one ring with z evenly spaced balls, at k angles of each of its g grooves.

    ``between`` (z, z, g·k, g·k) [m/N]: displacement at one ball by load at another, 0 at the place
    of the load; ``own`` (g, k): that at the place of the load, less the part in Hertz's law.
    ``limits`` (g, 2): range of the angles φ; ``cardinal`` (3, k, k): Chebyshev coefficients of
    the polynomials that are 1 at one of the angles, of their first and second derivatives.
    ``outward`` ±1: sign of the radial direction into the ring.
    """

    between: Array
    own: Array
    limits: Array
    cardinal: Array
    outward: float

    def mirrored(self) -> Compliance:
        """Compliance of the ring with its neighbours on the other side: φ changes sign, and two
        grooves are exchanged."""
        return replace(self, between=self.between[..., ::-1, ::-1], own=self.own[::-1, ::-1])

    def for_equal_loads(self, harmonic: int) -> Compliance:
        """Compliance of one ball that stands for all, equally loaded: ball k has the weight
        cos(harmonic ψ_k)."""
        around = np.cos(2.0 * np.pi * harmonic * np.arange(len(self.between)) / len(self.between))
        first_ball = np.einsum("k,kab->ab", around, self.between[0])
        return replace(self, between=first_ball[None, None])

    def shifts(
        self, way: Array, load: Array, stiffness: Array, others: Sequence[Compliance] = ()
    ) -> tuple[Array, list[Array]]:
        """Compute shifts (s, z, g, 2) [m] of the groove centres, axial and radial, by contacts of a
        ``load`` [N] and a slope ``stiffness`` [N/m] (s, z, g), and their derivatives
        (s, z, g, 2, z, g, 2) by the motion of the balls against the grooves.

        ``way`` (s, z, g, 2) [m]: vector from every groove centre to its ball. ``others``: further
        compliances, of which the derivatives about this state follow those of this one.
        """
        length = np.sqrt((way * way).sum(axis=-1))
        part = 1.0 / np.where(length > 0.0, length, 1.0)[..., None]
        normal = way * part
        tangent = self.outward * np.stack([normal[..., 1], -normal[..., 0]], axis=-1)
        angle = np.arctan2(normal[..., 0], self.outward * normal[..., 1])
        weights = [self._in_groove(g, angle[..., g]) for g in range(angle.shape[2])]
        local = [
            np.stack([weight[k] @ self.own[g] for g, weight in enumerate(weights)], 2)
            for k in range(3)
        ]
        value, first, second = (_spread([weight[k] for weight in weights]) for k in range(3))

        loads = np.einsum("szga,szg->sza", value, load)  # at the computed angles (s, z, a)
        deflections = np.tensordot(loads, self.between, ((1, 2), (1, 3)))  # likewise
        w = np.einsum("szga,sza->szg", value, deflections) + local[0] * load
        rotation = np.einsum("szga,sza->szg", first, deflections) + 0.5 * local[1] * load
        bent = np.einsum("szga,sza->szg", second, deflections)

        # A motion dy of a ball changes its load by ``stiffness`` normal·dy and its angle by
        # tangent·dy / length. With C read at φ and loaded at φ', dw = C dQ + ∂C/∂φ' Q dφ'
        # + ∂C/∂φ Q dφ; the last cancels against the rotation of w' tangent, −w' normal dφ. At
        # the place of a load both angles change together: each has half of a derivative of ``own``.
        turning = tangent * part
        pressing, carried = stiffness[..., None] * normal, load[..., None] * turning
        by = value[..., None] * pressing[:, :, :, None] + first[..., None] * carried[:, :, :, None]
        read = value[..., None] * normal[:, :, :, None] + first[..., None] * tangent[:, :, :, None]
        at_place = _pair(
            normal, local[0][..., None] * pressing + 0.5 * local[1][..., None] * carried
        )
        at_place += _pair(
            tangent,
            0.5 * local[1][..., None] * pressing
            + 0.5 * local[2][..., None] * carried
            + (w + bent)[..., None] * turning,
        )
        slopes = [c._slope(read, by) for c in (self, *others)]
        balls = np.arange(way.shape[1])
        for slope in slopes:
            for g in range(way.shape[2]):
                slope[:, balls, g, :, balls, g] += at_place[:, :, g].swapaxes(0, 1)
        return w[..., None] * normal + rotation[..., None] * tangent, slopes

    def _slope(self, read: Array, by: Array) -> Array:
        """``read`` · between · ``by``, each (s, z, g, g·k, 2), as (s, z, g, 2, z, g, 2)."""
        states, z, grooves, places, _ = by.shape
        ends = 2 * grooves
        by = np.moveaxis(by, 3, 2).reshape(states, z, places, ends)
        half = self.between.transpose(1, 0, 2, 3).reshape(z, z * places, places) @ by
        half = half.reshape(states, z, z, places, ends).transpose(0, 2, 3, 1, 4)
        read = np.moveaxis(read, 3, 4).reshape(states, z, ends, places)
        slope = read @ half.reshape(states, z, places, z * ends)
        return slope.reshape(states, z, grooves, 2, z, grooves, 2)

    def _in_groove(self, g: int, angle: Array) -> tuple[Array, Array, Array]:
        """Weights (s, z, k) of the computed angles at any φ (s, z), and their derivatives; beyond
        the ends of the groove they continue linearly, for ``FADING`` at most."""
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
    """Place weights (s, z, k) of each groove among the angles of all grooves (s, z, g, g·k)."""
    count, size = weights[0].shape[-1], len(weights)
    wide = np.zeros((*weights[0].shape[:2], size, size * count))
    for g, weight in enumerate(weights):
        wide[:, :, g, g * count : (g + 1) * count] = weight
    return wide


def _pair(a: Array, b: Array) -> Array:
    return a[..., :, None] * b[..., None, :]
