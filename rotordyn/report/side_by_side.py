"""Variants as plain text: a table for every analysis, a line per variant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

from rotordyn.analyses.headline import headline_cells
from rotordyn.analyses.known import matches
from rotordyn.analyses.registry import analysis, in_order
from rotordyn.machine.reference import Reference
from rotordyn.report.known import computed_values, known_values
from rotordyn.report.rotors import rotor_lines, rotor_table
from rotordyn.report.summary import called
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.text import aligned, from_to, opening, wrapped

Variant = tuple[Described, Mapping[str, Any]]
T = TypeVar("T")
MOST, FEW = 14, 8  # most rows that are all shown; number shown of more


def comparison_summary(
    case: Described,
    variants: Sequence[Variant],
    warnings: Sequence[str] = (),
    notes: Sequence[str] = (),
    unsolved: Sequence[str] = (),
) -> str:
    """Rotors, key figures at the first and the last speed, then the known values that apply.

    Of many variants a few are shown, evenly through their order; ``variants.csv`` has all.
    """
    top = opening(warnings, called(case), notes, unsolved)
    lines = [*top, *_rotors([described for described, _ in variants])]
    for name in in_order(*(results for _, results in variants)):
        heads, rows = headline_cells(name, variants)
        if heads:
            title = f"{analysis(name).heading}, {_ends(variants, name)}"
            lines += ["", title, *aligned([["", *heads], *_sampled(rows)]), *_rest(rows)]
    known = _known(variants)
    return "\n".join([*lines, *([""] if known else []), *known])


def _rotors(variants: Sequence[Described]) -> list[str]:
    """Lines of the rotors of every variant; as of one machine where they are equal."""
    heads, rows = rotor_table(variants)
    if heads[0] == "variant":
        note = [f"{FEW} of {len(rows)} rotors"] * (len(rows) > MOST)
        return ["", "rotor", *aligned([["", *heads[1:]], *_sampled(rows)]), *note]
    spindles = [variant.spindle for variant in variants if variant.spindle is not None]
    return [part for line in rotor_lines(spindles[0]) for part in wrapped(line)] if rows else []


def _ends(variants: Sequence[Variant], name: str) -> str:
    speed = next(results[name] for _, results in variants if name in results).speed
    return f"{from_to(speed * RPM.factor, 0)} rpm"


def _sampled(rows: Sequence[T]) -> Sequence[T]:
    if len(rows) <= MOST:
        return rows
    return [rows[round(k * (len(rows) - 1) / (FEW - 1))] for k in range(FEW)]


def _rest(rows: Sequence[Any]) -> list[str]:
    return [f"{FEW} of {len(rows)} variants; all are in variants.csv"] if len(rows) > MOST else []


def _known(variants: Sequence[Variant]) -> list[str]:
    """Lines of every known value, once, with the values computed by the variants it applies to."""
    beside: dict[Reference, list[tuple[str, str]]] = {}
    for case, results in variants:
        for match in matches(case.known, results, case.spindle):
            ours = computed_values(match)
            beside.setdefault(match.reference, []).append((case.title, ours))
    return [line for reference, ours in beside.items() for line in _comparison(reference, ours)]


def _comparison(reference: Reference, computed: Sequence[tuple[str, str]]) -> list[str]:
    head = f"{reference.kind}  {known_values(reference)}"
    if len(computed) > 1 and len({values for _, values in computed}) == 1:
        computed = [("all of them", computed[0][1])]
    lines = [head, *(f"    {title}: {values}" for title, values in _sampled(computed))]
    return [part for line in lines for part in wrapped(line)]
