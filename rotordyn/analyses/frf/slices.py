"""One table per speed at which curves are drawn."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.results.display import RPM, shown
from rotordyn.results.layout import Table


def slices(result: FrequencyResponse) -> Iterator[Table]:
    """One table per slice with a solution: a line per frequency; of every pair both parts, and
    amplitude and phase."""
    solved = np.isfinite(result.response).all(axis=(1, 2))
    for index in np.flatnonzero(result.is_slice & solved).tolist():
        rpm = float(result.speed[index]) * RPM.factor
        columns = [("frequency", shown("Hz"), result.frequency)]
        for place, pair in enumerate(result.pair):
            label, unit = f"{result.kind} {pair}", shown(result.unit(place))
            values = result.response[index, place]
            columns.append((label, unit, values))
            columns.append((f"{label} amplitude", unit, np.abs(values)))
            columns.append((f"{label} phase", shown("rad"), np.angle(values)))
        yield Table(f"frf_{rpm:.7g}rpm", columns)
