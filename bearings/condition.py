"""What there is to say about each state of a batch, in a few words."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bearings.state import BearingState, Cause

Array = NDArray[np.float64]
PERMANENT = 4.2e9  # Pa: ISO 76, the pressure that leaves a ten-thousandth of the ball diameter
PARTS = 16  # of an interval of speed that are solved together
ROUNDS = 3
IMPOSSIBLE = 1.0  # Mg/D over the load of a race
GIVEN = ("displacement", "load and displacement", "load")
RPM = math.pi / 30.0


def conditions(state: BearingState) -> NDArray[np.str_]:
    """See ``BearingState.condition``."""
    balls = state.inner_load.shape[-1]
    pressure = np.maximum(state.inner_pressure, state.outer_pressure).reshape(-1, balls)
    angle = np.maximum(np.abs(state.inner_angle), np.abs(state.outer_angle)).reshape(-1, balls)
    angle = np.where(state.inner_load.reshape(-1, balls) > 0.0, angle, 0.0)
    status = state.status.reshape(-1, balls)
    slipping = state.slipping.reshape(-1, balls)
    words = []
    for k, outcome in enumerate(state.outcome.reshape(-1)):
        if outcome == "no equilibrium":
            words.append(f"{outcome}: {ending(state.cause, k)}")
        elif outcome:
            words.append(str(outcome))
        else:
            words.append("; ".join(_remarks(pressure[k], angle[k], status[k], slipping[k])))
    return np.array(words, dtype=str).reshape(state.outcome.shape)


def ending(cause: Cause, index: int) -> str:
    """Up to which speed there is a state of a question that has none, and what ends it."""
    asked = cause.question
    low, high = 0.0, float(asked.speed[index])
    for _ in range(ROUNDS):
        speeds = np.linspace(low, high, PARTS + 1)[1:-1]
        there = cause.solved(asked.repeated(index, speeds)).outcome == ""
        first = int(np.argmin(there)) if not there.all() else PARTS - 1
        ends = np.concatenate([[low], speeds, [high]])
        low, high = float(ends[first]), float(ends[first + 1])
    last = cause.solved(asked.repeated(index, np.array([low])))
    where = (
        f"above {low / RPM:.0f} rpm at this {GIVEN[int(asked.free.sum() > 0) + asked.free.all()]}"
    )
    load = np.minimum(last.inner_load, last.outer_load)[0]
    force = np.abs(last.gyroscopic_moment[0]) / cause.bearing.ball_diameter
    thrown = (load > 0.0) & (force > IMPOSSIBLE * load)
    if thrown.any():
        return f"balls {_ranges(thrown)} are thrown off a race {where}"
    return f"stiffness vanishes {where}"


def _remarks(
    pressure: Array, angle: Array, status: NDArray[np.str_], slipping: NDArray[np.str_]
) -> list[str]:
    """About a state that exists."""
    remarks = []
    if pressure.max() > PERMANENT:
        remarks.append(f"overloaded (pressure {pressure.max() / 1e9:.1f} GPa)")
    if (beyond := angle > math.pi / 2.0).any():
        remarks.append(f"beyond the groove (balls {_ranges(beyond)})")
    idle = (status == "lost contact") | (status == "unloaded")
    if idle.all():
        remarks.append("unloaded")
    elif idle.any():
        remarks.append(f"lost contact (balls {_ranges(idle)})")
    for race in ("inner", "outer", "both"):
        if (slipping == race).any():
            name = "both races" if race == "both" else f"{race} race"
            remarks.append(f"slips on the {name} (balls {_ranges(slipping == race)})")
    return remarks


def _ranges(chosen: NDArray[np.bool_]) -> str:
    """The numbers of the chosen balls: 0–3, 7."""
    numbers = np.flatnonzero(chosen)
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return ", ".join(f"{run[0]}" if len(run) == 1 else f"{run[0]}–{run[-1]}" for run in runs)
