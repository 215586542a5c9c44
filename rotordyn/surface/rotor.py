"""Surfaces of the rotor and of what holds it, from the description of a spindle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.surface.body import Surface, together
from rotordyn.surface.revolution import FACETS, Tube, revolved

SHAFT = "shaft"
RINGS_OVER_LENGTH = 100
_COLLAR = 0.02  # of the shaft's length: width of a body whose size is not known


def rotor_surface(spindle: Spindle, facets: int = FACETS) -> Surface:
    """Return the surface of shaft, discs and masses; ``facets`` around the axis, a multiple of 8.

    Discs and masses move as rigid bodies with their station. Point masses have no size: each is
    drawn as the hollow cylinder around the shaft with its inertias, or as a narrow collar where no
    such cylinder exists.
    """
    shaft = spindle.shaft
    longest = (shaft.end - shaft.start) / RINGS_OVER_LENGTH
    edges = shaft.boundaries
    tubes = [
        Tube(
            left,
            right,
            *(d / 2.0 for pair in zip(section.inner, section.outer, strict=True) for d in pair),
        )
        for section, left, right in zip(shaft.sections, edges, edges[1:], strict=False)
    ]
    bodies = [revolved(SHAFT, tubes, longest, facets)]
    bodies += [_disc(disc, number, facets) for number, disc in enumerate(spindle.discs, start=1)]
    bodies += [
        _mass(mass, number, shaft, facets) for number, mass in enumerate(spindle.masses, start=1)
    ]
    return together(bodies)


def holder_surface(spindle: Spindle, facets: int = FACETS) -> Surface | None:
    """Return outer rings of the bearings, and a ring around the shaft at each linear support."""
    rings = [_outer_ring(seat, spindle.seats, facets) for seat in spindle.seats]
    rings += [_support(support, spindle.shaft, facets) for support in spindle.supports]
    return together(rings) if rings else None


def bearing_width(seat: BearingSeat, seats: Sequence[BearingSeat]) -> float:
    """Return a likely ring width [m], less where adjacent bearings are close."""
    gaps = [abs(seat.x - other.x) for other in seats if other.x != seat.x]
    return min(1.7 * seat.bearing.ball_diameter, 0.92 * min(gaps, default=math.inf))


def orbit_stations(spindle: Spindle) -> tuple[float, ...]:
    """Return the stations of drawn orbits: ends, bearings, supports, bodies, eighths of the length.

    They are at least a twelfth of the shaft's length apart.
    """
    shaft = spindle.shaft
    length = shaft.end - shaft.start
    kept: list[float] = []
    for x in _candidates(spindle):
        if all(abs(x - other) >= length / 12.0 for other in kept):
            kept.append(x)
    return tuple(sorted(kept))


def _candidates(spindle: Spindle) -> Iterator[float]:
    start, end = spindle.shaft.start, spindle.shaft.end
    yield from (start, end)
    yield from (seat.x for seat in spindle.seats)
    yield from (support.x for support in spindle.supports)
    yield from (body.x for body in spindle.lumped)
    yield from (start + (end - start) * k / 8.0 for k in range(1, 8))


def _disc(disc: Disc, number: int, facets: int) -> Surface:
    half = disc.width / 2.0
    inner, outer = disc.inner_diameter / 2.0, disc.outer_diameter / 2.0
    tube = Tube(disc.x - half, disc.x + half, inner, outer)
    return revolved(disc.name or f"disc {number}", [tube], facets=facets, station=disc.x)


def _mass(mass: PointMass, number: int, shaft: Shaft, facets: int) -> Surface:
    """Return the hollow cylinder around the shaft with the inertias of ``mass``, or a collar."""
    width = _COLLAR * (shaft.end - shaft.start)
    inner = shaft.diameters_at(mass.x)[0] / 2.0
    outer = 1.06 * inner
    if mass.mass > 0.0 and 2.0 * mass.polar_inertia / mass.mass > inner**2 + outer**2:
        outer = math.sqrt(2.0 * mass.polar_inertia / mass.mass - inner**2)
        along = mass.diametral_inertia - mass.polar_inertia / 2.0
        width = max(math.sqrt(12.0 * max(along, 0.0) / mass.mass), width)
    half = width / 2.0
    tube = Tube(mass.x - half, mass.x + half, inner, outer)
    return revolved(mass.name or f"mass {number}", [tube], facets=facets, station=mass.x)


def _outer_ring(seat: BearingSeat, seats: Sequence[BearingSeat], facets: int) -> Surface:
    half = bearing_width(seat, seats) / 2.0
    pitch, ball = seat.bearing.pitch_diameter / 2.0, seat.bearing.ball_diameter
    tube = Tube(seat.x - half, seat.x + half, pitch + 0.18 * ball, pitch + 1.05 * ball)
    return revolved(seat.name, [tube], facets=facets, station=seat.x)


def _support(support: LinearSupport, shaft: Shaft, facets: int) -> Surface:
    half = _COLLAR * (shaft.end - shaft.start) / 2.0
    radius = shaft.diameters_at(support.x)[0] / 2.0
    tube = Tube(support.x - half, support.x + half, 1.25 * radius, 1.6 * radius)
    return revolved(support.name, [tube], facets=facets, station=support.x)
