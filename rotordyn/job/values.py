"""What of a run has a range: its headline numbers and curves, by name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rotordyn.analyses.headline import headline_numbers
from rotordyn.analyses.registry import analysis, in_order
from rotordyn.results.described import Described, Shown
from rotordyn.results.frames import turning
from rotordyn.results.headline import Curve, Number
from rotordyn.results.kinds import Array


@dataclass(frozen=True, slots=True)
class Values:
    """Headline numbers and curves of one machine by name; none of one without a solution."""

    numbers: Mapping[str, Number] = field(default_factory=dict)
    curves: Mapping[str, Curve] = field(default_factory=dict)
    sentence: str = ""


def values_of(case: Described, results: Mapping[str, Any]) -> Values:
    """The values of the results of ``case``."""
    numbers = {f"{name}: {each.words}": each for name, each in headline_numbers(case, results)}
    names = in_order(results)
    curves = {key: each for name in names for key, each in named_curves(case, name, results[name])}
    return Values(numbers, curves)


def machine_of(case: Described) -> str:
    """What the spindle of a case is called; nothing where there is none."""
    return (case.spindle.title or case.spindle.name) if case.spindle is not None else ""


def shown_of(case: Described, result: Any) -> Shown:
    """A result of ``case`` as figures and pages show it; what is known is of the fixed frame."""
    known = () if turning(result) else case.known
    return Shown(case.title or case.name, result, known, case.spindle)


def named_curves(case: Described, name: str, result: Any) -> Iterator[tuple[str, Curve]]:
    """Curves of an analysis, within their axes, by what tells them from the others."""
    count: Counter[str] = Counter()
    for curve in analysis(name).curves(case.analyses.get(name), shown_of(case, result)):
        if curve.backdrop:
            continue
        parts = (curve.figure, curve.panel, curve.title or curve.label, curve.key or curve.series)
        words = f"{name}: {', '.join(part for part in dict.fromkeys(parts) if part)}"
        count[words] += 1
        yield (words if count[words] == 1 else f"{words} ({count[words]})"), curve.within


def difference(curve: Curve, other: Curve, base: Curve) -> Array:
    """How far ``other`` lies from ``base`` at the points of ``curve``; by logarithms where they
    change by factors.

    The difference is followed between the points of the two where these are the same.
    """
    first, second = _scaled(base), _scaled(other)
    if np.array_equal(base.x, other.x):
        return _followed(curve.x, base.x, second - first)
    return _followed(curve.x, other.x, second) - _followed(curve.x, base.x, first)


def _scaled(curve: Curve) -> Array:
    if not curve.by_ratio:
        return np.asarray(curve.y, float)
    known = (curve.y > 0.0) & (curve.y < np.inf)
    return np.where(known, np.log(np.where(known, curve.y, 1.0)), np.nan)


def _followed(x: Array, at: Array, y: Array) -> Array:
    """Values at ``x`` of what is known ``at`` some points; NaN outside and beside unknown ones."""
    if np.array_equal(x, at):
        return y
    return np.interp(x, at, y, left=np.nan, right=np.nan)
