"""Deflection of a point under a radial force that grows from zero in even steps.

Every load is a balance of its own (``preload.balance``); only its start is taken from the loads
before it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.balance import Balance, Point
from rotordyn.preload.balance_search import balanced
from rotordyn.preload.leaving import NEARER, Leaving

Words = NDArray[np.str_]
SHORTEST = 2.0**-12  # of a step, that is tried where its end is not found at once
FAILED = 8  # strides without an end, after which a curve ends
LOST = 1e-6  # of its lightest ball without radial force: a ball with less carries nothing


@dataclass(frozen=True, eq=False, slots=True)
class LoadStep:
    """The machine in balance under one load: where everything stands, and where it is heading.

    ``place``: deflections of the shaft with the positions of the sleeves (speeds, unknowns), then
    the ball centres of each bearing model (2, speeds, seats, balls). ``slope``: how far each of
    them would move for the next step of the load, were the machine linear.
    """

    place: list[Array]
    slope: list[Array]

    def ahead(self, before: LoadStep | None) -> list[Array]:
        """Where the next load is likely to put everything.

        On the cubic with the places and slopes of this load and of the one ``before``, an even step
        back; on the straight line where there is none.
        """
        if before is None:
            return [x + dx for x, dx in zip(self.place, self.slope, strict=True)]
        every = zip(before.place, before.slope, self.place, self.slope, strict=True)
        return [5.0 * x0 + 2.0 * dx0 - 4.0 * x1 + 4.0 * dx1 for x0, dx0, x1, dx1 in every]


@dataclass(frozen=True, eq=False, slots=True)
class RadialCurve:
    """``deflection`` of the loaded point (speeds, loads), ``tangent`` at no load (speeds,) [N/m].

    ``outcome`` (speeds,): empty, or why the curve ends early (then NaN from there on). ``reach``
    (speeds, bodies): furthest position of each body against its spring along the curve, as travel
    from rest [m]. ``unloading`` (speeds, seats): force under which the first ball of a bearing
    carries nothing, where all of them were pressed [N]; NaN: none. ``unloaded`` (speeds, seats):
    that ball, counted from 0; −1: none. ``bearings`` (speeds, loads, seats, 3): axial load of each
    in its own frame, radial load, largest load of a ball on its inner race [N].
    """

    deflection: Array
    tangent: Array
    outcome: Words
    reach: Array
    unloading: Array
    unloaded: Indices
    bearings: Array

    def at(self, rows: Indices) -> RadialCurve:
        """The curve at some of its speeds, also repeated."""
        return RadialCurve(*(getattr(self, each.name)[rows] for each in fields(self)))


def radial_curve(problem: Balance, here: Point, force: Array, outcome: Words) -> RadialCurve:
    """Deflection under loads that ascend evenly from zero, where the machine stands ``here``, at
    speeds without an ``outcome`` (speeds,); every speed stands on its own."""
    p, point, start = len(problem.rotor.point), problem.rotor.point, problem.start
    every = np.ones(len(start), dtype=bool)
    step, slope = float(force[-1]) / max(len(force) - 1, 1), problem.per_newton(here, every)
    before, last = None, _load_step(problem, here, step * slope)
    deflection, tangent = np.zeros((len(start), len(force))), 1.0 / slope[:, :p].dot(point)
    outcome, slack = outcome.astype(object), problem.slack(here)
    reach = problem.travel(start)
    unloading = np.full_like(here.lightest, np.nan)
    unloaded = np.full(unloading.shape, -1)
    least, lightest = LOST * here.lightest, [here.lightest]
    bearings = np.full((len(start), len(force), len(problem.bearings), 3), np.nan)
    bearings[:, 0] = _of_bearings(problem, here)
    for k in range(1, len(force)):
        if (outcome != "").all():
            deflection[:, k:] = np.nan
            break
        guess, begun = last.ahead(before), (problem, here)
        ends = float(force[k - 1]), float(force[k])
        problem, here, converged = _stepped(problem, here, guess, ends, outcome == "", slack)
        lost = (outcome == "") & ~converged
        outcome[lost] = [_why(pressure, force[k]) for pressure in here.pressure[lost]]
        light = (here.lightest < least) & np.isnan(unloading) & (outcome == "")[:, None]
        for seat in np.flatnonzero(light.any(axis=0)).tolist():
            known = {
                row: Leaving.between(
                    force[:k].tolist(),
                    [float(each[row, seat]) for each in lightest],
                    float(force[k]),
                    float(least[row, seat]),
                    int(begun[1].lightest_ball[row, seat]),
                )
                for row in np.flatnonzero(light[:, seat]).tolist()
            }
            for row, one in _nearer(*begun, last, known, seat, step).items():
                unloading[row, seat], unloaded[row, seat] = one.zero, one.ball
        slope = problem.per_newton(here, outcome == "")
        before, last = last, _load_step(problem, here, step * slope)
        deflection[:, k] = (here.coordinates - start)[:, :p] @ point
        deflection[outcome != "", k] = np.nan
        bearings[outcome == "", k] = _of_bearings(problem, here)[outcome == ""]
        reach = np.fmax(reach, problem.travel(here.coordinates))
        lightest.append(here.lightest)
    words = outcome.astype(str)
    return RadialCurve(deflection, tangent, words, reach, unloading, unloaded, bearings)


def _of_bearings(problem: Balance, here: Point) -> Array:
    """Axial load in its own frame, radial load, largest load of a ball (speeds, seats, 3) [N]."""
    found = np.empty((*here.load.shape[:2], 3))
    found[..., 0] = here.load[..., 0] * problem.thrust
    across = [place for place, number in enumerate(problem.dof) if number in (1, 2)]
    found[..., 1] = np.linalg.norm(here.load[..., across], axis=-1)
    for places, balls in here.bearings:
        found[:, places, 2] = balls.inner_load.max(axis=-1)
    return found


def _stepped(
    problem: Balance,
    here: Point,
    guess: list[Array],
    ends: tuple[float, float],
    alive: Flags,
    slack: Flags,
) -> tuple[Balance, Point, Flags]:
    """The balance under the second force of ``ends`` from that under the first, and where there is
    one: in a stride from ``guess``, else, of curves that begin with a ``slack`` bearing, in strides
    as long as they lead to one, from place to place; where the bearing is met, they are short."""
    found, there, good = balanced(problem, guess, here, ends[1], alive)
    left = alive & ~good & slack
    if not left.any():
        return found, there, good
    share, stride, failed = 0.0, 0.25, 0
    while share < 1.0 and left.any():
        stride = min(stride, 1.0 - share)
        force = ends[0] + (share + stride) * (ends[1] - ends[0])
        balls = [one.ball for _, one in here.bearings]
        on, at, solved = balanced(problem, [here.coordinates, *balls], here, force, left)
        if (left & ~solved).any() and stride > SHORTEST and failed < FAILED:
            stride, failed = 0.25 * stride, failed + 1
            continue
        problem, here, left = on, at, left & solved
        share, stride = share + stride, 2.0 * stride
    found = problem.where(left, found)
    moved = np.where(left[:, None], here.coordinates, there.coordinates)
    return found, found.evaluate(moved, None), good | left


def _nearer(
    problem: Balance, here: Point, last: LoadStep, known: dict[int, Leaving], seat: int, step: float
) -> dict[int, Leaving]:
    """Balls of a ``seat`` that leave in the ``step`` [N] after ``last``, by speed, with further
    forces tried within it."""
    begin = next(iter(known.values())).load[-1]
    (place, *balls), (slope, *moves) = last.place, last.slope
    lost = set[int]()  # without a balance at a force that is tried: the next would be the same
    for _ in range(NEARER):
        force, alive = np.full(len(place), begin), np.zeros(len(place), dtype=bool)
        for row, one in known.items():
            force[row], alive[row] = one.trial, not (one.found or row in lost)
        if not alive.any():
            break
        share = ((force - begin) / step)[:, None]
        guess = [place + share * slope]
        guess += [x + share[..., None] * dx for x, dx in zip(balls, moves, strict=True)]
        _, there, good = balanced(problem, guess, here, force, alive)
        lost |= set(np.flatnonzero(alive & ~good).tolist())
        for row in [row for row in known if good[row] and alive[row]]:
            lightest, ball = there.lightest[row, seat], there.lightest_ball[row, seat]
            known[row] = known[row].after(float(force[row]), float(lightest), int(ball))
    return known


def _load_step(problem: Balance, here: Point, slope: Array) -> LoadStep:
    return LoadStep(
        [here.coordinates, *(one.ball for _, one in here.bearings)],
        [slope, *problem.balls_along(here, slope)],
    )


def _why(pressure: float, force: float) -> str:
    """Why a curve ends at ``force`` [N]."""
    if pressure > HIGHEST_PRESSURE:
        return (
            f"bearings are overloaded under a radial force of {force:g} N (peak pressure "
            f"{pressure / 1e9:.1f} GPa, at most {HIGHEST_PRESSURE / 1e9:g} GPa): lower max_force"
        )
    return (
        f"no equilibrium under a radial force of {force:g} N: lower max_force or raise the preload"
    )
