"""Measured frequency responses beside the computed ones in a few lines of text."""

from __future__ import annotations

import math

from rotordyn.analysis.display import RPM, shown
from rotordyn.analysis.results import FrequencyResponse
from rotordyn.report.text import unbroken

MOST = 4  # responses told


def measured_lines(result: FrequencyResponse) -> list[str]:
    """A line per measured response: its highest peaks, the computed ones beside, their likeness."""
    lines = [_line(result, row) for row in range(min(MOST, len(result.measured)))]
    rest = len(result.measured) - MOST
    return lines + ([f"           and {rest} more measured responses"] if rest > 0 else [])


def _line(result: FrequencyResponse, row: int) -> str:
    pair, rpm = result.measured_pair[row], result.measured_speed[row] * RPM.factor
    to = shown(result.unit(result.pair.index(pair)))
    peaks = [
        unbroken(
            f"{seen:.1f} Hz {high * to.factor:.3g} (computed {found:.1f} Hz, "
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
    return (
        f"measured   {result.measured[row]}, {result.kind} {pair} at {rpm:.0f} rpm: likeness "
        f"{result.likeness[row]:.3f}{told}"
    )
