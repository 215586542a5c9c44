"""How far sleeves are from what the response over time does not know: stops that close or open,
and friction that gives way."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.preload.arrangement import SHAFT
from rotordyn.scene.scene import Scene

LEAST = 1e-9  # N


def sleeve_margins(scene: Scene, held: Array, moved: Array) -> dict[str, Array]:
    """``stop_gap`` and ``holding`` of the result (s, sleeves), of sleeves that are displaced along
    the axis by ``moved`` (s, t, sleeves) against ``held`` (s, sleeves) [N/m]."""
    none = np.full((len(moved), moved.shape[-1]), np.nan)
    if not scene.spindle.sleeves or not scene.spindle.seats:
        return {"stop_gap": none, "holding": none}
    state, rows = scene.preload, scene.bearing_row[scene.usable]
    outward = state.network.arrangement.direction[SHAFT + 1 :] * moved  # away from the stop
    least, most = (np.nan_to_num(find(outward, axis=1)) for find in (np.nanmin, np.nanmax))
    stands = state.stopped[rows]
    has_stop = np.isfinite(state.limit[SHAFT + 1 :])
    rubs = state.rubs[SHAFT + 1 :] > 0.0
    push = held * np.maximum(most, -least)  # either way
    of_stop = np.maximum(held * most, 0.0) / np.maximum(state.stop_force[rows], LEAST)
    friction = np.abs(state.friction_force[rows])
    of_friction = (friction + push) / np.maximum(state.rubs[SHAFT + 1 :], LEAST)
    return {
        "stop_gap": np.where(has_stop & ~stands, state.stop_gaps()[rows] + least, np.nan),
        "holding": np.where(rubs, of_friction, np.where(stands, of_stop, np.nan)),
    }
