"""Single balls: inner groove centre and speed are given, the ball centre is sought."""

from __future__ import annotations

import time
from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from benchmarks.random_bearings.judged import OPEN, UNEQUAL, judged
from tests.oracles.ball_equations import Balls
from tests.oracles.plain_newton import kind_of_root, plain_newton
from tests.oracles.random_states import Drawn, draw_bearing, draw_centres, draw_speeds

Array = NDArray[np.float64]
EACH = 500
PLAIN = 5  # the plain iteration is tried on every fifth bearing
SEED = 1


def draw_balls(number: int, count: int = EACH) -> tuple[Drawn, Array, Array]:
    """A bearing, groove centres (2, count) and speeds of one ball."""
    rng = np.random.default_rng([SEED, number])
    drawn = draw_bearing(rng, number)
    return drawn, draw_centres(rng, drawn, count), draw_speeds(rng, drawn, count)


def solve_balls(drawn: Drawn, centre: Array, speed: Array) -> BearingState:
    """By the public interface: an axial displacement and a growth put the groove at its position;
    all balls of the ring are alike, and one of them is solved."""
    b, free = drawn.bearing, drawn.equations.li + drawn.equations.lo
    d = np.zeros((speed.size, 5))
    d[:, 0] = centre[0] - free * np.sin(b.contact_angle)
    growth = centre[1] - free * np.cos(b.contact_angle)
    return b.equilibrium(displacement=d, speed=speed, growth=growth, **drawn.how)


def survey_balls(count: int) -> dict[str, Any]:
    """Results of ``count`` balls."""
    tally: Counter[str] = Counter()
    plain = {name: Counter() for name in ("signed", "unsigned")}
    worst, solving, newton = np.zeros(2), 0.0, dict.fromkeys(plain, 0.0)
    for number in range(-(-count // EACH)):
        drawn, centre, speed = draw_balls(number)
        begin = time.process_time()
        state = solve_balls(drawn, centre, speed)
        solving += time.process_time() - begin
        worst = np.maximum(worst, _judged(tally, drawn, centre, state))
        for name in plain if number % PLAIN == 0 else ():
            begin = time.process_time()
            found = plain_newton(drawn.equations, centre, speed, signed=name == "signed")
            newton[name] += time.process_time() - begin
            plain[name].update(_compared(drawn.equations, state, *found))
    total = tally["states"]
    return {
        **tally,
        "worst": dict(zip(("force", "gap"), worst.tolist(), strict=True)),
        "microseconds": 1e6 * solving / total,
        "plain": {
            name: {**plain[name], "microseconds": 1e6 * newton[name] * PLAIN / total}
            for name in plain
        },
    }


def _judged(tally: Counter[str], drawn: Drawn, centre: Array, state: BearingState) -> Array:
    """Counts; the largest scaled residual force and the largest gap."""
    balls, good = drawn.equations, state.outcome == ""
    tally["states"] += good.size
    for word, times in zip(*np.unique(state.outcome, return_counts=True), strict=True):
        tally[str(word) or "solved"] += int(times)
    for word, times in zip(*np.unique(state.status[good, 0], return_counts=True), strict=True):
        tally[f"ball: {word}"] += int(times)
    tally[f"no equilibrium, {drawn.kinematics}"] += int((~good).sum())
    peak = np.maximum(state.inner_pressure, state.outer_pressure)[good, 0]
    tally["below 5 GPa"] += int((peak < 5e9).sum())
    tally["beyond 90°"] += int((np.abs(state.inner_angle[good, 0]) > 0.5 * np.pi).sum())
    found = judged(balls, state, np.flatnonzero(good), centre[:, good, None])
    fault, gap = np.abs(found.fault).max(axis=0)[:, 0], found.gap[:, 0]
    top = np.maximum(state.inner_load, state.outer_load)[good, 0]
    numbers = (state.load[good], state.ball_centre[:, good], top)
    tally["not finite"] += int(sum((~np.isfinite(v)).sum() for v in numbers))
    tally["tensile"] += int((state.inner_load[good] < 0.0).sum() + (top < 0.0).sum())
    scaled = fault / np.maximum(top, 1e-300)
    tally["residual above 1e-9"] += int((~(scaled <= UNEQUAL)).sum())
    tally["not closed"] += int((~(gap <= OPEN)).sum())
    return np.array([scaled.max(initial=0.0), gap.max(initial=0.0)])


def _compared(balls: Balls, state: BearingState, u: Array, done: NDArray[np.bool_]) -> Counter[str]:
    """Results of the plain iteration where a physical state of a loaded or lost ball exists."""
    status = state.status[:, 0]
    known = (state.outcome == "") & (status != "unloaded") & (state.speed > 0.0)
    lost = status[known] == "lost contact"
    word = kind_of_root(balls, u[:, known], state.ball_centre[:, known, 0], lost)
    word = np.where(done[known], word, "failed")
    counts: Counter[str] = Counter({"compared": int(known.sum())})
    for name, times in zip(*np.unique(word, return_counts=True), strict=True):
        counts[str(name)] += int(times)
    held = word[~lost]
    counts["compared, held"] += held.size
    counts["physical, held"] += int((held == "physical").sum())
    none = state.outcome == "no equilibrium"
    counts["no equilibrium"] += int(none.sum())
    counts["a root where none is physical"] += int(done[none].sum())
    return counts
