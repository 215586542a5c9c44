"""Goals and limits of a design."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.optimum.criterion import Criterion, Reading, amount, span

LARGEST = 1e6  # bound on the violation of a limit, also that of a limit without a value


@dataclass(frozen=True)
class Goal:
    """Goal: the worst of the selected numbers is to be as high or as low as possible.

    ``highest`` or ``lowest``, one of them: the numbers, as ``Criterion.of``; ``where``: as there.
    """

    highest: str | None = None
    lowest: str | None = None
    where: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if (self.highest is None) == (self.lowest is None):
            raise InvalidInput("a goal is either highest or lowest: give one of them")

    @property
    def criterion(self) -> Criterion:
        """The numbers that are read."""
        return Criterion(self.highest or self.lowest or "", self.where)

    @property
    def words(self) -> str:
        """Heading."""
        return f"{'highest' if self.highest else 'lowest'} {self.criterion.words}"

    def worst(self, reading: Reading) -> float:
        """Worst of the values, as printed; NaN if there is none."""
        if not reading.values.size:
            return np.nan
        return float(reading.values.min() if self.highest else reading.values.max())

    def cost(self, worst: float) -> float:
        """Cost to be minimised."""
        return -worst if self.highest else worst


@dataclass(frozen=True)
class Limit:
    """Limit: all selected numbers are ``at_least``, ``at_most`` or ``outside`` (a, b).

    ``of``, ``where``: as of ``Criterion``. Bounds in SI units or text with a unit.
    ``absent``: whether a missing number satisfies the limit, such as the speed at which a stop
    closes that never does.
    """

    of: str
    where: Mapping[str, object] = field(default_factory=dict)
    at_least: float | str | None = None
    at_most: float | str | None = None
    outside: tuple[float | str, float | str] | None = None
    absent: bool = False

    def __post_init__(self) -> None:
        if self.at_least is None and self.at_most is None and self.outside is None:
            raise InvalidInput(f"limit of {shown(self.of)}: give at_least, at_most or outside")
        if self.outside is not None and not _is_pair(self.outside):
            raise InvalidInput(
                f"limit of {shown(self.of)}: outside takes [from, to], got {shown(self.outside)}"
            )

    @property
    def criterion(self) -> Criterion:
        """The numbers that are read."""
        return Criterion(self.of, self.where)

    @property
    def words(self) -> str:
        """Heading."""
        bounds = [
            *([f"at least {self.at_least}"] if self.at_least is not None else []),
            *([f"at most {self.at_most}"] if self.at_most is not None else []),
            *([f"outside {' to '.join(map(str, self.outside))}"] if self.outside else []),
        ]
        return f"{self.criterion.words} {' and '.join(bounds)}"

    def margin(self, reading: Reading) -> tuple[float, float]:
        """Least margin to a bound, over the bound, negative if violated; and its value."""
        values = reading.values
        margins = np.full(values.shape, np.inf)
        if self.at_least is not None:
            low = self._bound(self.at_least, reading)
            margins = np.minimum(margins, (values - low) / (abs(low) or 1.0))
        if self.at_most is not None:
            high = self._bound(self.at_most, reading)
            margins = np.minimum(margins, (high - values) / (abs(high) or 1.0))
        if self.outside is not None:
            low, high = (self._bound(end, reading) for end in self.outside)
            if not low < high:
                raise InvalidInput(
                    f"limit of {shown(self.of)}: outside goes from low to high, got "
                    f"{span(self.outside)}"
                )
            margins = np.minimum(
                margins, np.maximum(low - values, values - high) / (abs(high) or 1.0)
            )
        if not values.size or (reading.absent and not self.absent):
            return (LARGEST if self.absent else -LARGEST), np.nan
        worst = int(np.argmin(margins))
        return float(np.clip(margins[worst], -LARGEST, LARGEST)), float(values[worst])

    def _bound(self, given: float | str, reading: Reading) -> float:
        try:
            value = amount(given, reading.unit)
        except InvalidInput as refusal:
            raise InvalidInput(f"limit of {shown(self.of)}: {refusal}") from None
        if not math.isfinite(value):
            raise InvalidInput(f"limit of {shown(self.of)}: a bound is a number, got {given}")
        return value


def _is_pair(given: object) -> bool:
    return isinstance(given, list | tuple) and len(given) == 2
