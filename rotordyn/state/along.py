"""A network followed through one step of its path, from event to event.

Between two events no contact changes its kind and the positions are smooth. Where friction reaches
its limit or comes to rest, a stop closes or lets go, the share of the step is found as a root and
the rates say how the path goes on. Where no smooth way goes on, the network snaps to the next
equilibrium, or has none.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from rotordyn.errors import NoSolution
from rotordyn.state.conditions import Condition, Event, changed, conditions, events, measures
from rotordyn.state.contacts import State, hold
from rotordyn.state.network import Step
from rotordyn.state.rates import turned, velocity
from rotordyn.state.settle import settle

Array = NDArray[np.float64]
SHORTEST = 1e-9  # of a step: what changes within is a snap
EXACT = 1e-12  # of a step: where an event is
SMOOTH = 1e-3  # of the way of a part: the cubic between its ends meets its middle
STILL = 1e-11  # m
AFTER = 1e-10  # of what a condition is measured by: violated
SNAPPED = 1e-9  # m
PARTS = 4000  # of a step
AT_ONCE = 100  # parts without length in a row: contacts change back and forth without end
TOUCHED = 1e-9  # of what a condition is measured by, 1e-12 m: a bearing is about to load or unload
WITHIN = 0.5 ** np.arange(1.0, 31.0)  # of a bracket: where a condition at its limit is looked for
SNAP = Condition("snap", -1)


class NoEquilibrium(NoSolution):
    """Nothing balances a body beyond some place of the path.

    ``share`` of the step done; ``body`` that runs away.
    """

    def __init__(self, share: float, body: str, sentence: str) -> None:
        self.share, self.body = share, body
        super().__init__(sentence)


@dataclass(frozen=True, eq=False, slots=True)
class Part:
    """A smooth part up to ``share``, its end, and what ended it (None: nothing did)."""

    share: float
    state: State
    ended: Condition | None


def along(step: Step, state: State) -> tuple[State, list[Event]]:
    """The state at the end of a step, and the events on the way.

    Raises
    ------
    NoEquilibrium : nothing balances a body, or contacts change without end
    """
    share, length, before, at_once = 0.0, 1.0, state, 0
    state = turned(step, state)
    met = events(before, state, share, None)
    for _ in range(PARTS):
        if share >= 1.0:
            return state, met
        part = _part(step, state, share, min(share + length, 1.0), careful=not step.single)
        length = max(2.0 * (part.share - share), SHORTEST)
        at_once = 0 if part.share > share else at_once + 1
        if at_once > AT_ONCE:
            break
        share, before, state = part.share, part.state, part.state
        if part.ended is SNAP:
            share, state = min(share + SHORTEST, 1.0), _snapped(step, state, share)
            met += _snaps(before, state, share)
        elif part.ended is not None:
            known = part.ended.index if part.ended.kind == "halt" else None
            after = _sided(step, changed(step.network, before, part.ended), part)
            state = turned(step, after, known)
            met += events(before, state, share, part.ended)
        length = 1.0 if part.ended else length
    raise _endless(step, state, share)


def _sided(step: Step, state: State, part: Part) -> State:
    """The state with the slope that a bearing goes on with which was just loaded or unloaded."""
    if part.ended is None or part.ended.kind not in ("load", "unload"):
        return state
    side = 1.0 if part.ended.kind == "load" else -1.0
    at = step.beside(state.at, step.load(part.share), part.ended.index, side)
    return replace(state, at=at)


def _snaps(before: State, after: State, share: float) -> list[Event]:
    way = np.abs(after.x - before.x)
    snap = [Event(share, "snap", int(way.argmax()))] if way.max() > SNAPPED else []
    return [*snap, *events(before, after, share, None)]


def _part(step: Step, state: State, a: float, b: float, *, careful: bool) -> Part:
    """The longest smooth part from ``a``, at most to ``b``.

    ``careful``: the positions between are held against the cubic between the ends.
    """
    of = conditions(step.network, state)
    begins = measures(step, state, step.load(a), of)
    v = velocity(step, state)
    while True:
        there = hold(step, state, b, state.x + (b - a) * v)
        if there is not None:
            samples = _samples(step, state, (a, b), there, v) if careful else [(b, there)]
            if samples or np.abs(there.x - state.x).max() < SNAPPED:
                part = _ended(step, (a, state), of, begins, samples or [(b, there)])
                if part is not None:
                    return part
        if b - a <= SHORTEST:
            return Part(a, state, SNAP)
        b, careful = max(0.5 * (a + b), a + 0.9 * SHORTEST), True


def _samples(
    step: Step, state: State, ends: tuple[float, float], there: State, v: Array
) -> list[tuple[float, State]]:
    """Middle and end of a part; nothing where the positions are not smooth between."""
    length = ends[1] - ends[0]
    middle = 0.5 * (ends[0] + ends[1])
    between = hold(step, state, middle, 0.5 * (state.x + there.x))
    if between is None:
        return []
    cubic = 0.5 * (state.x + there.x) + 0.125 * length * (v - velocity(step, there))
    way = np.abs(there.x - state.x).max()
    smooth = np.abs(cubic - between.x).max() <= SMOOTH * way + STILL
    return [(middle, between), (ends[1], there)] if smooth else []


def _ended(
    step: Step,
    start: tuple[float, State],
    of: list[Condition],
    begins: Array,
    samples: list[tuple[float, State]],
) -> Part | None:
    """The part up to the first violated condition; None where the positions jump there."""
    values = [(share, measures(step, one, step.load(share), of)) for share, one in samples]
    if len(values) > 1:
        dips = _dips(start[0], begins, *values)
        there = [(share, hold(step, start[1], share)) for share in dips]
        values += [(s, measures(step, one, step.load(s), of)) for s, one in there if one]
    share, ended, last = samples[-1][0], None, values[-1][1]
    for _ in of:
        brackets = [one for k in range(len(of)) if (one := _bracket(k, start[0], begins, values))]
        if not brackets:
            break
        _, k, met, past = min(brackets)
        ended = of[k]
        share, at = _root(step, start, (met, past), ended)
        values = [one for one in values if one[0] < share]
        values.append((share, measures(step, at, step.load(share), of)))
        values[-1][1][k] = 0.0
    if ended is None:
        return Part(share, samples[-1][1], None)
    if ended.kind == "halt":
        ended = _loading(of, values[-1][1], last) or ended
    return _continuous(step, start, Part(share, start[1], ended))


def _loading(of: list[Condition], here: Array, later: Array) -> Condition | None:
    """The bearing that loads or unloads where sliding seems to halt: its slope jumps there, and
    only the one beyond tells whether sliding halts."""
    near = (np.abs(here) <= TOUCHED) & (later < here)
    return next((of[k] for k in np.flatnonzero(near) if of[k].kind in ("load", "unload")), None)


def _bracket(
    k: int, a: float, begins: Array, values: list[tuple[float, Array]]
) -> tuple[float, int, float, float] | None:
    """Where condition ``k`` is likely to end; ``k``; a share where it is met, one where not."""
    violated = [(share, float(value[k])) for share, value in values if value[k] < -AFTER]
    if not violated:
        return None
    past, below = min(violated)
    good = [(s, float(value[k])) for s, value in values if s < past and value[k] > 0.0]
    met, above = max(good, default=(a, max(float(begins[k]), 0.0)))
    return met + (past - met) * above / (above - below), k, met, past


def _dips(
    a: float, begins: Array, middle: tuple[float, Array], end: tuple[float, Array]
) -> list[float]:
    """Shares where the parabola through three values of a condition lies below zero."""
    half = middle[0] - a
    bend = begins - 2.0 * middle[1] + end[1]
    slope = 0.5 * (end[1] - begins)
    cup = bend > 0.0
    at = np.where(cup, -slope / np.where(cup, bend, 1.0), 0.0)
    low = middle[1] + at * (slope + 0.5 * at * bend)
    return [middle[0] + half * float(s) for s in at[cup & (np.abs(at) < 1.0) & (low < 0.0)]]


def _root(
    step: Step, start: tuple[float, State], between: tuple[float, float], one: Condition
) -> tuple[float, State]:
    """Share at which a condition is no longer met, and the state there."""
    known = {start[0]: start[1]}

    def value(share: float) -> float:
        at = hold(step, start[1], share, _near(known, share))
        if at is None:
            return -1.0
        known[share] = at
        return float(measures(step, at, step.load(share), [one])[0])

    met, past = between
    if value(met) <= 0.0:  # at its limit: it may go within before it is violated
        nearer = (met + (past - met) * share for share in WITHIN)
        inside = next((share for share in nearer if value(share) > 0.0), None)
        if inside is None:
            return met, known.get(met, start[1])
        met = inside
    if value(past) >= 0.0:  # violated by rounding alone, solved from elsewhere
        return past, known[past]
    root = cast(float, brentq(value, met, past, xtol=EXACT, rtol=EXACT))
    return root, known[min(known, key=lambda other: abs(other - root))]


def _near(known: dict[float, State], share: float) -> Array:
    """Positions on the straight line through the two nearest known ones."""
    one, *more = sorted(known, key=lambda other: abs(other - share))
    if not more:
        return known[one].x
    way = known[more[0]].x - known[one].x
    return known[one].x + (share - one) / (more[0] - one) * way


def _continuous(step: Step, start: tuple[float, State], part: Part) -> Part | None:
    """The part with the state at its end; before the jump where there is one."""
    a, state = start
    at = hold(step, state, part.share)
    before, after = (hold(step, state, max(part.share + way, a)) for way in (-SHORTEST, SHORTEST))
    if before is None:
        return None
    jumps = after is None or float(np.abs(after.x - before.x).max()) > SNAPPED
    if at is not None and not jumps:
        return replace(part, state=at)
    share = part.share - SHORTEST
    return Part(share, before, SNAP) if share > a else None


def _snapped(step: Step, state: State, share: float) -> State:
    """The next equilibrium after ``share``, where no smooth way goes on."""
    share = min(share + SHORTEST, 1.0)
    there = settle(step, state, share)
    if there is None:
        raise _nothing(step, state, share)
    free = np.array([law.free for law in step.load(share).laws])
    return turned(step, replace(there, loaded=there.at.deflection > free))


def _endless(step: Step, state: State, share: float) -> NoEquilibrium:
    """The sentence about contacts that change back and forth."""
    bodies = step.network.bodies
    body = bodies[int(np.abs(velocity(step, state)).argmax())]
    return NoEquilibrium(
        share,
        body,
        f"body {body}: its contacts change back and forth without end; friction of joints that "
        "form a loop is not determined: leave one of them out, or change the step a little",
    )


def _nothing(step: Step, state: State, share: float) -> NoEquilibrium:
    """The sentence about the body that runs away."""
    bodies, force = step.network.bodies, step.load(share).force
    body = bodies[int(np.abs(velocity(step, state)).argmax())]
    pushed = int(np.abs(force).argmax())
    under = f"{force[pushed]:.6g} N on {bodies[pushed]}" if force[pushed] else "no external force"
    return NoEquilibrium(
        share,
        body,
        f"body {body} has no equilibrium under {under}: nothing holds it any longer; lower the "
        "force, or hold it with a spring or a stop",
    )
