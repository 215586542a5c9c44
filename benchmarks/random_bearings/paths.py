"""Refused and solved states against the path itself, followed by pseudo-arclength."""

from __future__ import annotations

import time
from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.random_bearings.balls import draw_balls, solve_balls
from benchmarks.random_bearings.rings import Asked, draw_states
from tests.oracles.blend_path import Blend, Path, follow

Array = NDArray[np.float64]
NONE = np.zeros(5, dtype=bool)
ENDED = ("fold", "jump", "lifted")  # reasons why a path has no physical end
SAME = 1e-5  # of the deflection
FROM = 10_000  # separate bearings, so that the sets of the other surveys remain unchanged


def survey_ball_paths(refused: int, solved: int, *, each: int = 3) -> dict[str, Any]:
    """Some refused and as many solved balls, at most ``each`` of one bearing."""
    tally, odd, number = Counter(), [], FROM
    begin = time.process_time()
    while tally["refused"] < refused or tally["solved"] < solved:
        drawn, centre, speed = draw_balls(number)
        state = solve_balls(drawn, centre, speed)
        for index in _some(state.outcome, speed, tally, (refused, solved), each):
            path = ball_path(drawn.equations, centre[:, index : index + 1], speed[index])
            there = bool(state.outcome[index] == "")
            same = _same(path, state.ball_centre[:, index, :1], drawn.equations, speed[index])
            odd += _compared(tally, path, there, same, (number, int(index), drawn.kinematics))
        number += 1
    return {**tally, "odd": odd, "seconds": time.process_time() - begin}


def survey_ring_paths(refused: int, solved: int, *, each: int = 2) -> dict[str, Any]:
    """The same for whole bearings."""
    tally, odd, number = Counter(), [], FROM
    begin = time.process_time()
    while tally["refused"] < refused or tally["solved"] < solved:
        asked = draw_states(number)
        if asked.drawn.bearing.balls <= 30:
            state = asked.solve()
            for index in _some(state.outcome, asked.speed, tally, (refused, solved), each):
                path = ring_path(asked, index)
                there = bool(state.outcome[index] == "")
                same = _same(
                    path, state.ball_centre[:, index], asked.drawn.equations, asked.speed[index]
                )
                name = (number, int(index), asked.drawn.kinematics)
                odd += _compared(tally, path, there, same, name)
        number += 1
    return {**tally, "odd": odd, "seconds": time.process_time() - begin}


def ball_path(equations: Any, centre: Array, speed: float) -> Path:
    """The path of one ball, its groove centre (2, 1) held."""
    zero = np.zeros(5)
    return _followed(equations, lambda _: centre, float(speed), zero, NONE, zero)


def ring_path(asked: Asked, index: int) -> Path:
    """The path of one bearing state."""
    equations = asked.drawn.equations

    def centre(d: Array) -> Array:
        return equations.centres(d, asked.static[index], asked.growth[index])

    free = np.asarray(asked.free)
    d = np.where(free, 0.0, asked.displacement[index])
    return _followed(equations, centre, asked.speed[index], asked.load[index], free, d)


def _followed(*question: Any) -> Path:
    """In extended precision where rounding stops it, near a pole of the rolling relations."""
    path = follow(Blend(*question))
    return follow(Blend(*question, np.longdouble)) if path.end == "stuck" else path


def _some(
    outcome: NDArray[np.str_], speed: Array, tally: Counter[str], wanted: tuple[int, int], each: int
) -> list[int]:
    """States in rotation to follow: refused and solved ones, as far as more are needed."""
    chosen: list[int] = []
    turning = speed > 1e-3 * speed.max()
    for name, word, most in zip(("refused", "solved"), ("no equilibrium", ""), wanted, strict=True):
        there = np.flatnonzero((outcome == word) & turning)
        chosen += there[: min(each, max(most - tally[name], 0))].tolist()
    return chosen


def _same(path: Path, x: Array, equations: Any, speed: float) -> bool:
    if path.end != "arrived":
        return False
    load = equations.loads(path.x * 0.0 + 1.0, path.x, speed)["qo"].max()
    deep = (load / equations.outer.k) ** (2.0 / 3.0)
    return bool(np.abs(path.x - x).max() < SAME * deep)


def _compared(
    tally: Counter[str], path: Path, there: bool, same: bool, name: tuple[int, int, str]
) -> list[list[Any]]:
    """Counts; contradictions are returned for inspection."""
    group = "solved" if there else "refused"
    tally[group] += 1
    tally[f"{group}: {path.end}"] += 1
    agreed = (there and path.end == "arrived" and same) or (not there and path.end in ENDED)
    tally[f"{group}, agreed"] += int(agreed)
    return [] if agreed else [[*name, group, path.end, round(path.t, 6), same]]
