"""Crossings of the positive real axis by eigenvalues z(θ), which are limits of stability.

The depth of each limit is 1/z; the least depth is sought. Branches are followed from sample to
sample; samples are added where a branch turns fast near the axis, and where the phase of
Π(1 − a z), which counts the unstable multipliers at a depth a, is uncertain for any depth up to
the limit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Indices

Solve = Callable[[Array], Complex]
ROUNDS = 12  # of refinement
MOST_SAMPLES = 4000
STEPS = 40  # of a root
ROUNDED = 1e-12  # of an eigenvalue: a smaller imaginary part is rounding
REAL = 1e-6  # as ROUNDED, at an end, where eigenvalues may be double and err more
CLOSE = 1e-8  # of an eigenvalue: tolerance of the imaginary part of a root
SAME = 0.05  # relative tolerance of the interpolated value at a known crossing
FAR = 0.9  # rad: largest phase step between samples
DEPTHS = 48  # at which unstable multipliers are counted
RANGE = 30.0  # from the least depth at which anything could be unstable


class Crossing(NamedTuple):
    """Largest ``value`` of an eigenvalue on the positive real axis, 0 if there is none, and its
    ``angle`` θ [rad]."""

    value: float
    angle: float


def largest_crossing(solve: Solve, angle: Array, ends: Sequence[int] = (-1,)) -> Crossing:
    """Return the largest crossing. ``solve``: eigenvalues (n, m) at angles (n,); ``angle``: first
    samples, ascending; ``ends``: samples at which eigenvalues may be real, the last or also the
    first."""
    z = solve(angle)
    best = Crossing(0.0, float("nan"))
    for _ in range(ROUNDS):
        best = _best(solve, angle, z, best, ends)
        intervals = _unresolved(angle, z, best, ends)
        if not len(intervals) or len(angle) > MOST_SAMPLES:
            break
        middle = 0.5 * (angle[intervals] + angle[intervals + 1])
        inserted = solve(middle)
        angle = np.insert(angle, intervals + 1, middle)
        z = np.insert(z, intervals + 1, inserted, axis=0)
    return best


def _pairs(z: Complex) -> tuple[Complex, Complex]:
    """Pair each eigenvalue of a sample with the nearest one of the next, and vice versa
    (n − 1, 2 m)."""
    distance = np.abs(z[:-1, :, None] - z[1:, None, :])
    next_nearest = np.take_along_axis(z[1:], distance.argmin(axis=2), axis=1)
    previous_nearest = np.take_along_axis(z[:-1], distance.argmin(axis=1), axis=1)
    return np.concatenate([z[:-1], previous_nearest], axis=1), np.concatenate(
        [next_nearest, z[1:]], axis=1
    )


def _best(solve: Solve, angle: Array, z: Complex, known: Crossing, ends: Sequence[int]) -> Crossing:
    """Return the largest crossing between samples; at the ends, the largest real eigenvalue."""
    best, computed = known, z
    z = np.where(np.abs(z.imag) <= ROUNDED * np.abs(z), z.real, z)
    for end in ends:
        real = np.abs(computed[end].imag) <= REAL * np.abs(computed[end])
        largest = computed[end].real[real].max(initial=0.0)
        best = max(best, Crossing(float(largest), float(angle[end])), key=_value)
        z[end] = np.where(real, computed[end].real, computed[end])
    low, high = _pairs(z)
    changes_sign = low.imag * high.imag < 0.0
    highest = np.where(changes_sign, np.maximum(low.real, high.real), 0.0)
    around = (angle[:-1] <= known.angle) & (known.angle <= angle[1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        interpolated = low.real + low.imag / (low.imag - high.imag) * (high.real - low.real)
    highest[around[:, None] & (np.abs(interpolated - known.value) < SAME * known.value)] = 0.0
    while True:
        place = np.unravel_index(highest.argmax(), highest.shape)
        if highest[place] <= best.value:
            return best
        highest[place] = 0.0
        row = int(place[0])
        best = max(best, _root(solve, angle[row : row + 2], low[place], high[place]), key=_value)


def _value(crossing: Crossing) -> float:
    return crossing.value


def _root(solve: Solve, angle: Array, low: complex, high: complex) -> Crossing:
    """Return the crossing of a branch between two samples, by false position; the Illinois rule
    halves the weight of an end that stays, which otherwise stalls."""
    a, b = angle.tolist()
    if not max(low.real, high.real) > 0.0:
        return Crossing(0.0, a)
    side = 0
    weights = [1.0, 1.0]
    for _ in range(STEPS):
        imag_low, imag_high = low.imag * weights[0], high.imag * weights[1]
        share = min(max(imag_low / (imag_low - imag_high), 1e-3), 1.0 - 1e-3)
        middle = a + share * (b - a)
        guess = low + (middle - a) / (b - a) * (high - low)
        values = solve(np.array([middle]))[0]
        z = values[np.abs(values - guess).argmin()]
        if abs(z.imag) <= CLOSE * abs(z):
            return Crossing(max(float(z.real), 0.0), middle)
        if (z.imag > 0.0) == (low.imag > 0.0):
            a, low, weights = middle, z, [1.0, 0.5 * weights[1] if side == -1 else 1.0]
            side = -1
        else:
            b, high, weights = middle, z, [0.5 * weights[0] if side == 1 else 1.0, 1.0]
            side = 1
    return Crossing(0.0, middle)  # two branches taken for one: neither crosses


def _unresolved(angle: Array, z: Complex, best: Crossing, ends: Sequence[int]) -> Indices:
    """Return the intervals to halve: a branch turns back near the axis beyond the best crossing, or
    the count of unstable multipliers is uncertain, or contradicts the limit."""
    low, high = _pairs(z)
    floor = max(best.value, np.abs(z).max() / RANGE)
    is_beyond = np.maximum(low.real, high.real) > floor
    step = np.abs(high - low)
    is_near = np.minimum(np.abs(low.imag), np.abs(high.imag)) < 0.5 * step
    turns_back = is_beyond & is_near & (low.imag * high.imag >= 0.0) & (step > 0.02 * np.abs(low))
    unresolved = turns_back.any(axis=1)
    unresolved[[*ends]] = False  # there branches lie on the axis
    depth = np.geomspace(1.0 / (1.05 * np.abs(z).max()), 0.998 / floor, DEPTHS)
    phase = np.angle(1.0 - depth[:, None, None] * z).sum(axis=2)
    jump = np.abs(np.remainder(np.diff(phase, axis=1) + np.pi, 2.0 * np.pi) - np.pi)
    unresolved |= (jump > FAR).any(axis=0)
    unresolved &= np.diff(angle) > 1e-7 * angle[-1]
    return np.flatnonzero(unresolved)
