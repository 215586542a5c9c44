"""Parameters of a study: dotted paths of a case, and the values that they take."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from typing import Any

import numpy as np

from rotordyn.case.case import Case
from rotordyn.case.keys import MODELS
from rotordyn.case.paths import found_at, from_top, value_of
from rotordyn.case.study import MOST_POINTS
from rotordyn.case.varied import usual_unit
from rotordyn.case.vary import vary
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, kinds_of, shown
from rotordyn.quantity import Quantity
from rotordyn.units import KINDS, parse_unit

RESOLVED = 1e-14  # relative distance from which 15 digits distinguish two numbers
LONGEST = 60  # characters of a list of values as a coordinate


@dataclass(frozen=True, slots=True)
class Span:
    """Numbers from ``low`` to ``high``, in SI units or text with a unit.

    ``count``: number of values in a grid, both ends included; ``log``: spaced by equal ratios.
    """

    low: float | str
    high: float | str
    count: int | None = None
    log: bool = False


@dataclass(frozen=True, slots=True)
class Spread(Sequence[Any]):
    """Sequence of ``points`` numbers from ``low`` to ``high``, spaced evenly or by equal ratios
    (``log``), computed on access and rounded to 15 digits."""

    low: float
    high: float
    points: int
    log: bool

    def __len__(self) -> int:
        return self.points

    def __getitem__(self, place: Any) -> Any:
        if isinstance(place, slice):
            return [self[k] for k in range(*place.indices(self.points))]
        share = range(self.points)[place] / (self.points - 1)
        return float(f"{_between(self.low, self.high, share, log=self.log):.15g}")

    @property
    def resolved(self) -> bool:
        """Whether 15 digits distinguish adjacent numbers."""
        if self.log:
            distance = math.log(self.high / self.low)
        else:
            distance = (self.high - self.low) / max(abs(self.low), abs(self.high))
        return distance / (self.points - 1) > RESOLVED


def _between(low: float, high: float, share: float, *, log: bool) -> float:
    """Interpolate from ``low`` (share 0) to ``high`` (share 1), linearly or by ratio."""
    return low * (high / low) ** share if log else low + share * (high - low)


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter at a dotted ``path``: listed ``values``, as ``vary`` takes them, or any number
    between ``ends``.

    ``labels``: the values as coordinates, numbers in SI units or words; ``quantity``: that of
    numbers with a dimension. ``whole``: only integers; ``log``: sampled by equal ratios.
    """

    path: str
    values: Sequence[Any] = ()
    labels: Sequence[Any] = ()
    ends: tuple[float, float] | None = None
    quantity: Quantity | None = None
    whole: bool = False
    log: bool = False

    @property
    def numeric(self) -> bool:
        """Whether its values are numbers."""
        return self.ends is not None or all(isinstance(v, float | int) for v in self.labels)

    @property
    def unit(self) -> str:
        """SI unit of the numbers; empty without a dimension."""
        if self.quantity is None or not self.numeric:
            return ""
        return next((u for u in KINDS[self.quantity.kind] if parse_unit(u).scale == 1.0), "")

    @property
    def display(self) -> tuple[str, float]:
        """Usual unit for printing, and its SI value."""
        numbers = self.ends or self.labels
        if self.quantity is None or not self.numeric:
            return "", 1.0
        unit = usual_unit(self.quantity, [float(value) for value in numbers])
        return unit, parse_unit(unit).scale if unit else 1.0

    @property
    def heading(self) -> str:
        """Path with usual unit."""
        unit = self.display[0]
        return f"{self.path} [{unit}]" if unit else self.path

    def displayed(self, label: Any) -> Any:
        """Convert a coordinate to the usual unit."""
        if not self.numeric:
            return label
        return float(f"{label / self.display[1]:.12g}")

    def at(self, share: float) -> Any:
        """Value at a ``share`` in [0, 1) of the range, from the first (or lowest) to the last."""
        if self.ends is None:
            return self.values[int(share * len(self.values))]
        low, high = self.ends
        if self.whole:
            return int(low + math.floor(share * (high - low + 1.0)))
        return _between(low, high, share, log=self.log)


