"""Solver of the response over time to forces, at constant speed.

The machine is solved twice, with the tangents of its bearings and with their law. One half of the
requested error is allowed to the model, the other to the time steps, which are halved until the
motion changes by less.

Theory: docs/theory/time_response.md.
"""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from rotordyn.allowance import require_marching
from rotordyn.analyses.time_response.bearings import Bearings
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.forces import mean_inputs, values
from rotordyn.analyses.time_response.march import Path, march
from rotordyn.analyses.time_response.nonlinear import Nonlinear
from rotordyn.analyses.time_response.peaks import loads_and_peaks, longest
from rotordyn.analyses.time_response.result import TimeResponseResult
from rotordyn.analyses.time_response.sleeves import sleeve_margins
from rotordyn.analyses.time_response.spec import DIRECTIONS, TimeResponseSpec
from rotordyn.arrays import Array, Indices
from rotordyn.results.display import RPM, number
from rotordyn.scene.linearity import FAR
from rotordyn.scene.refinement import (
    AT_REST,
    changes,
    relative_change,
    response_accuracy,
    solve_accurately,
)
from rotordyn.scene.scene import Scene

HALVINGS = 4  # of the steps, at most
HALF = 0.5  # of the requested error, allowed to model and steps each
ENDINGS = {
    True: "the equilibrium of the bearings does not converge",
    False: f"it moves farther than {FAR * 1e3:g} mm",
}
WIDE = (
    f"the steady orbit, on which time_response begins, exceeds {FAR * 1e3:g} mm, as at a lightly "
    "damped critical speed: give damping, or take another speed"
)


class Motion(NamedTuple):
    """Path at the instants of the result, and its estimated error over the largest displacement of
    each point (points,); displacements of the ``sleeves`` (s, t, sleeves) at all computed instants,
    and in the previous run, ``coarser``."""

    path: Path
    error: Array
    sleeves: Array
    coarser: Array


def solve(scene: Scene, spec: TimeResponseSpec) -> TimeResponseResult:
    """Return the response at every speed with a state.

    Raises
    ------
    NoSolution : no speed has a state
    TooCostly : it would take more time or memory than a run may
    """
    for k in scene.with_motions(("bending", "axial")):
        scene.system(k)  # solves free motions, which ``Scene.warnings`` checks for instability
    seats = len(scene.spindle.seats)
    _require(Equation.of(scene, spec), spec.samples, seats)
    scene, linear = solve_accurately(
        scene, partial(_linear, spec), lambda motion: float(motion.error.max()) / HALF
    )
    equation = Equation.of(scene, spec)
    if not seats:
        return _result(scene, spec, equation, linear, linear.path, None)
    nonlinear = Nonlinear.of(scene, equation)
    motion = _nonlinear(scene, spec, equation, nonlinear)
    combined = motion._replace(error=motion.error + linear.error)
    return _result(scene, spec, equation, combined, linear.path, nonlinear.bearings)


def _require(equation: Equation, steps: int, seats: int) -> None:
    """Check time and memory of ``steps``, with the law of the bearings if there are ``seats``."""
    states, size = equation.stiffness.shape[:2]
    inputs = equation.inputs.shape[1] + 5 * seats
    outputs = len(equation.points) + len(equation.sleeves) + 10 * seats
    require_marching("time_response", states, seats, steps, 2 * size + 3 * inputs, outputs)


def _linear(spec: TimeResponseSpec, scene: Scene) -> Motion:
    """Return motion of the linear machine, in steps of half the usual length; its error is the
    change by a finer model in steps half as long again."""
    equation, count = Equation.of(scene, spec), spec.samples - 1
    path = _path(scene, spec, equation, count).every(2)
    if not scene.checks.wanted:
        return _motion(path, np.full(len(spec.points), np.nan))

    def moved(model: Scene, rows: Indices) -> Array:
        finer = 2 if model is not scene else 1
        finer_path = _path(model, spec, Equation.of(model, spec, rows), finer * count)
        return np.nan_to_num(_displacement(finer_path.every(2 * finer)))

    return _motion(path, changes(scene, moved, 2, AT_REST))


def _motion(path: Path, error: Array) -> Motion:
    """Return the motion of a single run, without a coarser one."""
    return Motion(path, error, path.sleeves, path.sleeves)


def _nonlinear(
    scene: Scene, spec: TimeResponseSpec, equation: Equation, nonlinear: Nonlinear
) -> Motion:
    """Return motion with the law of the bearings, and stops; its error is the change by the last
    halving of the steps."""
    count = spec.samples // 4
    if not scene.checks.wanted:
        path = _path(scene, spec, equation, 2 * count, nonlinear)
        return _motion(path, np.full(len(spec.points), np.nan))
    path, wanted = _path(scene, spec, equation, count, nonlinear), HALF * response_accuracy(scene)
    for halving in range(HALVINGS):
        if halving:
            _require(equation, 2 ** (halving + 1) * count, len(scene.spindle.seats))
        coarser, path = path, _path(scene, spec, equation, 2 ** (halving + 1) * count, nonlinear)
        fine, coarse = _displacement(path.every(2)), _displacement(coarser)
        error = relative_change(np.nan_to_num(coarse), np.nan_to_num(fine), 2, AT_REST)
        instants = len(path.points[0])
        if error.max() <= wanted and (path.ended == instants).all():
            break
    return Motion(path.every(2**halving), error, path.sleeves, coarser.sleeves)


