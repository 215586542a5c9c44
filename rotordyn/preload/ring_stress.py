"""Stress of inner rings under their fits."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.growth import inner_fit, inner_ring

YIELD = 1.5e9  # Pa, of hardened bearing steel with little margin


def ring_stress(spindle: Spindle, speed: Array, temperatures: Temperatures | None = None) -> Array:
    """Return the Tresca stress, hoop stress plus pressure at the bore, of every fitted inner ring
    that rotates at ``speed`` [rad/s], NaN without a fit (speeds, seats) [Pa]."""
    stress = np.full((len(speed), len(spindle.seats)), np.nan)
    for k, seat in enumerate(spindle.seats):
        fit = inner_fit(seat)
        if fit is None:
            continue
        for rows, state in inner_ring(spindle, seat, speed, temperatures):
            stress[rows, k] = state.hoop_stress(fit.radius) + state.pressure[:, 0]
    return stress
