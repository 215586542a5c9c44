"""Solving one bearing: single calls and batches, through the public interface."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from bearings.state import BearingState

Array = NDArray[np.float64]
BATCH = 1000
SPEED = 24000.0 * math.pi / 30.0
VEX70 = rotordyn.load(Path(__file__).parents[1] / "cases" / "vex70.yaml").bearing
assert VEX70 is not None


def measure_bearing() -> list[dict[str, Any]]:
    """Cost and residual of every kind of call, hybrid kinematics at 24 000 rpm."""
    loads = _loads()
    states = VEX70.equilibrium(load=loads, speed=SPEED)
    kept = states.outcome == ""
    loads, moves = loads[kept], states.displacement[kept]
    axial = np.zeros_like(loads)
    axial[:, 0] = loads[:, 0]
    return [
        _case("load → displacement, one, axial", lambda: _from_load(axial[0]), axial[0]),
        _case("load → displacement, one, general", lambda: _from_load(loads[0]), loads[0]),
        _case("displacement → load, one, general", lambda: _from_move(moves[0]), loads[0]),
        _case("load → displacement, batch, axial", lambda: _from_load(axial), axial),
        _case("load → displacement, batch, general", lambda: _from_load(loads), loads),
        _case("displacement → load, batch, general", lambda: _from_move(moves), loads),
    ]


def _loads() -> Array:
    draw = np.random.default_rng(70)
    thrust = draw.uniform(800.0, 4000.0, BATCH)
    side = draw.uniform(-0.25, 0.25, (BATCH, 2)) * thrust[:, None]
    return np.column_stack([thrust, side, draw.uniform(-5.0, 5.0, (BATCH, 2))])


def _from_load(load: Array) -> BearingState:
    return VEX70.equilibrium(load=load, speed=SPEED)


def _from_move(displacement: Array) -> BearingState:
    return VEX70.equilibrium(displacement=displacement, speed=SPEED)


def _case(name: str, solve: Callable[[], BearingState], asked: Array) -> dict[str, Any]:
    """µs per state and per ball (median of five), largest miss of the load over the load."""
    state, states = solve(), asked.size // 5
    if (state.outcome != "").any():
        raise ValueError(f"{name}: {state.outcome}")
    seconds = median(_seconds(solve) for _ in range(5))
    lever = np.array([1.0, 1.0, 1.0, *[2.0 / VEX70.pitch_diameter] * 2])
    carried = _from_move(state.displacement).load  # solved anew: what the displacement really gives
    miss = np.abs((carried - asked) * lever).max(axis=-1)
    return {
        "name": name,
        "states": states,
        "state": 1e6 * seconds / states,
        "ball": 1e6 * seconds / states / VEX70.balls,
        "error": float((miss / np.abs(asked * lever).max(axis=-1)).max()),
    }


def _seconds(work: Callable[[], Any]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin
