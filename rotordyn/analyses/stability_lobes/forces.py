"""Forces of the teeth of a cutter that a rigid machine would feel: of the feed, and of the edges.

A tooth at the angle φ takes off h = f sin φ, its feed f in proportion to its pitch, with run-out
the chips of ``chips``; on the length of its edge in cut act K_t h + K_te tangentially and
K_n h + K_ne radially.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.chips import Chip, chips
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
    def chips(self) -> tuple[Chip, ...]:
        """Of the teeth behind each of the gaps."""
        return chips(self.cut, self.feed)

    @property
    def repeats(self) -> int:
        """How often the pattern of teeth stands around the cutter."""
        return round(2.0 * math.pi / self.cut.turn)

    @property
    def idle(self) -> frozenset[int]:
        """Teeth of the pattern that take off nothing."""
        return frozenset(range(len(self.cut.gaps))) - {chip.tooth for chip in self.chips}

    def at(self, angle: Array) -> Array:
        """Force on the tip in feed and normal [N] and torque over the radius [N] while the first
        tooth is at ``angle`` (n,): (n, 3)."""
        standing, whole = self.cut.standing(angle), np.zeros((len(angle), 3))
        for chip in self.chips:
            whole += self._of_chip(chip, standing[:, chip.tooth])
        return self.depth * whole * np.array([-1.0, -1.0, 1.0])

    def _of_chip(self, chip: Chip, at: Array) -> Array:
        """Sum of what acts at its tooth ``at`` angles (turns, n), by depth (n, 3)."""
        lag = self.cut.lag
        if lag > STRAIGHT:
            begin, end = np.maximum(at - lag, chip.entry), np.minimum(at, chip.exit)
            pairs = zip(self._swept(end), self._swept(begin), strict=True)
            by_feed, level, edge = ((one - other) / lag for one, other in pairs)
        else:
            by_feed, level, edge = self._one(at)
        inside = (at > chip.entry) & (at - lag < chip.exit)
        each = by_feed * chip.feed + level * chip.height + edge
        return np.where(inside[..., None], each, 0.0).sum(axis=0)

    def _one(self, angle: Array) -> tuple[Array, Array, Array]:
        """Of a tooth in cut, by depth and by a chip of sin φ, of 1, and of none (…, 3)."""
        s, c = np.sin(angle), np.cos(angle)
        own = self.cut.tangential, self.cut.radial
        chip = np.concatenate([self.cut.one_tooth(angle)[..., 0], own[0] * s[..., None]], -1)
        level, edge = (
            np.stack([t * c + r * s, r * c - t * s, np.full_like(s, t)], axis=-1)
            for t, r in (own, (self.tangential, self.radial))
        )
        return chip, level, edge

    def _swept(self, angle: Array) -> tuple[Array, Array, Array]:
        """Antiderivatives of the same."""
        s, c = np.sin(angle), np.cos(angle)
        own = self.cut.tangential, self.cut.radial
        chip = np.concatenate([self.cut.swept(angle)[..., 0], -own[0] * c[..., None]], axis=-1)
        level, edge = (
            np.stack([t * s - r * c, r * s + t * c, t * angle], axis=-1)
            for t, r in (own, (self.tangential, self.radial))
        )
        return chip, level, edge

    def mean_torque(self) -> float:
        """Mean torque over the radius [N]."""
        tangential, swept = self.cut.tangential, 0.0
        for chip in self.chips:
            length = chip.exit - chip.entry
            cosine = math.cos(chip.entry) - math.cos(chip.exit)
            swept += tangential * (chip.feed * cosine + chip.height * length)
            swept += self.tangential * length
        return self.depth * self.repeats * swept / (2.0 * math.pi)

    def harmonics(self, order: Array) -> Complex:
        """Amplitudes of e^(ikφ) of the force on the tip (n, 2) [N], φ the angle of the first tooth,
        at the orders k of the revolution, whole multiples of those of the pattern."""
        level, edge = (
            np.stack([t * COSINE + r * SINE, r * COSINE - t * SINE], axis=-1)
            for t, r in ((self.cut.tangential, self.cut.radial), (self.tangential, self.radial))
        )
        whole: Complex = np.zeros((len(order), 2), dtype=complex)
        for chip in self.chips:
            one = chip.feed * self.by_displacement(order, chip)[..., 0]
            one += self._series(chip.height * level + edge, order, chip)
            whole += one * np.exp(1j * order * self.cut.behind[chip.tooth])[:, None]
        return np.asarray(-self.depth * self.repeats * whole)

    def by_displacement(self, order: Array, chip: Chip) -> Complex:
        """Amplitudes of H of a tooth that takes off a ``chip`` (n, 2, 2) [Pa]."""
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
            chip,
        )

    def _series(self, coefficients: NDArray[np.inexact], order: Array, chip: Chip) -> Complex:
        """Amplitudes (n, …) of what is Σ coefficients e^(imφ) of a tooth while it takes off a
        ``chip``, mean over its edge."""
        cut, turned = self.cut, TURNS - order[:, None]
        ends = [_primitive(turned, angle) for angle in (chip.exit, chip.entry)]
        within = (ends[0] - ends[1]) / (2.0 * math.pi)
        if cut.lag > 0.0:
            within = within * (_primitive(-order, cut.lag) / cut.lag)[:, None]
        return np.tensordot(within, coefficients, axes=1)


def _primitive(turn: Array, angle: float) -> Complex:
    """∫ e^(i turn φ) dφ from 0 to ``angle``."""
    half = 0.5 * turn * angle
    return np.asarray(angle * np.exp(1j * half) * np.sinc(half / math.pi))
