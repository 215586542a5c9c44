"""Multi-frequency stability of milling at one speed.

The forces F(t) = e^{iωt} Σ F_k e^{ikω_T t} over all harmonics of the tooth frequency are a periodic
function; it is not zero only where teeth cut, and there it is smooth. It is expanded in Legendre
polynomials over each span of the cut, whose Fourier coefficients are spherical Bessel functions.
The result is that of infinitely many harmonics of the form of Budak and Altintas (1998), and it
converges exponentially where truncated harmonics converge with a low order.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.cutting import Cut

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Receptance = Callable[[Array], Complex]
SPARE = 6  # polynomials more than a wave at the highest frequency needs
TAIL = 20.0  # at least so far above zero harmonics are summed, as phase over half a span


@dataclass(frozen=True)
class Harmonics:
    """The cut at one tooth ``period`` [s] of a machine whose receptance matters up to ``top``
    [rad/s]."""

    cut: Cut
    period: float
    top: float

    @cached_property
    def order(self) -> NDArray[np.intp]:
        """Harmonics summed, as many to both sides of the middle of 0 and −1 (k,)."""
        shortest = min(half for _, half, _ in self.spans)
        highest = max(self.top * self.period, TAIL / shortest)
        most = math.ceil(highest / (2.0 * math.pi)) + 2
        return np.arange(-most - 1, most + 1)

    @cached_property
    def spans(self) -> list[tuple[float, float, int]]:
        """Centre and half length of the spans of the cut over the pitch, and how many polynomials
        (centre, half length, count)."""
        pitch, found = self.cut.pitch, []
        for low, high in self.cut.pieces():
            half = 0.5 * (high - low) / pitch
            count = math.ceil(self.top * self.period * half) + SPARE
            found.append((0.5 * (low + high) / pitch, half, count))
        return found

    @cached_property
    def cutting(self) -> Array:
        """H between the polynomials (p, 2, p, 2) [Pa]."""
        size = sum(count for *_, count in self.spans)
        found, at = np.zeros((size, 2, size, 2)), 0
        for centre, half, count in self.spans:
            x, weight = np.polynomial.legendre.leggauss(count + 12)
            basis = _legendre(x, count)
            matrix = self.cut.matrix((centre + half * x) * self.cut.pitch)
            own = slice(at, at + count)
            found[own, :, own] = np.einsum("lq,q,qij,mq->limj", basis, weight, matrix, basis)
            at += count
        return found

    def coefficients(self, angle: Array) -> Complex:
        """Fourier coefficients at frequencies times period ``angle`` (…) of the orthonormal
        polynomials (…, p)."""
        found = []
        for centre, half, count in self.spans:
            bessel = spherical_bessel(angle * half, count)
            order = np.arange(count)
            scale = np.sqrt(2.0 * half * (2 * order + 1)) * (-1j) ** order
            found.append(bessel * scale * np.exp(-1j * angle * centre)[..., None])
        return np.concatenate(found, axis=-1)

    def motion(self, receptance: Receptance, angle: Array) -> Complex:
        """Motion from tooth to tooth by the forces, between polynomials (n, p, 2, p, 2) [m/N] at
        ``angle`` ωT (n,)."""
        at = angle[:, None] + 2.0 * math.pi * self.order
        own = both_signs(receptance, at / self.period)
        basis = self.coefficients(at)
        n, p = len(angle), basis.shape[-1]
        found = np.empty((n, p, 2, p, 2), dtype=complex)
        back = np.swapaxes(basis, 1, 2).conj()
        for i in range(2):
            for j in range(2):
                found[:, :, i, :, j] = (back * own[:, None, :, i, j]) @ basis
        return found * (1.0 - np.exp(-1j * angle))[:, None, None, None, None]

    def matrix(self, receptance: Receptance, angle: Array) -> Complex:
        """−H times the motion (n, 2p, 2p): its eigenvalues z on the positive real axis are 1/a."""
        motion = self.motion(receptance, angle)
        n, p = len(angle), motion.shape[1]
        cutting = self.cutting.reshape(2 * p, 2 * p)
        return -(cutting @ motion.reshape(n, 2 * p, 2 * p))

    def eigenvalues(self, receptance: Receptance, angle: Array) -> Complex:
        """(n, 2p)"""
        return np.asarray(np.linalg.eigvals(self.matrix(receptance, angle)), dtype=complex)

    def chatter(self, receptance: Receptance, angle: float, value: float) -> float:
        """Frequency [Hz] at which the tip moves most, of the eigenvalue nearest to ``value``."""
        at = np.array([angle])
        z, vectors = np.linalg.eig(self.matrix(receptance, at)[0])
        force = vectors[:, np.abs(z - value).argmin()].reshape(-1, 2)
        along: Array = angle + 2.0 * math.pi * self.order.astype(float)
        own = both_signs(receptance, along / self.period)
        motion = (own @ (self.coefficients(along) @ force)[:, :, None])[:, :, 0]
        place = int(np.linalg.norm(motion, axis=1).argmax())
        return float(abs(along[place])) / (2.0 * math.pi * self.period)


def both_signs(receptance: Receptance, omega: Array) -> Complex:
    """Receptance (…, 2, 2) at frequencies of either sign (…): that at −ω is the conjugate."""
    own = receptance(np.abs(omega).ravel()).reshape(*omega.shape, 2, 2)
    return np.where((omega < 0.0)[..., None, None], own.conj(), own)


def _legendre(x: Array, count: int) -> Array:
    """Orthonormal polynomials over −1 … 1 (count, n)."""
    scale = np.sqrt(np.arange(count) + 0.5)
    return (np.polynomial.legendre.legvander(x, count - 1) * scale).T


def spherical_bessel(x: Array, count: int) -> Array:
    """Of the first kind, orders 0 … count − 1 (…, count), by recurrence: upward where x is beyond
    the order, else downward from far above (Miller)."""
    size = np.abs(x).ravel()
    found = np.empty((count, size.size))
    up = size > count
    found[:, up] = _upward(size[up], count)
    found[:, ~up] = _downward(size[~up], count)
    sign = np.where(x.ravel() < 0.0, -1.0, 1.0)
    found[1::2] *= sign
    return found.T.reshape(*x.shape, count)


def _upward(x: Array, count: int) -> Array:
    found = np.empty((max(count, 2), x.size))
    found[0] = np.sin(x) / x
    found[1] = (found[0] - np.cos(x)) / x
    for order in range(1, count - 1):
        found[order + 1] = (2 * order + 1) / x * found[order] - found[order - 1]
    return found[:count]


def _downward(x: Array, count: int) -> Array:
    found = np.zeros((count + 1, x.size))
    small = x < 1e-8
    x = np.where(small, 1e-8, x)
    above, own = np.zeros(x.size), np.full(x.size, 1e-250)
    for order in range(count + 24, -1, -1):
        if order <= count:
            found[order] = own
        above, own = own, (2 * order + 1) / x * own - above
        large = np.abs(own) > 1e100
        if large.any():
            own, above = np.where(large, own * 1e-150, own), np.where(large, above * 1e-150, above)
            found[order:, large] *= 1e-150
    first, second = np.sin(x) / x, (np.sin(x) / x - np.cos(x)) / x
    larger = np.abs(found[0]) >= np.abs(found[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = np.where(larger, first / found[0], second / found[1])
    found *= scale
    found[0, small], found[1:, small] = 1.0, 0.0
    return found[:count]
