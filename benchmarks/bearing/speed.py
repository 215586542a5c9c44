"""All ways to compute a bearing's state, here and by SciPy, against a reference of more digits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings import AngularContactBallBearing, Follower
from bearings.ring.state import BearingState
from benchmarks.bearing.plain import PlainBearing
from benchmarks.bearing.reference import Reference, largest
from benchmarks.bearing.subject import (
    LOAD,
    SPEED,
    VEX70,
    States,
    random_states,
    solver,
    sweep_states,
)
from benchmarks.bearing.timing import fastest

Array = NDArray[np.float64]
Answer = tuple[Array, Array, Array | None]  # load, displacement, K of some states
APART = 1e-3  # µm
JUDGED = 10  # states of a batch
NEAR = 0.99  # of the load: where a warm start comes from
ONE_LOAD, ONE_SHIFT, SWEEP, BATCH = (
    "one displacement → load, K",
    "one load → displacement, K",
    "sweep",
    "batch, cold",
)


@dataclass(frozen=True)
class Way:
    """``work`` computes and returns the result; ``target`` [µs] per state or per ball."""

    task: str
    name: str
    states: States
    work: Callable[[], Answer]
    target: tuple[float, str] | None = None
    by_load: bool = False


class Subject:
    """The one state, its neighbour that warm starts come from, and the batches."""

    def __init__(self, count: int) -> None:
        self.bearing: AngularContactBallBearing = VEX70
        self.sweep, self.batch = sweep_states(count), random_states(count)
        self.plain = PlainBearing(self.bearing, SPEED)
        with solver(compiled=False):
            self.here = self.bearing.equilibrium(load=LOAD, speed=SPEED)
            self.near = self.bearing.equilibrium(load=NEAR * LOAD, speed=SPEED)

    @cached_property
    def one(self) -> States:
        """The one state."""
        return States(LOAD[None], self.here.displacement[None], np.array([SPEED]))

    @cached_property
    def lever(self) -> Array:
        """Lever that converts moments to forces."""
        return np.array([1.0, 1.0, 1.0, *[1.0 / self.plain.radius] * 2])

    @cached_property
    def start(self) -> Array:
        """The neighbour's ball unknowns."""
        centres = self.plain.centres(self.near.displacement)
        return self.plain.unknowns(*centres, *self.near.ball_centre)


def measure_speed(count: int = 1000, repeats: int = 7) -> list[dict[str, Any]]:
    """µs per state and per ball, errors of load or displacement and of K, and targets."""
    subject = Subject(count)
    lines = []
    for way in [*_single(subject), *_many(subject), *_scipy(subject)]:
        seconds = fastest(way.work, repeats)
        lines.append({**_line(way, subject, seconds), **_errors(way, subject)})
    order = (ONE_LOAD, ONE_SHIFT, SWEEP, BATCH)
    return sorted(lines, key=lambda line: order.index(line["task"]))


def lost_from_unloaded() -> int:
    """Balls for which ``fsolve`` from the unloaded geometry does not converge to the true state."""
    subject = Subject(1)
    plain, here = subject.plain, subject.here
    found = plain.settled(here.displacement, plain.unloaded())[1]
    known = plain.unknowns(*plain.centres(here.displacement), *here.ball_centre)
    return int((np.abs(found - known).max(axis=1) > APART).sum())


def _line(way: Way, subject: Subject, seconds: float) -> dict[str, Any]:
    each = 1e6 * seconds / len(way.states.load)
    limit, unit = way.target or (None, None)
    return {
        "task": way.task,
        "way": way.name,
        "states": len(way.states.load),
        "state": each,
        "ball": each / subject.bearing.balls,
        "target": limit,
        "per": unit,
    }


def _state(found: BearingState) -> Answer:
    return found.load, found.displacement, found.stiffness()


def _asked(subject: Subject, *, by_load: bool, compiled: bool, warm: bool) -> Answer:
    here = subject.here
    given: Any = {"load": LOAD} if by_load else {"displacement": here.displacement}
    start = subject.near if warm else None
    return _state(subject.bearing.equilibrium(speed=SPEED, start=start, compiled=compiled, **given))


def _single(subject: Subject) -> Iterator[Way]:
    """One state; followers alternate between two neighbouring states, half of a pair is a state."""
    follower, here, near = (
        Follower(subject.bearing, speed=SPEED),
        subject.here.displacement,
        subject.near.displacement,
    )

    def moved() -> Answer:
        follower.load(near)
        return follower.load(here)

    def loaded() -> Answer:
        follower.displacement(NEAR * LOAD)
        return follower.displacement(LOAD)

    pair = States(*(np.repeat(part, 2, axis=0) for part in _parts(subject.one)))
    yield Way(ONE_LOAD, "`Follower.load`, warm", pair, lambda: _named(moved()), (60.0, "state"))
    yield Way(
        ONE_SHIFT,
        "`Follower.displacement`, warm",
        pair,
        lambda: _named(loaded()),
        (300.0, "state"),
        by_load=True,
    )
    for by_load, task in ((False, ONE_LOAD), (True, ONE_SHIFT)):
        for compiled in (True, False):
            for warm in (True, False):
                name = f"`equilibrium`, {_how(compiled)}, {'warm' if warm else 'cold'}"
                how = dict(by_load=by_load, compiled=compiled, warm=warm)
                yield Way(task, name, subject.one, _bound(subject, how), by_load=by_load)


