"""Change values at dotted paths of a frozen description (``"spindle.bearings.a.x"``)."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, is_dataclass, replace
from functools import cache, partial
from typing import Annotated, Any, TypeVar, get_args, get_origin

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from rotordyn.analyses.registry import analysis, names
from rotordyn.case.arranged import CLASSES
from rotordyn.case.case import ByName, Case
from rotordyn.case.deeper import deeper
from rotordyn.case.keys import COMMON, keys_of
from rotordyn.case.varied import (
    Steps,
    called,
    called_at,
    common_at,
    from_top,
    no_such,
    reached,
    turn_of,
    ways_of_items,
)
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import (
    REQUIRED,
    Field,
    Refused,
    accept,
    declared,
    descriptions,
    found_in,
    kinds_of,
    parts_of,
    shown,
)
from rotordyn.machine.bearing_set import BearingSet
from rotordyn.machine.matrix import Matrix
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.quantity import Choice, suggestion
from rotordyn.scene.conditions import HYPOTHESES, Conditions

D = TypeVar("D")
K = TypeVar("K")
LONGEST = 1000  # characters of a path
WHOLE = (Spindle, BallBearing, Tool)  # cannot begin with defaults
OF_CLASS = ("arrangement", "preload", "class")
NO_KEYS = ("tool", "variants")  # fields of a case that paths may name though files have no such key


@dataclass(frozen=True, slots=True)
class _Change:
    """A new value, the whole path to it as given, and the remaining ``steps`` of the path."""

    value: object
    path: str
    steps: Steps

    def inside(self, count: int) -> _Change:
        """The change without the first steps, which lead to what it is within."""
        return _Change(self.value, self.path, self.steps[count:])

    def refused(self, why: str, place: str = "") -> InvalidInput:
        return InvalidInput(f"{self.path}{place}: {why}")


def vary(description: D, changes: Mapping[str, object]) -> D:
    """``description`` with other values at dotted paths; the description itself stays as it is.

    A path is that of ``override`` in files. It begins at the top of a case, or within its machine
    (``sleeves.front.mass`` is ``spindle.sleeves.front.mass``); of a key that both have, that of the
    case is meant. It names keys, items of a list by their ``name`` or, where they have none, by
    their place from 1 (``damping.rotor.1``), entries of a mapping by their key, further points by a
    name that is like none there is; ``*`` stands for every item or entry.
    What a file gives once for all bearings (``fits``) goes to those that give none themselves; what
    is absent (``conditions.temperatures``) begins with its defaults; ``tool`` is what is in the
    nose.
    Values are objects, numbers in SI units, or as files write them: text with a unit
    (``"8 N/um"``), names of models, mappings. They replace what is there. All changes are made
    together: only the outcome must be possible; what is within something that is replaced, and one
    item of all, have their own values. What changes a case changes its variants too, unless the
    path begins with ``variants``.

    Raises
    ------
    InvalidInput : a path that leads nowhere, a value of the wrong type or out of its range, or an
        outcome that contradicts itself; one sentence that names the path and what is allowed
    """
    other = changed(description, changes)
    return _signed(other) if isinstance(other, Case) else other


def changed(description: D, changes: Mapping[str, object]) -> D:
    """Like ``vary``, but the digest stays that of the original case."""
    if not is_dataclass(description) or isinstance(description, type):
        raise InvalidInput(f"vary takes a description, such as a Case: given {shown(description)}")
    if not isinstance(changes, Mapping):
        raise InvalidInput(f"changes map a dotted path to a value: given {shown(changes)}")
    listed = [_change(path, value) for path, value in changes.items()]
    if isinstance(description, Case):
        listed = [_from_top(description, each) for each in listed]
        last = {each.steps: each for each in listed}
        for change in listed:
            if last[change.steps] is not change:
                room = change.steps[0]
                raise change.refused(f"given twice, with and without '{room}.' before it")
    listed.sort(key=lambda each: turn_of(".".join(each.steps)))
    if isinstance(description, Case):
        listed = [*_of_variants(description, listed), *listed]
    return _fields(description, listed)


def _of_variants(case: Case, changes: Sequence[_Change]) -> list[_Change]:
    """Repeat the changes for every variant of ``case``."""
    if not case.variants:
        return []
    inner = [change for change in changes if change.steps[0] not in ("variants", "name", "title")]
    return [replace(change, steps=("variants", "*", *change.steps)) for change in inner]


def _change(path: object, value: object) -> _Change:
    if not isinstance(path, str) or not all(path.split(".")) or not path.isprintable():
        raise InvalidInput(f"not a dotted path: given {shown(path)}; such as 'conditions.rotor'")
    if len(path) > LONGEST:
        raise InvalidInput(f"{path[:40]}...: a path longer than {LONGEST} characters")
    return _Change(value, path, tuple(path.split(".")))


def _from_top(case: Case, change: _Change) -> _Change:
    """Complete a path that begins within the machine of ``case``."""
    path = from_top(change.path, spindle=case.bearing is None)
    if path == change.path:
        return change
    machine: Any = Spindle if case.bearing is None else type(case.bearing)
    known = [*_keys(Case), *(field.keys[0] for field in keys_of(machine) if field.keys)]
    _require_known(change, known, "key", deeper(Case, change.steps[0]))
    return replace(change, steps=(*path.split("."),))


def _signed(case: Any) -> Any:
    """Give a changed case a digest of its own, as its files no longer define it."""
    text = f"{case.digest} {replace(case, files=(), digest='')!r}"
    return replace(case, digest=hashlib.sha256(text.encode()).hexdigest())


def _value(annotation: Any, old: Any, changes: Sequence[_Change]) -> Any:
    """Apply ``changes`` to ``old`` in their order."""
    for index, change in enumerate(changes):
        if not change.steps:
            return _value(annotation, _taken(annotation, change), changes[index + 1 :])
    if not changes:
        return old
    kinds = kinds_of(annotation) if old is None else []
    if kinds and kinds[0] not in WHOLE:
        return _begun(kinds, changes)
    if is_dataclass(old):
        return _fields(old, changes)
    if isinstance(old, Mapping):
        return _entries(annotation, old, changes)
    if isinstance(old, tuple) and old:
        return _items(annotation, old, changes)
    raise changes[0].refused(
        f"leads too far: '{_way_to(changes[0])}' is {shown(old)}; give it whole"
    )


def value_of(annotation: Any, value: object) -> Any:
    """Convert a value: an object or number in SI units, or as files write it; raises Refused."""
    try:
        return accept(annotation, value)
    except Refused:
        listed = value if isinstance(value, list | tuple) else [value]
        mapped = any(isinstance(each, Mapping) for each in listed)
        named = any(isinstance(each, str) for each in listed) and any(descriptions(annotation))
        if not mapped and not named:
            raise
    from rotordyn.case.forms import in_python  # reads YAML, which vary seldom needs

    return in_python(annotation, value)


def _taken(annotation: Any, change: _Change) -> Any:
    try:
        return value_of(annotation, change.value)
    except Refused as refusal:
        raise change.refused(refusal.why, refusal.place) from None


def _fields(old: Any, changes: Sequence[_Change]) -> Any:
    fields = {field.name: field for field in declared(old.__class__)}
    if isinstance(old, Case):
        changes = _clamped(old, fields["tool"], changes)
    of_model: dict[str, Any] = {}
    if isinstance(old, BearingSeat):
        of_model, changes = _of_model(old, changes)
    ways = [way for each in changes for way in _of_items(old, _of_class(old, each))]
    groups = _by_field(old.__class__, ways)
    new = of_model | {
        name: _value(fields[name].annotation, getattr(old, name), group)
        for name, group in groups.items()
    }
    if isinstance(arrangement := new.get("arrangement"), BearingSet):
        turned = arrangement.turned(old.seats)
        new["seats"] = _value(fields["seats"].annotation, turned, groups.setdefault("seats", []))
    if isinstance(old, Conditions):
        new["stated"] = (*old.stated, *(key for key in HYPOTHESES if key in groups))
    made = _made(partial(replace, old), new, changes)
    for name in groups:
        result = getattr(made, name)
        if result is not new[name] and result != new[name]:
            _require_kept(fields[name].annotation, result, groups[name])
    return made


def _of_model(old: BearingSeat, changes: Sequence[_Change]) -> tuple[dict[str, Any], list[_Change]]:
    """What else another model gives to a bearing: values of fields, and the sizes of its rings to
    what is new within the bearing, or had those of the model before."""
    hidden: dict[str, Any] = {}
    sized, listed = [], [*changes]
    for k, change in enumerate(changes):
        if change.steps != ("model",) or change.value == old.bearing:
            continue
        if isinstance(change.value, BallBearing):
            hidden |= {"model": "", "preloads": ()}
        else:
            content = {"name": old.name, "x": 0.0, "thrust": old.thrust}
            content |= {"model": change.value, "model_override": old.override}
            whole = change.path.removesuffix(".model")
            read = _taken(BearingSeat, replace(change, value=content, path=whole))
            hidden |= {name: getattr(read, name) for name in ("model", "preloads", "sizes")}
            listed[k] = replace(change, value=read.bearing)
    sizes = hidden.get("sizes", old.sizes)
    for fills in (common.fills for common in COMMON[BearingSeat] if common.fills[-1] in sizes):
        size, before = sizes[fills[-1]], old.sizes.get(fills[-1])
        within = [each for each in listed if each.steps[: len(fills) - 1] == fills[:-1]]
        if within or size != before:
            held = [value for _, value, _ in reached(old, fills)]
            if (within and not held) or (size != before and held == [before]):
                sized.append(_Change(size, (within or listed)[0].path, fills))
        for k, each in enumerate(listed):
            if isinstance(each.value, Mapping) and fills[: len(each.steps)] == each.steps:
                value = _with_size(each.value, fills[len(each.steps) :], size)
                listed[k] = replace(each, value=value)
    return hidden, [*sized, *listed]


def _with_size(value: object, steps: Steps, size: float) -> object:
    """A mapping as files write it, with the size of a ring where it gives none itself."""
    if not isinstance(value, Mapping):
        return value
    if len(steps) == 1:
        return {steps[0]: size, **value}
    return {k: _with_size(v, steps[1:], size) if k == steps[0] else v for k, v in value.items()}


def _of_class(old: Any, change: _Change) -> _Change:
    """Replace a preload class of a set by the force that the models of its bearings list."""
    arrangement = old.arrangement if isinstance(old, Spindle) else None
    if arrangement is None or change.steps != OF_CLASS:
        return change
    seats = [seat for seat in old.seats if seat.name in arrangement.bearings]
    printed = [dict(zip(CLASSES, seat.preloads, strict=False)) for seat in seats]
    forces = {each.get(str(change.value)) for each in printed}
    force = forces.pop() if len(forces) == 1 else None
    if force is None:
        raise change.refused(
            f"the bearings of the set have no common force of a class {shown(change.value)}; "
            f"allowed: {', '.join(CLASSES)}, of models that print preloads, or change class_force"
        )
    return replace(change, value=force, steps=(*OF_CLASS[:-1], "class_force"))


def _require_kept(annotation: Any, result: Any, changes: Sequence[_Change]) -> None:
    """Raise if the ``result`` of all changes lacks one of them, since it follows from others."""
    if _value(annotation, result, changes) == result:
        return
    undone = (each for each in changes if _value(annotation, result, [each]) != result)
    raise next(undone, changes[0]).refused(
        "changes nothing: its value follows from other keys, as the sleeve of a set from its "
        "arrangement; change those"
    )


def _made(kind: Callable[..., Any], values: Mapping[str, Any], changes: Sequence[_Change]) -> Any:
    try:
        return kind(**values)
    except (InvalidInput, InvalidBearing) as error:
        paths = dict.fromkeys(change.path for change in changes)
        raise InvalidInput(f"{', '.join(paths)}: {error}") from None


def _begun(kinds: Sequence[type], changes: Sequence[_Change]) -> Any:
    """Create an absent value: the kind whose keys match best, other fields at their defaults."""
    keys = {change.steps[0] for change in changes}
    kind = max(kinds, key=lambda each: len(keys & {key for key, *_ in _ways(each)}))
    fields, groups = declared(kind), _by_field(kind, changes)
    missing = [".".join(f.keys) for f in fields if f.default is REQUIRED and f.name not in groups]
    if missing:
        raise changes[0].refused(
            f"is not given yet, and the part that it belongs to also needs {', '.join(missing)}: "
            "give these too"
        )
    with unchecked():
        usual = kind(**{f.name: None if f.default is REQUIRED else f.default for f in fields})
    return _fields(usual, changes)


def _of_items(old: Any, change: _Change) -> list[_Change]:
    """The change itself, or one for every item that shares the common value it leads to."""
    common = common_at(old, change.steps)
    if common is None:
        return [change]
    ways = ways_of_items(old, common, change.steps)
    if not ways:
        way = ".".join(
            filter(None, (_way_to(change), *common.fills, *change.steps[len(common.keys) :]))
        )
        raise change.refused(
            f"changes nothing: each of {common.fills[0]} has its own value here; change {way}"
        )
    return [replace(change, steps=way) for way in ways]


def _clamped(case: Case, field: Field, changes: Sequence[_Change]) -> Sequence[_Change]:
    """Put the change of the spindle that follows from another tool before changes within it."""
    of_tool = [change for change in changes if change.steps[0] == "tool"]
    whole = [change for change in changes if change.steps == ("spindle",)]
    if whole:  # a spindle given as a whole already contains its tool
        tool, spindle = None, _taken(Spindle | None, replace(whole[-1], steps=()))
        before, after = (each.references if each else () for each in (case.spindle, spindle))
        known = (*after, *(each for each in case.references if each not in before))
        changes = [replace(whole[-1], value=known, steps=("references",)), *changes]
        if case.tool and not of_tool and not isinstance(whole[-1].value, Spindle):
            of_tool = [replace(whole[-1], value=case.tool, steps=("tool",))]
    else:
        tool, spindle = case.tool, case.spindle
    if not of_tool:
        return [*([replace(whole[0], value=None, steps=("tool",))] if whole else []), *changes]
    if spindle is None:
        raise of_tool[0].refused("a tool needs a spindle: this case has none")
    rest = [change for change in changes if change not in (*of_tool, *whole)]
    new = _value(field.annotation, tool, [c.inside(1) for c in of_tool])
    further = any(change.steps[0] == "spindle" for change in rest)
    with unchecked() if further else nullcontext():  # checked with what else changes
        bare = _made(lambda: spindle.without_tool(tool) if tool else spindle, {}, of_tool)
        spindle = _made(lambda: bare.with_tool(new) if new else bare, {}, of_tool)
    first = {"tool": new, "spindle": spindle}
    return [*(replace(of_tool[0], value=v, steps=(key,)) for key, v in first.items()), *rest]


@cache
def _ways(kind: Any) -> dict[Steps, str]:
    """Fields of a description by the steps that lead to them."""
    fields = declared(kind)
    ways = {(field.name,): field.name for field in fields if not field.keys}
    return ways | {field.keys: field.name for field in fields if field.keys}


def _keys(kind: type) -> list[str]:
    """First keys of a description that files have, and those that paths may name besides."""
    fields = declared(kind)
    named = [field.name for field in fields if not field.keys and field.name in NO_KEYS]
    return [*(field.keys[0] for field in fields if field.keys), *named]


def _by_field(kind: type, changes: Iterable[_Change]) -> dict[str, list[_Change]]:
    """Group changes by the field they lead to."""
    return _grouped(changes, _ways(kind), partial(_no_field, kind))


def _no_field(kind: type, change: _Change) -> None:
    """Raise for a path that leads to no field."""
    first, ways = change.steps[0], _ways(kind)
    within = [way[1] for way in ways if len(way) > 1 and way[0] == first]
    if within and len(change.steps) == 1:
        inner = ", ".join(f"{change.path}.{key}" for key in within)
        raise change.refused(f"holds several values, each with a path of its own: change {inner}")
    if within:
        _require_known(change.inside(1), within, "key")
    key = next((".".join(way) for way, name in ways.items() if name == first), first)
    if key != first:
        raise change.refused(f"'{first}' is called '{key}' here, as in files")
    _require_known(change, _keys(kind), "key", deeper(kind, first))
    raise change.refused("does not exist here")


def _items(annotation: Any, old: tuple[Any, ...], changes: Sequence[_Change]) -> tuple[Any, ...]:
    ways = {(called_at(k, item),): k for k, item in enumerate(old, start=1)}
    what = "name" if hasattr(old[0], "name") else "number"
    refuse = partial(_require_known, known=[way[0] for way in ways], what=what)
    groups = _grouped(changes, ways, refuse, ways)
    member = parts_of(annotation, tuple)[0]
    return tuple(_value(member, item, groups.get(k, [])) for k, item in enumerate(old, start=1))


def _entries(annotation: Any, old: Mapping[Any, Any], changes: Sequence[_Change]) -> dict[Any, Any]:
    key, member = parts_of(annotation, Mapping)
    closed = names() if found_in(annotation, ByName) else _closed(key)
    ways = {(called(name),): name for name in [*old, *closed]}
    known = [way[0] for way in ways]
    if not closed and member is not Case:  # names of one's own, such as a further point
        steps = (change.steps[0] for change in changes)
        ways |= {(step,): step for step in steps if step != "*" and not suggestion(step, known)}
    refuse = partial(_require_known, known=known, what="key")
    groups = _grouped(changes, ways, refuse, [(called(name),) for name in old])
    matrix, new = found_in(annotation, Matrix), {}
    for name, group in groups.items():
        if matrix is not None:
            one = Annotated[float, matrix.quantity(*name)]
            member = one | tuple[one, ...]
        if found_in(annotation, ByName):
            member = analysis(name).spec
        new[name] = _value(member, old.get(name), group)
    return {**old, **new}


def _closed(key: Any) -> list[object]:
    """All keys that a mapping may have, if its declaration lists them."""
    if get_origin(key) is tuple:
        first, second = (_closed(part) for part in get_args(key))
        return [(row, column) for row in first for column in second]
    choice = found_in(key, Choice)
    return [] if choice is None else list(choice.allowed)


def _grouped(
    changes: Iterable[_Change],
    ways: Mapping[Any, K],
    refuse: Callable[[_Change], None],
    every: Iterable[Steps] | None = None,
) -> dict[K, list[_Change]]:
    """Group changes by what their first steps lead to, which are removed from them.

    ``every``: the ways that ``*`` stands for; ``refuse`` raises for a step that leads nowhere.
    """
    groups: dict[K, list[_Change]] = {}
    for change in changes:
        if change.steps[0] == "*" and every is not None:
            leads = [*every]
        else:
            leads = [way for way in (change.steps[:1], change.steps[:2]) if way in ways][:1]
            if not leads:
                refuse(change)
        for way in leads:
            groups.setdefault(ways[way], []).append(change.inside(len(way)))
    return groups


def _require_known(change: _Change, known: Iterable[str], what: str, inner: str = "") -> None:
    """Raise if the next step of a path is not ``known``; ``inner``: path on which it is."""
    step, names = change.steps[0], [*known]
    if step not in names:
        where = f" in '{way}'" if (way := _way_to(change)) else ""
        raise change.refused(no_such(step, names, what, where, inner))


def _way_to(change: _Change) -> str:
    """The part of the path up to the current value."""
    return change.path.removesuffix(".".join(change.steps)).rstrip(".")
