"""A result as an xarray Dataset, complex in memory, units and labels as attributes; and back."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, get_type_hints

import numpy as np

from rotordyn.analyses.registry import BEARING_ANALYSES, SPINDLE_ANALYSES
from rotordyn.report.variables import variables
from rotordyn.results.declaration import declared

if TYPE_CHECKING:
    import xarray as xr


def dataset(result: Any) -> xr.Dataset:
    """``result`` with its coordinates (``speed`` [rad/s] beside ``speed_rpm``) and quantities.

    The values are those of the result, not copies.
    """
    import xarray as xr

    parts = variables(result)
    arrays = {v.name: (v.dims, v.values, v.attrs) for v in parts}
    coords = {v.name: arrays.pop(v.name) for v in parts if v.role != "quantity"}
    return xr.Dataset(arrays, coords, {"result": type(result).__name__})


def result_of(analysis: str, data: xr.Dataset) -> Any:
    """The frozen result of ``analysis`` that ``data`` was made from.

    Raises
    ------
    ValueError : this version has no such result, or its fields are others
    """
    name = data.attrs["result"]
    if analysis not in SPINDLE_ANALYSES | BEARING_ANALYSES:
        raise ValueError(f"no analysis {analysis}")
    kind = getattr(import_module(f"rotordyn.analyses.{analysis}.result"), name, None)
    if kind is None or not declared(kind):
        raise ValueError(f"no result {name}")
    hints = get_type_hints(kind)
    values = {}
    for field, info in declared(kind).items():
        place = info.metadata["dims"][0] if info.metadata["role"] == "coordinate" else field
        if place not in data.variables:
            raise ValueError(f"{name} without {field}")
        values[field] = _value(data[place].values, hints[field])
    return kind(**values)


def _value(values: np.ndarray[Any, Any], hint: Any) -> Any:
    """An array as what a field is annotated to hold: a number, a text, words or the array."""
    if hint in (float, int, str):
        return hint(values[()])
    return tuple(values.tolist()) if hint == tuple[str, ...] else values
