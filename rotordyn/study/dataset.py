"""Outcomes of a study as one xarray Dataset, what was varied as its dimensions."""

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
OF_RESULTS = ": "  # in the name of a variable that belongs to an analysis, not in those of paths


def gathered(
    study: Study,
    outcomes: Mapping[int, Outcome],
    datasets: Callable[[Outcome], Mapping[str, xr.Dataset]],
) -> xr.Dataset:
    """Every headline number, NaN beside its ``sentence`` where there is none, and what is kept
    whole as ``analysis: variable``."""
    import xarray as xr

    design, case = study.design, study.case
    rows = [outcomes.get(k) for k in range(design.count)]
    units_of = {name: unit for row in rows if row for name, (_, unit) in row.numbers.items()}
    values: dict[str, Any] = {}
    for name, unit in units_of.items():
        column = [row.numbers.get(name, (np.nan,))[0] if row else np.nan for row in rows]
        values[name] = (design.dims, np.reshape(column, design.shape), _attributes(unit, name))
    said = np.array([row.sentence if row else "not solved yet" for row in rows], dtype=object)
    told = np.array([len(row.warnings) if row else 0 for row in rows])
    values["sentence"] = (design.dims, said.reshape(design.shape), {"long_name": "why not solved"})
    values["warnings"] = (design.dims, told.reshape(design.shape), {"long_name": "how many"})
    whole = xr.Dataset(values, _coordinates(design), about(case.name, case.title, case.digest))
    good = [(k, row) for k, row in enumerate(rows) if row and row.solved]
    if not study.results or not good:
        return whole
    kept = {k: datasets(row) for k, row in good}
    parts = [_apart(_stacked(design, name, kept), design, values.keys()) for name in study.results]
    return xr.merge([whole, *parts], combine_attrs="override", join="left")


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
    """``long_name`` and ``units``, those that CF can write; printed units as they are."""
    try:
        return {"long_name": name, **units(unit.replace(" ", "·"))}
    except ValueError:
        return {"long_name": name, "units": unit}


def _stacked(design: Design, name: str, kept: Mapping[int, Mapping[str, xr.Dataset]]) -> xr.Dataset:
    """A dataset of all points over another, with NaN where one of them has no value."""
    import xarray as xr

    named = [_named(name, each[name]) for each in kept.values()]
    places = {dim: _places([each[dim].values for each in named]) for dim in named[0].dims}
    numbered = [
        each.assign_coords({dim: own[k] for dim, (_, own) in places.items()})
        for k, each in enumerate(named)
    ]
    whole = xr.concat(numbered, dim=POINT, data_vars="all", join="outer", combine_attrs="override")
    whole = whole.assign_coords({POINT: [*kept]}).reindex({POINT: np.arange(design.count)})
    entries = {dim: (dim, every, named[0][dim].attrs) for dim, (every, _) in places.items()}
    whole = whole.assign_coords(entries)
    return _unravelled(design, whole) if design.sampling == "grid" else whole.drop_vars(POINT)


def _named(name: str, data: xr.Dataset) -> xr.Dataset:
    """Variables and dimensions by the names that they have in a study."""
    return data.rename({each: f"{name}{OF_RESULTS}{each}" for each in data.variables})


def _apart(part: xr.Dataset, design: Design, numbers: Set[str]) -> xr.Dataset:
    """With the dimensions in the name of a variable that a headline number is called like."""
    called = {}
    for name in numbers & part.variables.keys():
        over = ", ".join(str(d) for d in part[name].dims if d not in design.dims)
        called[name] = f"{name} coordinate" if over == name else f"{name} over {over}"
    return part.rename(called)


def _places(rows: Sequence[Any]) -> tuple[Any, list[list[int]]]:
    """All entries of one dimension of several datasets, ascending where these differ, and the
    places among them of each.

    An entry may stand there more than once, such as a mode that several orders excite: the first
    of one is the same as the first of another, then the second.
    """
    counted = [_counted(row.tolist()) for row in rows]
    alike = all(row == counted[0] for row in counted)
    every = counted[0] if alike else sorted({each for row in counted for each in row})
    place = {each: k for k, each in enumerate(every)}
    values = np.array([entry for entry, _ in every], dtype=np.result_type(*rows))
    return values, [[place[each] for each in row] for row in counted]


def _counted(entries: Sequence[Any]) -> list[tuple[Any, int]]:
    """Each entry with the number of its like before it."""
    seen: Counter[Any] = Counter()
    counted = []
    for each in entries:
        counted.append((each, seen[each]))
        seen[each] += 1
    return counted


def _unravelled(design: Design, whole: xr.Dataset) -> xr.Dataset:
    """The one dimension of points as those of a grid."""
    import xarray as xr

    found = {}
    for name, each in whole.drop_vars(POINT).variables.items():
        if POINT in each.dims:
            first = each.transpose(POINT, ...)
            shape = (*design.shape, *first.shape[1:])
            found[name] = xr.Variable(
                (*design.dims, *first.dims[1:]), first.values.reshape(shape), each.attrs
            )
        else:
            found[name] = each
    coords = {name: found.pop(name) for name in whole.coords if name in found}
    return xr.Dataset(found, coords)
