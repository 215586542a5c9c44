"""Axial shift of the bearing seats by the centrifugal shortening of the shaft, and by heat."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures

Array = NDArray[np.float64]


def seat_shifts(spindle: Spindle, speed: Array) -> Array:
    """Shift of every seat towards +x at every speed, shape (speeds, seats) [m]."""
    rule = spindle.shortening
    shifts = np.zeros((len(speed), len(spindle.seats)))
    for k, seat in enumerate(spindle.seats):
        if isinstance(rule, PrescribedShortening):
            shifts[:, k] = rule.shift.get(seat.name, 0.0) * (speed / rule.speed) ** 2
        elif isinstance(rule, ComputedShortening):
            shifts[:, k] = strain_integral(spindle.shaft, rule.reference, seat.x) * speed**2
    return shifts


def thermal_shifts(spindle: Spindle, speed: Array, temperatures: Temperatures) -> Array:
    """Shift of every seat on the shaft against the one in the housing by their temperatures,
    towards +x, shape (speeds, seats) [m].

    Both are counted from where the shaft does not shift, or from the first bearing. The parts of a
    sleeve are as warm as the housing, which takes its spring and stop along.
    """
    rule, seats = spindle.shortening, spindle.seats
    start = rule.reference if isinstance(rule, ComputedShortening) else min(s.x for s in seats)
    shifts = np.empty((len(speed), len(seats)))
    for k, seat in enumerate(seats):
        rises = temperatures.rises(seat.name, speed)
        housing = temperatures.housing_expansion * (seat.x - start)
        shifts[:, k] = expansion(spindle.shaft, start, seat.x) * rises.shaft
        shifts[:, k] -= housing * rises.housing
    return shifts


def expansion(shaft: Shaft, start: float, end: float) -> float:
    """∫ α dx from ``start`` to ``end`` over a shaft [m/K]."""
    low, high = min(start, end), max(start, end)
    total = 0.0
    for section, left, right in zip(
        shaft.sections, shaft.boundaries[:-1], shaft.boundaries[1:], strict=True
    ):
        length = max(min(right, high) - max(left, low), 0.0)
        total += length * section.material.thermal_expansion
    return total if end >= start else -total


def strain_integral(shaft: Shaft, start: float, end: float) -> float:
    """∫ ε dx / Ω² from ``start`` to ``end`` over a free shaft turning at Ω [m·s²]."""
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
    """Mean axial strain of a free rotating hollow cylinder over Ω²: −ν ρ (ro² + ri²) / (2 E); its
    mean between two ``shares`` of a cone."""
    material, radii = section.material, 0.0
    for front, rear in (section.outer, section.inner):
        a, b = (front + share * (rear - front) for share in shares)
        radii += (a * a + a * b + b * b) / 12.0
    return -material.poisson_ratio * material.density * radii / (2.0 * material.young_modulus)
