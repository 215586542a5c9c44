"""Axial shift of the bearing seats by the centrifugal shortening of the shaft."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.growth import ComputedShortening, PrescribedShortening
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle

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


def strain_integral(shaft: Shaft, start: float, end: float) -> float:
    """∫ ε dx / Ω² from ``start`` to ``end`` over a free shaft turning at Ω [m·s²]."""
    edges = shaft.boundaries
    low, high = min(start, end), max(start, end)
    total = 0.0
    for section, left, right in zip(shaft.sections, edges[:-1], edges[1:], strict=True):
        covered = min(right, high) - max(left, low)
        if covered > 0.0:
            total += covered * _strain(section)
    return total if end >= start else -total


def _strain(section: Section) -> float:
    """Mean axial strain of a free rotating hollow cylinder over Ω²: −ν ρ (ro² + ri²) / (2 E)."""
    material = section.material
    radii = (section.outer_diameter**2 + section.inner_diameter**2) / 4.0
    return -material.poisson_ratio * material.density * radii / (2.0 * material.young_modulus)
