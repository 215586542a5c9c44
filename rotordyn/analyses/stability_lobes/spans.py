"""Spans of the tooth period in which teeth cut, and functions over them.

Forces of the cut are zero where no tooth cuts and smooth in between. They are expanded in
orthonormal Legendre polynomials over each span, which converges exponentially, where truncated
harmonics converge with a low order.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

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
ROUNDED = 1e-15  # of the largest pivot: a smaller one is rounding
TAIL = 60.0  # at least so far above zero harmonics are summed, as phase over half a span


@dataclass(frozen=True)
class Spans:
    """The cut at one tooth ``period`` [s] of a machine whose receptance matters up to ``top``
    [rad/s]; ``spare``: polynomials more than its waves need."""

    cut: Cut
    period: float
    top: float
    spare: int = SPARE

    @cached_property
    def each(self) -> list[tuple[float, float, int]]:
        """Centre and half length of the spans of the cut over the pitch, and how many polynomials
        (centre, half length, count)."""
        pitch, found = self.cut.pitch, []
        for low, high in self.cut.pieces():
            half = 0.5 * (high - low) / pitch
            count = math.ceil(self.top * self.period * half) + self.spare
            found.append((0.5 * (low + high) / pitch, half, count))
        return found

    @property
    def size(self) -> int:
        """Polynomials in all spans p."""
        return sum(count for *_, count in self.each)

    @cached_property
    def order(self) -> NDArray[np.intp]:
        """Harmonics that matter, as many to both sides of the middle of 0 and −1 (k,)."""
        shortest = min(half for _, half, _ in self.each)
        highest = max(self.top * self.period, TAIL / shortest)
        most = math.ceil(highest / (2.0 * math.pi)) + 2
        return np.arange(-most - 1, most + 1)

    def between(self, cut: Cut) -> Array:
        """Galerkin matrix of H between the polynomials (2p, 2p) [Pa], of a cut with these spans."""
        size = self.size
        found, at = np.zeros((size, 2, size, 2)), 0
        for centre, half, count in self.each:
            x, weight = _gauss(count + 12)
            basis = _legendre(x, count)
            matrix = cut.matrix((centre + half * x) * cut.pitch)
            right = matrix[:, :, None, :] * basis.T[:, None, :, None]
            own = (basis * weight) @ right.reshape(len(x), -1)
            found[at : at + count, :, at : at + count] = own.reshape(count, 2, count, 2)
            at += count
        return found.reshape(2 * size, 2 * size)

    @cached_property
    def cutting(self) -> Array:
        """H of the cut itself between the polynomials (2p, 2p) [Pa]."""
        return self.between(self.cut)

    @cached_property
    def thickness(self) -> tuple[Array, Array]:
        """``cutting`` as a product: forces by chip thickness (2p, r), that by displacement (r, 2p).

        A tooth feels motion in one direction at a time: where one cuts, r is little above p.
        """
        return factors(self.cutting)

    def coefficients(self, angle: Array) -> Complex:
        """Fourier coefficients at frequencies times period ``angle`` (…) of the orthonormal
        polynomials (…, p)."""
        found = []
        for centre, half, count in self.each:
            bessel = spherical_bessel(angle * half, count)
            order = np.arange(count)
            scale = np.sqrt(2.0 * half * (2 * order + 1)) * (-1j) ** order
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
        raise InvalidInput(
            f"speed: while a tooth cuts, the highest mode, up to {hertz:.5g} Hz, has "
            f"{spans.size / math.pi:.0f} waves; allowed: {most / math.pi:.0f}: raise the speed, "
            "take the method zero-order, or leave that mode out (max_frequency of a case)"
        )


def factors(matrix: Array) -> tuple[Array, Array]:
    """A square matrix (n, n) of low rank as a product (n, r) by (r, n)."""
    from scipy.linalg import qr

    left, right, order = qr(matrix, pivoting=True, check_finite=False)
    kept = np.abs(right.diagonal()) > ROUNDED * abs(right[0, 0])
    return left[:, kept], right[kept][:, np.argsort(order)]


def both_signs(receptance: Receptance, omega: Array) -> Complex:
    """Receptance (…, 2, 2) at frequencies of either sign (…): that at −ω is the conjugate."""
    own = receptance(np.abs(omega).ravel()).reshape(*omega.shape, 2, 2)
    return np.where((omega < 0.0)[..., None, None], own.conj(), own)


def _legendre(x: Array, count: int) -> Array:
    """Orthonormal polynomials over −1 … 1 (count, n)."""
    scale = np.sqrt(np.arange(count) + 0.5)
    return (np.polynomial.legendre.legvander(x, count - 1) * scale).T
