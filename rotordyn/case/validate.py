"""Holds a file against its schema and says in our words what does not fit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from rotordyn import units
from rotordyn.case.faults import Faults
from rotordyn.case.node import UNKNOWN, Node
from rotordyn.case.retired import RETIRED
from rotordyn.case.schema.bearing import kinds_with
from rotordyn.quantity import suggestion

M = TypeVar("M", bound=BaseModel)

_LISTED = 24
_SHAPES = {
    "model_type": "a mapping (key: value)",
    "model_attributes_type": "a mapping (key: value)",
    "dict_type": "a mapping (key: value)",
    "union_tag_not_found": "a mapping (key: value)",
    "list_type": "a list",
    "too_short": "at least one item",
}

_FORMS: dict[object, str] = {
    "<range>": "a range {from, to, step or count}, or a list",
    "<mapping>": "a mapping (key: value), or computed",
}


def validate(model: type[M], root: Node, faults: Faults) -> M | None:
    """The file as an instance of ``model``, or None where too little of it can be used.

    Values found faulty are reported and taken as unknown, so that the instance may still serve
    to check the rest; build nothing from it once ``faults`` holds anything.
    """
    data = root.plain()
    for _ in range(3):
        try:
            return model.model_validate(data)
        except ValidationError as error:
            details = error.errors(include_url=False, include_input=False)
        for detail in details:
            _report(model, root, data, detail, faults)
        for detail in details:
            _put_aside(data, detail)
    return None


def _report(
    model: type[BaseModel], root: Node, data: Any, detail: ErrorDetails, faults: Faults
) -> None:
    keys, kind = detail["loc"], detail["type"]
    if _reach(data, keys)[0] is UNKNOWN:
        return
    if kind == "missing":
        if root.at(*keys[:-1]).child(keys[-1]) is not None:
            return
        faults.missing(root, keys, "missing key: it must be given")
    elif kind == "extra_forbidden":
        _report_unknown(model, root, keys, faults)
    elif kind == "rotordyn":
        faults.at(root, keys, detail["msg"])
    elif kind == "too_long":
        most, count = (detail["ctx"][key] for key in ("max_length", "actual_length"))
        faults.at(root, keys, f"too many items: given {count}; allowed: up to {most}")
    else:
        shown = units.shown(root.at(*keys).value if kind != "too_short" else [])
        given = "an empty list" if kind == "too_short" else shown
        needed = _FORMS.get(keys[-1]) or _SHAPES.get(kind, "another kind of value")
        faults.at(root, keys, f"wrong shape: given {given}; allowed: {needed}")


def _report_unknown(
    model: type[BaseModel], root: Node, keys: tuple[int | str, ...], faults: Faults
) -> None:
    """An unknown key; of a bearing, the key of another kind than is written or than an override
    has made of its model."""
    here, last, sentence = root.at(*keys[:-1]), str(keys[-1]), _unknown_key(model, keys)
    kind, key = here.child("kind"), here.child(last)
    kinds = kinds_with(last) if "ball_diameter" in _keys_at(model, keys[:-1]) else []
    if kinds and kind is None:
        sentence += f"; is 'kind: {kinds[0]}' missing?"
    elif kinds and kind and key and key.file == here.file != kind.file:
        hint = f"; the model gives it: add {last}: null to the override"
        faults.at(root, (*keys[:-1], "kind"), sentence + hint)
        return
    faults.at_key(root, keys, sentence)


def _unknown_key(model: type[BaseModel], keys: tuple[int | str, ...]) -> str:
    allowed = _keys_at(model, keys[:-1])
    given = str(keys[-1])
    if sentence := RETIRED.get((str(keys[-2]) if len(keys) > 1 else "", given)):
        return sentence
    listed = ", ".join(allowed[:_LISTED]) + (", …" if len(allowed) > _LISTED else "")
    return f"unknown key: given {units.shown(given)}; allowed: {listed or 'no keys'}" + suggestion(
        given, allowed
    )


def _keys_at(model: type[BaseModel], keys: tuple[int | str, ...]) -> list[str]:
    """Keys of the entry that a location of pydantic's leads to."""
    entries = [model]
    for key in keys:
        fields = [f for entry in entries for name, f in _fields(entry) if name == key]
        if fields:
            entries = [found for field in fields for found in _models(field.annotation)]
        tagged = [entry for entry in entries if getattr(entry, "tag", "") == key]
        entries = tagged or entries
    return [name for entry in entries for name, _ in _fields(entry)]


def _fields(entry: type[BaseModel]) -> Iterator[tuple[str, Any]]:
    for name, field in entry.model_fields.items():
        yield field.alias or name, field


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for argument in get_args(annotation):
        yield from _models(argument)


def _reach(data: Any, keys: tuple[int | str, ...]) -> tuple[Any, Any, Any]:
    """The value a location leads to, what holds it, and its key there."""
    holder, last = None, None
    for key in keys:
        if _has(data, key):
            holder, last, data = data, key, data[key]
    return data, holder, last


def _has(data: Any, key: int | str) -> bool:
    if isinstance(data, dict):
        return key in data
    return isinstance(data, list) and isinstance(key, int) and key < len(data)


def _put_aside(data: Any, detail: ErrorDetails) -> None:
    keys = detail["loc"]
    if detail["type"] == "missing":
        holder = _reach(data, keys[:-1])[0]
        if isinstance(holder, dict):
            holder[keys[-1]] = UNKNOWN
        return
    value, holder, last = _reach(data, keys)
    if holder is None:
        return
    if isinstance(holder, dict) and (detail["type"] == "extra_forbidden" or value is UNKNOWN):
        holder.pop(last, None)
    else:
        holder[last] = UNKNOWN
