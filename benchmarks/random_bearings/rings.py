"""Whole bearings: by load, by displacement, and mixed; their tangents against differences."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.ring.operation import operation
from bearings.ring.request import solved
from bearings.ring.state import BearingState
from benchmarks.random_bearings.judged import OPEN, UNEQUAL, judged
from tests.oracles.random_states import (
    Drawn,
    draw_bearing,
    draw_displacements,
    draw_growth,
    draw_loads,
    draw_speeds,
)
from tests.oracles.wide_tangent import DIGITS, wide_tangent

Array = NDArray[np.float64]
EACH = 50
SEED = 2
TANGENT = 4  # the tangent is compared on every fourth bearing
KINDS = ("load", "load", "load", "displacement", "mixed")
FROM = 30_000  # separate bearings
FRICTION = 0.1
FADING = (
    "equal",
    "inner",
)  # with friction, a light ball loses contact continuously
OFF = 1e-6  # of the largest entry: a tangent with a larger error is checked further
FAR = 20.0  # steps of the difference: distance of a contact from opening or closing


@dataclass(frozen=True)
class Asked:
    """States of one bearing: which pairs are given by load, and all numbers."""

    drawn: Drawn
    kind: str
    free: NDArray[np.bool_]
    load: Array
    displacement: Array
    speed: Array
    static: Array
    growth: Array

    def solve(
        self, start: BearingState | None = None, *, compiled: bool | None = None
    ) -> BearingState:
        """All states in one call, also under thrust on the open side, which a bearing refuses."""
        points = operation(
            self.drawn.bearing.grooves,
            Law(**self.drawn.how),
            load=np.where(self.free, self.load, np.nan),
            displacement=np.where(self.free, np.nan, self.displacement),
            speed=self.speed,
            static_growth=self.static,
            growth=self.growth,
        )
        return solved(points, start, compiled)

    def only(self, row: int) -> Asked:
        """One of the states alone."""
        each = ("load", "displacement", "speed", "static", "growth")
        return replace(self, **{name: getattr(self, name)[[row]] for name in each})

    @property
    def lever(self) -> Array:
        """Lever that scales all five DOF to lengths."""
        half = 0.5 * self.drawn.bearing.pitch_diameter
        return np.array([1.0, 1.0, 1.0, half, half])


def draw_states(number: int, count: int = EACH, friction: float | None = None) -> Asked:
    """A bearing and its prescribed states."""
    rng = np.random.default_rng([SEED, number])
    drawn = replace(draw_bearing(rng, number), friction=friction)
    speed = draw_speeds(rng, drawn, count)
    static = draw_growth(rng, drawn, count) * (rng.uniform() < 0.5)
    growth = static + draw_growth(rng, drawn, count) * (rng.uniform() < 0.5)
    load, displacement = draw_loads(rng, drawn, count), draw_displacements(rng, drawn, count)
    kind = KINDS[rng.integers(len(KINDS))]
    by_load = {"load": 5, "displacement": 0}.get(kind, rng.integers(1, 5))
    free = rng.permutation(np.arange(5) < by_load)
    return Asked(drawn, kind, free, load, displacement, speed, static, growth)


def survey_rings(count: int) -> dict[str, Any]:
    """Results of ``count`` bearing states."""
    tally: Counter[str] = Counter()
    seconds: Counter[str] = Counter()
    worst: dict[str, float] = Counter()
    for number in range(-(-count // EACH)):
        asked = draw_states(number)
        begin = time.process_time()
        state = asked.solve()
        seconds[asked.kind] += time.process_time() - begin
        tally[f"asked by {asked.kind}"] += EACH
        good = np.flatnonzero(state.outcome == "")
        _counted(tally, asked, state)
        if not good.size:
            continue
        _balanced(tally, worst, asked, state, good)
        _symmetric(tally, worst, asked, state, good)
        if number % TANGENT == 0:
            begin = time.process_time()
            tangent_errors(tally, worst, asked, state, good)
            seconds["tangents"] += time.process_time() - begin
    times = {k: 1e6 * seconds[k] / max(tally[f"asked by {k}"], 1) for k in dict.fromkeys(KINDS)}
    return {
        **tally,
        "worst": dict(worst),
        "microseconds": times,
        "seconds of tangents": seconds["tangents"],
    }


def survey_friction(count: int) -> dict[str, Any]:
    """Refusals of ``count`` bearing states, with any friction and with a limited one."""
    tally: Counter[str] = Counter()
    for number in range(FROM, FROM + -(-count // EACH)):
        for word, mu in (("any", None), ("limited", FRICTION)):
            asked = draw_states(number, friction=mu)
            refused = int((asked.solve().outcome == "no equilibrium").sum())
            name = f"{word}, {asked.drawn.kinematics}"
            tally[name] += refused
            tally[f"{name}, share that fades"] += refused * (asked.drawn.sharing in FADING)
        tally["states"] += EACH
        tally[f"states, {asked.drawn.kinematics}"] += EACH
        tally[f"states, {asked.drawn.kinematics}, share that fades"] += EACH * (
            asked.drawn.sharing in FADING
        )
    return {"friction": FRICTION, **tally}


def _counted(tally: Counter[str], asked: Asked, state: BearingState) -> None:
    """Outcomes, statuses, pressures, impossible numbers."""
    good = state.outcome == ""
    tally["states"] += good.size
    for word, times in zip(*np.unique(state.outcome, return_counts=True), strict=True):
        tally[str(word) or "solved"] += int(times)
        if word:
            tally[f"{word}, {asked.drawn.kinematics}"] += int(times)
    for word, times in zip(*np.unique(state.status[good], return_counts=True), strict=True):
        tally[f"ball: {word}"] += int(times)
    peak = np.maximum(state.inner_pressure, state.outer_pressure)[good].max(axis=-1)
    tally["below 5 GPa"] += int((peak < 5e9).sum())
    held = state.inner_load[good] > 0.0
    wide = (np.abs(state.inner_angle[good]) > 0.5 * np.pi) & held
    tally["with a ball beyond 90°"] += int(wide.any(axis=-1).sum())
    numbers = (state.load, state.displacement, state.complete_stiffness, state.outer_load)
    tally["not finite"] += int(sum((~np.isfinite(v[good])).sum() for v in numbers))
    loads = np.minimum(state.inner_load, state.outer_load)[good]
    tally["tensile"] += int((loads < 0.0).sum())


def _balanced(
    tally: Counter[str],
    worst: dict[str, float],
    asked: Asked,
    state: BearingState,
    good: NDArray[np.intp],
) -> None:
    """Balls and ring by the independent equations."""
    balls = asked.drawn.equations
    centre = balls.centres(state.displacement[good], asked.static[good], asked.growth[good])
    found = judged(balls, state, good, centre)
    top = np.maximum(state.inner_load, state.outer_load)[good].max(axis=-1)
    want = np.where(asked.free, asked.load[good], state.load[good])
    kept = np.where(asked.free, state.displacement[good], asked.displacement[good])
    ring = np.abs((balls.ring_load(found.action) - want) / asked.lever).max(axis=-1)
    size = np.maximum(np.abs(want / asked.lever).max(axis=-1), top)
    some = top > 0.0
    ball = np.abs(found.fault).max(axis=(0, -1))
    for name, miss, unit in (("ball", ball, top), ("ring", ring, size)):
        scaled = miss[some] / unit[some]
        tally[f"{name} residual above 1e-9"] += int((~(scaled <= UNEQUAL)).sum())
        worst[name] = max(worst[name], float(scaled.max(initial=0.0)))
    tally["not as asked"] += int((kept != state.displacement[good]).any(axis=-1).sum())
    gap = found.gap.max(axis=-1)
    tally["not closed"] += int((~(gap <= OPEN)).sum())
    worst["gap"] = max(worst["gap"], float(gap.max()))


def _symmetric(
    tally: Counter[str],
    worst: dict[str, float],
    asked: Asked,
    state: BearingState,
    good: NDArray[np.intp],
) -> None:
    """Symmetry of K at rest."""
    rest = good[asked.speed[good] == 0.0]
    k = state.complete_stiffness[rest] / asked.lever / asked.lever[:, None]
    size = np.abs(k).max(axis=(1, 2))
    apart = np.abs(k - k.swapaxes(1, 2)).max(axis=(1, 2))[size > 0.0] / size[size > 0.0]
    tally["at rest"] += apart.size
    worst["asymmetry at rest"] = max(worst["asymmetry at rest"], float(apart.max(initial=0.0)))


def tangent_errors(
    tally: Counter[str],
    worst: dict[str, float],
    asked: Asked,
    state: BearingState,
    good: NDArray[np.intp],
) -> None:
    """Five-point differences of the solver, the best of five steps, away from contact loss.

    Where none of them agrees, differences of the independent equations in more digits decide.
    """
    top = state.inner_load[good].max(axis=-1)
    step = 3e-4 * (top / asked.drawn.equations.inner.k) ** (2.0 / 3.0)
    far = (_nearest(asked, state, good) > FAR * 8.0 * step) & (top > 0.0)
    chosen, step = good[far], step[far]
    if not chosen.size:
        return
    k = state.complete_stiffness[chosen] / asked.lever / asked.lever[:, None]
    size = np.abs(k).max(axis=(1, 2))
    error = np.full(chosen.size, np.inf)
    for factor in (1.0, 0.25, 4.0, 32.0, 256.0):  # large ones for weakly held balls
        todo = np.flatnonzero(~(error < OFF))
        if not todo.size:
            break
        slope = _differences(asked, state, chosen[todo], factor * step[todo])
        apart = np.abs(slope - k[todo]).max(axis=(1, 2)) / size[todo]
        error[todo] = np.fmin(error[todo], apart)
    rounded = np.flatnonzero(~(error < OFF)) if DIGITS else []
    for i in rounded:
        error[i] = np.abs(_wide(asked, state, chosen[i]) - k[i]).max() / size[i]
    tally["tangents"] += error.size
    tally["tangents decided in extended precision"] += len(rounded)
    tally["tangents off by more than 1e-6"] += int((~(error < OFF)).sum())
    worst["tangent"] = max(worst["tangent"], float(error.max()))


def _wide(asked: Asked, state: BearingState, index: int) -> Array:
    """∂f/∂d (5, 5) in extended precision, DOF as lengths; infinite where not found."""
    growth = asked.static[index], asked.growth[index]
    d, x = state.displacement[index], state.ball_centre[:, index]
    try:
        k = wide_tangent(asked.drawn.equations, d, x, asked.speed[index], growth)
    except ArithmeticError:
        return np.full((5, 5), np.inf)
    return np.asarray(k / asked.lever / asked.lever[:, None], dtype=float)


def _nearest(asked: Asked, state: BearingState, good: NDArray[np.intp]) -> Array:
    """How far the ball nearest to it is from gaining or losing its inner contact [m]."""
    balls = asked.drawn.equations
    a = balls.centres(state.displacement[good], asked.static[good], asked.growth[good])
    v = a - state.ball_centre[:, good]
    turning = np.hypot(*v) - balls.li
    resting = np.hypot(*a) - balls.li - balls.lo
    still = (state.centrifugal_force[good] == 0.0).all(axis=-1, keepdims=True)
    return np.asarray(np.abs(np.where(still, resting, turning)).min(axis=-1))


def _differences(asked: Asked, state: BearingState, chosen: NDArray[np.intp], step: Array) -> Array:
    """∂f/∂d (s, 5, 5), DOF as lengths; every point starts at the state itself."""
    factors = np.array([1.0, -1.0, 2.0, -2.0])
    moves = factors[:, None, None, None] * step[:, None] * np.eye(5)[:, None] / asked.lever
    points = state.displacement[chosen] + moves.reshape(20, chosen.size, 5)
    start = replace(
        state,
        displacement=np.broadcast_to(state.displacement[chosen], points.shape),
        outcome=np.broadcast_to(state.outcome[chosen], points.shape[:2]),
        inner_load=np.broadcast_to(state.inner_load[chosen], (20, *state.inner_load[chosen].shape)),
        ball_centre=np.broadcast_to(
            state.ball_centre[:, None, chosen], (2, 20, *state.inner_load[chosen].shape)
        ),
    )
    found = asked.drawn.bearing.equilibrium(
        displacement=points,
        speed=asked.speed[chosen],
        static_growth=asked.static[chosen],
        growth=asked.growth[chosen],
        start=start,
        **asked.drawn.how,
    )
    load = (found.load / asked.lever).reshape(4, 5, chosen.size, 5)
    slope = (8.0 * (load[0] - load[1]) - (load[2] - load[3])) / (12.0 * step[:, None])
    return slope.transpose(1, 2, 0)
