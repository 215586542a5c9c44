"""What a change brings with it, as in files: another bearing model its ring sizes and preloads, a
preload class its force, a part of the spindle that of the tool in its nose."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from bearings.bearing import BallBearing
from rotordyn.case.case import Case
from rotordyn.case.keys import COMMON, extra
from rotordyn.case.node import Read
from rotordyn.case.paths import Change, Steps, reached, taken, within_tool
from rotordyn.case.spelled import with_shared
from rotordyn.field import declared, shown
from rotordyn.machine.bearing_set import CLASSES, SetPreload
from rotordyn.machine.flexible_rings import SIZES, RingBodies
from rotordyn.machine.reference import Reference
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.scene.conditions import HYPOTHESES, Conditions

OF_CLASS = ("preload", "class")
# What a file gives whole of a spindle, beside which a tool has its own.
_WHOLE = (("masses",), ("joints",), ("shaft",), ("shaft", "start"), ("shaft", "sections"))
OF_RING_AND_MAKER = [(key,) for key in ("name", "preloads", *SIZES)]  # stored beside the model


def following(old: Any, new: Mapping[str, Any]) -> dict[str, Any]:
    """Values of fields that follow from those of other fields, as in files."""
    if isinstance(old, Conditions):
        return {"stated": (*old.stated, *(key for key in HYPOTHESES if key in new))}
    if isinstance(old, SetPreload) and "class_force" in new and "maker_class" not in new:
        return {"maker_class": None}
    if isinstance(old, Reference) and len(speeds := new.get("speeds", ())) == 1:
        return {"speeds": speeds * len(new.get("values", old.values))}
    if isinstance(old, Case) and "spindle" in new and "references" not in new:
        before, after = (of.references if of else () for of in (old.spindle, new["spindle"]))
        kept = (each for each in old.references if each not in before)
        return {} if before == after else {"references": (*after, *kept)}
    return {}


def with_class_force(
    old: Spindle, seats: Sequence[BearingSeat], changes: Sequence[Change], inner: Sequence[Change]
) -> list[Change]:
    """``changes`` of the set of bearings with the force of its preload class that the models of
    ``seats`` list: of another class, or of the same one where ``inner`` changes have other models.
    """
    preload = old.arrangement.preload if old.arrangement else None
    given = any(not change.steps or change.steps[0] == "preload" for change in changes)
    other = [seat.preloads for seat in seats] != [seat.preloads for seat in old.seats]
    if preload and preload.maker_class and other and not given:
        changes = [*changes, replace(inner[0], value=preload.maker_class, steps=OF_CLASS)]
    listed: list[Change] = []
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


def with_model(old: BearingSeat, changes: Sequence[Change]) -> tuple[dict[str, Any], list[Change]]:
    """What another model gives to a bearing beside itself: values of fields without keys, and
    ``changes`` with the sizes of its rings."""
    beside: dict[str, Any] = {}
    listed = [*changes]
    for k, change in enumerate(changes):
        if change.steps[:1] == ("model",) and change.steps[1:] in OF_RING_AND_MAKER:
            beside |= _of_seat(change, beside.get("sizes", old.sizes))
        if change.steps != ("model",) or change.value == old.bearing:
            continue
        if isinstance(change.value, BallBearing):
            beside |= {"model": "", "preloads": ()}
        else:  # read as in a file, for what the file of the model has besides
            content = {"name": old.name, "x": 0.0, "thrust": old.thrust}
            content |= {"model": change.value, "model_override": old.override}
            whole = change.path.removesuffix(".model")
            read = taken(BearingSeat, replace(change, value=content, path=whole))
            beside |= {name: getattr(read, name) for name in ("model", "preloads", "sizes")}
            listed[k] = replace(change, value=read.bearing)
    return beside, _with_sizes(old, beside.get("sizes", old.sizes), listed)


def _with_sizes(
    old: BearingSeat, sizes: Mapping[str, float], changes: list[Change]
) -> list[Change]:
    """``changes`` with the ``sizes`` of the rings for what is new in the bearing (fits, growth,
    flexible rings), and for what had those of the model before."""
    added, listed = list[Change](), changes
    for fills in (common.fills for common in COMMON[BearingSeat] if common.fills[-1] in sizes):
        size, before = sizes[fills[-1]], old.sizes.get(fills[-1])
        within = [each for each in listed if each.steps[: len(fills) - 1] == fills[:-1]]
        if within or size != before:
            held = [value for _, value, _ in reached(old, fills)]
            if (within and not held) or (size != before and held == [before]):
                added.append(Change(size, (within or listed)[0].path, fills))
        listed = [
            replace(each, value=_sized(each.value, fills[len(each.steps) :], size))
            if isinstance(each.value, Mapping) and fills[: len(each.steps)] == each.steps
            else each
            for each in listed
        ]
    return [*added, *listed]


def _of_seat(change: Change, sizes: Mapping[str, float]) -> dict[str, Any]:
    """What a key of a bearing model changes of the bearing on the shaft; ``sizes`` of its rings."""
    key = change.steps[1]
    field = next(field for field in extra(BallBearing) if field.keys == (key,))
    value = taken(field.annotation, change)
    if key not in SIZES:
        return {"model" if key == "name" else key: value}
    kept = {each: size for each, size in sizes.items() if each != key}
    return {"sizes": kept if value is None else {**kept, key: value}}


def with_ring_sizes(old: Any, change: Change) -> Change:
    """A mapping for flexible rings, with the sizes of the rings before where it gives none."""
    if not (isinstance(old, RingBodies) and isinstance(change.value, Mapping)):
        return change
    sizes = {size: getattr(old, size) for size in SIZES}
    held = {size: Read(each) for size, each in sizes.items() if each is not None}
    return replace(change, value={**held, **change.value})


def _sized(value: object, steps: Steps, size: float) -> object:
    """A mapping as files write it, with the size of a ring where it gives none itself."""
    if not isinstance(value, Mapping):
        return value
    if len(steps) == 1:
        return {steps[0]: size, **value}
    return {k: _sized(v, steps[1:], size) if k == steps[0] else v for k, v in value.items()}


def also_of_tool(case: Case, change: Change) -> list[Change]:
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
    full = with_shared(old, replace(change, steps=steps[-1:]))
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
