"""Zero-order stability (Altintas and Budak 1995): the mean of the cutting forces over the tooth
period, and one frequency of vibration. Exact where the cutting forces do not change with the angle.

At a depth a and a frequency ω on the limit 1/a is an eigenvalue of Z = −(1 − e^{−iωT}) Φ(iω) H̄, so
that the lobes need not be counted and every speed has its own receptance. Of unevenly spaced teeth
the factor is the mean over their delays T. Process damping adds −iω Φ(iω) C̄.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Rows = Callable[[Array], Complex]
CANDIDATES = 4  # crossings of a speed that are refined at a time, what may be largest first
BULGE = 0.1  # of the chord between two samples: an arc of the phase between them bulges by 0.025
STEPS = 30
LEAST = 1e-4  # of the largest eigenvalue: a smaller crossing limits no depth that is cut


class Mean(NamedTuple):
    """Mean forces of a unit of depth, each (1 or s, e, d) of e forces by d motions: by displacement
    from tooth to tooth ``cutting`` [Pa], by velocity ``rubbing`` [N s/m²]."""

    cutting: Array
    rubbing: Array


def zero_order(
    receptances: Rows, mean: Mean, delays: Array, omega: Array, sampled: Rows | None = None
) -> tuple[Array, Array]:
    """Depth [m], infinite where nothing limits it, and chatter frequency [rad/s] of every speed
    (s,).

    ``receptances`` of frequencies (s, f): (s, f, d, e); ``delays`` from tooth to tooth (s, gaps)
    [s];
    ``omega`` (s, f) ascending samples [rad/s]; ``sampled``: an approximation of the receptances
    that costs less, in which crossings are looked for.
    """
    near = receptances if sampled is None else sampled
    z = _followed(_eigenvalues(near(omega), mean, delays, omega))
    low, high = z[:, :-1], z[:, 1:]
    chord, highest = np.abs(high - low), np.maximum(low.real, high.real)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = low.real + low.imag / (low.imag - high.imag) * (high.real - low.real)
        slant = chord / np.abs(low.imag - high.imag)  # the flatter, the farther a bulge reaches
        bound = np.minimum(crossing + BULGE * chord * slant, highest + BULGE * chord)
    bound = np.where(low.imag * high.imag < 0.0, bound, 0.0).reshape(len(z), -1)
    order, rows = np.argsort(-bound, axis=1), np.arange(len(z))[:, None]
    value, at = LEAST * np.abs(z).max(axis=(1, 2)), np.full(len(z), np.nan)
    for first in range(0, order.shape[1], CANDIDATES):
        chosen = order[:, first : first + CANDIDATES]
        if not (bound[rows, chosen] > value[:, None]).any():
            break
        k, branch = np.divmod(chosen, z.shape[2])
        ends = omega[rows, k], omega[rows, k + 1], z[rows, k, branch], z[rows, k + 1, branch]
        frequencies, values = _roots(receptances, mean, delays, ends)
        values = np.where(bound[rows, chosen] > 0.0, values, 0.0)
        best = values.argmax(axis=1)[:, None]
        found, where = (np.take_along_axis(a, best, axis=1)[:, 0] for a in (values, frequencies))
        value, at = np.where(found > value, (found, where), (value, at))
    depth = np.full(len(z), np.inf)
    known = np.isfinite(at)
    depth[known] = 1.0 / value[known]
    return depth, at


def _eigenvalues(receptance: Complex, mean: Mean, delays: Array, omega: Array) -> Complex:
    """Of Z (s, f, d, d): (s, f, d), d at most 2."""
    back = np.exp(-1j * omega[..., None] * delays[:, None]).mean(axis=-1)
    own = (back - 1.0)[..., None, None] * (receptance @ mean.cutting[:, None])
    if mean.rubbing.any():
        own = own - 1j * omega[..., None, None] * (receptance @ mean.rubbing[:, None])
    if own.shape[-1] == 1:
        return own[..., 0]
    half = 0.5 * (own[..., 0, 0] + own[..., 1, 1])
    product = own[..., 0, 0] * own[..., 1, 1] - own[..., 0, 1] * own[..., 1, 0]
    root = np.sqrt(half**2 - product)
    larger = np.where(np.abs(half + root) >= np.abs(half - root), half + root, half - root)
    with np.errstate(divide="ignore", invalid="ignore"):
        smaller = np.where(larger != 0.0, product / larger, 0.0)
    return np.stack([larger, smaller], axis=-1)


def _followed(z: Complex) -> Complex:
    """Eigenvalues (s, f, d) with each branch in its column."""
    if z.shape[-1] == 1:
        return z
    swapped, before = z[:, 1:, ::-1], z[:, :-1]
    stay = np.abs(z[:, 1:] - before).sum(axis=-1)
    change = np.abs(swapped - before).sum(axis=-1) < stay
    flip = np.cumsum(change, axis=1) % 2 == 1
    followed = z.copy()
    followed[:, 1:] = np.where(flip[..., None], swapped, z[:, 1:])
    return followed


def _roots(
    receptances: Rows, mean: Mean, delays: Array, ends: tuple[Array, Array, Complex, Complex]
) -> tuple[Array, Array]:
    """Frequencies (s, c) at which branches between two samples are real, and the values there."""
    a, b, one, other = ends
    weight_a, weight_b = one.imag.copy(), other.imag.copy()
    middle, z, side = a, one, np.zeros(a.shape)
    for _ in range(STEPS):
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.nan_to_num(weight_a / (weight_a - weight_b), nan=0.5)
        middle = a + np.clip(share, 1e-3, 1.0 - 1e-3) * (b - a)
        found = _eigenvalues(receptances(middle), mean, delays, middle)
        with np.errstate(divide="ignore", invalid="ignore"):
            guess = one + np.nan_to_num((middle - a) / (b - a)) * (other - one)
        nearest = np.abs(found - guess[..., None]).argmin(axis=-1)[..., None]
        z = np.take_along_axis(found, nearest, axis=-1)[..., 0]
        if (np.abs(z.imag) <= 1e-10 * np.abs(z)).all():
            break
        lower = (z.imag > 0.0) == (one.imag > 0.0)
        weight_b = np.where(lower, np.where(side < 0.0, 0.5 * weight_b, other.imag), z.imag)
        weight_a = np.where(lower, z.imag, np.where(side > 0.0, 0.5 * weight_a, one.imag))
        a, one = np.where(lower, middle, a), np.where(lower, z, one)
        b, other = np.where(lower, b, middle), np.where(lower, other, z)
        side = np.where(lower, -1.0, 1.0)
    return middle, z.real
