"""The shape of each kind of file as JSON Schema (draft 2020-12), for editors.

Read off the same annotations as the files themselves (``rotordyn.case.reading``).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import is_dataclass
from typing import Any, get_args, get_origin

from bearings.bearing import BallBearing
from bearings.errors import shown
from bearings.kinds import DEFAULT, KINDS, kind_class
from bearings.materials import Material
from rotordyn import units
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Pair, Port
from rotordyn.analyses.registry import analysis, names
from rotordyn.case.case import ByName, Case
from rotordyn.case.identification import IdentificationFile
from rotordyn.case.keys import COMMON, ESTIMATED, MODELS, PortPair, Range, Variant, keys_of
from rotordyn.case.library import known
from rotordyn.case.study import OptimumFile, StudyFile
from rotordyn.case.uncertain import AS_USUAL, Worded
from rotordyn.errors import InvalidInput
from rotordyn.field import REQUIRED, Field, bare, found_in, members, metadata
from rotordyn.machine.matrix import DOFS, ENTRIES, Matrix
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.quantity import Choice, Items, Named, Quantity, Sweep, Whole, Words, suggestion
from rotordyn.scene.spec import Spec

Shape = dict[str, Any]
FILES: dict[str, type] = {
    "case": Case,
    "spindle": Spindle,
    "tool": Tool,
    "bearing": BallBearing,
    "material": Material,
    "study": StudyFile,
    "optimum": OptimumFile,
    "identification": IdentificationFile,
}
_MACHINES = {"spindle": Spindle, "tool": Tool, "bearing": BallBearing}
# Rules of a mapping in addition to its required keys.
_RULES: dict[type, Shape] = {
    Case: {
        "oneOf": [{"required": ["spindle"]}, {"required": ["bearing"]}],
        "dependentRequired": {"tool": ["spindle"]},
    },
    FrfSpec: {
        "required": [],  # replaces the one from the fields: one of two keys is enough
        "allOf": [
            {"anyOf": [{"required": ["pairs"]}, {"required": ["matrix"]}]},
            {"anyOf": [{"required": ["frequencies"]}, {"required": ["engine_orders"]}]},
        ],
    },
    Range: {"oneOf": [{"required": ["step"]}, {"required": ["count"]}]},
}
_LETTER = r"A-Za-z_\u00a1-\uffff"
_NAME = rf"[{_LETTER}][{_LETTER}0-9 -]*"
_PLACE: Shape = {
    "type": "string",
    "pattern": rf"^.+\.({'|'.join(DOFS)})$",
    "description": f"POINT.DIRECTION; directions: {', '.join(DOFS)}",
}


def json_schema(file: str) -> Shape:
    """The JSON Schema of one kind of file, a key of ``FILES``.

    Raises
    ------
    InvalidInput : there is no such kind of file
    """
    if file not in FILES:
        allowed = f"allowed: {', '.join(FILES)}{suggestion(file, FILES)}"
        raise InvalidInput(f"unknown kind of file: {shown(file)}; {allowed}")
    shapes: dict[str, Shape] = {}
    root = shapes[_defined(FILES[file], shapes)]
    if variant := shapes.get(Variant.__name__):
        conditions = variant["properties"]["conditions"]
        variant["properties"]["conditions"] = _in_part(conditions, shapes)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **root,
        "title": f"rotordyn {file}",
        "$defs": {name: shapes[name] for name in sorted(shapes)},
    }


def _in_part(shape: Shape, shapes: dict[str, Shape]) -> Shape:
    """Schema of a mapping that is laid over another: no key is required, null takes a part out."""
    whole = {**shapes.get(shape.get("$ref", "").rpartition("/")[2], {}), **shape}
    if "properties" not in whole:
        return shape
    inner = {key: _in_part(each, shapes) for key, each in whole["properties"].items()}
    parts = {
        key: {"anyOf": [each, {"type": "null"}], "description": each["description"]}
        for key, each in inner.items()
        if "properties" in each
    }
    left_out = ("$ref", "required")
    kept = {key: value for key, value in whole.items() if key not in left_out}
    return {**kept, "properties": {**inner, **parts}}


def title(kind: type) -> str:
    """``SqueezeFilmDamper`` -> ``squeeze film damper``."""
    words = re.sub(r"(?<!^)(?=[A-Z])", " ", kind.__name__).lower()
    return re.sub(r" spec$", " analysis" if issubclass(kind, Spec) else "", words)


def default_of(field: Field) -> Any:
    """Default as written in a file; None if there is nothing to write."""
    value = field.default
    if value is REQUIRED or is_dataclass(value) or value in (None, "", (), {}):
        return None
    if (limits := found_in(field.annotation, Quantity)) is not None and isinstance(value, float):
        return limits.written(value)
    if (words := found_in(field.annotation, Words)) is not None:
        return None if value == words.silent else words.word(value)
    return list(value) if isinstance(value, tuple) else value


def plain(text: str) -> str:
    """Text without Markdown links and marks."""
    return re.sub(r" ?\(\[[^]]*\]\([^)]*\)\)", "", " ".join(text.split())).replace("`", "")


def about(kind: type, *, plainly: bool = True) -> str:
    """First paragraph of a description's docstring, without units; ``plainly``: without marks."""
    text = " ".join((kind.__doc__ or "").partition("\n\n")[0].split()).replace("``", "`")
    return re.sub(r",? \[[^]]*\](?!\()", "", plain(text) if plainly else text)