def parameter(case: Case, path: str, asked: object) -> Parameter:
    """Check the values of one path against the case.

    Raises
    ------
    InvalidInput : the path does not exist, a value has the wrong type or is out of range, a span is
        not of numbers; the sentence names the path
    """
    if isinstance(asked, Span):
        return _spanned(case, path, asked)
    if isinstance(asked, str) or not isinstance(asked, Sequence | np.ndarray):
        raise InvalidInput(f"{path}: a list of values or a Span is needed, got {shown(asked)}")
    if not len(asked):
        raise InvalidInput(f"{path}: the list is empty, at least one value is needed")
    given = [each.item() if isinstance(each, np.generic) else each for each in asked]
    accepted = [_taken(case, path, each) for each in given]
    read = zip(accepted, given, strict=True)  # a model by its name is read once
    values = tuple(each if is_dataclass(each) else word for (each, _), word in read)
    pairs = zip(accepted, asked, strict=True)
    labels = tuple(_label(each, word, quantity) for (each, quantity), word in pairs)
    plain = all(isinstance(each, str | float | int | np.generic) for each in asked)
    if len(set(labels)) < len(labels) and not plain:  # texts of other objects may coincide
        labels = tuple(f"{label} ({k + 1})" for k, label in enumerate(labels))
    quantity = accepted[0][1]
    if quantity is not None and any(isinstance(label, str) for label in labels):
        pairs = zip(labels, accepted, strict=True)
        labels = tuple(_as_word(label, value, quantity) for label, (value, _) in pairs)
    return Parameter(path, values, labels, quantity=quantity)


def _spanned(case: Case, path: str, span: Span) -> Parameter:
    (low, quantity), (high, _) = (_taken(case, path, end) for end in (span.low, span.high))
    numbers = [v for v in (low, high) if isinstance(v, float | int) and not isinstance(v, bool)]
    if len(numbers) < 2 or not all(map(math.isfinite, numbers)):
        raise InvalidInput(f"{path}: is not a number: list its values instead of a range")
    if not low < high:
        given = [quantity.written(v) if quantity else f"{v:g}" for v in (low, high)]
        raise InvalidInput(f"{path}: a span goes from low to high, got {given[0]} to {given[1]}")
    if span.log and low <= 0.0:
        raise InvalidInput(f"{path}: a span by ratio lies above 0, got from {shown(span.low)}")
    whole, ends = isinstance(low, int), (float(low), float(high))
    if span.count is None:
        return Parameter(path, ends=ends, quantity=quantity, whole=whole, log=span.log)
    if not is_whole(span.count, 2, MOST_POINTS):
        raise InvalidInput(
            f"{path}: a span has at least 2 points and at most {MOST_POINTS:g}, got "
            f"{shown(span.count)}"
        )
    spread = Spread(*ends, span.count, span.log)
    values: Sequence[Any] = spread
    if whole:  # no more points than there are integers
        most = high * math.log(high / low) + 2.0 if span.log else high - low + 1
        few = Spread(*ends, min(span.count, math.ceil(most)), span.log)
        values = tuple(sorted({round(value) for value in few}))
    elif not spread.resolved:
        raise InvalidInput(
            f"{path}: {span.count} points of this span are closer than 15 digits resolve: take "
            "fewer"
        )
    return Parameter(path, values, values, ends, quantity, whole, span.log)


def kind_of_model(case: Case, path: str) -> Any:
    """Kind of library model that a name at ``path`` refers to; None where a text is not a name."""
    places = found_at(case, path, absent=True)
    forms = {kind for _, declared in places for kind in kinds_of(declared)}
    return next((name for kind, name in MODELS.items() if kind in forms), None)