def _path(
    scene: Scene,
    spec: TimeResponseSpec,
    equation: Equation,
    count: int,
    nonlinear: Nonlinear | None = None,
) -> Path:
    """Integrate the motion in ``count`` steps, from the steady orbit of the unbalances."""
    inputs = partial(mean_inputs, spec, equation.speed)
    initial = _steady_start(spec, equation)
    step = spec.duration / count
    return march(equation, inputs, step, count, initial, nonlinear, scene.clock.progress)


def _steady_start(spec: TimeResponseSpec, equation: Equation) -> tuple[Array, Array]:
    """Return q and q̇ (s, n) at time 0 of the steady orbit of the linear machine; infinite at a
    critical speed without damping, which has none."""
    s, n, _ = equation.stiffness.shape
    initial, place = np.zeros((2, s, n)), {port: k for k, port in enumerate(spec.ports)}
    for unbalance, omega in zip(spec.unbalances, equation.speed.T, strict=True):
        along_y, along_z = (equation.inputs[:, place[unbalance.at, axis]] for axis in ("y", "z"))
        size = unbalance.unbalance * omega**2 * np.exp(1j * unbalance.angle)
        load = size[:, None] * (along_y - 1j * along_z)  # along z a quarter of a turn later
        iomega = 1j * omega[:, None, None]
        dynamic = equation.stiffness + iomega * equation.damping + iomega**2 * np.eye(n)
        for row in np.flatnonzero(omega):
            try:
                moved = np.linalg.solve(dynamic[row], load[row])
            except np.linalg.LinAlgError:
                initial[:, row] = np.inf
                continue
            initial[:, row] += moved.real, (1j * omega[row] * moved).real
    return initial[0], initial[1]


def _displacement(path: Path) -> Array:
    """Return the displacement of the points (s, t, points, 3)."""
    return path.points.reshape(*path.points.shape[:2], -1, len(DIRECTIONS))


def _result(
    scene: Scene,
    spec: TimeResponseSpec,
    equation: Equation,
    motion: Motion,
    linear: Path,
    bearings: Bearings | None,
) -> TimeResponseResult:
    path, time = motion.path, np.linspace(0.0, spec.duration, spec.samples)
    displacement, linear_displacement = _displacement(path), _displacement(linear)
    (when, size), late = longest(displacement, time), 3 * (spec.samples // 4)
    outcome, ending = [*scene.outcome], ["" for _ in scene.speed]
    for row, k in enumerate(scene.usable):
        if not path.ended[row]:
            outcome[k] = f"at {number(scene.speed[k] * RPM.factor, 0)} rpm {WIDE}"
        elif path.ended[row] < spec.samples:
            ending[k] = ENDINGS[bool(path.unbalanced[row])]
    late_size = longest(displacement[:, late:], time[late:])[1]
    late_size[path.ended < spec.samples] = np.nan
    loads = loads_and_peaks(scene, path, time, bearings)
    margins = sleeve_margins(scene, equation, path.sleeves, motion.sleeves, motion.coarser)
    ended = time[np.minimum(path.ended, spec.samples) - 1]
    begun = path.ended > 0

    def scattered(values: Array) -> Array:
        """Scatter values over all speeds, NaN at those without a motion."""
        return scene.scattered(
            np.where(begun.reshape(-1, *[1] * (values.ndim - 1)), values, np.nan)
        )

    applied = [values(force, time) for force in spec.forces]
    return TimeResponseResult(
        speed=scene.speed,
        time=time,
        point=spec.points,
        axis=DIRECTIONS,
        bearing=tuple(seat.name for seat in scene.spindle.seats),
        sleeve=tuple(sleeve.name for sleeve in scene.spindle.sleeves),
        force=spec.names,
        outcome=tuple(outcome),
        ended=scattered(ended),
        ending=tuple(ending),
        applied=np.array(applied).reshape(len(spec.forces), spec.samples).T,
        displacement=scattered(displacement),
        linear_displacement=scattered(linear_displacement),
        largest=scattered(size),
        late_largest=scattered(late_size),
        largest_time=scattered(when),
        linear_largest=scattered(longest(linear_displacement, time)[1]),
        **{name: scattered(field) for name, field in loads.items()},
        **{name: scattered(field) for name, field in margins.items()},
        unbalances=len(spec.unbalances),
        friction_limit=np.array([sleeve.friction for sleeve in scene.spindle.sleeves]),
        error=motion.error,
        error_asked=response_accuracy(scene),
    )
