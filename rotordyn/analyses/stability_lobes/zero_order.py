"""Zero-order stability, by the mean of the cutting forces and one frequency of vibration.

It is that of Altintas and Budak (1995), with the mean over the tooth period, and exact where the
cutting forces do not change with the angle.

At a depth a and a frequency ω on the limit 1/a is an eigenvalue of Z = −(1 − e^{−iωT}) Φ(iω) H̄, so
that the lobes need not be counted and every speed has its own receptance. Of unevenly spaced teeth
the factor is the mean over their delays T. Process damping adds −iω Φ(iω) C̄.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex

Rows = Callable[[Array], Complex]
CANDIDATES = 4  # crossings of a speed refined at a time, in order of their bounds
BULGE = 0.1  # of the chord between two samples: an arc of the phase between them bulges by 0.025
STEPS = 30
LEAST = 1e-4  # of the largest eigenvalue: a smaller crossing limits no practical depth


class Mean(NamedTuple):
    """Mean forces by unit of depth, each (1 or s, e, d) of e forces by d motions: ``cutting`` [Pa]
    by displacement from tooth to tooth, ``rubbing`` [N s/m²] by velocity."""

    cutting: Array
    rubbing: Array


def zero_order(
    receptances: Rows, mean: Mean, delays: Array, omega: Array, sampled: Rows | None = None
) -> tuple[Array, Array]:
    """Return the stable depth [m], infinite without a limit, and the chatter frequency [rad/s] of
    every speed (s,).

    ``receptances`` of frequencies (s, f): (s, f, d, e); ``delays`` from tooth to tooth (s, gaps)
    [s];
    ``omega`` (s, f) ascending samples [rad/s]; ``sampled``: an approximation of the receptances
    that costs less, in which crossings are located.
    """
    near = receptances if sampled is None else sampled
    z = _sorted_branches(_eigenvalues(near(omega), mean, delays, omega))
    low, high = z[:, :-1], z[:, 1:]
    chord, highest = np.abs(high - low), np.maximum(low.real, high.real)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = low.real + low.imag / (low.imag - high.imag) * (high.real - low.real)
        flatness = chord / np.abs(low.imag - high.imag)  # the flatter, the farther a bulge reaches
        bound = np.minimum(crossing + BULGE * chord * flatness, highest + BULGE * chord)
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
        found, root = (np.take_along_axis(a, best, axis=1)[:, 0] for a in (values, frequencies))
        value, at = np.where(found > value, (found, root), (value, at))
    depth = np.full(len(z), np.inf)
    limited = np.isfinite(at)
    depth[limited] = 1.0 / value[limited]
    return depth, at


def _eigenvalues(receptance: Complex, mean: Mean, delays: Array, omega: Array) -> Complex:
    """Return the eigenvalues (s, f, d) of Z (s, f, d, d), d at most 2."""
    delay_factor = np.exp(-1j * omega[..., None] * delays[:, None]).mean(axis=-1)
    matrix = (delay_factor - 1.0)[..., None, None] * (receptance @ mean.cutting[:, None])
    if mean.rubbing.any():
        matrix = matrix - 1j * omega[..., None, None] * (receptance @ mean.rubbing[:, None])
    if matrix.shape[-1] == 1:
        return matrix[..., 0]
    half = 0.5 * (matrix[..., 0, 0] + matrix[..., 1, 1])
    product = matrix[..., 0, 0] * matrix[..., 1, 1] - matrix[..., 0, 1] * matrix[..., 1, 0]
    root = np.sqrt(half**2 - product)
    larger = np.where(np.abs(half + root) >= np.abs(half - root), half + root, half - root)
    with np.errstate(divide="ignore", invalid="ignore"):
        smaller = np.where(larger != 0.0, product / larger, 0.0)
    return np.stack([larger, smaller], axis=-1)


def _sorted_branches(z: Complex) -> Complex:
    """Sort eigenvalues (s, f, d) so that each branch keeps its column."""
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
    """Return frequencies (s, c) at which branches between samples are real, and values there."""
    a, b, z_a, z_b = ends
    weight_a, weight_b = z_a.imag.copy(), z_b.imag.copy()
    middle, z, side = a, z_a, np.zeros(a.shape)
    for _ in range(STEPS):
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.nan_to_num(weight_a / (weight_a - weight_b), nan=0.5)
        middle = a + np.clip(share, 1e-3, 1.0 - 1e-3) * (b - a)
        values = _eigenvalues(receptances(middle), mean, delays, middle)
        with np.errstate(divide="ignore", invalid="ignore"):
            guess = z_a + np.nan_to_num((middle - a) / (b - a)) * (z_b - z_a)
        nearest = np.abs(values - guess[..., None]).argmin(axis=-1)[..., None]
        z = np.take_along_axis(values, nearest, axis=-1)[..., 0]
        if (np.abs(z.imag) <= 1e-10 * np.abs(z)).all():
            break
        replaces_a = (z.imag > 0.0) == (z_a.imag > 0.0)
        # Illinois rule: an end that stays twice has its weight halved, which otherwise stalls
        weight_b = np.where(replaces_a, np.where(side < 0.0, 0.5 * weight_b, z_b.imag), z.imag)
        weight_a = np.where(replaces_a, z.imag, np.where(side > 0.0, 0.5 * weight_a, z_a.imag))
        a, z_a = np.where(replaces_a, middle, a), np.where(replaces_a, z, z_a)
        b, z_b = np.where(replaces_a, b, middle), np.where(replaces_a, z_b, z)
        side = np.where(replaces_a, -1.0, 1.0)
    return middle, z.real
