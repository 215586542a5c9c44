"""Published and measured values beside ours, as the page of the flagship shows them."""

from __future__ import annotations

import math

import numpy as np

from docs.generate.flagship import Flagship
from docs.generate.marked import table
from docs.generate.rows import number
from rotordyn.analysis.comparison import Comparison, compare
from rotordyn.analysis.display import shown
from rotordyn.machine.reference import QUANTITIES

HEAD = ("quantity", "kind", "speed [rpm]:", "known:", "ours:", "why they may differ")


def comparison_table(known: Flagship) -> str:
    """One line per known value, the reason once per series."""
    spindle = known.spindle
    found = compare(spindle.references, known.results, spindle)
    return table(HEAD, [line for item in found for line in _lines(item)])


def _lines(item: Comparison) -> list[tuple[str, ...]]:
    reference, unit = item.reference, shown(QUANTITIES[item.reference.quantity])
    name = f"{reference.quantity.replace('_', ' ')} {reference.subject}".strip().replace("_", " ")
    lines: list[tuple[str, ...]] = []
    for k, (speed, value, ours) in enumerate(
        zip(reference.speeds, reference.values, item.values, strict=True)
    ):
        first = k == 0
        lines.append(
            (
                f"{name} [{unit.unit}]" if first else "",
                reference.kind if first else "",
                f"{speed * 30.0 / math.pi:.0f}",
                number(value * unit.factor),
                number(ours * unit.factor) if np.isfinite(ours) else "–",
                " ".join(reference.remark.split()) if first else "",
            )
        )
    return lines


def left_out(known: Flagship) -> str:
    """Known values that this version computes nothing for, as a sentence."""
    spindle = known.spindle
    compared = {item.reference for item in compare(spindle.references, known.results, spindle)}
    rest = [r for r in spindle.references if r not in compared]
    names = dict.fromkeys(f"{r.quantity} {r.subject}".strip().replace("_", " ") for r in rest)
    return "Kept in the model without a computed value beside it: " + ", ".join(names) + "."
