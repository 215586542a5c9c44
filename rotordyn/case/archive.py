"""A case as plain values that JSON holds, and back: so that a results folder knows its case.

Every description is a frozen dataclass whose fields are its constructor's arguments; it is stored
as these, with the name of its class. Floats keep every digit.
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
    """``value``, a case or a part of one, as lists, objects, texts and numbers of JSON.

    Files are named by folder and file alone. Raises TypeError for what no description holds.
    """
    if isinstance(value, bool | int | str) or value is None:
        return value
    if isinstance(value, tuple | list):
        return [archived(each) for each in value]
    if isinstance(value, float) and math.isfinite(value):
        return value
    if is_dataclass(value):
        held = {field.name: archived(getattr(value, field.name)) for field in fields(value)}
        return {KIND: type(value).__name__, **held}
    return _named(value)


def _named(value: Any) -> dict[str, Any]:
    """What JSON has no form for, under the name of its kind."""
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
    """What ``archived`` made ``plain`` from; every description is checked as it is built.

    Raises
    ------
    InvalidInput : this version has no such description, or builds it from other fields
    """
    if isinstance(plain, list):
        return tuple(restored(each) for each in plain)
    if not isinstance(plain, dict):
        return plain
    name = plain.get(KIND)
    if name in _PLAIN:
        return _PLAIN[name](plain["value"])
    kind = _HERE[name] if name in _HERE else _kind(name)
    held = {key: restored(each) for key, each in plain.items() if key != KIND}
    try:
        return kind(**held)
    except TypeError as error:
        raise InvalidInput(f"{name} has other fields in this version: {error}") from None


def _kind(name: object) -> Any:
    """The class of a description, by its name; of analyses outside it stands beside their spec."""
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
