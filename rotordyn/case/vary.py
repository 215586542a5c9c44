"""Change values at dotted paths of a frozen description (``"spindle.bearings.a.x"``)."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import is_dataclass, replace
from functools import partial
from typing import Annotated, Any, TypeVar, get_args, get_origin

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from rotordyn.analyses.registry import analysis, names
from rotordyn.case.case import ByName, Case
from rotordyn.case.consequences import (
    also_of_tool,
    beside_tool,
    following,
    with_class_force,
    with_model,
    with_ring_sizes,
)
from rotordyn.case.deeper import deeper
from rotordyn.case.keys import keys_of
from rotordyn.case.paths import (
    OF_RANGE,
    Change,
    Steps,
    from_top,
    items_in_path,
    key_in_path,
    no_root,
    no_such,
    of_range,
    order_of,
    taken,
    too_far,
    ways_of,
)
from rotordyn.case.spelled import of_each_item, spelled, unknown_in
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import REQUIRED, Field, declared, found_in, kinds_of, parts_of, shown
from rotordyn.machine.bearing_set import BearingSet
from rotordyn.machine.matrix import Matrix
from rotordyn.machine.reference import Reference, values_of
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.quantity import Choice, suggestion

D = TypeVar("D")
K = TypeVar("K")
LONGEST = 1000  # characters of a path
WHOLE = (Spindle, BallBearing, Tool)  # cannot begin with defaults
NO_KEYS = ("tool", "variants")  # fields of a case that paths may name though files have no such key


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
    case = description if isinstance(description, Case) else None
    listed = [_change(case, path, value) for path, value in changes.items()]
    last = {each.steps: each for each in listed}
    for change in listed:
        if last[change.steps] is not change:
            room = change.steps[0]
            raise change.refused(f"given twice, with and without '{room}.' before it")
    listed.sort(key=lambda each: order_of(each.steps))
    if case is not None and case.variants:
        listed = [*_of_variants(listed), *listed]
    return _fields(description, listed)


def _of_variants(changes: Sequence[Change]) -> list[Change]:
    """Repeat the changes of a case for every variant."""
    inner = [change for change in changes if change.steps[0] not in ("variants", "name", "title")]
    return [replace(change, steps=("variants", "*", *change.steps)) for change in inner]


def _change(case: Case | None, path: object, value: object) -> Change:
    """Check the form of a path; complete one that begins within the machine of a case."""
    if not isinstance(path, str) or not all(path.split(".")) or not path.isprintable():
        raise InvalidInput(f"not a dotted path: given {shown(path)}; such as 'conditions.rotor'")
    if len(path) > LONGEST:
        raise InvalidInput(f"{path[:40]}...: a path longer than {LONGEST} characters")
    whole = path if case is None else from_top(path, spindle=case.bearing is None)
    change = Change(value, path, tuple(whole.split(".")))
    if case is not None and whole != path:
        machine: Any = Spindle if case.bearing is None else type(case.bearing)
        if why := no_root(change.steps[1], machine):
            raise change.refused(why)
    return change


def _signed(case: Any) -> Any:
    """Give a changed case a digest of its own, as its files no longer define it."""
    text = f"{case.digest} {replace(case, files=(), digest='')!r}"
    return replace(case, digest=hashlib.sha256(text.encode()).hexdigest())


def _value(annotation: Any, old: Any, changes: Sequence[Change]) -> Any:
    """Apply ``changes`` to ``old`` in their order."""
    for index, change in enumerate(changes):
        if not change.steps:
            whole = taken(annotation, with_ring_sizes(old, change))
            return _value(annotation, whole, changes[index + 1 :])
    if not changes:
        return old
    kinds = kinds_of(annotation) if old is None else []
    if kinds and kinds[0] not in WHOLE:
        return _created(kinds, changes)
    if is_dataclass(old):
        return _fields(old, changes)
    if isinstance(old, Mapping):
        return _entries(annotation, old, changes)
    if isinstance(old, tuple) and old:
        return _items(annotation, old, changes)
    raise changes[0].refused(too_far(changes[0].way))


def _fields(old: Any, changes: Sequence[Change]) -> Any:
    fields = {field.name: field for field in declared(old.__class__)}
    if isinstance(old, Case):
        changes = _with_tool(old, fields["tool"], changes)
    beside: dict[str, Any] = {}
    if isinstance(old, BearingSeat):
        beside, changes = with_model(old, changes)
    ways = [
        way for each in changes for field in spelled(old, each) for way in of_each_item(old, field)
    ]
    groups = _by_field(old.__class__, ways)
    annotations = {name: field.annotation for name, field in fields.items()}
    if isinstance(old, Reference):
        annotations["values"] = values_of(old.quantity)
    if isinstance(old, Spindle) and (old.arrangement or "arrangement" in groups):
        inner = groups.get("seats", [])
        with unchecked():
            seats = _value(annotations["seats"], old.seats, inner)
        if listed := with_class_force(old, seats, groups.get("arrangement", []), inner):
            groups["arrangement"] = listed
    new = beside | {
        name: _value(annotations[name], getattr(old, name), group) for name, group in groups.items()
    }
    if isinstance(arrangement := new.get("arrangement"), BearingSet):
        turned = arrangement.turned(old.seats)
        new["seats"] = _value(annotations["seats"], turned, groups.setdefault("seats", []))
    new |= following(old, new)
    made = _made(partial(replace, old, **new), changes)
    for name in groups:
        result = getattr(made, name)
        if result is not new[name] and result != new[name]:
            _require_kept(annotations[name], result, groups[name])
    return made


def _require_kept(annotation: Any, result: Any, changes: Sequence[Change]) -> None:
    """Raise if the ``result`` of all changes lacks one of them, since it follows from others."""
    if _value(annotation, result, changes) == result:
        return
    undone = (each for each in changes if _value(annotation, result, [each]) != result)
    raise next(undone, changes[0]).refused(
        "changes nothing: its value follows from other keys, as the sleeve of a set from its "
        "arrangement; change those"
    )


def _made(make: Callable[[], Any], changes: Sequence[Change]) -> Any:
    """Make a description; contradictions are those of the ``changes``."""
    try:
        return make()
    except (InvalidInput, InvalidBearing) as error:
        paths = dict.fromkeys(change.path for change in changes)
        raise InvalidInput(f"{', '.join(paths)}: {error}") from None


def _created(kinds: Sequence[type], changes: Sequence[Change]) -> Any:
    """Create an absent value: the kind whose keys match best, other fields at their defaults."""
    keys = {change.steps[0] for change in changes}
    kind = max(kinds, key=lambda each: len(keys & {key for key, *_ in ways_of(each)}))
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


def _with_tool(case: Case, field: Field, changes: Sequence[Change]) -> Sequence[Change]:
    """Put the change of the spindle that follows from another tool before changes within it."""
    changes = [inner for change in changes for inner in also_of_tool(case, change)]
    of_tool = [change for change in changes if change.steps[0] == "tool"]
    whole = [change for change in changes if change.steps == ("spindle",)]
    if whole:  # a spindle given as a whole already contains its tool
        tool, spindle = None, taken(Spindle | None, replace(whole[-1], steps=()))
        if case.tool and not of_tool and not isinstance(whole[-1].value, Spindle):
            of_tool = [replace(whole[-1], value=case.tool, steps=("tool",))]
    else:
        tool, spindle = case.tool, case.spindle
    if not of_tool:
        if tool and spindle:
            changes = [x for each in changes for x in beside_tool(spindle, tool, each)]
        return [*([replace(whole[0], value=None, steps=("tool",))] if whole else []), *changes]
    if spindle is None:
        raise of_tool[0].refused("a tool needs a spindle: this case has none")
    rest = [change for change in changes if change not in (*of_tool, *whole)]
    new = _value(field.annotation, tool, [c.inside(1) for c in of_tool])
    further = any(change.steps[0] == "spindle" for change in rest)
    with unchecked() if further else nullcontext():  # checked with what else changes
        bare = _made(lambda: spindle.without_tool(tool) if tool else spindle, of_tool)
        spindle = _made(lambda: bare.with_tool(new) if new else bare, of_tool)
    if new:
        rest = [x for each in rest for x in beside_tool(spindle, new, each)]
    first = {"tool": new, "spindle": spindle}
    return [*(replace(of_tool[0], value=v, steps=(key,)) for key, v in first.items()), *rest]


def _by_field(kind: type, changes: Iterable[Change]) -> dict[str, list[Change]]:
    """Group changes by the field they lead to."""
    return _grouped(changes, ways_of(kind), partial(_no_field, kind))


def _no_field(kind: type, change: Change) -> None:
    """Raise for a path that leads to no field."""
    first, ways = change.steps[0], ways_of(kind)
    known = [key.keys for key in keys_of(kind) if key.keys]
    within = [way[1] for way in known if len(way) > 1 and way[0] == first]
    if within:
        raise change.refused(unknown_in(change.steps[1], within))
    key = next((".".join(way) for way, name in ways.items() if name == first), first)
    if key != first:
        raise change.refused(f"'{first}' is called '{key}' here, as in files")
    names = [way[0] for way in known] + [*NO_KEYS] * (kind is Case)
    raise change.refused(unknown_in(first, names, deeper(kind, first)))


def _items(annotation: Any, old: tuple[Any, ...], changes: Sequence[Change]) -> tuple[Any, ...]:
    ways = {(name,): k for k, name in enumerate(items_in_path(annotation, old), start=1)}
    what = "name" if hasattr(old[0], "name") else "number"
    if what == "number" and changes and changes[0].steps[0] in OF_RANGE:
        raise changes[0].refused(of_range(changes[0].way))
    refuse = partial(_require_known, known=[way[0] for way in ways], what=what)
    groups = _grouped(changes, ways, refuse, ways)
    member = parts_of(annotation, tuple)[0]
    return tuple(_value(member, item, groups.get(k, [])) for k, item in enumerate(old, start=1))


def _entries(annotation: Any, old: Mapping[Any, Any], changes: Sequence[Change]) -> dict[Any, Any]:
    by_name, matrix = found_in(annotation, ByName), found_in(annotation, Matrix)
    key, member = parts_of(annotation, Mapping)
    closed = names() if by_name else _all_keys(key)
    ways = {(key_in_path(name),): name for name in [*old, *closed]}
    known = [way[0] for way in ways]
    if not closed and member is not Case:  # names of one's own, such as a further point
        steps = (change.steps[0] for change in changes)
        ways |= {(step,): step for step in steps if step != "*" and not suggestion(step, known)}
    refuse = partial(_require_known, known=known, what="key")
    groups = _grouped(changes, ways, refuse, [(key_in_path(name),) for name in old])
    new, removed = dict[Any, Any](), list[Any]()
    for name, given in groups.items():
        group, last = given, given[-1]
        if matrix is not None:
            if last.removes:  # as if left out, as in files
                removed.append(name)
                continue
            one = Annotated[float, matrix.quantity(*name)]
            several = last.steps or isinstance(last.value, list | tuple)
            member = one | tuple[one, ...] if several else one
        elif by_name:  # nothing stands for the defaults, as in files
            member = analysis(name).spec
            group = [replace(each, value={}) if each.removes else each for each in given]
        new[name] = _value(member, old.get(name), group)
    return {name: each for name, each in {**old, **new}.items() if name not in removed}


def _all_keys(key: Any) -> list[object]:
    """All keys that a mapping may have, if its declaration lists them."""
    if get_origin(key) is tuple:
        first, second = (_all_keys(part) for part in get_args(key))
        return [(row, column) for row in first for column in second]
    choice = found_in(key, Choice)
    return [] if choice is None else list(choice.allowed)


def _grouped(
    changes: Iterable[Change],
    ways: Mapping[Any, K],
    refuse: Callable[[Change], None],
    every: Iterable[Steps] | None = None,
) -> dict[K, list[Change]]:
    """Group changes by what their first steps lead to, which are removed from them.

    ``every``: the ways that ``*`` stands for; ``refuse`` raises for a step that leads nowhere.
    """
    groups: dict[K, list[Change]] = {}
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


def _require_known(change: Change, known: Iterable[str], what: str) -> None:
    """Raise if the next step of a path is not ``known``."""
    if (step := change.steps[0]) not in (names := [*known]):
        where = f" in '{change.way}'" if change.way else ""
        raise change.refused(no_such(step, names, what, where))
