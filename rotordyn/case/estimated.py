"""Read a bearing given by catalogue values under ``estimate`` instead of balls and grooves."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

from bearings.catalogue.printed import Catalogue
from bearings.errors import InvalidBearing
from bearings.kinds import DEFAULT, kind_class
from rotordyn.case.keys import Printed
from rotordyn.case.leaf import is_unknown
from rotordyn.case.node import Node
from rotordyn.case.reading import Reading

if TYPE_CHECKING:
    from bearings.catalogue.estimate import EstimatedBearing

NEEDED = ("estimate", "name", "bore_diameter", "outside_diameter", "contact_angle")
_CALLED = {"bore_diameter": "bore"}  # key of files -> field of a catalogue
_SHOULDERS = ("inner_shoulder_diameter", "outer_shoulder_diameter")


def estimated(reading: Reading, node: Node) -> EstimatedBearing | None:
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
    for key in NEEDED:
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
