"""Points that stand far off where the mean absolute difference is made least."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from rotordyn.study.identification.certainty import Certainty
from rotordyn.study.identification.measurement import Measurement

Array = NDArray[np.float64]
FAR = 5.0  # deviations of the others: noise has hardly any
MOST = 4  # that are named


def outliers(
    measurements: Sequence[Measurement], residuals: Sequence[Array], sure: Certainty
) -> Iterator[str]:
    """A sentence that names them, the farthest first; none where none stands off."""
    found = []
    for each, residual in zip(measurements, residuals, strict=True):
        data = each.data
        size = np.abs(residual) / (data.deviation * sure.birge)
        for k in np.flatnonzero(size > FAR).tolist():
            at, unit = f"{data.at[k]:.6g}", data.along.partition("[")[2].removesuffix("]")
            where = " ".join(filter(None, (data.name, data.series[k], "at", at, unit)))
            by = f"{residual[k] * data.factor:+.3g} {data.unit}".strip()
            found.append((float(size[k]), f"{where} by {by}"))
    if found:
        found.sort(key=lambda each: -each[0])
        more = f" and {len(found) - MOST} more" if len(found) > MOST else ""
        yield (
            f"points that stand off by more than {FAR:g} deviations of the others: "
            f"{'; '.join(words for _, words in found[:MOST])}{more}; measure them again: beside "
            "a kink, or where few points determine a value, intervals do not know of them"
        )
