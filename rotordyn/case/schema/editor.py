"""The schema of each kind of file as JSON Schema (draft 2020-12), for editors."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, get_args

from pydantic import PlainValidator
from pydantic.fields import FieldInfo
from pydantic.json_schema import models_json_schema

from bearings.kinds import DEFAULT, KINDS
from rotordyn.case.library import known
from rotordyn.case.schema.base import Entry, title
from rotordyn.case.schema.bearing import BearingEntry, entry_of
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.material import MaterialEntry
from rotordyn.case.schema.meanings import meanings
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.schema.values import QuantityReader
from rotordyn.errors import InvalidInput
from rotordyn.quantity import suggestion

Shape = dict[str, Any]
FILES: dict[str, type[Entry]] = {
    "case": CaseEntry,
    "spindle": SpindleEntry,
    "tool": ToolEntry,
    "bearing": BearingEntry,
    "material": MaterialEntry,
}
BEARINGS = {entry_of(kind).__name__: kind for kind in KINDS}
# Entries that stand in files of their own, and the folder of the library that holds these.
_MODELS = {
    "SpindleEntry": "spindles",
    "ToolEntry": "tools",
    "BearingEntry": "bearings",
    "MaterialEntry": "materials",
}
# Keys of a case under which a model is named; the case's own entry leaves them open.
_MACHINES = {"spindle": "SpindleEntry", "tool": "ToolEntry", "bearing": "BearingEntry"}


def json_schema(file: str) -> Shape:
    """The JSON Schema of one kind of file, a key of ``FILES``.

    Raises
    ------
    InvalidInput : there is no such kind of file
    """
    if file not in FILES:
        allowed = f"allowed: {', '.join(FILES)}{suggestion(file, FILES)}"
        raise InvalidInput(f"unknown kind of file: {file!r}; {allowed}")
    kinds = [entry_of(kind) for kind in KINDS]
    asked = [(entry, "validation") for entry in (*FILES.values(), *kinds)]
    shapes: Shape = models_json_schema(asked, by_alias=True)[1]["$defs"]  # type: ignore[arg-type]
    for entry in _entries():
        _describe(entry, shapes[entry.__name__])
    shapes[BearingEntry.__name__] = _by_kind(shapes)
    root = shapes[FILES[file].__name__]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **root,
        "title": f"rotordyn {file}",
        "$defs": {name: shapes[name] for name in sorted(_reached(root, shapes))},
    }


def _entries() -> list[type[Entry]]:
    """The entries of all files and those they hold."""
    found = [*FILES.values(), *(entry_of(kind) for kind in KINDS)]
    for entry in found:
        held = (m for field in entry.model_fields.values() for m in _held(field.annotation))
        found += [model for model in dict.fromkeys(held) if model not in found]
    return found


def _held(annotation: Any) -> Iterator[type[Entry]]:
    if isinstance(annotation, type) and issubclass(annotation, Entry):
        yield annotation
    for argument in get_args(annotation):
        yield from _held(argument)


def _describe(entry: type[Entry], shape: Shape) -> None:
    """Says what each key means and takes; titles that only repeat the key are left out."""
    shape["title"], shape["description"] = title(entry), _plain(entry.__doc__ or "")
    words = meanings(entry)
    for name, field in entry.model_fields.items():
        key = field.alias or name
        shape["properties"][key] = _property(key, field, shape["properties"][key])
        said = [_plain(words.get(key, "")), _text_of(shape["properties"][key])]
        shape["properties"][key]["description"] = "; ".join(filter(None, said))


def _property(key: str, field: FieldInfo, shape: Shape) -> Shape:
    shape.pop("title", None)
    shape.pop("default", None)
    if field.annotation is Any and key in _MACHINES:
        return _reference(_MACHINES[key])
    models = _models_in(shape)
    if models:
        return _reference(models[0])
    if "patternProperties" in shape:
        shape["additionalProperties"] = False
    default = _default(field)
    return shape if default is None else {**shape, "default": default}


def _models_in(shape: Shape) -> list[str]:
    """Entries of files of their own among the forms of a value; a bearing is of any kind."""
    forms = [f for form in shape.get("anyOf", []) for f in (form, *form.get("oneOf", []))]
    named = [str(form.get("$ref", "")).rpartition("/")[2] for form in forms]
    return [name for name in (_shared(name) for name in named) if name in _MODELS]


def _shared(name: str) -> str:
    return BearingEntry.__name__ if name in BEARINGS else name


def _by_kind(shapes: Shape) -> Shape:
    """A bearing, its keys by its kind."""
    about = {key: shapes[BearingEntry.__name__][key] for key in ("title", "description")}
    forms = []
    for name, kind in BEARINGS.items():
        shape = shapes[name]["properties"]["kind"]
        shape["enum"] = [kind]
        if kind != DEFAULT:
            del shape["default"]
            shapes[name]["required"] = ["kind", *shapes[name]["required"]]
        forms.append({"$ref": f"#/$defs/{name}"})
    return {**about, "oneOf": forms}


def _reference(entry: str) -> Shape:
    """A model: a name of the library, the path of a file, or a mapping in place."""
    path = {"type": "string", "pattern": r"[/\\]|\.ya?ml$"}
    names: list[str | int] = [*known(_MODELS[entry])]
    names += [int(name) for name in known(_MODELS[entry]) if name.isdecimal()]
    return {"anyOf": [{"enum": names}, path, {"$ref": f"#/$defs/{entry}"}]}


def _default(field: FieldInfo) -> Any:
    """The default as written in a file; None where there is nothing to write."""
    value = field.get_default(call_default_factory=True)
    if field.is_required() or isinstance(value, Entry) or value in (None, "", [], {}):
        return None
    validators = (m.func for m in field.metadata if isinstance(m, PlainValidator))
    reader = next((f for f in validators if isinstance(f, QuantityReader)), None)
    return reader.written(value) if reader else value


def _text_of(shape: Shape) -> str:
    """What a value takes, said by its own shape or by the forms it may have."""
    forms = [shape, *shape.get("anyOf", []), *shape.get("oneOf", []), shape.get("items", {})]
    return next((form["description"] for form in forms if "description" in form), "")


def _plain(text: str) -> str:
    """A phrase of the documents without their links and marks."""
    return re.sub(r" ?\(\[[^]]*\]\([^)]*\)\)", "", " ".join(text.split())).replace("`", "")


def _reached(shape: Any, shapes: Shape) -> set[str]:
    """Names of the shapes that ``shape`` refers to, directly or not."""
    found: set[str] = set()
    todo = [shape]
    while todo:
        part = todo.pop()
        if isinstance(part, dict):
            name = str(part.get("$ref", "")).rpartition("/")[2]
            if name and name not in found:
                found.add(name)
                todo.append(shapes[name])
            todo += part.values()
        elif isinstance(part, list):
            todo += part
    return found
