"""Speeds, frequencies and other lists: ascending, without repeats, ranges that come out even."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.sweep import MAX_STEPS, FrequencyRange, SpeedRange
from rotordyn.units import format_quantity


def sweep(
    entry: SpeedRange | FrequencyRange | Sequence[float],
    unit: str,
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> None:
    """A range that runs upwards in whole steps, or a list that ascends."""
    if isinstance(entry, SpeedRange | FrequencyRange):
        _range(entry, unit, root, way, faults)
    else:
        ascending(entry, root, way, faults)


def ascending(values: Sequence[float], root: Node, way: tuple[object, ...], faults: Faults) -> None:
    """Each value of the list at ``way`` is above the one before it."""
    for index in range(1, len(values)):
        if values[index] <= values[index - 1]:
            how = "repeated" if values[index] == values[index - 1] else "not in ascending order"
            before, here = (root.at(*way, i).raw for i in (index - 1, index))
            faults.at(root, (*way, index), f"{how}: given '{here}' after '{before}'")


def _range(
    entry: SpeedRange | FrequencyRange,
    unit: str,
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> None:
    if entry.start >= entry.to:
        start, to = root.at(*way, "from").raw, root.at(*way, "to").raw
        word = "is empty" if entry.start == entry.to else "is reversed"
        faults.at(
            root,
            (*way, "to"),
            f"the range {word}: given '{start}' to '{to}'; allowed: to above from",
        )
    elif _has_other_keys(root.at(*way)):
        return
    elif (entry.step is None) == (entry.count is None):
        given = "neither" if entry.step is None else "both"
        faults.at_key(root, way, f"a range needs either step or count: given {given}")
    elif entry.step is not None:
        _even(entry.to - entry.start, entry.step, entry.start, unit, root, way, faults)


def _has_other_keys(node: Node) -> bool:
    """A misspelt key is reported already; what it leaves out is no second fault."""
    return isinstance(node.value, dict) and not {"from", "to", "step", "count"} >= set(node.value)


def _even(
    span: float,
    step: float,
    start: float,
    unit: str,
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> None:
    exact = span / step
    if not math.isfinite(exact):
        return
    if exact >= MAX_STEPS:
        given = root.at(*way, "step").raw
        faults.at(root, (*way, "step"), f"more than {MAX_STEPS} steps: given '{given}'")
    elif abs(exact - round(exact)) > 1e-6 * max(1.0, exact) or round(exact) == 0:
        ends = [format_quantity(start + n * step, unit) for n in (int(exact), int(exact) + 1)]
        given = root.at(*way, "step").raw
        faults.at(
            root,
            (*way, "step"),
            f"the step does not come out at the end of the range: given '{given}'; "
            f"it would end at {ends[0]} or {ends[1]}",
        )
