"""What a key of a file accepts, asked from the readers of the schema themselves.

Each reader is handed values it must refuse, and its own message says what is allowed: this page
and the messages a user sees cannot disagree.
"""

from __future__ import annotations

import math
import re
import types
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import PlainValidator, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo
from rotordyn.case.schema.analyses import Place
from rotordyn.case.schema.base import Entry, title
from rotordyn.case.schema.bearing import BearingEntry

from rotordyn import units

_KIND = re.compile(r"expected (.+?): given")


def accepted(field: FieldInfo) -> str:
    """The type, range and unit of a field in words."""
    return _accepted(field.annotation, tuple(field.metadata))


def default(field: FieldInfo) -> str:
    """The default as one would write it, or ``required``."""
    if field.is_required():
        return "required"
    value = field.get_default(call_default_factory=True)
    if value is None or value in ("", [], {}):
        return "–"
    if isinstance(value, Entry):
        return getattr(value, "name", "its defaults")
    if isinstance(value, list):
        return "all" if len(value) > 1 else f"`[{value[0]}]`"
    return f"`{_written(field, value)}`"


def _written(field: FieldInfo, value: Any) -> str:
    if isinstance(value, bool | str | int):
        return str(value).lower() if isinstance(value, bool) else str(value)
    reader = _reader(tuple(field.metadata))
    kind = _kind(reader) if reader else ""
    if math.isinf(value):
        return _message(reader, True).rpartition(", or ")[2]
    coherent = [u for u in units.KINDS.get(kind, ("",)) if units.parse_unit(u).scale == 1.0]
    return f"{value:g} {coherent[0]}".strip() if coherent else f"{value:g}"


def _accepted(annotation: Any, metadata: tuple[Any, ...] = ()) -> str:
    if get_origin(annotation) is Annotated:
        first, *rest = get_args(annotation)
        return _accepted(first, (*metadata, *rest))
    reader = _reader(metadata)
    if reader is not None:
        return _read_by(reader, annotation)
    if isinstance(annotation, type) and issubclass(annotation, Entry):
        whole = BearingEntry if issubclass(annotation, BearingEntry) else annotation
        return f"[{title(whole)}](#{anchor(whole)})"
    return _composed(annotation)


def _composed(annotation: Any) -> str:
    """A list, a mapping, or one of several forms."""
    parts = [_accepted(a) for a in get_args(annotation) if a is not type(None)]
    origin = get_origin(annotation)
    if origin in (types.UnionType, Union):
        return ", or ".join(dict.fromkeys(parts))
    if origin is list:
        return f"list: {parts[0]}"
    return f"mapping of names to: {parts[1]}" if origin is dict else "see meaning"


def anchor(entry: type[Entry]) -> str:
    """The heading's link target."""
    return title(entry).replace(" ", "-")


def _reader(metadata: tuple[Any, ...]) -> PlainValidator | None:
    return next((m for m in metadata if isinstance(m, PlainValidator)), None)


def _read_by(reader: PlainValidator, annotation: Any) -> str:
    if annotation is Place:
        return "`POINT.DIRECTION`"
    refusal = _message(reader, True)
    allowed = refusal.partition("allowed: ")[2]
    if annotation == list[list[float]]:
        return "list of rows, each a list of quantities"
    plain = {
        "not freedoms": f"list: {allowed}",
        "not a name": "name",
        "not a point": "name of a point, or length",
        "no name of a point": "name of a point",
        "not text": "text",
        "not a whole": f"whole number, {allowed}",
    }
    for start, words in plain.items():
        if refusal.startswith(start):
            return words
    if refusal.startswith("not one of its choices"):
        return _choices(allowed.split(", "))
    return _quantity(reader, refusal) if refusal else "`true` or `false`"


def _choices(words: list[str]) -> str:
    quoted = [f"`{word}`" for word in words]
    return quoted[0] if len(quoted) == 1 else "one of " + ", ".join(quoted)


def _quantity(reader: PlainValidator, refusal: str) -> str:
    kind = _kind(reader)
    far = _message(reader, f"1e290 {units.KINDS[kind][0]}".strip()).partition("allowed: ")[2]
    words = refusal.rpartition(", or ")[2] if ", or " in refusal else ""
    return f"{kind}, {far}" + (f", or `{words}`" if words else "")


def _kind(reader: PlainValidator) -> str:
    match = _KIND.search(_message(reader, True))
    return match[1] if match else ""


def _message(reader: PlainValidator | None, value: object) -> str:
    """What the reader says to ``value``; empty where it takes it."""
    try:
        TypeAdapter(Annotated[Any, reader]).validate_python(value)
    except ValidationError as error:
        return error.errors()[0]["msg"]
    return ""
