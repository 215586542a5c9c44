"""Changes as files spell them, as changes of fields: keys that are not stored, groups of keys,
values that several items share, and what another bearing model brings with it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import is_dataclass, replace
from typing import Any

from bearings.bearing import BallBearing
from bearings.kinds import KINDS, kind_class
from rotordyn.case.case import Case
from rotordyn.case.change import Change, taken, way_to, ways_of
from rotordyn.case.keys import COMMON, extra, keys_of
from rotordyn.case.node import Read, Shared
from rotordyn.case.varied import Steps, common_at, reached, ways_of_items, within_tool
from rotordyn.field import REQUIRED, Field, declared, parts_of, shown
from rotordyn.machine.assembly import unknown
from rotordyn.machine.bearing_set import CLASSES
from rotordyn.machine.flexible_rings import SIZES, RingBodies
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.units import shown as as_written

OF_CLASS = ("preload", "class")
# What a file gives whole of a spindle, beside which a tool has its own.
_WHOLE = (("masses",), ("joints",), ("shaft",), ("shaft", "start"), ("shaft", "sections"))
# Keys of files that change the bearing models they are beside, and the path of these.
OVERRIDES = {
    (Spindle, "bearing_override"): ("bearings", "*", "model"),
    (BearingSeat, "model_override"): ("model",),
}
OF_RING_AND_MAKER = [(key,) for key in ("name", "preloads", *SIZES)]  # stored beside the model
NOT_STORED = (
    *("title", "name", "note", "source", "sources", "bore_diameter", "outside_diameter", "width"),
    *("preloads", "reference", "at"),
)


def spelled(old: Any, change: Change) -> list[Change]:
    """The change as those of fields: keys that only files have, and keys given as one mapping."""
    steps, value = change.steps, change.value
    kind: Any = type(old)
    if (way := OVERRIDES.get((kind, steps[0]))) is not None:
        change = replace(change, steps=(*way, *steps[1:]))
        if steps[1:] or not isinstance(value, Mapping):
            return [change]
        return [replace(change, value=v, steps=(*way, str(k))) for k, v in value.items()]
    change = _with_shared(old, change)
    keys: list[Field] = [*keys_of(kind)]
    if steps[:1] not in ways_of(kind) and any(key.keys == steps[:1] for key in extra(kind)):
        return _beside(old, change)
    within = [key for key in keys if len(key.keys) > len(steps) and key.keys[: len(steps)] == steps]
    if not within or any(key.keys == steps for key in keys):
        return [change]
    value = {} if value is None else value
    if not isinstance(value, Mapping):
        names = dict.fromkeys(key.keys[len(steps)] for key in within)
        raise change.refused(
            f"wrong shape: given {as_written(value)}; allowed: a mapping (key: value) with "
            f"{', '.join(names)}"
        )
    whole = {key.keys: _default(old, key) for key in within}
    whole = {way: usual for way, usual in whole.items() if usual is not REQUIRED}
    whole |= _flat(change, value, steps, within)
    return [replace(change, value=v, steps=way) for way, v in whole.items()]


def _with_shared(old: Any, change: Change) -> Change:
    """A change that replaces items of a list, each with what the items share unless it gives its
    own, as in files."""
    given: Any = change.value
    several = isinstance(given, list)
    items = given if several else [given]
    if len(change.steps) > 2 or not all(isinstance(each, Mapping) for each in items):
        return change
    shared: dict[str, Any] = {}
    for common in COMMON.get(type(old), ()):
        listed, place, key = common.fills if len(common.fills) == 3 else ("", "", "")
        if place == "*" and listed == change.steps[0] and len(change.steps) == 2 - several:
            for way in ways_of_items(old, common, common.keys)[:1]:
                item = next(value for _, value, _ in reached(old, way[:2]))
                shared |= {k: v for k, v in _as_mapping(item).items() if k == key}
    full = [{**{k: Shared(v) for k, v in shared.items()}, **each} for each in items]
    return replace(change, value=full if several else full[0])


def _as_mapping(value: Any) -> Any:
    """A description as nested mappings of files, without the sizes that follow from a model."""
    if not is_dataclass(value):
        return Read(value)
    kind: Any = type(value)
    content: dict[str, Any] = {}
    for field in declared(kind):
        each = getattr(value, field.name)
        if field.keys and field.keys[-1] not in SIZES and each != field.default:
            *outer, last = field.keys
            inner = content
            for key in outer:
                inner = inner.setdefault(key, {})
            inner[last] = _as_mapping(each)
    return content


def _default(old: Any, key: Field) -> Any:
    """Value of a key that a mapping leaves out; REQUIRED if it stays as it is."""
    common = common_at(old, key.keys)
    if common is None:
        return key.default
    if not ways_of_items(old, common, key.keys):
        return REQUIRED
    way = (common.fills[-1], *key.keys[len(common.keys) :])
    kind: Any = common.kind
    return next(field.default for field in declared(kind) if field.keys == way)


def _flat(
    change: Change, value: Mapping[Any, Any], way: Steps, within: Sequence[Field]
) -> dict[Steps, Any]:
    """The entries of a mapping by the keys ``within`` which they are."""
    flat: dict[Steps, Any] = {}
    for name, each in value.items():
        inner, deep = (*way, str(name)), isinstance(each, Mapping)
        if any(key.keys == inner for key in within):
            flat[inner] = each
        elif deep and any(key.keys[: len(inner)] == inner for key in within):
            flat |= _flat(change, each, inner, within)
        else:
            names = [key.keys[len(way)] for key in within if key.keys[: len(way)] == way]
            raise change.refused(unknown_in(str(name), names), f".{name}")
    return flat


def unknown_in(name: str, names: Iterable[str], inner: str = "") -> str:
    from rotordyn.case.reading import unknown_key  # reads YAML, which vary seldom needs

    return unknown_key(name, [*dict.fromkeys(names)], "", inner)


def _beside(old: Any, change: Change) -> list[Change]:
    """No change by a key of files that is checked and not stored; others are refused."""
    key = change.steps[0]
    field = next(field for field in extra(type(old)) if field.keys == (key,))
    if key == "kind":
        if change.value == next(word for word in KINDS if kind_class(word) is type(old)):
            return []
        for why in unknown("kind of bearing", as_written(change.value), KINDS):
            raise change.refused(why)
    if key not in NOT_STORED:
        whole = way_to(change) or "the whole"
        raise change.refused(f"is read together with all that it is part of: give '{whole}' whole")
    member = parts_of(field.annotation, tuple) if change.steps[1:] else ()
    taken(member[0] if member else field.annotation, change)
    return []


def of_class(
    old: Spindle, seats: Sequence[BearingSeat], changes: Sequence[Change], inner: Sequence[Change]
) -> list[Change]:
    """``changes`` of the set of bearings with the force of its preload class that the models of
    ``seats`` list: of another class, or of the same one where ``inner`` changes have other models.
    """
    listed: list[Change] = []
    before = [seat.preloads for seat in old.seats]
    kept = all(change.steps and change.steps[0] != "preload" for change in changes)
    if kept and old.arrangement and old.arrangement.preload:
        held = old.arrangement.preload.maker_class
        if held and [seat.preloads for seat in seats] != before:
            changes = [*changes, replace(inner[0], value=held, steps=OF_CLASS)]
    for change in changes:
        if change.steps != OF_CLASS:
            listed.append(change)
            continue
        members = old.arrangement.bearings if old.arrangement else ()
        printed = [dict(zip(CLASSES, s.preloads, strict=False)) for s in seats if s.name in members]
        forces = {each.get(str(change.value)) for each in printed}
        force = forces.pop() if len(forces) == 1 else None
        if force is None:
            raise change.refused(
                f"the bearings of the set have no common force of a class {shown(change.value)}; "
                f"allowed: {', '.join(CLASSES)}, of models that print preloads, or change "
                "class_force"
            )
        listed += [change, replace(change, value=force, steps=("preload", "class_force"))]
    return listed


def of_items(old: Any, change: Change) -> list[Change]:
    """The change itself, or one for every item that shares the common value it leads to."""
    common = common_at(old, change.steps)
    if common is None:
        return [change]
    ways = ways_of_items(old, common, change.steps)
    if not ways:
        way = ".".join(
            filter(None, (way_to(change), *common.fills, *change.steps[len(common.keys) :]))
        )
        raise change.refused(
            f"changes nothing: each of {common.fills[0]} has its own value here; change {way}"
        )
    return [replace(change, steps=way) for way in ways]


def of_model(old: BearingSeat, changes: Sequence[Change]) -> tuple[dict[str, Any], list[Change]]:
    """What else another model gives to a bearing: values of fields, and the sizes of its rings to
    what is new within the bearing, or had those of the model before."""
    hidden: dict[str, Any] = {}
    sized, listed = [], [*changes]
    for k, change in enumerate(changes):
        if change.steps[:1] == ("model",) and change.steps[1:] in OF_RING_AND_MAKER:
            hidden |= _beside_model(change, hidden.get("sizes", old.sizes))
        if change.steps != ("model",) or change.value == old.bearing:
            continue
        if isinstance(change.value, BallBearing):
            hidden |= {"model": "", "preloads": ()}
        else:
            content = {"name": old.name, "x": 0.0, "thrust": old.thrust}
            content |= {"model": change.value, "model_override": old.override}
            whole = change.path.removesuffix(".model")
            read = taken(BearingSeat, replace(change, value=content, path=whole))
            hidden |= {name: getattr(read, name) for name in ("model", "preloads", "sizes")}
            listed[k] = replace(change, value=read.bearing)
    sizes = hidden.get("sizes", old.sizes)
    for fills in (common.fills for common in COMMON[BearingSeat] if common.fills[-1] in sizes):
        size, before = sizes[fills[-1]], old.sizes.get(fills[-1])
        within = [each for each in listed if each.steps[: len(fills) - 1] == fills[:-1]]
        if within or size != before:
            held = [value for _, value, _ in reached(old, fills)]
            if (within and not held) or (size != before and held == [before]):
                sized.append(Change(size, (within or listed)[0].path, fills))
        for k, each in enumerate(listed):
            if isinstance(each.value, Mapping) and fills[: len(each.steps)] == each.steps:
                value = _with_size(each.value, fills[len(each.steps) :], size)
                listed[k] = replace(each, value=value)
    return hidden, [*sized, *listed]


def _beside_model(change: Change, sizes: Mapping[str, float]) -> dict[str, Any]:
    """What a key of a bearing model changes of the bearing on the shaft; ``sizes`` of its rings."""
    key = change.steps[1]
    field = next(field for field in extra(BallBearing) if field.keys == (key,))
    value = taken(field.annotation, change)
    if key not in SIZES:
        return {"model" if key == "name" else key: value}
    kept = {each: size for each, size in sizes.items() if each != key}
    return {"sizes": kept if value is None else {**kept, key: value}}


def with_sizes(old: Any, change: Change) -> Change:
    """A mapping for flexible rings, with the sizes of the rings before where it gives none."""
    if not (isinstance(old, RingBodies) and isinstance(change.value, Mapping)):
        return change
    sizes = {size: getattr(old, size) for size in SIZES}
    held = {size: Read(each) for size, each in sizes.items() if each is not None}
    return replace(change, value={**held, **change.value})


def _with_size(value: object, steps: Steps, size: float) -> object:
    """A mapping as files write it, with the size of a ring where it gives none itself."""
    if not isinstance(value, Mapping):
        return value
    if len(steps) == 1:
        return {steps[0]: size, **value}
    return {k: _with_size(v, steps[1:], size) if k == steps[0] else v for k, v in value.items()}


def in_the_nose(case: Case, change: Change) -> list[Change]:
    """The change, with or as that of the tool where a path within the spindle means what is of it;
    stations of all points are those of the spindle, as a tool counts its own from the nose."""
    steps = within_tool(change.steps[1:]) if change.steps[0] == "spindle" else ()
    if case.tool is None or case.spindle is None:
        return [change]
    if change.steps == ("spindle", "points", "*"):
        names = [name for name in case.spindle.points if name not in case.tool.points]
        return [replace(change, steps=("spindle", "points", name)) for name in names]
    items = getattr(case.tool, steps[0]) if steps else ()
    inside = replace(change, steps=("tool", *steps))
    if steps[1:2] in [(item.name,) for item in items]:
        return [inside]
    return [change, inside] if items and steps[1] == "*" else [change]


def beside_tool(spindle: Spindle, tool: Tool, change: Change) -> list[Change]:
    """The change of a whole list, of the shaft or of all points of a ``spindle``, which in files
    has no ``tool``, as those of the spindle with the tool in its nose."""
    steps, value = change.steps[1:], change.value
    if change.steps[0] == "spindle" and steps == ("points",) and isinstance(value, Mapping):
        nose = spindle.shaft.start - tool.front(0.0)
        return [replace(change, value={**tool.placed(nose), **value})]
    if change.steps[0] != "spindle" or steps not in _WHOLE:
        return [change]
    holder = Shaft if len(steps) == 2 else Spindle
    annotation = next(f.annotation for f in declared(holder) if f.keys == steps[-1:])
    old = spindle.shaft if holder is Shaft else spindle
    full = _with_shared(old, replace(change, steps=steps[-1:]))
    whole = taken(annotation, replace(full, steps=()))
    if steps[0] == "shaft":
        return _before_nose(spindle, tool, change, whole)
    added = getattr(tool, steps[0])
    return [change if _holds(whole, added) else replace(change, value=(*whole, *added))]


def _before_nose(spindle: Spindle, tool: Tool, change: Change, whole: Any) -> list[Change]:
    """The change to ``whole`` of the shaft, its start or its sections, behind those of the tool;
    another start moves the points of the tool."""
    sections, last = tool.sections, change.steps[-1]
    if last != "start" and _holds(whole.sections if last == "shaft" else whole, sections):
        return [change]
    if last == "sections":
        front = spindle.shaft.sections[: len(sections)]
        return [replace(change, value=(*front, *whole))]
    nose = whole.start if last == "shaft" else whole
    new = whole.preceded_by(sections) if last == "shaft" else tool.front(nose)
    points = tool.placed(nose).items()
    moved = [replace(change, value=x, steps=("spindle", "points", name)) for name, x in points]
    return [replace(change, value=new), *moved]


def _holds(items: Iterable[Any], added: Iterable[Any]) -> bool:
    """Whether items given as a whole include some of a tool, as those of a spindle in Python do."""
    names = {item.name for item in added}
    return any(item.name and item.name in names for item in items)
