"""From a question to solved states: alike ones together, each group in one solve."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearings.angular_contact import AngularContactBallBearing
from bearings.collect import blank, state, store
from bearings.convex import resting_seat
from bearings.equilibrium import solve
from bearings.errors import InvalidBearing, NoEquilibrium
from bearings.geometry import geometry, groove_origin
from bearings.kinematics import HYPOTHESES, SHARINGS
from bearings.model import BallModel
from bearings.problem import Problem
from bearings.question import Question, check_friction, check_name, question
from bearings.ring import axial_ring, full_ring
from bearings.state import BearingState, Cause

Array = NDArray[np.float64]
TOGETHER = 20000  # balls in one batch: bounds the memory
SLOW = 2e-9  # of the groove reach: a ball pressed in less by its own motion is at rest

REMEDIES = {
    "unloaded": "no load presses the rings together; give a load, or a displacement",
    "no equilibrium": (
        "the balls lose their hold between rest and this speed; raise the load, lower the speed, "
        "or use outer or hybrid kinematics"
    ),
    "no contact angle": "static growth takes the whole contact angle; reduce the fit",
}


def answer(
    bearing: AngularContactBallBearing,
    *,
    load: ArrayLike | None,
    displacement: ArrayLike | None,
    speed: ArrayLike,
    static_growth: ArrayLike,
    growth: ArrayLike | None,
    kinematics: str,
    moment_sharing: str,
    friction: float | None,
    start: BearingState | None,
) -> BearingState:
    """See ``AngularContactBallBearing.equilibrium``."""
    check_name("kinematics", kinematics, HYPOTHESES)
    check_name("moment_sharing", moment_sharing, SHARINGS)
    asked = question(load, displacement, speed, static_growth, growth)
    check_friction(friction)
    model = BallModel(geometry(bearing), kinematics, moment_sharing, friction)
    origin = groove_origin(model.geometry, asked.static_growth, asked.growth)
    outcome = np.where(np.isfinite(origin[0]), "", "no contact angle").astype("<U16")
    outcome[asked.unloaded & (outcome == "")] = "unloaded"
    states = blank(model.geometry, asked, outcome)
    for index, axial, turning in _groups(model, asked, outcome):
        problem = _problem(model, asked, origin, index, axial=axial, turning=turning)
        first = _first(problem, asked.displacement[index])
        near = None
        if start is not None and turning:
            first, near = _neighbour(problem, asked, start, index, first)
        store(states, index, problem, solve(problem, first, near))
    if asked.shape == () and states["outcome"][0]:
        word = str(states["outcome"][0])
        raise NoEquilibrium(word, speed=float(asked.speed[0]), remedy=REMEDIES[word])
    growths = (v.reshape(asked.shape) for v in (asked.static_growth, asked.growth))
    return state(states, asked.shape, Cause(bearing, kinematics, moment_sharing, friction, *growths))


def _groups(
    model: BallModel, asked: Question, outcome: NDArray[np.str_]
) -> Iterator[tuple[NDArray[np.intp], bool, bool]]:
    """States alike in what must be solved: (index, axial?, turning?).

    A speed whose centrifugal force does not press a ball measurably into its race is rest.
    """
    g = model.geometry
    depth = (model.nominal_centrifugal(asked.speed) / g.outer.stiffness) ** (2.0 / 3.0)
    is_axial, is_turning = asked.axial, depth > SLOW * g.outer_reach
    for axial in (True, False):
        for turning in (True, False):
            chosen = (is_axial == axial) & (is_turning == turning) & (outcome == "")
            index, share = np.flatnonzero(chosen), TOGETHER // (1 if axial else g.balls) + 1
            for first in range(0, len(index), share):
                yield index[first : first + share], axial, turning


def _problem(
    model: BallModel,
    asked: Question,
    origin: Array,
    index: NDArray[np.intp],
    *,
    axial: bool,
    turning: bool,
) -> Problem:
    others = np.array([False] + [axial] * 4)  # of an axial state they stay at zero by symmetry
    return Problem(
        model=model,
        ring=axial_ring(model.geometry) if axial else full_ring(model.geometry),
        origin=origin[:, index],
        speed=asked.speed[index],
        load=asked.load[index],
        free=asked.free & ~others,
        turning=turning,
    )


def _first(problem: Problem, given: Array) -> Array:
    """Displacement to start from: as ``given`` (s, 5), else all balls under their likely share."""
    d = given.copy()
    if not problem.free[0]:
        return d
    g = problem.model.geometry
    thrust = np.abs(problem.load[:, :3]).max(axis=1) + np.abs(problem.load[:, 3:]).max(axis=1) / (
        g.pitch_diameter / 2.0
    )
    share = thrust / (g.balls * max(np.sin(g.contact_angle), 0.2))
    length = g.free_distance + (share / g.series_stiffness) ** (2.0 / 3.0)
    radial = np.minimum(np.abs(problem.origin[1]), 0.999 * length)
    side = np.where(problem.load[:, 0] < 0.0, -1.0, 1.0)
    d[:, 0] = side * np.sqrt(length**2 - radial**2) - problem.origin[0]
    return d


def _neighbour(
    problem: Problem,
    asked: Question,
    start: BearingState,
    index: NDArray[np.intp],
    first: Array,
) -> tuple[Array, Array]:
    """(d, X) of the neighbouring states; ``first`` and seats at rest where one is missing."""
    if start.outcome.shape != asked.shape or start.inner_load.shape[-1] != (
        problem.model.geometry.balls
    ):
        raise InvalidBearing(
            f"start must be a state of this bearing with batch shape {asked.shape}, got "
            f"{start.outcome.shape}"
        )
    near = start.ball_centre.reshape(2, len(asked.speed), -1)[:, index]
    near = near[..., : problem.ring.balls]  # of an axial state all balls are alike
    known = np.asarray(np.isfinite(near).all(axis=(0, 2)))
    there = start.displacement.reshape(-1, 5)[index]
    first = np.where(known[:, None] & problem.free, there, first)
    a = problem.centres(first)
    seats = np.stack(resting_seat(problem.model.constants, (a[0], a[1])))
    return first, np.where(known[:, None], near, seats)
