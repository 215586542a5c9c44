"""Paths of files to what is given once for several items, as paths of these items."""

from __future__ import annotations

from typing import Any

from rotordyn.case.keys import COMMON, Common
from rotordyn.field import declared
from rotordyn.machine.matrix import entry_name

Steps = tuple[str, ...]


def common_at(holder: Any, steps: Steps) -> Common | None:
    """What is given once for several items of ``holder``, where a path leads into that."""
    each: Common
    for each in COMMON.get(type(holder), ()):
        if each.meaning and steps[: len(each.keys)] == each.keys:
            return each
    return None


def called(key: object) -> str:
    """A key of a mapping as written in a path; a place of a matrix as in files."""
    return entry_name(*key) if isinstance(key, tuple) else str(key)


def called_at(place: int, item: object) -> str:
    """An item of a list as written in a path: by its name, without one by its place from 1."""
    return getattr(item, "name", "") or str(place)


def ways_of_items(holder: Any, common: Common, steps: Steps) -> list[Steps]:
    """The same path within every item that gives no such value itself; none where that is not
    known of items."""
    listed, _, key = common.fills
    kind: Any = type(holder)
    name = next(field.name for field in declared(kind) if field.keys == (listed,))
    rest = (key, *steps[len(common.keys) :])
    items = [each for each in getattr(holder, name) if hasattr(each, "own")]
    return [(listed, each.name, *rest) for each in items if key not in each.own]
