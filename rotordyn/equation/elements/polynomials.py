"""Polynomials that vanish at both ends of an element: integrated Legendre polynomials.

ψ_k = (P_k − P_(k−2)) / √(2 (2k − 1)), k ≥ 2, over ξ ∈ [−1, 1]; their slopes are orthonormal
(Szabó & Babuška, *Finite Element Analysis*, 1991).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from rotordyn.arrays import Array, Indices


def bubbles(last: int, xi: Array) -> tuple[Array, Array, Array]:
    """Return ∫ψ_k dξ from −1, ψ_k, and dψ_k/dξ for k = 2 … ``last`` at ``xi``, each (…, last − 1).

    The integral of ψ_k vanishes at ξ = 1, too, for k ≥ 3.
    """
    return _bubbles(last, xi.shape, xi.tobytes())


@lru_cache(maxsize=256)
def _bubbles(last: int, shape: tuple[int, ...], places: bytes) -> tuple[Array, Array, Array]:
    """Return read-only arrays, cached: the same few places recur."""
    xi, k = np.frombuffer(places).reshape(shape), np.arange(2, last + 1)
    p = np.asarray(legendre.legvander(xi, last + 1), dtype=np.float64)
    scale = np.sqrt(2.0 * (2.0 * k - 1.0))
    value = (p[..., 2:-1] - p[..., : last - 1]) / scale
    slope = p[..., 1:last] * np.sqrt((2.0 * k - 1.0) / 2.0)
    functions = (_integral(p, k) - _integral(p, k - 2)) / scale, value, slope
    for array in functions:
        array.flags.writeable = False
    return functions


def _integral(p: Array, degree: Indices) -> Array:
    """Return ∫ P_k dξ from −1."""
    lower = np.where(degree == 0, -p[..., :1], p[..., np.abs(degree - 1)])
    return np.asarray((p[..., degree + 1] - lower) / (2.0 * degree + 1.0))


@lru_cache(maxsize=64)
def points(degree: int) -> tuple[Array, Array]:
    """Return Gauss points on [−1, 1] and weights, exact up to ``degree``; read only."""
    rule = legendre.leggauss(degree // 2 + 1)
    for array in rule:
        array.flags.writeable = False
    return rule
