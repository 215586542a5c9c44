"""Apply overrides to a tree: ``sleeves.front.spring.stiffness: 8 N/um``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, joined
from rotordyn.case.varied import called_at
from rotordyn.quantity import suggestion


def apply(changes: Mapping[str, Node], target: Node, faults: Faults) -> None:
    """Write each entry of ``changes`` (dotted path: value) into ``target``, in place.

    A path consists of keys, and of list items by their ``name``, or by their index from 1 if they
    have none; ``*`` stands for every item or entry. Missing mappings are created; any other
    obstacle is a fault. Every place gets a copy of the value.
    """
    for path, value in changes.items():
        _put(value, path.split("."), target, faults)


def _put(value: Node, steps: list[str], target: Node, faults: Faults) -> None:
    step, rest = steps[0], steps[1:]
    target.shared = False
    if step == "*" and isinstance(target.value, dict | list):
        container: Any = target.value
        for key, child in [*target.items()]:
            if rest:
                _put(value, rest, child, faults)
            else:
                container[key] = value.copy()
    elif isinstance(target.value, list):
        place = _place(value, step, target, faults)
        if place is not None and rest:
            _put(value, rest, target.value[place], faults)
        elif place is not None:
            target.value[place] = value.copy()
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


def _place(value: Node, step: str, target: Node, faults: Faults) -> int | None:
    """Index of a list item by its name, or by its number from 1 if items have none."""
    names = [called_at(k, item) for k, item in enumerate(target.value, start=1)]
    if step in names:
        return names.index(step)
    where = target.path or "the list"
    if any(item.name for item in target.value):
        allowed = f"unknown name '{step}' in {where}; allowed: {', '.join(names)}"
        faults.at_key(value, f"{allowed}{suggestion(step, names)}")
    elif names:
        faults.at_key(value, f"unknown number '{step}' in {where}; allowed: from 1 to {len(names)}")
    else:
        faults.at_key(value, f"'{where}' is empty: give it whole")
    return None
