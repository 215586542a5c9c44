"""Tables of an identification: values, differences, models, predictions and profiles."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.report.tables import Column, write_table
from rotordyn.study.identification.certainty import ON_A_BOUND
from rotordyn.study.identification.prediction import Prediction
from rotordyn.units import pretty_unit

if TYPE_CHECKING:
    from rotordyn.study.identification.identification import Explained, Identification


def write_tables(folder: Path, result: Identification) -> None:
    """Write the tables ``values``, ``profiles``, ``differences``, ``models``, ``predictions``."""
    best = result.explained
    unknowns, sure = best.problem.unknowns, best.sure
    columns: list[Column] = [
        ("path", [each.path for each in unknowns]),
        ("name", [each.name for each in unknowns]),
        ("unit", [pretty_unit(each.unit) for each in unknowns]),
    ]
    for name, values in (
        ("value", sure.values),
        ("standard deviation", sure.deviation),
        ("lower end of 95 %", sure.interval[:, 0]),
        ("upper end of 95 %", sure.interval[:, 1]),
        ("lower bound", best.problem.bounds[0]),
        ("upper bound", best.problem.bounds[1]),
    ):
        pairs = zip(unknowns, values.tolist(), strict=True)
        cells = ["" if np.isnan(v) else f"{u.shown(v):.9g}" for u, v in pairs]
        columns.append((name, cells))
    if result.profiles:
        columns += _ends_of_profiles(result)
        write_table(folder / "profiles.csv", _profiles(result))
    write_table(folder / "values.csv", [*columns, ("verdict", list(sure.words))])
    write_table(folder / "differences.csv", _points(best))
    for beside in best.beside:
        columns = [(h, [row[k] for row in beside.rows]) for k, h in enumerate(beside.head)]
        write_table(folder / f"{beside.name}.csv", columns)
    models = list(zip(result.models, result.evidence, strict=True))
    write_table(
        folder / "models.csv",
        [
            ("model", [model.name for model, _ in models]),
            ("BIC above the best", [f"{above:.6g}" for _, above in models]),
            ("sum of squares", [f"{model.fit.cost:.6g}" for model, _ in models]),
            *_columns_of_models(result),
        ],
    )
    if result.predictions:
        heads = {n: n for n in ("name", "unit", "value", "low", "high", "measured")}
        if any(each.bound for each in result.predictions):
            heads |= {"bound": ON_A_BOUND}
        if any(each.least is not None for each in result.predictions):
            heads |= {n: f"{n} over surviving models" for n in ("least", "most")}
        rows = [(h, [_cell(each, n) for each in result.predictions]) for n, h in heads.items()]
        write_table(folder / "predictions.csv", rows)


def _cell(of: Prediction, name: str) -> object:
    """Cell of a field of a prediction: a number or text, None for NaN."""
    value = getattr(of, name)
    if isinstance(value, tuple):
        return ", ".join(value)
    return None if isinstance(value, float) and np.isnan(value) else value


def _ends_of_profiles(result: Identification) -> Iterator[Column]:
    """Yield columns of the ends of intervals by profile, empty where there is none."""
    for end, head in enumerate(("lower", "upper")):
        cells = []
        for unknown in result.explained.problem.unknowns:
            profile = result.profiles.get(unknown.path)
            cells.append("" if profile is None else f"{unknown.shown(profile.interval[end]):.9g}")
        yield f"{head} end by profile", cells


def _profiles(result: Identification) -> list[Column]:
    """Columns of all points of all profiles, with χ² above the best."""
    unknowns = result.explained.problem.unknowns
    rows = [
        (unknown.path, pretty_unit(unknown.unit), f"{unknown.shown(value):.9g}", f"{excess:.6g}")
        for profile in result.profiles.values()
        for unknown in (unknowns[profile.number],)
        for value, excess in zip(profile.values, profile.excess, strict=True)
    ]
    heads = ("path", "unit", "value", "chi squared above the best")
    return [(head, [row[k] for row in rows]) for k, head in enumerate(heads)]


def _columns_of_models(result: Identification) -> list[Column]:
    """Columns of the value of every unknown by model; empty where it is not sought."""
    every = {u.path: u for model in result.models for u in model.problem.unknowns}
    columns: list[Column] = []
    for path, unknown in every.items():
        cells = []
        for model in result.models:
            known = dict(
                zip(
                    (u.path for u in model.problem.unknowns), model.fit.values.tolist(), strict=True
                )
            )
            cells.append(f"{unknown.shown(known[path]):.9g}" if path in known else "")
        columns.append((unknown.heading, cells))
    return columns


def _points(best: Explained) -> list[Column]:
    rows = []
    for each, predicted, residual in zip(
        best.problem.measurements, best.fit.predicted, best.residuals, strict=True
    ):
        data = each.data
        explained = data.observed - residual
        for k in range(len(residual)):
            values = (data.observed[k], predicted[k], explained[k], residual[k], data.deviation[k])
            rows.append(
                (
                    *(data.name, data.series[k], data.along, f"{data.at[k]:.9g}", data.unit),
                    *(f"{value * data.factor:.9g}" for value in values),
                )
            )
    heads = (
        "measurement", "curve", "along", "at", "unit",
        "measured", "machine", "with tare and drift", "residual", "noise",
    )  # fmt: skip
    return [(head, [row[k] for row in rows]) for k, head in enumerate(heads)]
