"""Outliers of a fit of least absolute differences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rotordyn.arrays import Array
from rotordyn.study.identification.certainty import Certainty
from rotordyn.study.identification.measurement import Measurement

FAR = 5.0  # robust standard deviations from which a point is an outlier
MOST = 4  # outliers that are named


def outliers(
    measurements: Sequence[Measurement], residuals: Sequence[Array], sure: Certainty
) -> Iterator[str]:
    """Yield a sentence that names the outliers, the farthest first, if there are any."""
    far = []
    for each, residual in zip(measurements, residuals, strict=True):
        data = each.data
        size = np.abs(residual) / (data.deviation * sure.birge)
        for k in np.flatnonzero(size > FAR).tolist():
            at, unit = f"{data.at[k]:.6g}", data.along.partition("[")[2].removesuffix("]")
            where = " ".join(filter(None, (data.name, data.series[k], "at", at, unit)))
            by = f"{residual[k] * data.factor:+.3g} {data.unit}".strip()
            far.append((float(size[k]), f"{where} by {by}"))
    if far:
        far.sort(key=lambda each: -each[0])
        more = f" and {len(far) - MOST} more" if len(far) > MOST else ""
        yield (
            f"points that differ by more than {FAR:g} deviations of the others: "
            f"{'; '.join(words for _, words in far[:MOST])}{more}; measure them again: near "
            "a kink, or where few points determine a value, intervals do not include them"
        )
