"""Spans of the period in which teeth cut, and polynomials over them.

Cutting forces are zero where no tooth cuts and smooth elsewhere. They are expanded in orthonormal
Legendre polynomials over each span, which converge exponentially, whereas truncated harmonics
converge with a low order.

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

from rotordyn.analyses.stability_lobes.bessel import spherical_bessel
from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.errors import InvalidInput

Receptance = Callable[[Array], Complex]
_gauss = lru_cache(np.polynomial.legendre.leggauss)
SPARE = 12  # polynomials: from waves just resolved to errors of rounding
SHORTEST = 1e-12  # of a period: a shorter part of two spans in common is rounding
ROUNDED = 1e-15  # of the largest pivot: a smaller one is rounding
TAIL = 60.0  # rad: least phase over half a span up to which harmonics are summed
MASSIVE = 30.0  # times the highest frequency: harmonics beyond it change limits by 1e-8
NEGLIGIBLE = 1e-10  # size of a polynomial beyond the waves of its span that is truncated


class Thickness(NamedTuple):
    """Dynamic chip thickness w = now u − before c, by the displacement u (2p,) of a period and
    c = ``kept`` u of the previous period; forces are −depth · ``forces`` w.

    ``forces`` (2p, r), ``now`` (r, 2p), ``before`` (r, q), ``kept`` (q, 2p).
    """

    forces: Array
    now: Array
    before: Array
    kept: Array


class _Part(NamedTuple):
    """Gauss points of a part of a span, at ``angle`` (n,) and with ``weight`` (n,) [rad], in which
    the teeth behind the gap ``which`` cut the surface left in an ``earlier`` span, at
    ``past`` (n,), of the ``last`` period (1) or of the same one (0)."""

    span: int
    earlier: int
    which: int
    last: int
    angle: Array
    past: Array
    weight: Array


@dataclass(frozen=True)
class Spans:
    """Spans of a ``cut`` with a ``period`` [s], of the teeth or of an uneven pattern of teeth, of a
    machine whose receptance matters up to ``top`` [rad/s]; ``spare``: polynomials beyond those that
    its waves need."""

    cut: Cut
    period: float
    top: float
    spare: int = SPARE

    @cached_property
    def each(self) -> list[tuple[float, float, int]]:
        """Centre and half length of each span, over the period, and its number of polynomials
        (centre, half length, count)."""
        turn, spans = self.cut.turn, []
        for low, high in self.cut.pieces():
            half = 0.5 * (high - low) / turn
            phase = self.top * self.period * half
            count = math.ceil(phase) + self.spare
            if not self.cut.even:  # whose spans may be short
                count = min(count, _polynomials(phase + (high - low)))
            spans.append((0.5 * (low + high) / turn, half, count))
        return spans

    @cached_property
    def places(self) -> list[slice]:
        """Slices of the polynomials of every span among all."""
        ends = accumulate((count for *_, count in self.each), initial=0)
        return [slice(low, high) for low, high in pairwise(ends)]

    @property
    def size(self) -> int:
        """Number p of polynomials in all spans."""
        return sum(count for *_, count in self.each)

    @cached_property
    def order(self) -> Indices:
        """Orders (k,) of the harmonics that matter, symmetric about −1/2."""
        shortest = min(half for _, half, _ in self.each)
        highest = max(self.top * self.period, TAIL / shortest)
        if not self.cut.even:  # far above all modes the tip is a mass, which hardly moves
            highest = min(highest, MASSIVE * self.top * self.period)
        most = math.ceil(highest / (2.0 * math.pi)) + 2
        return np.arange(-most - 1, most + 1)

    def between(self, cut: Cut) -> Array:
        """Return the Galerkin matrix (2p, 2p) [Pa] of H of a cut with these spans."""
        size = self.size
        matrix = np.zeros((size, 2, size, 2))
        for (centre, half, count), at in zip(self.each, self.places, strict=True):
            x, weight = _gauss(count + 12)
            basis = _legendre(x, count)
            matrix[at, :, at] = _galerkin(
                basis * weight, cut.matrix((centre + half * x) * cut.turn), basis
            )
        return matrix.reshape(2 * size, 2 * size)

    @cached_property
    def delayed(self) -> tuple[Array, Array]:
        """Galerkin matrices (2p, 2p) [Pa] of H on the displacement at the previous tooth's cut, in
        the same period and in the last one."""
        size = self.size
        if self.cut.even:
            return np.zeros((2 * size, 2 * size)), self.cutting
        matrices, parts = np.zeros((2, size, 2, size, 2)), list(self._overlaps())
        angle, many = np.concatenate([part.angle for part in parts]), [p.angle.size for p in parts]
        which, force = np.repeat([part.which for part in parts], many), np.empty((sum(many), 2, 2))
        for gap in range(len(self.cut.gaps)):
            force[which == gap] = self.cut.by_gap(angle[which == gap], gap)
        most = max(count for *_, count in self.each)
        left, right = (
            _legendre(np.concatenate([self._coordinate(*values) for values in at]), most)
            for at in ([(p.span, p.angle) for p in parts], [(p.earlier, p.past) for p in parts])
        )
        ends = pairwise(accumulate(many, initial=0))
        for part, (low, high) in zip(parts, ends, strict=True):
            (_, half, count), (*_, other) = self.each[part.span], self.each[part.earlier]
            share = part.weight / (half * self.cut.turn)
            matrices[part.last, self.places[part.span], :, self.places[part.earlier]] += _galerkin(
                left[:count, low:high] * share, force[low:high], right[:other, low:high]
            )
        same, last_period = matrices.reshape(2, 2 * size, 2 * size)
        return same, last_period

    def _overlaps(self) -> Iterator[_Part]:
        """Yield parts of spans in which a tooth cuts the surface left in one of the spans."""
        turn = self.cut.turn
        ends = [(turn * (c - h), turn * (c + h)) for c, h, _ in self.each]
        for (which, gap), last in product(enumerate(self.cut.gaps), (0, 1)):
            shift = gap - last * turn  # to the previous tooth's cut
            for (k, span), (j, earlier) in product(enumerate(ends), repeat=2):
                low, high = max(span[0], earlier[0] + shift), min(span[1], earlier[1] + shift)
                if high - low <= SHORTEST * turn:
                    continue
                x, weight = _gauss((self.each[k][2] + self.each[j][2]) // 2 + 12)
                half = 0.5 * (high - low)
                angle = 0.5 * (low + high) + half * x
                yield _Part(k, j, which, last, angle, angle - shift, half * weight)

    def _coordinate(self, k: int, angle: Array) -> Array:
        """Return angles as coordinates −1 … 1 of a span."""
        centre, half, _ = self.each[k]
        return (angle / self.cut.turn - centre) / half

    @cached_property
    def cutting(self) -> Array:
        """Galerkin matrix (2p, 2p) [Pa] of H of the cut."""
        return self.between(self.cut)

    @cached_property
    def thickness(self) -> Thickness:
        """Low-rank cutting forces: while one tooth cuts, they have one direction at a time, so that
        r is little above p."""
        same, last = self.delayed
        if self.cut.even:
            forces, chip = factors(self.cutting)
            return Thickness(forces, chip, np.eye(len(chip)), chip)
        forces, chip = factors(np.hstack([self.cutting - same, last]))
        return Thickness(forces, chip[:, : len(same)], *factors(chip[:, len(same) :]))

    @cached_property
    def halves(self) -> Array:
        """Half length (p,) of the span of each polynomial, over the period."""
        return np.concatenate([np.full(count, half) for _, half, count in self.each])

    def coefficients(self, angle: Array) -> Complex:
        """Return Fourier coefficients (…, p), at frequency times period ``angle`` (…), of the
        polynomials, which are orthonormal over −1 … 1 of their spans."""
        parts = []
        for centre, half, count in self.each:
            bessel = spherical_bessel(angle * half, count)
            order = np.arange(count)
            scale = half * np.sqrt(2.0 * (2 * order + 1)) * (-1j) ** order
            parts.append(bessel * scale * np.exp(-1j * angle * centre)[..., None])
        return np.concatenate(parts, axis=-1)

    def chatter(self, receptance: Receptance, angle: float, force: Complex) -> float:
        """Return the frequency [Hz], up to ``top``, of the largest motion of the tip by forces
        (2p,) e^{i angle t/T}."""
        most = math.ceil(self.top * self.period / (2.0 * math.pi)) + 2
        along: Array = angle + 2.0 * math.pi * np.arange(-most - 1.0, most + 1.0)
        values = both_signs(receptance, along / self.period)
        motion = (values @ (self.coefficients(along) @ force.reshape(-1, 2))[:, :, None])[:, :, 0]
        place = int(np.linalg.norm(motion, axis=1).argmax())
        return float(abs(along[place])) / (2.0 * math.pi * self.period)


def refuse_waves(spans: Spans, most: int) -> None:
    """Refuse a cut that needs more than ``most`` polynomials, whose matrices take minutes."""
    if spans.size > most:
        hertz = spans.top / 2.0 / math.pi
        if not spans.cut.even:
            raise InvalidInput(
                f"pitch: forces of {len(spans.cut.gaps)} uneven teeth with modes up to {hertz:.5g} "
                f"Hz need {spans.size} polynomials; allowed: {most}: raise the speed, take the "
                "method zero-order, or leave those modes out (max_frequency of a case)"
            )
        raise InvalidInput(
            f"speed: while a tooth cuts, the highest mode, up to {hertz:.5g} Hz, has "
            f"{spans.size / math.pi:.0f} waves; allowed: {most / math.pi:.0f}: raise the speed, "
            "take the method zero-order, or leave that mode out (max_frequency of a case)"
        )


def factors(matrix: Array) -> tuple[Array, Array]:
    """Factor a matrix (n, m) of low rank, n ≤ m, into a product (n, r) by (r, m)."""
    from scipy.linalg import qr

    left, right, order = qr(matrix, pivoting=True, check_finite=False)
    kept = np.abs(right.diagonal()) > ROUNDED * abs(right[0, 0])
    return left[:, kept], right[kept][:, np.argsort(order)]


def both_signs(receptance: Receptance, omega: Array) -> Complex:
    """Return receptance (…, 2, 2) at frequencies (…) of either sign: at −ω it is the conjugate."""
    values = receptance(np.abs(omega).ravel()).reshape(*omega.shape, 2, 2)
    return np.where((omega < 0.0)[..., None, None], values.conj(), values)


def _polynomials(phase: float) -> int:
    """Return the number of polynomials over a span that waves cross by 2 ``phase`` [rad]."""
    count, share = 2, phase**2 / 15.0
    while count <= phase or share > NEGLIGIBLE:
        count += 1
        share *= phase / (2.0 * count + 1.0)
    return count


def _galerkin(left: Array, force: Array, right: Array) -> Array:
    """Return ∫ left force right (m, 2, k, 2) of weighted polynomials (m, n) and others (k, n), by
    values at n points, with ``force`` (n, 2, 2)."""
    acting = force[:, :, None, :] * right.T[:, None, :, None]
    return (left @ acting.reshape(len(force), -1)).reshape(len(left), 2, len(right), 2)


def _legendre(x: Array, count: int) -> Array:
    """Return orthonormal Legendre polynomials over −1 … 1 (count, n)."""
    scale = np.sqrt(np.arange(count) + 0.5)
    return (np.polynomial.legendre.legvander(x, count - 1) * scale).T
