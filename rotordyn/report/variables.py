"""A result as a list of named arrays, read off its declaration: what every file is made from."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.report.cf import SIGN_CONVENTION, units
from rotordyn.results.declaration import absence, declared


class Variable(NamedTuple):
    """An array over named dimensions.

    ``role``: ``"coordinate"`` (the values of a dimension), ``"auxiliary"`` (the same values in
    another unit) or ``"quantity"``. ``attrs``: ``long_name``, ``units`` (or ``units_of_entries``,
    where they differ); ``comment``: how it is read, and where it has no number other than by an
    outcome; of complex values ``sign_convention``.
    """

    name: str
    role: str
    dims: tuple[str, ...]
    values: NDArray[Any]
    attrs: dict[str, str]


def variables(result: Any) -> list[Variable]:
    """Every declared field of ``result``; a speed is followed by itself in rpm."""
    return [variable for name in declared(result) for variable in _variables(result, name)]


def as_array(value: Any) -> NDArray[Any]:
    """``value`` as an array; a tuple holds words."""
    return np.array(value, dtype=str) if isinstance(value, tuple) else np.asarray(value)


def _variables(result: Any, name: str) -> Iterator[Variable]:
    info = declared(result)[name].metadata
    values = as_array(getattr(result, name))
    attrs = {"long_name": info["label"], **units(_unit(result, name, info["unit"]))}
    if remarks := [*filter(None, (info.get("comment"), absence(info)))]:
        attrs["comment"] = "; ".join(remarks)
    if values.dtype.kind == "c":
        attrs["sign_convention"] = SIGN_CONVENTION
    dims = info["dims"]
    if info["role"] == "quantity":
        yield Variable(name, "quantity", dims, values, attrs)
        return
    yield Variable(dims[0], "coordinate", dims, values, attrs)
    if info["unit"] == "rad/s":
        rpm = {"long_name": info["label"], "units": "rpm"}
        yield Variable(f"{dims[0]}_rpm", "auxiliary", dims, values * (30.0 / math.pi), rpm)


def _unit(result: Any, name: str, declared_unit: str) -> str:
    """SI unit of a field; a list by entry where the ``entry_units`` of the result differ."""
    entries = result.entry_units(name) if hasattr(result, "entry_units") else ()
    return ", ".join(entries if len(set(entries)) > 1 else entries[:1]) or declared_unit
