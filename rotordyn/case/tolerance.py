"""Tolerances in text form, checked against the value of a case at their path.

``± 5 %`` is a share of the value, ``± 2 um`` and ``+3/-2 deg`` are differences, ``24..28 deg``
ends, ``factor 2`` half to double, ``least..most`` words.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from rotordyn import units
from rotordyn.case.case import Case
from rotordyn.case.paths import places
from rotordyn.case.vary import vary
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, accept, found_in, shown
from rotordyn.quantity import Choice, Quantity

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?"
BOTH = re.compile(rf"(?:±|\+/?-)\s*({NUMBER})\s*(.*)")
APART = re.compile(rf"\+\s*({NUMBER})\s*(?:/|,)\s*-\s*({NUMBER})\s*(.*)")
ENDS = re.compile(rf"({NUMBER})\s*(.*?)\s*\.\.\s*({NUMBER})\s*(.*)")
TIMES = re.compile(rf"factor\s+({NUMBER})")
WORDS = re.compile(r"([A-Za-z]\w*)\s*\.\.\s*([A-Za-z]\w*)")
FORMS = "allowed: '± 5 %', '± 2 um', '+3/-2 deg', '24..28 deg', 'factor 2', 'least..most'"
NUMBER_AS_SUCH = Quantity("number")
LEAST = 1e-12  # least width over the value
SEARCHED = 1e-6  # distance from a bound, over the width, that counts as on the bound


@dataclass(frozen=True, slots=True)
class Tolerance:
    """An uncertain number.

    ``path`` and ``text`` as written. ``ends``: lowest, nominal and highest value (tuples if the
    value is a list) by each path that it changes. ``nominal``: position of the value of the case
    between lowest (0) and highest (1); ``log``: interpolated by ratios. ``unit``: SI; ``quantity``
    with its range. ``beside``: further changes by path that go with any value.
    """

    path: str
    text: str
    ends: Mapping[str, tuple[Any, Any, Any]] = field(default_factory=dict)
    nominal: float = 0.5
    log: bool = False
    unit: str = ""
    quantity: Quantity = NUMBER_AS_SUCH
    beside: Mapping[str, Any] = field(default_factory=dict)

    def at(self, share: float) -> dict[str, Any]:
        """Values by path, as ``vary`` takes them, at a share from lowest (0) to highest (1)."""
        values = {path: self._between(*each, share) for path, each in self.ends.items()}
        return {**values, **self.beside}

    def within(self, low: float, high: float, text: str) -> Tolerance:
        """Reduce the tolerance to shares ``low`` to ``high``, which enclose the nominal value."""
        ends = {}
        for path, (least, nominal, most) in self.ends.items():
            at = [self._between(least, nominal, most, share) for share in (low, high)]
            if isinstance(least, float):  # the search for the last valid value may have met a bound
                at = [_on_bound(end, self.quantity, SEARCHED * (most - least)) for end in at]
            ends[path] = (at[0], nominal, at[1])
        return replace(self, text=text, ends=ends, nominal=(self.nominal - low) / (high - low))

    def _between(self, low: Any, nominal: Any, high: Any, share: float) -> Any:
        if isinstance(low, str):  # three words, equally likely
            return (low, nominal, high)[min(int(3.0 * share), 2)]
        if isinstance(low, tuple):
            triples = zip(low, nominal, high, strict=True)
            return tuple(self._between(*each, share) for each in triples)
        if isinstance(low, int):
            return min(low + int(share * (high - low + 1)), high)
        if share == self.nominal:
            return nominal
        if self.log:
            return low * (high / low) ** share
        return low + share * (high - low)

    def shown(self, path: str) -> str:
        """Text of lowest and highest value at a path, in the unit of the range."""
        low, _, high = self.ends[path]
        pairs = zip(low, high, strict=True) if isinstance(low, tuple) else [(low, high)]
        ends = [[self.quantity.as_bounds(end) for end in pair] for pair in pairs]
        return ", ".join(f"{first.split()[0]} to {last}" for first, last in ends)

    @property
    def _first(self) -> list[Any]:
        """Lowest, nominal and highest value at the first path, of the first item of a list."""
        ends = next(iter(self.ends.values()))
        return [end[0] if isinstance(end, tuple) else end for end in ends]

    @property
    def levels(self) -> int:
        """Number of equally likely discrete values; 0 if continuous."""
        low, _, high = self._first
        if isinstance(low, str):
            return 3
        return high - low + 1 if isinstance(low, int) else 0

    @property
    def width(self) -> float:
        """Width at the first path [SI]; NaN for words."""
        low, _, high = self._first
        return math.nan if isinstance(low, str) else float(high - low)

    @property
    def value(self) -> float:
        """Nominal value at the first path [SI]; NaN for words."""
        nominal = self._first[1]
        return math.nan if isinstance(nominal, str) else float(nominal)


def tolerance(case: Case, path: str, text: str, *, beyond: bool = False) -> Tolerance:
    """Read a tolerance of the value at a dotted path of ``case``; ``beyond``: may leave the range.

    Raises
    ------
    InvalidInput : the path does not exist or holds no number, or the text is no tolerance of it,
        leaves its range, or has no width; one sentence that does not repeat the path
    """
    values = _found(case, path)
    ends, share, log, unit, quantity = {}, 0.5, False, "", None
    for place, value, annotation in values:
        ends[place], share, log = _ends(value, annotation, text, beyond)
        quantity = quantity_of(annotation)
        unit = "" if quantity is None or isinstance(value, str) else quantity.coherent_unit
    return Tolerance(path, text, ends, share, log, unit, quantity or NUMBER_AS_SUCH)


def _found(case: Case, path: str) -> list[tuple[str, Any, Any]]:
    values = places(case, path)
    if values:
        return values
    try:
        vary(case, {path: None})  # raises with the part of the path that does not exist
    except InvalidInput as refusal:
        raise InvalidInput(str(refusal).removeprefix(f"{path}: ")) from None
    raise InvalidInput("does not exist in this case")


def _ends(
    value: Any, annotation: Any, text: str, beyond: bool
) -> tuple[tuple[Any, Any, Any], float, bool]:
    """Lowest, nominal and highest value, share of the nominal one, and whether by ratios."""
    if isinstance(value, tuple) and value and all(isinstance(each, float) for each in value):
        rows = [_ends(each, annotation, text, beyond) for each in value]
        columns = tuple(zip(*(row[0] for row in rows), strict=True))
        return (columns[0], columns[1], columns[2]), rows[0][1], rows[0][2]
    if isinstance(value, str) and found_in(annotation, Choice) is not None:
        return _words(value, annotation, text), 0.5, False
    low, high, log = _limits(value, annotation, text, beyond)
    if isinstance(value, int):
        if low != round(low) or high != round(high):
            raise InvalidInput(f"'{text}': whole numbers are needed, such as ± 1")
        return (int(low), value, int(high)), (value - low) / (high - low), False
    share = math.log(value / low) / math.log(high / low) if log else (value - low) / (high - low)
    return (low, value, high), share, log


def _limits(value: Any, annotation: Any, text: str, beyond: bool) -> tuple[float, float, bool]:
    """Lowest and highest number, checked against the value and its range."""
    if isinstance(value, bool) or not isinstance(value, float | int):
        what = "is not given in this case" if value is None else f"is not a number: {shown(value)}"
        raise InvalidInput(f"{what}; a tolerance needs one")
    if not math.isfinite(value):
        raise InvalidInput("is infinite in this case; a tolerance needs a number")
    quantity = quantity_of(annotation) or NUMBER_AS_SUCH
    low, high, log = _numbers(float(value), quantity, text.strip().replace("\u2212", "-"))
    if low > high:
        raise InvalidInput(f"the lower end comes first: given '{text}'")
    if not low < high or high - low <= LEAST * max(abs(low), abs(high)):
        hint = ", a share of 0 is 0: give it with a unit" if value == 0 and "%" in text else ""
        raise InvalidInput(f"a tolerance without width: given '{text}'{hint}")
    low, high = _on_bound(low, quantity), _on_bound(high, quantity)
    for end in () if beyond else (low, high):
        if why := quantity.refusal(end, quantity.as_bounds(end)):
            raise InvalidInput(f"'{text}' exceeds the allowed range: {why}")
    if not low <= value <= high:
        written = quantity.as_bounds(value)
        raise InvalidInput(f"'{text}' does not contain the value of the case, {written}")
    return low, high, log


def _on_bound(end: float, quantity: Quantity, apart: float = 0.0) -> float:
    """Return the bound if ``end`` meets it to within rounding or a search, else ``end``."""
    bounds = [quantity.low] * bool(quantity.at_least) + [quantity.high] * bool(quantity.at_most)
    near = (b for b in bounds if abs(end - b) <= max(LEAST * max(abs(b), abs(end)), apart))
    return next(near, end)


def _words(value: str, annotation: Any, text: str) -> tuple[str, str, str]:
    match = WORDS.fullmatch(text.strip())
    if match is None:
        raise InvalidInput(f"holds a word, {value}: given '{text}'; allowed: two words, 'A..B'")
    for word in match.groups():
        try:
            accept(annotation, word)
        except Refused as refusal:
            raise InvalidInput(refusal.why) from None
    if match[1] == match[2]:
        raise InvalidInput(f"a tolerance without width: given '{text}'")
    return match[1], value, match[2]


def _numbers(value: float, quantity: Quantity, text: str) -> tuple[float, float, bool]:
    """Lowest and highest value [SI], and whether they were given as ratios."""
    apart = units.DIFFERENCE.get(quantity.kind, quantity.kind)
    if match := TIMES.fullmatch(text):
        by = float(match[1])
        if by < 1.0 or value <= 0.0:
            raise InvalidInput(f"a factor is above 1, of a value above 0: given '{text}'")
        return value / by, value * by, True
    if match := BOTH.fullmatch(text):
        if match[1].startswith("-"):
            raise InvalidInput(f"a tolerance either way is above 0: given '{text}'")
        half = _difference(value, match[1], match[2], apart)
        return value - half, value + half, False
    if match := APART.fullmatch(text):
        up, down = (_difference(value, each, match[3], apart) for each in match.groups()[:2])
        return value - down, value + up, False
    if match := ENDS.fullmatch(text):
        first, last = match[2] or match[4], match[4]
        ends = [
            units.parse(f"{n} {u}", quantity.kind) for n, u in ((match[1], first), (match[3], last))
        ]
        return ends[0], ends[1], False
    raise InvalidInput(f"no tolerance: given {units.shown(text)}; {FORMS}")


def _difference(value: float, number: str, unit: str, kind: str) -> float:
    """Difference [SI] from text; percentages refer to the value."""
    if unit == "%":
        return abs(value) * float(number) / 100.0
    return units.parse(f"{number} {unit}", kind)
