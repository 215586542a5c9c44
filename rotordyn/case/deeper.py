"""Keys that stand one level down from where they were looked for."""

from __future__ import annotations

from typing import Any

from bearings.bearing import BallBearing
from rotordyn.case.keys import keys_of, kinds_with
from rotordyn.field import kinds_of


def deeper(kind: Any, name: str) -> str:
    """Where a key that ``kind`` lacks stands one level down; empty where it does not.

    >>> deeper(BearingSeat, "contact_angle")
    'model.contact_angle'
    """
    for outer in keys_of(kind):
        for inner in kinds_of(outer.annotation):
            of_bearing = issubclass(inner, BallBearing) and kinds_with(name)
            if of_bearing or name in {each.keys[0] for each in keys_of(inner) if each.keys}:
                return ".".join((*outer.keys, name))
    return ""
