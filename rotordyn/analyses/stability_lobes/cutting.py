"""Forces of the teeth of a milling cutter on its tip.

x is the feed, y the normal to it, φ the angle of a tooth from +y towards +x; it cuts while entry <
φ < exit. Stability depends only on the dynamic chip thickness, h = Δx sin φ + Δy cos φ, with Δ the
displacement of the tip since the previous tooth, and the force is F = −a H(φ) Δ.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import accumulate, chain, pairwise

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.errors import InvalidInput

ROUNDED = 1e-3  # rad: a cut that ends this near to 0 or π ends there, as π may be given as 3.1416
LEAST_PIECE = 1e-9  # of a turn of the pattern: a shorter piece of the cut is rounding
LEAST = math.radians(0.999)  # least pitch
FULL = 1e-6  # rad: tolerance of the sum of pitches
STRAIGHT = 1e-7  # rad: a mean along an edge of smaller lag would be rounding
SPREAD = 0.05  # rad, over which forces at an end of contact are spread
NONE = 1e-9  # sine of an angle at which a chip has no thickness
ALIKE = 1e-12  # rad, m: pitches and run-outs that differ by less are equal


@dataclass(frozen=True, slots=True)
class Cut:
    """Cut by ``teeth`` of one helix, cutting coefficients [Pa], ``entry`` and ``exit`` [rad].

    ``lag`` [rad]: angle of the end of an edge behind its tip. ``pitches`` [rad]: from each tooth
    to the one that cut before it, in the order in which they cut; none if all are equal.
    ``runout`` [m]: radial run-out of each tooth; none if all are equal. ``edges``: tangential
    and radial forces of edges by length over the feed of a radian [Pa rad], which follow the
    vibration where chips begin or end with no thickness.
    """

    teeth: int
    tangential: float
    radial: float
    entry: float
    exit: float
    lag: float = 0.0
    pitches: tuple[float, ...] = ()
    runout: tuple[float, ...] = ()
    edges: tuple[float, float] = (0.0, 0.0)

    @property
    def gaps(self) -> tuple[float, ...]:
        """Pitches [rad] of the shortest pattern that repeats around the cutter; one pitch if teeth
        are evenly spaced with equal run-out."""
        if not (self.pitches or self.runout):
            return (2.0 * math.pi / self.teeth,)
        pitches = self.pitches or (2.0 * math.pi / self.teeth,) * self.teeth
        return pitches[: _pattern_size(pitches, self.runout or (0.0,) * self.teeth)]

    @property
    def even(self) -> bool:
        """Whether the teeth are evenly spaced and of equal run-out."""
        return len(self.gaps) == 1

    @property
    def turn(self) -> float:
        """Angle [rad] after which the pattern of teeth repeats: the pitch of evenly spaced ones."""
        return math.fsum(self.gaps)

    @property
    def interruption(self) -> float:
        """Period over the time in which some tooth cuts: limits of short cuts grow with it."""
        return self.turn / sum(high - low for low, high in self.pieces())

    def without(self, idle: Collection[int]) -> Cut:
        """Return the cutter with the other teeth of its pattern, without run-out: they cut what the
        ``idle`` ones leave."""
        count = len(self.gaps)
        first = next(tooth for tooth in range(count) if tooth not in idle)
        pitches, since = [], 0.0
        for tooth in range(first + 1, first + 1 + self.teeth):
            since += self.gaps[tooth % count]
            if tooth % count not in idle:
                pitches.append(since)
                since = 0.0
        return replace(self, teeth=len(pitches), pitches=tuple(pitches), runout=())

    def mean(self) -> Array:
        """Return the mean of H of all teeth (2, 2) [Pa]; lag and pitches do not change it."""
        integral = self.swept(np.array(self.exit)) - self.swept(np.array(self.entry))
        return integral * self.teeth / (2.0 * math.pi)

    @property
    def ends(self) -> list[tuple[float, float]]:
        """Spans of angle next to a start or end of chips with no thickness, over which edge forces
        that follow the vibration are spread."""
        if self.edges == (0.0, 0.0):
            return []
        width = min(SPREAD, 0.5 * (self.exit - self.entry))
        spans = (self.entry, self.entry + width), (self.exit - width, self.exit)
        return [span for span in spans if math.sin(span[0]) < NONE or math.sin(span[1]) < NONE]

    def pieces(self) -> list[tuple[float, float]]:
        """Return spans of the first tooth's angle, within one turn of the pattern, in which some
        tooth cuts and H is smooth."""
        ends = np.array([self.entry, self.exit, *chain(*self.ends)])
        ends = np.concatenate([ends, ends + self.lag])
        ends = (ends[:, None] - self.behind).ravel()
        ends = np.unique(self.entry + np.mod(ends - self.entry, self.turn))
        ends = np.append(ends, self.entry + self.turn)
        spans = pairwise(ends.tolist())
        return [
            (low, high)
            for low, high in spans
            if high - low > LEAST_PIECE * self.turn
            and self.in_cut(np.array([0.5 * (low + high)]))[0]
        ]

    def in_cut(self, angle: Array) -> Flags:
        """Return whether some tooth cuts with the first one at ``angle`` (n,)."""
        return np.asarray(self.cutting(self.standing(angle)).any(axis=(0, 1)))

    def matrix(self, angle: Array) -> Array:
        """Return H of all teeth (n, 2, 2) [Pa] with the first one at ``angle`` (n,)."""
        return np.asarray(self.by_gap(angle).sum(axis=0))

    def by_gap(self, angle: Array, which: int | None = None) -> Array:
        """Return H of the teeth behind each of the ``gaps`` (gaps, n, 2, 2) [Pa]; ``which``: of
        those behind one gap (n, 2, 2)."""
        at = self.standing(angle) if which is None else self.standing(angle)[:, which]
        if self.lag > STRAIGHT:
            # mean of H along the edge, of which a part is in cut
            begin, end = np.maximum(at - self.lag, self.entry), np.minimum(at, self.exit)
            coefficients = (self.swept(end) - self.swept(begin)) / self.lag
        else:
            coefficients = self.one_tooth(at)
        coefficients = np.where(self.cutting(at)[..., None, None], coefficients, 0.0)
        if self.ends:
            gap = np.array(self.gaps) if which is None else np.array(self.gaps[which : which + 1])
            coefficients += self._end_density(at)[..., None, None] * self._end_forces(gap)
        return np.asarray(coefficients.sum(axis=0))

    def _end_density(self, at: Array) -> Array:
        """Return the density [1/rad] of ends of contact along edges, at angles of teeth (…)."""
        density = np.zeros(at.shape)
        for low, high in self.ends:
            if self.lag > STRAIGHT:
                part = np.clip(at, low, high) - np.clip(at - self.lag, low, high)
                density += part / (self.lag * (high - low))
            else:
                density += ((at > low) & (at < high)) / (high - low)
        return density

    def _end_forces(self, gap: Array) -> Array:
        """Return forces (gaps, 1, 2, 2) at an end by displacement since a ``gap`` (gaps,) [rad]."""
        matrix = np.array([[0.0, self.edges[0]], [0.0, self.edges[1]]])
        return np.asarray(matrix / gap[:, None, None, None])

    def cutting(self, at: Array) -> Flags:
        """Return whether some part of the edge of a tooth at ``at`` is in cut."""
        return np.asarray((at > self.entry) & (at - self.lag < self.exit))

    @property
    def behind(self) -> Array:
        """Angles of the teeth relative to the first one (gaps,) [rad], from 0 down."""
        return -np.array([*accumulate(self.gaps[1:], initial=0.0)])

    def standing(self, angle: Array) -> Array:
        """Return angles of all teeth (turns, gaps, n), also past exit while edges are in cut."""
        turns = np.arange(-1, math.ceil((math.pi + self.lag) / self.turn) + 1)
        return angle + (turns[:, None] * self.turn + self.behind)[..., None]

    def one_tooth(self, angle: Array) -> Array:
        """Return H of one tooth in cut (…, 2, 2)."""
        s, c = np.sin(angle), np.cos(angle)
        x, y = self.tangential * c + self.radial * s, self.radial * c - self.tangential * s
        return np.stack([np.stack([x * s, x * c], -1), np.stack([y * s, y * c], -1)], -2)

    def swept(self, angle: Array) -> Array:
        """Return the antiderivative of H of one tooth (…, 2, 2)."""
        s2, c2, half = np.sin(2.0 * angle) / 4.0, np.cos(2.0 * angle) / 4.0, 0.5 * angle
        t, r = self.tangential, self.radial
        return np.stack(
            [
                np.stack([-t * c2 + r * (half - s2), t * (half + s2) - r * c2], -1),
                np.stack([-r * c2 - t * (half - s2), r * (half + s2) + t * c2], -1),
            ],
            -2,
        )


@lru_cache
def _pattern_size(*values: tuple[float, ...]) -> int:
    """Return the number of teeth of the shortest pattern that repeats around the cutter."""
    teeth = np.array(values)
    count = teeth.shape[1]
    return next(
        k
        for k in range(1, count + 1)
        if count % k == 0 and (np.abs(teeth - np.roll(teeth, k, axis=1)) < ALIKE).all()
    )


def checked(cut: Cut) -> Cut:
    """Return a valid cut, with an entry near 0 and an exit near π set to these values.

    Raises
    ------
    InvalidInput : no tooth, entry after exit, more than half a turn in cut, or a negative
        coefficient
    """
    if cut.teeth < 1:
        raise InvalidInput(f"teeth: given {cut.teeth}; allowed: at least 1")
    if cut.pitches:
        total, least = math.fsum(cut.pitches), min(cut.pitches)
        if len(cut.pitches) != cut.teeth or abs(total - 2.0 * math.pi) > FULL or least < LEAST:
            raise InvalidInput(
                f"pitch: given {len(cut.pitches)} angles from {math.degrees(least):.6g}°, "
                f"{math.degrees(total):.6g}° in total; allowed: one for each of {cut.teeth} teeth, "
                f"from {math.degrees(LEAST):g}°, 360° in total"
            )
    if abs(cut.entry) < ROUNDED:
        cut = replace(cut, entry=0.0)
    if abs(cut.exit - math.pi) < ROUNDED:
        cut = replace(cut, exit=math.pi)
    if not 0.0 <= cut.entry < cut.exit <= math.pi:
        raise InvalidInput(
            f"entry and exit: given {cut.entry:.6g} and {cut.exit:.6g} rad; allowed: entry before "
            "exit, both from 0 to π, from the normal towards the feed"
        )
    if not cut.pieces():
        raise InvalidInput(
            f"entry and exit: given {cut.exit - cut.entry:.6g} rad in cut, too short to differ "
            f"from zero; allowed: from {LEAST_PIECE:g} of the angle between teeth"
        )
    if not (cut.tangential > 0.0 and cut.radial >= 0.0):
        raise InvalidInput(
            f"cutting coefficients: given {cut.tangential:.6g} and {cut.radial:.6g} Pa; allowed: "
            "tangential above 0, radial from 0"
        )
    return cut
