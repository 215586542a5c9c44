"""Apply overrides to a tree: ``sleeves.front.spring.stiffness: 8 N/um``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from rotordyn.case.faults import Faults
from rotordyn.case.node import UNKNOWN, Node
from rotordyn.case.paths import OF_RANGE, item_in_path, no_such, of_range, too_far

Open = Callable[[str, Node], Node]  # the value of a key; the model if it may be named there


def apply(
    changes: Mapping[str, Node], target: Node, faults: Faults, opened: Open = lambda key, node: node
) -> None:
    """Write each entry of ``changes`` (dotted path: value) into ``target``, in place.

    A path consists of keys, and of list items by their ``name``, or by their index from 1 if they
    have none; ``*`` stands for every item or entry. Missing mappings are created, and models that
    are named are ``opened``; any other obstacle is a fault. Every place gets a copy of the value.
    """
    for path, value in changes.items():
        _put(value, path.split("."), target, faults, opened)


def _put(value: Node, steps: list[str], target: Node, faults: Faults, opened: Open) -> None:
    step, rest = steps[0], steps[1:]
    target.shared = False
    values, item = step in OF_RANGE and _is_list_of_values(target), step == "*" or step.isdigit()
    if values or (item and _is_range(target)):
        faults.at_key(value, of_range(_way(value, steps)))
    elif step == "*" and isinstance(target.value, dict | list):
        _put_everywhere(value, rest, target, faults, opened)
    elif isinstance(target.value, list):
        place = _place(value, steps, target, faults)
        if place is not None and rest:
            _put(value, rest, target.value[place], faults, opened)
        elif place is not None:
            target.value[place] = value.copy()
    elif not isinstance(target.value, dict):
        if target.value is not UNKNOWN:
            faults.at_key(value, too_far(_way(value, steps)))
    elif rest:
        path = value.path.removesuffix("." + ".".join(rest))
        absent = Node({}, value.file, value.line, value.column, path, key=value.key)
        child = target.value.get(step, absent)
        target.value[step] = absent if child.value is None else opened(step, child)
        _put(value, rest, target.value[step], faults, opened)
    else:
        target.value[step] = value.copy()


def _is_list_of_values(target: Node) -> bool:
    plain = isinstance(target.value, list) and not any(item.name for item in target.value)
    return (plain and bool(target.value)) or _is_range(target)


def _is_range(target: Node) -> bool:
    return 0 < len(target.entries()) == len({*target.entries()} & {*OF_RANGE})


def _put_everywhere(
    value: Node, rest: list[str], target: Node, faults: Faults, opened: Open
) -> None:
    for key, child in [*target.items()]:
        if rest:
            _put(value, rest, child, faults, opened)
        else:
            target.value[key] = value.copy()


def _place(value: Node, steps: list[str], target: Node, faults: Faults) -> int | None:
    """Index of a list item by its name, or by its number from 1 if items have none."""
    step, names = steps[0], [item_in_path(k, item) for k, item in enumerate(target.value, start=1)]
    if step in names:
        return names.index(step)
    what, way = "name" if any(item.name for item in target.value) else "number", _way(value, steps)
    faults.at_key(value, no_such(step, names, what, f" in '{way}'") if names else too_far(way))
    return None


def _way(value: Node, steps: list[str]) -> str:
    """The path of a change, as given, without its last ``steps``."""
    return value.path.partition("override.")[2].removesuffix(".".join(steps)).rstrip(".")
