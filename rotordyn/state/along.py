"""A network followed through one step of its path, from event to event.

Between two events no contact changes its kind and the positions are smooth. Where friction reaches
its limit, sliding halts, or a stop closes or opens, the share of the step is solved as a root and
the rates determine how the path continues. Where it cannot continue smoothly, the network snaps to
the next equilibrium, or has none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple, cast

import numpy as np
from scipy.optimize import brentq

from rotordyn.arrays import Array
from rotordyn.state.conditions import (
    Condition,
    Event,
    changed,
    conditions,
    events,
    measures,
    slopes,
)
from rotordyn.state.contacts import State, hold
from rotordyn.state.network import Step, pieces
from rotordyn.state.no_equilibrium import endless, runaway
from rotordyn.state.rates import rates, updated_contacts, velocity
from rotordyn.state.settle import settle

SHORTEST = 1e-9  # of a step: a change within it is a snap
EXACT = 1e-12  # of a step: tolerance of the share of an event
SMOOTH = 1e-3  # of the travel of a part: largest distance of its middle from the cubic of its ends
STILL = 1e-11  # m, which is added to that distance
AFTER = 1e-10  # in the measure of a condition: below −AFTER it is violated
SNAPPED = 1e-9  # m, least travel of a snap
PARTS = 4000  # of a step
AT_ONCE = 100  # parts without length in a row: contacts change back and forth without end
TOUCHED = 1e-9  # in the measure of a condition, 1e-12 m: a bearing is about to pass a kink
LOWEST = 1e-9  # of a step: tolerance of the share at which a condition has its minimum
WITHIN = 0.5 ** np.arange(1.0, 31.0)  # shares of a bracket to evaluate a condition at its limit
SNAP = Condition("snap", -1)


@dataclass(frozen=True, eq=False, slots=True)
class Part:
    """A smooth part up to ``share``, its last state, and the condition that ended it, or None."""

    share: float
    state: State
    ended: Condition | None


class Sample(NamedTuple):
    """The ``state`` at a ``share`` and its rates ``v`` (bodies,); the margin of every condition,
    ``value``, and the rate of that, ``slope`` (conditions,)."""

    share: float
    state: State
    v: Array
    value: Array
    slope: Array


def along(step: Step, state: State) -> tuple[State, list[Event]]:
    """Follow a step: return the state at its end, and the events on the way.

    Raises
    ------
    NoEquilibrium : nothing balances a body, or contacts change without end
    """
    all_events: list[Event] = []
    for _, reached, new_events in parts(step, state):
        state = reached
        all_events += new_events
    return state, all_events


def passed(step: Step, state: State, shares: Sequence[float]) -> list[State]:
    """Return the states at ``shares`` of a step, ascending up to 1; raises as ``along``."""
    states: list[State] = []
    begin, known = state, dict[float, State]()
    for share, reached, _ in parts(step, state):
        known[share] = reached
        while len(states) < len(shares) and shares[len(states)] < share:
            place = shares[len(states)]
            solved = hold(step, begin, place, _near(known, place)) or hold(step, begin, place)
            if solved is None:
                raise runaway(step, place, velocity(step, begin))
            known[place] = solved
            states.append(solved)
        begin, known = reached, {share: reached}
    return [*states, *[begin] * (len(shares) - len(states))]


def parts(step: Step, state: State) -> Iterator[tuple[float, State, list[Event]]]:
    """Yield share, state and events at the begin of a step and after each of its smooth parts;
    raises as ``along``."""
    share, length, before, at_once = 0.0, 1.0, state, 0
    piece = pieces(step.load(0.0).laws, state.at.deflection, state.piece)
    state = updated_contacts(step, _sided(step, replace(state, piece=piece), 0.0), 0.0)
    yield share, state, events(before, state, share, None)
    for _ in range(PARTS):
        if share >= 1.0:
            return
        careful = not _one_way(step, state)
        part = _part(step, state, share, min(share + length, 1.0), careful=careful)
        # only the search has shortened a part that no condition ended: the next one may be longer
        length = 1.0 if part.ended else max(2.0 * (part.share - share), SHORTEST)
        at_once = 0 if part.share > share else at_once + 1
        if at_once > AT_ONCE:
            break
        share, before, state, new_events = part.share, part.state, part.state, list[Event]()
        if part.ended is SNAP:
            share, state = min(share + SHORTEST, 1.0), _snapped(step, state, share)
            new_events = _snaps(before, state, share)
        elif part.ended is not None:
            halted = part.ended.index if part.ended.kind == "halt" else None
            after = _sided(step, changed(step.network, before, part.ended), share)
            state = updated_contacts(step, after, share, halted)
            new_events = events(before, state, share, part.ended)
        yield share, state, new_events
    raise endless(step, share, velocity(step, state))


def _one_way(step: Step, state: State) -> bool:
    """Whether sliding keeps its direction: one force changes, and bodies slide on the ground."""
    slides = ~state.sticks & (step.network.frictions.limit > 0.0)
    between = np.count_nonzero(step.network.frictions.row, axis=1) > 1
    return step.single and not (slides & between).any()


def _sided(step: Step, state: State, share: float) -> State:
    """State in which every bearing at a kink of its law has the slope of its current piece."""
    at = step.beside(state.at, step.load(share), state.piece)
    return state if at is state.at else replace(state, at=at)


def _snaps(before: State, after: State, share: float) -> list[Event]:
    """Events of a snap: that of the body that moved farthest, and the contacts it has changed."""
    travel = np.abs(after.x - before.x)
    snap = [Event(share, "snap", int(travel.argmax()))] if travel.max() > SNAPPED else []
    return [*snap, *events(before, after, share, None)]


def _part(step: Step, state: State, a: float, b: float, *, careful: bool) -> Part:
    """Find the longest smooth part from share ``a``, at most to ``b``, by halving.

    ``careful``: the positions between are compared with the cubic between the ends.
    """
    of = conditions(step, state)
    begin = _sample(step, state, a, of)
    while True:
        reached = hold(step, state, b, state.x + (b - a) * begin.v)
        if reached is not None:
            end = _sample(step, reached, b, of)
            middle = _middle(step, begin, end, of) if careful else None
            if middle or not careful or np.abs(reached.x - state.x).max() < SNAPPED:
                samples = [begin, middle, end] if middle else [begin, end]
                part = _ended(step, of, samples)
                if part is not None:
                    return part
        if b - a <= SHORTEST:
            return Part(a, state, SNAP)
        # at most once shorter than SHORTEST: where even that fails there is a snap
        b, careful = max(0.5 * (a + b), a + 0.9 * SHORTEST), True


def _sample(step: Step, state: State, share: float, of: list[Condition]) -> Sample:
    """Sample of the part at a ``share`` of it: rates of its state, values and slopes of the
    conditions ``of`` the part."""
    rate = rates(step, state)
    value = measures(step, state, step.load(share), of, rate)
    return Sample(share, state, rate.x, value, slopes(step, state, of, rate))


def _middle(step: Step, begin: Sample, end: Sample, of: list[Condition]) -> Sample | None:
    """Sample the middle of a part; None where the positions are not smooth between its ends."""
    length = end.share - begin.share
    middle, x = 0.5 * (begin.share + end.share), 0.5 * (begin.state.x + end.state.x)
    between = hold(step, begin.state, middle, x)
    if between is None:
        return None
    cubic = x + 0.125 * length * (begin.v - end.v)
    travel = np.abs(end.state.x - begin.state.x).max()
    smooth = np.abs(cubic - between.x).max() <= SMOOTH * travel + STILL
    return _sample(step, between, middle, of) if smooth else None


def _ended(step: Step, of: list[Condition], samples: list[Sample]) -> Part | None:
    """Return the part up to the first violated condition; None where the positions jump there."""
    begin, *_, end = samples
    start = begin.share, begin.state
    known = {sample.share: sample.state for sample in samples}
    dips = [*_halts(*samples)] if len(samples) > 2 else []
    dips += [share for pair in pairwise(samples) for share in _lowest(step, start[1], of, *pair)]
    at_dips = [(share, hold(step, start[1], share)) for share in dips]
    values = [(sample.share, sample.value) for sample in samples[1:]]
    values += [(s, measures(step, there, step.load(s), of)) for s, there in at_dips if there]
    share, ended = end.share, None
    for _ in of:
        brackets = [
            hit for k in range(len(of)) if (hit := _bracket(k, start[0], begin.value, values))
        ]
        if not brackets:
            break
        _, k, met, past = min(brackets)
        ended = of[k]
        share, at = _root(step, known, (met, past), ended)
        values = [value for value in values if value[0] < share]
        values.append((share, measures(step, at, step.load(share), of)))
        values[-1][1][k] = 0.0
    if ended is None:
        return Part(share, end.state, None)
    if ended.kind == "halt":
        ended = _kink(of, values[-1][1], end.value) or ended
    return _continuous(step, start[0], Part(share, at, ended))


def _kink(of: list[Condition], now: Array, later: Array) -> Condition | None:
    """Find the bearing at a kink of its law where sliding seems to halt: its slope jumps there,
    and only the slope beyond determines whether sliding halts."""
    touched = (np.abs(now) <= TOUCHED) & (later < now)
    return next((of[k] for k in np.flatnonzero(touched) if of[k].kind in ("rise", "fall")), None)


def _bracket(
    k: int, a: float, begins: Array, values: list[tuple[float, Array]]
) -> tuple[float, int, float, float] | None:
    """Bracket the violation of condition ``k``: its estimated share, ``k``, a share where it is
    met, one where it is violated; None if it is met everywhere."""
    violated = [(share, float(value[k])) for share, value in values if value[k] < -AFTER]
    if not violated:
        return None
    past, below = min(violated)
    satisfied = [(s, float(value[k])) for s, value in values if s < past and value[k] > 0.0]
    met, above = max(satisfied, default=(a, max(float(begins[k]), 0.0)))
    return met + (past - met) * above / (above - below), k, met, past


def _halts(begin: Sample, middle: Sample, end: Sample) -> list[float]:
    """Shares of the minima below zero of parabolas through three values of a halt."""
    half = middle.share - begin.share
    bend = begin.value - 2.0 * middle.value + end.value
    slope = 0.5 * (end.value - begin.value)
    cup = np.isnan(begin.slope) & (bend > 0.0)
    at = np.where(cup, -slope / np.where(cup, bend, 1.0), 0.0)
    low = middle.value + at * (slope + 0.5 * at * bend)
    return [middle.share + half * float(s) for s in at[cup & (np.abs(at) < 1.0) & (low < 0.0)]]


def _lowest(
    step: Step, state: State, of: list[Condition], left: Sample, right: Sample
) -> Iterator[float]:
    """Yield shares where a condition met at both ends may be violated: its rate is zero there.

    The tangents at the ends bound its minimum between them.
    """
    turns = (left.slope < 0.0) & (right.slope > 0.0)
    steep = np.where(turns, left.slope - right.slope, -1.0)
    distance = (right.value - right.slope * (right.share - left.share) - left.value) / steep
    low = left.value + left.slope * distance
    doubtful = low < 0.5 * np.minimum(left.value, right.value) - AFTER
    for k in np.flatnonzero(turns & doubtful).tolist():

        def rate(share: float, k: int = k) -> float:
            between = hold(step, state, share)
            if between is None:
                return -1.0
            return float(slopes(step, between, [of[k]], rates(step, between))[0])

        yield cast(float, brentq(rate, left.share, right.share, xtol=LOWEST))


def _root(
    step: Step, known: dict[float, State], between: tuple[float, float], condition: Condition
) -> tuple[float, State]:
    """Solve the share at which a condition is no longer met, and the state there.

    ``known``: states of the part at their shares, to which newly solved ones are added.
    """
    state = known[min(known)]

    def value(share: float) -> float:
        at = known.get(share) or hold(step, state, share, _near(known, share))
        if at is None:
            return -1.0
        known[share] = at
        return float(measures(step, at, step.load(share), [condition])[0])

    met, past = between
    if value(met) <= 0.0:  # at its limit: its margin may grow before it is violated
        nearer = (met + (past - met) * share for share in WITHIN)
        inside = next((share for share in nearer if value(share) > 0.0), None)
        if inside is None:
            return met, known.get(met, state)
        met = inside
    if value(past) >= 0.0:  # violated by rounding alone, solved from elsewhere
        return past, known[past]
    root = cast(float, brentq(value, met, past, xtol=EXACT, rtol=EXACT))
    return root, known[min(known, key=lambda other: abs(other - root))]


def _near(known: dict[float, State], share: float) -> Array:
    """Positions on the straight line through those of the two nearest known states."""
    nearest, *more = sorted(known, key=lambda other: abs(other - share))
    if not more:
        return known[nearest].x
    travel = known[more[0]].x - known[nearest].x
    return known[nearest].x + (share - nearest) / (more[0] - nearest) * travel


def _continuous(step: Step, a: float, part: Part) -> Part | None:
    """Return the part, begun at ``a``, or that before a jump of positions at its end, or None."""
    state = part.state
    shares = [max(part.share + offset, a) for offset in (-SHORTEST, SHORTEST)]
    before, after = (hold(step, state, share, state.x) for share in shares)
    if before is None:
        return None
    if after is not None and np.abs(after.x - before.x).max() <= SNAPPED:
        return part
    share = part.share - SHORTEST
    return Part(share, before, SNAP) if share > a else None


def _snapped(step: Step, state: State, share: float) -> State:
    """Solve the next equilibrium after ``share``, where the path cannot continue smoothly."""
    share = min(share + SHORTEST, 1.0)
    settled = settle(step, state, share)
    if settled is None:
        raise runaway(step, share, velocity(step, state))
    piece = pieces(step.load(share).laws, settled.at.deflection)
    return updated_contacts(step, replace(settled, piece=piece), share)
