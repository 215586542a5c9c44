"""Spherical Bessel functions: Fourier and Laplace integrals of Legendre polynomials."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex


def spherical_bessel(x: Array, count: int) -> Array:
    """Return spherical Bessel functions of the first kind, orders 0 … count − 1 (…, count), by
    recurrence: upward where x exceeds ``count``, else downward from a far higher order (Miller)."""
    size = np.abs(x).ravel()
    values = np.empty((count, size.size))
    use_upward = size > count
    values[:, use_upward] = _upward(size[use_upward], count)
    values[:, ~use_upward] = _downward(size[~use_upward], count)
    sign = np.where(x.ravel() < 0.0, -1.0, 1.0)
    values[1::2] *= sign
    return values.T.reshape(*x.shape, count)


def _upward(x: Array, count: int) -> Array:
    values = np.empty((max(count, 2), x.size))
    values[0] = np.sin(x) / x
    values[1] = (values[0] - np.cos(x)) / x
    for order in range(1, count - 1):
        values[order + 1] = (2 * order + 1) / x * values[order] - values[order - 1]
    return values[:count]


def _downward(x: Array, count: int) -> Array:
    values = np.zeros((count + 1, x.size))
    small = x < 1e-8
    x = np.where(small, 1e-8, x)
    above, j_n = np.zeros(x.size), np.full(x.size, 1e-250)
    for order in range(count + 24, -1, -1):
        if order <= count:
            values[order] = j_n
        above, j_n = j_n, (2 * order + 1) / x * j_n - above
        large = np.abs(j_n) > 1e100
        if large.any():
            j_n, above = np.where(large, j_n * 1e-150, j_n), np.where(large, above * 1e-150, above)
            values[order:, large] *= 1e-150
    first, second = np.sin(x) / x, (np.sin(x) / x - np.cos(x)) / x
    larger = np.abs(values[0]) >= np.abs(values[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = np.where(larger, first / values[0], second / values[1])
    values *= scale
    values[0, small], values[1:, small] = 1.0, 0.0
    return values[:count]


def modified_bessel(z: Complex, count: int) -> Complex:
    """Return e^z i_n(z), Re z ≤ 0, for the orders 0 … count − 1 (…, count): half the integral of
    e^{z(1 + x)} P_n(x) over −1 … 1."""
    from scipy.special import ive

    order, z = np.arange(count), z[..., None]
    return np.asarray(np.sqrt(0.5 * np.pi / z) * ive(order + 0.5, z) * np.exp(1j * z.imag))
