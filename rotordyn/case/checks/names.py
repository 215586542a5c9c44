"""Names that must be unique, and names that must exist."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.quantity import suggestion


def unique(names: Sequence[str], root: Node, way: tuple[object, ...], faults: Faults) -> None:
    """No item of the list at ``way`` bears the name of an earlier one (empty ones aside)."""
    earlier: set[str] = set()
    for index, name in enumerate(names):
        if name and name in earlier:
            faults.at(root, (*way, index, "name"), f"name given twice: '{name}'")
        earlier.add(name)


def exists(
    name: str,
    allowed: Iterable[str],
    what: str,
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> bool:
    """``name`` is among ``allowed``; an empty name (unknown) passes."""
    known = list(allowed)
    if not name or name in known:
        return True
    choices = ", ".join(known) or "none, there are none here"
    faults.at(
        root,
        way,
        f"unknown {what}: given '{name}'; allowed: {choices}" + suggestion(name, known),
    )
    return False
