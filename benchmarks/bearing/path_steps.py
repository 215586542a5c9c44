"""Step length along the path from the convex problem: time against wrong states.

States are those of the survey of random bearings in the upper half of its speeds. The reference has
steps of a fixed length; it is certain where steps of four times that length give the same.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any
from unittest import mock

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from bearings.ring.tolerances import (
    FIRST_BLEND,
    FIRST_FREE,
    LONGEST_TURN,
    NEWTON_STEPS,
    QUICK_STEPS,
    SHORTEST_BLEND,
)
from benchmarks.bearing.subject import solver
from benchmarks.random_bearings.rings import Asked, draw_states
from tests.oracles.random_states import HIGHEST

Array = NDArray[np.float64]
EACH = 50
SAME = 1e-5  # of the ball's diameter
FINE, FINER = 2.0**-5, 2.0**-7


@dataclass(frozen=True)
class PathSteps:
    """Constants of ``bearings.ring.tolerances`` by shorter names."""

    first: float = FIRST_BLEND
    turn: float = LONGEST_TURN
    shortest: float = SHORTEST_BLEND
    most: int = NEWTON_STEPS
    quick: int = QUICK_STEPS
    free: float = FIRST_FREE

    @contextmanager
    def used(self) -> Iterator[None]:
        """The solver uses these steps."""
        names = {
            "FIRST_BLEND": self.first,
            "LONGEST_TURN": self.turn,
            "SHORTEST_BLEND": self.shortest,
            "NEWTON_STEPS": self.most,
            "QUICK_STEPS": self.quick,
            "FIRST_FREE": self.free,
        }
        with solver(compiled=False), mock.patch.multiple("bearings.ring.tolerances", **names):
            yield


def fixed(length: float) -> PathSteps:
    """Steps of one length, shortened only where they fail, never lengthened again."""
    return PathSteps(first=length, turn=0.05, shortest=2.0**-24, most=8, quick=-1, free=length)


VARIED: dict[str, dict[float, PathSteps]] = {
    "default": {FIRST_BLEND: PathSteps()},
    "first path step": {v: PathSteps(first=v) for v in (1.0, 0.5, 0.25, 2.0**-4)},
    "largest rotation [rad]": {
        v: PathSteps(turn=v) for v in (1.5, 0.6, 0.3, 0.15, 0.075, 0.0375, 0.02)
    },
    "Newton steps allowed": {v: PathSteps(most=v) for v in (8, 6, 5, 4)},
    "shortest path step": {
        v: PathSteps(shortest=v) for v in (0.5, 2.0**-3, 2.0**-5, 2.0**-9, 2.0**-17, 2.0**-25)
    },
    "fixed path steps": {v: fixed(v) for v in (0.25, 2.0**-4)},
}
SMOOTH = ("hybrid", "outer")  # with the others contact is lost with a jump


@dataclass(frozen=True)
class Judged:
    """States of a bearing and the results of the two finest steps; ``certain`` where they agree."""

    asked: Asked
    true: BearingState
    certain: NDArray[np.bool_]


def measure_path_steps(bearings: int = 24, repeats: int = 2) -> dict[str, Any]:
    """How many states were judged, and a line per setting."""
    judged = [_judged(number) for number in range(bearings)]
    certain = sum(int(one.certain.sum()) for one in judged)
    exist = sum(int((one.certain & (one.true.outcome == "")).sum()) for one in judged)
    lines = [
        {"varied": name, "value": value, **_line(steps, judged, repeats, certain)}
        for name, settings in VARIED.items()
        for value, steps in settings.items()
    ]
    states = sum(one.certain.size for one in judged)
    return {"states": states, "certain": certain, "exist": exist, "lines": lines}


def fast_states(number: int) -> Asked:
    """A bearing and its prescribed states in the upper half of its speeds."""
    asked = draw_states(number, EACH)
    share = np.random.default_rng([3, number]).uniform(0.5, 1.0, EACH)
    return replace(asked, speed=HIGHEST / asked.drawn.bearing.pitch_diameter * share)


def _judged(number: int) -> Judged:
    asked, found = fast_states(number), []
    for length in (FINER, FINE):
        with fixed(length).used():
            found.append(asked.solve())
    return Judged(asked, found[0], _same(asked, *found))


def _same(asked: Asked, one: BearingState, other: BearingState) -> NDArray[np.bool_]:
    """Where both have the same state, or none."""
    apart = np.abs(one.ball_centre - other.ball_centre).max(axis=(0, -1))
    near = apart < SAME * asked.drawn.bearing.ball_diameter
    neither = (one.outcome != "") & (other.outcome != "")
    return np.where((one.outcome == "") & (other.outcome == ""), near, neither)


def _line(steps: PathSteps, judged: list[Judged], repeats: int, certain: int) -> dict[str, Any]:
    """µs per state, all bearings in turn; states refused, other, or found where none exists, and
    the number of these under hypotheses without a jump."""
    seconds, wrong = [], Counter[str]()
    for run in range(repeats):
        total = 0.0
        for one in judged:
            with steps.used():
                begin = time.perf_counter()
                found = one.asked.solve()
                total += time.perf_counter() - begin
            if run:
                continue
            there, is_true = found.outcome == "", one.true.outcome == ""
            missed = {
                "refused": one.certain & is_true & ~there,
                "spurious": one.certain & ~is_true & there,
                "other": one.certain & is_true & there & ~_same(one.asked, found, one.true),
            }
            for word, which in missed.items():
                wrong[word] += int(which.sum())
                wrong["smooth"] += int(which.sum()) * (one.asked.drawn.kinematics in SMOOTH)
        seconds.append(total)
    states = sum(one.certain.size for one in judged)
    return {
        "state": 1e6 * min(seconds) / states,
        **{word: wrong[word] for word in ("refused", "other", "spurious", "smooth")},
        "share": (wrong["refused"] + wrong["other"] + wrong["spurious"]) / max(certain, 1),
    }