def _defined(kind: type, shapes: dict[str, Shape]) -> str:
    """Name of the schema of a description, which is added to ``shapes``."""
    name = kind.__name__
    if name in shapes:
        return name
    shapes[name] = {}
    if kind is BallBearing:
        forms = [{"$ref": f"#/$defs/{_defined(kind_class(word), shapes)}"} for word in KINDS]
        head = {"title": "bearing", "description": "A ball bearing, its keys by its kind."}
        shapes[name] = {**head, "oneOf": forms}
        return name
    head = {"title": title(kind), "description": about(kind)}
    shapes[name] = {**_mapping(keys_of(kind), shapes, kind), **head, **_RULES.get(kind, {})}
    if issubclass(kind, BallBearing):
        _one_kind(shapes[name], kind)
    return name


def _one_kind(shape: Shape, kind: type) -> None:
    word = next(word for word in KINDS if kind_class(word) is kind)
    shape["properties"]["kind"]["enum"] = [word]
    if word == DEFAULT:
        shape["anyOf"] = [{"required": shape.pop("required")}, {"required": [*ESTIMATED]}]
    else:
        del shape["properties"]["kind"]["default"]
        shape["required"] = ["kind", *shape["required"]]


def _mapping(
    keys: tuple[Field, ...], shapes: dict[str, Shape], kind: type, depth: int = 0
) -> Shape:
    """Schema of an object with these keys and no others; deeper keys become nested objects."""
    filled = {c.fills[-1] for each in COMMON.values() for c in each if c.kind is kind}
    properties: Shape = {}
    required = []
    for field in keys:
        if len(field.keys) <= depth:
            continue
        key = field.keys[depth]
        if len(field.keys) > depth + 1:
            if key not in properties:
                longer = (f for f in keys if len(f.keys) > depth + 1)
                inner = tuple(f for f in longer if f.keys[: depth + 1] == field.keys[: depth + 1])
                properties[key] = {**_mapping(inner, shapes, kind, depth + 1), "description": key}
            continue
        properties[key] = _property(key, field, shapes, kind)
        if field.default is REQUIRED and key not in filled:
            required.append(key)
    return _closed(properties, **({"required": required} if required else {}))


def _closed(properties: Shape, **more: Any) -> Shape:
    """Schema of an object with these properties and no others."""
    return {"type": "object", "properties": properties, "additionalProperties": False, **more}


