"""Deflection of a point under a radial force that grows from zero in even steps.

Every load has its own solution of the balance (``preload.balance``), to which previous loads give
no more than the starting point.
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
SHORTEST = 2.0**-12  # of a load step: shortest substep where the whole step does not converge
FAILED = 8  # substeps that do not converge, after which a curve ends
LOST = 1e-6  # of the lightest ball load without radial force: less is a lost contact


@dataclass(frozen=True, eq=False, slots=True)
class LoadStep:
    """Balance of the machine under one load: its coordinates, and their slope over the load.

    ``place``: deflections of the shaft with the positions of the sleeves (speeds, unknowns), then
    the ball centres of each bearing model (2, speeds, seats, balls). ``slope``: their linear change
    over the next step of the load.
    """

    place: list[Array]
    slope: list[Array]

    def ahead(self, before: LoadStep | None) -> list[Array]:
        """Extrapolate to the next load.

        The cubic has the places and slopes of this load and of the one ``before``, an even step
        back; without that one the extrapolation is linear.
        """
        if before is None:
            return [x + dx for x, dx in zip(self.place, self.slope, strict=True)]
        terms = zip(before.place, before.slope, self.place, self.slope, strict=True)
        return [5.0 * x0 + 2.0 * dx0 - 4.0 * x1 + 4.0 * dx1 for x0, dx0, x1, dx1 in terms]


@dataclass(frozen=True, eq=False, slots=True)
class RadialCurve:
    """``deflection`` of the loaded point (speeds, loads), ``tangent`` at no load (speeds,) [N/m].

    ``outcome`` (speeds,): empty, or why the curve ends early (then NaN from there on). ``reach``
    (speeds, bodies): furthest position of each body against its spring along the curve, as travel
    from rest [m]. ``unloading`` (speeds, seats): force at which the first ball of a bearing
    loses contact, if all of them are loaded before [N]; NaN: none. ``unloaded`` (speeds, seats):
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
        """Curve at ``rows`` of its speeds, which may repeat."""
        return RadialCurve(*(getattr(self, field.name)[rows] for field in fields(self)))


def radial_curve(problem: Balance, here: Point, force: Array, outcome: Words) -> RadialCurve:
    """Solve for the deflection under loads that ascend evenly from zero, from the balance ``here``
    on, at speeds without an ``outcome`` (speeds,); speeds are independent."""
    p, point, start = len(problem.rotor.point), problem.rotor.point, problem.start
    all_rows = np.ones(len(start), dtype=bool)
    step, slope = float(force[-1]) / max(len(force) - 1, 1), problem.per_newton(here, all_rows)
    previous, last = None, _load_step(problem, here, step * slope)
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
        guess, start_of_step = last.ahead(previous), (problem, here)
        ends = float(force[k - 1]), float(force[k])
        problem, here, converged = _stepped(problem, here, guess, ends, outcome == "", slack)
        failed = (outcome == "") & ~converged
        outcome[failed] = [_why(pressure, force[k]) for pressure in here.pressure[failed]]
        unloads = (here.lightest < least) & np.isnan(unloading) & (outcome == "")[:, None]
        for seat in np.flatnonzero(unloads.any(axis=0)).tolist():
            leaving = {
                row: Leaving.between(
                    force[:k].tolist(),
                    [float(loads[row, seat]) for loads in lightest],
                    float(force[k]),
                    float(least[row, seat]),
                    int(start_of_step[1].lightest_ball[row, seat]),
                )
                for row in np.flatnonzero(unloads[:, seat]).tolist()
            }
            for row, event in _located(*start_of_step, last, leaving, seat, step).items():
                unloading[row, seat], unloaded[row, seat] = event.zero, event.ball
        slope = problem.per_newton(here, outcome == "")
        previous, last = last, _load_step(problem, here, step * slope)
        deflection[:, k] = (here.coordinates - start)[:, :p] @ point
        deflection[outcome != "", k] = np.nan
        bearings[outcome == "", k] = _of_bearings(problem, here)[outcome == ""]
        reach = np.fmax(reach, problem.travel(here.coordinates))
        lightest.append(here.lightest)
    words = outcome.astype(str)
    return RadialCurve(deflection, tangent, words, reach, unloading, unloaded, bearings)


