"""End stops over time, and how far sleeves are from what the response does not know: stops that
stay as they are, and friction that gives way."""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.time_response.equation import Equation
from rotordyn.arrays import Array
from rotordyn.preload.arrangement import SHAFT
from rotordyn.scene.scene import Scene

LEAST = 1e-9  # N


def sleeve_margins(
    scene: Scene, equation: Equation, moved: Array, fine: Array, coarser: Array
) -> dict[str, Array]:
    """The fields of the result about sleeves that are displaced along the axis by ``moved``
    (s, t, sleeves) at the instants of the result, by ``fine`` at more of them, and by ``coarser``
    in a run with half the steps."""
    none = np.full((len(moved), moved.shape[-1]), np.nan)
    names = "stop_gap", "stop_force", "stop_error", "holding"
    if not scene.spindle.sleeves or not scene.spindle.seats:
        return {"gap": np.full(moved.shape, np.nan), **dict.fromkeys(names, none)}
    state, rows, stops = scene.preload, scene.bearing_row[scene.usable], equation.stops
    way = state.network.arrangement.direction[SHAFT + 1 :]  # away from the stop
    least, most, before = _least(way * fine), -_least(-way * fine), _least(way * coarser)
    stands, acts = state.stopped[rows] & ~stops.act, stops.act
    has_stop = np.isfinite(state.limit[SHAFT + 1 :])
    begun = np.where(acts, stops.gap, np.where(has_stop & ~stands, state.stop_gaps()[rows], np.nan))
    gap = begun + least
    rubs = state.rubs[SHAFT + 1 :] > 0.0
    of_stop = np.maximum(equation.held * most, 0.0) / np.maximum(state.stop_force[rows], LEAST)
    friction = way * state.friction_force[rows]  # which takes all that the motion brings
    of_friction = np.maximum(friction - equation.held * least, equation.held * most - friction)
    of_friction /= np.maximum(state.rubs[SHAFT + 1 :], LEAST)
    force, other = (
        np.where(acts, stops.stiffness * np.maximum(-each, 0.0), np.nan)
        for each in (gap, begun + before)
    )
    return {
        "gap": begun[:, None] + way * moved,
        "stop_gap": gap,
        "stop_force": force,
        "stop_error": np.abs(force - other) / np.maximum(np.maximum(force, other), LEAST),
        "holding": np.where(rubs, of_friction, np.where(stands, of_stop, np.nan)),
    }


def _least(values: Array) -> Array:
    """Least of values (s, t, k) over time (s, k), between instants by a parabola of three."""
    known = np.where(np.isfinite(values), values, np.inf)
    at = np.clip(known.argmin(axis=1)[:, None], 1, known.shape[1] - 2)
    before, here, after = (np.take_along_axis(known, at + k, 1)[:, 0] for k in (-1, 0, 1))
    with np.errstate(invalid="ignore"):  # beside the end of an answer
        slope, bend = 0.5 * (after - before), before - 2.0 * here + after
        valley = here - 0.5 * slope**2 / np.where(bend > 0.0, bend, np.inf)
    least = known.min(axis=1)
    inside = np.isfinite(valley) & (here == least) & (np.abs(slope) < bend)
    return np.where(np.isfinite(least), np.where(inside, valley, least), 0.0)
