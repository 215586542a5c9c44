"""Radial growth of the inner groove centres at speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.growth import InterferenceFit, QuadraticInSpeed
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import BearingSeat

if TYPE_CHECKING:
    from bearings.fit.cylinder import Cylinder

Array = NDArray[np.float64]


def ring_growth(spindle: Spindle, seat: BearingSeat, speed: Array) -> Array:
    """Total growth Δu of a seat's inner groove centre at every speed, static part included [m]."""
    rule = seat.growth.centrifugal
    if isinstance(rule, QuadraticInSpeed):
        return seat.growth.static + rule.value * (speed / rule.speed) ** 2
    if (fit := seat.growth.fitted) is not None:
        return seat.growth.static + fit_growth(spindle, seat, fit, speed)
    return np.full_like(speed, seat.growth.static)


def fit_growth(spindle: Spindle, seat: BearingSeat, fit: InterferenceFit, speed: Array) -> Array:
    """Growth by rotation of the inner raceway of a ring fitted on the shaft, from rest [m].

    Shaft section and inner ring are compound thick cylinders in plane stress; the ring reaches to
    the raceway contact radius ``inner_raceway_radius``.
    """
    from bearings.fit.compound import centrifugal_growth

    bodies = fitted_bodies(spindle, seat, fit)
    return centrifugal_growth(bodies, [fit.interference], bodies[-1].outer_radius, speed)


def released_fits(spindle: Spindle, speed: float) -> list[tuple[str, float]]:
    """Bearings whose inner ring lets go of the shaft up to ``speed``, and where [rad/s]."""
    released = []
    for seat in spindle.seats:
        fit = seat.growth.fitted
        if fit is not None:
            from bearings.fit.compound import release_speed

            limit = float(release_speed(fitted_bodies(spindle, seat, fit), [fit.interference])[0])
            if limit <= speed:
                released.append((seat.name, limit))
    return released


def fitted_bodies(
    spindle: Spindle, seat: BearingSeat, fit: InterferenceFit
) -> tuple[Cylinder, Cylinder]:
    """Shaft and inner ring as cylinders."""
    from bearings.fit.cylinder import Cylinder

    material, bearing = spindle.shaft.section_at(seat.x).material, seat.bearing
    hole = spindle.shaft.diameters_at(seat.x)[1]
    bore = fit.bore_diameter / 2.0
    return (
        Cylinder(hole / 2.0, bore, material),
        Cylinder(bore, bearing.inner_raceway_radius, bearing.ring_material),
    )
