"""Solved states put back into the caller's shape."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.geometry import Geometry
from bearings.ring.data import Cause
from bearings.ring.equilibrium import Solution
from bearings.ring.problem import Problem
from bearings.ring.question import Question
from bearings.ring.state import BearingState

Array = NDArray[np.float64]
BALL_FIELDS = (
    "inner_load",
    "outer_load",
    "inner_angle",
    "outer_angle",
    "inner_pressure",
    "outer_pressure",
    "centrifugal_force",
    "gyroscopic_moment",
    "inner_grip",
    "outer_grip",
)
CONTACT_FIELDS = ("contact_load", "contact_angle", "contact_pressure")


def blank(g: Geometry, question: Question, outcome: NDArray[np.str_]) -> dict[str, NDArray[Any]]:
    """Arrays for every field, NaN until a state is found."""
    count = len(question.speed)
    states: dict[str, NDArray[Any]] = {
        name: np.full((count, g.balls), np.nan) for name in BALL_FIELDS
    }
    touching = len(g.inner_grooves) + len(g.outer_grooves)
    states |= {name: np.full((count, touching, g.balls), np.nan) for name in CONTACT_FIELDS}
    states["load"] = np.full((count, 5), np.nan)
    states["residual"] = np.full(count, np.nan)
    states["displacement"] = np.full((count, 5), np.nan)
    states["complete_stiffness"] = np.full((count, 5, 5), np.nan)
    states["status"] = np.full((count, g.balls), "", dtype="<U12")
    states["ball_centre"] = np.full((count, 2, g.balls), np.nan)
    states["speed"] = question.speed
    states["outcome"] = outcome
    return states


def store(
    states: dict[str, NDArray[Any]], index: NDArray[np.intp], problem: Problem, solution: Solution
) -> None:
    """Write the states that exist; note the outcome of the others."""
    states["outcome"][index] = solution.outcome
    found = np.flatnonzero(solution.outcome == "")
    good, into = _places(found), _places(index[found])
    b, g = solution.balance, problem.geometry
    qi, qo, mg = b.inner_load[good], b.outer_load[good], b.gyroscopic_moment[good]
    share = np.broadcast_to(b.inner_share, b.inner_load.shape)[good]
    states["load"][into] = np.where(problem.free, problem.load, solution.ring_load)[good]
    states["displacement"][into] = solution.displacement[good]
    states["residual"][into] = solution.residual[good]
    states["complete_stiffness"][into] = solution.stiffness[good]
    states["ball_centre"][into] = solution.ball[:, good].swapaxes(0, 1)
    load, sin, cos = solution.contacts
    races = [g.inner] * len(g.inner_grooves) + [g.outer] * len(g.outer_grooves)
    pressure = [race.peak_pressure(q[good]) for race, q in zip(races, load, strict=True)]
    sides = _sides(g)
    angle = [
        np.arctan2(s if w > 0.0 else -s, c)[good] for s, c, w in zip(sin, cos, sides, strict=True)
    ]
    for k, (q, turned, peak) in enumerate(zip(load, angle, pressure, strict=True)):
        states["contact_load"][into, k] = q[good]
        states["contact_angle"][into, k] = np.where(q[good] > 0.0, turned, np.nan)
        states["contact_pressure"][into, k] = peak
    inner, single = len(g.inner_grooves), g.single
    inner_angle = angle[0] if single else np.arctan2(*b.inner_direction)[good]
    values = (
        qi,
        qo,
        inner_angle,
        angle[1] if single else np.arctan2(*b.outer_direction)[good],
        _largest(pressure[:inner]),
        _largest(pressure[inner:]),
        np.broadcast_to(b.centrifugal_force[good], qi.shape),
        mg,
        _grip(share * mg, qi, g.ball_diameter),
        _grip((2.0 - share) * mg, qo, g.ball_diameter),
    )
    for name, value in zip(BALL_FIELDS, values, strict=True):
        states[name][into] = value
    idle = "lost contact" if problem.turning else "unloaded"
    word = np.where((inner_angle < 0.0) & (not g.both_ways), "open side", "loaded")
    states["status"][into] = np.where(qi > 0.0, word, idle)


def _places(index: NDArray[np.intp]) -> NDArray[np.intp] | slice:
    """Places that follow one another as a slice, which copies nothing."""
    if index.size and index[-1] - index[0] + 1 == index.size:
        return slice(index[0], index[-1] + 1)
    return index


def _sides(g: Geometry) -> list[float]:
    """Sign of the axial direction in which the angle of each contact counts."""
    inner = [1.0 if x.offset >= 0.0 else -1.0 for x in g.inner_grooves]
    return inner + [1.0 if x.offset <= 0.0 else -1.0 for x in g.outer_grooves]


def _largest(of_contacts: list[Array]) -> Array:
    return of_contacts[0] if len(of_contacts) == 1 else np.maximum(*of_contacts)


def _grip(moment: Array, load: Array, diameter: float) -> Array:
    """Friction coefficient that holds λ Mg at a race: λ |Mg| / (D Q); 0 where nothing presses."""
    return np.where(load > 0.0, np.abs(moment) / (diameter * np.where(load > 0.0, load, 1.0)), 0.0)


def state(states: dict[str, NDArray[Any]], shape: tuple[int, ...], cause: Cause) -> BearingState:
    """Fields back in the caller's shape."""
    centre = states.pop("ball_centre")
    shaped = {name: value.reshape((*shape, *value.shape[1:])) for name, value in states.items()}
    shaped |= {name: shaped[name].swapaxes(-1, -2) for name in CONTACT_FIELDS}
    centre = centre.reshape((*shape, *centre.shape[1:]))
    return BearingState(cause=cause, ball_centre=np.moveaxis(centre, -2, 0), **shaped)
