"""Speeds that a spindle passes on its way to another speed, whatever speeds a case lists.

Friction remembers where the forces on a sleeve turned. Growth, shortening and the loads of balls go
with Ω²; temperatures that depend on the speed do not, so that together they may turn between two
speeds of a case. The way therefore leads through speeds of its own, close enough to meet the turn.

Theory: docs/theory/network.md#friction-in-all-analyses.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures

# m/s, of Ω dm: between two of them a ring's growth ρ v² r/E is a few nm from a straight line
SPACING = 5.0


def passed_speeds(spindle: Spindle, top: float, temperatures: Temperatures | None) -> Array:
    """Return the speeds to pass up to ``top`` [rad/s], ascending: those of the temperatures, and
    evenly spaced ones; none at constant temperatures, where a straight way turns nowhere."""
    tabled = np.array(() if temperatures is None else temperatures.speeds)
    if not tabled.size:
        return tabled
    return np.union1d(evenly_spaced(spindle, top), tabled[(tabled > 0.0) & (tabled <= top)])


def evenly_spaced(spindle: Spindle, top: float) -> Array:
    """Return the evenly spaced speeds up to ``top`` [rad/s], closer for larger bearings."""
    step = SPACING / max(seat.bearing.pitch_diameter for seat in spindle.seats)
    return np.asarray(step * np.arange(1, int(top / step) + 1))
