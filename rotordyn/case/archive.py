"""Convert a case to JSON values and back, so that a results folder contains its case.

Every description is a frozen dataclass whose fields are its constructor's arguments; it is stored
as these, with the name of its class. Floats keep all digits.
"""

from __future__ import annotations

import importlib
import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

from rotordyn.analyses.registry import analysis, names
from rotordyn.case.case import Case
from rotordyn.case.uncertain import Uncertain
from rotordyn.description import Description
from rotordyn.errors import InvalidInput

KIND = "is"  # the key that names a class
_ROOMS = ("rotordyn.machine", "rotordyn.analyses", "bearings")


def archived(value: Any) -> Any:
    """Convert a case or a part of it to JSON values.

    Paths keep only folder and file name. Raises TypeError for values that descriptions never have.
    """
    if isinstance(value, bool | int | str) or value is None:
        return value
    if isinstance(value, tuple | list):
        return [archived(each) for each in value]
    if isinstance(value, float) and math.isfinite(value):
        return value
    if is_dataclass(value):
        content = {field.name: archived(getattr(value, field.name)) for field in fields(value)}
        return {KIND: type(value).__name__, **content}
    return _named(value)


def _named(value: Any) -> dict[str, Any]:
    """Convert a value that JSON lacks to an object with the name of its kind."""
    match value:
        case float():
            return {KIND: "float", "value": str(value)}
        case complex():
            return {KIND: "complex", "value": [archived(value.real), archived(value.imag)]}
        case Path():
            return {KIND: "Path", "value": f"{value.parent.name}/{value.name}"}
        case Mapping():
            pairs = [[archived(key), archived(each)] for key, each in value.items()]
            return {KIND: "mapping", "value": pairs}
    raise TypeError(f"no description holds {type(value).__name__}")


def restored(plain: Any) -> Any:
    """Convert the result of ``archived`` back; every description is checked as it is built.

    Raises
    ------
    InvalidInput : this version has no such description, or it has other fields
    """
    if isinstance(plain, list):
        return tuple(restored(each) for each in plain)
    if not isinstance(plain, dict):
        return plain
    name = plain.get(KIND)
    if name in _PLAIN:
        return _PLAIN[name](plain["value"])
    kind = _HERE[name] if name in _HERE else _kind(name)
    arguments = {key: restored(each) for key, each in plain.items() if key != KIND}
    try:
        return kind(**arguments)
    except TypeError as error:
        raise InvalidInput(f"{name} has other fields in this version: {error}") from None


def _kind(name: object) -> Any:
    """Class of a description by name; for external analyses it is in the module of their spec."""
    for room in map(importlib.import_module, _ROOMS):
        if name in room.__all__:
            return getattr(room, str(name))
    for module in {analysis(each).spec.__module__: None for each in names()}:
        kind = getattr(sys.modules[module], str(name), None)
        if isinstance(kind, type) and issubclass(kind, Description):
            return kind
    raise InvalidInput(f"this version has no {name}")


_HERE: dict[object, Any] = {"Case": Case, "Uncertain": Uncertain}
_PLAIN: dict[object, Callable[[Any], Any]] = {
    "float": float,
    "complex": lambda parts: complex(*map(restored, parts)),
    "Path": Path,
    "mapping": lambda pairs: {restored(key): restored(each) for key, each in pairs},
}
