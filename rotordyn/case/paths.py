"""Dotted paths of a case: what they lead to, and values on their way there.

A path consists of keys as in files, names of items (numbers from 1 where they have none) and keys
of mappings; ``*`` stands for every item or entry.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from functools import cache
from typing import Annotated, Any

from rotordyn.analyses.measured_response import Pair
from rotordyn.case.case import Case
from rotordyn.case.deeper import deeper
from rotordyn.case.keys import COMMON, Common, PortPair, Range, keys_of
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, accept, declared, found_in, kinds_of, parts_of
from rotordyn.machine.matrix import Matrix, entry_name
from rotordyn.quantity import suggestion
from rotordyn.units import shown

OF_CASE = frozenset(field.keys[0] if field.keys else field.name for field in declared(Case))
# Those that overrides in files may change.
IN_FILES = (*(field.keys[0] for field in declared(Case) if field.keys), "tool")
OF_RANGE = [key for field in declared(Range) for key in field.keys]
WRITTEN = (str, int, float, Mapping, list, tuple)  # what a file may hold
Steps = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Change:
    """A new value, the whole path to it as given, and the remaining ``steps`` of the path."""

    value: object
    path: str
    steps: Steps

    def inside(self, count: int) -> Change:
        """The change without the first steps, which lead to what it is within."""
        return Change(self.value, self.path, self.steps[count:])

    @property
    def way(self) -> str:
        """The part of the path up to the current value."""
        return self.path.removesuffix(".".join(self.steps)).rstrip(".")

    @property
    def removes(self) -> bool:
        """True if nothing is given for the current value."""
        return not self.steps and self.value is None

    def refused(self, why: str, place: str = "") -> InvalidInput:
        return InvalidInput(f"{self.path}{place}: {why}")


def value_of(annotation: Any, value: object) -> Any:
    """Convert a value: an object or number in SI units, or as files write it; raises Refused."""
    try:
        return accept(annotation, value)
    except Refused:
        listed = value if isinstance(value, list | tuple) else [value]
        if not all(each is None or isinstance(each, WRITTEN) for each in listed):
            raise
    from rotordyn.case.forms import in_python  # reads YAML, which vary seldom needs

    return in_python(annotation, value)


def taken(annotation: Any, change: Change) -> Any:
    try:
        return value_of(annotation, change.value)
    except Refused as refusal:
        raise change.refused(refusal.why, refusal.place) from None


@cache
def ways_of(kind: Any) -> dict[Steps, str]:
    """Fields of a description by the steps that lead to them."""
    fields = declared(kind)
    ways = {(field.name,): field.name for field in fields if not field.keys}
    return ways | {field.keys: field.name for field in fields if field.keys}


def from_top(path: str, spindle: bool, keys: Collection[str] = OF_CASE) -> str:
    """A path from the top of a case, of a ``spindle`` or a single bearing: one that begins with
    none of the ``keys`` of the case lies in its machine."""
    if path.partition(".")[0] in keys:
        return path
    return f"spindle.{path}" if spindle else f"bearing.{path}"


def order_of(steps: Sequence[str]) -> tuple[int, int]:
    """Sort key of whole paths that are changed together: what is within something, and one item of
    all, come later."""
    return len(steps), -[*steps].count("*")


def within_tool(steps: Steps) -> Steps:
    """Steps within a tool to what a path within the spindle may mean of it; none if it cannot.

    >>> within_tool(("shaft", "sections", "*", "length")), within_tool(("sleeves", "*"))
    (('sections', '*', 'length'), ())
    """
    inner = steps[1:] if steps[:1] == ("shaft",) else steps
    return inner if len(inner) > 1 and inner[0] in ("sections", "masses", "joints") else ()


def no_root(step: str, machine: Any) -> str:
    """Sentence on a first step of a path that is a key neither of a case nor of its ``machine``;
    empty if it is one."""
    known = [*IN_FILES, *(field.keys[0] for field in keys_of(machine) if field.keys)]
    if step in known:
        return ""
    inner = deeper(Case, step)
    hint = f" (did you mean {inner}?)" if inner else suggestion(step, known)
    return f"unknown key: given {shown(step)}; allowed: {', '.join(dict.fromkeys(known))}{hint}"


def no_such(step: str, names: Iterable[str], what: str, where: str) -> str:
    """Sentence on a step of a path that leads nowhere."""
    known = [*dict.fromkeys(filter(None, names))]
    listed = ", ".join(known[:12]) + (", …" if len(known) > 12 else "")
    if what == "number":
        return f"unknown number '{step}'{where}; allowed: from 1 to {len(known)}"
    listed = listed or "none, it is empty"
    return f"unknown {what} '{step}'{where}; allowed: {listed}{suggestion(step, known)}"


def of_range(way: str) -> str:
    """Sentence on a path to what only a range in a file has, such as ``speeds.to``."""
    return f"'{way}' is a list of values: give it whole, as a list or {{from: …, to: …, step: …}}"


def too_far(way: str) -> str:
    """Sentence on a path that leads into a single value, into nothing or an empty list."""
    return f"leads too far: '{way}' has no parts; give it whole"


def found_at(case: Case, path: str, *, absent: bool = False) -> list[tuple[Any, Any]]:
    """Values and annotations at a dotted path as ``vary`` takes it; several with ``*``, none if it
    does not exist. ``absent``: also fields inside absent descriptions."""
    return [(value, annotation) for _, value, annotation in places(case, path, absent=absent)]


def places(case: Case, path: str, *, absent: bool = False) -> list[tuple[str, Any, Any]]:
    """Like ``found_at``, each with its own path from the top, in which ``*`` is replaced."""
    steps = from_top(path, case.bearing is None).split(".")
    matches = reached(case, tuple(steps), absent=absent)
    return [(".".join(way), value, annotation) for way, value, annotation in matches]


def reached(
    value: Any, steps: Steps, annotation: Any = None, done: Steps = (), *, absent: bool = False
) -> Iterator[tuple[Steps, Any, Any]]:
    """Yield own steps, value and annotation of all that ``steps`` lead to within a value."""
    if not steps:
        yield done, value, annotation
        return
    common = common_at(value, steps)
    below = [*children(value, annotation)]
    if absent and value is None:
        fields = [field for kind in kinds_of(annotation) for field in declared(kind)]
        below = [(field.keys, None, field.annotation) for field in fields if field.keys]
    for ahead in [steps] if common is None else ways_of_items(value, common, steps):
        for way, inner, inside in below:
            fits = all(step in ("*", key) for step, key in zip(ahead, way, strict=False))
            if fits and len(ahead) >= len(way):
                rest = ahead[len(way) :]
                yield from reached(inner, rest, inside, (*done, *way), absent=absent)


def children(value: Any, annotation: Any) -> Iterator[tuple[Steps, Any, Any]]:
    """Yield steps, value and annotation of all parts of a value."""
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
            yield (key_in_path(key),), entry, inside
    elif isinstance(value, tuple):
        member = parts_of(annotation, tuple) or (annotation,)
        for name, item in zip(items_in_path(annotation, value), value, strict=True):
            yield (name,), item, member[0]


def common_at(holder: Any, steps: Steps) -> Common | None:
    """The common value of several items of ``holder`` into which a path leads; None if none."""
    each: Common
    for each in COMMON.get(type(holder), ()):
        if each.meaning and steps[: len(each.keys)] == each.keys:
            return each
    return None


def ways_of_items(holder: Any, common: Common, steps: Steps) -> list[Steps]:
    """The path inside every item that has no such value itself."""
    listed, _, key = common.fills
    kind: Any = type(holder)
    name = next(field.name for field in declared(kind) if field.keys == (listed,))
    rest = (key, *steps[len(common.keys) :])
    items = enumerate(getattr(holder, name), start=1)
    return [(listed, item_in_path(k, each), *rest) for k, each in items if key not in each.own]


def key_in_path(key: object) -> str:
    """Key of a mapping as written in a path; entries of a matrix as in files."""
    return entry_name(*key) if isinstance(key, tuple) else str(key)


def item_in_path(place: int, item: object) -> str:
    """Item of a list as written in a path: its name, or its number from 1 if it has none."""
    return getattr(item, "name", "") or str(place)


def items_in_path(annotation: Any, items: Sequence[Any]) -> list[str]:
    """Items of a list as written in a path."""
    if found_in(annotation, Pair) is not None:
        return [key for field in declared(PortPair) for key in field.keys]
    return [item_in_path(place, item) for place, item in enumerate(items, start=1)]
