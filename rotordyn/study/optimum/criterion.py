"""What a goal or limit reads of a solved case: headline numbers, or a variable of a result."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import translate
from itertools import compress, product
from typing import Any, NamedTuple

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.results.declaration import declared
from rotordyn.results.headline import Number
from rotordyn.results.kinds import Array
from rotordyn.units import in_unit, parse_unit

ALIKE = 1e-9  # relative difference of coordinates that are the same


class Reading(NamedTuple):
    """Values that a criterion reads, as printed, without those that are absent; their unit; the
    heading of each, or the variable with the entries that several have; of headline numbers the
    ``speeds`` [rpm], None of one that has none, and how many are ``absent``."""

    values: Array
    unit: str
    names: tuple[str, ...] = ()
    speeds: tuple[float | None, ...] = ()
    absent: int = 0


@dataclass(frozen=True)
class Criterion:
    """What is read: ``of`` "analysis: words" all headline numbers that begin with these words,
    whole ones where there are such, of those in several units the ones whose whole name they are;
    or ``of`` "analysis.variable" a variable of its dataset, by its size where it is complex.

    ``where``: entries of its coordinates, by name a word (``*`` any letters), a number, or a pair
    of numbers that bound a range; numbers in SI units or text with a unit.
    """

    of: str
    where: Mapping[str, object] = field(default_factory=dict)

    @property
    def analysis(self) -> str:
        """The analysis that is asked."""
        return self.of.replace(":", ".").partition(".")[0].strip()

    @property
    def words(self) -> str:
        """As a heading."""
        chosen = ", ".join(f"{key} {span(value)}" for key, value in self.where.items())
        return f"{self.of} ({chosen})" if chosen else self.of

    def read(self, case: Case, results: Mapping[str, Any]) -> Reading:
        """All values, those without a number left out; none of modes and critical speeds that the
        machine has not.

        Raises
        ------
        InvalidInput : no such number, variable, coordinate or entry; the sentence says which exist
        """
        result = results[self.analysis]
        if ":" in self.of:
            return self._numbers(case, result)
        return self._variable(result)

    def _numbers(self, case: Case, result: Any) -> Reading:
        words = self.of.partition(":")[2].strip()
        about = analysis(self.analysis)
        numbers = list(about.numbers(result, case))
        found = _begun(numbers, words) or _begun(about.lacking(result), words)
        if not found:
            names = list(dict.fromkeys(each.name for each in numbers))
            raise InvalidInput(
                f"{shown(self.of)}: {self.analysis} has no such number; allowed: "
                f"{', '.join(names)}{suggestion(words, names)}"
            )
        if self.where:
            raise InvalidInput(f"{shown(self.of)}: where selects of a variable, not of a number")
        if len({each.unit for each in found}) > 1:
            found = [each for each in found if each.name == words] or found
        if len({each.unit for each in found}) > 1:
            several = ", ".join(dict.fromkeys(each.name for each in found))
            raise InvalidInput(
                f"{shown(self.of)}: these numbers have several units: name one of {several}"
            )
        unit = found[0].unit
        known = [each for each in found if not np.isnan(each.value)]
        names = [f"{self.analysis}: {each.heading.removesuffix(f' [{unit}]')}" for each in known]
        speeds = tuple(each.speed for each in known)
        values = np.array([each.value for each in known])
        return Reading(values, unit, tuple(names), speeds, len(found) - len(known))

    def _variable(self, result: Any) -> Reading:
        name = self.of.partition(".")[2]
        fields = variables(result)
        if name not in fields:
            raise InvalidInput(
                f"{shown(self.of)}: {self.analysis} has no such variable; allowed: "
                f"{', '.join(fields)}{suggestion(name, fields)}"
            )
        dims, printed = fields[name], declared(result)[name].metadata["printed"]
        values = np.asarray(getattr(result, name))
        values = np.abs(values) if np.iscomplexobj(values) else values.astype(float)
        written = {dim: _written(result, dim) for dim in dims}
        others = dict(analysis(self.analysis).unlisted(result))
        for coordinate, asked in self.where.items():
            if coordinate not in dims:
                raise InvalidInput(
                    f"{shown(self.of)}: no coordinate {shown(coordinate)}; allowed: "
                    f"{', '.join(dims) or 'none'}{suggestion(coordinate, dims)}"
                )
            unit = declared(result)[coordinate].metadata["printed"].unit
            entries, further = getattr(result, coordinate), others.get(coordinate, ())
            places = _places(self.of, coordinate, entries, asked, unit, further)
            values = values.take(places, axis=dims.index(coordinate))
            written[coordinate] = [written[coordinate][k] for k in places]
        several = [words if len(words) > 1 else [""] for words in written.values()]
        names = [", ".join(filter(None, words)) for words in product(*several)]
        known = ~np.isnan(values.reshape(-1))
        return Reading(
            values.reshape(-1)[known] * printed.factor,
            printed.unit,
            tuple(f"{self.of} {words}".strip() for words in compress(names, known)),
        )


def _begun(numbers: Iterable[Number], words: str) -> list[Number]:
    """Those whose heading begins with words, with whole ones where there are such."""
    found = [each for each in numbers if each.heading.startswith(words)]
    return [each for each in found if f"{each.heading} ".startswith(f"{words} ")] or found


def span(value: object) -> str:
    """An entry, or the ends of a range, in words."""
    return " to ".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


def variables(result: Any) -> dict[str, tuple[str, ...]]:
    """Variables of a result that are numbers, with their dimensions."""
    return {
        key: each.metadata["dims"]
        for key, each in declared(result).items()
        if each.metadata["role"] == "quantity" and _is_number(getattr(result, key))
    }


def _is_number(values: Any) -> bool:
    return np.asarray(values).dtype.kind in "fiubc"


def _written(result: Any, coordinate: str) -> list[str]:
    """Entries of a coordinate as printed."""
    entries, printed = getattr(result, coordinate), declared(result)[coordinate].metadata["printed"]
    if not _is_number(entries):
        return [str(each) for each in entries]
    return [f"{each * printed.factor:.6g} {printed.unit}".strip() for each in np.asarray(entries)]


def _alike(word: str, pattern: str) -> bool:
    """Whether a word is that of a pattern; a number before ``*`` ends there: ``bending 1*`` is not
    ``bending 10``."""
    ending = re.sub(r"(?<=\d)(?=\.\*|\(\?>\.\*)", r"(?!\\d)", translate(pattern))
    return re.match(ending, word) is not None


def _places(
    of: str, name: str, entries: Any, asked: object, unit: str, others: Sequence[str] = ()
) -> list[int]:
    """Which entries of a coordinate are meant; none where these are ``others``."""
    if not _is_number(entries):
        words = [str(each) for each in entries]
        found = [k for k, word in enumerate(words) if _alike(word, str(asked))]
        if not found and not any(_alike(word, str(asked)) for word in others):
            raise InvalidInput(
                f"{shown(of)}: no {name} {shown(asked)}; allowed: {', '.join(words)}"
                f"{suggestion(str(asked), words)}"
            )
        return found
    values = np.asarray(entries, dtype=float)
    ends = asked if isinstance(asked, list | tuple) else (asked, asked)
    if len(ends) != 2:
        raise InvalidInput(f"{shown(of)}: {name} takes one number or two, got {shown(asked)}")
    try:
        for each in ends:
            amount(each, unit)  # of its kind
        low, high = (amount(each, "") for each in ends)
    except InvalidInput as refusal:
        raise InvalidInput(f"{shown(of)}: {name}: {refusal}") from None
    room = ALIKE * max(abs(low), abs(high))
    inside = (values >= low - room) & (values <= high + room)
    if not inside.any():
        suffix = str(ends[0]).strip().partition(" ")[2]  # a unit, as it was asked in
        low, high = (in_unit(v, suffix) if suffix else v for v in (values.min(), values.max()))
        raise InvalidInput(
            f"{shown(of)}: no {name} at {shown(asked)}; it goes from {low:.6g} to {high:.6g} "
            f"{suffix or 'in SI units'}"
        )
    return [int(k) for k in np.flatnonzero(inside)]


def amount(given: object, unit: str) -> float:
    """A number (SI), or text with a unit, counted in the printed ``unit``; SI where that is empty.

    Raises
    ------
    InvalidInput : no number; a unit of another kind than ``unit``
    """
    word, _, suffix = str(given).strip().partition(" ")
    try:
        value = float(word)
        written, printed = parse_unit(suffix), parse_unit(unit) if unit not in ("", "-") else None
    except (ValueError, InvalidInput):
        if suffix and suffix == unit:  # such as "1e6 mm/min", a unit of prints alone
            return float(word)
        raise InvalidInput(
            f"not a number with a unit: given {shown(given)}" + (f", in {unit}" if unit else "")
        ) from None
    if printed is None:
        return value * written.scale
    if isinstance(given, str) and written.dimension != printed.dimension:
        raise InvalidInput(f"expected a number in {unit}: given {shown(given)}")
    return value * (written.scale if isinstance(given, str) else 1.0) / printed.scale
