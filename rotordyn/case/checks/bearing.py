"""Bearings: a geometry that can exist, growth that can be computed, sleeves that can slide."""

from __future__ import annotations

import math

from bearings.errors import InvalidBearing
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
    """The balls fit on their circle, and the rings around them."""
    if entry.ball_material is None or entry.ring_material is None:
        return
    try:
        built(entry)
    except InvalidBearing as error:
        values = (entry.ball_diameter, entry.pitch_diameter, entry.contact_angle)
        known = not any(math.isnan(v) for v in (*values, *_conformities(entry)))
        if known:
            faults.at(root, (*way, "balls"), f"impossible bearing: {error}")
    _rings(entry, root, way, faults)


def _conformities(entry: BearingEntry) -> tuple[float, float]:
    return entry.inner_conformity, entry.outer_conformity


def _rings(entry: BearingEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    inner = entry.pitch_diameter - entry.ball_diameter * math.cos(entry.contact_angle)
    outer = entry.pitch_diameter + entry.ball_diameter * math.cos(entry.contact_angle)
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
    race = model.pitch_diameter - model.ball_diameter * math.cos(model.contact_angle)
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
            return max(section.inner)
        left += section.length
    return None


def _static(
    growth: GrowthEntry, model: BearingEntry, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    centres = (sum(_conformities(model)) - 1.0) * model.ball_diameter
    room = centres * (1.0 - math.cos(model.contact_angle))
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
    thrust = {seat.name: seat.thrust for seat in entry.bearings}
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
