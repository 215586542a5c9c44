"""One line of an accuracy table: reference value, computed value, difference."""

from __future__ import annotations

import math
from dataclasses import dataclass

Values = tuple[float, ...]
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
HEAD = (
    "quantity",
    "reference",
    "computed",
    "largest difference:",
    "allowed:",
    "source of the reference",
)


@dataclass(frozen=True, slots=True)
class Row:
    """``expected`` and ``found`` values; without ``expected``, ``found`` is an error.

    ``allowed``: largest relative difference, the limit of the test of the same name.
    """

    what: str
    found: Values
    allowed: float
    source: str
    expected: Values = ()

    @property
    def difference(self) -> float:
        """Largest relative difference, or the largest error."""
        if not self.expected:
            return max(self.found)
        pairs = zip(self.found, self.expected, strict=True)
        return max(abs(found / expected - 1.0) for found, expected in pairs)

    @property
    def cells(self) -> tuple[str, ...]:
        """The line as printed."""
        expected = numbers(self.expected) if self.expected else "0"
        found = numbers(self.found) if self.expected else power(max(self.found))
        own = power if self.allowed < 1e-3 else percent
        return (self.what, expected, found, own(self.difference), own(self.allowed), self.source)


def numbers(values: Values) -> str:
    """Values with four significant digits (five from 10 000 on)."""
    return ", ".join(number(value) for value in values)


def number(value: float) -> str:
    """One value with four significant digits."""
    if value == 0.0:
        return "0"
    places = max(0, 3 - math.floor(math.log10(abs(value))))
    return f"{value:.{places}f}".replace("-", "−")


def percent(value: float) -> str:
    """A ratio in percent with two significant digits."""
    return f"{100.0 * value:.2g} %"


def power(value: float) -> str:
    """A small number as a power of ten."""
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.0e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(RAISED)}"
