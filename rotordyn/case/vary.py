"""Change values at dotted paths of a frozen description (``"spindle.bearings.a.x"``)."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, is_dataclass, replace
from functools import partial
from typing import Annotated, Any, TypeVar, get_args, get_origin

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from rotordyn.analyses.registry import analysis, names
from rotordyn.case.arranged import CLASSES
from rotordyn.case.case import ByName, Case
from rotordyn.case.deeper import deeper
from rotordyn.case.keys import fields_of
from rotordyn.case.named_models import MODELS as FOLDERS
from rotordyn.case.varied import called, called_at, common_at, ways_of_items
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import (
    REQUIRED,
    Field,
    Refused,
    accept,
    declared,
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

D = TypeVar("D")
LONGEST = 1000  # characters of a path
MODELS = (Spindle, BallBearing, Tool)  # can only be given as a whole
OF_CLASS = ("arrangement", "preload", "class")
NO_KEYS = ("tool", "variants")  # fields of a case that paths may name though files have no such key


@dataclass(frozen=True, slots=True)
class _Change:
    """A new value, the whole path to it as given, and the remaining ``steps`` of the path."""

    value: object
    path: str
    steps: tuple[str, ...]

    def refused(self, why: str, place: str = "") -> InvalidInput:
        return InvalidInput(f"{self.path}{place}: {why}")


def vary(description: D, changes: Mapping[str, object]) -> D:
    """``description`` with other values at dotted paths; the description itself stays as it is.

    A path begins at the top of a case: it names keys, items of a list by their ``name`` or, where
    they have none, by their place from 1 (``spindle.damping.rotor.1``), entries of a mapping by
    their key, further points by a name that is like none there is; ``*`` stands for every item or
    entry.
    What a file gives once for all bearings (``spindle.fits``) goes to those that give none
    themselves; what is absent (``conditions.temperatures``) begins with its defaults; ``tool`` is
    what is in the nose.
    Values are in SI units, or text with a unit (``"8 N/um"``) where the field has a dimension, and
    replace what is there. All changes are made together: only the outcome must be possible; what
    is within something that is replaced, and one item of all, have their own values. What
    changes a case changes its variants too, unless the path begins with ``variants``.

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
    listed.sort(key=lambda each: (len(each.steps), -each.steps.count("*")))
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
    if kinds and kinds[0] not in MODELS:
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


def _taken(annotation: Any, change: _Change) -> Any:
    try:
        return accept(annotation, change.value)
    except Refused as refusal:
        folder = next((FOLDERS[k] for k in kinds_of(annotation) if k in FOLDERS), "")
        named = folder and isinstance(change.value, str)
        hint = f", such as rotordyn.model('{folder}', {shown(change.value)})" if named else ""
        raise change.refused(f"{refusal.why}{hint}", refusal.place) from None


def _fields(old: Any, changes: Sequence[_Change]) -> Any:
    fields = {field.name: field for field in fields_of(old.__class__)}
    if isinstance(old, Case):
        changes = _clamped(old, fields["tool"], changes)
    ways = [way for each in changes for way in _ways(old, _of_class(old, each))]
    groups = _by_field([*fields.values()], ways, old.__class__)
    if isinstance(old, BearingSeat):
        for name in ("fits", "flexible_rings"):
            if getattr(old, name) is None and name in groups:
                given = replace(groups[name][0], steps=())
                sized = [replace(given, value=v, steps=(key,)) for key, v in old.sizes.items()]
                groups[name] = [*sized, *groups[name]]
    new = {
        name: _value(fields[name].annotation, getattr(old, name), group)
        for name, group in groups.items()
    }
    if isinstance(old, BearingSeat):
        whole = [change.value for change in groups.get("bearing", ()) if not change.steps]
        if any(each != old.bearing for each in whole):
            new |= {"model": "", "preloads": ()}  # of the previous bearing
    if isinstance(arrangement := new.get("arrangement"), BearingSet):
        turned = arrangement.turned(old.seats)
        new["seats"] = _value(fields["seats"].annotation, turned, groups.setdefault("seats", []))
    made = _made(partial(replace, old), new, changes)
    for name, value in new.items():
        result = getattr(made, name)
        if result is not value and result != value:
            _require_kept(fields[name].annotation, result, groups[name])
    return made


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
    by_kind = {kind: {f.keys[0]: f for f in declared(kind) if f.keys} for kind in kinds}
    kind = max(by_kind, key=lambda each: len(keys & by_kind[each].keys()))
    fields = declared(kind)
    groups = _by_field(fields, changes, kind)
    missing = [".".join(f.keys) for f in fields if f.default is REQUIRED and f.name not in groups]
    if missing:
        raise changes[0].refused(
            f"is not given yet, and the part that it belongs to also needs {', '.join(missing)}: "
            "give these too"
        )
    new = {
        f.name: _value(f.annotation, None if f.default is REQUIRED else f.default, groups[f.name])
        for f in fields
        if f.name in groups
    }
    return _made(kind, new, changes)


