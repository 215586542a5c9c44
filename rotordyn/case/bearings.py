"""Reads bearings of any kind, also by catalogue values alone, and bearings on the shaft."""

from __future__ import annotations

import re
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

from bearings.bearing import BallBearing
from bearings.catalogue.printed import Catalogue
from bearings.errors import InvalidBearing
from bearings.kinds import DEFAULT, KINDS, kind_class
from rotordyn import units
from rotordyn.case import expand
from rotordyn.case.arranged import printed_preloads
from rotordyn.case.faults import Faults
from rotordyn.case.keys import ESTIMATED, Printed, bearing_class, keys_of
from rotordyn.case.leaf import is_unknown
from rotordyn.case.node import Node
from rotordyn.case.reading import Reading
from rotordyn.errors import InvalidInput
from rotordyn.machine.assembly import unknown as not_known
from rotordyn.machine.flexible_rings import SIZES
from rotordyn.machine.seat import BearingSeat, no_ring_left

if TYPE_CHECKING:
    from bearings.catalogue.estimate import EstimatedBearing

_CALLED = {"bore_diameter": "bore"}  # key of files -> field of a catalogue
_SHOULDERS = ("inner_shoulder_diameter", "outer_shoulder_diameter")


def seat(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a bearing on the shaft; it takes the name of its model."""
    if not node.file:  # written in Python
        expand.bearing_of_seat(node, reading.files)
    read = {key: _measured(node.child("model", key), "length") for key in SIZES}
    sizes = {key: size for key, size in read.items() if size is not None}
    named = node.child("model", "name")
    model = named.value if named is not None and isinstance(named.value, str) else ""
    if node.child("model", "estimate") is not None:
        model += " (estimate)"
    thrust = node.child("thrust")
    by_set = thrust is not None and thrust.shared
    forces = [_measured(each, "force") for each in printed_preloads(node).values()]
    preloads = tuple(each for each in forces if each is not None)
    override = {key: child.plain() for key, child in node.entries("model_override").items()}
    hidden: dict[str, Any] = dict(sizes=sizes, by_set=by_set, preloads=preloads, override=override)
    return reading.description(BearingSeat, node, model=model, **hidden)


def _measured(node: Node | None, kind: str) -> float | None:
    """Parse a number with a unit of this kind; None if missing or faulty."""
    try:
        return None if node is None else units.parse(node.value, kind)
    except InvalidInput:
        return None


def bearing(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a bearing of any kind; None if it has faults, which are reported."""
    if not isinstance(node.value, dict):
        named = expand.bearing(node, {}, reading.files)
        return None if named is None else bearing(reading, annotation, named, others)
    if node.child("estimate") is not None:
        return _estimated(reading, node)
    kind = node.child("kind")
    if kind is not None and kind.value not in tuple(KINDS):
        for why in not_known("kind of bearing", kind.raw or units.shown(kind.plain()), KINDS):
            reading.faults.at(kind, why)
        return None
    model = bearing_class(kind.value if kind else None)
    values = reading.fields(model, node)
    optional = {field.name for field in keys_of(model) if field.default is None}
    for name, value in values.items():
        zero = isinstance(value, int) and node.child(name) is not None and value == 0
        if zero or (value is None and name not in optional) or is_unknown(value):
            return None
    try:
        made = model(**values)
    except InvalidBearing as error:
        place, hint = _named(str(error), model, node)
        reading.faults.at(node.at(*place), f"impossible bearing: {error}{hint}")
        return None
    _rings(reading.faults, node, made)
    return made


def _estimated(reading: Reading, node: Node) -> EstimatedBearing | None:
    """Estimate the bearing from the values of the file; None if it has faults."""
    from bearings.catalogue.estimate import likeliest

    model: Any = kind_class(DEFAULT)
    faults, kind = reading.faults, node.child("kind")
    before = faults.count
    if kind is not None and kind.value != DEFAULT:
        faults.at(
            kind,
            f"no estimate of this kind: given '{kind.raw}'; allowed: {DEFAULT}, or leave "
            "out estimate and give balls and grooves",
        )
        return None
    values = reading.given(model, node)
    for key in ESTIMATED:
        if node.child(key) is None:
            faults.missing(node, key, "missing key: an estimate needs it")
    if faults.count > before:
        return None
    printed = values.pop("estimate") or Printed()
    values |= {field.name: getattr(printed, field.name) for field in fields(Printed)}
    if any(map(is_unknown, values.values())):
        return None
    named = {_CALLED.get(key, key): value for key, value in values.items()}
    taken = {field.name: named[field.name] for field in fields(Catalogue) if field.name in named}
    try:
        bearing = likeliest(Catalogue(**taken))
        shoulders = {key: values[key] for key in _SHOULDERS if key in values}
        return replace(bearing, **shoulders) if shoulders else bearing
    except InvalidBearing as error:
        faults.at_key(node.at("estimate"), f"no estimate: {error}")
        return None


def _named(sentence: str, model: type[BallBearing], node: Node) -> tuple[tuple[str, ...], str]:
    """Key to be changed, of those that a sentence names, and a hint on overriding the model.

    Keys in an override come first: the user cannot change a model of the library.
    """
    kind: Any = model
    optional = {field.name for field in keys_of(kind) if field.default is None}
    words = re.findall(r"[a-z_]+", sentence)
    given = [word for word in words if word in model.measures() and node.child(word) is not None]
    written = [word for word in given if node.at(word).file != node.file]
    instead = [word for word in given if word not in written and word in optional]
    hint = ""
    if written and instead and "exactly one" in sentence:
        nulls = ", ".join(f"{word}: null" for word in dict.fromkeys(instead))
        hint = f"; the model gives {instead[0]} already: add {nulls} to the override"
    return tuple((written or given)[:1]), hint


def _rings(faults: Faults, node: Node, made: BallBearing) -> None:
    """Report rings without thickness between balls and bore or outside diameter."""
    sizes = (_measured(node.child(key), "length") for key in ("bore_diameter", "outside_diameter"))
    for which, _, allowed in no_ring_left(made, *sizes):
        key = f"{which}_diameter"
        given = f"given '{node.at(key).raw}'; allowed: {allowed}"
        faults.at(node.at(key), f"no ring left beside the balls: {given}")
