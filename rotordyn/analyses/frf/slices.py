"""One table per speed at which curves are drawn."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.results.display import RPM, shown
from rotordyn.results.layout import Table


def slices(result: FrequencyResponse) -> Iterator[Table]:
    """One table per slice with a solution: a line per frequency, every pair."""
    solved = np.isfinite(result.response).all(axis=(1, 2))
    for index in np.flatnonzero(result.is_slice & solved).tolist():
        rpm = float(result.speed[index]) * RPM.factor
        pairs = [
            (f"{result.kind} {pair}", shown(result.unit(place)), result.response[index, place])
            for place, pair in enumerate(result.pair)
        ]
        yield Table(f"frf_{rpm:.7g}rpm", [("frequency", shown("Hz"), result.frequency), *pairs])