def _property(key: str, field: Field, shapes: dict[str, Shape], kind: type) -> Shape:
    if kind in (Case, Variant) and key in _MACHINES:
        shape = _reference(_MACHINES[key], shapes)
    else:
        shape = shape_of(field.annotation, shapes)
    parts = [plain(field.meaning), shape.get("description", "")]
    shape = {**shape, "description": "; ".join(filter(None, parts))}
    default = default_of(field)
    return shape if default is None else {**shape, "default": default}


def shape_of(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    """Schema of a value with this annotation."""
    for beside in metadata(annotation):
        if type(beside) in _FORMS:
            return _FORMS[type(beside)](annotation, shapes)
    forms = members(annotation)
    if len(forms) > 1:
        each = [shape_of(form, shapes) for form in forms]
        words = [
            form["description"] for form in each if "description" in form and "$ref" not in form
        ]
        return {"anyOf": each, **({"description": "; or ".join(words)} if words else {})}
    return _of_one(forms[0], shapes)


def _of_one(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    inner = bare(annotation)
    if inner in _FORMS:
        return _FORMS[inner](annotation, shapes)
    if inner in MODELS:
        return _reference(inner, shapes)
    if isinstance(inner, type) and is_dataclass(inner):
        return {"$ref": f"#/$defs/{_defined(inner, shapes)}"}
    if get_origin(inner) is tuple:
        return _list(annotation, shape_of(get_args(inner)[0], shapes))
    return _entries(inner, shapes) if get_origin(inner) is Mapping else _single(annotation)


def _list(annotation: Any, items: Shape) -> Shape:
    shape: Shape = {"type": "array", "items": items}
    if limit := found_in(annotation, Items):
        shape |= {"minItems": limit.at_least, "maxItems": limit.at_most}
    return {**shape, **({"description": items["description"]} if "description" in items else {})}


def _entries(inner: Any, shapes: dict[str, Shape]) -> Shape:
    key, entry = get_args(inner)
    if entry is Any:
        return {"type": "object"}
    named = any(isinstance(limit, Named) for limit in metadata(key))
    pattern = rf"^{_NAME}$" if named else ".*"
    return {
        "type": "object",
        "patternProperties": {pattern: shape_of(entry, shapes)},
        "additionalProperties": False,
    }


def _single(annotation: Any) -> Shape:
    for limit in metadata(annotation):
        if isinstance(limit, Quantity):
            return quantity(limit)
        if isinstance(limit, Choice):
            return {"enum": list(limit.allowed)}
        if isinstance(limit, Words):
            return {"enum": [word for word, _ in limit.values]}
        if isinstance(limit, Whole):
            text = f"whole number, {limit.at_least} to {limit.at_most}"
            bounds = {"minimum": limit.at_least, "maximum": limit.at_most}
            return {"type": "integer", **bounds, "description": text}
        if isinstance(limit, Named):
            pattern = rf"^{_NAME}(\.{_NAME})?$" if limit.dotted else rf"^{_NAME}$"
            return {"type": "string", "pattern": pattern}
    kinds = {str: "string", bool: "boolean", float: "number", int: "integer"}
    inner = bare(annotation)
    return {"type": kinds[inner]} if inner in kinds else {}


def quantity(limits: Quantity) -> Shape:
    """Schema of a quantity: text with a unit, a plain number without one, the word for infinite.

    The description states the range; the pattern can only check the sign, and that the value is not
    zero.
    """
    forms = [_text(limits)]
    if "" in units.KINDS[limits.kind]:
        forms.insert(0, _plain_number(limits))
    if limits.infinite:
        forms.append({"const": limits.infinite})
    shape: Shape = forms[0] if len(forms) == 1 else {"anyOf": forms}
    names = ", ".join(unit or "plain number" for unit in units.KINDS[limits.kind])
    word = f", or {limits.infinite}" if limits.infinite else ""
    return {**shape, "description": f"{limits.kind}, {limits.allowed}{word}; units: {names}"}


def _text(limits: Quantity) -> Shape:
    sign = r"\+?" if limits.low >= 0.0 else "[+-]?"
    sign = rf"(?=[+0-9.]*[1-9]){sign}" if limits.low == 0.0 and limits.above else sign
    grouped = "[0-9]{1,3}([ \u00a0\u2009\u202f][0-9]{3})+(?![0-9])"
    number = rf"{sign}(({grouped}|[0-9]+)\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{{1,4}})?"
    return {
        "type": "string",
        "pattern": rf"^\s*{number}\s*({units.pattern(limits.kind)})\s*$",
        "examples": [f"1 {unit}".strip() for unit in units.KINDS[limits.kind]],
    }


def _plain_number(limits: Quantity) -> Shape:
    bounds = {
        "exclusiveMinimum" if limits.above else "minimum": limits.low,
        "exclusiveMaximum" if limits.below else "maximum": limits.high,
    }
    return {"type": "number", **{key: b for key, b in bounds.items() if math.isfinite(b)}}


def _reference(kind: type, shapes: dict[str, Shape]) -> Shape:
    """Schema of a model: a name of the library, the path of a file, or a mapping."""
    path = {"type": "string", "pattern": r"[/\\]|\.ya?ml$"}
    names: list[str | int] = [*known(MODELS[kind])]
    names += [int(name) for name in known(MODELS[kind]) if name.isdecimal()]
    return {"anyOf": [{"enum": names}, path, {"$ref": f"#/$defs/{_defined(kind, shapes)}"}]}


def _sweep(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    """Schema of a list or a range."""
    item = get_args(bare(annotation))[0]
    limits = found_in(item, Quantity)
    one = quantity(limits)
    row = _mapping(keys_of(Range), shapes, Range)
    for key in ("from", "to", "step"):
        row["properties"][key] = {**one, "description": row["properties"][key]["description"]}
    return {"anyOf": [{**row, **_RULES[Range]}, _list(annotation, one)]}


def _matrix(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    """Schema of a matrix: entries by name, or all rows with their DOF."""
    marker = found_in(annotation, Matrix)
    tabled = len(get_args(get_args(bare(annotation))[1])) > 1
    entries: Shape = {}
    for key, pair in ENTRIES.items():
        one = quantity(marker.quantity(*pair))
        row = {"anyOf": [one, {"type": "array", "items": one}], "description": one["description"]}
        entries[key] = row if tabled else one
    dofs = {
        "type": "array",
        "items": {"enum": list(DOFS)},
        "minItems": 1,
        "uniqueItems": True,
        "description": "DOF of the rows (loads) and columns (displacements)",
    }
    rows = {
        "type": "array",
        "items": {"type": "array", "items": {"type": ["string", "number"]}},
        "description": "row by row, with units; a bare 0 needs none",
    }
    whole = {"dof": dofs, "matrix": rows}
    return {"anyOf": [_closed(entries), _closed(whole, required=[*whole])]}


def _by_name(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    each = {}
    for name in names():
        kind = analysis(name).spec
        text = shapes[_defined(kind, shapes)]["description"]
        forms = [{"$ref": f"#/$defs/{kind.__name__}"}]
        forms += [] if "required" in shapes[kind.__name__] else [{"type": "null"}]
        each[name] = {"anyOf": forms, "description": text}
    return _closed(each, minProperties=1)


def _values(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    """Schema of a reference, whose values have the unit of its quantity."""
    shape = _mapping(keys_of(Reference), shapes, Reference)
    shape["properties"]["values"]["items"] = {"type": ["string", "number"]}
    return {**shape, "description": about(Reference)}


def _worded(annotation: Any, shapes: dict[str, Shape]) -> Shape:
    """Schema of a mapping, or of the words for the usual one."""
    whole = {"$ref": f"#/$defs/{_defined(bare(members(annotation)[0]), shapes)}"}
    return {"anyOf": [{"const": AS_USUAL}, whole]}


_FORMS: dict[type, Callable[[Any, dict[str, Shape]], Shape]] = {
    Worded: _worded,
    Sweep: _sweep,
    Port: lambda annotation, shapes: _PLACE,
    Pair: lambda annotation, shapes: _mapping(keys_of(PortPair), shapes, PortPair),
    Matrix: _matrix,
    ByName: _by_name,
    Reference: _values,
}
