"""From what a caller asks (any batch shape) to solved states: checks, groups, broadcasts."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearings.angular_contact import AngularContactBallBearing
from bearings.ball import BallModel
from bearings.convex import resting_seat
from bearings.equilibrium import Solution, solve
from bearings.errors import InvalidBearing, NoEquilibrium
from bearings.geometry import Geometry, geometry
from bearings.kinematics import HYPOTHESES, SHARINGS
from bearings.problem import Problem
from bearings.ring import axial_ring, full_ring
from bearings.state import BearingState

Array = NDArray[np.float64]
SLOW = 2e-9  # of the groove reach: a ball pressed in less by its own motion is at rest

REMEDIES = {
    "unloaded": "no load presses the rings together; give a load, or a displacement",
    "no equilibrium": (
        "the balls lose their hold between rest and this speed; raise the load, lower the speed, "
        "or use outer or hybrid kinematics"
    ),
    "no contact angle": "static growth takes the whole contact angle; reduce the fit",
}


@dataclass(frozen=True, eq=False, slots=True)
class Request:
    """What is asked, as a list of states: ``given`` (s, 5) is a load or a displacement."""

    by_load: bool
    given: Array
    speed: Array
    static_growth: Array
    growth: Array
    shape: tuple[int, ...]

    def groups(
        self, model: BallModel, outcome: NDArray[np.str_]
    ) -> Iterator[tuple[NDArray[np.intp], bool, bool]]:
        """States alike in what must be solved: (index, axial?, turning?).

        A speed whose centrifugal force does not press a ball measurably into its race is rest.
        """
        g = model.geometry
        depth = (model.nominal_centrifugal(self.speed) / g.outer.stiffness) ** (2.0 / 3.0)
        is_axial, is_turning = (self.given[:, 1:] == 0.0).all(axis=1), depth > SLOW * g.outer_reach
        for axial in (True, False):
            for turning in (True, False):
                chosen = (is_axial == axial) & (is_turning == turning) & (outcome == "")
                if chosen.any():
                    yield np.flatnonzero(chosen), axial, turning


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
    start: BearingState | None,
) -> BearingState:
    """See ``AngularContactBallBearing.equilibrium``."""
    _check_name("kinematics", kinematics, HYPOTHESES)
    _check_name("moment_sharing", moment_sharing, SHARINGS)
    request = _request(load, displacement, speed, static_growth, growth)
    model = BallModel.named(geometry(bearing), kinematics, moment_sharing)
    origin, outcome = _origin(model.geometry, request)
    states = _blank(model.geometry, request, outcome)
    for index, axial, turning in request.groups(model, outcome):
        problem = _problem(model, request, origin, index, axial=axial, turning=turning)
        first = _first(problem, request, index)
        near = None
        if start is not None and turning:
            first, near = _neighbour(problem, request, start, index, first)
        _store(states, index, problem, solve(problem, first, near))
    if request.shape == () and states["outcome"][0]:
        word = str(states["outcome"][0])
        raise NoEquilibrium(word, speed=float(request.speed[0]), remedy=REMEDIES[word])
    return _state(states, request.shape)


def _request(
    load: ArrayLike | None,
    displacement: ArrayLike | None,
    speed: ArrayLike,
    static_growth: ArrayLike,
    growth: ArrayLike | None,
) -> Request:
    if (load is None) == (displacement is None):
        raise InvalidBearing("give exactly one of load and displacement")
    by_load = displacement is None
    given = _finite("load" if by_load else "displacement", load if by_load else displacement)
    if given.ndim < 1 or given.shape[-1] != 5:
        raise InvalidBearing(f"load or displacement must have shape (…, 5), got {given.shape}")
    omega, static = _finite("speed", speed), _finite("static_growth", static_growth)
    total = static if growth is None else _finite("growth", growth)
    try:
        shape = np.broadcast_shapes(given.shape[:-1], omega.shape, static.shape, total.shape)
    except ValueError as error:
        raise InvalidBearing(f"leading shapes do not fit together: {error}") from error
    flat = [np.broadcast_to(v, shape).reshape(-1) for v in (omega, static, total)]
    return Request(
        by_load=by_load,
        given=np.broadcast_to(given, (*shape, 5)).reshape(-1, 5),
        speed=np.abs(flat[0]),
        static_growth=flat[1],
        growth=flat[2],
        shape=shape,
    )


def _finite(name: str, value: ArrayLike | None) -> Array:
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise InvalidBearing(f"{name} must be numbers, got {value!r}") from error
    if not np.isfinite(array).all():
        raise InvalidBearing(f"{name} must be finite, got {value!r}")
    return array


def _check_name(what: str, name: str, known: Iterable[str]) -> None:
    if name in known:
        return
    close = difflib.get_close_matches(str(name), known, n=1)
    hint = f" (did you mean {close[0]!r}?)" if close else ""
    raise InvalidBearing(f"{what} must be one of {', '.join(known)}, got {name!r}{hint}")


def _origin(g: Geometry, request: Request) -> tuple[Array, NDArray[np.str_]]:
    """A₀ (2, s) at zero displacement, and the outcome of the states that have none.

    The axial part is zeroed with the STATIC growth, the radial part carries the growth at speed.
    """
    cosine = np.cos(g.contact_angle) + request.static_growth / g.free_distance
    possible = np.abs(cosine) <= 1.0
    axial = g.free_distance * np.sqrt(np.where(possible, 1.0 - cosine**2, 0.0))
    radial = g.free_distance * np.cos(g.contact_angle) + request.growth
    outcome = np.where(possible, "", "no contact angle").astype("<U16")
    if request.by_load:
        outcome[(request.given == 0.0).all(axis=1) & possible] = "unloaded"
    return np.stack([axial, radial]), outcome


def _problem(
    model: BallModel,
    request: Request,
    origin: Array,
    index: NDArray[np.intp],
    *,
    axial: bool,
    turning: bool,
) -> Problem:
    free = np.array([request.by_load] + [request.by_load and not axial] * 4)
    return Problem(
        model=model,
        ring=axial_ring(model.geometry) if axial else full_ring(model.geometry),
        origin=origin[:, index],
        speed=request.speed[index],
        load=request.given[index] if request.by_load else np.zeros((index.size, 5)),
        free=free,
        turning=turning,
    )


def _first(problem: Problem, request: Request, index: NDArray[np.intp]) -> Array:
    """Displacement to start from; for a load, one that seats all balls under its likely share."""
    if not request.by_load:
        return request.given[index].copy()
    g = problem.model.geometry
    thrust = np.abs(problem.load[:, :3]).max(axis=1) + np.abs(problem.load[:, 3:]).max(axis=1) / (
        g.pitch_diameter / 2.0
    )
    share = thrust / (g.balls * max(np.sin(g.contact_angle), 0.2))
    length = g.free_distance + (share / g.series_stiffness) ** (2.0 / 3.0)
    radial = np.minimum(np.abs(problem.origin[1]), 0.999 * length)
    side = np.where(problem.load[:, 0] < 0.0, -1.0, 1.0)
    d = np.zeros((len(index), 5))
    d[:, 0] = side * np.sqrt(length**2 - radial**2) - problem.origin[0]
    return d


def _neighbour(
    problem: Problem,
    request: Request,
    start: BearingState,
    index: NDArray[np.intp],
    first: Array,
) -> tuple[Array, Array | None]:
    """(d, X) of a neighbouring state as a start, or (first, None) where it has no such state."""
    if start.outcome.shape != request.shape or start.inner_load.shape[-1] != (
        problem.model.geometry.balls
    ):
        raise InvalidBearing(
            f"start must be a state of this bearing with batch shape {request.shape}, got "
            f"{start.outcome.shape}"
        )
    near = start.ball_centre.reshape(2, len(request.speed), -1)[:, index]
    near = near[..., : problem.ring.balls]  # of an axial state all balls are alike
    known = np.asarray(np.isfinite(near).all(axis=(0, 2)))
    if request.by_load:
        there = start.displacement.reshape(-1, 5)[index]
        first = np.where(known[:, None], there, first)
    centre = problem.ring.centres(problem.origin, first)
    return first, np.where(known[:, None], near, resting_seat(problem.model.geometry, centre))


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


def _blank(g: Geometry, request: Request, outcome: NDArray[np.str_]) -> dict[str, NDArray[Any]]:
    """Arrays for every field, NaN until a state is found."""
    count = len(request.speed)
    states: dict[str, NDArray[Any]] = {
        name: np.full((count, g.balls), np.nan) for name in BALL_FIELDS
    }
    states["load"] = np.full((count, 5), np.nan)
    states["displacement"] = np.full((count, 5), np.nan)
    states["complete_stiffness"] = np.full((count, 5, 5), np.nan)
    states["status"] = np.full((count, g.balls), "", dtype="<U12")
    states["ball_centre"] = np.full((count, 2, g.balls), np.nan)
    states["speed"] = request.speed
    states["outcome"] = outcome
    return states


def _store(
    states: dict[str, NDArray[Any]], index: NDArray[np.intp], problem: Problem, solution: Solution
) -> None:
    """Write the states that exist; note the outcome of the others."""
    states["outcome"][index] = solution.outcome
    good = solution.outcome == ""
    into, b, g = index[good], solution.balance, problem.model.geometry
    qi, qo, mg = b.inner_load[good], b.outer_load[good], b.gyroscopic_moment[good]
    share = np.broadcast_to(b.inner_share[good], qi.shape)
    states["load"][into] = problem.load[good] if problem.free.any() else solution.ring_load[good]
    states["displacement"][into] = solution.displacement[good]
    states["complete_stiffness"][into] = solution.stiffness[good]
    states["ball_centre"][into] = solution.ball[:, good].swapaxes(0, 1)
    values = (
        qi,
        qo,
        b.inner_angle[good],
        b.outer_angle[good],
        g.inner.peak_pressure(qi),
        g.outer.peak_pressure(qo),
        np.broadcast_to(b.centrifugal_force[good], qi.shape),
        mg,
        _grip(share * mg, qi, g.ball_diameter),
        _grip((2.0 - share) * mg, qo, g.ball_diameter),
    )
    for name, value in zip(BALL_FIELDS, values, strict=True):
        states[name][into] = value
    idle = "lost contact" if problem.turning else "unloaded"
    word = np.where(b.inner_angle[good] < 0.0, "open side", "loaded")
    states["status"][into] = np.where(qi > 0.0, word, idle)


def _grip(moment: Array, load: Array, diameter: float) -> Array:
    """Friction coefficient that holds λ Mg at a race: λ |Mg| / (D Q); 0 where nothing presses."""
    return np.where(load > 0.0, np.abs(moment) / (diameter * np.where(load > 0.0, load, 1.0)), 0.0)


def _state(states: dict[str, NDArray[Any]], shape: tuple[int, ...]) -> BearingState:
    """Fields back in the caller's shape."""
    centre = states.pop("ball_centre")
    shaped = {name: value.reshape((*shape, *value.shape[1:])) for name, value in states.items()}
    centre = centre.reshape((*shape, *centre.shape[1:]))
    return BearingState(ball_centre=np.moveaxis(centre, -2, 0), **shaped)
