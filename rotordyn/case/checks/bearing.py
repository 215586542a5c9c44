"""Bearings: a geometry that can exist, growth that can be computed, sleeves that can slide."""

from __future__ import annotations

import math
import re
from contextlib import suppress

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from bearings.kinds import kind_class
from rotordyn.case.build.bearing import bearing as built
from rotordyn.case.checks.names import exists, unique
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.bearing import BearingEntry
from rotordyn.case.schema.growth import GrowthEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.schema.support import SeatEntry
from rotordyn.units import format_quantity


def geometry(entry: BearingEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    """The data fit one another by the rules of the kind, and the rings around the balls."""
    if not _known(entry):
        return
    try:
        bearing = built(entry)
    except InvalidBearing as error:
        place, hint = _named(str(error), entry, root.at(*way))
        faults.at(root, (*way, *place), f"impossible bearing: {error}{hint}")
        return
    _rings(entry, bearing, root, way, faults)


def _known(entry: BearingEntry) -> bool:
    """No value of the geometry was found faulty."""
    optional = {name for name, field in type(entry).model_fields.items() if field.default is None}
    for name, measure in entry.measures.items():
        value = getattr(entry, name)
        if measure.quantity == "material":
            if value is None:
                return False
        elif not (value is None and name in optional) and math.isnan(value):
            return False
    return True


def _named(sentence: str, entry: BearingEntry, here: Node) -> tuple[tuple[str, ...], str]:
    """The key to change of those that a sentence names, and how to override one of the model.

    Keys that an override gives come first: the model of a library is not the user's to change.
    """
    words = re.findall(r"[a-z_]+", sentence)
    given = [w for w in words if w in entry.measures and here.child(w) is not None]
    written = [w for w in given if here.at(w).file != here.file]
    fields = type(entry).model_fields
    optional = [w for w in given if w not in written and fields[w].default is None]
    hint = ""
    if written and optional and "exactly one" in sentence:
        nulls = ", ".join(f"{w}: null" for w in dict.fromkeys(optional))
        hint = f"; the model gives {optional[0]} already: add {nulls} to the override"
    return tuple((written or given)[:1]), hint


def _rings(
    entry: BearingEntry, bearing: BallBearing, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    inner, outer = 2.0 * bearing.inner_raceway_radius, 2.0 * bearing.outer_raceway_radius
    if entry.bore_diameter is not None and entry.bore_diameter >= inner:
        _no_ring(root, (*way, "bore_diameter"), "below", inner, faults)
    if entry.outside_diameter is not None and entry.outside_diameter <= outer:
        _no_ring(root, (*way, "outside_diameter"), "above", outer, faults)


def _no_ring(root: Node, way: tuple[object, ...], side: str, limit: float, faults: Faults) -> None:
    faults.at(
        root,
        way,
        f"no ring left beside the balls: given '{root.at(*way).raw}'; "
        f"allowed: {side} {format_quantity(limit, 'mm')}",
    )


def seats(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    """Every bearing on the shaft can exist and its growth can be had."""
    unique([seat.name for seat in entry.bearings], root, ("bearings",), faults)
    for index, seat in enumerate(entry.bearings):
        way = ("bearings", index)
        if seat.model is not None:
            geometry(seat.model, root, (*way, "model"), faults)
            own = seat.growth is not None
            place = (*way, "growth") if own else ("growth",)
            _growth(seat.growth or entry.growth, seat, root, place, faults)
            _bore(entry, seat, root, (*place, "fit"), faults)
            _thrust(entry, seat, root, way, faults)


def _thrust(
    entry: SpindleEntry, seat: SeatEntry, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    """Which way it takes thrust, where it takes one only; which way a spring pushes it."""
    assert seat.model is not None
    if seat.thrust is not None:
        return
    kind = seat.model.kind
    if not kind_class(kind).both_ways:
        faults.missing(
            root,
            (*way, "thrust"),
            f"missing key: kind {kind} takes thrust one way only; allowed: +x, -x, the way the "
            "shaft pushes the inner ring to load the balls",
        )
    elif any(seat.name in sleeve.bearings for sleeve in entry.sleeves):
        faults.missing(
            root,
            (*way, "thrust"),
            "missing key: the spring of its sleeve pushes one way; allowed: +x, -x, the way the "
            "shaft pushes the inner ring against the spring",
        )


def _built(entry: BearingEntry) -> BallBearing | None:
    """The bearing; None where its faults are reported already."""
    if _known(entry):
        with suppress(InvalidBearing):
            return built(entry)
    return None


def _growth(
    growth: GrowthEntry,
    seat: SeatEntry,
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> None:
    model = seat.model
    assert model is not None
    _static(growth, model, root, way, faults)
    if growth.centrifugal != "computed":
        return
    if growth.fit is None:
        faults.missing(
            root,
            (*way, "fit"),
            "missing key: a computed growth needs fit: {interference: …, on the radius}",
        )
    elif growth.fit.bore_diameter is None and model.bore_diameter is None:
        faults.missing(
            root,
            (*way, "fit", "bore_diameter"),
            f"missing key: the model of bearing {seat.name} gives no bore_diameter",
        )


def _bore(
    entry: SpindleEntry, seat: SeatEntry, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    """A computed growth has shaft inside the bore and ring between bore and balls."""
    growth, model = seat.growth or entry.growth, seat.model
    if growth.centrifugal != "computed" or growth.fit is None or model is None:
        return
    bore = growth.fit.bore_diameter or model.bore_diameter
    hole = _hole(entry, seat.x)
    bearing = _built(model)
    if bearing is None:
        return
    race = 2.0 * bearing.inner_raceway_radius
    if bore is not None and hole is not None and not (hole < bore < race or math.isnan(bore)):
        given = format_quantity(bore, "mm")
        allowed = " to ".join(format_quantity(limit, "mm") for limit in (hole, race))
        faults.at(
            root,
            way,
            f"the bore of bearing {seat.name} leaves no shaft or no ring: given {given}; allowed: "
            f"inside {allowed}",
        )


def _hole(entry: SpindleEntry, x: float) -> float | None:
    """Inner diameter of the shaft at station ``x``; None off the shaft."""
    left = entry.shaft.start
    for section in entry.shaft.sections:
        if left <= x < left + section.length:
            front, rear = section.inner
            return front + (x - left) / section.length * (rear - front)
        left += section.length
    return None


def _static(
    growth: GrowthEntry, model: BearingEntry, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    bearing = _built(model)
    room = math.inf if bearing is None else bearing.largest_static_growth
    if growth.static > room:
        faults.at(
            root,
            (*way, "static"),
            f"takes the whole contact angle: given '{root.at(*way, 'static').raw}'; "
            f"allowed: up to {format_quantity(room, 'um')}",
        )


def sleeves(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    """Bearings of a sleeve exist, sit on no other, and are all pushed the same way."""
    unique([sleeve.name for sleeve in entry.sleeves], root, ("sleeves",), faults)
    thrust = {seat.name: seat.thrust or "" for seat in entry.bearings}
    taken: dict[str, str] = {}
    for index, sleeve in enumerate(entry.sleeves):
        ways = set()
        for place, name in enumerate(sleeve.bearings):
            way = ("sleeves", index, "bearings", place)
            if exists(name, thrust, "bearing", root, way, faults):
                ways.add(thrust.get(name, ""))
            if name in taken:
                faults.at(root, way, f"bearing '{name}' is already on sleeve '{taken[name]}'")
            taken.setdefault(name, sleeve.name)
        if {"+x", "-x"} <= ways:
            faults.at(
                root,
                ("sleeves", index, "bearings"),
                "bearings of one sleeve must all have the same thrust: given +x and -x",
            )
