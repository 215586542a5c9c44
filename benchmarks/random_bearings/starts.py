"""The same solution from any start, and no jumps along sweeps of load and speed."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from benchmarks.random_bearings.rings import EACH, Asked, draw_states

Array = NDArray[np.float64]
FROM = 20_000  # separate bearings
SAME = 1e-6  # of the largest ball load
POINTS, FINE = 41, 32
VISIBLE = 1e-3  # of the largest ball load: smaller steps are not checked


def survey_starts(count: int) -> dict[str, Any]:
    """States solved cold and from the state of another load and speed."""
    tally, odd, number = Counter(), [], FROM
    begin = time.process_time()
    while tally["states"] < count:
        asked = draw_states(number)
        cold = asked.solve()
        warm = asked.solve(_rolled(cold))
        tally["states"] += EACH
        for index in np.flatnonzero(differing(cold, warm)):
            word = _difference(cold, warm, index)
            tally[f"{asked.drawn.kinematics}: {word}"] += 1
            tally["differing"] += 1
            odd.append([number, int(index), asked.drawn.kinematics, word])
        number += 1
    return {**tally, "odd": odd, "seconds": time.process_time() - begin}


def _rolled(state: BearingState) -> BearingState:
    """Every state at the place of the next one."""
    return replace(
        state,
        displacement=np.roll(state.displacement, 1, axis=0),
        outcome=np.roll(state.outcome, 1, axis=0),
        inner_load=np.roll(state.inner_load, 1, axis=0),
        ball_centre=np.roll(state.ball_centre, 1, axis=1),
    )


def differing(cold: BearingState, warm: BearingState) -> NDArray[np.bool_]:
    """Where outcome, a status or a ball load differ."""
    solved = (cold.outcome == "") & (warm.outcome == "")
    size = np.maximum(cold.outer_load.max(axis=-1), 1e-12)
    apart = np.abs(cold.inner_load - warm.inner_load).max(axis=-1) > SAME * size
    return (cold.outcome != warm.outcome) | (solved & apart)


def _difference(cold: BearingState, warm: BearingState, index: int) -> str:
    if cold.outcome[index] != warm.outcome[index]:
        return f"{cold.outcome[index] or 'solved'} cold, {warm.outcome[index] or 'solved'} warm"
    same = (cold.status[index] == warm.status[index]).all()
    return "another branch, same statuses" if same else "another branch, other statuses"


def survey_sweeps(count: int, friction: float | None = None) -> dict[str, Any]:
    """Sweeps of load and of speed, each state solved cold; steep intervals are refined."""
    tally, odd, number = Counter(), [], FROM
    begin = time.process_time()
    while tally["sweeps"] < count:
        asked = draw_states(number, 2, friction)
        if asked.kind == "load" and asked.speed[0] > 0.0:
            by = ("load", "speed")[tally["sweeps"] % 2]
            found = _jumps(asked, by)
            tally["sweeps"] += 1
            tally[f"sweeps of {by}"] += 1
            tally["with a refusal"] += int(found["refused"])
            tally["with a jump"] += int(bool(found["jumps"]))
            tally[f"with a jump, {asked.drawn.kinematics}"] += int(bool(found["jumps"]))
            odd += [[number, by, asked.drawn.kinematics, *jump] for jump in found["jumps"]]
        number += 1
    return {**tally, "odd": odd, "seconds": time.process_time() - begin}


def sweep(asked: Asked, by: str, part: Array) -> BearingState:
    """The first state with its load or speed multiplied by each ``part``."""
    count = len(part)
    first: dict[str, Any] = {
        name: np.repeat(getattr(asked, name)[:1], count, axis=0)
        for name in ("load", "displacement", "speed", "static", "growth")
    }
    scaled = (first[by].T * part).T
    return replace(asked, **first | {by: scaled}).solve()


def _jumps(asked: Asked, by: str) -> dict[str, Any]:
    """Intervals that stay steep however finely they are divided."""
    part = np.linspace(0.05, 1.0, POINTS)
    state = sweep(asked, by, part)
    step, size = _steps(state)
    around = np.fmax(np.append(step[1:], 0.0), np.append(0.0, step[:-1]))
    steep = np.flatnonzero((step > 2.0 * around) & (step > VISIBLE))
    jumps = []
    for k in steep:
        fine = sweep(asked, by, np.linspace(part[k], part[k + 1], FINE + 1))
        inner, _ = _steps(fine, size)
        most = float(np.nanmax(inner)) if np.isfinite(inner).any() else 0.0
        if most > 0.5 * step[k]:
            at = int(np.nanargmax(inner))
            flips = int((fine.status[at] != fine.status[at + 1]).sum())
            jumps.append([round(float(part[k]), 4), round(most, 4), flips])
    return {"jumps": jumps, "refused": (state.outcome != "").any()}


def _steps(state: BearingState, size: float | None = None) -> tuple[Array, float]:
    """Largest change of a ball load from each state to the next, over the largest of the sweep."""
    load = np.concatenate([state.inner_load, state.outer_load], axis=-1)
    if size is None:
        size = float(np.nanmax(load)) if np.isfinite(load).any() else 1.0
    return np.abs(np.diff(load, axis=0)).max(axis=-1) / size, size
