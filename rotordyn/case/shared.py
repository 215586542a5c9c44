"""Resolve paths to values given once for several items into paths of these items."""

from __future__ import annotations

from typing import Any

from rotordyn.case.keys import COMMON, Common
from rotordyn.field import declared
from rotordyn.machine.matrix import entry_name

Steps = tuple[str, ...]


def common_at(holder: Any, steps: Steps) -> Common | None:
    """The common value of several items of ``holder`` into which a path leads; None if none."""
    each: Common
    for each in COMMON.get(type(holder), ()):
        if each.meaning and steps[: len(each.keys)] == each.keys:
            return each
    return None


def called(key: object) -> str:
    """Key of a mapping as written in a path; entries of a matrix as in files."""
    return entry_name(*key) if isinstance(key, tuple) else str(key)


def called_at(place: int, item: object) -> str:
    """Item of a list as written in a path: its name, or its number from 1 if it has none."""
    return getattr(item, "name", "") or str(place)


def ways_of_items(holder: Any, common: Common, steps: Steps) -> list[Steps]:
    """The path inside every item that has no such value itself."""
    listed, _, key = common.fills
    kind: Any = type(holder)
    name = next(field.name for field in declared(kind) if field.keys == (listed,))
    rest = (key, *steps[len(common.keys) :])
    items = [each for each in getattr(holder, name) if hasattr(each, "own")]
    return [(listed, each.name, *rest) for each in items if key not in each.own]
