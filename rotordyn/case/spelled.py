"""Changes as files spell them, as changes of fields: keys that are not stored, groups of keys, and
values that several items share."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import is_dataclass, replace
from typing import Any

from bearings.kinds import KINDS, kind_class
from rotordyn.case.keys import COMMON, extra, keys_of
from rotordyn.case.node import Read, Shared
from rotordyn.case.paths import (
    Change,
    Steps,
    common_at,
    reached,
    taken,
    ways_of,
    ways_of_items,
)
from rotordyn.field import REQUIRED, Field, declared, parts_of
from rotordyn.machine.assembly import unknown
from rotordyn.machine.flexible_rings import SIZES
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.units import shown

# Keys of files that change the bearing models they are beside, and the path of these.
OVERRIDES = {
    (Spindle, "bearing_override"): ("bearings", "*", "model"),
    (BearingSeat, "model_override"): ("model",),
}
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
    change = with_shared(old, change)
    keys: list[Field] = [*keys_of(kind)]
    beside = next((key for key in extra(kind) if key.keys == steps[:1]), None)
    if beside is not None and steps[:1] not in ways_of(kind):
        return _beside(beside, kind, change)
    within = [key for key in keys if len(key.keys) > len(steps) and key.keys[: len(steps)] == steps]
    if not within or any(key.keys == steps for key in keys):
        return [change]
    value = {} if value is None else value
    if not isinstance(value, Mapping):
        names = dict.fromkeys(key.keys[len(steps)] for key in within)
        raise change.refused(
            f"wrong shape: given {shown(value)}; allowed: a mapping (key: value) with "
            f"{', '.join(names)}"
        )
    whole = {key.keys: _default(old, key) for key in within}
    whole = {way: usual for way, usual in whole.items() if usual is not REQUIRED}
    whole |= _flat(change, value, steps, within)
    return [replace(change, value=v, steps=way) for way, v in whole.items()]


def with_shared(old: Any, change: Change) -> Change:
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


def _beside(field: Field, kind: type, change: Change) -> list[Change]:
    """No change by a key of files that is checked and not stored; others are refused."""
    (key,) = field.keys
    if key == "kind":
        if change.value == next(word for word in KINDS if kind_class(word) is kind):
            return []
        for why in unknown("kind of bearing", shown(change.value), KINDS):
            raise change.refused(why)
    if key not in NOT_STORED:
        whole = change.way or "the whole"
        raise change.refused(f"is read together with all that it is part of: give '{whole}' whole")
    member = parts_of(field.annotation, tuple) if change.steps[1:] else ()
    taken(member[0] if member else field.annotation, change)
    return []


def of_each_item(old: Any, change: Change) -> list[Change]:
    """The change itself, or one for every item that shares the common value it leads to."""
    common = common_at(old, change.steps)
    if common is None:
        return [change]
    ways = ways_of_items(old, common, change.steps)
    if not ways:
        way = ".".join(filter(None, (change.way, *common.fills, *change.steps[len(common.keys) :])))
        raise change.refused(
            f"changes nothing: each of {common.fills[0]} has its own value here; change {way}"
        )
    return [replace(change, steps=way) for way in ways]
