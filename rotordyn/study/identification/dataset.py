"""An identification as one xarray Dataset, in SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.report.cf import about

if TYPE_CHECKING:
    import xarray as xr

    from rotordyn.study.identification.identification import Identification


def _profiles(result: Identification) -> dict[str, Any]:
    """Variables of the profiles: intervals, and all points of each profile."""
    ends = np.full((len(result.explained.problem.unknowns), 2), np.nan)
    for each in result.profiles.values():
        ends[each.number] = each.interval
    paths = [path for path, each in result.profiles.items() for _ in each.values]
    value, excess = (
        np.concatenate([getattr(each, name) for each in result.profiles.values()])
        for name in ("values", "excess")
    )
    meaning = "95 % interval by profile, SI; NaN of unknowns whose profile was not asked for"
    return {
        "profile_interval": (("unknown", "end"), ends, {"long_name": meaning}),
        "profile_unknown": ("profile_point", np.array(paths, dtype=object)),
        "profile_value": ("profile_point", value, {"long_name": "fixed value, SI"}),
        "profile_excess": (
            "profile_point",
            excess,
            {
                "long_name": "least χ² above the best, over the Birge factor squared",
                "threshold": result.explained.sure.quantile**2,
            },
        ),
    }


def dataset(result: Identification) -> xr.Dataset:
    """Build the Dataset: values, intervals and correlation of the unknowns of the best model; all
    measured points; evidence of all models; predictions as printed; profiles."""
    import xarray as xr

    best, sure = result.explained, result.explained.sure
    problem = best.problem
    names = [each.path for each in problem.unknowns]
    fit = zip(problem.measurements, best.fit.predicted, best.residuals, strict=True)
    rows = [
        (data.name, data.series[k], data.observed[k], data.deviation[k], predicted[k], residual[k])
        for data, predicted, residual in ((m.data, p, d) for m, p, d in fit)
        for k in range(len(residual))
    ]
    words = [np.array([row[k] for row in rows], dtype=object) for k in range(2)]
    observed, deviation, predicted, residual = (np.array([r[k] for r in rows]) for k in range(2, 6))
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
        "residual": (
            "point",
            residual,
            {"long_name": "not explained, tare and drift off, SI"},
        ),
        "evidence": ("model", result.evidence, {"long_name": "BIC above the best"}),
    }
    coords = {
        "unknown": names,
        "other": other,
        "end": ["low", "high"],
        "model": [each.name for each in result.models],
    }
    if result.predictions:
        coords["prediction"] = [each.name for each in result.predictions]
        for name in ("value", "low", "high", "least", "most"):
            numbers = [getattr(each, name) for each in result.predictions]
            if None not in numbers:
                values[f"predicted_{name}"] = ("prediction", numbers)
    if result.profiles:
        values |= _profiles(result)
    case = problem.case
    attributes = about(result.name, result.title, case.digest)
    attributes |= {
        "verdict": "\n".join(result.verdict),
        "stopped": "yes" if result.stopped else "",
        "beside": "\n".join(each.name for each in best.beside),
    }
    return xr.Dataset(values, coords, attributes)
