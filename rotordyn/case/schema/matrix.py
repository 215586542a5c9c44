"""The stiffness or damping matrix of a linear support: by its entries, or written whole."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import Annotated, Any, cast

from pydantic import (
    BeforeValidator,
    Discriminator,
    PlainValidator,
    Tag,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    create_model,
)
from pydantic_core import InitErrorDetails, PydanticCustomError

from rotordyn.case.node import UNKNOWN
from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.shapes import FREEDOM_LIST
from rotordyn.case.schema.values import Reader, given, quantity, wrong
from rotordyn.machine.support import FREEDOMS, entry_name

_UNITS = {"stiffness": ("N/m", "N/rad", "N m/rad"), "damping": ("N s/m", "N s/rad", "N m s/rad")}
_BOUND = {"stiffness": "1e13", "damping": "1e10"}
_KNOWN = set(FREEDOMS)
_WHOLE = ("freedoms", "matrix")


ENTRIES = {entry_name(r, c): (r, c) for r, c in product(FREEDOMS, FREEDOMS)}


def _readers(kind: str) -> tuple[PlainValidator, ...]:
    """Readers of an entry by how many of its two freedoms are rotations."""
    kinds = (kind, f"coupling {kind}", f"tilt {kind}")
    limits = (f"{_BOUND[kind]} {unit}" for unit in _UNITS[kind])
    return tuple(
        quantity(k, at_least=f"-{limit}", at_most=limit)
        for k, limit in zip(kinds, limits, strict=True)
    )


def _rotations(row: str, column: str) -> int:
    return sum(len(freedom) > 1 for freedom in (row, column))


def _by_entries(title: str, kind: str) -> Any:
    """An entry with one optional key per place of a 6×6 matrix: a value, or one per speed."""
    types = [Annotated[float | tuple[float, ...], _or_row(one)] for one in _readers(kind)]
    fields: dict[str, Any] = {
        key: (types[_rotations(*pair)] | None, None) for key, pair in ENTRIES.items()
    }
    return create_model(title, __base__=Entry, **fields)


def _or_row(reader: PlainValidator) -> PlainValidator:
    """Reads one value, or a list of them as a tuple."""
    one, shape = cast(Reader, reader.func), reader.json_schema_input_type

    def read(value: Any) -> float | tuple[float, ...]:
        if not isinstance(value, list):
            return cast(float, one(value))
        found, faults = [], list[InitErrorDetails]()
        for index, item in enumerate(value):
            try:
                found.append(one(item))
            except PydanticCustomError as error:
                faults.append({"type": wrong(error.message()), "loc": (index,), "input": item})
        if faults:
            raise ValidationError.from_exception_data("entry", faults)
        return tuple(found)

    return PlainValidator(read, json_schema_input_type=shape | list[shape])  # type: ignore[valid-type]


def _freedoms(value: Any) -> list[str]:
    if value is UNKNOWN:
        return []
    names = value if isinstance(value, list) else []
    if not names or len(set(map(str, names))) < len(names) or not set(map(str, names)) <= _KNOWN:
        shown = given(", ".join(map(str, names)) if names else value)
        raise wrong(
            f"not freedoms: given {shown}; allowed: different ones of {', '.join(FREEDOMS)}"
        )
    return names


def _cells(kind: str) -> Callable[[Any, ValidationInfo], list[list[float]]]:
    """Reader of all entries of a matrix, row by row, each fault at its own entry."""
    readers = [cast(Reader, reader.func) for reader in _readers(kind)]

    def read(value: Any, info: ValidationInfo) -> list[list[float]]:
        freedoms = (info.data or {}).get("freedoms", [])
        if value is UNKNOWN or not freedoms:
            return []
        _square(value, len(freedoms))
        faults: list[InitErrorDetails] = []
        matrix = [[0.0] * len(freedoms) for _ in freedoms]
        for i, j in product(range(len(freedoms)), repeat=2):
            cell, pair = value[i][j], (freedoms[i], freedoms[j])
            try:
                matrix[i][j] = 0.0 if _is_zero(cell) else readers[_rotations(*pair)](cell)
            except PydanticCustomError as error:
                named = wrong(f"entry {entry_name(*pair)}: {error.message()}")
                faults.append({"type": named, "loc": (i, j), "input": cell})
        if faults:
            raise ValidationError.from_exception_data("matrix", faults)
        return matrix

    return read


def _is_zero(cell: Any) -> bool:
    """A bare 0 is the same in every unit."""
    return isinstance(cell, int | float) and not isinstance(cell, bool) and cell == 0


def _square(value: Any, size: int) -> None:
    rows = value if isinstance(value, list) else []
    lengths = [len(row) if isinstance(row, list) else 0 for row in rows]
    if lengths != [size] * size:
        count = f"{len(rows)} rows of {', '.join(map(str, lengths))}" if rows else given(value)
        raise wrong(f"not a matrix of its freedoms: given {count}; allowed: {size} rows of {size}")


_FREEDOM_LIST = Annotated[Any, WithJsonSchema(FREEDOM_LIST)]
Freedoms = Annotated[list[str], PlainValidator(_freedoms, json_schema_input_type=_FREEDOM_LIST)]
_Rows = list[list[str | float]]


class WholeStiffnessEntry(Entry):
    """Rows and columns of a stiffness matrix in the order of its freedoms, 1×1 to 6×6."""

    freedoms: Freedoms
    matrix: Annotated[
        list[list[float]], PlainValidator(_cells("stiffness"), json_schema_input_type=_Rows)
    ]


class WholeDampingEntry(Entry):
    """Rows and columns of a damping matrix in the order of its freedoms, 1×1 to 6×6."""

    freedoms: Freedoms
    matrix: Annotated[
        list[list[float]], PlainValidator(_cells("damping"), json_schema_input_type=_Rows)
    ]


StiffnessMatrixEntry: Any = _by_entries("StiffnessMatrixEntry", "stiffness")
DampingMatrixEntry: Any = _by_entries("DampingMatrixEntry", "damping")


def _one_way(value: Any) -> Any:
    """A matrix is written in one of its forms."""
    if isinstance(value, dict) and any(k in value for k in _WHOLE):
        both = [key for key in value if key in ENTRIES]
        if both:
            raise wrong(
                f"both ways of writing a matrix: given {', '.join(both)} beside freedoms and "
                "matrix; allowed: entries by name, or freedoms and matrix"
            )
    return value


def _way(value: Any) -> str:
    whole = isinstance(value, WholeStiffnessEntry | WholeDampingEntry) or (
        isinstance(value, dict) and any(key in value for key in _WHOLE)
    )
    return "<whole>" if whole else "<entries>"


def _either(whole: Any, named: Any) -> Any:
    forms: Any = Annotated[whole, Tag("<whole>")] | Annotated[named, Tag("<entries>")]
    return Annotated[forms, Discriminator(_way), BeforeValidator(_one_way)]


StiffnessMatrix: Any = _either(WholeStiffnessEntry, StiffnessMatrixEntry)
DampingMatrix: Any = _either(WholeDampingEntry, DampingMatrixEntry)


def entries(matrix: Any) -> dict[tuple[str, str], Any]:
    """What a matrix says, by pair of freedoms, however it is written; NaN where it is faulty.

    A value, or a tuple of one per speed.
    """
    if isinstance(matrix, WholeStiffnessEntry | WholeDampingEntry):
        if not matrix.matrix:
            return dict.fromkeys(ENTRIES.values(), math.nan)
        places = product(matrix.freedoms, matrix.freedoms)
        values = (value for row in matrix.matrix for value in row)
        return dict(zip(places, values, strict=False))
    named = {pair: getattr(matrix, key) for key, pair in ENTRIES.items()}
    return {pair: value for pair, value in named.items() if value is not None}
