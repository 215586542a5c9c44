"""Measured frequency responses beside computed ones: peaks of both, and their FRAC."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.frf.coupled import TipError
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import as_quantity
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.numerics.line_peak import line_peak

PEAKS = 3
NO_TIP = TipError(math.nan, math.nan, "", np.asarray)
LEAST_POINTS = 8  # in the band: with fewer, any two smooth curves correlate
PROMINENT = math.sqrt(2.0)  # ratio by which an amplitude falls on both sides of a peak: 3 dB


def measured_fields(
    spec: FrfSpec,
    speed: Array,
    frequency: Array,
    pairs: Sequence[str],
    computed: Callable[[int, Array], Complex],
    peaks: tuple[Array, Complex],
    errors: Mapping[str, TipError] = {},
) -> dict[str, Any]:
    """Fields of a result for the measured responses ``spec.measured``.

    ``computed``: responses (pairs, n) at the index of a speed and frequencies (n,) [Hz];
    ``peaks``: frequency and value (speeds, pairs, resonances). The computed response is that at
    the nearest speed of the case. ``errors``: of coupled tips, by the name of the response: a fit
    to their peaks knows nothing of noise, which the modes of the measurement have averaged.
    """
    count, longest = len(spec.measured), max((len(m.frequency) for m in spec.measured), default=0)
    axis = np.full((count, longest), np.nan)
    response = np.full((count, longest), complex(np.nan, np.nan))
    peak_rows = np.full((5, count, PEAKS), np.nan)
    frac = np.full(count, np.nan)
    for row, entry in enumerate(spec.measured):
        at_frequency, measured = np.array(entry.frequency), as_quantity(entry, spec.quantity)
        axis[row, : len(at_frequency)], response[row, : len(at_frequency)] = at_frequency, measured
        speed_index = int(np.abs(speed - entry.speed).argmin())
        pair = pairs.index(entry.pair)
        inside = (at_frequency >= frequency[0]) & (at_frequency <= frequency[-1])
        computed_values = computed(speed_index, at_frequency[inside])[pair]
        if np.isfinite(computed_values).all() and inside.sum() >= LEAST_POINTS:
            frac[row] = assurance(measured[inside], computed_values)
            peak_at, peak_value = (array[speed_index, pair] for array in peaks)
            is_peak = np.isfinite(peak_at)
            # between peaks closer than the grid, which would otherwise be one
            valleys = np.sqrt(peak_at[is_peak][1:] * peak_at[is_peak][:-1])
            grid = np.unique(np.concatenate([frequency, peak_at[is_peak], valleys]))
            curve = np.abs(computed(speed_index, grid)[pair])
            curve[np.searchsorted(grid, peak_at[is_peak])] = np.abs(peak_value[is_peak])
            rows = _paired_peaks(at_frequency[inside], measured[inside], grid, curve)
            if entry.name in errors and (known := np.isfinite(rows[0])).any():
                rows[2, known] = errors[entry.name].at(rows[0, known])
            peak_rows[:, row] = rows
    tips = [errors.get(entry.name, NO_TIP) for entry in spec.measured]
    of_tips = np.array([[tip.noise, tip.calibration] for tip in tips]).reshape(-1, 2)
    of_measured = ("measured_peak", "measured_peak_amplitude", "measured_peak_error")
    names = (*of_measured, "computed_peak", "computed_peak_amplitude")
    return {
        "measured": tuple(entry.name for entry in spec.measured),
        "peak": np.arange(1, PEAKS + 1),
        "sample": np.arange(longest),
        "measured_pair": tuple(entry.pair for entry in spec.measured),
        "measured_speed": np.array([entry.speed for entry in spec.measured]),
        "measured_frequency": axis,
        "measured_response": response,
        "frac": frac,
        "measured_error": of_tips[:, 0],
        "measured_calibration": of_tips[:, 1],
        "measured_doubt": tuple(tip.doubt for tip in tips),
        **dict(zip(names, peak_rows, strict=True)),
    }


def assurance(one: Complex, other: Complex) -> float:
    """Frequency response assurance criterion |aᴴ b|² / (aᴴ a · bᴴ b), 1 where b = c a."""
    largest = np.abs(one).max(initial=0.0), np.abs(other).max(initial=0.0)
    if not min(largest) > 0.0:
        return 0.0
    one, other = one / largest[0], other / largest[1]  # squares of 1e200 overflow
    size = float((np.abs(one) ** 2).sum() * (np.abs(other) ** 2).sum())
    return float(np.abs(np.vdot(one, other)) ** 2) / size


def peaks_of(amplitude: Array) -> Indices:
    """Indices of local maxima from which the amplitude falls by 3 dB on both sides before it rises
    above them, highest first."""
    inner = amplitude[1:-1]
    tops = 1 + np.flatnonzero((inner > amplitude[:-2]) & (inner >= amplitude[2:]))
    prominent = [top for top in tops if _is_prominent(amplitude, int(top))]
    return np.array(sorted(prominent, key=lambda top: -amplitude[top]), dtype=np.intp)


def _is_prominent(amplitude: Array, top: int) -> bool:
    for side in (amplitude[top::-1], amplitude[top:]):
        higher = np.flatnonzero(side > amplitude[top])
        flank = side[: higher[0]] if higher.size else side
        if flank.min() * PROMINENT > amplitude[top]:
            return False
    return True


def _paired_peaks(at: Array, measured: Complex, frequency: Array, computed: Array) -> Array:
    """Pair the highest measured peaks, ascending, with the nearest computed peaks (5, peaks).

    Rows: measured frequency, amplitude and its error, computed frequency and amplitude.
    """
    rows = np.full((5, PEAKS), np.nan)
    tops, candidates = np.sort(peaks_of(np.abs(measured))[:PEAKS]), peaks_of(computed)
    for column, top in enumerate(tops.tolist()):
        peak = line_peak(at, measured, top)
        rows[:3, column] = peak
        if candidates.size:
            nearest = candidates[np.abs(np.log(frequency[candidates] / peak.frequency)).argmin()]
            rows[3:, column] = frequency[nearest], computed[nearest]
    return rows
