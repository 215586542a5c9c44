"""End stops over time, and how far sleeves are from what the response does not know: stops that
stay as they are, and friction that gives way."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.time_response.equation import Equation
from rotordyn.arrays import Array
from rotordyn.preload.arrangement import SHAFT
from rotordyn.scene.scene import Scene

LEAST = 1e-9  # N


def sleeve_margins(scene: Scene, equation: Equation, moved: Array) -> dict[str, Array]:
    """The fields of the result about sleeves that are displaced along the axis by ``moved``
    (s, t, sleeves)."""
    none = np.full((len(moved), moved.shape[-1]), np.nan)
    names = "stop_gap", "stop_force", "holding"
    if not scene.spindle.sleeves or not scene.spindle.seats:
        return {"gap": np.full(moved.shape, np.nan), **dict.fromkeys(names, none)}
    state, rows, stops = scene.preload, scene.bearing_row[scene.usable], equation.stops
    outward = state.network.arrangement.direction[SHAFT + 1 :] * moved  # away from the stop
    least, most = (np.nan_to_num(find(outward, axis=1)) for find in (np.nanmin, np.nanmax))
    stands, acts = state.stopped[rows] & ~stops.act, stops.act
    has_stop = np.isfinite(state.limit[SHAFT + 1 :])
    begun = np.where(acts, stops.gap, np.where(has_stop & ~stands, state.stop_gaps()[rows], np.nan))
    gap = begun + least
    rubs = state.rubs[SHAFT + 1 :] > 0.0
    push = equation.held * np.maximum(most, -least)  # either way
    of_stop = np.maximum(equation.held * most, 0.0) / np.maximum(state.stop_force[rows], LEAST)
    friction = np.abs(state.friction_force[rows])
    of_friction = (friction + push) / np.maximum(state.rubs[SHAFT + 1 :], LEAST)
    return {
        "gap": begun[:, None] + outward,
        "stop_gap": gap,
        "stop_force": np.where(acts, stops.stiffness * np.maximum(-gap, 0.0), np.nan),
        "holding": np.where(rubs, of_friction, np.where(stands, of_stop, np.nan)),
    }
