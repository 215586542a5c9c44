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
    """Fit of a ring: ``radius`` of the fit and ``interference`` on the radius [m]."""

    radius: float
    interference: float


def static_growth(spindle: Spindle, seat: BearingSeat) -> float:
    """Return the growth of a seat at rest and at the reference temperature, as mounted [m]."""
    if seat.fits is None:
        return seat.growth.static
    return float(_fitted(spindle, seat, np.zeros(1), None)[0])


def ring_growth(
    spindle: Spindle, seat: BearingSeat, speed: Array, temperatures: Temperatures | None = None
) -> Array:
    """Return the growth Δu of a seat at every speed [rad/s], static part included (speeds,) [m].

    It follows from the fits where they are given; else ``growth.static`` is the growth as mounted.
    """
    static, rule = seat.growth.static, seat.growth.centrifugal
    if seat.fits is not None:
        return _fitted(spindle, seat, speed, temperatures)
    if seat.growth.fitted is not None:
        mounted = _fitted(spindle, seat, np.zeros(1), None)
        return static + _fitted(spindle, seat, speed, temperatures) - mounted
    growth = np.full_like(speed, static)
    if isinstance(rule, QuadraticInSpeed):
        growth = growth + rule.value * (speed / rule.speed) ** 2
    if temperatures is not None:  # rings without a fit expand freely, whatever the speed
        growth = growth + _fitted(spindle, seat, speed, temperatures)
    return growth


def thermal_shift(
    seat: BearingSeat, speed: Array, temperatures: Temperatures | None = None
) -> Array:
    """Return the axial shift of the inner groove, in the direction that loads the bearing, due to
    thermal growth of the balls beyond that of the adjacent rings (speeds,) [m]."""
    return _ball_growth(seat, speed, temperatures)[1]


