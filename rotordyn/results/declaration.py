"""How a result says what its numbers are: dimensions, unit and label travel with every field.

A result is a frozen dataclass. Its array fields are declared with ``quantity`` (data over named
dimensions) or ``coordinate`` (the values of one dimension); everything else about files, tables and
figures is derived from that declaration.
"""

from __future__ import annotations

from dataclasses import Field, field, fields
from typing import Any

from rotordyn.results.display import Shown, shown


def quantity(*dims: str, unit: str, label: str, printed: Shown | None = None) -> Any:
    """A field with data over ``dims``; ``unit`` of the data (SI), ``label`` for axes and tables.

    ``printed``: another unit of tables and figures than ``display.shown`` gives.
    """
    return field(metadata=_metadata("quantity", dims, unit, label, printed))


def coordinate(dim: str, *, unit: str, label: str, printed: Shown | None = None) -> Any:
    """A field with the values of dimension ``dim`` (numbers, or a tuple of names: unit ``""``)."""
    return field(metadata=_metadata("coordinate", (dim,), unit, label, printed))


def _metadata(
    role: str, dims: tuple[str, ...], unit: str, label: str, printed: Shown | None
) -> dict[str, Any]:
    as_printed = printed or shown(unit)
    return {"role": role, "dims": dims, "unit": unit, "label": label, "printed": as_printed}


def declared(result: Any) -> dict[str, Field[Any]]:
    """The declared fields of a result (instance or class), by name."""
    return {f.name: f for f in fields(result) if "role" in f.metadata}
