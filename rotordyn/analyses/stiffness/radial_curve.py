"""Deflection of a point under a radial force that grows from zero in even steps.

Every load is a balance of its own (``preload.balance``); only its start is taken from the loads
before it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.balance import Balance, Point
from rotordyn.preload.under_load import leaving

Array = NDArray[np.float64]
Words = NDArray[np.str_]
LOST = 1e-3  # of its lightest ball without radial force: a ball with less carries nothing


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
    carries nothing, where all of them were pressed, between two loads by the parabola of its
    approach [N]; NaN: none.
    """

    deflection: Array
    tangent: Array
    outcome: Words
    reach: Array
    unloading: Array

    def at(self, rows: NDArray[np.intp]) -> RadialCurve:
        """The curve at some of its speeds, also repeated."""
        return RadialCurve(*(getattr(self, each.name)[rows] for each in fields(self)))


def radial_curve(problem: Balance, here: Point, force: Array) -> RadialCurve:
    """Deflection under loads that ascend evenly from zero, where the machine stands ``here``; every
    speed stands on its own."""
    p, point, start = len(problem.rotor.point), problem.rotor.point, problem.start
    every = np.ones(len(start), dtype=bool)
    step, slope = float(force[-1]) / max(len(force) - 1, 1), problem.per_newton(here, every)
    before, last = None, _load_step(problem, here, step * slope)
    deflection, tangent = np.zeros((len(start), len(force))), 1.0 / slope[:, :p].dot(point)
    outcome = np.full(len(start), "", dtype=object)
    reach = problem.travel(start)
    unloading = np.full_like(here.lightest, np.nan)
    least, lightest = LOST * here.lightest, [here.lightest]
    for k in range(1, len(force)):
        if (outcome != "").all():
            deflection[:, k:] = np.nan
            break
        guess = last.ahead(before)
        problem, here, converged = problem.solved(guess, here, float(force[k]), outcome == "")
        lost = (outcome == "") & ~converged
        outcome[lost] = [_why(pressure, force[k]) for pressure in here.pressure[lost]]
        slope = problem.per_newton(here, outcome == "")
        before, last = last, _load_step(problem, here, step * slope)
        deflection[:, k] = (here.coordinates - start)[:, :p] @ point
        deflection[outcome != "", k] = np.nan
        reach = np.fmax(reach, problem.travel(here.coordinates))
        light = (here.lightest < least) & (outcome == "")[:, None]
        for row, seat in np.argwhere(light & np.isnan(unloading)):
            pressed = [each[row, seat] ** (2.0 / 3.0) for each in lightest[-3:]]
            below = force[k - len(pressed) : k].tolist()
            unloading[row, seat] = leaving(below, pressed, float(force[k]))
        lightest.append(here.lightest)
    return RadialCurve(deflection, tangent, outcome.astype(str), reach, unloading)


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
