"""All results of a run in one NetCDF-4 file, a group per analysis (``variant/analysis`` of many).

Attributes follow the CF conventions (``report.cf``). NetCDF has no complex numbers that every
reader agrees on: a complex ``x`` is stored as ``x_re`` and ``x_im``, each with the name of the
whole variable. Truth values are bytes 0 and 1, flags in the sense of CF, with the attribute
``dtype = "bool"``, as xarray writes them. ``read_results`` undoes both. Words are strings; those of
a dimension stand in a variable of its name, where xarray looks for labels.

xarray reads such a file as well, by its own engine, in ten times the time, since that
looks up the dimensions of every variable anew.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.report.variables import Variable, variables

if TYPE_CHECKING:
    import xarray as xr

NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable"
OF_FORMAT = {
    *("CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST", "_FillValue", "_NCProperties"),
    *("_Netcdf4Dimid", "_Netcdf4Coordinates"),
}
FLAGS: dict[str, Any] = {
    "dtype": "bool",
    "flag_values": np.array([0, 1], np.int8),
    "flag_meanings": "false true",
}


def write_results(
    path: Path, results: Mapping[str, Any], attributes: Mapping[str, str] | None = None
) -> None:
    """Write ``results`` (analysis name -> result) to ``path``; ``attributes`` describe the run."""
    import h5py

    # In memory first: HDF5 itself, on a full disk, ends the process instead of saying so.
    # Under its own name: of two in memory at once, HDF5 refuses the second of the same name.
    with h5py.File(path, "w", driver="core", backing_store=False, track_order=True) as file:
        written_by = f"version=2,h5py={h5py.__version__},hdf5={h5py.version.hdf5_version}"
        file.attrs["_NCProperties"] = np.bytes_(written_by)
        file.attrs.update(attributes or {})
        number = count()
        for name, result in results.items():
            _write_group(file.create_group(name, track_order=True), result, number)
        file.flush()
        content = file.id.get_file_image()
    path.write_bytes(content)


def read_results(path: Path) -> Mapping[str, xr.Dataset]:
    """The groups of a results file by analysis name, with complex variables restored.

    A group is read at every access; the mapping itself holds no data.

    Raises
    ------
    OSError : there is no such file, or it is no NetCDF-4 file
    InvalidInput : it is damaged, also when a group is read
    """
    return _Groups(path)


@contextmanager
def _reading(path: Path) -> Iterator[Any]:
    """Open the file; any error from damage becomes one sentence."""
    import h5py

    with h5py.File(path, "r") as file:
        try:
            yield file
        except (OSError, LookupError, RuntimeError, AttributeError, TypeError, ValueError) as error:
            raise InvalidInput(f"{path} is damaged ({error}): run the case again") from error


class _Groups(Mapping[str, "xr.Dataset"]):
    """Datasets of a file that must not change while it is read."""

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, _state(path)
        with _reading(path) as file:
            self._names = _result_groups(file)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __getitem__(self, name: str) -> xr.Dataset:
        if name not in self._names:
            raise KeyError(name)
        if _state(self._path) != self._state:
            raise InvalidInput(f"{self._path} has been replaced since it was opened: open it again")
        with _reading(self._path) as file:
            return _restored(file[name])


def _state(path: Path) -> tuple[int, int] | None:
    """Identity of a file, by which a replacement is detected; None where there is no file."""
    try:
        status = path.stat()
    except FileNotFoundError:
        return None
    return status.st_ino, status.st_mtime_ns


def _result_groups(group: Any, above: str = "") -> list[str]:
    """Names of the groups that hold a result, those in groups included."""
    import h5py

    names = []
    for name, inner in group.items():
        if isinstance(inner, h5py.Group):
            path = f"{above}{name}"
            names += [path] if "result" in inner.attrs else _result_groups(inner, f"{path}/")
    return names


def _write_group(group: Any, result: Any, number: Iterator[int]) -> None:
    """Write a result to a group; ``number`` counts the dimensions of the whole file."""
    group.attrs["result"] = type(result).__name__
    parts = [half for variable in variables(result) for half in _storable(variable)]
    names = {v.name for v in parts}
    stored = {v.name: _stored(group, v) for v in parts}
    for v in parts:
        if v.role == "quantity" and (covered := _covered(v, parts)):
            stored[v.name].attrs["coordinates"] = covered
    sizes = {d: n for v in parts for d, n in zip(v.dims, v.values.shape, strict=True)}
    scales = {}
    for d, size in sizes.items():
        scales[d] = stored.pop(d, None) or _created(group, d, (size,), ">f4")
        scales[d].make_scale(d if d in names else f"{NO_VARIABLE}.{size:10}")
        scales[d].attrs["_Netcdf4Dimid"] = np.int32(next(number))
    for v in parts:
        if v.name not in scales:
            for axis, d in zip(stored[v.name].dims, v.dims, strict=True):
                axis.attach_scale(scales[d])


def _stored(group: Any, v: Variable) -> Any:
    """Store the values of a variable and its attributes in a group of a file."""
    import h5py

    is_text = v.values.dtype.kind == "U"
    kind = h5py.string_dtype() if is_text else v.values.dtype
    # CF: a missing value is declared, and coordinates have none.
    has_gaps = v.role == "quantity" and v.values.dtype.kind == "f"
    missing = {"_FillValue": np.full(1, np.nan)} if has_gaps else {}
    stored = _created(group, v.name, v.values.shape, kind, np.nan if has_gaps else None)
    if v.values.size:
        stored[...] = v.values.astype(object) if is_text else v.values
    stored.attrs.update(missing | v.attrs)
    return stored


def _created(group: Any, name: str, shape: tuple[int, ...], kind: Any, gap: Any = None) -> Any:
    """Create a variable without values; in NetCDF an empty dimension must be unlimited."""
    grows = {"maxshape": tuple(n or None for n in shape)} if 0 in shape else {}
    return group.create_dataset(name, shape, kind, fillvalue=gap, track_order=True, **grows)


def _covered(variable: Variable, parts: list[Variable]) -> str:
    """Names of the auxiliary coordinates of a variable, which xarray then does not read as data."""
    auxiliary = [v for v in parts if v.role == "auxiliary"]
    return " ".join(v.name for v in auxiliary if set(v.dims) <= set(variable.dims))


def _storable(variable: Variable) -> list[Variable]:
    """The variable in types of NetCDF: complex values in two halves, truth values as bytes."""
    values, attrs = variable.values, variable.attrs
    if values.dtype.kind == "b":
        return [variable._replace(values=values.astype(np.int8), attrs=attrs | FLAGS)]
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


def _restored(group: Any) -> xr.Dataset:
    """A dataset as it was in memory: complex joined, truth values and words of their own types."""
    import xarray as xr

    members = dict(group.items())
    scales = {member.id: name for name, member in members.items() if member.is_scale}
    stored = {
        name: _variable(member, scales)
        for name, member in members.items()
        if member.id not in scales
        or not _text(member.attrs.get("NAME", "")).startswith(NO_VARIABLE)
    }
    for real in [v for v in stored.values() if v.attrs.get("complex_part") == "real"]:
        name = real.attrs["complex_name"]
        halves = stored.pop(f"{name}_re"), stored.pop(f"{name}_im")
        stored[name] = _joined(*halves)
    for variable in stored.values():
        variable.attrs.pop("coordinates", None)
    coordinates = {n for n in stored if n.endswith("speed_rpm") or (n,) == stored[n].dims}
    return xr.Dataset(
        {name: variable for name, variable in stored.items() if name not in coordinates},
        {name: stored[name] for name in coordinates},
        _attributes(group),
    )


def _variable(stored: Any, scales: Mapping[Any, str]) -> xr.Variable:
    """A variable with the names of its dimensions, by their scales."""
    import xarray as xr

    dims = [scales[dim[0].id] if len(dim) else scales[stored.id] for dim in stored.dims]
    attrs = _attributes(stored)
    if stored.dtype.kind == "O":
        values = stored.asstr()[...].astype(str)
    elif attrs.pop("dtype", "") == "bool":
        values = stored[...].astype(bool)
        del attrs["flag_values"], attrs["flag_meanings"]
    else:
        values = stored[...]
    return xr.Variable(dims, values, attrs)


def _attributes(stored: Any) -> dict[str, Any]:
    """Attributes without those of the file format."""
    attrs = stored.attrs
    return {name: _text(attrs[name]) for name in attrs if name not in OF_FORMAT}


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _joined(real: xr.Variable, imaginary: xr.Variable) -> xr.Variable:
    values = np.empty(real.shape, complex)
    values.real, values.imag = real.values, imaginary.values
    joined = real.copy(data=values)
    joined.attrs = {k: v for k, v in real.attrs.items() if not k.startswith("complex_")}
    return joined
