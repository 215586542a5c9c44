"""Tables of curves: one per speed at which they are drawn, and one of all peaks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.results.display import DEGREE, RPM, Shown, shown
from rotordyn.results.layout import Table


def slices(result: FrequencyResponse) -> Iterator[Table]:
    """One table per slice with a solution, a line per frequency: real and imaginary part, amplitude
    and phase of every pair. Then one of the peaks."""
    for row, speed in enumerate(result.slice_speed):
        finite = np.isfinite(result.slice_frequency[row])
        values = result.slice_value[row][:, finite]
        if not np.isfinite(values).all():
            continue
        columns = [("frequency", shown("Hz"), result.slice_frequency[row, finite])]
        for place, pair in enumerate(result.pair):
            label, unit = f"{result.kind} {pair}", shown(result.unit(place))
            columns.append((label, unit, values[place]))
            columns.append((f"{label} amplitude", unit, np.abs(values[place])))
            columns.append((f"{label} phase", shown("rad"), np.angle(values[place])))
        yield Table(f"frf_{float(speed) * RPM.factor:.7g}rpm", columns)
    if result.resonance.size:
        yield _peaks(result)


def _peaks(result: FrequencyResponse) -> Table:
    """A line per peak of every speed and pair."""
    speed, pair, place = np.nonzero(np.isfinite(result.peak_frequency))
    value = result.peak_value[speed, pair, place]
    units = [shown(result.unit(k)) for k in range(len(result.pair))]
    factor = np.array([unit.factor for unit in units])
    plain = Shown("")
    return Table(
        "frf_peaks",
        [
            ("speed", RPM, result.speed[speed]),
            ("response / excitation", plain, np.array(result.pair)[pair]),
            ("frequency", shown("Hz"), result.peak_frequency[speed, pair, place]),
            (f"amplitude of the {result.kind}", plain, np.abs(value) * factor[pair]),
            ("unit", plain, np.array([unit.unit for unit in units])[pair]),
            ("phase", DEGREE, np.angle(value)),
        ],
    )
