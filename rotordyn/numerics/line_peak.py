"""A peak between the lines of a measured response, by one mode and a constant fitted around it.

Lines that are wide compared with a peak miss its top. H = c + r / (f − q) of complex q, r and c is
linear in q, n and c as f H = q H + n + c f, weighted by 1 / |f − q| of the previous fit, so that
noise counts equally on every line.

Theory: docs/theory/receptances.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex

SIDE, MOST = 3, 6  # lines to either side of the highest one: at least, and at most
LEVEL = 0.4  # of the highest line, down to which lines around it are taken
FEWEST = 3  # lines within 3 dB of the highest one, from which on it represents the peak
ROUNDS = 5  # of weights
TRUSTED = 0.1  # largest relative standard error of the damping of a reliable pole
SAME = 1e-4  # of a height: difference between the fit and a line at the top of the peak
NEAREST = 0.02  # lines from the axis: a pole nearer to it cannot be resolved
WIDTHS = np.linspace(-4.0, 4.0, 1601)  # in half widths, points at which the top is sought


class LinePeak(NamedTuple):
    """``frequency`` and ``height`` of a peak, and the standard ``error`` of the height over it.
    Without a reliable fit they are those of the highest line; the error is then NaN, and infinite
    where lines are too wide for the peak."""

    frequency: float
    height: float
    error: float


def line_peak(frequency: Array, response: Complex, top: int) -> LinePeak:
    """Return the peak about the highest line ``top`` of a response (n,) at ``frequency`` (n,)."""
    size = np.abs(response)
    wide = (np.abs(size[max(top - 1, 0) : top + 2]) > np.sqrt(0.5) * size[top]).sum() < FEWEST
    highest = LinePeak(float(frequency[top]), float(size[top]), np.inf if wide else np.nan)
    taken = slice(top - _reach(size[top::-1]), top + _reach(size[top:]) + 1)
    step = float(np.diff(frequency[taken]).max(initial=0.0))
    x, values = (frequency[taken] - frequency[top]) / (step or 1.0), response[taken] / size[top]
    if len(x) < 2 * SIDE or not step > 0.0:
        return highest
    columns = np.stack([values, np.ones(len(x)), x], axis=1)
    weight = np.ones(len(x))
    for _ in range(ROUNDS):
        fitted, *_ = np.linalg.lstsq(columns * weight[:, None], x * values * weight, rcond=None)
        pole = complex(fitted[0])
        if not abs(pole.imag) > NEAREST or abs(pole.real) > 1.0 + abs(pole.imag):
            return highest
        weight = 1.0 / np.abs(x - pole)
    around = np.clip(pole.real + abs(pole.imag) * WIDTHS, -1.0, 1.0)
    curve = np.abs((fitted[1] + fitted[2] * around) / (around - pole))
    residual = (columns @ fitted - x * values) * weight
    weighted = columns * weight[:, None]
    inverse = np.linalg.pinv(weighted)
    noise = np.sqrt((np.abs(residual) ** 2).sum() / (len(x) - 3))
    if noise * np.linalg.norm(inverse[0]) > TRUSTED * abs(pole.imag):
        return highest
    # noise differs between lines: each one's by its residual in the fit without it (HC3)
    leverage = np.einsum("nk,kn->n", weighted, inverse).real
    influence = inverse * (residual / (1.0 - leverage))
    covariance = influence @ influence.conj().T
    highest_point = int(curve.argmax())
    top_x = around[highest_point]
    top_value = (fitted[1] + fitted[2] * top_x) / (top_x - pole)
    # at the top the height changes with q, n and c alone: dH = (H dq + dn + f dc)/(f − q)
    gradient = np.array([top_value, 1.0, top_x]) / (top_x - pole)
    variance = 0.5 * (gradient @ covariance @ gradient.conj()).real  # of one part of noise
    error = float(np.sqrt(variance) / curve[highest_point])
    if abs(curve[highest_point] - 1.0) <= SAME:  # other modes distort the fit by as much
        return highest._replace(error=error)
    return LinePeak(
        float(frequency[top] + around[highest_point] * step),
        float(curve[highest_point] * size[top]),
        error,
    )


def _reach(size: Array) -> int:
    """Return the number of lines on one side of the highest: while they fall, down to ``LEVEL``."""
    stops = np.flatnonzero((size[1:] > size[:-1]) | (size[1:] < LEVEL * size[0]))
    wide = int(stops[0]) if stops.size else len(size) - 1
    return min(max(wide, SIDE), MOST, len(size) - 1)
