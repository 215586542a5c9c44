"""Find keys at a deeper level than where they were written."""

from __future__ import annotations

from typing import Any

from bearings.bearing import BallBearing
from rotordyn.case.keys import keys_of, kinds_with
from rotordyn.field import kinds_of


def deeper(kind: Any, name: str) -> str:
    """Path of a key one level below ``kind``; empty if there is none.

    >>> from rotordyn.machine import BearingSeat
    >>> deeper(BearingSeat, "contact_angle")
    'model.contact_angle'
    """
    for outer in keys_of(kind):
        for inner in kinds_of(outer.annotation):
            of_bearing = issubclass(inner, BallBearing) and kinds_with(name)
            if of_bearing or name in {each.keys[0] for each in keys_of(inner) if each.keys}:
                return ".".join((*outer.keys, name))
    return ""


def leads(kind: Any, way: tuple[str, ...]) -> bool:
    """Whether nested mappings with these keys lead from ``kind`` to a field or a group.

    >>> from rotordyn.machine import Spindle
    >>> leads(Spindle, ("damping", "rotor")), leads(Spindle, ("damping", "roter"))
    (True, False)
    """
    for field in keys_of(kind):
        first, rest = way[: len(field.keys)], way[len(field.keys) :]
        if way == field.keys[: len(way)]:
            return True
        inner = kinds_of(field.annotation) if first and first == field.keys else []
        if any(leads(each, rest) for each in inner):
            return True
    return False


def nested(name: str) -> str:
    """Write a dotted key as nested mappings.

    >>> nested("damping.rotor")
    'damping: {rotor: …}'
    """
    first, *rest = name.split(".")
    return f"{first}: {{{nested('.'.join(rest))}}}" if rest else f"{first}: …"
