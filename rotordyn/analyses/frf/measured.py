"""Measured frequency responses beside computed ones: peaks of both, and how alike they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import as_quantity
from rotordyn.numerics.line_peak import line_peak

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
PEAKS = 3
LEAST_POINTS = 8  # in the band: of fewer, any two smooth curves look alike
PROMINENT = math.sqrt(2.0)  # how far an amplitude falls on both sides of a peak: 3 dB


def measured_fields(
    spec: FrfSpec,
    speed: Array,
    frequency: Array,
    pairs: Sequence[str],
    computed: Callable[[int, Array], Complex],
    peaks: tuple[Array, Complex],
    errors: Mapping[str, float] = {},
) -> dict[str, Any]:
    """The fields of a result about ``spec.measured``.

    ``computed``: responses (pairs, n) at one of the speeds and at frequencies (n,) [Hz]; of
    ``peaks``, frequency and value (speeds, pairs, resonances). The computed response is that at the
    nearest speed of the case. ``errors``: relative ones by the name of the response.
    """
    count, longest = len(spec.measured), max((len(m.frequency) for m in spec.measured), default=0)
    axis = np.full((count, longest), np.nan)
    response = np.full((count, longest), complex(np.nan, np.nan))
    beside = np.full((5, count, PEAKS), np.nan)
    frac = np.full(count, np.nan)
    for row, one in enumerate(spec.measured):
        at_frequency, measured = np.array(one.frequency), as_quantity(one, spec.quantity)
        axis[row, : len(at_frequency)], response[row, : len(at_frequency)] = at_frequency, measured
        near = int(np.abs(speed - one.speed).argmin())
        pair = pairs.index(one.pair)
        inside = (at_frequency >= frequency[0]) & (at_frequency <= frequency[-1])
        there = computed(near, at_frequency[inside])[pair]
        if np.isfinite(there).all() and inside.sum() >= LEAST_POINTS:
            frac[row] = assurance(measured[inside], there)
            at, high = (each[near, pair] for each in peaks)
            known = np.isfinite(at)
            valleys = np.sqrt(at[known][1:] * at[known][:-1])  # between peaks nearer than the grid
            grid = np.unique(np.concatenate([frequency, at[known], valleys]))
            curve = np.abs(computed(near, grid)[pair])
            curve[np.searchsorted(grid, at[known])] = np.abs(high[known])
            beside[:, row] = _beside(at_frequency[inside], measured[inside], grid, curve)
    of_measured = ("measured_peak", "measured_peak_amplitude", "measured_peak_error")
    names = (*of_measured, "computed_peak", "computed_peak_amplitude")
    return {
        "measured": tuple(one.name for one in spec.measured),
        "peak": np.arange(1, PEAKS + 1),
        "sample": np.arange(longest),
        "measured_pair": tuple(one.pair for one in spec.measured),
        "measured_speed": np.array([one.speed for one in spec.measured]),
        "measured_frequency": axis,
        "measured_response": response,
        "frac": frac,
        "measured_error": np.array([errors.get(one.name, np.nan) for one in spec.measured]),
        **dict(zip(names, beside, strict=True)),
    }


def assurance(one: Complex, other: Complex) -> float:
    """Frequency response assurance criterion |aᴴ b|² / (aᴴ a · bᴴ b), 1 where b = c a."""
    largest = np.abs(one).max(initial=0.0), np.abs(other).max(initial=0.0)
    if not min(largest) > 0.0:
        return 0.0
    one, other = one / largest[0], other / largest[1]  # squares of 1e200 are no numbers
    size = float((np.abs(one) ** 2).sum() * (np.abs(other) ** 2).sum())
    return float(np.abs(np.vdot(one, other)) ** 2) / size


def peaks_of(amplitude: Array) -> NDArray[np.intp]:
    """Places of local maxima that stand 3 dB above the way to anything higher, by height."""
    inner = amplitude[1:-1]
    tops = 1 + np.flatnonzero((inner > amplitude[:-2]) & (inner >= amplitude[2:]))
    kept = [top for top in tops if _stands_out(amplitude, int(top))]
    return np.array(sorted(kept, key=lambda top: -amplitude[top]), dtype=np.intp)


def _stands_out(amplitude: Array, top: int) -> bool:
    for side in (amplitude[top::-1], amplitude[top:]):
        higher = np.flatnonzero(side > amplitude[top])
        until = side[: higher[0]] if higher.size else side
        if until.min() * PROMINENT > amplitude[top]:
            return False
    return True


def _beside(at: Array, measured: Complex, frequency: Array, computed: Array) -> Array:
    """The highest measured peaks, ascending, each with the computed peak nearest to it (5, peaks).

    Rows: measured frequency, amplitude and its error, computed frequency and amplitude.
    """
    rows = np.full((5, PEAKS), np.nan)
    tops, others = np.sort(peaks_of(np.abs(measured))[:PEAKS]), peaks_of(computed)
    for column, top in enumerate(tops.tolist()):
        peak = line_peak(at, measured, top)
        rows[:3, column] = peak
        if others.size:
            near = others[np.abs(np.log(frequency[others] / peak.frequency)).argmin()]
            rows[3:, column] = frequency[near], computed[near]
    return rows
