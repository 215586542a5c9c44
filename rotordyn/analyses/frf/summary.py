"""Measured frequency responses beside the computed ones in a few lines of text."""

from __future__ import annotations

import math

import numpy as np

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, number, rounded_up, shown
from rotordyn.results.text import unbroken

PLURAL = {"receptance": "receptances", "mobility": "mobilities", "inertance": "inertances"}
MOST = 4  # responses told
SAME = 1e-6  # of a speed


def summary(result: FrequencyResponse) -> list[str]:
    """A line per measured response: its highest peaks, the computed ones beside, their likeness."""
    lines = [_line(result, row) for row in range(min(MOST, len(result.measured)))]
    rest = len(result.measured) - MOST
    return lines + ([f"           and {rest} more measured responses"] if rest > 0 else [])


def _line(result: FrequencyResponse, row: int) -> str:
    pair = result.measured_pair[row]
    to = shown(result.unit(result.pair.index(pair)))
    peaks = [
        unbroken(
            f"{number(seen)} Hz {high * to.factor:.3g} (computed {number(found)} Hz, "
            f"{(found / seen - 1.0) * 100.0:+.1f} %, {own * to.factor:.3g}, "
            f"{(own / high - 1.0) * 100.0:+.0f} %)"
        )
        for seen, high, found, own in zip(
            result.measured_peak[row],
            result.measured_peak_amplitude[row],
            result.computed_peak[row],
            result.computed_peak_amplitude[row],
            strict=True,
        )
        if math.isfinite(seen) and math.isfinite(found)
    ]
    told = f"; peaks [{to.unit}] {', '.join(peaks)}" if peaks else "; no peaks in common"
    head = (
        f"measured   {result.measured[row]}, {result.kind} {pair} at {speeds_compared(result, row)}"
    )
    if not math.isfinite(result.likeness[row]):
        return f"{head}, where there is no response"
    return f"{head}: likeness {result.likeness[row]:.3f}{told}"


def speeds_compared(result: FrequencyResponse, row: int) -> str:
    """The speed of a measured response, and that of the computed one where it is another."""
    own = float(result.measured_speed[row])
    near = float(result.speed[np.abs(result.speed - own).argmin()])
    rpm, other = (number(speed * RPM.factor, 0) for speed in (own, near))
    same = abs(near - own) <= SAME * max(near, own)
    return f"{rpm} rpm" if same else f"{rpm} rpm, computed at {other} rpm"


def cells(result: FrequencyResponse, _: Described) -> dict[str, str]:
    """The likeness of every measured response to the computed one, 1 at best."""
    return {
        f"{name} at {speeds_compared(result, row)}": (
            f"{result.likeness[row]:.3f}" if math.isfinite(result.likeness[row]) else "–"
        )
        for row, name in enumerate(result.measured)
    }


def accuracy(result: FrequencyResponse) -> list[str]:
    """The largest estimated error of the responses."""
    worst = float(result.error.max(initial=0.0))
    return [f"{PLURAL[result.kind]} within {rounded_up(worst)} of their peak"]
