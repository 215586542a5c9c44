"""Tidy CSV tables in engineering units, laid out from the declaration of each result."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise, product
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.registry import analysis
from rotordyn.report.variables import as_array
from rotordyn.results.declaration import declared
from rotordyn.results.display import Shown, load_unit, shown, stiffness_unit
from rotordyn.results.layout import Layout

Column = tuple[str, list[Any]]


def write_tables(folder: Path, results: Mapping[str, Any]) -> list[str]:
    """Write the tables of every result into ``folder``; returns the names of the files."""
    names = []
    for name, result in results.items():
        for layout in analysis(name).tables:
            if layout.several and len(getattr(result, layout.several)) < 2:
                continue
            columns = tidy_columns(result, layout)
            if columns[0][1]:
                names.append(write_table(folder / f"{layout.name}.csv", columns))
        for table in analysis(name).further_tables(result):
            columns = [part for column in table.columns for part in _parts(*column)]
            names.append(write_table(folder / f"{table.name}.csv", columns))
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
        field = fields[coordinates[dim]]
        columns.append(_column(field["label"], field["printed"], np.broadcast_to(spread, shape)))
    for name, info in fields.items():
        if info["role"] == "quantity" and _belongs(info["dims"], layout):
            columns += _quantity_columns(result, name, layout, shape)
    return columns


def _belongs(dims: tuple[str, ...], layout: Layout) -> bool:
    rows, extent = set(layout.rows), set(dims)
    repeated = dims == ("speed",) and "speed" in rows and len(rows) <= 2
    return (
        repeated
        or (layout.repeating and extent < rows)
        or (rows <= extent <= rows | set(layout.across))
    )


def _quantity_columns(
    result: Any, name: str, layout: Layout, shape: tuple[int, ...]
) -> Iterator[Column]:
    """Columns of one quantity: one, or one per entry ``across`` it."""
    info, values = declared(result)[name].metadata, as_array(getattr(result, name))
    across = [d for d in info["dims"] if d not in layout.rows]
    if len(info["dims"]) - len(across) < len(layout.rows):
        extent = [n if d in info["dims"] else 1 for d, n in zip(layout.rows, shape, strict=True)]
        values = values.reshape(extent)
        yield _column(info["label"], info["printed"], np.broadcast_to(values, shape))
        return
    order = [info["dims"].index(d) for d in (*layout.rows, *across)]
    entries = list(product(*(getattr(result, d) for d in across)))
    flat = values.transpose(order).reshape(prod(shape), len(entries))
    for place, entry in enumerate(entries):
        unit = (
            _unit_by_name(entry, across)
            or _listed_unit(result, name, entry, across)
            or info["printed"]
        )
        label = f"{info['label']} {','.join(entry)}" if entry else info["label"]
        yield from _parts(label, unit, flat[:, place])


def _unit_by_name(entry: tuple[str, ...], across: list[str]) -> Shown | None:
    """Unit of one entry ``across``, where its name determines the unit."""
    if across == ["dof", "dof_other"]:
        return shown(stiffness_unit(*entry))
    return shown(load_unit(*entry)) if across == ["component"] else None


def _listed_unit(result: Any, name: str, entry: tuple[str, ...], across: list[str]) -> Shown | None:
    """Unit of one entry ``across`` of a field that lists units: that of this entry, or the one that
    all have."""
    units = [*result.entry_units(name)] if hasattr(result, "entry_units") else []
    if len(set(units)) == 1:
        return shown(units[0])
    entries = [*getattr(result, across[0])] if len(across) == 1 else []
    return shown(units[entries.index(entry[0])]) if units and len(entries) == len(units) else None


def _parts(label: str, unit: Shown, values: NDArray[Any]) -> Iterator[Column]:
    if values.dtype.kind != "c":
        yield _column(label, unit, values)
        return
    yield _column(f"{label} real", unit, values.real)
    yield _column(f"{label} imaginary", unit, values.imag)


def _column(label: str, unit: Shown, values: NDArray[Any]) -> Column:
    header = f"{label} [{unit.unit}]" if unit.unit else label
    if values.dtype.kind != "f":
        return header, values.ravel().tolist()
    return header, _printed((values.ravel() * unit.factor).tolist())


def _printed(values: list[float]) -> list[str]:
    """Numbers with 7 digits, or 12 where ascending ones would not differ."""
    cells = number_cells(values)
    pairs = zip(pairwise(cells), pairwise(values), strict=True)
    ambiguous = any(a == b and x < y for (a, b), (x, y) in pairs)
    return number_cells(values, 12) if ambiguous else cells


def number_cells(values: Iterable[float], digits: int = 7) -> list[str]:
    """Numbers with ``digits`` digits as text; empty for NaN."""
    return ["" if math.isnan(value) else f"{value:.{digits}g}" for value in values]


def write_table(path: Path, columns: Iterable[Column]) -> str:
    """Write a CSV file of columns; returns its name."""
    columns = list(columns)
    with path.open("w", newline="", encoding="utf-8-sig") as file:  # Excel needs the mark for UTF-8
        writer = csv.writer(file)
        writer.writerow([header for header, _ in columns])
        writer.writerows(zip(*(values for _, values in columns), strict=True))
    return path.name
