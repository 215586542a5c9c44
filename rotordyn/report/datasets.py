"""A result as an xarray Dataset, complex in memory, units and labels as attributes; and back."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import is_dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, get_type_hints

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.analyses.registry import analysis
from rotordyn.report.variables import variables
from rotordyn.results.declaration import declared

if TYPE_CHECKING:
    import xarray as xr


def dataset(result: Any) -> xr.Dataset:
    """``result`` with its coordinates (``speed`` [rad/s] beside ``speed_rpm``) and quantities.

    The values are those of the result, not copies, and may only be read.
    """
    import xarray as xr

    parts = variables(result)
    arrays = {v.name: (v.dims, _read_only(v.values), v.attrs) for v in parts}
    coords = {v.name: arrays.pop(v.name) for v in parts if v.role != "quantity"}
    return xr.Dataset(arrays, coords, {"result": type(result).__name__})


def _read_only(values: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    view = values.view()
    view.flags.writeable = False
    return view


def result_of(of: str, data: xr.Dataset) -> Any:
    """The frozen result of the analysis ``of`` that ``data`` was made from.

    Raises
    ------
    InvalidInput : there is no such analysis
    ValueError : it has no such result in this version, or the result has other fields
    """
    name = data.attrs["result"]
    kind = next(_kinds(of, name), None)
    if kind is None:
        raise ValueError(f"no result {name}")
    return restored_as(kind, data)


def restored_as(kind: Any, data: xr.Dataset) -> Any:
    """The result of a ``kind`` that ``data`` was made from; ValueError where it was not."""
    hints, name = get_type_hints(kind), kind.__name__
    values = {}
    for field, info in declared(kind).items():
        place = info.metadata["dims"][0] if info.metadata["role"] == "coordinate" else field
        if place not in data.variables:
            raise ValueError(f"{name} without {field}")
        values[field] = _value(data[place].values, hints[field])
    return kind(**values)


def _kinds(of: str, name: str) -> Iterator[type]:
    """The class of a result, in ``result.py`` or beside the solver of its analysis."""
    solve = analysis(of).solve
    if not isinstance(solve, Code):
        return
    for module in ("result", solve.path.partition(":")[0]):
        with suppress(ModuleNotFoundError):
            kind = getattr(import_module(f"{solve.package}.{module}"), name, None)
            if isinstance(kind, type) and is_dataclass(kind) and declared(kind):
                yield kind


def _value(values: np.ndarray[Any, Any], hint: Any) -> Any:
    """Convert an array to the type annotated for a field: a number, a text, words or the array."""
    if hint in (bool, float, int, str):
        return hint(values[()])
    return tuple(values.tolist()) if hint == tuple[str, ...] else values
