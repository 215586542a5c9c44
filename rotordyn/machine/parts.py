"""The parts of a spindle as rows of a table: kind, name, station, data."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rotordyn.machine.housing import Housing, RigidHousing
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import GROUND, LinearSupport

HEAD = ("part", "name", "x [mm]", "data")
Row = tuple[str, str, str, str]


def part_rows(spindle: Spindle) -> Iterator[Row]:
    """Yield a row for every part, the shaft first, stations in mm."""
    yield _shaft("shaft", spindle.name, spindle.shaft)
    yield from map(_rotor, spindle.rotors)
    for disc in spindle.discs:
        size = f"Ø {_mm(disc.outer_diameter)} × {_mm(disc.width)} mm"
        yield "disc", disc.name, _mm(disc.x), size
    yield from (("mass", m.name, _mm(m.x), f"{m.mass:.4g} kg") for m in spindle.masses)
    yield from (("joint", each.name, _mm(each.x), "") for each in spindle.joints)
    if (bar := spindle.drawbar) is not None:
        yield "drawbar", "", f"{_mm(bar.start)} to {_mm(bar.end)}", f"{bar.force:.4g} N"
    if spindle.motor is not None:
        yield "motor", "", "", spindle.motor.words
    yield from map(_bearing, spindle.seats)
    yield from map(_sleeve, spindle.sleeves)
    yield from map(_support, spindle.supports)
    for damper in spindle.dampers:
        clearance = f"clearance {damper.clearance * 1e6:.4g} µm, {damper.film}"
        yield "squeeze-film damper", damper.name, _mm(damper.x), clearance
    yield from map(_housing, spindle.housings)
    yield from (
        ("point", name, _mm(place.x), place.rotor) for name, place in spindle.places.items()
    )


def _shaft(kind: str, name: str, shaft: Shaft, more: str = "") -> Row:
    ends = f"{_mm(shaft.start)} to {_mm(shaft.end)}"
    largest = _mm(shaft.largest_diameter)
    data = f"{len(shaft.sections)} sections, largest diameter {largest} mm"
    return kind, name, ends, f"{data}{more}"


def _rotor(rotor: Rotor) -> Row:
    return _shaft("rotor", rotor.name, rotor.shaft, f", {rotor.speed_ratio:g} × the speed")


def _bearing(seat: BearingSeat) -> Row:
    thrust = {1: ", carries thrust towards +x", -1: ", carries thrust towards −x", 0: ""}
    kind = seat.model or type(seat.bearing).__name__
    data = f"{kind}, {seat.bearing.balls} balls of {_mm(seat.bearing.ball_diameter)} mm"
    return "bearing", seat.name, _mm(seat.x), f"{data}{thrust[seat.thrust]}"


def _sleeve(sleeve: Sleeve) -> Row:
    spring = sleeve.spring
    data = f"carries {', '.join(sleeve.bearings)}; preload {spring.words}, {spring.rate}"
    if math.isfinite(sleeve.stop_travel):
        data += f", stop after {sleeve.stop_travel * 1e6:.4g} µm"
    return "sleeve", sleeve.name, "", data


def _support(support: LinearSupport) -> Row:
    stiff = [f"{row}{column}" for row, column in support.stiffness if row == column]
    texts = [f"stiffness {', '.join(stiff)}"] if stiff else []
    texts += [f"rigid {', '.join(support.rigid)}"] if support.rigid else []
    texts += [f"against {support.against}"] if support.against != GROUND else []
    return "support", support.name, _mm(support.x), "; ".join(texts)


def _housing(housing: Housing) -> Row:
    carried = f"carries {', '.join(housing.carries)}"
    if isinstance(housing, RigidHousing):
        return "housing", housing.name, _mm(housing.x), f"{housing.mass:.4g} kg, {carried}"
    return "housing", housing.name, "", f"reduced, {len(housing.mass)} coordinates, {carried}"


def _mm(x: float) -> str:
    return f"{x * 1e3:.4g}"
