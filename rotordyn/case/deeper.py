"""Keys that stand further down than where they were looked for."""

from __future__ import annotations

from typing import Any

from bearings.bearing import BallBearing
from rotordyn.case.keys import keys_of, kinds_with
from rotordyn.field import kinds_of


def deeper(kind: Any, name: str) -> str:
    """Where a key that ``kind`` lacks stands one level down; empty where it does not.

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
    """Whether mappings in one another lead along these keys of ``kind`` to a field or a group.

    >>> from rotordyn.machine import Spindle
    >>> leads(Spindle, ("damping", "rotor")), leads(Spindle, ("damping", "roter"))
    (True, False)
    """
    for field in keys_of(kind):
        own, rest = way[: len(field.keys)], way[len(field.keys) :]
        if way == field.keys[: len(way)]:
            return True
        inner = kinds_of(field.annotation) if own and own == field.keys else []
        if any(leads(each, rest) for each in inner):
            return True
    return False


def nested(name: str) -> str:
    """A key with dots, as mappings in one another.

    >>> nested("damping.rotor")
    'damping: {rotor: …}'
    """
    first, *rest = name.split(".")
    return f"{first}: {{{nested('.'.join(rest))}}}" if rest else f"{first}: …"
