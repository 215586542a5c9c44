"""Published and measured values: their units, and one speed per value."""

from __future__ import annotations

from collections.abc import Sequence

from rotordyn import units
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.reference import KIND_OF_UNIT, ReferenceEntry
from rotordyn.errors import InvalidInput
from rotordyn.machine.reference import QUANTITIES


def references(entries: Sequence[ReferenceEntry], root: Node, faults: Faults) -> None:
    """Every reference can be read and has as many speeds as values (or one speed)."""
    for index, entry in enumerate(entries):
        way = ("references", index)
        _values(entry, root, way, faults)
        if len(entry.speeds) not in (1, len(entry.values)):
            faults.at(
                root,
                (*way, "speeds"),
                f"{len(entry.speeds)} speeds for {len(entry.values)} values: "
                "allowed: one speed, or one per value",
            )


def _values(entry: ReferenceEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    if not entry.quantity:
        return
    kind = KIND_OF_UNIT[QUANTITIES[entry.quantity]]
    for place, value in enumerate(entry.values):
        try:
            units.parse(value, kind)
        except InvalidInput as error:
            faults.at(root, (*way, "values", place), str(error))
