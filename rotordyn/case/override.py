"""Puts single values into a file that was read: ``sleeves.front.spring.stiffness: 8 N/um``."""

from __future__ import annotations

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, joined
from rotordyn.quantity import suggestion


def apply(changes: Node | None, target: Node, faults: Faults) -> None:
    """Writes each entry of ``changes`` (dotted path: value) into ``target``, in place.

    A path names keys, and items of a list by their ``name``; mappings on the way are made where
    they are missing. Anything else the path meets is a fault.
    """
    if changes is None or not isinstance(changes.value, dict):
        return
    for path, value in changes.value.items():
        _put(value, path.split("."), target, faults)


def _put(value: Node, steps: list[str], target: Node, faults: Faults) -> None:
    for place, step in enumerate(steps[:-1], start=1):
        path = value.path.removesuffix("." + ".".join(steps[place:]))
        found = _step(value, step, path, target, faults)
        if found is None:
            return
        target = found
    if isinstance(target.value, list):
        _replace_item(value, steps[-1], target, faults)
    elif isinstance(target.value, dict):
        target.value[steps[-1]] = value
    else:
        _no_way(value, steps[-1], target, faults)


def _step(value: Node, step: str, path: str, target: Node, faults: Faults) -> Node | None:
    """One step from ``target``; ``path`` is the way so far, where a mapping must be made."""
    if isinstance(target.value, list):
        return _item(value, step, target, faults)
    if not isinstance(target.value, dict):
        _no_way(value, step, target, faults)
        return None
    if step not in target.value or target.value[step].value is None:
        target.value[step] = Node({}, value.file, value.line, value.column, path, key=value.key)
    child: Node = target.value[step]
    return child


def _item(value: Node, step: str, target: Node, faults: Faults) -> Node | None:
    found: Node | None = next((item for item in target.value if item.name == step), None)
    if found is None:
        names = [item.name for item in target.value if item.name]
        allowed = ", ".join(names) or "the list as a whole, its items have no names"
        where = target.path or "the list"
        message = f"unknown name '{step}' in {where}; allowed: {allowed}{suggestion(step, names)}"
        faults.at_key(value, (), message)
    return found


def _replace_item(value: Node, step: str, target: Node, faults: Faults) -> None:
    found = _item(value, step, target, faults)
    if found is not None:
        target.value[target.value.index(found)] = value


def _no_way(value: Node, step: str, target: Node, faults: Faults) -> None:
    faults.at_key(
        value, (), f"'{joined(target.path, step)}' does not exist: '{target.path}' holds one value"
    )
