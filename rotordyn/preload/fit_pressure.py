"""Pressure between rings and their seats: what is left of fits at speed and temperature."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.growth import inner_fit, inner_ring, outer_fit, outer_ring


def fit_pressure(
    spindle: Spindle, speed: Array, temperatures: Temperatures | None = None
) -> tuple[Array, Array]:
    """Return the pressure of every inner ring on the shaft and of every outer ring in its housing
    at ``speed`` [rad/s], 0 where it is loose (speeds, seats) [Pa].

    NaN for a ring that has no fit, or one that does not press as mounted.
    """
    inner, outer = np.full((2, len(speed), len(spindle.seats)), np.nan)
    rest = np.zeros(1)
    for k, seat in enumerate(spindle.seats):
        if inner_fit(seat) is not None and inner_ring(spindle, seat, rest)[0][1].holds.all():
            for rows, state in inner_ring(spindle, seat, speed, temperatures):
                inner[rows, k] = state.pressure[:, 0]
        if outer_fit(seat) is not None and outer_ring(seat, rest)[0][1].holds.all():
            for rows, state in outer_ring(seat, speed, temperatures):
                outer[rows, k] = state.pressure[:, 0]
    return inner, outer
