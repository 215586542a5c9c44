"""Defect frequencies of the bearings of a spindle over speed."""

from __future__ import annotations

import math

import numpy as np

from rotordyn.arrays import Array
from rotordyn.scene.scene import Scene


def passing(scene: Scene, wanted: tuple[str, ...]) -> tuple[tuple[str, ...], Array]:
    """Return names and frequencies (speeds, names) [Hz] of the defects ``wanted``; identical
    bearings share a name."""
    if not wanted:
        return (), np.zeros((len(scene.speed), 0))
    from bearings.life import frequencies

    names: dict[tuple[int, int], list[str]] = {}
    orders = {}
    for seat, (state, column) in zip(scene.spindle.seats, scene.preload.seat_states(), strict=True):
        names.setdefault((id(state), column), []).append(seat.name)
        orders[id(state)] = frequencies(state)
    solved = np.array([reason == "" for reason in scene.outcome])
    hertz = np.where(solved, scene.speed, np.nan) / (2.0 * math.pi)
    rates = {
        f"{which} {', '.join(seats)}": getattr(orders[key], which)[scene.bearing_row, column]
        * hertz
        for which in wanted
        for (key, column), seats in names.items()
    }
    return tuple(rates), np.stack([*rates.values()], axis=1)
