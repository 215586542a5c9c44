"""Spherical Bessel functions, of which Fourier and Laplace integrals of Legendre polynomials are
made."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


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


def modified_bessel(z: Complex, count: int) -> Complex:
    """e^z i_n(z) of Re z ≤ 0 for the orders 0 … count − 1 (…, count): half the integral of
    e^{z(1 + x)} P_n(x) over −1 … 1."""
    from scipy.special import ive

    order, z = np.arange(count), z[..., None]
    return np.asarray(np.sqrt(0.5 * np.pi / z) * ive(order + 0.5, z) * np.exp(1j * z.imag))
