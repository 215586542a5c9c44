"""Axial shift of the shaft at its bearings and supports, by centrifugal shortening and by heat."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.housing_expansion import housing_expansion


def seat_shifts(spindle: Spindle, speed: Array) -> Array:
    """Return the shift of every seat towards +x at every speed, shape (speeds, seats) [m]."""
    rule = spindle.shortening
    if isinstance(rule, PrescribedShortening):
        shifts = [rule.shift.get(seat.name, 0.0) for seat in spindle.seats]
        return np.multiply.outer((speed / rule.speed) ** 2, shifts)
    return shortened(spindle, speed, [seat.x for seat in spindle.seats])


def thermal_shifts(spindle: Spindle, speed: Array, temperatures: Temperatures) -> Array:
    """Return the thermal shift of every seat on the shaft relative to that in the housing, towards
    +x, shape (speeds, seats) [m].

    Both are counted from where the shaft does not shift, or from the first bearing. The parts of a
    sleeve are as warm as the housing, with which its spring and stop move.
    """
    return _expanded(spindle, speed, temperatures, [seat.x for seat in spindle.seats])


def support_shift(spindle: Spindle, speed: Array, temperatures: Temperatures | None) -> Array:
    """Return the shift of the shaft at the supports that hold it along its axis, on a ground as
    warm as the housing: the mean weighted by their stiffness (speeds,) [m].

    Where the shifts of seats are prescribed those of supports are unknown, and speed does not shift
    the shaft there.
    """
    stiffness = np.array([support.along for support in spindle.supports])
    if not stiffness.sum():
        return np.zeros(len(speed))
    stations = [support.x for support in spindle.supports]
    shifts = shortened(spindle, speed, stations)
    if temperatures is not None:
        shifts = shifts + _expanded(spindle, speed, temperatures, stations)
    return np.asarray(shifts @ stiffness / stiffness.sum())


def shortened(spindle: Spindle, speed: Array, stations: Sequence[float]) -> Array:
    """Return the computed shift of the shaft at stations [m] by rotation (speeds, stations) [m]."""
    rule = spindle.shortening
    if not isinstance(rule, ComputedShortening):
        return np.zeros((len(speed), len(stations)))
    strains = [strain_integral(spindle.shaft, rule.reference, x) for x in stations]
    return np.multiply.outer(speed**2, strains)


def _expanded(
    spindle: Spindle, speed: Array, temperatures: Temperatures, stations: Sequence[float]
) -> Array:
    """Return the thermal shift of shaft against housing at stations [m] (speeds, stations) [m]."""
    rule, seats = spindle.shortening, spindle.seats
    start = rule.reference if isinstance(rule, ComputedShortening) else min(s.x for s in seats)
    rises = temperatures.rises(seats[0].name, speed)  # of shaft and housing, equal at all seats
    shaft = [expansion(spindle.shaft, start, x) for x in stations]
    alpha = housing_expansion(spindle, temperatures.housing_expansion)
    housing = [alpha * (x - start) for x in stations]
    return np.multiply.outer(rises.shaft, shaft) - np.multiply.outer(rises.housing, housing)


def expansion(shaft: Shaft, start: float, end: float) -> float:
    """Return ∫ α dx from ``start`` to ``end`` over a shaft [m/K]."""
    low, high = min(start, end), max(start, end)
    total = 0.0
    for section, left, right in zip(
        shaft.sections, shaft.boundaries[:-1], shaft.boundaries[1:], strict=True
    ):
        length = max(min(right, high) - max(left, low), 0.0)
        total += length * section.material.expansion
    return total if end >= start else -total


def strain_integral(shaft: Shaft, start: float, end: float) -> float:
    """Return ∫ ε dx / Ω² from ``start`` to ``end`` over a free shaft rotating at Ω [m·s²]."""
    edges = shaft.boundaries
    low, high = min(start, end), max(start, end)
    total = 0.0
    for section, left, right in zip(shaft.sections, edges[:-1], edges[1:], strict=True):
        ends = max(left, low), min(right, high)
        if ends[1] > ends[0]:
            shares = [(x - left) / (right - left) for x in ends]
            total += (ends[1] - ends[0]) * _strain(section, shares)
    return total if end >= start else -total


def _strain(section: Section, shares: Sequence[float]) -> float:
    """Return the mean axial strain of a free rotating hollow cylinder over Ω², −ν ρ (ro² + ri²) /
    (2 E), averaged between two ``shares`` of a cone."""
    material, radii = section.material, 0.0
    for front, rear in (section.outer, section.inner):
        a, b = (front + share * (rear - front) for share in shares)
        radii += (a * a + a * b + b * b) / 12.0
    return -material.poisson_ratio * material.density * radii / (2.0 * material.young_modulus)
