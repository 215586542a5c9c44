"""Symbols of supports, housings and squeeze films on the half-section [mm]."""

from __future__ import annotations

import math

from rotordyn.figures.sketch import Sketch
from rotordyn.figures.style import BLUE, SKY
from rotordyn.figures.symbols import (
    GROUND_DEPTH,
    RING,
    SLEEVE,
    draw_ground,
    outside_of,
    sleeve_top,
    spring,
)
from rotordyn.machine.housing import Housing
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.machine.support import GROUND, LinearSupport
from rotordyn.surface.rotor import bearing_width


def foot(spindle: Spindle) -> float:
    """Return the distance of the ground below the shaft [mm]."""
    return 0.02 * (spindle.shaft.end - spindle.shaft.start) * 1e3


def held_radius(spindle: Spindle) -> float:
    """Return the largest radius of bearings, sleeves, films and housings [mm]."""
    radii = [outside_of(seat) for seat in spindle.seats]
    radii += [seat_top(spindle, seat) + 2.0 for seat in spindle.seats]
    radii += [_film_radius(spindle, film) + foot(spindle) for film in spindle.dampers]
    radii += [low + 3.0 * foot(spindle) for _, _, low in housings_above(spindle).values()]
    return max(radii, default=0.0)


def seat_top(spindle: Spindle, seat: BearingSeat) -> float:
    """Return the outer radius of a bearing, or of the sleeve over it [mm]."""
    sleeve = spindle.sleeve_of(seat.name)
    if sleeve is None:
        return outside_of(seat)
    return sleeve_top(other for other in spindle.seats if other.name in sleeve.bearings)


def housed(spindle: Spindle, name: str) -> bool:
    """Return whether a housing carries the bearing or support."""
    return any(name in housing.carries for housing in spindle.housings)


def housings_above(spindle: Spindle) -> dict[str, tuple[float, float, float]]:
    """Return by housing left and right end and lower edge of the block over its bearings [mm]."""
    blocks = {}
    for housing in spindle.housings:
        seats = [seat for seat in spindle.seats if seat.name in housing.carries]
        if seats:
            spans = [_span(spindle, seat) for seat in seats]
            left, right = min(a for a, _ in spans), max(b for _, b in spans)
            clear = _thickest(spindle, left, right) + 0.3 * foot(spindle)
            low = max(clear, *(seat_top(spindle, seat) for seat in seats))
            blocks[housing.name] = left, right, low
    return blocks


def draw_holders(sketch: Sketch, spindle: Spindle) -> None:
    """Draw linear supports as a spring from a rotor down to the ground, rigid ones as a wedge;
    squeeze films about their journal; housings as blocks on springs."""
    unit = 0.1 * foot(spindle)
    for support in spindle.supports:
        x = support.x * 1e3
        if support.against != GROUND:
            _link(sketch, spindle, support)
            continue
        radius, ground = _shaft_radius(spindle, support), _ground(spindle, support)
        if support.rigid:
            left, right = (x - 4.0 * unit, ground), (x + 4.0 * unit, ground)
            sketch.polygon([(x, -radius), left, right], "#FFFFFF", edge=BLUE)
        else:
            sketch.line(spring((x, -radius), (x, ground), 2.0 * unit), BLUE, 1.0)
        if not housed(spindle, support.name):
            draw_ground(sketch, x, ground, 4.0 * unit, upright=False, side=-1.0, unit=unit)
    for film in spindle.dampers:
        _film(sketch, spindle, film)
    for housing in spindle.housings:
        _housing_below(sketch, spindle, housing)
    for name, block in housings_above(spindle).items():
        _housing_above(sketch, spindle, name, block)


def gap(spindle: Spindle, support: LinearSupport) -> tuple[float, float]:
    """Return the radii between which a support joins two rotors [mm]."""
    ends = [spindle.part(end).shaft.diameters_at(support.x) for end in support.ends]
    (thin, _), (_, bore) = sorted(ends)
    low, high = thin * 500.0, bore * 500.0
    if high > low:
        return low, high
    return low - 2.0, low + 2.0  # side by side, or one on the other


def lower_end(spindle: Spindle, support: LinearSupport) -> float:
    """Return the lower edge of the ground symbol of a support, or of the block of its housing."""
    unit = 0.1 * foot(spindle)
    for housing in spindle.housings:
        if support.name in housing.carries:
            return _block(spindle, housing)
    return _ground(spindle, support) - GROUND_DEPTH * unit


def _block(spindle: Spindle, housing: Housing) -> float:
    """Return the lower edge of the block of a housing under its supports [mm]."""
    feet = [_ground(spindle, s) for s in spindle.supports if s.name in housing.carries]
    return min(feet) - 0.3 * foot(spindle)


def _span(spindle: Spindle, seat: BearingSeat) -> tuple[float, float]:
    half = bearing_width(seat, spindle.seats) / 2.0
    return (seat.x - half) * 1e3, (seat.x + half) * 1e3