def _by_field(
    fields: Sequence[Field], changes: Iterable[_Change], kind: type
) -> dict[str, list[_Change]]:
    """Group changes by the field they lead to; its keys are removed from their steps."""
    groups: dict[str, list[_Change]] = {}
    for change in changes:
        field, rest = _field(fields, change, kind)
        groups.setdefault(field.name, []).append(rest)
    return groups


def _ways(old: Any, change: _Change) -> list[_Change]:
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
        tool, spindle = None, _taken(Spindle, replace(whole[-1], steps=()))
    else:
        tool, spindle = case.tool, case.spindle
    if not of_tool:
        return [*([replace(whole[0], value=None, steps=("tool",))] if whole else []), *changes]
    if spindle is None:
        raise of_tool[0].refused("a tool needs a spindle: this case has none")
    rest = [change for change in changes if change not in (*of_tool, *whole)]
    new = _value(field.annotation, tool, [replace(c, steps=c.steps[1:]) for c in of_tool])
    further = any(change.steps[0] == "spindle" for change in rest)
    with unchecked() if further else nullcontext():  # checked with what else changes
        bare = _made(lambda: spindle.without_tool(tool) if tool else spindle, {}, of_tool)
        spindle = _made(lambda: bare.with_tool(new) if new else bare, {}, of_tool)
    first = {"tool": new, "spindle": spindle}
    return [*(replace(of_tool[0], value=v, steps=(key,)) for key, v in first.items()), *rest]


def _field(fields: Sequence[Field], change: _Change, kind: type) -> tuple[Field, _Change]:
    """The field to which the first steps of a path lead, and the change with the remaining ones."""
    ways: dict[tuple[str, ...], Field] = {(f.name,): f for f in fields if not f.keys}
    ways |= {field.keys: field for field in fields if field.keys}
    for way, field in ways.items():
        if change.steps[: len(way)] == way:
            return field, replace(change, steps=change.steps[len(way) :])
    within = [way for way in ways if len(way) > 1 and way[0] == change.steps[0]]
    if within:
        change = replace(change, steps=change.steps[1:])
        if not change.steps:
            inner = ", ".join(f"{change.path}.{way[1]}" for way in within)
            raise change.refused(
                f"holds several values, each with a path of its own: change {inner}"
            )
        _known(change, change.steps[0], [way[1] for way in within], "key")
    called = {field.name: way for way, field in ways.items()}
    if (key := called.get(change.steps[0])) is not None:
        raise change.refused(f"'{change.steps[0]}' is called '{'.'.join(key)}' here, as in files")
    inner = deeper(kind, change.steps[0])
    named = [way[0] for way, field in ways.items() if field.keys]
    named += [field.name for field in fields if not field.keys and field.name in NO_KEYS]
    _known(change, change.steps[0], named, "key", inner)
    raise change.refused("does not exist here")


def _items(annotation: Any, old: tuple[Any, ...], changes: Sequence[_Change]) -> tuple[Any, ...]:
    names = [called_at(k, item) for k, item in enumerate(old, start=1)]
    groups = _grouped(changes, names, "name" if hasattr(old[0], "name") else "number")
    member = parts_of(annotation, tuple)[0]
    pairs = zip(names, old, strict=True)
    return tuple(_value(member, item, groups.get(name, [])) for name, item in pairs)


def _entries(annotation: Any, old: Mapping[Any, Any], changes: Sequence[_Change]) -> dict[Any, Any]:
    key, member = parts_of(annotation, Mapping)
    closed = names() if found_in(annotation, ByName) else _closed(key)
    keys = {called(name): name for name in [*old, *closed]}
    if not closed and member is not Case:  # names of one's own, such as a further point
        steps = (change.steps[0] for change in changes)
        keys |= {step: step for step in steps if step != "*" and not suggestion(step, keys)}
    groups = _grouped(changes, [called(name) for name in old], "key", list(keys))
    matrix, new = found_in(annotation, Matrix), {}
    for text, group in groups.items():
        name = keys[text]
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
    changes: Sequence[_Change], present: list[str], what: str, known: list[str] | None = None
) -> dict[str, list[_Change]]:
    """Group changes by their first step, which is removed from them."""
    groups: dict[str, list[_Change]] = {}
    for change in changes:
        step, rest = change.steps[0], replace(change, steps=change.steps[1:])
        if step != "*":
            _known(change, step, known or present, what)
        for name in present if step == "*" else [step]:
            groups.setdefault(name, []).append(rest)
    return groups


def _known(change: _Change, step: str, known: Iterable[str], what: str, inner: str = "") -> None:
    names = [*dict.fromkeys(name for name in known if name)]
    if step in names:
        return
    listed = ", ".join(names[:12]) + (", …" if len(names) > 12 else "")
    where = f" in '{_way_to(change)}'" if len(change.steps) < change.path.count(".") + 1 else ""
    if what == "number":
        raise change.refused(f"unknown number '{step}'{where}; allowed: from 1 to {len(names)}")
    hint = f" (did you mean {inner}?)" if inner else suggestion(step, names)
    allowed = f"{listed or 'none, it is empty'}{hint}"
    raise change.refused(f"unknown {what} '{step}'{where}; allowed: {allowed}")


def _way_to(change: _Change) -> str:
    """The part of the path up to the current value."""
    return change.path.removesuffix(".".join(change.steps)).rstrip(".")
