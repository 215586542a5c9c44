"""Headline numbers and curves of a result, by which variants are compared.

Both are plain data: summary, table and figures of variants read those of any analysis.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.machine.reference import Reference
from rotordyn.results.declaration import declared
from rotordyn.results.display import RPM, number
from rotordyn.results.text import outside

LEAST_POINTS = 4  # for a line; fewer are marks
FAR = 4.0  # times a ceiling: limit up to which a line is drawn beyond an axis
NONE = "none"  # printed for a missing number, unless it names a reason
CHANGE = 6  # decimals of a change [%]: less is rounding
Known = tuple[str, str]  # quantity and subject of a reference
Place = tuple[float, str]


class Number(NamedTuple):
    """A headline number as printed.

    ``speed`` [rpm] where it is one of several over speed; ``part``: distinguishes numbers of
    one ``name``, such as a direction of whirl, that summaries write side by side;
    ``absent``: printed where there is none (NaN); ``inner``: at a speed between the first and the
    last, which goals and limits read and tables omit. ``bound``: upper bound of an unknown value
    (NaN).
    """

    name: str
    unit: str
    value: float
    part: str = ""
    speed: float | None = None
    digits: int = 1
    absent: str = NONE
    inner: bool = False
    bound: float = np.nan

    @property
    def words(self) -> str:
        """Name, part and speed, which are unique within an analysis."""
        at = f"at {self.speed:.0f} rpm" if self.speed is not None else ""
        return " ".join(word for word in (self.name, self.part, at) if word)

    @property
    def reading(self) -> float:
        """Value that goals, limits and studies read: the bound where only that is known."""
        return float(np.fmin(self.value, self.bound))

    @property
    def heading(self) -> str:
        """Heading of the column of the number, with its unit."""
        return f"{self.words} [{self.unit}]" if self.unit else self.words


class Curve(NamedTuple):
    """A curve as printed, in a ``panel`` of the ``figure`` that overlays variants.

    ``label`` and ``unit`` of the ordinate are those of the panel's first curve. ``series``: name
    that distinguishes curves of one variant, by dashes; ``key``: name that curves of two variants
    have in common, by default the series. ``breaks``: steps between points without a line.
    ``known``: references shown beside it; ``limits`` of the ordinate, None where it has none;
    ``places`` along the abscissa, named above the panel. ``backdrop``: equal in all variants.
    ``end``: its name at the right edge, of several that share a series. ``least``: points that a
    line needs; fewer are marks. ``ceiling``: larger values lie beyond the axis, which does not
    grow for them.
    """

    figure: str
    label: str
    unit: str
    x: Array
    y: Array
    series: str = ""
    key: str = ""
    panel: str = ""
    along: str = "speed [rpm]"
    title: str = ""
    breaks: Flags | None = None
    known: Known | None = None
    limits: tuple[float | None, float | None] = (None, None)
    log: bool = False
    backdrop: bool = False
    places: Sequence[Place] = ()
    end: str = ""
    least: int = LEAST_POINTS
    ceiling: float = np.inf

    @property
    def dotted(self) -> bool:
        """Whether its points are too few for a line."""
        return 1 < len(self.x) < self.least

    @property
    def by_ratio(self) -> bool:
        """Whether values are positive and compared by ratio: amplitudes, unbounded depths."""
        return self.log or bool(np.isfinite(self.ceiling))

    @property
    def within(self) -> Curve:
        """Copy without the values beyond the axis."""
        return self._replace(y=under(np.asarray(self.y, float), self.ceiling))

    @property
    def drawn(self) -> tuple[Array, Array]:
        """x and y with a gap at every jump, and where y has no logarithm."""
        x, y = np.asarray(self.x, float), np.asarray(self.y, float)
        if self.log:
            y = np.where(y > 0.0, y, np.nan)
        return (x, y) if self.breaks is None else broken(x, y, self.breaks)


def under(values: Array, ceiling: float) -> Array:
    """Values with NaN where their size is above a ceiling; all of them where it is infinite."""
    return values if np.isinf(ceiling) else np.where(np.abs(values) <= ceiling, values, np.nan)


def broken(x: Array, y: Array, breaks: Flags) -> tuple[Array, Array]:
    """x and y with a gap at every step between points over which no line is drawn."""
    at = np.flatnonzero(breaks) + 1
    return np.insert(x, at, x[at]), np.insert(y, at, np.nan)


def belongs(reference: Reference, known: Collection[Known]) -> bool:
    """Whether a reference is shown with curves of these (quantity, subject): with those of its
    subject, or with all of its quantity where it has none."""
    subjects = {subject for quantity, subject in known if quantity == reference.quantity}
    return bool(subjects) and (reference.subject in subjects or not reference.subject)


def each_speed(
    result: Any, name: str, unit: str, values: Array, *, part: str = "", digits: int = 1
) -> Iterator[Number]:
    """A number at every speed of ``values`` (speeds,)."""
    for k, (speed, value) in enumerate(zip(result.speed, values, strict=True)):
        rpm, inner = float(speed * RPM.factor), 0 < k < len(values) - 1
        yield Number(name, unit, float(value), part, rpm, digits, inner=inner)


def curves_of(
    result: Any, field: str, *, along: str = "speed", panels: str = "", series: str = "", **how: Any
) -> Iterator[Curve]:
    """Curves of a declared ``field`` over its coordinate ``along``.

    ``panels`` and ``series``: dimensions whose entries have a panel, or dashes, each; of ``series``
    several, separated by blanks. ``how``: further fields of ``Curve``.
    """
    fields = {name: item.metadata for name, item in declared(result).items()}
    entries = {m["dims"][0]: name for name, m in fields.items() if m["role"] == "coordinate"}
    info, abscissa = fields[field], fields[along]
    x = getattr(result, along) * abscissa["printed"].factor
    values = np.moveaxis(getattr(result, field), info["dims"].index(along), -1)
    remaining = [dim for dim in info["dims"] if dim != along]
    for index in product(*(range(n) for n in values.shape[:-1])):
        at = zip(remaining, index, strict=True)
        names = {dim: str(getattr(result, entries[dim])[k]) for dim, k in at}
        series_name = ", ".join(names[dim] for dim in series.split())
        look = {
            "label": info["label"],
            "unit": info["printed"].unit,
            "panel": names.get(panels, ""),
            "series": series_name,
            "key": series_name,
            "along": f"{abscissa['label']} [{abscissa['printed'].unit}]",
        }
        yield Curve(x=x, y=values[index] * info["printed"].factor, **{**look, **how})


def cells(numbers: Iterable[Number]) -> dict[str, str]:
    """Numbers as text, by name and unit: parts joined by "/", the first and the last speed by "→",
    with extremes beyond both of them."""
    grouped: dict[str, dict[float | None, list[Number]]] = {}
    for entry in numbers:
        head = f"{entry.name} [{entry.unit}]" if entry.unit else entry.name
        grouped.setdefault(head, {}).setdefault(entry.speed, []).append(entry)
    return {head: _over_speed([*by_speed.values()]) for head, by_speed in grouped.items()}


def _over_speed(groups: Sequence[Sequence[Number]]) -> str:
    """Numbers at the first and the last speed as text, and extremes beyond them."""
    text = " → ".join(_side_by_side(group) for group in groups if not group[0].inner)
    first = groups[0][0]
    extremes = [
        [pick([entry.value for entry in group]) for group in groups]
        for pick in (np.fmin.reduce, np.fmax.reduce)
    ]
    more = [
        f"{word} {number(value, first.digits)}"
        for word, values in zip(("least", "most"), extremes, strict=True)
        for kind, _, value in outside(np.array(values))
        if kind == word
    ]
    return f"{text} ({', '.join(more)})" if more else text


def _side_by_side(parts: Sequence[Number]) -> str:
    """Parts of a number as text, once where they are equal."""
    texts = [_printed(part) for part in parts]
    values = np.array([part.value for part in parts])
    equal = np.allclose(values, values[0], rtol=1e-6, atol=0.0, equal_nan=True)
    return texts[0] if equal else "/".join(texts)


def _printed(entry: Number) -> str:
    if np.isnan(entry.value):
        return entry.absent
    return "unbounded" if np.isinf(entry.value) else number(entry.value, entry.digits)


def changes(numbers: Mapping[str, float], first: Mapping[str, float]) -> dict[str, float]:
    """Relative changes [%] of numbers from those of the same name of another variant, NaN where one
    of them has no value or the other is zero."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = {
            name: np.divide(value, first.get(name, np.nan)) - 1.0 for name, value in numbers.items()
        }
    return {
        name: round(float(r) * 100.0, CHANGE) if np.isfinite(r) else np.nan
        for name, r in ratio.items()
    }