def _thickest(spindle: Spindle, left: float, right: float) -> float:
    """Return the largest radius of rotors and their discs between two stations [mm]."""
    shafts = [part.shaft for part in spindle.parts.values()]
    radii = [
        max(section.outer)
        for shaft in shafts
        for section, a, b in zip(
            shaft.sections, shaft.boundaries, shaft.boundaries[1:], strict=False
        )
        if a * 1e3 < right and b * 1e3 > left
    ]
    discs = (disc for part in spindle.parts.values() for disc in part.discs)
    radii += [
        disc.outer_diameter
        for disc in discs
        if (disc.x - disc.width / 2) * 1e3 < right and (disc.x + disc.width / 2) * 1e3 > left
    ]
    return max(radii, default=0.0) * 500.0


def _shaft_radius(spindle: Spindle, support: LinearSupport) -> float:
    """Return the radius of the shaft that a support holds [mm]."""
    shaft = spindle.part(support.holds).shaft
    return shaft.diameters_at(support.x)[0] * 500.0


def _ground(spindle: Spindle, support: LinearSupport) -> float:
    """Return the level of the ground of a support [mm]: below every rotor at its station."""
    radii = [
        part.shaft.diameters_at(support.x)[0] * 500.0
        for part in spindle.parts.values()
        if part.shaft.start <= support.x <= part.shaft.end
    ]
    return -max(_shaft_radius(spindle, support), *radii, 0.0) - foot(spindle)


def _link(sketch: Sketch, spindle: Spindle, support: LinearSupport) -> None:
    """Draw a crossed box between two rotors, in the gap from the thinner to the thicker one."""
    low, high = gap(spindle, support)
    half, x = 0.5 * max(high - low, 5.0), support.x * 1e3
    sketch.box(x - half, x + half, low, high, "#FFFFFF", edge=BLUE, z=5)
    sketch.cross(x - half, x + half, low, high, colour=BLUE, width=0.7, z=6)


def _film_radius(spindle: Spindle, film: SqueezeFilmDamper) -> float:
    """Return the outer radius of a film [mm], drawn thick enough to be visible."""
    return film.radius * 1e3 + max(film.clearance * 1e3, 0.25 * foot(spindle))


def _film(sketch: Sketch, spindle: Spindle, film: SqueezeFilmDamper) -> None:
    """Draw the journal that does not spin, from the shaft to the film, and the ground around it."""
    left, right = (film.x - film.length / 2) * 1e3, (film.x + film.length / 2) * 1e3
    shaft, journal = spindle.shaft.diameters_at(film.x)[0] * 500.0, film.radius * 1e3
    outer, unit = _film_radius(spindle, film), 0.1 * foot(spindle)
    for side in (1.0, -1.0):
        if journal > shaft:
            sketch.box(left, right, side * shaft, side * journal, RING, z=4)
        sketch.box(left, right, side * journal, side * outer, SKY, edge=SKY, z=4)
        half = (right - left) / 2.0
        draw_ground(sketch, film.x * 1e3, side * outer, half, upright=False, side=side, unit=unit)


def _housing_below(sketch: Sketch, spindle: Spindle, housing: Housing) -> None:
    """Draw a housing as a block under the supports that it carries."""
    unit = 0.1 * foot(spindle)
    feet = [(s.x * 1e3, _ground(spindle, s)) for s in spindle.supports if s.name in housing.carries]
    if feet:
        left, right = min(x for x, _ in feet) - 4.0 * unit, max(x for x, _ in feet) + 4.0 * unit
        low = _block(spindle, housing)
        sketch.box(left, right, low, low + 3.0 * unit, SLEEVE, z=4)
        for x, y in feet:
            sketch.line([(x, y), (x, low + 3.0 * unit)], BLUE, 1.0)


def _housing_above(
    sketch: Sketch, spindle: Spindle, name: str, block: tuple[float, float, float]
) -> None:
    """Draw a housing as a block on the bearings that it carries, on springs from the ground."""
    (left, right, low), unit = block, 0.1 * foot(spindle)
    high, ground = low + 8.0 * unit, low + 22.0 * unit
    carried = next(housing for housing in spindle.housings if housing.name == name).carries
    for seat in spindle.seats:
        top = seat_top(spindle, seat)
        if seat.name in carried and not math.isclose(top, low):
            sketch.box(*_span(spindle, seat), top, low, SLEEVE, z=4)
    sketch.box(left, right, low, high, SLEEVE, z=4)
    for share in (0.2, 0.8):
        x = left + share * (right - left)
        sketch.line(spring((x, high), (x, ground), 2.0 * unit), BLUE, 1.0)
        draw_ground(sketch, x, ground, 4.0 * unit, upright=False, side=1.0, unit=unit)
