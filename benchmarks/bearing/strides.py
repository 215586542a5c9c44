"""How finely the path from the convex problem is followed: time against states that come out wrong.

States are those of the survey of random bearings in the upper half of its speeds. What is right is
said by strides of a fixed length, so fine that a four times finer one says the same.
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
class Strides:
    """What ``bearings.ring.tolerances`` calls by these names."""

    first: float = FIRST_BLEND
    turn: float = LONGEST_TURN
    shortest: float = SHORTEST_BLEND
    most: int = NEWTON_STEPS
    quick: int = QUICK_STEPS
    free: float = FIRST_FREE

    @contextmanager
    def used(self) -> Iterator[None]:
        """The solver strides so."""
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


def fixed(length: float) -> Strides:
    """Strides of one length, shortened only where they fail, never longer again."""
    return Strides(first=length, turn=0.05, shortest=2.0**-24, most=8, quick=-1, free=length)


VARIED: dict[str, dict[float, Strides]] = {
    "as shipped": {FIRST_BLEND: Strides()},
    "first stride": {v: Strides(first=v) for v in (1.0, 0.5, 0.25, 2.0**-4)},
    "longest turn [rad]": {v: Strides(turn=v) for v in (1.5, 0.6, 0.3, 0.15, 0.075, 0.0375, 0.02)},
    "most Newton steps": {v: Strides(most=v) for v in (8, 6, 5, 4)},
    "shortest stride": {
        v: Strides(shortest=v) for v in (0.5, 2.0**-3, 2.0**-5, 2.0**-9, 2.0**-17, 2.0**-25)
    },
    "fixed strides": {v: fixed(v) for v in (0.25, 2.0**-4)},
}
SMOOTH = ("hybrid", "outer")  # the others lose a contact with a jump


@dataclass(frozen=True)
class Judged:
    """States of a bearing and what the two finest strides find; ``sure`` where they agree."""

    asked: Asked
    true: BearingState
    sure: NDArray[np.bool_]


def measure_strides(bearings: int = 24, repeats: int = 2) -> dict[str, Any]:
    """How many states were judged, and a line per setting."""
    judged = [_judged(number) for number in range(bearings)]
    sure = sum(int(one.sure.sum()) for one in judged)
    exist = sum(int((one.sure & (one.true.outcome == "")).sum()) for one in judged)
    lines = [
        {"varied": name, "value": value, **_line(strides, judged, repeats, sure)}
        for name, settings in VARIED.items()
        for value, strides in settings.items()
    ]
    states = sum(one.sure.size for one in judged)
    return {"states": states, "sure": sure, "exist": exist, "lines": lines}


def fast_states(number: int) -> Asked:
    """A bearing and what is asked of it in the upper half of its speeds."""
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
    """Where both found the same state, or none."""
    apart = np.abs(one.ball_centre - other.ball_centre).max(axis=(0, -1))
    near = apart < SAME * asked.drawn.bearing.ball_diameter
    neither = (one.outcome != "") & (other.outcome != "")
    return np.where((one.outcome == "") & (other.outcome == ""), near, neither)


def _line(strides: Strides, judged: list[Judged], repeats: int, sure: int) -> dict[str, Any]:
    """µs per state, all bearings in turn; states refused, other, or found where none is, and how
    many of these are wrong without a jump in the hypothesis."""
    seconds, wrong = [], Counter[str]()
    for run in range(repeats):
        total = 0.0
        for one in judged:
            with strides.used():
                begin = time.perf_counter()
                found = one.asked.solve()
                total += time.perf_counter() - begin
            if run:
                continue
            there, is_true = found.outcome == "", one.true.outcome == ""
            missed = {
                "refused": one.sure & is_true & ~there,
                "invented": one.sure & ~is_true & there,
                "other": one.sure & is_true & there & ~_same(one.asked, found, one.true),
            }
            for word, which in missed.items():
                wrong[word] += int(which.sum())
                wrong["smooth"] += int(which.sum()) * (one.asked.drawn.kinematics in SMOOTH)
        seconds.append(total)
    states = sum(one.sure.size for one in judged)
    return {
        "state": 1e6 * min(seconds) / states,
        **{word: wrong[word] for word in ("refused", "other", "invented", "smooth")},
        "share": (wrong["refused"] + wrong["other"] + wrong["invented"]) / max(sure, 1),
    }
