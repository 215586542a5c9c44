"""Forces of the teeth of a cutter on a rigid machine: of the chips, and of the edges.

A tooth at the angle φ cuts a chip h = f sin φ, with its feed f in proportion to its pitch; with
run-out, chips are those of ``chips``. The force by length of edge in cut is K_t h + K_te
tangentially and K_n h + K_ne radially.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.chips import Chip, chips
from rotordyn.analyses.stability_lobes.cutting import STRAIGHT, Cut
from rotordyn.arrays import Array, Complex

# amplitudes of e^(imφ), m = −2 … 2
TURNS = np.arange(-2, 3)
SINE, COSINE = np.array([0, 0.5j, 0, -0.5j, 0]), np.array([0, 0.5, 0, 0.5, 0])
SQUARE = np.array([-0.25, 0, 0.5, 0, -0.25])  # sin²
PRODUCT = np.array([0.25j, 0, 0, 0, -0.25j])  # sin cos
OTHER = np.array([0.25, 0, 0.5, 0, 0.25])  # cos²


@dataclass(frozen=True, slots=True)
class Forces:
    """Forces of a ``cut`` over a ``depth`` [m], with a ``feed`` by tooth [m], on average if teeth
    are uneven; ``tangential`` and ``radial`` edge forces by length [N/m]."""

    cut: Cut
    depth: float
    feed: float
    tangential: float = 0.0
    radial: float = 0.0

    @property
    def chips(self) -> tuple[Chip, ...]:
        """Chips of the teeth behind each of the gaps."""
        return chips(self.cut, self.feed)

    @property
    def repeats(self) -> int:
        """Number of repeats of the pattern of teeth around the cutter."""
        return round(2.0 * math.pi / self.cut.turn)

    @property
    def idle(self) -> frozenset[int]:
        """Teeth of the pattern that cut no chip."""
        return frozenset(range(len(self.cut.gaps))) - {chip.tooth for chip in self.chips}

    def at(self, angle: Array) -> Array:
        """Return force on the tip in feed and normal [N], and torque over the radius [N], with the
        first tooth at ``angle`` (n,): (n, 3)."""
        angles, total = self.cut.standing(angle), np.zeros((len(angle), 3))
        for chip in self.chips:
            total += self._of_chip(chip, angles[:, chip.tooth])
        return self.depth * total * np.array([-1.0, -1.0, 1.0])  # F = −a H Δ, as in ``cutting``

    def _of_chip(self, chip: Chip, at: Array) -> Array:
        """Return the sum of its forces by depth (n, 3), its tooth ``at`` angles (turns, n)."""
        lag = self.cut.lag
        if lag > STRAIGHT:
            begin, end = np.maximum(at - lag, chip.entry), np.minimum(at, chip.exit)
            pairs = zip(self._antiderivatives(end), self._antiderivatives(begin), strict=True)
            by_feed, by_height, edge = ((upper - lower) / lag for upper, lower in pairs)
        else:
            by_feed, by_height, edge = self._per_depth(at)
        inside = (at > chip.entry) & (at - lag < chip.exit)
        force = by_feed * chip.feed + by_height * chip.height + edge
        return np.where(inside[..., None], force, 0.0).sum(axis=0)

    def _per_depth(self, angle: Array) -> tuple[Array, Array, Array]:
        """Return forces of a tooth by depth: of a chip sin φ, a chip 1, and its edge (…, 3)."""
        s, c = np.sin(angle), np.cos(angle)
        pair = self.cut.tangential, self.cut.radial
        chip = np.concatenate([self.cut.one_tooth(angle)[..., 0], pair[0] * s[..., None]], -1)
        by_height, edge = (
            np.stack([t * c + r * s, r * c - t * s, np.full_like(s, t)], axis=-1)
            for t, r in (pair, (self.tangential, self.radial))
        )
        return chip, by_height, edge

    def _antiderivatives(self, angle: Array) -> tuple[Array, Array, Array]:
        """Return antiderivatives of ``_per_depth``."""
        s, c = np.sin(angle), np.cos(angle)
        pair = self.cut.tangential, self.cut.radial
        chip = np.concatenate([self.cut.swept(angle)[..., 0], -pair[0] * c[..., None]], axis=-1)
        by_height, edge = (
            np.stack([t * s - r * c, r * s + t * c, t * angle], axis=-1)
            for t, r in (pair, (self.tangential, self.radial))
        )
        return chip, by_height, edge

    def mean_torque(self) -> float:
        """Return the mean torque over the radius [N]."""
        tangential, integral = self.cut.tangential, 0.0
        for chip in self.chips:
            length = chip.exit - chip.entry
            cosine = math.cos(chip.entry) - math.cos(chip.exit)
            integral += tangential * (chip.feed * cosine + chip.height * length)
            integral += self.tangential * length
        return self.depth * self.repeats * integral / (2.0 * math.pi)

    def harmonics(self, order: Array) -> Complex:
        """Return amplitudes of e^(ikφ) of the force on the tip (n, 2) [N], φ the angle of the first
        tooth, at orders k of the revolution, which are multiples of those of the pattern."""
        by_height, edge = (
            np.stack([t * COSINE + r * SINE, r * COSINE - t * SINE], axis=-1)
            for t, r in ((self.cut.tangential, self.cut.radial), (self.tangential, self.radial))
        )
        total: Complex = np.zeros((len(order), 2), dtype=complex)
        for chip in self.chips:
            amplitude = chip.feed * self.by_displacement(order, chip)[..., 0]
            amplitude += self._series(chip.height * by_height + edge, order, chip)
            total += amplitude * np.exp(1j * order * self.cut.behind[chip.tooth])[:, None]
        return np.asarray(-self.depth * self.repeats * total)

    def by_displacement(self, order: Array, chip: Chip) -> Complex:
        """Return amplitudes of H of a tooth that cuts a ``chip`` (n, 2, 2) [Pa]."""
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
        """Return amplitudes (n, …) of Σ coefficients e^(imφ) of a tooth while it cuts a ``chip``,
        the mean over its edge."""
        cut, orders = self.cut, TURNS - order[:, None]
        ends = [_primitive(orders, angle) for angle in (chip.exit, chip.entry)]
        within = (ends[0] - ends[1]) / (2.0 * math.pi)
        if cut.lag > 0.0:
            within = within * (_primitive(-order, cut.lag) / cut.lag)[:, None]
        return np.tensordot(within, coefficients, axes=1)


def _primitive(order: Array, angle: float) -> Complex:
    """Return ∫ e^(i order φ) dφ from 0 to ``angle``."""
    half = 0.5 * order * angle
    return np.asarray(angle * np.exp(1j * half) * np.sinc(half / math.pi))
