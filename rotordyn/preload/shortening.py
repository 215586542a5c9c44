"""Axial shift of the bearing seats by the centrifugal shortening of the shaft."""

from __future__ import annotations

from collections.abc import Sequence

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
