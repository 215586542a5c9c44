"""Spans of the period of the cut in which teeth cut, and functions over them.

Forces of the cut are zero where no tooth cuts and smooth in between. They are expanded in
orthonormal Legendre polynomials over each span, which converges exponentially, where truncated
harmonics converge with a low order.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate, pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.bessel import spherical_bessel
from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.errors import InvalidInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Receptance = Callable[[Array], Complex]
_gauss = lru_cache(np.polynomial.legendre.leggauss)
SPARE = 12  # polynomials: from waves resolved to rounding
SHORTEST = 1e-12  # of a period: a shorter part of two spans in common is rounding
ROUNDED = 1e-15  # of the largest pivot: a smaller one is rounding
TAIL = 60.0  # at least so far above zero harmonics are summed, as phase over half a span
MASSIVE = 30.0  # times the highest frequency: limits change by 1e-8
NEGLIGIBLE = 1e-10  # a polynomial beyond the waves of its span that takes less is left out


class Thickness(NamedTuple):
    """What teeth feel of the displacement u (2p,) of a period: w = now u − before c, where c =
    ``kept`` u of the period before; forces are −depth · ``forces`` w.

    ``forces`` (2p, r), ``now`` (r, 2p), ``before`` (r, q), ``kept`` (q, 2p).
    """

    forces: Array
    now: Array
    before: Array
    kept: Array


class _Part(NamedTuple):
    """Gauss points of a part of the span ``here``, at ``angle`` (n,) and with ``weight`` (n,)
    [rad], in which the teeth behind the gap ``which`` cut what was left in the span ``there``, at
    the angle ``back`` (n,), of the ``last`` period (1) or of the same (0)."""

    here: int
    there: int
    which: int
    last: int
    angle: Array
    back: Array
    weight: Array


@dataclass(frozen=True)
class Spans:
    """The cut of a ``period`` [s], from tooth to tooth or over an uneven pattern of them, of a
    machine whose receptance matters up to ``top`` [rad/s]; ``spare``: polynomials more than its
    waves need."""

    cut: Cut
    period: float
    top: float
    spare: int = SPARE

    @cached_property
    def each(self) -> list[tuple[float, float, int]]:
        """Centre and half length of the spans of the cut over the period, and how many polynomials
        (centre, half length, count)."""
        turn, found = self.cut.turn, []
        for low, high in self.cut.pieces():
            half = 0.5 * (high - low) / turn
            phase = self.top * self.period * half
            count = math.ceil(phase) + self.spare
            if not self.cut.even:  # whose spans may be short
                count = min(count, _enough(phase + (high - low)))
            found.append((0.5 * (low + high) / turn, half, count))
        return found

    @cached_property
    def places(self) -> list[slice]:
        """Rows of every span among all polynomials."""
        ends = accumulate((count for *_, count in self.each), initial=0)
        return [slice(low, high) for low, high in pairwise(ends)]

    @property
    def size(self) -> int:
        """Polynomials in all spans p."""
        return sum(count for *_, count in self.each)

    @cached_property
    def order(self) -> NDArray[np.intp]:
        """Harmonics that matter, as many to both sides of the middle of 0 and −1 (k,)."""
        shortest = min(half for _, half, _ in self.each)
        highest = max(self.top * self.period, TAIL / shortest)
        if not self.cut.even:  # far above all modes the tip is a mass, which hardly moves
            highest = min(highest, MASSIVE * self.top * self.period)
        most = math.ceil(highest / (2.0 * math.pi)) + 2
        return np.arange(-most - 1, most + 1)

    def between(self, cut: Cut) -> Array:
        """Galerkin matrix of H between the polynomials (2p, 2p) [Pa], of a cut with these spans."""
        size = self.size
        found = np.zeros((size, 2, size, 2))
        for (centre, half, count), at in zip(self.each, self.places, strict=True):
            x, weight = _gauss(count + 12)
            basis = _legendre(x, count)
            found[at, :, at] = _galerkin(
                basis * weight, cut.matrix((centre + half * x) * cut.turn), basis
            )
        return found.reshape(2 * size, 2 * size)

    @cached_property
    def delayed(self) -> tuple[Array, Array]:
        """What of H acts on the displacement when the tooth before cut there, in the same period
        and in the last one (2p, 2p) each [Pa]."""
        size = self.size
        if self.cut.even:
            return np.zeros((2 * size, 2 * size)), self.cutting
        found, parts = np.zeros((2, size, 2, size, 2)), list(self._in_common())
        angle, many = np.concatenate([part.angle for part in parts]), [p.angle.size for p in parts]
        which, force = np.repeat([part.which for part in parts], many), np.empty((sum(many), 2, 2))
        for gap in range(len(self.cut.gaps)):
            force[which == gap] = self.cut.by_gap(angle[which == gap], gap)
        most = max(count for *_, count in self.each)
        left, right = (
            _legendre(np.concatenate([self._place(*each) for each in at]), most)
            for at in ([(p.here, p.angle) for p in parts], [(p.there, p.back) for p in parts])
        )
        ends = pairwise(accumulate(many, initial=0))
        for part, (low, high) in zip(parts, ends, strict=True):
            (_, half, count), (*_, other) = self.each[part.here], self.each[part.there]
            share = part.weight / (half * self.cut.turn)
            found[part.last, self.places[part.here], :, self.places[part.there]] += _galerkin(
                left[:count, low:high] * share, force[low:high], right[:other, low:high]
            )
        same, last_period = found.reshape(2, 2 * size, 2 * size)
        return same, last_period

    def _in_common(self) -> Iterator[_Part]:
        """Parts of a span in which a tooth cuts what was left in another one, or in the same."""
        turn = self.cut.turn
        ends = [(turn * (c - h), turn * (c + h)) for c, h, _ in self.each]
        for (which, gap), last in product(enumerate(self.cut.gaps), (0, 1)):
            shift = gap - last * turn  # back to where the tooth before cut
            for (k, here), (j, there) in product(enumerate(ends), repeat=2):
                low, high = max(here[0], there[0] + shift), min(here[1], there[1] + shift)
                if high - low <= SHORTEST * turn:
                    continue
                x, weight = _gauss((self.each[k][2] + self.each[j][2]) // 2 + 12)
                half = 0.5 * (high - low)
                angle = 0.5 * (low + high) + half * x
                yield _Part(k, j, which, last, angle, angle - shift, half * weight)

    def _place(self, k: int, angle: Array) -> Array:
        """Angles on −1 … 1 of a span."""
        centre, half, _ = self.each[k]
        return (angle / self.cut.turn - centre) / half

    @cached_property
    def cutting(self) -> Array:
        """H of the cut itself between the polynomials (2p, 2p) [Pa]."""
        return self.between(self.cut)

    @cached_property
    def thickness(self) -> Thickness:
        """A tooth feels motion in one direction at a time: where one cuts, r is little above p."""
        same, last = self.delayed
        if self.cut.even:
            forces, chip = factors(self.cutting)
            return Thickness(forces, chip, np.eye(len(chip)), chip)
        forces, chip = factors(np.hstack([self.cutting - same, last]))
        return Thickness(forces, chip[:, : len(same)], *factors(chip[:, len(same) :]))

    @cached_property
    def halves(self) -> Array:
        """Half length of the span of each polynomial over the period (p,)."""
        return np.concatenate([np.full(count, half) for _, half, count in self.each])

    def coefficients(self, angle: Array) -> Complex:
        """Fourier coefficients at frequencies times period ``angle`` (…) of the polynomials
        (…, p), which are orthonormal over −1 … 1 of their spans."""
        found = []
        for centre, half, count in self.each:
            bessel = spherical_bessel(angle * half, count)
            order = np.arange(count)
            scale = half * np.sqrt(2.0 * (2 * order + 1)) * (-1j) ** order
            found.append(bessel * scale * np.exp(-1j * angle * centre)[..., None])
        return np.concatenate(found, axis=-1)

    def chatter(self, receptance: Receptance, angle: float, force: Complex) -> float:
        """Frequency [Hz] at which the tip moves most by forces (2p,) e^{i angle t/T}: one up to
        ``top``."""
        most = math.ceil(self.top * self.period / (2.0 * math.pi)) + 2
        along: Array = angle + 2.0 * math.pi * np.arange(-most - 1.0, most + 1.0)
        own = both_signs(receptance, along / self.period)
        motion = (own @ (self.coefficients(along) @ force.reshape(-1, 2))[:, :, None])[:, :, 0]
        place = int(np.linalg.norm(motion, axis=1).argmax())
        return float(abs(along[place])) / (2.0 * math.pi * self.period)


def refuse_waves(spans: Spans, most: int) -> None:
    """Refuse a cut that needs more than ``most`` polynomials, whose matrices take minutes."""
    if spans.size > most:
        hertz = spans.top / 2.0 / math.pi
        if not spans.cut.even:
            raise InvalidInput(
                f"pitch: forces of {len(spans.cut.gaps)} unlike teeth with modes up to {hertz:.5g} "
                f"Hz take {spans.size} polynomials; allowed: {most}: raise the speed, take the "
                "method zero-order, or leave those modes out (max_frequency of a case)"
            )
        raise InvalidInput(
            f"speed: while a tooth cuts, the highest mode, up to {hertz:.5g} Hz, has "
            f"{spans.size / math.pi:.0f} waves; allowed: {most / math.pi:.0f}: raise the speed, "
            "take the method zero-order, or leave that mode out (max_frequency of a case)"
        )


def factors(matrix: Array) -> tuple[Array, Array]:
    """A matrix (n, m) of low rank, n ≤ m, as a product (n, r) by (r, m)."""
    from scipy.linalg import qr

    left, right, order = qr(matrix, pivoting=True, check_finite=False)
    kept = np.abs(right.diagonal()) > ROUNDED * abs(right[0, 0])
    return left[:, kept], right[kept][:, np.argsort(order)]


def both_signs(receptance: Receptance, omega: Array) -> Complex:
    """Receptance (…, 2, 2) at frequencies of either sign (…): that at −ω is the conjugate."""
    own = receptance(np.abs(omega).ravel()).reshape(*omega.shape, 2, 2)
    return np.where((omega < 0.0)[..., None, None], own.conj(), own)


def _enough(phase: float) -> int:
    """Polynomials over a span that waves cross by twice the ``phase`` [rad], forces included."""
    count, share = 2, phase**2 / 15.0
    while count <= phase or share > NEGLIGIBLE:
        count += 1
        share *= phase / (2.0 * count + 1.0)
    return count


def _galerkin(left: Array, force: Array, right: Array) -> Array:
    """∫ left force right between weighted polynomials (m, n) and others (k, n) at points of a
    ``force`` (n, 2, 2): (m, 2, k, 2)."""
    acting = force[:, :, None, :] * right.T[:, None, :, None]
    return (left @ acting.reshape(len(force), -1)).reshape(len(left), 2, len(right), 2)


def _legendre(x: Array, count: int) -> Array:
    """Orthonormal polynomials over −1 … 1 (count, n)."""
    scale = np.sqrt(np.arange(count) + 0.5)
    return (np.polynomial.legendre.legvander(x, count - 1) * scale).T
