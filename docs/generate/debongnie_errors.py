"""Errors of Debongnie's approximation, compared with rings solved ball by ball."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearings.debongnie import distribution, power_law
from tests.oracles.radial_ring import ball_loads, displacement, positions

Array = NDArray[np.float64]
RATIOS = 0.5 * 4.0 ** np.linspace(0.0, 1.0, 9)  # ki/ke
SHARES = np.linspace(0.1, 0.9, 33)  # δc/δr of the approximation
BALLS = tuple(range(7, 17))
CONTINUOUS = 360  # balls whose sum is the integral around the ring, to 1e-4


@dataclass(frozen=True)
class Errors:
    """Relative errors of the approximation under the same load, shape (ki/ke, δc/δr).

    ``displacement``: of δr, at the worse of two positions of the ball set: a ball in line with the
    load, or the middle between two balls. ``inner`` and ``outer``: of the largest ball load on
    either race, over both positions. ``in_zone``: mean number of balls in the load zone.
    """

    displacement: Array
    inner: Array
    outer: Array
    in_zone: Array


def errors(balls: int, ratios: ArrayLike = RATIOS, shares: ArrayLike = SHARES) -> Errors:
    """Errors for a ring of ``balls``; of ``CONTINUOUS`` balls: of the power law alone."""
    ratio, share = np.meshgrid(np.asarray(ratios), np.asarray(shares), indexing="ij")
    around = distribution(1.0 / share - 1.0, power_law(ratio))
    force = balls * around.radial
    off, largest = np.zeros_like(share), np.zeros_like(share)
    for between in (False, True):
        angles = positions(balls, between)
        exact = displacement(force, ratio, angles)
        here = 1.0 / share / exact - 1.0
        off = np.where(np.abs(here) > np.abs(off), here, off)
        largest = np.maximum(largest, ball_loads(exact, ratio, angles).max(axis=-1))
    peak = around.inner_peak
    outer = (1.0 + peak) / (1.0 + largest) - 1.0
    return Errors(off, peak / largest - 1.0, outer, balls * around.zone / np.pi)
