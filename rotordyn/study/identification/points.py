"""Measured points in a CSV file: a header with column names and units, then numbers."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import Quantity
from rotordyn.units import KINDS, parse_unit

HEAD = re.compile(r"\s*([\w ]+?)\s*(?:\[([^\]]*)\])?\s*")


def read_points(
    path: Path, columns: Mapping[str, Quantity | None]
) -> tuple[dict[str, Array], dict[str, tuple[str, ...]], tuple[str, ...]]:
    """Read a table: numbers [SI] and texts by column name, and file and line of each row.

    ``columns``: quantity of each column, None for text; all columns are required.

    Raises
    ------
    InvalidInput : no file; a column that is missing, unknown or in a wrong unit; a row that is
        short, holds no number, or one out of range. The sentence names the file and the line
    """
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "is not text in UTF-8"
        raise InvalidInput(f"{path}: cannot be read: {why}") from None
    rows = [
        (number, row)
        for number, row in enumerate(csv.reader(lines), start=1)
        if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")
    ]
    if not rows:
        raise InvalidInput(f"{path}: holds no table; allowed: columns {_allowed(columns)}")
    units = _head(path, *rows[0], columns)
    numbers: dict[str, list[float]] = {n: [] for n, held in columns.items() if held is not None}
    words: dict[str, list[str]] = {n: [] for n, held in columns.items() if held is None}
    for line, row in rows[1:]:
        if len(row) != len(rows[0][1]):
            raise InvalidInput(
                f"{path}:{line}: has {len(row)} cells where the head has {len(rows[0][1])}"
            )
        for place, (name, unit) in units.items():
            if (quantity := columns[name]) is None:
                words[name].append(row[place].strip())
                continue
            value = _number(path, line, name, row[place]) * parse_unit(unit).scale
            if why := quantity.refusal(value, f"{row[place].strip()} {unit}"):
                raise InvalidInput(f"{path}:{line}: {name}: {why}")
            numbers[name].append(value)
    arrays = {name: np.array(values) for name, values in numbers.items()}
    places = tuple(f"{path.name}:{line}" for line, _ in rows[1:])
    return arrays, {name: tuple(values) for name, values in words.items()}, places


def _head(
    path: Path, line: int, cells: list[str], columns: Mapping[str, Quantity | None]
) -> dict[int, tuple[str, str]]:
    """Name and unit of each column by its index."""
    named: dict[int, tuple[str, str]] = {}
    for place, cell in enumerate(cells):
        match = HEAD.fullmatch(cell)
        name = match.group(1) if match else cell
        if name not in columns:
            raise InvalidInput(
                f"{path}:{line}: unknown column {shown(cell.strip())}; allowed: {_allowed(columns)}"
            )
        if name in (present for present, _ in named.values()):
            raise InvalidInput(f"{path}:{line}: has the column {name} twice")
        named[place] = name, _unit(path, line, cell, columns[name], match.group(2))  # type: ignore[union-attr]
    for name in columns:
        if name not in (present for present, _ in named.values()):
            raise InvalidInput(
                f"{path}:{line}: lacks the column {name}; needed: {_allowed(columns)}"
            )
    return named


def _unit(path: Path, line: int, cell: str, held: Quantity | None, unit: str | None) -> str:
    if held is None:
        return ""
    allowed = KINDS[held.kind]
    if unit is None:
        raise InvalidInput(
            f"{path}:{line}: {shown(cell.strip())} has no unit; allowed: {', '.join(allowed)}"
        )
    try:
        given = parse_unit(unit)
    except InvalidInput:
        given = None
    if given is None or given.dimension not in {parse_unit(u).dimension for u in allowed}:
        raise InvalidInput(
            f"{path}:{line}: {shown(cell.strip())} is in no unit of {held.kind}; allowed: "
            f"{', '.join(allowed)}"
        )
    return unit


def _number(path: Path, line: int, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise InvalidInput(f"{path}:{line}: {name} is not a number: given {shown(cell.strip())}")
    return value


def _allowed(columns: Mapping[str, Quantity | None]) -> str:
    return ", ".join(
        name if held is None else f"{name} [{', '.join(KINDS[held.kind])}]"
        for name, held in columns.items()
    )
