"""Goals and limits of a design."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.optimum.criterion import Criterion, Reading, amount, span

LARGEST = 1e6  # violation of a limit, and what one without a value counts


@dataclass(frozen=True)
class Goal:
    """The worst of what is read is to be as ``highest`` or as ``lowest`` as possible.

    ``highest`` or ``lowest``, one of them: what, as ``Criterion.of``; ``where``: as there.
    """

    highest: str | None = None
    lowest: str | None = None
    where: Mapping[str, object] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if (self.highest is None) == (self.lowest is None):
            raise InvalidInput("a goal is either highest or lowest: give one of them")

    @property
    def criterion(self) -> Criterion:
        """What is read."""
        return Criterion(self.highest or self.lowest or "", self.where)

    @property
    def words(self) -> str:
        """As a heading."""
        return f"{'highest' if self.highest else 'lowest'} {self.criterion.words}"

    def worst(self, reading: Reading) -> float:
        """The worst value read, as printed; NaN where there is none."""
        if not reading.values.size:
            return np.nan
        return float(reading.values.min() if self.highest else reading.values.max())

    def cost(self, worst: float) -> float:
        """What is minimised."""
        return -worst if self.highest else worst


@dataclass(frozen=True)
class Limit:
    """All that is read stays ``at_least``, ``at_most`` or ``outside`` (a, b).

    ``of``, ``where``: as of ``Criterion``. Bounds in SI units or text with a unit.
    ``absent``: whether a number that is absent keeps the limit, such as the speed of a stop that is
    never reached, or one of several.
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
        """What is read."""
        return Criterion(self.of, self.where)

    @property
    def words(self) -> str:
        """As a heading."""
        bounds = [
            *([f"at least {self.at_least}"] if self.at_least is not None else []),
            *([f"at most {self.at_most}"] if self.at_most is not None else []),
            *([f"outside {' to '.join(map(str, self.outside))}"] if self.outside else []),
        ]
        return f"{self.criterion.words} {' and '.join(bounds)}"

    def margin(self, reading: Reading) -> tuple[float, float]:
        """Room to the nearest bound, as a share of it, below 0 beyond it; the value read there."""
        values = reading.values
        rooms = np.full(values.shape, np.inf)
        if self.at_least is not None:
            low = self._bound(self.at_least, reading)
            rooms = np.minimum(rooms, (values - low) / (abs(low) or 1.0))
        if self.at_most is not None:
            high = self._bound(self.at_most, reading)
            rooms = np.minimum(rooms, (high - values) / (abs(high) or 1.0))
        if self.outside is not None:
            low, high = (self._bound(end, reading) for end in self.outside)
            if not low < high:
                raise InvalidInput(
                    f"limit of {shown(self.of)}: outside goes from low to high, got "
                    f"{span(self.outside)}"
                )
            rooms = np.minimum(rooms, np.maximum(low - values, values - high) / (abs(high) or 1.0))
        if not values.size or (reading.absent and not self.absent):
            return (LARGEST if self.absent else -LARGEST), np.nan
        worst = int(np.argmin(rooms))
        return float(np.clip(rooms[worst], -LARGEST, LARGEST)), float(values[worst])

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
