"""A result as an xarray Dataset: complex in memory, units and labels as attributes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rotordyn.report.variables import variables

if TYPE_CHECKING:
    import xarray as xr


def dataset(result: Any) -> xr.Dataset:
    """``result`` with its coordinates (``speed`` [rad/s] beside ``speed_rpm``) and quantities."""
    import xarray as xr

    parts = variables(result)
    arrays = {v.name: (v.dims, v.values, v.attrs) for v in parts}
    coords = {v.name: arrays.pop(v.name) for v in parts if v.role != "quantity"}
    return xr.Dataset(arrays, coords, {"result": type(result).__name__})
