"""Single values as JSON Schema: what an editor is told about each."""

from __future__ import annotations

import math
from typing import Any

from rotordyn import units
from rotordyn.machine.support import FREEDOMS
from rotordyn.quantity import Quantity

Shape = dict[str, Any]

_LETTER = r"A-Za-z_\u00a1-\uffff"
NAME: Shape = {"type": "string", "pattern": rf"^[{_LETTER}][{_LETTER}0-9 -]*$"}
_NAME = rf"[{_LETTER}][{_LETTER}0-9 -]*"
POINT: Shape = {"type": "string", "pattern": rf"^{_NAME}(\.{_NAME})?$"}
PLACE: Shape = {
    "type": "string",
    "pattern": rf"^.+\.({'|'.join(FREEDOMS)})$",
    "description": f"POINT.DIRECTION; directions: {', '.join(FREEDOMS)}",
}
FREEDOM_LIST: Shape = {
    "type": "array",
    "items": {"enum": list(FREEDOMS)},
    "minItems": 1,
    "uniqueItems": True,
}


def choice(allowed: tuple[str, ...]) -> Shape:
    """One of a few words."""
    return {"enum": list(allowed)}


def whole(at_least: int, at_most: int) -> Shape:
    """A whole number within bounds."""
    about = f"whole number, {at_least} to {at_most}"
    return {"type": "integer", "minimum": at_least, "maximum": at_most, "description": about}


def quantity(limits: Quantity) -> Shape:
    """Text with a unit; a plain number where the kind has none; or the word for infinite.

    The range is in the description; of the text only the sign can be checked.
    """
    forms = [_text(limits)]
    if "" in units.KINDS[limits.kind]:
        forms.insert(0, _plain(limits))
    if limits.infinite:
        forms.append({"const": limits.infinite})
    shape: Shape = forms[0] if len(forms) == 1 else {"anyOf": forms}
    return {**shape, "description": _about(limits)}


def _text(limits: Quantity) -> Shape:
    sign = r"\+?" if limits.low >= 0.0 else "[+-]?"
    number = rf"{sign}([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{{1,4}})?"
    return {
        "type": "string",
        "pattern": rf"^\s*{number}\s*({units.pattern(limits.kind)})\s*$",
        "examples": [f"1 {unit}".strip() for unit in units.KINDS[limits.kind]],
    }


def _plain(limits: Quantity) -> Shape:
    bounds = {
        "exclusiveMinimum" if limits.above else "minimum": limits.low,
        "exclusiveMaximum" if limits.below else "maximum": limits.high,
    }
    return {"type": "number", **{key: b for key, b in bounds.items() if math.isfinite(b)}}


def _about(limits: Quantity) -> str:
    names = ", ".join(unit or "plain number" for unit in units.KINDS[limits.kind])
    word = f", or {limits.infinite}" if limits.infinite else ""
    return f"{limits.kind}, {limits.allowed}{word}; units: {names}"
