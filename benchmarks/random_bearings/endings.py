"""The speed reported with a refusal, against a fine scan of all speeds below the requested one."""

from __future__ import annotations

import time
from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ring.condition import first_gaps
from bearings.ring.request import solved
from bearings.ring.spin_up import Gap
from bearings.ring.state import BearingState
from benchmarks.random_bearings.rings import draw_states

FINE = 1000  # speeds
EACH = 2  # refusals of a bearing
MOST_BALLS = 30
RARE = 4  # one in four of the bearings with hybrid and outer kinematics is checked


def survey_endings(count: int) -> dict[str, Any]:
    """Speeds reported with ``count`` refusals, mostly of kinematics with jumps."""
    tally: Counter[str] = Counter()
    odd: list[list[Any]] = []
    seconds, number = 0.0, 0
    while tally["refusals"] < count:
        asked = draw_states(number)
        smooth = asked.drawn.kinematics in ("hybrid", "outer")
        if asked.drawn.bearing.balls <= MOST_BALLS and not (smooth and number // 4 % RARE):
            state = asked.solve()
            refused = np.flatnonzero(state.outcome == "no equilibrium")[:EACH]
            refused = refused[: count - tally["refusals"]]
            if refused.size:
                begin = time.process_time()
                gaps = first_gaps(state.operation, refused)
                seconds += time.process_time() - begin
                for index, gap in zip(refused, gaps, strict=True):
                    word = _compared(tally, state, int(index), gap)
                    odd += [[number, int(index), asked.drawn.kinematics, *word]] if word else []
        number += 1
    return {**tally, "odd": odd, "milliseconds": 1e3 * seconds / count}


def _compared(tally: Counter[str], state: BearingState, index: int, gap: Gap) -> list[str]:
    """Counts; errors are returned in words."""
    speed = float(state.speed[index]) * np.arange(1, FINE + 1) / FINE
    there = _there(state, index, speed)
    above = bool(there[speed > gap.low].any())
    tally["refusals"] += 1
    tally[f"refusals, {state.operation.law.kinematics}"] += 1
    tally["states at all speeds below"] += int(there[speed <= gap.low].all())
    tally["states again above"] += int(above)
    tally["states again above, reported"] += int(above and gap.again is not None)
    words = []
    if not there[speed <= gap.low].all():
        words.append("none at a speed below the reported one")
    if above and gap.again is None:
        words.append("states again that are not reported")
    return words


def _there(state: BearingState, index: int, speed: NDArray[np.float64]) -> NDArray[np.bool_]:
    return solved(state.operation.repeated(index, speed)).outcome == ""
