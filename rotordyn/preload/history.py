"""Axial network of a spindle with memory: its history from assembly on, then loads along a path.

Friction makes each state depend on the one before, so that states are followed from one event (a
sleeve slips or sticks, a stop closes or opens) to the next. Bearings are tables of their loads and
tangents at every point of the path, blended linearly between two points. ``rotordyn.preload.play``
is a faster solver for cycles of force alone, for identification.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
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
from rotordyn.preload.passed_speeds import passed_speeds
from rotordyn.preload.state import PreloadState
from rotordyn.state import NoEquilibrium
from rotordyn.state.along import along, parts, passed
from rotordyn.state.contacts import State
from rotordyn.state.laws import AxialLaw
from rotordyn.state.network import Bearings, Frictions, Load, Network, Springs, Step, Stops
from rotordyn.state.rates import compliance, updated_contacts
from rotordyn.state.rest import mounted_state

SLIDING = 1e-9  # of the limit of friction: what is closer to it slides
PARTS = 16  # of a way between temperatures: laws of rings that grow by µm are far from linear


@dataclass(frozen=True, eq=False, slots=True)
class History:
    """Axial ``network`` of the spindle and the loads of its history.

    ``of_seat``: index of the network's bearing at each seat; ``rest``: load at assembly;
    ``before``: loads up to the run-up; ``passed``: loads passed on the way to each speed, since the
    speed before it on that way; ``through``: load as the run-up reaches it; ``after``:
    loads that follow there; ``loads``: the last one at each speed. ``lower``: number of speeds
    below the one at which the run-up begins.
    """

    network: Network
    of_seat: list[int]
    rest: Load
    loads: tuple[Load, ...]
    before: tuple[Load, ...]
    passed: tuple[tuple[Load, ...], ...]
    through: tuple[Load, ...]
    after: tuple[tuple[Load, ...], ...]
    lower: int

    def run_up(self) -> list[State | str]:
        """Return the state at every speed at the end of the history, or why there is none."""
        path = (self.rest, *self.before)
        initial = self._followed(mounted_state(self.network, self.rest), path)
        ends: list[State | str] = [initial] * len(self.loads)
        rows = range(len(self.loads))
        # upward from the speed of the last step before, and downward from it: two separate paths
        for route in (rows[self.lower :], rows[: self.lower][::-1]):
            state, load = initial, path[-1]
            reached: dict[int, State | str] = {}  # by the load there, as a speed of the case
            for row in route:
                for point in self.passed[row]:
                    state = reached.get(id(point)) or self._followed(state, (load, point))
                    load = point
                # a branch of its own: the way goes on from the point passed last
                there = self._followed(state, (load, self.through[row]))
                reached[id(self.through[row])] = there
                ends[row] = self._followed(there, (self.through[row], *self.after[row]))
        return ends

    def _followed(self, state: State | str, path: Sequence[Load]) -> State | str:
        """Return the state at the end of a path that begins in ``state``, or why there is none."""
        for start, end in pairwise(path):
            if isinstance(state, str):
                break
            require_time("history", "broken off")
            try:
                state = along(Step(self.network, start, end), state)[0]
            except NoEquilibrium as error:
                state = str(error)
        return state

    def loaded(
        self, row: int, state: State, force: Sequence[float], start: Load | None = None
    ) -> list[State]:
        """Return the states under successive axial forces [N] at speed ``row``, from ``state``.

        ``start``: load in that state, at this speed; None: no additional force.

        Raises
        ------
        NoEquilibrium : nothing balances a body
        """
        base = float(self.loads[row].force[SHAFT])
        states, current = [state], self.loads[row] if start is None else start
        for values in _monotonic(float(current.force[SHAFT]) - base, force):
            step = Step(self.network, current, self.under(row, values[-1]))
            low, high = current.force[SHAFT], step.end.force[SHAFT]
            rise = (high - low) or 1.0
            states += passed(
                step, states[-1], [*((base + v - low) / rise for v in values[:-1]), 1.0]
            )
            current = step.end
        return states[1:]

    def force_to_slide(self, row: int, state: State, force: float, reach: float) -> float:
        """Return the axial force [N] beyond ``force`` at which a sleeve first slides again, where
        friction of all of them is at its limit in ``state``; NaN where one sticks or stands at a
        stop, where a stop opens or closes before, or where none slides up to ``reach`` [N]."""
        limit = self.network.frictions.limit
        slides = np.abs(state.friction) >= limit * (1.0 - SLIDING)
        if not (limit > 0.0).any() or not slides.all() or (np.abs(state.press) > 0.0).any():
            return math.nan
        step = Step(self.network, self.under(row, force), self.under(row, force + reach))
        ahead = (event for *_, events in parts(step, state) for event in events)
        try:
            for event in ahead:
                if event.kind.startswith("slip"):
                    return event.share * reach
                if event.kind in ("open", "close"):
                    break
        except NoEquilibrium:
            pass
        return math.nan

    def under(self, row: int, force: float) -> Load:
        """Return the load at speed ``row`` with a further axial ``force`` [N] on the shaft."""
        load = self.loads[row]
        push = load.force.copy()
        push[SHAFT] += force
        return replace(load, force=push)

    def compliance(self, row: int, state: State, force: float, way: float) -> float:
        """Return the axial compliance [m/N] for a force that rises or falls, ``way`` ±1."""
        start, end = self.under(row, force), self.under(row, force + way)
        step = Step(self.network, start, end)
        return way * float(compliance(step, updated_contacts(step, state, 0.0))[SHAFT])


def _monotonic(start: float, force: Sequence[float]) -> list[list[float]]:
    """Return the forces after ``start`` in monotonic sequences."""
    sequences: list[list[float]] = []
    direction = 0.0
    for a, b in pairwise([start, *force]):
        if not sequences or np.sign(b - a) != direction:
            sequences.append([b])
        else:
            sequences[-1].append(b)
        direction = np.sign(b - a)
    return sequences


def history(preload: PreloadState, reach: float) -> History:
    """Return the network of a spindle with the friction of its sleeves, and its history up to the
    speeds of ``preload``.

    ``reach``: largest axial force of later paths [N].

    Raises
    ------
    TooCostly : the history takes more time or memory than is allowed
    """
    joined, past = _separated(preload), preload.past
    _require_allowed(preload, len(joined.bearings))
    applied = [step.axial_force or 0.0 for step in past.steps]
    largest = max(map(abs, (preload.force, past.weight, *(past.weight + f for f in applied))))
    most = 2.0 * (reach + largest + float(np.abs(preload.network.springs.force).sum()))
    laws = BearingLaws(preload, joined, most)
    assembled = PreloadNetwork(as_mounted(joined), preload.network.springs)
    deflection = assembled.deflection(preload.mounted.position)[0].tolist()
    by_seat = preload.mounted_load().tolist()
    loads, models = zip(*((by_seat[b.seats[0]], b.model) for b in joined.bearings), strict=True)
    bearings = zip(laws.at(0.0, warm=0.0)[0], models, loads, deflection, strict=True)
    network = _network(preload, joined, np.array([deflection_of(*bearing) for bearing in bearings]))

    @cache  # one load for each moment
    def load(at: Moment) -> Load:
        push, gap = np.zeros((2, len(joined.bodies)))
        of_bearings, shift, at_supports = laws.at(at.speed, warm=at.warm)
        push[SHAFT], gap[SHAFT] = at.force, -at_supports
        return Load(push, shift, gap, of_bearings)

    speeds, between = joined.speed.tolist(), _passed_speeds(preload).tolist()
    parts = _parts(preload)
    before, passed, through, after = moments(past, speeds, preload.force, between, parts)
    start = Moment(0.0, 0.0, 0.0)
    laws.all_at([*before, *chain(*passed), *through, *chain(*after)])
    return History(
        network,
        of_seat=joined.bearing_of_seat,
        rest=load(start),
        loads=tuple(load(path[-1]) for path in after),
        before=tuple(load(at) for at in before),
        passed=tuple(tuple(load(at) for at in way) for way in passed),
        through=tuple(load(at) for at in through),
        after=tuple(tuple(load(at) for at in path[1:]) for path in after),
        lower=bisect_left(speeds, (before or [start])[-1].speed),
    )


class Moment(NamedTuple):
    """Point of a history: speed [rad/s], share of the way to operating temperature, axial force
    [N]."""

    speed: float
    warm: float
    force: float


class Moments(NamedTuple):
    """Points ``before`` the run-up, those ``passed`` on it since the neighbour of each speed, at
    each speed as it comes ``through``, and from there on."""

    before: list[Moment]
    passed: list[list[Moment]]
    through: list[Moment]
    after: list[list[Moment]]


def moments(
    past: Past, speeds: Sequence[float], force: float, between: Sequence[float] = (), parts: int = 1
) -> Moments:
    """Return the points of a history up to each of ``speeds``; ways lead through
    the speeds ``between`` [rad/s], ascending, and temperatures change in ``parts`` equal steps.

    In the end every speed has its temperatures, and the axial ``force`` [N] on the shaft.
    """
    current = Moment(0.0, 0.0, past.weight)
    before = [] if past.weight == 0.0 else [current]
    for step in past.before:
        before += _changed(step, current, past.weight, between, parts)
        current = before[-1]
    passed: list[list[Moment]] = [[] for _ in speeds]
    rows, lower = range(len(speeds)), bisect_left(speeds, current.speed)
    for route in (rows[lower:], rows[:lower][::-1]):
        last = current
        for row in route:
            # where no way turns, those of the case are as good, and are solved anyway
            passed[row] = _way(last, speeds[row], between or speeds)
            last = [last, *passed[row]][-1]
    through = [current._replace(speed=speed) for speed in speeds]
    after = []
    for passage in through:
        path = [passage]
        for step in past.after:
            path += _changed(step, path[-1], past.weight, (), parts)
        path += [*_warming(path[-1], 1.0, parts), Moment(passage.speed, 1.0, force)]
        after.append([path[0], *(b for a, b in pairwise(path) if a != b)])
    return Moments(before, passed, through, after)


def _passed_speeds(preload: PreloadState) -> Array:
    """Return the speeds that the ways of its history lead through."""
    top = max(*preload.speed.tolist(), *preload.past.speeds)
    return passed_speeds(preload.spindle, top, preload.temperatures)


def _parts(preload: PreloadState) -> int:
    """Return the number of parts in which its history changes temperatures."""
    return 1 if preload.temperatures is None else PARTS


def _all_speeds(preload: PreloadState) -> Array:
    """Return all speeds of a preload state and its history, ascending."""
    return np.unique([*preload.speed, *preload.past.speeds, *_passed_speeds(preload)])


def _separated(preload: PreloadState) -> Arrangement:
    """Return the arrangement of a preload state; bearings that do not stay identical through its
    history are separate."""
    joined, speeds = preload.network.arrangement, _all_speeds(preload)
    conditions = preload.law, preload.temperatures, preload.films
    groups = arrangement(preload.spindle, speeds, 0.0, *conditions).bearing_of_seat
    bearings = [
        replace(bearing, seats=tuple(seats))
        for bearing in joined.bearings
        for _, seats in groupby(sorted(bearing.seats, key=groups.__getitem__), groups.__getitem__)
    ]
    return replace(joined, bearings=tuple(bearings))


def _require_allowed(preload: PreloadState, bearings: int) -> None:
    """Raise TooCostly if load tables and steps of the history take more than is allowed."""
    past, between, parts = preload.past, _passed_speeds(preload).tolist(), _parts(preload)
    steps = most_moments(past, len(preload.speed), between, parts)
    laws = len(_all_speeds(preload)) * bearings
    if preload.temperatures is not None:
        changed_at = len(preload.speed) if past.cold or past.after else 1
        laws = laws * (2 if past.cold else 1) + changed_at * parts * bearings
    what = f"history: {steps} steps and {laws} load tables of bearings"
    require_history(what, laws, steps)


def most_moments(past: Past, speeds: int, between: Sequence[float] = (), parts: int = 1) -> int:
    """Return an upper bound of the number of ``moments`` at so many ``speeds``."""
    before, after = (
        (parts - 1) * sum(step.warm is not None for step in steps)
        for steps in (past.before, past.after)
    )
    current, count = 0.0, before
    for step in past.before:
        goal = current if step.speed is None else step.speed
        count += 1 + abs(bisect_left(between, goal) - bisect_left(between, current))
        current = goal
    at_each = len(past.after) + after + 2 + (parts if past.cold or after else 1)
    return count + len(between) + speeds * at_each


def _changed(
    step: HistoryStep, start: Moment, weight: float, between: Sequence[float], parts: int
) -> list[Moment]:
    """Return the points to which a step leads from ``start``."""
    if step.warm is not None:
        return _warming(start, float(step.warm), parts)
    if step.axial_force is not None:
        return [start._replace(force=weight + step.axial_force)]
    goal = start.speed if step.speed is None else step.speed
    return [*_way(start, goal, between), start._replace(speed=goal)]


def _warming(start: Moment, goal: float, parts: int) -> list[Moment]:
    """Return the points on the way from ``start`` to a share of the operating temperatures."""
    shares = np.linspace(start.warm, goal, parts + 1)[1:] if start.warm != goal else [goal]
    return [start._replace(warm=float(share)) for share in shares]


def _way(start: Moment, goal: float, between: Sequence[float]) -> list[Moment]:
    """Return the points on the way from ``start`` to another speed, without both."""
    low, high = sorted((start.speed, goal))
    inside = between[bisect_right(between, low) : bisect_left(between, high)]
    return [start._replace(speed=at) for at in (inside if goal > low else inside[::-1])]


class BearingLaws:
    """Laws of the bearings ``joined`` of a preload state up to a load ``most`` [N], and shifts of
    their seats, at any speed of its history; each is computed once."""

    def __init__(self, preload: PreloadState, joined: Arrangement, most: float) -> None:
        self.preload, self.joined, self.most = preload, joined, most
        self.speeds = _all_speeds(preload)
        self._arranged: dict[float, Arrangement] = {}  # at all of these, cold and warm
        self._known: dict[tuple[float, float], tuple[tuple[AxialLaw, ...], Array, float]] = {}

    def at(self, speed: float, *, warm: float) -> tuple[tuple[AxialLaw, ...], Array, float]:
        """Return laws, shifts (bearings,) [m] and that of the shaft at its supports [m], at a speed
        [rad/s], at a share ``warm`` of the way to operating temperature."""
        key = self._key(speed, warm)
        self._solve([key])
        return self._known[key]

    def all_at(self, moments: Iterable[Moment]) -> None:
        """Solve the laws of all ``moments`` together, which is faster."""
        self._solve(dict.fromkeys(self._key(moment.speed, moment.warm) for moment in moments))

    def _key(self, speed: float, warm: float) -> tuple[float, float]:
        return speed, 0.0 if self.preload.temperatures is None else warm

    def _solve(self, keys: Iterable[tuple[float, float]]) -> None:
        """Solve laws at those keys (speed, share of warmth) that are new."""
        new = {key: self._bearings(*key) for key in keys if key not in self._known}
        flat = [bearing for bearings, _ in new.values() for bearing in bearings]
        speeds = [speed for (speed, _), (bearings, _) in new.items() for _ in bearings]
        tables = iter(axial_tables(flat, speeds, self.most))
        for key, (bearings, at_supports) in new.items():
            shift = np.array([bearing.shortening[0] for bearing in bearings])
            self._known[key] = tuple(next(tables) for _ in bearings), shift, at_supports

    def _bearings(self, speed: float, warm: float) -> tuple[list[AxialBearing], float]:
        """Return the bearings at a speed, and the shift of the shaft at its supports [m]."""
        if warm not in (0.0, 1.0):  # growth is taken as linear in the temperatures
            (cold, cold_shift), (hot, hot_shift) = (self._bearings(speed, at) for at in (0.0, 1.0))
            between = [_between(*pair, warm) for pair in zip(cold, hot, strict=True)]
            return between, (1.0 - warm) * cold_shift + warm * hot_shift
        if warm not in self._arranged:
            state = self.preload
            conditions = state.law, state.temperatures if warm else None, state.films
            self._arranged[warm] = arrangement(state.spindle, self.speeds, 0.0, *conditions)
        at_speed = self._arranged[warm].at(np.searchsorted(self.speeds, [speed]))
        of_seat = at_speed.bearing_of_seat
        bearings = [
            at_speed.bearings[of_seat[bearing.seats[0]]] for bearing in self.joined.bearings
        ]
        return bearings, float(at_speed.support_shift[0])


def _between(cold: AxialBearing, hot: AxialBearing, warm: float) -> AxialBearing:
    """Return a bearing at a share of the way from one state to the other."""
    growth = (1.0 - warm) * cold.growth + warm * hot.growth
    shortening = (1.0 - warm) * cold.shortening + warm * hot.shortening
    return replace(cold, growth=growth, shortening=shortening)


def _network(preload: PreloadState, joined: Arrangement, deflection: Array) -> Network:
    """Return the network of a preload state; ``deflection`` (bearings,) as mounted [m]."""
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