def _bound(subject: Subject, how: dict[str, bool]) -> Callable[[], Answer]:
    return lambda: _asked(subject, **how)


def _how(compiled: bool) -> str:
    return "compiled" if compiled else "numpy"


def _parts(states: States) -> tuple[Array, Array, Array]:
    return states.load, states.displacement, states.speed


def _named(found: Any) -> Answer:
    return found.load, found.displacement, found.stiffness


def _many(subject: Subject) -> Iterator[Way]:
    bearing, sweep, batch = subject.bearing, subject.sweep, subject.batch
    follower = Follower(bearing, speed=SPEED)
    target = (1.0, "ball")
    yield Way(
        SWEEP,
        "`Follower.load`",
        sweep,
        lambda: _named(follower.load(sweep.displacement, sweep.speed)),
        target,
    )
    yield Way(
        SWEEP,
        "`Follower.displacement`",
        sweep,
        lambda: _named(follower.displacement(sweep.load, sweep.speed)),
        target,
        by_load=True,
    )
    for compiled in (True, False):
        limit = None if compiled else (6.0, "ball")
        for by_load in (False, True):
            what = "load → displacement" if by_load else "displacement → load"
            work = _batched(bearing, batch, by_load=by_load, compiled=compiled)
            yield Way(
                BATCH, f"`equilibrium`, {_how(compiled)}, {what}", batch, work, limit, by_load
            )


def _batched(
    bearing: AngularContactBallBearing, states: States, *, by_load: bool, compiled: bool
) -> Callable[[], Answer]:
    given: Any = {"load": states.load} if by_load else {"displacement": states.displacement}
    return lambda: _state(bearing.equilibrium(speed=states.speed, compiled=compiled, **given))


def _scipy(subject: Subject) -> Iterator[Way]:
    """The plain equations, every start the known neighbouring state, which favours SciPy."""
    plain, start, one = subject.plain, subject.start, subject.one
    here, near = subject.here.displacement, subject.near.displacement

    def load_alone() -> Answer:
        return plain.settled(here, start)[0], here, None

    def load() -> Answer:
        carried, k = plain.load_and_stiffness(here, start)
        return carried, here, k

    def shift(solve: Callable[[Array, Array, Array], tuple[Array, Array]]) -> Answer:
        d, balls = solve(LOAD, near, start)
        return LOAD, d, plain.load_and_stiffness(d, balls)[1]

    yield Way(ONE_LOAD, "SciPy, `fsolve` per ball, no K, warm", one, load_alone)
    yield Way(ONE_LOAD, "SciPy, `fsolve` per ball, K by differences, warm", one, load)
    for name, solve in (
        ("ring around balls", plain.displacement_nested),
        ("105 unknowns", plain.displacement_together),
    ):
        words = f"SciPy, `root`, {name}, K by differences, warm"
        yield Way(ONE_SHIFT, words, one, lambda solve=solve: shift(solve), by_load=True)


def _errors(way: Way, subject: Subject) -> dict[str, Any]:
    """Largest relative errors over some of the states: of load or displacement, and of K."""
    load, shift, k = way.work()
    load, shift = np.atleast_2d(load), np.atleast_2d(shift)
    k = None if k is None else k.reshape(-1, 5, 5)
    asked, stiff = [], []
    for i in np.unique(np.linspace(0, len(load) - 1, JUDGED).astype(int)):
        miss = _missed(way, subject, int(i), load[i], shift[i], None if k is None else k[i])
        asked.append(miss[0])
        stiff.append(miss[1])
    return {"error": max(asked), "error_k": None if k is None else max(stiff)}


def _missed(
    way: Way, subject: Subject, i: int, load: Array, shift: Array, k: Array | None
) -> tuple[float, float]:
    """Errors of one state; the reference starts from its K and ball centres, computed again."""
    given_load, given_shift, speeds = (part[i] for part in _parts(way.states))
    speed, lever = float(speeds), subject.lever
    with solver(compiled=False):
        near = subject.bearing.equilibrium(displacement=given_shift, speed=speed)
    true = Reference(subject.bearing, speed)
    d = given_shift
    if way.by_load:
        d = true.displacement(given_load, given_shift, near.ball_centre, near.stiffness())
    whole_load, whole_k = true.load_and_stiffness(d, near.ball_centre)
    off = 0.0 if k is None else largest((k - whole_k) * lever, whole_k * lever, lever[:, None])
    if way.by_load:
        return largest(shift - d, d, 1.0 / lever), off
    return largest(load - whole_load, whole_load, lever), off
