"""Motion over time under forces, from the preload state on.

The machine is solved twice: with the tangents of its bearings, and with their law. Steps are halved
until the motion changes by less than is asked for.

Theory: docs/theory/time_response.md.
"""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from rotordyn.allowance import require_marching
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.forces import applied, sizes
from rotordyn.analyses.time_response.march import Path, march
from rotordyn.analyses.time_response.remainder import Remainder
from rotordyn.analyses.time_response.result import TimeResponseResult
from rotordyn.analyses.time_response.spec import DIRECTIONS, TimeResponseSpec
from rotordyn.arrays import Array, Indices
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.preload.arrangement import SHAFT
from rotordyn.scene.refinement import changes, response_accuracy, solve_accurately
from rotordyn.scene.scene import Scene

HALVINGS = 4  # of the steps, at most
LEAST = 0.1  # of the error asked for is left to the steps
AXES = len(DIRECTIONS)


class Motion(NamedTuple):
    """A path at the instants of the result, and its estimated error over the largest displacement
    of each point (points,)."""

    path: Path
    error: Array


def answer(scene: Scene, spec: TimeResponseSpec) -> TimeResponseResult:
    """At every speed with a state.

    Raises
    ------
    NoSolution : no speed has one
    """
    for k in scene.with_motions(("bending", "axial")):
        scene.system(k)  # tells of instability (``Scene.warnings``)
    seats = len(scene.spindle.seats)
    require_marching("time_response", len(scene.usable) * seats, 0.75 * spec.samples)
    scene, linear = solve_accurately(
        scene, partial(_linear, spec), lambda motion: float(motion.error.max())
    )
    if not seats:
        return _result(scene, spec, linear, linear.path, None)
    bearings, left = Remainder.of(scene), response_accuracy(scene) - np.nanmax(linear.error)
    nonlinear = _nonlinear(scene, spec, bearings, max(left, LEAST * response_accuracy(scene)))
    both = nonlinear._replace(error=nonlinear.error + linear.error)
    return _result(scene, spec, both, linear.path, bearings)


