"""Published and measured values and computed ones under the same conditions."""

from __future__ import annotations

import math

import numpy as np

from docs.generate.flagship import Flagship, under
from docs.generate.marked import table
from docs.generate.rows import number
from rotordyn.analyses.known import matches
from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.results.display import shown
from rotordyn.results.known import Match
from rotordyn.scene.conditions import Conditions

HEAD = ("quantity", "kind", "speed [rpm]:", "known:", "computed:", "reasons for differences")


def comparison_table(known: Flagship) -> str:
    """One line per known value, the reason once per series."""
    own = known.case.conditions
    return table(HEAD, [line for item in _found(known) for line in _lines(item, own)])


def _found(known: Flagship) -> list[Match]:
    """Values that can be compared, each with the results under its own conditions."""
    spindle = known.spindle
    found = (matches([r], under(r), spindle) for r in dict.fromkeys(spindle.references))
    return [item for items in found for item in items]


def _lines(item: Match, own: Conditions) -> list[tuple[str, ...]]:
    reference, unit = item.reference, shown(QUANTITIES[item.reference.quantity])
    name = _called(reference)
    lines: list[tuple[str, ...]] = []
    for k, (speed, value, computed) in enumerate(
        zip(reference.speeds, reference.values, item.values, strict=True)
    ):
        first = k == 0
        lines.append(
            (
                f"{name}{_modelled(reference, own)} [{unit.unit}]" if first else "",
                reference.kind if first else "",
                f"{speed * 30.0 / math.pi:.0f}",
                number(value * unit.factor),
                number(computed * unit.factor) if np.isfinite(computed) else "–",
                " ".join(reference.remark.split()) if first else "",
            )
        )
    return lines


def _called(reference: Reference) -> str:
    return f"{reference.quantity} {reference.subject}".strip().replace("_", " ")


def _modelled(reference: Reference, own: Conditions) -> str:
    """The conditions of the known value that differ from those of the case."""
    other = (f"`{k}: {v}`" for k, v in reference.conditions.items() if getattr(own, k) != v)
    return "".join(f", {words}" for words in other)


def omitted(known: Flagship) -> str:
    """Known values without a computed one, as a sentence."""
    compared = {item.reference for item in _found(known)}
    rest = [r for r in known.spindle.references if r not in compared]
    names = dict.fromkeys(map(_called, rest))
    return "Values in the model without a computed counterpart: " + ", ".join(names) + "."
