"""Tidy CSV tables in engineering units, laid out from the declaration of each result."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from itertools import product
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.report.variables import as_array
from rotordyn.results.declaration import declared
from rotordyn.results.display import RPM, Shown, load_unit, shown, stiffness_unit
from rotordyn.results.layout import Layout

LAYOUTS = {
    "preload": (
        Layout("preload", ("speed", "bearing"), ("dof", "dof_other")),
        Layout("preload_bodies", ("speed", "body")),
        Layout("preload_sleeves", ("speed", "sleeve")),
        Layout("preload_stops", ("sleeve",)),
    ),
    "campbell": (
        Layout("campbell", ("speed",), ("mode",)),
        Layout("campbell_modes", ("mode",)),
        Layout("campbell_critical", ("critical",)),
        Layout("campbell_shapes", ("shape_speed", "mode", "node"), ("dof",)),
        Layout("campbell_nodes", ("node",), several="rotor"),
        Layout("campbell_rotors", ("rotor",), several="rotor"),
    ),
    "frf": (
        Layout("frf_measured", ("measured",)),
        Layout("frf_measured_peaks", ("measured", "peak")),
    ),
    "stiffness": (
        Layout("stiffness", ("speed", "variant")),
        Layout("stiffness_curves", ("speed", "variant", "force")),
    ),
    "section_forces": (
        Layout("section_forces", ("speed", "cut"), repeating=True),
        Layout("section_forces_reactions", ("speed", "support"), ("component",), repeating=True),
        Layout("section_forces_twist", ("speed", "twist_limit"), repeating=True),
    ),
    "unbalance": (
        Layout("unbalance", ("speed", "point"), ("axis",)),
        Layout("unbalance_forces", ("speed", "support"), ("axis",)),
        Layout("unbalance_acting", ("unbalance",)),
        Layout("unbalance_critical", ("critical",)),
    ),
    "bearing": (
        Layout("bearing", ("speed", "load")),
        Layout("bearing_stiffness", ("speed", "load", "tangent"), ("dof", "dof_other")),
        Layout("bearing_balls", ("speed", "load", "ball")),
        Layout("bearing_contacts", ("speed", "load", "ball", "contact")),
        Layout("bearing_grooves", ("contact",)),
    ),
    "control": (
        Layout("control", ("speed", "boundary")),
        Layout("control_margins", ("speed", "load")),
        Layout("control_fits", ("boundary",), ("term",)),
    ),
}
Column = tuple[str, list[Any]]


def write_tables(folder: Path, results: Mapping[str, Any]) -> list[str]:
    """Write the tables of every result into ``folder``; returns the names of the files."""
    names = []
    for analysis, result in results.items():
        for layout in LAYOUTS.get(analysis, ()):
            if layout.several and len(getattr(result, layout.several)) < 2:
                continue
            columns = tidy_columns(result, layout)
            if columns[0][1]:
                names.append(_write(folder / f"{layout.name}.csv", columns))
        if isinstance(result, FrequencyResponse):
            names += _write_slices(folder, result)
    return names


def tidy_columns(result: Any, layout: Layout) -> list[Column]:
    """Header and values of every column: the coordinates of a row, then its quantities."""
    fields = {name: f.metadata for name, f in declared(result).items()}
    coordinates = {m["dims"][0]: n for n, m in fields.items() if m["role"] == "coordinate"}
    sizes = {d: len(getattr(result, n)) for d, n in coordinates.items()}
    shape = tuple(sizes[d] for d in layout.rows)
    columns = []
    for axis, dim in enumerate(layout.rows):
        values = as_array(getattr(result, coordinates[dim]))
        spread = values.reshape([-1 if a == axis else 1 for a in range(len(shape))])
        own = fields[coordinates[dim]]
        columns.append(_column(own["label"], own["printed"], np.broadcast_to(spread, shape)))
    for name, info in fields.items():
        if info["role"] == "quantity" and _belongs(info["dims"], layout):
            columns += _quantity_columns(result, name, layout, shape)
    return columns


def _belongs(dims: tuple[str, ...], layout: Layout) -> bool:
    rows, own = set(layout.rows), set(dims)
    repeated = dims == ("speed",) and "speed" in rows and len(rows) <= 2
    return (
        repeated or (layout.repeating and own < rows) or (rows <= own <= rows | set(layout.across))
    )


def _quantity_columns(
    result: Any, name: str, layout: Layout, shape: tuple[int, ...]
) -> Iterator[Column]:
    """The columns of one quantity: one, or one per place ``across`` it."""
    info, values = declared(result)[name].metadata, as_array(getattr(result, name))
    across = [d for d in info["dims"] if d not in layout.rows]
    if len(info["dims"]) - len(across) < len(layout.rows):
        own = [n if d in info["dims"] else 1 for d, n in zip(layout.rows, shape, strict=True)]
        values = values.reshape(own)
        yield _column(info["label"], info["printed"], np.broadcast_to(values, shape))
        return
    order = [info["dims"].index(d) for d in (*layout.rows, *across)]
    words = list(product(*(getattr(result, d) for d in across)))
    flat = values.transpose(order).reshape(prod(shape), len(words))
    for place, word in enumerate(words):
        to = _unit_of(word, across) or info["printed"]
        label = f"{info['label']} {','.join(word)}" if word else info["label"]
        yield from _parts(label, to, flat[:, place])


def _unit_of(word: tuple[str, ...], across: list[str]) -> Shown | None:
    """The unit of one place ``across``, where each has its own."""
    if across == ["dof", "dof_other"]:
        return shown(stiffness_unit(*word))
    return shown(load_unit(*word)) if across == ["component"] else None


def _parts(label: str, to: Shown, values: NDArray[Any]) -> Iterator[Column]:
    if values.dtype.kind != "c":
        yield _column(label, to, values)
        return
    yield _column(f"{label} real", to, values.real)
    yield _column(f"{label} imaginary", to, values.imag)


def _column(label: str, to: Shown, values: NDArray[Any]) -> Column:
    header = f"{label} [{to.unit}]" if to.unit else label
    if values.dtype.kind != "f":
        return header, values.ravel().tolist()
    return header, [f"{v:.7g}" for v in (values.ravel() * to.factor).tolist()]


def _write(path: Path, columns: list[Column]) -> str:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([header for header, _ in columns])
        writer.writerows(zip(*(values for _, values in columns), strict=True))
    return path.name


def _write_slices(folder: Path, result: FrequencyResponse) -> list[str]:
    """One table per slice with a solution: a line per frequency, both parts of every pair."""
    names = []
    solved = np.isfinite(result.response).all(axis=(1, 2))
    for index in np.flatnonzero(result.is_slice & solved).tolist():
        columns = [_column("frequency", shown("Hz"), result.frequency)]
        for place, pair in enumerate(result.pair):
            values = result.response[index, place]
            columns += _parts(f"{result.kind} {pair}", shown(result.unit(place)), values)
        rpm = float(result.speed[index]) * RPM.factor
        names.append(_write(folder / f"frf_{rpm:.7g}rpm.csv", columns))
    return names
