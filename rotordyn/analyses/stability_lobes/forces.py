"""Forces of the teeth of a cutter that a rigid machine would feel: of the feed, and of the edges.

A tooth at the angle φ takes off h = f sin φ, its feed f in proportion to its pitch; on the length
of its edge in cut act K_t h + K_te tangentially and K_n h + K_ne radially.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.cutting import STRAIGHT, Cut

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
# of e^(imφ), m = −2 … 2
TURNS = np.arange(-2, 3)
SINE, COSINE = np.array([0, 0.5j, 0, -0.5j, 0]), np.array([0, 0.5, 0, 0.5, 0])
SQUARE = np.array([-0.25, 0, 0.5, 0, -0.25])  # sin²
PRODUCT = np.array([0.25j, 0, 0, 0, -0.25j])  # sin cos
OTHER = np.array([0.25, 0, 0.5, 0, 0.25])  # cos²


@dataclass(frozen=True, slots=True)
class Forces:
    """Of ``cut`` over a ``depth`` [m], with ``feed`` by tooth [m], on average where teeth are
    uneven; ``tangential`` and ``radial`` [N/m] of the edges."""

    cut: Cut
    depth: float
    feed: float
    tangential: float = 0.0
    radial: float = 0.0

    @property
    def feeds(self) -> Array:
        """Of the tooth behind each of the gaps (gaps,) [m]."""
        return self.feed * self.cut.teeth * np.array(self.cut.gaps) / (2.0 * math.pi)

    @property
    def repeats(self) -> int:
        """How often the pattern of teeth stands around the cutter."""
        return round(2.0 * math.pi / self.cut.turn)

    def at(self, angle: Array) -> Array:
        """Force on the tip in feed and normal [N] and torque over the radius [N] while the first
        tooth is at ``angle`` (n,): (n, 3)."""
        cut = self.cut
        teeth = cut.standing(angle)
        if cut.lag > STRAIGHT:
            begin, end = np.maximum(teeth - cut.lag, cut.entry), np.minimum(teeth, cut.exit)
            pairs = zip(self._swept(end), self._swept(begin), strict=True)
            chip, edge = ((one - other) / cut.lag for one, other in pairs)
        else:
            chip, edge = self._one(teeth)
        each = chip * self.feeds[:, None, None] + edge
        whole = np.where(cut.cutting(teeth)[..., None], each, 0.0).sum(axis=(0, 1))
        return np.asarray(self.depth * whole * np.array([-1.0, -1.0, 1.0]))

    def _one(self, angle: Array) -> tuple[Array, Array]:
        """Of a tooth in cut, by feed and depth and by depth alone (…, 3)."""
        s, c = np.sin(angle), np.cos(angle)
        t, r = self.tangential, self.radial
        chip = np.concatenate(
            [self.cut.one_tooth(angle)[..., 0], self.cut.tangential * s[..., None]], -1
        )
        return chip, np.stack([t * c + r * s, r * c - t * s, np.full_like(s, t)], axis=-1)

    def _swept(self, angle: Array) -> tuple[Array, Array]:
        """Antiderivatives of the same."""
        s, c = np.sin(angle), np.cos(angle)
        t, r = self.tangential, self.radial
        torque = -self.cut.tangential * c[..., None]
        chip = np.concatenate([self.cut.swept(angle)[..., 0], torque], axis=-1)
        return chip, np.stack([t * s - r * c, r * s + t * c, t * angle], axis=-1)

    def mean_torque(self) -> float:
        """Mean torque over the radius [N]."""
        cut = self.cut
        swept = cut.tangential * self.feed * (math.cos(cut.entry) - math.cos(cut.exit))
        swept += self.tangential * (cut.exit - cut.entry)
        return self.depth * cut.teeth * swept / (2.0 * math.pi)

    def harmonics(self, order: Array) -> Complex:
        """Amplitudes of e^(ikφ) of the force on the tip (n, 2) [N], φ the angle of the first tooth,
        at the orders k of the revolution, whole multiples of those of the pattern."""
        t, r = self.tangential, self.radial
        edge = np.stack([t * COSINE + r * SINE, r * COSINE - t * SINE], axis=-1)
        shift = np.exp(1j * order[:, None] * self.cut.behind)
        chip = self.by_displacement(order)[..., 0] * (shift @ self.feeds)[:, None]
        return (
            -self.depth
            * self.repeats
            * (chip + self._series(edge, order) * shift.sum(axis=1, keepdims=True))
        )

    def by_displacement(self, order: Array) -> Complex:
        """Amplitudes of H of one tooth (n, 2, 2) [Pa]."""
        t, r = self.cut.tangential, self.cut.radial
        return self._series(
            np.stack(
                [
                    np.stack([t * PRODUCT + r * SQUARE, t * OTHER + r * PRODUCT], axis=-1),
                    np.stack([r * PRODUCT - t * SQUARE, r * OTHER - t * PRODUCT], axis=-1),
                ],
                axis=-2,
            ),
            order,
        )

    def _series(self, coefficients: NDArray[np.inexact], order: Array) -> Complex:
        """Amplitudes (n, …) of what is Σ coefficients e^(imφ) of a tooth in cut, mean over its
        edge."""
        cut, turned = self.cut, TURNS - order[:, None]
        ends = [_primitive(turned, angle) for angle in (cut.exit, cut.entry)]
        within = (ends[0] - ends[1]) / (2.0 * math.pi)
        if cut.lag > 0.0:
            within = within * (_primitive(-order, cut.lag) / cut.lag)[:, None]
        return np.tensordot(within, coefficients, axes=1)


def _primitive(turn: Array, angle: float) -> Complex:
    """∫ e^(i turn φ) dφ from 0 to ``angle``."""
    half = 0.5 * turn * angle
    return np.asarray(angle * np.exp(1j * half) * np.sinc(half / math.pi))
