"""Reads 6×6 matrices, written entry by entry or whole."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import product
from typing import Annotated, Any, get_args

from rotordyn.case.leaf import leaf, unknown
from rotordyn.case.node import Node
from rotordyn.case.reading import Reading, unknown_key
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, bare
from rotordyn.machine.matrix import ENTRIES, WHOLE, Matrix, dofs_of, entry_name, rows_of
from rotordyn.quantity import Quantity


def matrix(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Entries of a 6×6 matrix by pair of DOF, written one by one or whole."""
    marker = next(m for m in annotation.__metadata__ if isinstance(m, Matrix))
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, "a mapping (key: value)")
    if any(key in node.value for key in WHOLE):
        return _whole(reading, marker, node) or unknown(annotation)
    tabled = len(get_args(get_args(bare(annotation))[1])) > 1
    entries: dict[tuple[str, str], Any] = {}
    for key, child in node.value.items():
        if key not in ENTRIES:
            reading.faults.at_key(child, unknown_key(key, [*WHOLE, *ENTRIES]))
            continue
        pair = ENTRIES[key]
        one = Annotated[float, marker.quantity(*pair)]
        if child.value is None:
            continue
        if isinstance(child.value, list) and tabled:
            entries[pair] = tuple(reading.value(one, item) for item in child.value)
        elif isinstance(child.value, list):
            message = "a housing does not depend on speed: one value is needed"
            reading.faults.at(child, message)
        else:
            entries[pair] = reading.value(one, child)
    return entries


def _whole(reading: Reading, marker: Matrix, node: Node) -> dict[tuple[str, str], float]:
    both = [key for key in node.value if key in ENTRIES]
    if both:
        reading.faults.at(
            node,
            f"a matrix is written in two ways: given {', '.join(both)} beside dof and matrix; "
            "allowed: entries by name, or dof and matrix",
        )
        return {}
    for key, child in node.value.items():
        if key not in WHOLE:
            reading.faults.at_key(child, unknown_key(key, [*WHOLE, *ENTRIES]))
    for key in WHOLE:
        if key not in node.value:
            reading.faults.missing(node, key, "missing key: it must be given")
    given, rows = node.child("dof"), node.child("matrix")
    dofs = () if given is None else _taken(reading, given, dofs_of)
    if rows is None or not dofs or not _taken(reading, rows, partial(rows_of, size=len(dofs))):
        return {}
    entries = {}
    for (i, row), (j, column) in product(enumerate(dofs), enumerate(dofs)):
        entries[row, column] = _cell(
            reading, marker.quantity(row, column), rows.at(i, j), row, column
        )
    return entries


def _taken(reading: Reading, node: Node, take: Callable[[Any], Sequence[Any]]) -> Sequence[Any]:
    """Take a plain value; empty where it is refused, which is reported."""
    try:
        return take(node.plain())
    except InvalidInput as refusal:
        reading.faults.at(node, str(refusal))
        return ()


def _cell(reading: Reading, quantity: Quantity, node: Node, row: str, column: str) -> float:
    """An entry of a matrix; a bare 0 is the same in every unit."""
    value = node.plain()
    if isinstance(value, int | float) and not isinstance(value, bool) and value == 0:
        return 0.0
    try:
        cell: float = leaf(Annotated[float, quantity], value)
    except Refused as refusal:
        reading.faults.at(node, f"entry {entry_name(row, column)}: {refusal.why}")
        return math.nan
    return cell
