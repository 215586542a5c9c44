"""Solution of operating points: states of one kind in groups, each solved at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.arrays import Array, Flags, Index, Words
from bearings.ball.laws import Laws
from bearings.ball.potential import resting_seat
from bearings.errors import InvalidBearing
from bearings.geometry import Geometry
from bearings.ring.assembly import axial_assembly, full_assembly
from bearings.ring.compiled.states import pays
from bearings.ring.contacts import Contacts
from bearings.ring.equilibrium import Solution, solve
from bearings.ring.operation import Operation
from bearings.ring.problem import Problem, first_displacement
from bearings.ring.state import BearingState
from bearings.ring.tolerances import CRUSHED, TOGETHER

Arrays = dict[str, NDArray[Any]]
BY_BALL = (
    "inner_load",
    "outer_load",
    "inner_angle",
    "outer_angle",
    "inner_pressure",
    "outer_pressure",
    "centrifugal_force",
    "gyroscopic_moment",
    "inner_required_friction",
    "outer_required_friction",
)
ALIKE = ("raceways", "touching", "both_ways")  # of a bearing and the one of a start
STRAIGHT = 1e-9  # rad, contact angle up to which its sign is rounding
BY_CONTACT = ("contact_load", "contact_angle", "contact_pressure")


def solved(
    operation: Operation, start: BearingState | None = None, compiled: bool | None = None
) -> BearingState:
    """Solve all states of a batch; see ``BallBearing.equilibrium``."""
    g, full_problem = operation.geometry, Problem.of(operation, full_assembly)
    outcome = np.where(np.isfinite(full_problem.origin[0]), "", "no contact angle").astype("<U16")
    if g.touching:  # a centred ring is at rest under no load
        outcome[operation.unloaded & (outcome == "")] = "unloaded"
    states = _blank(full_problem, operation, outcome)
    if compiled is None:  # the compiled solver takes states of one law
        balls = int(np.where(operation.axial, 1, g.balls).sum())  # equal balls are solved once
        compiled = not isinstance(operation.law, Laws) and pays(balls, g)
    for index, problem in _groups(full_problem, operation, outcome == ""):
        first, guess = first_displacement(problem, operation.displacement[index]), None
        if start is not None and problem.turning and np.any(operation.law.one_branch):
            first, guess = _neighbour(problem, operation, start, index, first)
        _store(states, index, problem, solve(problem, first, guess, compiled=compiled))
    shape = operation.shape
    centre = states.pop("ball_centre").reshape(*shape, full_problem.unknowns, g.balls)
    return BearingState(
        operation,
        ball_centre=np.moveaxis(centre, -2, 0),
        **{name: value.reshape((*shape, *value.shape[1:])) for name, value in states.items()},
    )


def _groups(
    problem: Problem, operation: Operation, chosen: Flags
) -> Iterator[tuple[Index, Problem]]:
    """Yield groups of the ``chosen`` states with the same unknowns, by index and as problems."""
    is_axial, free = operation.axial, operation.free & np.array([True, *[False] * 4])
    axial_part = replace(problem, assembly=axial_assembly(problem.geometry), free=free)
    # in an axial state all other components stay at zero by symmetry
    for part, group in ((axial_part, is_axial), (problem, ~is_axial)):
        share = TOGETHER // part.assembly.balls + 1
        for index, alike in part.parts(chosen & group):
            for k in np.array_split(np.arange(index.size), -(-index.size // share)):
                yield index[k], alike.take(k)


def _neighbour(
    problem: Problem,
    operation: Operation,
    start: BearingState,
    index: Index,
    first: Array,
) -> tuple[Array, Array]:
    """Start (d, X) from neighbouring states; ``first`` and seats at rest where one is missing."""
    theirs, ours = start.operation.grooves, operation.grooves
    if any(getattr(theirs, name) != getattr(ours, name) for name in ALIKE):
        names = ", ".join(ours.raceways)
        raise InvalidBearing(f"start must be a state of a bearing of this kind, raceways {names}")
    if start.outcome.shape != operation.shape or start.inner_load.shape[-1] != (
        problem.geometry.balls
    ):
        raise InvalidBearing(
            f"start must be a state of this bearing with batch shape {operation.shape} and "
            f"{problem.geometry.balls} balls, got {start.outcome.shape} and "
            f"{start.inner_load.shape[-1]} balls"
        )
    balls = start.ball_centre.reshape(len(start.ball_centre), len(operation.speed), -1)[:, index]
    if len(balls) != problem.unknowns:  # of rings that were rigid, or that are now
        shifts = np.zeros((problem.unknowns - 2, *balls.shape[1:]))
        balls = np.concatenate([balls[:2], shifts])
    balls = balls[..., : problem.assembly.balls]  # all balls of an axial state are equal
    usable = np.asarray(np.isfinite(balls).all(axis=(0, 2))) & problem.law.one_branch
    displacement = start.displacement.reshape(-1, 5)[index]
    first = np.where(usable[:, None] & problem.free, displacement, first)
    a = problem.centres(first)
    seats = np.stack(resting_seat(problem.geometry, (a[0], a[1])))
    balls[:2] = np.where(usable[:, None], balls[:2], seats)
    balls[2:] = np.where(usable[:, None], balls[2:], 0.0)
    return first, balls


def _blank(problem: Problem, operation: Operation, outcome: Words) -> Arrays:
    """Arrays for every field, NaN until a state is solved."""
    g = problem.geometry
    contacts = (g.balls, len(g.sides))
    shapes = {"residual": (), "load": (5,), "displacement": (5,), "complete_stiffness": (5, 5)}
    shapes |= dict.fromkeys(BY_BALL, (g.balls,)) | dict.fromkeys(BY_CONTACT, contacts)
    shapes |= {"ball_centre": (problem.unknowns, g.balls)}
    count = len(outcome)
    states: Arrays = {name: np.full((count, *shape), np.nan) for name, shape in shapes.items()}
    states["status"] = np.full((count, g.balls), "", dtype="<U12")
    return states | {"speed": operation.speed, "outcome": outcome}


def _store(states: Arrays, index: Index, problem: Problem, solution: Solution) -> None:
    """Write the states that exist, and the outcome of all."""
    values = _of_balls(problem, solution) | {
        "load": np.where(problem.free, problem.load, solution.ring_load),
        "displacement": solution.displacement,
        "residual": solution.residual,
        "complete_stiffness": solution.stiffness,
        "ball_centre": solution.ball.swapaxes(0, 1),
    }
    pressure = np.maximum(values["inner_pressure"], values["outer_pressure"])
    apart = (values["status"] == "open side") & (values["inner_angle"] < -STRAIGHT)  # the rings
    pressure = np.where(apart, 0.0, pressure).max(axis=-1)
    crushed = (solution.outcome == "") & (pressure > CRUSHED)
    outcome = np.where(crushed, "overloaded", solution.outcome)
    states["outcome"][index] = outcome
    solved = np.flatnonzero(outcome == "")
    for name, value in values.items():
        states[name][index[solved]] = value[solved]


def _of_balls(problem: Problem, solution: Solution) -> Arrays:
    """Fields of the states by ball and by contact."""
    g, b = problem.geometry, solution.balance
    load, sin, cos = _by_side(g, solution.contacts)
    qi, qo, mg = b.inner_load, b.outer_load, b.gyroscopic_moment
    inner, outer = g.races
    pressure = np.concatenate(
        [g.inner.peak_pressure(load[inner]), g.outer.peak_pressure(load[outer])]
    )
    angle = np.arctan2(g.sides[:, None, None] * sin, cos)
    inner_angle, outer_angle = np.arctan2(*b.inner_direction), np.arctan2(*b.outer_direction)
    if g.single:  # also without load the directions of the contacts
        inner_angle, outer_angle = np.arctan2(solution.contacts.sin, solution.contacts.cos)
    idle = "lost contact" if problem.turning else "unloaded"
    word = np.where((inner_angle < STRAIGHT) & (not g.both_ways), "open side", "loaded")
    by_contact = (load, np.where(load > 0.0, angle, np.nan), pressure)
    return {
        "inner_load": qi,
        "outer_load": qo,
        "inner_angle": inner_angle,
        "outer_angle": outer_angle,
        "inner_pressure": pressure[inner].max(axis=0),
        "outer_pressure": pressure[outer].max(axis=0),
        "centrifugal_force": np.broadcast_to(b.centrifugal_force, qi.shape),
        "gyroscopic_moment": mg,
        "inner_required_friction": _required_friction(b.inner_share * mg, qi, g.ball_diameter),
        "outer_required_friction": _required_friction(
            (2.0 - b.inner_share) * mg, qo, g.ball_diameter
        ),
        "status": np.where(qi > 0.0, word, idle),
    } | {name: np.moveaxis(v, 0, -1) for name, v in zip(BY_CONTACT, by_contact, strict=True)}


def _by_side(g: Geometry, of_grooves: Contacts) -> Contacts:
    """Contacts (c, s, n) as in results: one groove a ring bears on the side of its angle."""
    if not g.by_side:
        return of_grooves
    load, sin, cos = (part[g.groove_of] for part in of_grooves)
    one_arc = g.by_contact(len(g.inner_grooves) == 1, len(g.outer_grooves) == 1)
    elsewhere = (sin > -STRAIGHT) != (g.sides > 0.0)[:, None, None]
    return Contacts(np.where(one_arc[:, None, None] & elsewhere, 0.0, load), sin, cos)


def _required_friction(moment: Array, load: Array, diameter: float) -> Array:
    """Friction coefficient that holds λ Mg at a race: λ |Mg| / (D Q); 0 without load."""
    return np.where(load > 0.0, np.abs(moment) / (diameter * np.where(load > 0.0, load, 1.0)), 0.0)
