"""Frequency responses in a few lines of text: their peaks, measured ones beside them."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.frf.measured import LEAST_POINTS
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.passivity import NO_DRIVING_POINT, fault_at_driving_point, misnamed
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, number, rounded_up, shown
from rotordyn.results.headline import Number
from rotordyn.results.severity import Severity, graded
from rotordyn.results.text import unbroken
from rotordyn.scene.lightly_damped import lightly_damped

PLURAL = {"receptance": "receptances", "mobility": "mobilities", "inertance": "inertances"}
MOST = 4  # responses listed
SAME = 1e-6  # of a speed
NOISY = 0.3  # of a response: a larger error by noise gives a warning


def summary(result: FrequencyResponse) -> list[str]:
    """The highest peak of every pair, of all frequencies and along every engine order; then a line
    per measured response: its highest peaks, the computed ones beside, the FRAC."""
    entries = [_highest(result, pair) for pair in range(min(MOST, len(result.pair)))]
    entries += [
        _along(result, row, pair)
        for row in range(min(MOST, len(result.line)))
        for pair in range(min(MOST, len(result.pair)))
    ]
    listed = [unbroken(word) for word in entries if word]
    peaks = [f"peaks      {result.kind}, the highest of each pair: {'; '.join(listed)}"]
    return [*(peaks if listed else []), *_measured(result)]


def _highest(result: FrequencyResponse, pair: int) -> str:
    """The highest peak of a pair at all speeds; empty where there is none."""
    if (highest := result.highest(pair)) is None:
        return ""
    row, place = highest
    hertz, rpm = result.peak_frequency[row, pair, place], result.speed[row] * RPM.factor
    at = f"at {number(float(hertz))} Hz and {number(float(rpm), 0)} rpm"
    size = float(np.abs(result.peak_value[row, pair, place]))
    return f"{result.pair[pair]} {_size(result, pair, size)} {at}"


def _along(result: FrequencyResponse, row: int, pair: int) -> str:
    """The highest peak of a pair along an engine order; its highest value where there is none."""
    size, at = np.abs(result.line_peak_value[row, pair]), result.line_peak_speed[row, pair]
    if not np.isfinite(size).any():
        size, at = np.abs(result.line_curve[row, :, pair]), result.line_speed[row]
    if not np.isfinite(size).any() or not np.nanmax(size) > 0.0:
        return ""
    place = int(np.nanargmax(size))
    rpm = number(float(at[place]) * RPM.factor, 0)
    value = f"{result.pair[pair]} {_size(result, pair, float(size[place]))}"
    return f"{value} along {result.line[row]} at {rpm} rpm"


def _size(result: FrequencyResponse, pair: int, size: float) -> str:
    """A value in its printed unit; displacement over force is followed by its inverse."""
    to = shown(result.unit(pair))
    if not math.isfinite(size):
        return "unbounded (no damping)"
    stiff = f" ({1e-6 / size:.3g} N/µm)" if result.unit(pair) == "m/N" else ""
    return f"{size * to.factor:.3g} {to.unit}{stiff}"


def _measured(result: FrequencyResponse) -> list[str]:
    """A line per measured response."""
    lines = [_line(result, row) for row in range(min(MOST, len(result.measured)))]
    rest = len(result.measured) - MOST
    more = f"           and {rest} more measured response{'s' * (rest > 1)}"
    return lines + ([more] if rest > 0 else [])


def _line(result: FrequencyResponse, row: int) -> str:
    pair = result.measured_pair[row]
    to = shown(result.unit(result.pair.index(pair)))
    peaks = [
        unbroken(
            f"{number(measured)} Hz {amplitude * to.factor:.3g} (computed {number(computed)} Hz, "
            f"{(computed / measured - 1.0) * 100.0:+.1f} %, {peak * to.factor:.3g}, "
            f"{(peak / amplitude - 1.0) * 100.0:+.0f} %)"
        )
        for measured, amplitude, computed, peak in zip(
            result.measured_peak[row],
            result.measured_peak_amplitude[row],
            result.computed_peak[row],
            result.computed_peak_amplitude[row],
            strict=True,
        )
        if math.isfinite(measured) and math.isfinite(computed)
    ]
    compared = f"; peaks [{to.unit}] {', '.join(peaks)}" if peaks else "; no peaks in common"
    head = (
        f"measured   {result.measured[row]}, {result.kind} {pair} at {speeds_compared(result, row)}"
    )
    if not math.isfinite(result.frac[row]):
        return f"{head}: not compared, {_why_not(result, row)}"
    noise = result.measured_error[row]
    uncertainty = ""
    if math.isfinite(noise):
        growth = result.measured_calibration[row]
        uncertainty = (
            f", uncertainty {100.0 * noise:.1f} % from noise and {growth:.0f} % for each 1 "
            "% (or 0.6°) of "
            "calibration"
        )
    return f"{head}: FRAC {result.frac[row]:.3f}{uncertainty}{compared}"


def _why_not(result: FrequencyResponse, row: int) -> str:
    frequency = result.measured_frequency[row]
    inside = ((frequency >= result.frequency[0]) & (frequency <= result.frequency[-1])).sum()
    if inside < LEAST_POINTS:
        return f"{inside} of its points lie in the band, {LEAST_POINTS} are needed"
    return "there is no computed response"


def warnings(result: FrequencyResponse) -> list[str]:
    """Warnings of inaccurate responses, of doubtful measured ones, and of light damping."""
    sentences = [
        f"measured response {name} is not compared: {_why_not(result, row)}"
        for row, name in enumerate(result.measured)
        if not math.isfinite(result.frac[row])
    ]
    sentences += [
        f"{name}: measurement noise causes an error of {100.0 * noise:.0f} %, most of it at "
        "its highest peaks: "
        "take a shorter blank, or more averages"
        for name, noise in zip(result.measured, result.measured_error, strict=True)
        if noise > NOISY
    ]
    sentences += [
        f"{name}: {doubt}"
        for name, doubt in zip(result.measured, result.measured_doubt, strict=True)
        if doubt
    ]
    sentences += [*_wide_lines(result), *_driving_points(result)]
    worst = float(result.error.max(initial=0.0))
    if worst > result.error_asked:
        pair = result.pair[int(result.error.argmax())]
        why = (
            f"frf: {pair} is less accurate than asked for: an estimated error of "
            f"{rounded_up(worst)} of its peak remains after refinement"
        )
        sentences.append(graded(Severity.INVALID, why))
    return [*sentences, *_lightly_damped(result)]


def _wide_lines(result: FrequencyResponse) -> Iterator[str]:
    """Warn of measured peaks between lines so wide that only the highest line is known."""
    for name, at, error in zip(
        result.measured, result.measured_peak, result.measured_peak_error, strict=True
    ):
        if (wide := np.isinf(error)).any():
            peaks = ", ".join(number(hertz) for hertz in at[wide])
            yield (
                f"measured response {name}: its frequencies are too far apart for the peaks at "
                f"{peaks} Hz, whose heights are those of the highest samples and may be too low: "
                "measure with a finer frequency resolution"
            )


def _driving_points(result: FrequencyResponse) -> Iterator[str]:
    """Warn of measured driving-point responses that no passive structure has; of a rotating machine
    only where the mistake is recognised. Computed tips of coupled tools are exempt."""
    for row, name in enumerate(result.measured):
        response, excitation = result.measured_pair[row].split(" / ")
        positive = np.nan_to_num(result.measured_frequency[row]) > 0.0
        computed = math.isfinite(result.measured_error[row])
        if response != excitation or computed or positive.sum() < LEAST_POINTS:
            continue
        values = result.measured_response[row, positive].tolist()
        omega = (2.0 * math.pi * result.measured_frequency[row, positive]).tolist()
        fault = fault_at_driving_point(values, omega, result.kind)
        if fault and not (fault == NO_DRIVING_POINT and result.measured_speed[row] > 0.0):
            words = fault if fault == NO_DRIVING_POINT else misnamed(result.kind)
            yield f"measured response {name} is not that of a driving point: {words}"


def _lightly_damped(result: FrequencyResponse) -> Iterator[str]:
    """Warn, in one sentence, where the highest peaks are those of lightly damped modes."""
    light = [pair for pair, mode in enumerate(result.light_mode) if mode]
    for pair in light[:1]:
        row, place = result.highest(pair) or (0, 0)
        ratio = result.peak_damping[row, pair, place]
        more = f" (and those of {len(light) - 1} more responses)" if len(light) > 1 else ""
        peak = f"frf: the highest peak of {_highest(result, pair)}{more}"
        yield lightly_damped(peak, result.light_mode[pair], float(ratio))


def speeds_compared(result: FrequencyResponse, row: int) -> str:
    """The speed of a measured response, and that of the computed one where it is another."""
    measured = float(result.measured_speed[row])
    computed = float(result.speed[np.abs(result.speed - measured).argmin()])
    rpm, other = (number(speed * RPM.factor, 0) for speed in (measured, computed))
    same = abs(computed - measured) <= SAME * max(computed, measured)
    return f"{rpm} rpm" if same else f"{rpm} rpm, computed at {other} rpm"


def numbers(result: FrequencyResponse, _: Described) -> Iterator[Number]:
    """FRAC (frequency response assurance criterion) of every measured response."""
    for row, name in enumerate(result.measured):
        label = f"{name} at {speeds_compared(result, row)}"
        yield Number(label, "", float(result.frac[row]), digits=3, absent="–")


def accuracy(result: FrequencyResponse) -> list[str]:
    """The largest estimated error of the responses."""
    worst = float(result.error.max(initial=0.0))
    return [f"{PLURAL[result.kind]} within {rounded_up(worst)} of their peak"]
