"""Nonlinear part of the cutting forces: the vibration itself moves the ends of contact.

Every tooth cuts down to the surface that the deepest of the previous teeth left, with the motion of
the tip since then; where that thickness is below 0 it cuts nothing. The linear part has the chips
of a rigid machine, and the vibration since one tooth; this module gives the rest.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.analyses.stability_lobes.chips import passed
from rotordyn.analyses.stability_lobes.forces import Forces
from rotordyn.arrays import Array, Complex, Indices

FINE, LEAST, ARC = 8, 2000, 400  # angles in the shortest wave, in all, and from entry to exit
MOST = 100_000  # angles, however short the arc
SLICE = 0.05  # rad: lag of an edge between slices


@dataclass(frozen=True, slots=True)
class Beyond:
    """Nonlinear part of the forces: on the tip ``over`` the pattern (count, 2), its amplitudes
    (n, 2) [N], and mean torque over the radius [N]."""

    over: Array
    force: Complex
    torque: float


@dataclass(frozen=True)
class Contact:
    """Contact of teeth with ``forces`` at a ``speed`` [rad/s]; ``rubbing`` by depth [N s/m²]."""

    forces: Forces
    speed: float
    rubbing: float

    def of(self, order: Array, moved: Complex) -> Beyond:
        """Return nonlinear part by amplitudes of motion (n, 2) at orders of a revolution ≥ 0."""
        angle, velocity = self._angle(order), self._at_angles(order, moved * self._iomega(order))
        linear, true = np.zeros((len(angle), 3)), np.zeros((len(angle), 3))
        for tooth, prior in enumerate(passed(self.forces.cut, self.forces.feed)):
            since = [self._at_angles(order, moved * _since(order, gap)) for gap in prior.gap]
            for at, rows in self._slices(angle, tooth):
                s, c = np.sin(at), np.cos(at)
                normal = np.stack([s, c], axis=-1)
                thickness = [
                    feed * s + height + (motion[rows] * normal).sum(axis=-1)
                    for motion, feed, height in zip(since, prior.feed, prior.height, strict=True)
                ]
                rate = self.rubbing * (velocity[rows] * normal).sum(axis=-1)
                thick = np.minimum.reduce(thickness)
                true[rows] += self._force(s, c, thick, rate) * (thick > 0.0)[:, None]
                for chip in self.forces.chips:
                    if chip.tooth == tooth:
                        inside = (at > chip.entry) & (at < chip.exit)
                        tooth_before = int(prior.gap.searchsorted(chip.gap))
                        push = self._force(s, c, thickness[tooth_before], rate)
                        linear[rows] += push * inside[:, None]
        beyond = true - linear
        amplitude = np.fft.rfft(beyond[:, :2], axis=0)[: len(order)] / len(angle)
        force = amplitude * np.exp(-1j * order * angle[0])[:, None]
        return Beyond(beyond[:, :2], force, float(beyond[:, 2].mean()))

    def largest(self, order: Array, moved: Complex, beyond: Beyond) -> float:
        """Return the largest force on the tip [N]."""
        cut, angle, forces = self.forces.cut, self._angle(order), self.forces
        total = forces.at(angle)[:, :2] + beyond.over
        velocity = self._at_angles(order, moved * self._iomega(order))
        for chip in forces.chips:
            chip_cut = replace(cut, entry=chip.entry, exit=chip.exit)
            flank = replace(chip_cut, tangential=0.0, radial=self.rubbing)
            since = self._at_angles(order, moved * _since(order, chip.gap))
            for source, motion in ((chip_cut, since), (flank, velocity)):
                kernel = source.by_gap(angle, chip.tooth)
                total -= forces.depth * np.einsum("nij,nj->ni", kernel, motion)
        return float(np.hypot(*total.T).max())

    def _angle(self, order: Array) -> Array:
        """Return angles of the cutter over its pattern (count,) [rad], at middles of steps."""
        cut = self.forces.cut
        of_arc = min(math.ceil(ARC * cut.turn / (cut.exit - cut.entry)), MOST)
        count = max(FINE * len(order), LEAST, of_arc)
        return cut.turn * (np.arange(count) + 0.5) / count

    def _at_angles(self, order: Array, amplitude: Complex) -> Array:
        """Return values at the angles of the cutter (count, 2) of amplitudes (n, 2)."""
        angle = self._angle(order)
        shifted = amplitude * np.exp(1j * order * angle[0])[:, None]
        return np.asarray(np.fft.irfft(shifted, len(angle), axis=0) * len(angle))

    def _iomega(self, order: Array) -> Complex:
        return np.asarray(1j * order * self.speed)[:, None]

    @property
    def _slice_count(self) -> int:
        """Number of slices of an edge."""
        return max(1, math.ceil(self.forces.cut.lag / SLICE))

    def _slices(self, angle: Array, tooth: int) -> Iterator[tuple[Array, Indices]]:
        """Yield angles of the slices of an edge that are between entry and exit, and their indices
        among the ``angle`` of the cutter."""
        cut = self.forces.cut
        for lag in cut.lag * (np.arange(self._slice_count) + 0.5) / self._slice_count:
            for at in cut.standing(angle)[:, tooth] - lag:
                rows = np.flatnonzero((at > cut.entry) & (at < cut.exit))
                yield at[rows], rows

    def _force(self, s: Array, c: Array, thick: Array, rate: Array) -> Array:
        """Return the forces of a slice on the tip in feed and normal, and its torque by edge forces
        over the radius (n, 3). The torque of chips is omitted: their sum is the feed however the
        tip moves, so that its mean stays."""
        forces, cut = self.forces, self.forces.cut
        share = forces.depth / self._slice_count
        t = share * (cut.tangential * thick + forces.tangential)
        r = share * (cut.radial * thick + forces.radial + rate)
        edge = np.full_like(t, share * forces.tangential)
        return np.stack([-t * c - r * s, t * s - r * c, edge], axis=-1)


def _since(order: Array, gap: float) -> Complex:
    """Return factors (n, 1) from amplitudes of motion to those of motion since a ``gap`` [rad]."""
    return np.asarray(1.0 - np.exp(-1j * order * gap))[:, None]
