"""A network followed through one step of its path, from event to event.

Between two events no contact changes its kind and the positions are smooth. Where friction reaches
its limit or comes to rest, a stop closes or lets go, the share of the step is found as a root and
the rates say how the path goes on. Where no smooth way goes on, the network snaps to the next
equilibrium, or has none.
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

SHORTEST = 1e-9  # of a step: what changes within is a snap
EXACT = 1e-12  # of a step: where an event is
SMOOTH = 1e-3  # of the way of a part: the cubic between its ends meets its middle
STILL = 1e-11  # m
AFTER = 1e-10  # of what a condition is measured by: violated
SNAPPED = 1e-9  # m
PARTS = 4000  # of a step
AT_ONCE = 100  # parts without length in a row: contacts change back and forth without end
TOUCHED = 1e-9  # of what a condition is measured by, 1e-12 m: a bearing is about to pass a kink
LOWEST = 1e-9  # of a step: where a condition is nearest to being violated
WITHIN = 0.5 ** np.arange(1.0, 31.0)  # of a bracket: where a condition at its limit is looked for
SNAP = Condition("snap", -1)


@dataclass(frozen=True, eq=False, slots=True)
class Part:
    """A smooth part up to ``share``, its end, and what ended it (None: nothing did)."""

    share: float
    state: State
    ended: Condition | None


class Sample(NamedTuple):
    """The ``state`` at a ``share`` and its rates ``v`` (bodies,); how far every condition is from
    being violated, ``value``, and the rate of that, ``slope`` (conditions,)."""

    share: float
    state: State
    v: Array
    value: Array
    slope: Array


def along(step: Step, state: State) -> tuple[State, list[Event]]:
    """The state at the end of a step, and the events on the way.

    Raises
    ------
    NoEquilibrium : nothing balances a body, or contacts change without end
    """
    met: list[Event] = []
    for _, there, new in parts(step, state):
        state = there
        met += new
    return state, met


def passed(step: Step, state: State, shares: Sequence[float]) -> list[State]:
    """States at ``shares`` of a step, ascending up to 1; raises as ``along``."""
    found: list[State] = []
    begun, known = state, dict[float, State]()
    for share, there, _ in parts(step, state):
        known[share] = there
        while len(found) < len(shares) and shares[len(found)] < share:
            place = shares[len(found)]
            at = hold(step, begun, place, _near(known, place)) or hold(step, begun, place)
            if at is None:
                raise runaway(step, place, velocity(step, begun))
            known[place] = at
            found.append(at)
        begun, known = there, {share: there}
    return [*found, *[begun] * (len(shares) - len(found))]


def parts(step: Step, state: State) -> Iterator[tuple[float, State, list[Event]]]:
    """Share, state and events at the begin of a step and after each of its smooth parts; raises as
    ``along``."""
    share, length, before, at_once = 0.0, 1.0, state, 0
    piece = pieces(step.load(0.0).laws, state.at.deflection, state.piece)
    state = updated_contacts(step, _sided(step, replace(state, piece=piece), 0.0), 0.0)
    yield share, state, events(before, state, share, None)
    for _ in range(PARTS):
        if share >= 1.0:
            return
        careful = not _one_way(step, state)
        part = _part(step, state, share, min(share + length, 1.0), careful=careful)
        # a part that was cut short by nothing but the search: the next try goes twice as far
        length = 1.0 if part.ended else max(2.0 * (part.share - share), SHORTEST)
        at_once = 0 if part.share > share else at_once + 1
        if at_once > AT_ONCE:
            break
        share, before, state, met = part.share, part.state, part.state, list[Event]()
        if part.ended is SNAP:
            share, state = min(share + SHORTEST, 1.0), _snapped(step, state, share)
            met = _snaps(before, state, share)
        elif part.ended is not None:
            known = part.ended.index if part.ended.kind == "halt" else None
            after = _sided(step, changed(step.network, before, part.ended), share)
            state = updated_contacts(step, after, share, known)
            met = events(before, state, share, part.ended)
        yield share, state, met
    raise endless(step, share, velocity(step, state))


def _one_way(step: Step, state: State) -> bool:
    """What slides goes on in one way: one force changes, and it slides along the ground."""
    slides = ~state.sticks & (step.network.frictions.limit > 0.0)
    between = np.count_nonzero(step.network.frictions.row, axis=1) > 1
    return step.single and not (slides & between).any()


def _sided(step: Step, state: State, share: float) -> State:
    """The state with the slope that every bearing goes on with which is at a kink of its law."""
    at = step.beside(state.at, step.load(share), state.piece)
    return state if at is state.at else replace(state, at=at)


def _snaps(before: State, after: State, share: float) -> list[Event]:
    """The snap, of the body that moved farthest, and the contacts that are others after it."""
    way = np.abs(after.x - before.x)
    snap = [Event(share, "snap", int(way.argmax()))] if way.max() > SNAPPED else []
    return [*snap, *events(before, after, share, None)]


def _part(step: Step, state: State, a: float, b: float, *, careful: bool) -> Part:
    """The longest smooth part found by halving from share ``a``, at most to ``b``.

    ``careful``: the positions between are held against the cubic between the ends.
    """
    of = conditions(step, state)
    begin = _sample(step, state, a, of)
    while True:
        there = hold(step, state, b, state.x + (b - a) * begin.v)
        if there is not None:
            end = _sample(step, there, b, of)
            middle = _middle(step, begin, end, of) if careful else None
            if middle or not careful or np.abs(there.x - state.x).max() < SNAPPED:
                samples = [begin, middle, end] if middle else [begin, end]
                part = _ended(step, of, samples)
                if part is not None:
                    return part
        if b - a <= SHORTEST:
            return Part(a, state, SNAP)
        # at most once shorter than SHORTEST: what no such part leads through is a snap
        b, careful = max(0.5 * (a + b), a + 0.9 * SHORTEST), True


def _sample(step: Step, state: State, share: float, of: list[Condition]) -> Sample:
    """A state with its rates and conditions ``of`` it."""
    rate = rates(step, state)
    value = measures(step, state, step.load(share), of, rate)
    return Sample(share, state, rate.x, value, slopes(step, state, of, rate))


def _middle(step: Step, begin: Sample, end: Sample, of: list[Condition]) -> Sample | None:
    """The middle of a part; None where the positions are not smooth between its ends."""
    length = end.share - begin.share
    middle, x = 0.5 * (begin.share + end.share), 0.5 * (begin.state.x + end.state.x)
    between = hold(step, begin.state, middle, x)
    if between is None:
        return None
    cubic = x + 0.125 * length * (begin.v - end.v)
    way = np.abs(end.state.x - begin.state.x).max()
    smooth = np.abs(cubic - between.x).max() <= SMOOTH * way + STILL
    return _sample(step, between, middle, of) if smooth else None


def _ended(step: Step, of: list[Condition], samples: list[Sample]) -> Part | None:
    """The part up to the first violated condition; None where the positions jump there."""
    begin, *_, end = samples
    start = begin.share, begin.state
    known = {one.share: one.state for one in samples}
    dips = [*_halts(*samples)] if len(samples) > 2 else []
    dips += [share for pair in pairwise(samples) for share in _lowest(step, start[1], of, *pair)]
    there = [(share, hold(step, start[1], share)) for share in dips]
    values = [(one.share, one.value) for one in samples[1:]]
    values += [(s, measures(step, one, step.load(s), of)) for s, one in there if one]
    share, ended = end.share, None
    for _ in of:
        brackets = [
            one for k in range(len(of)) if (one := _bracket(k, start[0], begin.value, values))
        ]
        if not brackets:
            break
        _, k, met, past = min(brackets)
        ended = of[k]
        share, at = _root(step, known, (met, past), ended)
        values = [one for one in values if one[0] < share]
        values.append((share, measures(step, at, step.load(share), of)))
        values[-1][1][k] = 0.0
    if ended is None:
        return Part(share, end.state, None)
    if ended.kind == "halt":
        ended = _kink(of, values[-1][1], end.value) or ended
    return _continuous(step, start[0], Part(share, at, ended))


def _kink(of: list[Condition], here: Array, later: Array) -> Condition | None:
    """The bearing at a kink of its law where sliding seems to halt: its slope jumps there, and
    only the one beyond tells whether sliding halts."""
    near = (np.abs(here) <= TOUCHED) & (later < here)
    return next((of[k] for k in np.flatnonzero(near) if of[k].kind in ("rise", "fall")), None)


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


def _halts(begin: Sample, middle: Sample, end: Sample) -> list[float]:
    """Shares where the parabola through three values of a halt lies below zero."""
    half = middle.share - begin.share
    bend = begin.value - 2.0 * middle.value + end.value
    slope = 0.5 * (end.value - begin.value)
    cup = np.isnan(begin.slope) & (bend > 0.0)
    at = np.where(cup, -slope / np.where(cup, bend, 1.0), 0.0)
    low = middle.value + at * (slope + 0.5 * at * bend)
    return [middle.share + half * float(s) for s in at[cup & (np.abs(at) < 1.0) & (low < 0.0)]]


def _lowest(
    step: Step, state: State, of: list[Condition], one: Sample, other: Sample
) -> Iterator[float]:
    """Shares where a condition that is met at both ends may be violated: its rate is zero there.

    The tangents at the ends tell how low it may go between.
    """
    turns = (one.slope < 0.0) & (other.slope > 0.0)
    steep = np.where(turns, one.slope - other.slope, -1.0)
    way = (other.value - other.slope * (other.share - one.share) - one.value) / steep
    low = one.value + one.slope * way
    near = low < 0.5 * np.minimum(one.value, other.value) - AFTER
    for k in np.flatnonzero(turns & near).tolist():

        def rate(share: float, k: int = k) -> float:
            there = hold(step, state, share)
            if there is None:
                return -1.0
            return float(slopes(step, there, [of[k]], rates(step, there))[0])

        yield cast(float, brentq(rate, one.share, other.share, xtol=LOWEST))


def _root(
    step: Step, known: dict[float, State], between: tuple[float, float], one: Condition
) -> tuple[float, State]:
    """Share at which a condition is no longer met, and the state there.

    ``known``: states of the part at their shares, to which those that are solved are added.
    """
    state = known[min(known)]

    def value(share: float) -> float:
        at = known.get(share) or hold(step, state, share, _near(known, share))
        if at is None:
            return -1.0
        known[share] = at
        return float(measures(step, at, step.load(share), [one])[0])

    met, past = between
    if value(met) <= 0.0:  # at its limit: it may go within before it is violated
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
    """Positions on the straight line through the two nearest known ones."""
    one, *more = sorted(known, key=lambda other: abs(other - share))
    if not more:
        return known[one].x
    way = known[more[0]].x - known[one].x
    return known[one].x + (share - one) / (more[0] - one) * way


def _continuous(step: Step, a: float, part: Part) -> Part | None:
    """The part, begun at ``a``; before the jump where positions jump at its end."""
    state = part.state
    places = [max(part.share + way, a) for way in (-SHORTEST, SHORTEST)]
    before, after = (hold(step, state, share, state.x) for share in places)
    if before is None:
        return None
    if after is not None and np.abs(after.x - before.x).max() <= SNAPPED:
        return part
    share = part.share - SHORTEST
    return Part(share, before, SNAP) if share > a else None


def _snapped(step: Step, state: State, share: float) -> State:
    """The next equilibrium after ``share``, where no smooth way goes on."""
    share = min(share + SHORTEST, 1.0)
    there = settle(step, state, share)
    if there is None:
        raise runaway(step, share, velocity(step, state))
    piece = pieces(step.load(share).laws, there.at.deflection)
    return updated_contacts(step, replace(there, piece=piece), share)
