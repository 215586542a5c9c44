"""Reads ascending values: a list, or a range from, to, step or count."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Any, get_args

from rotordyn import units
from rotordyn.case.keys import MOST_STEPS, Range
from rotordyn.case.leaf import unknown
from rotordyn.case.node import Node
from rotordyn.case.reading import Reading
from rotordyn.field import bare, found_in
from rotordyn.quantity import Quantity
from rotordyn.units import format_quantity


def sweep(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read ascending values: a list, or a range in whole steps."""
    if isinstance(node.value, list):
        return reading.items(annotation, node)
    if not isinstance(node.value, dict):
        allowed = "a range {from, to, step or count}, or a list"
        return reading.wrong_shape(annotation, node, allowed)
    item = get_args(bare(annotation))[0]
    limits = found_in(item, Quantity)
    zero = f"0 {units.KINDS[limits.kind][0]}"
    step = Annotated[float, Quantity(limits.kind, above=zero, at_most=limits.at_most)] | None
    taken = {"start": item, "to": item, "step": step}
    before = reading.faults.count
    swept = Range(**reading.fields(Range, node, annotations=taken))
    if reading.faults.count == before:
        for path, sentence in _range_faults(swept, units.KINDS[limits.kind][0]):
            reading.at(node, path, sentence)
    if reading.faults.count > before:
        return unknown(annotation)
    count = swept.count or round((swept.to - swept.start) / (swept.step or math.inf)) + 1
    span = swept.to - swept.start
    return (*(swept.start + span * n / (count - 1) for n in range(count - 1)), swept.to)


def _range_faults(span: Range, unit: str) -> Iterator[tuple[tuple[str, ...], str]]:
    if span.start >= span.to:
        word = "is empty" if span.start == span.to else "is reversed"
        given = "given {given:from} to {given}"
        yield ("to",), f"the range {word}: {given}; allowed: to above from"
    elif (span.step is None) == (span.count is None):
        given = "neither" if span.step is None else "both"
        yield (), f"a range needs either step or count: given {given}"
    elif span.step is not None:
        exact_steps = (span.to - span.start) / span.step
        if exact_steps >= MOST_STEPS:
            yield ("step",), f"more than {MOST_STEPS} steps: given {{given}}"
        elif (
            abs(exact_steps - round(exact_steps)) > 1e-6 * max(1.0, exact_steps)
            or exact_steps < 0.5
        ):
            ends = [span.start + n * span.step for n in (int(exact_steps), int(exact_steps) + 1)]
            low, high = (format_quantity(end, unit) for end in ends)
            yield (
                ("step",),
                f"the step does not reach the end of the range exactly: given {{given}}; it would "
                f"end at {low} or {high}",
            )
