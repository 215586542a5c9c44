"""What teeth take off as the vibration itself moves the ends of their contact.

Every tooth takes off what the deepest of those before it left, with all that the tip moved since,
and nothing where that is below 0. Forces of the chips of a rigid machine with the vibration since
one tooth are the linear part; here is what the true ones have beyond that.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.chips import passed
from rotordyn.analyses.stability_lobes.forces import Forces

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FINE, LEAST, ARC = 8, 2000, 400  # angles to the shortest wave, in all, and from entry to exit
MOST = 100_000  # angles for short arcs
SLICE = 0.05  # rad, by which an edge lags from slice to slice


@dataclass(frozen=True, slots=True)
class Beyond:
    """Beyond the linear ones: force on the tip over the pattern (count, 2) and its amplitudes
    (n, 2) [N], and the mean torque over the radius [N]."""

    over: Array
    force: Complex
    torque: float


@dataclass(frozen=True)
class Contact:
    """Of ``forces`` at a ``speed`` [rad/s], with ``rubbing`` flanks [N s/m²] by depth."""

    forces: Forces
    speed: float
    rubbing: float

    def of(self, order: Array, moved: Complex) -> Beyond:
        """With a motion of the tip (n, 2) at orders of the revolution, from 0 up."""
        angle, velocity = self._angle(order), self._over(order, moved * self._rate(order))
        linear, true = np.zeros((len(angle), 3)), np.zeros((len(angle), 3))
        for tooth, before in enumerate(passed(self.forces.cut, self.forces.feed)):
            since = [self._over(order, moved * _since(order, gap)) for gap in before.gap]
            for at, where in self._slices(angle, tooth):
                s, c = np.sin(at), np.cos(at)
                away = np.stack([s, c], axis=-1)
                left = [
                    feed * s + height + (motion[where] * away).sum(axis=-1)
                    for motion, feed, height in zip(since, before.feed, before.height, strict=True)
                ]
                rate = self.rubbing * (velocity[where] * away).sum(axis=-1)
                thick = np.minimum.reduce(left)
                true[where] += self._push(s, c, thick, rate) * (thick > 0.0)[:, None]
                for chip in self.forces.chips:
                    if chip.tooth == tooth:
                        inside = (at > chip.entry) & (at < chip.exit)
                        which = int(before.gap.searchsorted(chip.gap))
                        push = self._push(s, c, left[which], rate)
                        linear[where] += push * inside[:, None]
        beyond = true - linear
        amplitude = np.fft.rfft(beyond[:, :2], axis=0)[: len(order)] / len(angle)
        force = amplitude * np.exp(-1j * order * angle[0])[:, None]
        return Beyond(beyond[:, :2], force, float(beyond[:, 2].mean()))

    def largest(self, order: Array, moved: Complex, beyond: Beyond) -> float:
        """Largest force on the tip [N]."""
        cut, angle, forces = self.forces.cut, self._angle(order), self.forces
        total = forces.at(angle)[:, :2] + beyond.over
        velocity = self._over(order, moved * self._rate(order))
        for chip in forces.chips:
            own = replace(cut, entry=chip.entry, exit=chip.exit)
            flank = replace(own, tangential=0.0, radial=self.rubbing)
            since = self._over(order, moved * _since(order, chip.gap))
            for each, motion in ((own, since), (flank, velocity)):
                kernel = each.by_gap(angle, chip.tooth)
                total -= forces.depth * np.einsum("nij,nj->ni", kernel, motion)
        return float(np.hypot(*total.T).max())

    def _angle(self, order: Array) -> Array:
        """Of the cutter over its pattern (count,), between the steps."""
        cut = self.forces.cut
        of_arc = min(math.ceil(ARC * cut.turn / (cut.exit - cut.entry)), MOST)
        count = max(FINE * len(order), LEAST, of_arc)
        return cut.turn * (np.arange(count) + 0.5) / count

    def _over(self, order: Array, amplitude: Complex) -> Array:
        """Values at these angles (count, 2) of amplitudes (n, 2)."""
        angle = self._angle(order)
        begun = amplitude * np.exp(1j * order * angle[0])[:, None]
        return np.asarray(np.fft.irfft(begun, len(angle), axis=0) * len(angle))

    def _rate(self, order: Array) -> Complex:
        return np.asarray(1j * order * self.speed)[:, None]

    @property
    def _count(self) -> int:
        """Slices of an edge."""
        return max(1, math.ceil(self.forces.cut.lag / SLICE))

    def _slices(self, angle: Array, tooth: int) -> Iterator[tuple[Array, NDArray[np.intp]]]:
        """Angles of the slices of an edge that are between entry and exit, and their places among
        the ``angle`` of the cutter."""
        cut = self.forces.cut
        for lag in cut.lag * (np.arange(self._count) + 0.5) / self._count:
            for at in cut.standing(angle)[:, tooth] - lag:
                where = np.flatnonzero((at > cut.entry) & (at < cut.exit))
                yield at[where], where

    def _push(self, s: Array, c: Array, thick: Array, rate: Array) -> Array:
        """Force on the tip in feed and normal and torque of the edge over the radius (n, 3) of a
        slice. At every angle all chips together are the feed, however the tip moves: their mean
        torque stays."""
        forces, cut = self.forces, self.forces.cut
        share = forces.depth / self._count
        t = share * (cut.tangential * thick + forces.tangential)
        r = share * (cut.radial * thick + forces.radial + rate)
        edge = np.full_like(t, share * forces.tangential)
        return np.stack([-t * c - r * s, t * s - r * c, edge], axis=-1)


def _since(order: Array, gap: float) -> Complex:
    """From amplitudes to those of what moved since a ``gap`` [rad] (n, 1)."""
    return np.asarray(1.0 - np.exp(-1j * order * gap))[:, None]
