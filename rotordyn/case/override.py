"""Puts single values into a file that was read: ``sleeves.front.spring.stiffness: 8 N/um``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, joined
from rotordyn.quantity import suggestion


def apply(changes: Mapping[str, Node], target: Node, faults: Faults) -> None:
    """Writes each entry of ``changes`` (dotted path: value) into ``target``, in place.

    A path names keys, and items of a list by their ``name``, or by their place from 1 where they
    have none; ``*`` stands for every item or entry.
    Mappings on the way are made where they are missing. Anything else the path meets is a fault.
    Every place gets a value of its own, which may be changed further.
    """
    for path, value in changes.items():
        _put(value, path.split("."), target, faults)


def _put(value: Node, steps: list[str], target: Node, faults: Faults) -> None:
    step, rest = steps[0], steps[1:]
    target.shared = False
    if step == "*" and isinstance(target.value, dict | list):
        held: Any = target.value
        for key, child in [*target.items()]:
            if rest:
                _put(value, rest, child, faults)
            else:
                held[key] = value.copy()
    elif isinstance(target.value, list):
        item = _item(value, step, target, faults)
        if item is not None and rest:
            _put(value, rest, item, faults)
        elif item is not None:
            target.value[target.value.index(item)] = value.copy()
    elif not isinstance(target.value, dict):
        where = f"'{joined(target.path, step)}' does not exist"
        faults.at_key(value, f"{where}: '{target.path}' holds one value")
    elif not rest:
        target.value[step] = value.copy()
    else:
        if step not in target.value or target.value[step].value is None:
            path = value.path.removesuffix("." + ".".join(rest))
            target.value[step] = Node({}, value.file, value.line, value.column, path, key=value.key)
        _put(value, rest, target.value[step], faults)


def _item(value: Node, step: str, target: Node, faults: Faults) -> Node | None:
    names = [item.name for item in target.value]
    where = target.path or "the list"
    if any(names):
        allowed = f"{', '.join(filter(None, names))}{suggestion(step, names)}"
        message = f"unknown name '{step}' in {where}; allowed: {allowed}"
    else:
        names = [str(place) for place in range(1, len(names) + 1)]
        message = f"unknown number '{step}' in {where}; allowed: from 1 to {len(names)}"
    if step not in filter(None, names):
        faults.at_key(value, message if names else f"'{where}' is empty: give it whole")
        return None
    found: Node = target.value[names.index(step)]
    return found
