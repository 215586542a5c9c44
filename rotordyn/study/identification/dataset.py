"""An identification as one xarray Dataset, in SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rotordyn.report.cf import about

if TYPE_CHECKING:
    import xarray as xr

    from rotordyn.study.identification.solve import Identification


def dataset(found: Identification) -> xr.Dataset:
    """Values, intervals and correlation of the unknowns of the best model; every point; evidence
    of all models; predictions as printed."""
    import xarray as xr

    best, sure = found.explained, found.explained.sure
    problem = best.problem
    names = [each.path for each in problem.unknowns]
    fit = zip(problem.measurements, best.fit.predicted, best.left, strict=True)
    rows = [
        (data.name, data.series[k], data.observed[k], data.deviation[k], predicted[k], left[k])
        for data, predicted, left in ((m.data, p, d) for m, p, d in fit)
        for k in range(len(left))
    ]
    words = [np.array([row[k] for row in rows], dtype=object) for k in range(2)]
    observed, deviation, predicted, left = (np.array([r[k] for r in rows]) for k in range(2, 6))
    other = [f"{name}'" for name in names]
    values = {
        "value": ("unknown", sure.values, {"long_name": "value, SI"}),
        "deviation": ("unknown", sure.deviation, {"long_name": "standard deviation, SI"}),
        "interval": (("unknown", "end"), sure.interval, {"long_name": "95 % interval, SI"}),
        "verdict": ("unknown", np.array(sure.words, dtype=object)),
        "correlation": (("unknown", "other"), sure.correlation),
        "measurement": ("point", words[0]),
        "curve": ("point", words[1]),
        "observed": ("point", observed, {"long_name": "measured, SI"}),
        "noise": ("point", deviation, {"long_name": "standard deviation of the noise, SI"}),
        "machine": ("point", predicted, {"long_name": "of the identified machine, SI"}),
        "left": ("point", left, {"long_name": "not explained, tare and drift taken out, SI"}),
        "evidence": ("model", found.evidence, {"long_name": "BIC above the best"}),
    }
    coords = {
        "unknown": names,
        "other": other,
        "end": ["low", "high"],
        "model": [each.name for each in found.models],
    }
    if found.predictions:
        coords["prediction"] = [each.name for each in found.predictions]
        for name in ("value", "low", "high"):
            numbers = [getattr(each, name) for each in found.predictions]
            values[f"predicted_{name}"] = ("prediction", numbers)
    case = problem.case
    attributes = about(found.name, found.title, case.digest)
    return xr.Dataset(values, coords, {**attributes, "verdict": "\n".join(found.verdict)})
