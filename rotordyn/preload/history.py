"""The axial network of a spindle with its memory: its history from assembly on, then loads along a
path.

Friction holds sleeves where they were, so that every state is followed from the one before, from
one event (a sleeve slips or sticks, a stop closes or opens) to the next. The bearings are tables of
their loads and tangents at every speed, interpolated linearly between two speeds.
``rotordyn.preload.play`` is a quicker solver of cycles of force alone, for identification.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain, groupby, pairwise
from typing import NamedTuple

import numpy as np

from rotordyn.allowance import require_history, require_time
from rotordyn.arrays import Array
from rotordyn.machine.history import HistoryStep, Past
from rotordyn.preload.arrangement import (
    HOUSING,
    SHAFT,
    Arrangement,
    AxialBearing,
    arrangement,
    as_mounted,
    has_stop,
)
from rotordyn.preload.axial_tables import axial_tables, deflection_of
from rotordyn.preload.network import Network as PreloadNetwork
from rotordyn.preload.state import PreloadState
from rotordyn.state import NoEquilibrium
from rotordyn.state.along import along, parts, passed
from rotordyn.state.contacts import State
from rotordyn.state.laws import AxialLaw
from rotordyn.state.network import Bearings, Frictions, Load, Network, Springs, Step, Stops
from rotordyn.state.rates import compliance, updated_contacts
from rotordyn.state.rest import mounted_state

SLIDING = 1e-9  # of the limit of friction


@dataclass(frozen=True, eq=False, slots=True)
class History:
    """Axial ``network`` of the spindle and the loads of its history.

    ``of_seat``: the bearing of the network that stands for each seat; ``rest``: load at assembly;
    ``before``: loads up to the run-up; ``through``: load at each speed
    as the run-up passes it; ``after``: loads that follow there; ``loads``: the last one of each
    speed. ``lower``: number of speeds below the one at which the run-up begins.
    """

    network: Network
    of_seat: list[int]
    rest: Load
    loads: tuple[Load, ...]
    before: tuple[Load, ...]
    through: tuple[Load, ...]
    after: tuple[tuple[Load, ...], ...]
    lower: int

    def run_up(self) -> list[State | str]:
        """The state at every speed at the end of the history, or why there is none."""
        path = (self.rest, *self.before)
        begun = self._followed(mounted_state(self.network, self.rest), path)
        found: list[State | str] = [begun] * len(self.loads)
        rows = range(len(self.loads))
        # upward from the speed of the last step before, and downward from it: two separate paths
        for way in (rows[self.lower :], rows[: self.lower][::-1]):
            there, load = begun, path[-1]
            for row in way:
                there = self._followed(there, (load, self.through[row]))
                load = self.through[row]
                found[row] = self._followed(there, (load, *self.after[row]))
        return found

    def _followed(self, state: State | str, path: Sequence[Load]) -> State | str:
        """The state at the end of a path that begins in it, or why there is none."""
        for start, end in pairwise(path):
            if isinstance(state, str):
                break
            require_time("history", "broken off")
            try:
                state = along(Step(self.network, start, end), state)[0]
            except NoEquilibrium as none:
                state = str(none)
        return state

    def loaded(
        self, row: int, state: State, force: Sequence[float], start: Load | None = None
    ) -> list[State]:
        """States under axial forces [N] one after the other, at speed ``row`` from ``state``.

        ``start``: what acts in that state, at this speed; None: no force besides.

        Raises
        ------
        NoEquilibrium : nothing balances a body
        """
        base = float(self.loads[row].force[SHAFT])
        states, at = [state], self.loads[row] if start is None else start
        for values in _ways(float(at.force[SHAFT]) - base, force):
            step = Step(self.network, at, self.under(row, values[-1]))
            here, there = at.force[SHAFT], step.end.force[SHAFT]
            way = (there - here) or 1.0
            states += passed(
                step, states[-1], [*((base + v - here) / way for v in values[:-1]), 1.0]
            )
            at = step.end
        return states[1:]

    def force_to_slide(self, row: int, state: State, force: float, reach: float) -> float:
        """Axial force [N] beyond ``force`` at which a sleeve first slides again, where friction of
        all of them is at its limit in ``state``; NaN where one sticks or stands at a stop, where a
        stop opens or closes before, or where none slides up to ``reach`` [N]."""
        limit = self.network.frictions.limit
        slides = np.abs(state.friction) >= limit * (1.0 - SLIDING)
        if not (limit > 0.0).any() or not slides.all() or (np.abs(state.press) > 0.0).any():
            return math.nan
        step = Step(self.network, self.under(row, force), self.under(row, force + reach))
        met = (event for *_, events in parts(step, state) for event in events)
        try:
            for event in met:
                if event.kind.startswith("slip"):
                    return event.share * reach
                if event.kind in ("open", "close"):
                    break
        except NoEquilibrium:
            pass
        return math.nan

    def under(self, row: int, force: float) -> Load:
        """Loads at the speed of ``row`` with a further axial ``force`` [N] on the shaft."""
        load = self.loads[row]
        push = load.force.copy()
        push[SHAFT] += force
        return replace(load, force=push)

    def compliance(self, row: int, state: State, force: float, way: float) -> float:
        """Axial compliance of the shaft for a force that rises or falls, ``way`` ±1 [m/N]."""
        here, there = self.under(row, force), self.under(row, force + way)
        step = Step(self.network, here, there)
        return way * float(compliance(step, updated_contacts(step, state, 0.0))[SHAFT])


def _ways(start: float, force: Sequence[float]) -> list[list[float]]:
    """Forces after ``start``, each time it turns a list of its own."""
    ways: list[list[float]] = []
    before = 0.0
    for a, b in pairwise([start, *force]):
        if not ways or np.sign(b - a) != before:
            ways.append([b])
        else:
            ways[-1].append(b)
        before = np.sign(b - a)
    return ways


def history(preload: PreloadState, reach: float) -> History:
    """The network of a spindle with the friction of its sleeves, and its history up to the speeds
    of ``preload``.

    ``reach``: largest axial force of the paths that go on from there [N].

    Raises
    ------
    TooCostly : that takes more time or memory than is allowed
    """
    joined, past = _apart(preload), preload.past
    _require_allowed(preload, len(joined.bearings))
    known = [step.axial_force or 0.0 for step in past.steps]
    pushed = max(map(abs, (preload.force, past.weight, *(past.weight + f for f in known))))
    most = 2.0 * (reach + pushed + float(np.abs(preload.network.springs.force).sum()))
    laws = BearingLaws(preload, joined, most)
    assembled = PreloadNetwork(as_mounted(joined), preload.network.springs)
    near = assembled.deflection(preload.mounted.position)[0].tolist()
    by_seat = preload.mounted_load().tolist()
    loads, models = zip(*((by_seat[b.seats[0]], b.model) for b in joined.bearings), strict=True)
    each = zip(laws.at(0.0, warm=False)[0], models, loads, near, strict=True)
    network = _network(preload, joined, np.array([deflection_of(*one) for one in each]))

    def load(at: Moment) -> Load:
        push, gap = np.zeros((2, len(joined.bodies)))
        of_bearings, shift, at_supports = laws.at(at.speed, warm=at.warm)
        push[SHAFT], gap[SHAFT] = at.force, -at_supports
        return Load(push, shift, gap, of_bearings)

    before, through, after = moments(past, joined.speed.tolist(), preload.force)
    start = Moment(0.0, False, 0.0)
    laws.all_at([*before, *through, *chain(*after)])
    return History(
        network,
        of_seat=joined.bearing_of_seat,
        rest=load(start),
        loads=tuple(load(path[-1]) for path in after),
        before=tuple(load(at) for at in before),
        through=tuple(load(at) for at in through),
        after=tuple(tuple(load(at) for at in path[1:]) for path in after),
        lower=bisect_left(joined.speed.tolist(), (before or [start])[-1].speed),
    )


class Moment(NamedTuple):
    """A place of a history: speed [rad/s], at operating temperature or not, axial force [N]."""

    speed: float
    warm: bool
    force: float


def moments(
    past: Past, speeds: Sequence[float], force: float
) -> tuple[list[Moment], list[Moment], list[list[Moment]]]:
    """Places before the run-up, at each of ``speeds`` on it, and there from that one on.

    In the end every speed is at its temperatures, and the axial ``force`` [N] on the shaft.
    """
    here = Moment(0.0, False, past.weight)
    before = [] if past.weight == 0.0 else [here]
    for step in past.before:
        before += _changed(step, here, past.weight, speeds)
        here = before[-1]
    through = [here._replace(speed=speed) for speed in speeds]
    after = []
    for there in through:
        path = [there]
        for step in past.after:
            path += _changed(step, path[-1], past.weight, ())
        path += [path[-1]._replace(warm=True), Moment(there.speed, True, force)]
        after.append([path[0], *(b for a, b in pairwise(path) if a != b)])
    return before, through, after


def _apart(preload: PreloadState) -> Arrangement:
    """The arrangement of a preload state, bearings by themselves that do not stay alike through its
    history."""
    joined, speeds = preload.network.arrangement, np.union1d(preload.speed, preload.past.speeds)
    acting = preload.law, preload.temperatures, preload.films
    alike = arrangement(preload.spindle, speeds, 0.0, *acting).bearing_of_seat
    bearings = [
        replace(bearing, seats=tuple(seats))
        for bearing in joined.bearings
        for _, seats in groupby(sorted(bearing.seats, key=alike.__getitem__), alike.__getitem__)
    ]
    return replace(joined, bearings=tuple(bearings))


def _require_allowed(preload: PreloadState, bearings: int) -> None:
    """Raise InvalidInput where laws and steps of the history take more than is allowed."""
    past, speeds = preload.past, preload.speed.tolist()
    steps = most_moments(past, speeds)
    known = {0.0, *speeds, *(step.speed for step in past.steps if step.speed is not None)}
    laws = len(known) * bearings
    if preload.temperatures is not None and past.cold:
        laws *= 2
    what = f"history: {steps} steps and {laws} load tables of bearings"
    require_history(what, laws, steps)


def most_moments(past: Past, speeds: Sequence[float]) -> int:
    """How many ``moments`` there are at most."""
    here, count = 0.0, 0
    for step in past.before:
        goal = here if step.speed is None else step.speed
        count += 1 + abs(bisect_left(speeds, goal) - bisect_left(speeds, here))
        here = goal
    return count + len(speeds) * (len(past.after) + 3)


def _changed(
    step: HistoryStep, here: Moment, weight: float, speeds: Sequence[float]
) -> list[Moment]:
    """Moments to which a step goes from ``here``, with a stop at each of ``speeds`` in between."""
    if step.warm is not None:
        return [here._replace(warm=step.warm)]
    if step.axial_force is not None:
        return [here._replace(force=weight + step.axial_force)]
    goal = here.speed if step.speed is None else step.speed
    low, high = sorted((here.speed, goal))
    way = [*(speed for speed in speeds if low < speed < high), high]
    way = way if goal >= here.speed else [*way[-2::-1], low]
    return [here._replace(speed=speed) for speed in way]


class BearingLaws:
    """Laws of the bearings ``joined`` of a preload state up to a load ``most`` [N], and shifts of
    their seats, at any speed of its history; each is made once."""

    def __init__(self, preload: PreloadState, joined: Arrangement, most: float) -> None:
        self.preload, self.joined, self.most = preload, joined, most
        self.speeds = np.union1d(preload.speed, preload.past.speeds)
        self._arranged: dict[bool, Arrangement] = {}  # at all of these, warm or not
        self._known: dict[tuple[float, bool], tuple[tuple[AxialLaw, ...], Array, float]] = {}

    def at(self, speed: float, *, warm: bool) -> tuple[tuple[AxialLaw, ...], Array, float]:
        """Laws, shifts (bearings,) [m] and that of the shaft at its supports [m], at a speed
        [rad/s], at operating temperature or not."""
        place = self._place(speed, warm)
        self._solve([place])
        return self._known[place]

    def all_at(self, moments: Iterable[Moment]) -> None:
        """Make those of some ``moments`` together, which is quicker."""
        self._solve(dict.fromkeys(self._place(at.speed, at.warm) for at in moments))

    def _place(self, speed: float, warm: bool) -> tuple[float, bool]:
        return speed, warm and self.preload.temperatures is not None

    def _solve(self, places: Iterable[tuple[float, bool]]) -> None:
        """Make those at speeds, warm or not, that are not known yet."""
        new = {place: self._bearings(*place) for place in places if place not in self._known}
        every = [bearing for own, _ in new.values() for bearing in own]
        speeds = [speed for (speed, _), (own, _) in new.items() for _ in own]
        tables = iter(axial_tables(every, speeds, self.most))
        for place, (own, at_supports) in new.items():
            shift = np.array([bearing.shortening[0] for bearing in own])
            self._known[place] = tuple(next(tables) for _ in own), shift, at_supports

    def _bearings(self, speed: float, warm: bool) -> tuple[list[AxialBearing], float]:
        """The bearings at a speed, and the shift of the shaft at its supports [m]."""
        if warm not in self._arranged:
            state = self.preload
            acting = state.law, state.temperatures if warm else None, state.films
            self._arranged[warm] = arrangement(state.spindle, self.speeds, 0.0, *acting)
        there = self._arranged[warm].at(np.searchsorted(self.speeds, [speed]))
        of_seat = there.bearing_of_seat
        own = [there.bearings[of_seat[one.seats[0]]] for one in self.joined.bearings]
        return own, float(there.support_shift[0])


def _network(preload: PreloadState, joined: Arrangement, deflection: Array) -> Network:
    """Bodies of a preload state and all between them, bearings as ``joined``; ``deflection``
    (bearings,) as mounted [m]."""
    springs, rubs = preload.network.springs, preload.rubs
    rows = np.eye(len(joined.bodies))
    ends = [rows[b.outer] if b.outer != HOUSING else 0.0 * rows[0] for b in joined.bearings]
    stiffness = [springs.stiffness[0, SHAFT], *(push.stiffness for push in joined.pushes)]
    stops = [push for push in joined.pushes if has_stop(push)]
    rubbing = np.flatnonzero(rubs)
    return Network(
        bodies=joined.bodies,
        bearings=Bearings(
            row=rows[SHAFT] - np.array(ends),
            side=np.array([float(bearing.thrust) for bearing in joined.bearings]),
            count=np.array([float(len(bearing.seats)) for bearing in joined.bearings]),
            rest=deflection,
        ),
        springs=Springs(rows, springs.force[0], np.array(stiffness)),
        stops=Stops(
            rows[[push.body for push in stops]],
            np.array([float(push.direction) for push in stops]),
            np.array([-push.direction * push.travel for push in stops]),
        ),
        frictions=Frictions(rows[rubbing], limit=rubs[rubbing], start=np.zeros(len(rubbing))),
    )
