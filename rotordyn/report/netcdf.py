"""All results of a run in one NetCDF-4 file, a group per analysis (``variant/analysis`` of many).

Attributes follow the CF conventions (``report.cf``). NetCDF has no complex numbers that every
reader agrees on: a complex ``x`` is stored as ``x_re`` and ``x_im``, each naming the variable it is
part of. Truth values are bytes 0 and 1, flags in the sense of CF, with the attribute
``dtype = "bool"``, as xarray writes them. ``read_results`` undoes both. Words are strings; those of
a dimension stand in a variable of its name, where xarray looks for labels.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.report.variables import Variable, variables

if TYPE_CHECKING:
    import xarray as xr

DIMENSION_ALONE = b"This is a netCDF dimension but not a netCDF variable."
# What HDF5 and NetCDF keep beside the attributes of a variable.
OF_THE_FILE = {
    *("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS"),
    *("_Netcdf4Dimid", "_Netcdf4Coordinates", "_nc3_strict"),
    *("_FillValue", "flag_values", "flag_meanings"),
}
SCALE = b"DIMENSION_SCALE"


def write_results(
    path: Path, results: Mapping[str, Any], attributes: Mapping[str, str] | None = None
) -> None:
    """Write ``results`` (analysis name -> result) to ``path``; ``attributes`` describe the run."""
    import h5netcdf
    import h5py  # noqa: F401, which h5netcdf misses without naming it

    content = BytesIO()  # HDF5 itself, on a full disk, ends the process instead of saying so
    with h5netcdf.File(content, "w") as file:
        file.attrs.update(attributes or {})
        for name, result in results.items():
            _write_group(file.create_group(name), result)
    path.write_bytes(content.getbuffer())


def read_results(path: Path) -> Mapping[str, xr.Dataset]:
    """The groups of a results file by analysis name, complex variables put together again.

    A group is read each time that it is asked for; the mapping itself holds no data.

    Raises
    ------
    OSError : there is no such file, or it is no NetCDF-4 file
    """
    return _Groups(path)


class _Groups(Mapping[str, "xr.Dataset"]):
    """Datasets of a file that must not change while it is read."""

    def __init__(self, path: Path) -> None:
        import h5netcdf

        self._path, self._state = path, _state(path)
        with h5netcdf.File(path, "r") as file:
            self._names = _held(file)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __getitem__(self, name: str) -> xr.Dataset:
        import h5py

        if name not in self._names:
            raise KeyError(name)
        if _state(self._path) != self._state:
            raise InvalidInput(f"{self._path} has been replaced since it was opened: open it again")
        with h5py.File(self._path, "r") as file:
            return _dataset(file[name])


def _state(path: Path) -> tuple[int, int] | None:
    """What tells a file from another that took its place; None where there is none."""
    try:
        status = path.stat()
    except FileNotFoundError:
        return None
    return status.st_ino, status.st_mtime_ns


def _held(group: Any, above: str = "") -> list[str]:
    """Names of the groups that hold a result, those in groups included."""
    names = []
    for name, inner in group.groups.items():
        path = f"{above}{name}"
        names += [path] if "result" in inner.attrs else _held(inner, f"{path}/")
    return names


def _write_group(group: Any, result: Any) -> None:
    import h5py

    group.attrs["result"] = type(result).__name__
    parts = [half for variable in variables(result) for half in _storable(variable)]
    group.dimensions = {d: n for v in parts for d, n in zip(v.dims, v.values.shape, strict=True)}
    auxiliary = " ".join(v.name for v in parts if v.role == "auxiliary")
    for v in parts:
        words = v.values.dtype.kind == "U"
        kind = h5py.string_dtype() if words else v.values.dtype
        # CF: a missing value is declared, and coordinates have none.
        has_gaps = v.role == "quantity" and v.values.dtype.kind == "f"
        missing = {"fillvalue": np.nan} if has_gaps else {}
        stored = group.create_variable(v.name, v.dims, dtype=kind, **missing)
        if v.values.size:
            stored[...] = v.values.astype(object) if words else v.values
        stored.attrs.update(v.attrs)
        if v.role == "quantity" and (covered := _covered(auxiliary, v, parts)):
            stored.attrs["coordinates"] = covered


def _covered(auxiliary: str, variable: Variable, parts: list[Variable]) -> str:
    """Names of the auxiliary coordinates, which xarray then does not take for data."""
    dims = {v.name: v.dims for v in parts}
    fitting = [name for name in auxiliary.split() if set(dims[name]) <= set(variable.dims)]
    return " ".join(fitting)


def _storable(variable: Variable) -> list[Variable]:
    """The variable in the types NetCDF has: complex in two halves, truth values as bytes."""
    values, attrs = variable.values, variable.attrs
    if values.dtype.kind == "b":
        return [variable._replace(values=values.astype(np.int8), attrs=attrs | _flags())]
    if values.dtype.kind != "c":
        return [variable]
    halves = (("re", "real", values.real), ("im", "imaginary", values.imag))
    return [
        variable._replace(
            name=f"{variable.name}_{ending}",
            values=np.ascontiguousarray(half),
            attrs=attrs | {"complex_part": part, "complex_name": variable.name},
        )
        for ending, part, half in halves
    ]


def _flags() -> dict[str, Any]:
    return {
        "dtype": "bool",
        "flag_values": np.array([0, 1], np.int8),
        "flag_meanings": "false true",
    }


def _dataset(group: Any) -> xr.Dataset:
    """A dataset as it was in memory: complex joined, words as strings, no file encodings.

    Read by h5py itself: xarray's way to a variable takes ten times as long as its numbers.
    """
    import xarray as xr

    found = dict(_stored(group))
    attached = " ".join(attrs.pop("coordinates", "") for _, _, attrs in found.values()).split()
    halves = {name: v for name, v in found.items() if "complex_part" in v[2]}
    arrays = {name: v for name, v in found.items() if name not in halves}
    for dims, real, attrs in halves.values():
        if attrs["complex_part"] == "real":
            whole = attrs["complex_name"]
            values = np.empty(real.shape, complex)
            values.real, values.imag = real, found[f"{whole}_im"][1]
            kept = {k: v for k, v in attrs.items() if not k.startswith("complex_")}
            arrays[whole] = dims, values, kept
    coords = {
        name: arrays.pop(name)
        for name, (dims, _, _) in found.items()
        if dims == (name,) or name in attached or name.endswith("speed_rpm")
    }
    return xr.Dataset(arrays, coords, {"result": group.attrs["result"]})


def _stored(group: Any) -> Iterator[tuple[str, tuple[tuple[str, ...], Any, dict[str, Any]]]]:
    """Name, dimensions, values and attributes of every variable of a group."""
    import h5py

    def address(place: Any) -> int:
        found: int = h5py.h5o.get_info(place).addr
        return found

    members = list(group.items())
    dims = {
        address(v.id): name for name, v in members if v.attrs.get("CLASS") == b"DIMENSION_SCALE"
    }
    for name, v in members:
        attrs = dict(v.attrs.items())
        if attrs.get("NAME", b"").startswith(DIMENSION_ALONE):
            continue
        lists = attrs.get("DIMENSION_LIST", ())
        places = tuple(dims[address(h5py.h5r.dereference(ref[0], v.id))] for ref in lists)
        values = v.asstr()[...].astype(str) if v.dtype.kind == "O" else v[...]
        if attrs.pop("dtype", None) == "bool":
            values = values.astype(bool)
        kept = {k: a for k, a in attrs.items() if k not in OF_THE_FILE}
        yield name, (places or (name,) * v.ndim, values, kept)
