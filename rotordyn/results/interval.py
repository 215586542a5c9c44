"""Uncertainty of the results of a case: the range of every headline number and curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array
from rotordyn.results.declaration import coordinate, quantity

Whole = np.ndarray[tuple[int, ...], np.dtype[np.int64]]
ENDS = ("lowest", "highest")
NARROW = 1e-6  # relative width: nothing changes the number
ORDERED = 5  # decimals of the logarithm of a width by which numbers are put in order
ALIKE = 0.05  # of the largest change of two numbers
OVER_HYPOTHESES, OVER_TOLERANCES = "over hypotheses", "over tolerances, 95 %"
COMMON = ("spindle", "conditions", "*", "model")  # steps of a path that short names omit


@dataclass(frozen=True, eq=False, slots=True)
class Interval:
    """Ranges over hypotheses and over tolerances, and the sources that rule them.

    Numbers are in the units in which they are printed, ``unit``; NaN where there is none. Ranges
    over hypotheses hold every combination; those over tolerances 95 of 100 machines whose numbers
    lie anywhere within their tolerances, ``worst`` all of them. ``effect``: change of a number with
    one source at its end. ``interaction``: difference of two machines with all tolerances off at
    once from the sum of effects, over the range, NaN where ranges are those of samples. Curves
    are concatenated (``point``).

    ``without``: number of combinations without such a number (a stop not reached, an unloaded
    bearing), for which ``absent`` is printed; ``without_within``: likewise of the machines solved
    within tolerances, one more where a load would vanish within the range.
    """

    number: tuple[str, ...] = coordinate("number", unit="", label="number")
    source: tuple[str, ...] = coordinate("source", unit="", label="uncertain number")
    end: tuple[str, ...] = coordinate("end", unit="", label="end of the range")
    combination: tuple[str, ...] = coordinate("combination", unit="", label="hypotheses")
    path: tuple[str, ...] = coordinate("path", unit="", label="number of the case")
    curve: tuple[str, ...] = coordinate("curve", unit="", label="curve")
    unit: tuple[str, ...] = quantity("number", unit="", label="unit")
    absent: tuple[str, ...] = quantity("number", unit="", label="reason where there is none")
    nominal: Array = quantity("number", unit="", label="nominal")
    by_combination: Array = quantity("number", "combination", unit="", label="value")
    hypotheses: Array = quantity("number", "end", unit="", label="over hypotheses")
    tolerances: Array = quantity("number", "end", unit="", label="95 % of tolerances")
    worst: Array = quantity("number", "end", unit="", label="worst case of tolerances")
    effect: Array = quantity("number", "source", "end", unit="", label="effect")
    interaction: Array = quantity("number", unit="1", label="not the sum of effects, over range")
    without: Whole = quantity("number", unit="", label="combinations without it")
    without_within: Whole = quantity(
        "number", unit="", label="machines within tolerances without it"
    )
    numerical_error: Array = quantity("number", unit="1", label="numerical error")
    tolerance: tuple[str, ...] = quantity("source", unit="", label="tolerance")
    derivative: Array = quantity("number", "path", unit="", label="derivative, by SI unit")
    elasticity: Array = quantity("number", "path", unit="1", label="relative derivative")
    range_effect: Array = quantity("number", "path", unit="", label="κ, change over the range")
    curve_of: Whole = quantity("point", unit="", label="curve it belongs to")
    x: Array = quantity("point", unit="", label="abscissa")
    curve_nominal: Array = quantity("point", unit="", label="nominal")
    curve_hypotheses: Array = quantity("point", "end", unit="", label="over hypotheses")
    curve_tolerances: Array = quantity("point", "end", unit="", label="95 % of tolerances")
    runs: int = quantity(unit="", label="machines solved")
    narrowed: str = quantity(unit="", label="usual tolerances beyond the allowed range")
    lost: str = quantity(unit="", label="why some of them have no solution")

    def spread(self) -> Array:
        """Largest relative width of either range of every number (numbers,)."""
        size = np.abs(np.where(np.isnan(self.nominal), self.hypotheses[:, 1], self.nominal))
        size = np.where(size == 0.0, 1.0, size)
        with np.errstate(invalid="ignore"):  # both ends of an unbounded range are infinite
            widths = [np.ptp(ends, axis=1) for ends in (self.hypotheses, self.tolerances)]
        return np.nan_to_num(np.nanmax(np.stack([np.nan_to_num(w) for w in widths]), axis=0) / size)

    def varying(self) -> list[int]:
        """Indices of the numbers, those of the widest range first; constant ones are omitted.

        Equal ranges, as of both whirls of a mode at rest, stay in the order of the list.
        """
        spread = self.spread()
        coarse = np.log(np.maximum(spread, NARROW)).round(ORDERED)  # rounding must not order equals
        return [int(k) for k in np.argsort(-coarse, kind="stable") if spread[k] > NARROW]

    def apart(self, order: Sequence[int]) -> list[int]:
        """The first of every group of numbers with equal changes, such as both whirls of a mode."""
        kept: list[int] = []
        for k in order:
            if not any(self._same_changes(k, other) for other in kept):
                kept.append(k)
        return kept

    def _same_changes(self, one: int, other: int) -> bool:
        first, second = (
            np.nan_to_num(np.append(self.effect[k], self.hypotheses[k] - self.nominal[k]))
            for k in (one, other)
        )
        size = float(np.abs(first).max(initial=0.0))
        difference = float(np.abs(first - second).max(initial=0.0))
        return self.unit[one] == self.unit[other] and difference < ALIKE * size

    def rows_of(self, curve: int) -> Whole:
        """Indices of the points of a curve."""
        return np.flatnonzero(self.curve_of == curve)

    def ruling(self, number: int) -> list[tuple[str, float]]:
        """Sources with their shares of the range over tolerances, largest first."""
        widths = np.fmax.reduce(np.abs(self.effect[number]), axis=1, initial=0.0) ** 2
        total = widths.sum()
        order = np.argsort(-widths, kind="stable")
        return [(self.source[k], float(widths[k] / total)) for k in order if total and widths[k]]


def short_path(path: str) -> str:
    """A dotted path without the steps in ``COMMON``."""
    return ".".join(step for step in path.split(".") if step not in COMMON)