def _of_bearings(problem: Balance, point: Point) -> Array:
    """Axial load in the bearing's frame, radial load, largest ball load (speeds, seats, 3) [N]."""
    loads = np.empty((*point.load.shape[:2], 3))
    loads[..., 0] = point.load[..., 0] * problem.thrust
    radial = [place for place, number in enumerate(problem.dof) if number in (1, 2)]
    loads[..., 1] = np.linalg.norm(point.load[..., radial], axis=-1)
    for places, balls in point.bearings:
        loads[:, places, 2] = balls.inner_load.max(axis=-1)
    return loads


def _stepped(
    problem: Balance,
    here: Point,
    guess: list[Array],
    ends: tuple[float, float],
    alive: Flags,
    slack: Flags,
) -> tuple[Balance, Point, Flags]:
    """Solve for the balance under the second force of ``ends`` from that under the first; returns
    the speeds that converge as well. One step starts from ``guess``; where it fails, curves that
    begin with a ``slack`` bearing take adaptive substeps, short where it comes into contact."""
    solved_problem, point, converged = balanced(problem, guess, here, ends[1], alive)
    remaining = alive & ~converged & slack
    if not remaining.any():
        return solved_problem, point, converged
    share, stride, failed = 0.0, 0.25, 0
    while share < 1.0 and remaining.any():
        stride = min(stride, 1.0 - share)
        force = ends[0] + (share + stride) * (ends[1] - ends[0])
        balls = [states.ball for _, states in here.bearings]
        trial, reached, solved = balanced(
            problem, [here.coordinates, *balls], here, force, remaining
        )
        if (remaining & ~solved).any() and stride > SHORTEST and failed < FAILED:
            stride, failed = 0.25 * stride, failed + 1
            continue
        problem, here, remaining = trial, reached, remaining & solved
        share, stride = share + stride, 2.0 * stride
    solved_problem = problem.where(remaining, solved_problem)
    coordinates = np.where(remaining[:, None], here.coordinates, point.coordinates)
    return solved_problem, solved_problem.evaluate(coordinates, None), converged | remaining


def _located(
    problem: Balance, here: Point, last: LoadStep, exits: dict[int, Leaving], seat: int, step: float
) -> dict[int, Leaving]:
    """Locate, by speed, the force within the ``step`` [N] after ``last`` at which a ball of a
    ``seat`` loses contact, by solving at further forces."""
    begin = next(iter(exits.values())).load[-1]
    (place, *balls), (slope, *moves) = last.place, last.slope
    failed = set[int]()  # rows without a balance at a trial force: the next one would be the same
    for _ in range(NEARER):
        force, alive = np.full(len(place), begin), np.zeros(len(place), dtype=bool)
        for row, event in exits.items():
            force[row], alive[row] = event.trial, not (event.found or row in failed)
        if not alive.any():
            break
        share = ((force - begin) / step)[:, None]
        guess = [place + share * slope]
        guess += [x + share[..., None] * dx for x, dx in zip(balls, moves, strict=True)]
        _, point, converged = balanced(problem, guess, here, force, alive)
        failed |= set(np.flatnonzero(alive & ~converged).tolist())
        for row in [row for row in exits if converged[row] and alive[row]]:
            lightest, ball = point.lightest[row, seat], point.lightest_ball[row, seat]
            exits[row] = exits[row].after(float(force[row]), float(lightest), int(ball))
    return exits


def _load_step(problem: Balance, point: Point, slope: Array) -> LoadStep:
    return LoadStep(
        [point.coordinates, *(states.ball for _, states in point.bearings)],
        [slope, *problem.balls_along(point, slope)],
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