def _ball_growth(
    seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> tuple[Array, Array]:
    """Return growth and axial shift due to thermal growth of the balls (speeds,) [m]."""
    rises = _rises(seat, speed, temperatures)
    if temperatures is None:  # zero; saves the import
        return rises.balls, rises.balls
    from bearings.heat.temperature import ball_expansion

    return ball_expansion(seat.bearing, rises.balls, rises.inner, rises.outer)


def _fitted(
    spindle: Spindle, seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> Array:
    """Return the growth of both rings on shaft and in housing, and of the balls (speeds,) [m]."""
    bearing = seat.bearing
    inner = np.empty_like(speed)
    outer = _growth_by_balls(seat, speed, bearing.outer_raceway_radius)
    for rows, state in inner_ring(spindle, seat, speed, temperatures):
        inner[rows] = state.radial_growth(bearing.inner_raceway_radius)
    for rows, state in outer_ring(seat, speed, temperatures):
        outer[rows] += state.radial_growth(bearing.outer_raceway_radius, body=0)
    return inner - outer + _ball_growth(seat, speed, temperatures)[0]


def inner_ring(
    spindle: Spindle,
    seat: BearingSeat,
    speed: Array,
    temperatures: Temperatures | None = None,
) -> States:
    """Return states of shaft and inner ring at ``speed``, or of the ring alone if no fit is known.

    One state, with its rows, for all speeds of the same temperatures.
    """
    from bearings.fit.compound import compound

    bearing, fit = seat.bearing, inner_fit(seat)
    race = bearing.inner_raceway_radius
    rises = _rises(seat, speed, temperatures)
    states = []
    for rows in _equal_rows(rises.shaft, rises.inner):
        shaft_rise, ring_rise = float(rises.shaft[rows[0]]), float(rises.inner[rows[0]])
        if fit is None:
            ring = [_cylinder(0.9 * race, race, bearing.ring_material, ring_rise)]
            states.append((rows, compound(ring, [], 0.0 * speed[rows])))
            continue
        material = spindle.shaft.section_at(seat.x).material
        bore = spindle.shaft.diameters_at(seat.x)[1] / 2.0
        bodies = [
            _cylinder(bore, fit.radius, material, shaft_rise),
            _cylinder(fit.radius, race, bearing.ring_material, ring_rise),
        ]
        states.append((rows, compound(bodies, [fit.interference], speed[rows])))
    return states


def outer_ring(seat: BearingSeat, speed: Array, temperatures: Temperatures | None = None) -> States:
    """Return states of outer ring and housing at rest, or of the ring alone if no fit is known.

    The expansion of the free ring by the balls adds to its interference.
    """
    from bearings.fit.compound import compound

    bearing, fits, fit = seat.bearing, seat.fits, outer_fit(seat)
    race = bearing.outer_raceway_radius
    rises = _rises(seat, speed, temperatures)
    states = []
    radius = race if fit is None else fit.radius
    expanded = _growth_by_balls(seat, speed, radius)
    for rows in _equal_rows(rises.housing, rises.outer, expanded):
        housing_rise, ring_rise = float(rises.housing[rows[0]]), float(rises.outer[rows[0]])
        if fit is None or fits is None:
            ring = [_cylinder(race, 1.1 * race, bearing.ring_material, ring_rise)]
            states.append((rows, compound(ring, [], 0.0 * speed[rows])))
            continue
        bodies = [
            _cylinder(race, fit.radius, bearing.ring_material, ring_rise),
            _cylinder(fit.radius, fits.housing_radius, fits.housing_material, housing_rise),
        ]
        interference = fit.interference + float(expanded[rows[0]])
        states.append((rows, compound(bodies, [interference], 0.0 * speed[rows])))
    return states


def _growth_by_balls(seat: BearingSeat, speed: Array, radius: float) -> Array:
    """Return the growth of the free outer ring at ``radius`` by the centrifugal force of the balls,
    as a uniform pressure in its bore (speeds,) [m]; 0 unless the fits include it."""
    from bearings.geometry import frozen_force, geometry

    fits, bearing = seat.fits, seat.bearing
    if fits is None or not fits.under_balls or fits.width is None or not fits.outside_diameter:
        return np.zeros_like(speed)
    race, outside = bearing.outer_raceway_radius, fits.outside_diameter / 2.0
    load = bearing.balls * frozen_force(geometry(bearing.grooves), speed**2)
    pressure = load / (2.0 * math.pi * race * fits.width)
    material = bearing.ring_material
    nu, shape = material.poisson_ratio, race**2 / (outside**2 - race**2)
    factor = (1.0 - nu) * radius + (1.0 + nu) * outside**2 / radius
    return np.asarray(pressure * shape * factor / material.young_modulus)


def _cylinder(inner: float, outer: float, material: Material, rise: float) -> Cylinder:
    """Return a body ``rise`` [K] warmer than at assembly."""
    from bearings.fit.compound import Cylinder

    alpha = material.expansion
    return Cylinder(inner, outer, material, rise if alpha else 0.0, alpha)


def inner_fit(seat: BearingSeat) -> Fit | None:
    """Return the fit of the inner ring on the shaft, None if unknown."""
    if seat.fits is not None:
        if not seat.fits.shaft or seat.fits.bore_diameter is None:
            return None
        return Fit(seat.fits.bore_diameter / 2.0, seat.fits.depth("inner"))
    fitted = seat.growth.fitted
    return None if fitted is None else Fit(fitted.bore_diameter / 2.0, fitted.interference)


def outer_fit(seat: BearingSeat) -> Fit | None:
    """Return the fit of the outer ring in its housing, None if unknown."""
    if seat.fits is None or not seat.fits.housing or seat.fits.outside_diameter is None:
        return None
    return Fit(seat.fits.outside_diameter / 2.0, seat.fits.depth("outer"))


def _equal_rows(*values: Array) -> list[Indices]:
    """Group the rows at which all values are the same."""
    kinds = np.unique(np.stack(values), axis=1, return_inverse=True)[1].ravel()
    return [np.flatnonzero(kinds == kind) for kind in range(int(kinds.max(initial=-1)) + 1)]


def _rises(seat: BearingSeat, speed: Array, temperatures: Temperatures | None) -> Rises:
    """Return temperatures above the reference, 0 if all are those of assembly (speeds,) [K]."""
    if temperatures is None:
        zero = np.zeros(len(speed))
        return Rises(zero, zero, zero, zero, zero)
    return temperatures.rises(seat.name, speed)


class Release(NamedTuple):
    """Loss of the interference of a bearing ring on its ``seat``, from which speed on [rad/s].

    The ring comes loose between the speeds ``held`` and ``speed``, which are equal where it is
    exact; ``held`` is NaN if no speed is known at which the fit holds.
    """

    bearing: str
    ring: str
    seat: str
    held: float
    speed: float


def released_fits(
    spindle: Spindle, speed: Array, temperatures: Temperatures | None = None
) -> list[Release]:
    """Return the rings that are pressed on as mounted and come loose up to the highest of
    ``speed``.

    The speed is exact for inner rings at temperatures that do not depend on it; else it lies
    between two of ``speed``.
    """
    released = []
    for seat in spindle.seats:
        for between in _inner_release(spindle, seat, speed, temperatures):
            released.append(Release(seat.name, "inner", "shaft", *between))
        for between in _outer_release(seat, speed, temperatures):
            released.append(Release(seat.name, "outer", "housing", *between))
    return released


def _inner_release(
    spindle: Spindle, seat: BearingSeat, speed: Array, temperatures: Temperatures | None
) -> Iterator[tuple[float, float]]:
    """Yield the speeds between which the inner ring comes loose, if it does."""
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
    """Yield the speeds between which an outer ring with interference comes loose, if it does."""
    if outer_fit(seat) is not None and outer_ring(seat, np.zeros(1))[0][1].holds.all():
        yield from _first_loose(outer_ring(seat, speed, temperatures), speed)


def _first_loose(states: States, speed: Array) -> Iterator[tuple[float, float]]:
    """Yield the speed before the first at which a ring has no pressure, and that speed; nothing if
    the ring keeps its pressure."""
    loose = [row for rows, state in states for row in rows[~state.holds[:, 0]]]
    if loose:
        first = min(loose)
        at = float(speed[first])
        last_held = float(speed[first - 1]) if first else at if at == 0.0 else math.nan
        yield last_held, at
