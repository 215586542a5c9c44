"""Numbers of a solved case that a goal or limit refers to: headline numbers, or a variable."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import translate
from itertools import compress, product
from typing import Any, NamedTuple

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.results.declaration import declared
from rotordyn.results.display import Shown
from rotordyn.results.display import shown as printed_unit
from rotordyn.results.headline import Number
from rotordyn.units import in_unit, parse_unit

ALIKE = 1e-9  # relative difference up to which coordinates are equal


class Reading(NamedTuple):
    """Values read by a criterion, in printed ``unit``; missing ones are dropped.

    ``names``: heading of each number, or variable and entries of its coordinates. Of headline
    numbers: ``speeds`` [rpm] (None without one), and how many numbers are ``absent``."""

    values: Array
    unit: str
    names: tuple[str, ...] = ()
    speeds: tuple[float | None, ...] = ()
    absent: int = 0


@dataclass(frozen=True)
class Criterion:
    """Selection of numbers of a solved case.

    ``of`` "analysis: words": all headline numbers that begin with these words (with whole words, if
    any do); if they have several units, those named exactly so. ``of`` "analysis.variable": a
    variable of the dataset, its absolute value if complex.

    ``where``: selects entries of its coordinates: a text (``*`` stands for any characters), a
    number, or a pair of numbers that bound a range; numbers in SI units or text with a unit.
    """

    of: str
    where: Mapping[str, object] = field(default_factory=dict)

    @property
    def analysis(self) -> str:
        """Name of the analysis."""
        return self.of.replace(":", ".").partition(".")[0].strip()

    @property
    def words(self) -> str:
        """Heading of the selection."""
        chosen = ", ".join(f"{key} {span(value)}" for key, value in self.where.items())
        return f"{self.of} ({chosen})" if chosen else self.of

    def read(self, case: Case, results: Mapping[str, Any]) -> Reading:
        """Read the selected values; missing numbers, and modes or critical speeds that the machine
        lacks, are dropped.

        Raises
        ------
        InvalidInput : no such number, variable, coordinate or entry; the sentence lists those there
            are
        """
        result = results[self.analysis]
        if ":" in self.of:
            return self._numbers(case, result)
        return self._variable(result)

    def _numbers(self, case: Case, result: Any) -> Reading:
        words = self.of.partition(":")[2].strip()
        about = analysis(self.analysis)
        numbers = list(about.numbers(result, case))
        selected = _begun(numbers, words) or _begun(about.lacking(result), words)
        if not selected:
            if not numbers:
                fields = variables(result)
                named = [words] if words in fields else fields
                raise InvalidInput(
                    f"{shown(self.of)}: {self.analysis} has no headline numbers; allowed: its "
                    f"variables, {', '.join(f'{self.analysis}.{name}' for name in named)}"
                )
            names = list(dict.fromkeys(each.name for each in numbers))
            raise InvalidInput(
                f"{shown(self.of)}: {self.analysis} has no such number; allowed: "
                f"{', '.join(names)}{suggestion(words, names)}"
            )
        if self.where:
            raise InvalidInput(f"{shown(self.of)}: where selects of a variable, not of a number")
        if len({each.unit for each in selected}) > 1:
            selected = [each for each in selected if each.name == words] or selected
        if len({each.unit for each in selected}) > 1:
            several = ", ".join(dict.fromkeys(each.name for each in selected))
            raise InvalidInput(
                f"{shown(self.of)}: these numbers have several units: name one of {several}"
            )
        unit = selected[0].unit
        present = [each for each in selected if not np.isnan(each.reading)]
        names = [f"{self.analysis}: {each.heading.removesuffix(f' [{unit}]')}" for each in present]
        speeds = tuple(each.speed for each in present)
        values = np.array([each.reading for each in present])
        return Reading(values, unit, tuple(names), speeds, len(selected) - len(present))

    def _variable(self, result: Any) -> Reading:
        name = self.of.partition(".")[2]
        fields = variables(result)
        if name not in fields:
            raise InvalidInput(
                f"{shown(self.of)}: {self.analysis} has no such variable; allowed: "
                f"{', '.join(fields)}{suggestion(name, fields)}"
            )
        dims = fields[name]
        values = np.asarray(getattr(result, name))
        values = np.abs(values) if np.iscomplexobj(values) else values.astype(float)
        written = {dim: _written(result, dim) for dim in dims}
        units = _units(result, name)
        others = dict(analysis(self.analysis).missing_entries(result))
        for coordinate, asked in self.where.items():
            if coordinate not in dims:
                raise InvalidInput(
                    f"{shown(self.of)}: no coordinate {shown(coordinate)}; allowed: "
                    f"{', '.join(dims) or 'none'}{suggestion(coordinate, dims)}"
                )
            unit = declared(result)[coordinate].metadata["printed"].unit
            entries, further = getattr(result, coordinate), others.get(coordinate, ())
            indices = _places(self.of, coordinate, entries, asked, unit, further)
            values = values.take(indices, axis=dims.index(coordinate))
            written[coordinate] = [written[coordinate][k] for k in indices]
            if coordinate == units.along:
                units = units.taken(indices)
        printed = units.printed(self.of)
        several = [words if len(words) > 1 else [""] for words in written.values()]
        names = [", ".join(filter(None, words)) for words in product(*several)]
        present = ~np.isnan(values.reshape(-1))
        return Reading(
            values.reshape(-1)[present] * printed.factor,
            printed.unit,
            tuple(f"{self.of} {words}".strip() for words in compress(names, present)),
        )


class _Units(NamedTuple):
    """Printed units of a variable: one, or those of the entries ``along`` a coordinate."""

    units: tuple[Shown, ...]
    along: str = ""

    def taken(self, indices: Sequence[int]) -> _Units:
        """Units of some of the entries; where there are none, of all."""
        return _Units(tuple(self.units[k] for k in indices) or self.units, self.along)

    def printed(self, of: str) -> Shown:
        """The one unit; refuse several."""
        several = list(dict.fromkeys(self.units))
        if len(several) > 1:
            raise InvalidInput(
                f"{shown(of)}: these entries have several units, "
                f"{', '.join(each.unit for each in several)}: choose by where: {{{self.along}: …}}"
            )
        return several[0]


def _units(result: Any, name: str) -> _Units:
    """Units of a variable. Those that differ between entries do so along the last coordinate that
    has names: pairs, or ports, unless it is empty."""
    entries = result.entry_units(name) if hasattr(result, "entry_units") else ()
    metadata = declared(result)[name].metadata
    named = [dim for dim in metadata["dims"] if not _is_number(getattr(result, dim))]
    if not entries or not named:
        return _Units((metadata["printed"],))
    return _Units(tuple(map(printed_unit, entries)), named[-1])


def _begun(numbers: Iterable[Number], words: str) -> list[Number]:
    """Numbers whose heading begins with ``words``; only whole words count, if any match."""
    matching = [each for each in numbers if each.heading.startswith(words)]
    return [each for each in matching if f"{each.heading} ".startswith(f"{words} ")] or matching


def span(value: object) -> str:
    """Text of an entry, or of the ends of a range."""
    return " to ".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


def variables(result: Any) -> dict[str, tuple[str, ...]]:
    """Dimensions of the numeric variables of a result, by name."""
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
    """Whether a word matches a pattern; ``*`` after a digit does not match further digits:
    ``bending 1*`` does not match ``bending 10``."""
    ending = re.sub(r"(?<=\d)(?=\.\*|\(\?>\.\*)", r"(?!\\d)", translate(pattern))
    return re.match(ending, word) is not None


def _places(
    of: str, name: str, entries: Any, asked: object, unit: str, others: Sequence[str] = ()
) -> list[int]:
    """Indices of the entries of a coordinate ``asked`` for; none if only ``others`` match."""
    if not _is_number(entries):
        words = [str(each) for each in entries]
        matching = [k for k, word in enumerate(words) if _alike(word, str(asked))]
        if not matching and not any(_alike(word, str(asked)) for word in others):
            raise InvalidInput(
                f"{shown(of)}: no {name} {shown(asked)}; allowed: {', '.join(words)}"
                f"{suggestion(str(asked), words)}"
            )
        return matching
    values = np.asarray(entries, dtype=float)
    ends = asked if isinstance(asked, list | tuple) else (asked, asked)
    if len(ends) != 2:
        raise InvalidInput(f"{shown(of)}: {name} takes one number or two, got {shown(asked)}")
    try:
        for each in ends:
            amount(each, unit)  # refuses a unit of another dimension
        low, high = (amount(each, "") for each in ends)
    except InvalidInput as refusal:
        raise InvalidInput(f"{shown(of)}: {name}: {refusal}") from None
    room = ALIKE * max(abs(low), abs(high))
    inside = (values >= low - room) & (values <= high + room)
    if not inside.any():
        suffix = str(ends[0]).strip().partition(" ")[2]  # the unit in which it was given
        low, high = (in_unit(v, suffix) if suffix else v for v in (values.min(), values.max()))
        raise InvalidInput(
            f"{shown(of)}: no {name} at {shown(asked)}; it goes from {low:.6g} to {high:.6g} "
            f"{suffix or 'in SI units'}"
        )
    return [int(k) for k in np.flatnonzero(inside)]


def amount(given: object, unit: str) -> float:
    """Convert a number (SI), or text with a unit, to the printed ``unit``; to SI if that is empty.

    Raises
    ------
    InvalidInput : not a number; a unit of another dimension than ``unit``
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