def _taken(case: Case, path: str, value: object) -> tuple[Any, Quantity | None]:
    """``value`` as the case stores it, and its quantity; rules between fields are not checked."""
    if isinstance(value, Mapping):
        raise InvalidInput(
            f"{path}: a mapping is no value of a study: vary what is in it, "
            f"such as {path}.{next(iter(value), 'name')}"
        )
    places = found_at(case, path, absent=True)
    if not places:
        vary(case, {path: value})  # raises with the part of the path that does not exist
        return value, None
    declared = places[0][1]
    try:
        return value_of(declared, value), quantity_of(declared)
    except Refused as refusal:
        raise InvalidInput(f"{path}{refusal.place}: {refusal.why}") from None


def _label(value: Any, given: object, quantity: Quantity | None) -> Any:
    """Coordinate of a value: a number or a text; a list as it was written."""
    if isinstance(value, float | int) and not isinstance(value, bool) and math.isfinite(value):
        return value
    if isinstance(given, str):
        return given
    if is_dataclass(value):
        return str(getattr(value, "name", "") or type(value).__name__)
    if isinstance(value, tuple) and isinstance(given, Sequence | np.ndarray):
        texts = [item if isinstance(item, str) else _written(item, quantity) for item in given]
        return _cut(f"[{', '.join(texts)}]")
    return shown(value)


def _written(value: Any, quantity: Quantity | None) -> str:
    number = isinstance(value, float | int) and not isinstance(value, bool)
    return quantity.written(value) if quantity is not None and number else shown(value)


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 5]} ...]"


def _as_word(label: Any, value: Any, quantity: Quantity) -> str:
    """Text of a number whose list also holds words."""
    if isinstance(label, str):
        return quantity.written(value) if value == math.inf else label
    unit = usual_unit(quantity, [label])
    return f"{label / parse_unit(unit).scale if unit else label:.12g} {unit}".rstrip()


def is_whole(value: object, least: int, most: float = math.inf) -> bool:
    """Whether a value given in Python is an integer between ``least`` and ``most``."""
    return isinstance(value, int) and not isinstance(value, bool) and least <= value <= most


def require_whole(name: str, value: object, least: int) -> None:
    """Raise InvalidInput unless a value given in Python is an integer from ``least`` up."""
    if not is_whole(value, least):
        raise InvalidInput(f"{name}: given {shown(value)}; allowed: a whole number from {least} up")


def require_each_once(found: Sequence[Parameter]) -> None:
    """Raise InvalidInput if a list holds a value twice."""
    for each in found:
        if each.ends is None and len(set(each.labels)) < len(each.labels):
            repeated = next(v for k, v in enumerate(each.labels) if v in each.labels[:k])
            given = f"{each.displayed(repeated):.12g}" if each.numeric else repeated
            words = f"{given} {each.display[0]}".rstrip()
            raise InvalidInput(
                f"{each.path}: a value is listed twice: given {words}; allowed: once"
            )


def parameters(case: Case, asked: Any) -> Iterator[Parameter]:
    """Yield the parameter of every path that is varied.

    Raises
    ------
    InvalidInput : nothing is varied; see ``parameter``
    """
    if not isinstance(asked, Mapping) or not asked:
        raise InvalidInput("nothing is varied: map at least one dotted path to its values")
    for path in asked:
        if not isinstance(path, str):
            raise InvalidInput(f"not a dotted path: given {shown(path)}; such as 'speeds'")
    for path, why in given_twice(case, asked):
        raise InvalidInput(f"{path}: {why}")
    for path, values in asked.items():
        yield parameter(case, path, values)


def given_twice(case: Case, paths: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield paths that lead where another one of ``paths`` leads, each with a sentence."""
    before = set()
    for path in paths:
        whole = from_top(path, case.bearing is None)
        if whole in before:
            yield path, f"given twice, with and without '{whole.partition('.')[0]}.' before it"
        before.add(whole)
