"""Radial growth of the groove centres of a seat: fits, rotation and temperature.

Δu is the growth of the inner groove centre against the outer one. Fitted rings are compound thick
cylinders in plane stress, the inner ring with the shaft, the outer one with its housing; each ring
reaches to the contact of the balls with its race, whose growth moves the groove centre. Balls that
warm up and expand act as further growth and move the groove centres together along the axis
(theory: rings).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.machine.growth import QuadraticInSpeed
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Rises, Temperatures

if TYPE_CHECKING:
    from bearings.fit.compound import CompoundState, Cylinder
    from bearings.materials import Material

    States = list[tuple[Indices, CompoundState]]


class Fit(NamedTuple):
    """Where a ring sits: ``radius`` of the fit and ``interference`` on the radius [m]."""

    radius: float
    interference: float


def static_growth(spindle: Spindle, seat: BearingSeat) -> float:
    """Growth of a seat at rest and at the reference temperature, as mounted [m]."""
    if seat.fits is None:
        return seat.growth.static
    return float(_fitted(spindle, seat, np.zeros(1), None)[0])


def ring_growth(
    spindle: Spindle, seat: BearingSeat, speed: Array, temperatures: Temperatures | None = None
) -> Array:
    """Total growth Δu of a seat at every speed [rad/s], static part included (speeds,) [m].

    All of it follows from the fits where they are given; else ``growth.static`` is that as mounted.
    """
    static, rule = seat.growth.static, seat.growth.centrifugal
    if seat.fits is not None:
        return _fitted(spindle, seat, speed, temperatures)
    if seat.growth.fitted is not None:
        mounted = _fitted(spindle, seat, np.zeros(1), None)
        return static + _fitted(spindle, seat, speed, temperatures) - mounted
    grown = np.full_like(speed, static)
    if isinstance(rule, QuadraticInSpeed):
        grown = grown + rule.value * (speed / rule.speed) ** 2
    if temperatures is not None:  # rings without a fit expand freely, whatever the speed
        grown = grown + _fitted(spindle, seat, speed, temperatures)
    return grown


def thermal_shift(
    seat: BearingSeat, speed: Array, temperatures: Temperatures | None = None
) -> Array:
    """Axial shift of the inner groove, the way that loads the bearing, by thermal growth of the
    balls beyond that of the rings beside them (speeds,) [m]."""
    return _swollen(seat, speed, temperatures)[1]


def _swollen(
    seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> tuple[Array, Array]:
    """What thermal growth of the balls adds to growth and shift (speeds,) [m]."""
    rises = _rises(seat, speed, temperatures)
    if temperatures is None:  # without what computes it
        return rises.balls, rises.balls
    from bearings.heat.temperature import swollen

    return swollen(seat.bearing, rises.balls, rises.inner, rises.outer)


def _fitted(
    spindle: Spindle, seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> Array:
    """Growth of both rings with what they sit on, and of the balls (speeds,) [m]."""
    bearing = seat.bearing
    inner = np.empty_like(speed)
    outer = _under_balls(seat, speed, bearing.outer_raceway_radius)
    for rows, state in inner_ring(spindle, seat, speed, temperatures):
        inner[rows] = state.radial_growth(bearing.inner_raceway_radius)
    for rows, state in outer_ring(seat, speed, temperatures):
        outer[rows] += state.radial_growth(bearing.outer_raceway_radius, body=0)
    return inner - outer + _swollen(seat, speed, temperatures)[0]


def inner_ring(
    spindle: Spindle,
    seat: BearingSeat,
    speed: Array,
    temperatures: Temperatures | None = None,
) -> States:
    """Shaft and inner ring, or the ring alone where no fit is known, turning at ``speed``.

    One state for all speeds of the same temperatures, with their rows.
    """
    from bearings.fit.compound import compound

    bearing, fit = seat.bearing, inner_fit(seat)
    race = bearing.inner_raceway_radius
    rises = _rises(seat, speed, temperatures)
    states = []
    for rows in _rows_alike(rises.shaft, rises.inner):
        shaft, warm = float(rises.shaft[rows[0]]), float(rises.inner[rows[0]])
        if fit is None:
            ring = [_cylinder(0.9 * race, race, bearing.ring_material, warm)]
            states.append((rows, compound(ring, [], 0.0 * speed[rows])))
            continue
        material = spindle.shaft.section_at(seat.x).material
        hole = spindle.shaft.diameters_at(seat.x)[1] / 2.0
        bodies = [
            _cylinder(hole, fit.radius, material, shaft),
            _cylinder(fit.radius, race, bearing.ring_material, warm),
        ]
        states.append((rows, compound(bodies, [fit.interference], speed[rows])))
    return states


def outer_ring(seat: BearingSeat, speed: Array, temperatures: Temperatures | None = None) -> States:
    """Outer ring and housing, which stand still, or the ring alone where no fit is known.

    What balls expand the free ring by adds to its interference.
    """
    from bearings.fit.compound import compound

    bearing, fits, fit = seat.bearing, seat.fits, outer_fit(seat)
    race = bearing.outer_raceway_radius
    rises = _rises(seat, speed, temperatures)
    states = []
    outside = race if fit is None else fit.radius
    expanded = _under_balls(seat, speed, outside)
    for rows in _rows_alike(rises.housing, rises.outer, expanded):
        housing, warm = float(rises.housing[rows[0]]), float(rises.outer[rows[0]])
        if fit is None or fits is None:
            ring = [_cylinder(race, 1.1 * race, bearing.ring_material, warm)]
            states.append((rows, compound(ring, [], 0.0 * speed[rows])))
            continue
        bodies = [
            _cylinder(race, fit.radius, bearing.ring_material, warm),
            _cylinder(fit.radius, fits.housing_radius, fits.housing_material, housing),
        ]
        depth = fit.interference + float(expanded[rows[0]])
        states.append((rows, compound(bodies, [depth], 0.0 * speed[rows])))
    return states


def _under_balls(seat: BearingSeat, speed: Array, radius: float) -> Array:
    """Growth of the free outer ring at ``radius`` by the centrifugal force of the balls, as a
    uniform pressure in its bore (speeds,) [m]; where the fits ask for it."""
    from bearings.geometry import frozen_force, geometry

    fits, bearing = seat.fits, seat.bearing
    if fits is None or not fits.under_balls or fits.width is None or not fits.outside_diameter:
        return np.zeros_like(speed)
    race, outside = bearing.outer_raceway_radius, fits.outside_diameter / 2.0
    load = bearing.balls * frozen_force(geometry(bearing.grooves), speed**2)
    pressure = load / (2.0 * math.pi * race * fits.width)
    material = bearing.ring_material
    nu, shape = material.poisson_ratio, race**2 / (outside**2 - race**2)
    way = (1.0 - nu) * radius + (1.0 + nu) * outside**2 / radius
    return np.asarray(pressure * shape * way / material.young_modulus)


def _cylinder(inner: float, outer: float, material: Material, rise: float) -> Cylinder:
    """A body ``rise`` [K] warmer than it was assembled."""
    from bearings.fit.compound import Cylinder

    alpha = material.thermal_expansion
    return Cylinder(inner, outer, material, rise if alpha else 0.0, alpha)


def inner_fit(seat: BearingSeat) -> Fit | None:
    """Of the inner ring on the shaft, where it is known."""
    if seat.fits is not None:
        if not seat.fits.shaft or seat.fits.bore_diameter is None:
            return None
        return Fit(seat.fits.bore_diameter / 2.0, seat.fits.depth("inner"))
    given = seat.growth.fitted
    return None if given is None else Fit(given.bore_diameter / 2.0, given.interference)


def outer_fit(seat: BearingSeat) -> Fit | None:
    """Of the outer ring in its housing, where it is known."""
    if seat.fits is None or not seat.fits.housing or seat.fits.outside_diameter is None:
        return None
    return Fit(seat.fits.outside_diameter / 2.0, seat.fits.depth("outer"))


def _rows_alike(*values: Array) -> list[Indices]:
    """Rows at which all values are the same."""
    kinds = np.unique(np.stack(values), axis=1, return_inverse=True)[1].ravel()
    return [np.flatnonzero(kinds == kind) for kind in range(int(kinds.max(initial=-1)) + 1)]


def _rises(seat: BearingSeat, speed: Array, temperatures: Temperatures | None) -> Rises:
    """Temperatures above the reference, none where all are those of assembly (speeds,) [K]."""
    if temperatures is None:
        none = np.zeros(len(speed))
        return Rises(none, none, none, none, none)
    return temperatures.rises(seat.name, speed)


class Release(NamedTuple):
    """A ring of a bearing that lets go: which one, of what, and from which speed on [rad/s].

    It lets go between the speeds ``held`` and ``speed``, which are one where it is exact; ``held``
    is NaN where no speed is known at which it holds.
    """

    bearing: str
    ring: str
    seat: str
    held: float
    speed: float


def released_fits(
    spindle: Spindle, speed: Array, temperatures: Temperatures | None = None
) -> list[Release]:
    """Rings that were pressed on as mounted and let go up to the highest of ``speed``.

    At temperatures that do not follow the speed it is exact for inner rings, else between two of
    ``speed``.
    """
    released = []
    for seat in spindle.seats:
        for at in _inner_release(spindle, seat, speed, temperatures):
            released.append(Release(seat.name, "inner", "shaft", *at))
        for at in _outer_release(seat, speed, temperatures):
            released.append(Release(seat.name, "outer", "housing", *at))
    return released


def _inner_release(
    spindle: Spindle, seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> Iterator[tuple[float, float]]:
    """Speeds between which the inner ring lets go; none where it does not."""
    from bearings.fit.compound import release_speed

    fit = inner_fit(seat)
    if fit is None:
        return
    states = inner_ring(spindle, seat, speed, temperatures)
    tabled = temperatures is not None and bool(temperatures.speeds)
    if len(states) == 1 and not (tabled and len(speed) == 1):
        at = float(release_speed(states[0][1].bodies, [fit.interference])[0])
        if at <= speed.max():
            yield at, at
        return
    yield from _first_loose(states, speed)


def _outer_release(
    seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> Iterator[tuple[float, float]]:
    """The same of an outer ring that is pressed into its bore."""
    if outer_fit(seat) is not None and outer_ring(seat, np.zeros(1))[0][1].holds.all():
        yield from _first_loose(outer_ring(seat, speed, temperatures), speed)


def _first_loose(states: States, speed: Array) -> Iterator[tuple[float, float]]:
    """The first of the speeds at which a ring has no pressure, after the one before it; none where
    it has at all."""
    loose = [row for rows, state in states for row in rows[~state.holds[:, 0]]]
    if loose:
        first = min(loose)
        at = float(speed[first])
        before = float(speed[first - 1]) if first else at if at == 0.0 else math.nan
        yield before, at
