"""Headline numbers and curves of a run by name, of which intervals are made."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rotordyn.analyses.headline import headline_numbers
from rotordyn.analyses.registry import analysis, in_order
from rotordyn.arrays import Array
from rotordyn.results.described import Described, Shown
from rotordyn.results.frames import turning
from rotordyn.results.headline import Curve, Number


@dataclass(frozen=True, slots=True)
class Values:
    """Headline numbers and curves of one machine by name; empty without a solution."""

    numbers: Mapping[str, Number] = field(default_factory=dict)
    curves: Mapping[str, Curve] = field(default_factory=dict)
    sentence: str = ""


def values_of(case: Described, results: Mapping[str, Any]) -> Values:
    """Headline numbers and curves of the results of ``case``."""
    numbers = {f"{name}: {each.words}": each for name, each in headline_numbers(case, results)}
    names = in_order(results)
    curves = {key: each for name in names for key, each in named_curves(case, name, results[name])}
    return Values(numbers, curves)


def machine_of(case: Described) -> str:
    """Name of the spindle of a case; empty if there is none."""
    return (case.spindle.title or case.spindle.name) if case.spindle is not None else ""


def shown_of(case: Described, result: Any) -> Shown:
    """A result of ``case`` for figures and pages; known values apply to the fixed frame only."""
    known = () if turning(result) else case.known
    return Shown(case.title or case.name, result, known, case.spindle)


def named_curves(case: Described, name: str, result: Any) -> Iterator[tuple[str, Curve]]:
    """Yield the curves of an analysis by a distinct name, without values beyond their axes."""
    count: Counter[str] = Counter()
    for curve in analysis(name).curves(case.analyses.get(name), shown_of(case, result)):
        if curve.backdrop:
            continue
        parts = (curve.figure, curve.panel, curve.title or curve.label, curve.key or curve.series)
        words = f"{name}: {', '.join(part for part in dict.fromkeys(parts) if part)}"
        count[words] += 1
        yield (words if count[words] == 1 else f"{words} ({count[words]})"), curve.within


def difference(curve: Curve, other: Curve, base: Curve) -> Array:
    """Difference of ``other`` from ``base`` at the points of ``curve``, of logarithms if the curve
    changes by factors.

    If both have the same points, their difference is interpolated, else each of them.
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
    """Interpolate values known ``at`` some points to ``x``; NaN outside, and next to NaN."""
    if np.array_equal(x, at):
        return y
    return np.interp(x, at, y, left=np.nan, right=np.nan)
