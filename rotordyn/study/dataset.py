"""Outcomes of a study as one xarray Dataset, whose dimensions are the parameters."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.report.cf import about, units
from rotordyn.study.design import Design
from rotordyn.study.point import Outcome, Study

if TYPE_CHECKING:
    import xarray as xr

DATASET = "study.nc"
POINT = "point"
OF_RESULTS = ": "  # separates analysis and variable in a name; a dotted path never holds it


def gathered(
    study: Study,
    outcomes: Mapping[int, Outcome],
    datasets: Callable[[Outcome], Mapping[str, xr.Dataset]],
) -> xr.Dataset:
    """Join the outcomes of all points in one Dataset.

    It holds every headline number (NaN where a point has none; ``sentence`` says why), and the
    variables of analyses that are kept whole as ``analysis: variable``.
    """
    import xarray as xr

    design, case = study.design, study.case
    rows = [outcomes.get(k) for k in range(design.count)]
    units_of = {name: unit for row in rows if row for name, (_, unit) in row.numbers.items()}
    values: dict[str, Any] = {}
    for name, unit in units_of.items():
        column = [row.numbers.get(name, (np.nan,))[0] if row else np.nan for row in rows]
        values[name] = (design.dims, np.reshape(column, design.shape), _attributes(unit, name))
    sentences = np.array([row.sentence if row else "not solved yet" for row in rows], dtype=object)
    warnings = np.array([len(row.warnings) if row else 0 for row in rows])
    values["sentence"] = (
        design.dims,
        sentences.reshape(design.shape),
        {"long_name": "why not solved"},
    )
    values["warnings"] = (design.dims, warnings.reshape(design.shape), {"long_name": "how many"})
    joined = xr.Dataset(values, _coordinates(design), about(case.name, case.title, case.digest))
    solved = [(k, row) for k, row in enumerate(rows) if row and row.solved]
    if not study.results or not solved:
        return joined
    kept = {k: datasets(row) for k, row in solved}
    parts = [_apart(_stacked(design, name, kept), design, values.keys()) for name in study.results]
    return xr.merge([joined, *parts], combine_attrs="override", join="left")


def _coordinates(design: Design) -> dict[str, Any]:
    if design.sampling == "grid":
        return {
            p.path: ((p.path,), _row(p.labels), _attributes(p.unit, p.path))
            for p in design.parameters
        }
    points = [design.labels(k) for k in range(design.count)]
    return {
        p.path: ((POINT,), _row([each[p.path] for each in points]), _attributes(p.unit, p.path))
        for p in design.parameters
    }


def _row(labels: Any) -> Any:
    numbers = all(isinstance(each, float | int) for each in labels)
    return np.array(labels) if numbers else np.array([str(each) for each in labels], dtype=object)


def _attributes(unit: str, name: str) -> dict[str, str]:
    """``long_name`` and ``units``, by CF where it knows the unit, else as printed."""
    try:
        return {"long_name": name, **units(unit.replace(" ", "·"))}
    except ValueError:
        return {"long_name": name, "units": unit}


def _stacked(design: Design, name: str, kept: Mapping[int, Mapping[str, xr.Dataset]]) -> xr.Dataset:
    """Stack the datasets of one analysis over all points, with NaN where a point lacks a value."""
    import xarray as xr

    named = [_named(name, each[name]) for each in kept.values()]
    aligned = {dim: _places([each[dim].values for each in named]) for dim in named[0].dims}
    numbered = [
        each.assign_coords({dim: indices[k] for dim, (_, indices) in aligned.items()})
        for k, each in enumerate(named)
    ]
    stacked = xr.concat(
        numbered, dim=POINT, data_vars="all", join="outer", combine_attrs="override"
    )
    stacked = stacked.assign_coords({POINT: [*kept]}).reindex({POINT: np.arange(design.count)})
    entries = {dim: (dim, labels, named[0][dim].attrs) for dim, (labels, _) in aligned.items()}
    stacked = stacked.assign_coords(entries)
    return _unravelled(design, stacked) if design.sampling == "grid" else stacked.drop_vars(POINT)


def _named(name: str, data: xr.Dataset) -> xr.Dataset:
    """Rename variables and dimensions to ``analysis: variable``."""
    return data.rename({each: f"{name}{OF_RESULTS}{each}" for each in data.variables})


def _apart(part: xr.Dataset, design: Design, numbers: Set[str]) -> xr.Dataset:
    """Add the dimensions to the name of a variable that is called like a headline number."""
    renamed = {}
    for name in numbers & part.variables.keys():
        over = ", ".join(str(d) for d in part[name].dims if d not in design.dims)
        renamed[name] = f"{name} coordinate" if over == name else f"{name} over {over}"
    return part.rename(renamed)


def _places(rows: Sequence[Any]) -> tuple[Any, list[list[int]]]:
    """Union of the labels of one dimension over several datasets, ascending unless all agree, and
    the indices of each dataset's labels in it.

    A label may repeat, such as a mode that several orders excite; its n-th occurrences in different
    datasets are matched with one another.
    """
    counted = [_counted(row.tolist()) for row in rows]
    identical = all(row == counted[0] for row in counted)
    union = counted[0] if identical else sorted({each for row in counted for each in row})
    place = {each: k for k, each in enumerate(union)}
    values = np.array([entry for entry, _ in union], dtype=np.result_type(*rows))
    return values, [[place[each] for each in row] for row in counted]


def _counted(entries: Sequence[Any]) -> list[tuple[Any, int]]:
    """Pair each entry with the number of equal entries before it."""
    seen: Counter[Any] = Counter()
    counted = []
    for each in entries:
        counted.append((each, seen[each]))
        seen[each] += 1
    return counted


def _unravelled(design: Design, stacked: xr.Dataset) -> xr.Dataset:
    """Reshape the dimension ``point`` into the dimensions of the grid."""
    import xarray as xr

    variables = {}
    for name, variable in stacked.drop_vars(POINT).variables.items():
        if POINT in variable.dims:
            first = variable.transpose(POINT, ...)
            shape = (*design.shape, *first.shape[1:])
            variables[name] = xr.Variable(
                (*design.dims, *first.dims[1:]), first.values.reshape(shape), variable.attrs
            )
        else:
            variables[name] = variable
    coords = {name: variables.pop(name) for name in stacked.coords if name in variables}
    return xr.Dataset(variables, coords)