def _linear(spec: TimeResponseSpec, scene: Scene) -> Motion:
    """Of the linear machine; its error is the change by a finer model."""
    path = _path(scene, spec, spec.samples // 2)
    if scene.rigid or not scene.checks.wanted:
        return Motion(path, np.full(len(spec.points), 0.0 if scene.rigid else np.nan))

    def values(one: Scene, rows: Indices) -> Array:
        return _displacement(_path(one, spec, spec.samples // 2, rows=rows), spec)

    return Motion(path, changes(scene, values, 2))


def _nonlinear(scene: Scene, spec: TimeResponseSpec, bearings: Remainder, wanted: float) -> Motion:
    """With the law of the bearings; its error is the change by the last halving of the steps, if it
    can be below what is ``wanted``."""
    count = spec.samples // 4
    path = _path(scene, spec, count, bearings)
    for halving in range(HALVINGS):
        before, path = path, _path(scene, spec, 2 ** (halving + 1) * count, bearings)
        here = _displacement(path.every(2), spec)
        change = np.abs(here - _displacement(before, spec))
        size = np.nan_to_num(np.abs(here)).max(axis=(0, 1, 3))
        error = np.nan_to_num(change).max(axis=(0, 1, 3)) / np.where(size > 0.0, size, 1.0)
        if error.max() <= wanted and not path.unsettled.any():
            break
    return Motion(path.every(2**halving), error)


def _path(
    scene: Scene,
    spec: TimeResponseSpec,
    count: int,
    bearings: Remainder | None = None,
    rows: Indices | None = None,
) -> Path:
    """In so many steps, at all usable speeds or at some ``rows`` of them."""
    equation = Equation.of(scene, spec, rows)
    speed = scene.speed[scene.usable] if rows is None else scene.speed[scene.usable[rows]]
    ratios = [scene.spindle.ratios[scene.spindle.place(each.at).rotor] for each in spec.unbalances]
    force = partial(applied, spec, speed[:, None] * np.array(ratios))
    return march(equation, force, spec.duration / count, count, bearings, scene.progress)


def _displacement(path: Path, spec: TimeResponseSpec) -> Array:
    """Of the points (s, t, points, 3)."""
    watched = path.watched[..., : AXES * len(spec.points)]
    return watched.reshape(*watched.shape[:2], len(spec.points), AXES)


def _result(
    scene: Scene, spec: TimeResponseSpec, motion: Motion, linear: Path, bearings: Remainder | None
) -> TimeResponseResult:
    path, time = motion.path, np.linspace(0.0, spec.duration, spec.samples)
    moved, straight = _displacement(path, spec), _displacement(linear, spec)
    load, at, pressure, idle = _of_bearings(scene, path, bearings)
    far, size = _largest(moved)
    return TimeResponseResult(
        speed=scene.speed,
        time=time,
        point=spec.points,
        axis=DIRECTIONS,
        bearing=tuple(seat.name for seat in scene.spindle.seats),
        sleeve=tuple(sleeve.name for sleeve in scene.spindle.sleeves),
        force=tuple(each.name or f"force {k}" for k, each in enumerate(spec.forces, start=1)),
        outcome=scene.outcome,
        ended=scene.scattered(time[np.minimum(path.lost, spec.samples) - 1]),
        applied=np.stack([sizes(each, time) for each in spec.forces], axis=1)
        if spec.forces
        else np.zeros((spec.samples, 0)),
        displacement=scene.scattered(moved),
        linear_displacement=scene.scattered(straight),
        bearing_load=scene.scattered(load),
        largest=scene.scattered(size),
        largest_time=scene.scattered(time[far]),
        linear_largest=scene.scattered(_largest(straight)[1]),
        peak_load=scene.scattered(_largest(load)[1]),
        peak_time=scene.scattered(time[at]),
        peak_pressure=scene.scattered(pressure),
        peak_idle=scene.scattered(idle),
        stop_gap=scene.scattered(_stop_gaps(scene, path.watched[..., AXES * len(spec.points) :])),
        error=motion.error,
        error_asked=response_accuracy(scene),
    )


def _largest(values: Array) -> tuple[Indices, Array]:
    """When vectors (s, t, n, 3) are longest (s, n), and how long they are."""
    length = np.nan_to_num(np.linalg.norm(values, axis=-1))
    return length.argmax(axis=1), length.max(axis=1)


def _of_bearings(
    scene: Scene, path: Path, bearings: Remainder | None
) -> tuple[Array, Indices, Array, Array]:
    """Loads of the shaft on them (s, t, seats, 3) in the directions of the spindle; the instant at
    which that is largest, and there the contact pressure and the balls without load (s, seats)."""
    seats = scene.spindle.seats
    shape = (*path.watched.shape[:2], len(seats))
    if bearings is None:
        none = np.zeros((shape[0], shape[2]))
        return np.zeros((*shape, AXES)), none.astype(np.intp), none, none
    rings, beyond = (part.reshape(*shape, 5) for part in (path.rings, path.beyond))
    load = bearings.load[:, None] + beyond
    load = load + np.einsum("skij,stkj->stki", bearings.tangent, rings)
    thrust = np.array([seat.thrust for seat in seats])
    turn = np.where(thrust[:, None] < 0, HALF_TURN_ABOUT_Y[:AXES], 1.0)
    load = load[..., :AXES] * turn
    at = _largest(load)[0]
    there = np.take_along_axis(rings, at[:, None, :, None], axis=1)[:, 0]
    return load, at, *bearings.balls_at(np.nan_to_num(there))


def _stop_gaps(scene: Scene, way: Array) -> Array:
    """Least gap of the end stops (s, sleeves) where sleeves move along the axis (s, t, sleeves);
    NaN of those without a stop, or that stand at it."""
    if not scene.spindle.sleeves or not scene.spindle.seats:
        return np.full((len(way), way.shape[-1]), np.nan)
    state, rows = scene.preload, scene.bearing_row[scene.usable]
    outward = state.network.arrangement.direction[SHAFT + 1 :]
    gap = state.stop_gaps()[rows] + np.nanmin(outward * way, axis=1)
    stops = np.isfinite(state.limit[SHAFT + 1 :])
    return np.where(stops & ~state.stopped[rows], gap, np.nan)
