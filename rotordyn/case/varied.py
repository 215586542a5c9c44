"""Values at dotted paths of a case, and those in which cases differ."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from itertools import chain
from typing import Annotated, Any

from rotordyn.analyses.measured_response import Pair
from rotordyn.case.case import Case
from rotordyn.case.deeper import deeper
from rotordyn.case.keys import COMMON, Common, PortPair, Range, keys_of
from rotordyn.description import quantity_of
from rotordyn.field import declared, found_in, kinds_of, metadata, parts_of
from rotordyn.machine.matrix import Matrix, entry_name
from rotordyn.quantity import HIDDEN, Quantity, suggestion
from rotordyn.units import KINDS, parse_unit, shown

OF_CASES = ("spindle", "bearing", "conditions")
OF_CASE = frozenset(field.keys[0] if field.keys else field.name for field in declared(Case))
APART = (("name",), ("title",), ("references",))  # no result depends on these
# Those that overrides in files may change.
IN_FILES = (*(field.keys[0] for field in declared(Case) if field.keys), "tool")
OF_RANGE = [key for field in declared(Range) for key in field.keys]
Leaf = tuple[Any, Quantity | None]
Steps = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Varied:
    """A ``path`` as ``vary`` takes it, and the value of every case there: numbers in ``unit``, None
    if a case lacks the path."""

    path: str
    unit: str
    values: tuple[Any, ...]

    @property
    def label(self) -> str:
        """Path with unit, as a heading."""
        return f"{self.path} [{self.unit}]" if self.unit else self.path

    @property
    def numeric(self) -> bool:
        """Whether every case has a finite number at the path."""
        kinds = (int, float)
        numbers = [v for v in self.values if isinstance(v, kinds) and not isinstance(v, bool)]
        return len(numbers) == len(self.values) and all(map(math.isfinite, numbers))


def varied(cases: Sequence[Case]) -> tuple[Varied, ...]:
    """Differences between the machines and conditions of ``cases``, in the order of the fields;
    names and titles do not count."""
    leaves = [dict(_leaves(case)) for case in cases]
    paths = dict.fromkeys(chain.from_iterable(leaves))
    rows = ((path, [values.get(path, (None, None)) for values in leaves]) for path in paths)
    return tuple(
        _varied(path, row) for path, row in rows if any(leaf[0] != row[0][0] for leaf in row[1:])
    )


def unlike(case: Case, wanted: Case) -> dict[str, Leaf]:
    """Values and quantities of the case ``wanted`` by path, where ``case`` differs; names and
    titles do not count."""
    present = dict(_leaves(case))
    absent = (None, None)
    leaves = {**dict.fromkeys(present, absent), **dict(_leaves(wanted))}
    return {path: leaf for path, leaf in leaves.items() if present.get(path, absent)[0] != leaf[0]}


def found_at(case: Case, path: str, *, absent: bool = False) -> list[tuple[Any, Any]]:
    """Values and annotations at a dotted path as ``vary`` takes it; several with ``*``, none if it
    does not exist. ``absent``: also fields inside absent descriptions."""
    return [(value, annotation) for _, value, annotation in places(case, path, absent=absent)]


def places(case: Case, path: str, *, absent: bool = False) -> list[tuple[str, Any, Any]]:
    """Like ``found_at``, each with its own path from the top, in which ``*`` is replaced."""
    steps = from_top(path, case.bearing is None).split(".")
    matches = reached(case, tuple(steps), absent=absent)
    return [(".".join(way), value, annotation) for way, value, annotation in matches]


def from_top(path: str, spindle: bool, keys: Collection[str] = OF_CASE) -> str:
    """A path from the top of a case, of a ``spindle`` or a single bearing: one that begins with
    none of the ``keys`` of the case lies in its machine."""
    if path.partition(".")[0] in keys:
        return path
    return f"spindle.{path}" if spindle else f"bearing.{path}"


def no_root(step: str, machine: Any) -> str:
    """Sentence on a first step of a path that is a key neither of a case nor of its ``machine``;
    empty if it is one."""
    known = [*IN_FILES, *(field.keys[0] for field in keys_of(machine) if field.keys)]
    if step in known:
        return ""
    inner = deeper(Case, step)
    hint = f" (did you mean {inner}?)" if inner else suggestion(step, known)
    return f"unknown key: given {shown(step)}; allowed: {', '.join(dict.fromkeys(known))}{hint}"


def no_such(step: str, names: Iterable[str], what: str, where: str, inner: str = "") -> str:
    """Sentence on a step of a path that leads nowhere; ``inner``: path on which it exists."""
    known = [*dict.fromkeys(filter(None, names))]
    listed = ", ".join(known[:12]) + (", …" if len(known) > 12 else "")
    if what == "number":
        return f"unknown number '{step}'{where}; allowed: from 1 to {len(known)}"
    hint = f" (did you mean {inner}?)" if inner else suggestion(step, known)
    return f"unknown {what} '{step}'{where}; allowed: {listed or 'none, it is empty'}{hint}"


def within_tool(steps: Steps) -> Steps:
    """Steps within a tool to what a path within the spindle may mean of it; none if it cannot.

    >>> within_tool(("shaft", "sections", "*", "length")), within_tool(("sleeves", "*"))
    (('sections', '*', 'length'), ())
    """
    inner = steps[1:] if steps[:1] == ("shaft",) else steps
    return inner if len(inner) > 1 and inner[0] in ("sections", "masses", "joints") else ()


def of_range(way: str) -> str:
    """Sentence on a path to what only a range in a file has, such as ``speeds.to``."""
    return f"'{way}' is a list of values: give it whole, as a list or {{from: …, to: …, step: …}}"


def too_far(way: str) -> str:
    """Sentence on a path that leads into a single value, into nothing or an empty list."""
    return f"leads too far: '{way}' has no parts; give it whole"


def turn_of(path: str) -> tuple[int, int]:
    """Sort key of paths that are changed together: what is within something, and one item of all,
    come later."""
    return path.count("."), -path.count("*")


def reached(
    value: Any, steps: Steps, annotation: Any = None, done: Steps = (), *, absent: bool = False
) -> Iterator[tuple[Steps, Any, Any]]:
    """Yield own steps, value and annotation of all that ``steps`` lead to within a value."""
    if not steps:
        yield done, value, annotation
        return
    common = common_at(value, steps)
    below = [*_below(value, annotation)]
    if absent and value is None:
        fields = [field for kind in kinds_of(annotation) for field in declared(kind)]
        below = [(field.keys, None, field.annotation) for field in fields if field.keys]
    for ahead in [steps] if common is None else ways_of_items(value, common, steps):
        for way, inner, inside in below:
            fits = all(step in ("*", key) for step, key in zip(ahead, way, strict=False))
            if fits and len(ahead) >= len(way):
                rest = ahead[len(way) :]
                yield from reached(inner, rest, inside, (*done, *way), absent=absent)


def _below(value: Any, annotation: Any) -> Iterator[tuple[tuple[str, ...], Any, Any]]:
    """Yield path, value and annotation of all parts of a value."""
    if is_dataclass(value):
        kind: Any = type(value)
        keys = {field.keys for field in declared(kind)}
        for field in declared(kind):
            way = field.keys or (field.name,)
            if field.name and (field.keys or way not in keys):  # no key is called as another is
                yield way, getattr(value, field.name), field.annotation
    elif isinstance(value, Mapping):
        matrix = found_in(annotation, Matrix)
        key_and_entry = parts_of(annotation, Mapping)
        inside = key_and_entry[1] if key_and_entry else annotation
        for key, entry in value.items():
            if matrix is not None:
                inside = Annotated[float, matrix.quantity(*key)]
            yield (called(key),), entry, inside
    elif isinstance(value, tuple):
        member = parts_of(annotation, tuple) or (annotation,)
        for name, item in zip(called_items(annotation, value), value, strict=True):
            yield (name,), item, member[0]


def _leaves(case: Case) -> Iterator[tuple[str, Leaf]]:
    for name in OF_CASES:
        yield from _within(name, getattr(case, name), None)


def _within(path: str, value: Any, annotation: Any) -> Iterator[tuple[str, Leaf]]:
    """Yield every leaf value below ``path`` with its quantity."""
    fields = is_dataclass(value)
    if not (fields or isinstance(value, Mapping | tuple)):
        yield path, (value, quantity_of(annotation))
    for way, inner, inside in _below(value, annotation):
        if not (fields and (way in APART or HIDDEN in metadata(inside))):
            yield from _within(".".join((path, *way)), inner, inside)


def _varied(path: str, row: Sequence[Leaf]) -> Varied:
    values = [value for value, _ in row]
    quantity = next((q for value, q in row if q is not None and isinstance(value, float)), None)
    if quantity is None:
        return Varied(path, "", tuple(values))
    unit = usual_unit(quantity, [v for v in values if isinstance(v, float)])
    scale = parse_unit(unit).scale if unit else 1.0
    scaled = (float(f"{v / scale:.12g}") if isinstance(v, float) else v for v in values)
    return Varied(path, unit, tuple(scaled))


def usual_unit(quantity: Quantity, values: Sequence[float]) -> str:
    """Usual unit in which the largest value lies between 1 and 1000, if there is one; rpm for any
    speed."""
    units = KINDS[quantity.kind]
    if quantity.kind == "speed":
        return units[0]
    top = max((abs(v) for v in values if math.isfinite(v)), default=0.0)
    fits = (u for u in units if 1.0 <= top / (parse_unit(u).scale if u else 1.0) < 1000.0)
    return next(fits, units[0])


def common_at(holder: Any, steps: Steps) -> Common | None:
    """The common value of several items of ``holder`` into which a path leads; None if none."""
    each: Common
    for each in COMMON.get(type(holder), ()):
        if each.meaning and steps[: len(each.keys)] == each.keys:
            return each
    return None


def called(key: object) -> str:
    """Key of a mapping as written in a path; entries of a matrix as in files."""
    return entry_name(*key) if isinstance(key, tuple) else str(key)


def called_at(place: int, item: object) -> str:
    """Item of a list as written in a path: its name, or its number from 1 if it has none."""
    return getattr(item, "name", "") or str(place)


def called_items(annotation: Any, items: Sequence[Any]) -> list[str]:
    """Items of a list as written in a path."""
    if found_in(annotation, Pair) is not None:
        return [key for field in declared(PortPair) for key in field.keys]
    return [called_at(place, item) for place, item in enumerate(items, start=1)]


def ways_of_items(holder: Any, common: Common, steps: Steps) -> list[Steps]:
    """The path inside every item that has no such value itself."""
    listed, _, key = common.fills
    kind: Any = type(holder)
    name = next(field.name for field in declared(kind) if field.keys == (listed,))
    rest = (key, *steps[len(common.keys) :])
    items = enumerate(getattr(holder, name), start=1)
    return [(listed, called_at(k, each), *rest) for k, each in items if key not in each.own]
