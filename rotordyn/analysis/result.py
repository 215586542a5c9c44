"""How a result says what its numbers are: dimensions, unit and label travel with every field.

A result is a frozen dataclass. Its array fields are declared with ``quantity`` (data over named
dimensions) or ``coordinate`` (the values of one dimension); everything else about files, tables and
figures is derived from that declaration.
"""

from __future__ import annotations

from dataclasses import Field, field, fields
from typing import Any


def quantity(*dims: str, unit: str, label: str) -> Any:
    """A field with data over ``dims``; ``unit`` as printed (SI), ``label`` for axes and tables."""
    return field(metadata={"role": "quantity", "dims": dims, "unit": unit, "label": label})


def coordinate(dim: str, *, unit: str, label: str) -> Any:
    """A field with the values of dimension ``dim`` (numbers, or a tuple of names: unit ``""``)."""
    return field(metadata={"role": "coordinate", "dims": (dim,), "unit": unit, "label": label})


def declared(result: Any) -> dict[str, Field[Any]]:
    """The declared fields of a result (instance or class), by name."""
    return {f.name: f for f in fields(result) if "role" in f.metadata}
