"""Gaps and forces of end stops over time, and margins of sleeves to stops and to sliding.

The response neglects that other stops may close or open, and sliding against dry friction.
"""

from __future__ import annotations

import numpy as np

from rotordyn.analyses.time_response.equation import Equation
from rotordyn.arrays import Array
from rotordyn.preload.arrangement import SHAFT
from rotordyn.scene.scene import Scene

LEAST = 1e-9  # N, a divisor that avoids division by 0


def sleeve_margins(
    scene: Scene, equation: Equation, moved: Array, fine: Array, coarser: Array
) -> dict[str, Array]:
    """Return the fields of the result about sleeves that are displaced along the axis by ``moved``
    (s, t, sleeves) at the instants of the result, by ``fine`` at more instants, and by ``coarser``
    in a run with half the steps."""
    none = np.full((len(moved), moved.shape[-1]), np.nan)
    names = "stop_gap", "stop_force", "stop_error", "holding"
    if not scene.spindle.sleeves or not scene.spindle.seats:
        return {"gap": np.full(moved.shape, np.nan), **dict.fromkeys(names, none)}
    state, rows, stops = scene.preload, scene.bearing_row[scene.usable], equation.stops
    sign = state.network.arrangement.direction[SHAFT + 1 :]  # away from the stop
    least, most, coarse_least = _least(sign * fine), -_least(-sign * fine), _least(sign * coarser)
    closed, acts = state.stopped[rows] & ~stops.act, stops.act
    has_stop = np.isfinite(state.limit[SHAFT + 1 :])
    start = np.where(acts, stops.gap, np.where(has_stop & ~closed, state.stop_gaps()[rows], np.nan))
    gap = start + least
    rubs = state.rubs[SHAFT + 1 :] > 0.0
    stop_ratio = np.maximum(equation.held * most, 0.0) / np.maximum(state.stop_force[rows], LEAST)
    friction = sign * state.friction_force[rows]  # which takes all forces of the motion
    friction_ratio = np.maximum(friction - equation.held * least, equation.held * most - friction)
    friction_ratio /= np.maximum(state.rubs[SHAFT + 1 :], LEAST)
    force, coarse = (
        np.where(acts, stops.stiffness * np.maximum(-value, 0.0), np.nan)
        for value in (gap, start + coarse_least)
    )
    return {
        "gap": start[:, None] + sign * moved,
        "stop_gap": gap,
        "stop_force": force,
        "stop_error": np.abs(force - coarse) / np.maximum(np.maximum(force, coarse), LEAST),
        "holding": np.where(rubs, friction_ratio, np.where(closed, stop_ratio, np.nan)),
    }


def _least(values: Array) -> Array:
    """Return the least of values (s, t, k) over time (s, k), by a parabola through three values."""
    finite = np.where(np.isfinite(values), values, np.inf)
    at = np.clip(finite.argmin(axis=1)[:, None], 1, finite.shape[1] - 2)
    before, centre, after = (np.take_along_axis(finite, at + k, 1)[:, 0] for k in (-1, 0, 1))
    with np.errstate(invalid="ignore"):  # next to the end of the motion
        slope, curvature = 0.5 * (after - before), before - 2.0 * centre + after
        vertex = centre - 0.5 * slope**2 / np.where(curvature > 0.0, curvature, np.inf)
    least = finite.min(axis=1)
    inside = np.isfinite(vertex) & (centre == least) & (np.abs(slope) < curvature)
    return np.where(np.isfinite(least), np.where(inside, vertex, least), 0.0)
