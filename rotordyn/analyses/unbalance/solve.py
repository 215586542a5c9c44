"""Solver of the steady response to unbalance: orbits at points, forces of bearings and supports.

Bearings have the tangents of their preload state at each speed.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.unbalance.loads import acting, unbalanced
from rotordyn.analyses.unbalance.orbit import orbit
from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.analyses.unbalance.runs import runs_of
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.steady import (
    AXES,
    Steady,
    displacements,
    out_of_balance,
    steady,
)
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.equation.dofs import position
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.equation.linear import Linear
from rotordyn.equation.squeeze_film import film_coefficients
from rotordyn.errors import NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.modes.criticals import Critical, criticals_up_to
from rotordyn.numerics.peaks import NARROW, tops
from rotordyn.scene.linearity import departure, ring_rows
from rotordyn.scene.refinement import (
    AT_REST,
    changes,
    response_accuracy,
    sensitive_rows,
    solve_accurately,
)
from rotordyn.scene.sampling import over_speed
from rotordyn.scene.scene import Scene

UNDAMPED = 1e-9  # of the speed: a pole this near to the excitation has no damping
BESIDE = 0.2 * NARROW  # of a speed: distance from a pole without damping at which lines break


def solve(scene: Scene, spec: UnbalanceSpec) -> UnbalanceResult:
    """Return the response at every speed with a steady solution, by a model refined to the accuracy
    of the case.

    Raises
    ------
    NoSolution : no speed has a steady solution
    """
    for k in out_of_balance(scene, spec):
        scene.system(k)  # solves free motions, which ``Scene.warnings`` checks for instability
    spindle, rotor = scene.spindle, unbalanced(scene.spindle, spec)
    ratio = spindle.ratios[rotor]
    scene = scene.whirling(abs(ratio))
    scene, error = solve_accurately(
        scene,
        lambda model: _errors(model, spec, ratio),
        lambda errors: float(np.nanmax(errors, initial=0.0)),
    )
    speed = ratio * scene.speed[scene.usable]
    motions = [scene.system(k) for k in out_of_balance(scene, spec)]
    absent = [max(words) for words in zip(*(_absences(m, speed) for m in motions), strict=True)]
    counts = (speed != 0.0) | (speed == 0.0).all()  # at rest no unbalance force acts
    causes = [word for word, rotates in zip(absent, counts, strict=True) if rotates]
    if all(causes):
        raise NoSolution(f"no speed of the case has a steady response to unbalance: {causes[0]}")
    is_steady = np.array([word == "" for word in absent])
    motion, forces, departures = _response(spec, ratio, scene)
    motion[~is_steady] = forces[~is_steady] = complex(np.nan, np.nan)
    departures[~is_steady] = np.nan
    displacement, force = scene.scattered(motion), scene.scattered(forces)
    ellipse = orbit(displacement[..., 0], displacement[..., 1])
    loads = acting(spindle, scene.mesh, spec)
    critical = _criticals(scene, ratio)
    fine, (fine_motion, fine_forces, fine_apart) = _sampled(scene, spec, ratio, critical)
    undefined = np.isin(fine, scene.speed[scene.usable][~is_steady])
    fine_motion[undefined] = fine_forces[undefined] = complex(np.nan, np.nan)
    unbounded = [one.speed for one in critical if abs(one.damping_ratio) <= UNDAMPED]
    peaks, pushes = (
        _peaks(fine, orbit(values[..., 0], values[..., 1]).major, unbounded)
        for values in (fine_motion, fine_forces)
    )
    for at in unbounded:
        undefined |= np.abs(fine - at) <= BESIDE * at
    fine_motion[undefined] = fine_forces[undefined] = complex(np.nan, np.nan)
    fine_apart[undefined] = np.nan
    fine_orbit = orbit(fine_motion[..., 0], fine_motion[..., 1])
    fine_force = orbit(fine_forces[..., 0], fine_forces[..., 1]).major
    outcome = _outcome(scene, absent)
    runs = runs_of(scene, spec, ratio, outcome)
    return UnbalanceResult(
        speed=scene.speed,
        point=spec.points,
        axis=AXES,
        support=tuple(link.name for link in spindle.connections),
        unbalance=tuple(load.name for load in loads),
        critical=tuple(one.mode for one in critical),
        outcome=outcome,
        unstable=scene.scattered(np.any([part.growing.any(axis=1) for part in motions], axis=0)),
        displacement=displacement,
        amplitude=np.abs(displacement),
        phase=np.angle(displacement),
        major_axis=ellipse.major,
        minor_axis=ellipse.minor,
        inclination=ellipse.inclination,
        force=force,
        departure=scene.scattered(departures),
        force_amplitude=orbit(force[..., 0], force[..., 1]).major,
        rotor=rotor,
        grade_speed=spec.grade.speed if spec.grade else 0.0,
        speed_ratio=ratio,
        unbalance_station=np.array([load.place.x for load in loads]),
        unbalance_size=np.array([abs(load.size) for load in loads]),
        unbalance_angle=np.array([np.angle(load.size) for load in loads]),
        critical_speed=np.array([one.speed for one in critical]),
        critical_damping=np.array([one.damping_ratio for one in critical]),
        error=error,
        error_asked=response_accuracy(scene),
        fine_speed=fine,
        fine_displacement=fine_motion,
        fine_major_axis=fine_orbit.major,
        fine_minor_axis=fine_orbit.minor,
        fine_force_amplitude=fine_force,
        fine_departure=fine_apart,
        force_unbounded=_first_unbounded(pushes),
        film_orbit=_film_orbits(spindle, fine, ratio, fine_force),
        film_ratio=np.array(
            [getattr(link, "eccentricity_ratio", np.nan) for link in spindle.connections]
        ),
        resonance=np.arange(1, peaks.shape[-1] + 1),
        peak_speed=peaks[0],
        peak_amplitude=peaks[1],
        run=runs.name,
        run_outcome=runs.outcome,
        run_speed=runs.speed,
        run_amplitude=runs.moved.over_speed,
        run_peak=runs.moved.peak,
        run_peak_speed=runs.moved.speed,
        run_force=runs.pushed.over_speed,
        run_force_peak=runs.pushed.peak,
        run_force_peak_speed=runs.pushed.speed,
        run_departure=runs.departure,
        run_error=runs.error,
        unstable_range=np.arange(1, len(runs.growth.pole) + 1),
        unstable_from=runs.growth.first,
        unstable_to=runs.growth.last,
        unstable_pole=runs.growth.pole,
        model_frequency=scene.fineness.frequency,
    )


def _response(spec: UnbalanceSpec, ratio: float, scene: Scene) -> list[NDArray[Any]]:
    """Return displacements (usable, points, 2) [m], forces (usable, connections, 2) [N] and the
    departure of loads of bearings from those of their tangents (usable, connections)."""
    speed, subsystems = ratio * scene.speed[scene.usable], []
    for linear in map(scene.linear, out_of_balance(scene, spec)):
        motion = steady(scene, linear, spec, speed)
        displacement = displacements(scene, linear, spec, motion)
        subsystems.append((displacement, _forces(scene, linear, speed, motion)))
    parts = [np.sum(values, axis=0) for values in zip(*subsystems, strict=True)]
    if ratio < 0.0:  # e^(irΩt) as e^(i|r|Ωt)
        parts = [values.conj() for values in parts]
    departures, seats = np.full(parts[1].shape[:2], np.nan), len(scene.spindle.seats)
    if seats:
        departures[:, :seats] = departure(scene, _rings(scene, spec, speed))
    return [*parts, departures]


def _sampled(
    scene: Scene, spec: UnbalanceSpec, ratio: float, critical: Sequence[Critical]
) -> tuple[Array, list[NDArray[Any]]]:
    """Return speeds, those of the case and more about every peak, and the response there."""

    def amplitude(arrays: Sequence[NDArray[Any]]) -> Array:
        y, z = arrays[0][..., 0], arrays[0][..., 1]
        return np.concatenate([orbit(y, z).major, np.abs(y), np.abs(z)], axis=1)

    speeds = np.array([one.speed for one in critical])
    widths = speeds * np.abs([one.damping_ratio for one in critical])
    return over_speed(scene, partial(_response, spec, ratio), amplitude, speeds, widths)


def _peaks(speed: Array, amplitude: Array, unbounded: Sequence[float]) -> Array:
    """Return speed and height of every local maximum of the amplitudes (speeds, points):
    (2, points, n), NaN where a point has fewer; infinite near the ``unbounded`` critical speeds."""
    places = [tops(curve) for curve in amplitude.T]
    peaks = np.full((2, len(places), max(map(len, places), default=0)), np.nan)
    for row, (place, curve) in enumerate(zip(places, amplitude.T, strict=True)):
        peaks[0, row, : len(place)], peaks[1, row, : len(place)] = speed[place], curve[place]
        for at in unbounded:
            near = np.abs(peaks[0, row] - at) <= 2.0 * NARROW * at
            peaks[0, row, near], peaks[1, row, near] = at, np.inf
    return peaks


def _first_unbounded(peaks: Array) -> Array:
    """Return the first speed at which ``peaks`` (2, curves, n) are infinite, NaN without one."""
    at = np.where(np.isinf(peaks[1]), peaks[0], np.inf).min(axis=1, initial=np.inf)
    return np.where(np.isinf(at), np.nan, at)


def _rings(scene: Scene, spec: UnbalanceSpec, speed: Array) -> Complex:
    """Return the motion of the rings of every bearing, in its frame (speeds, seats, 5)."""
    parts = [scene.linear(k) for k in out_of_balance(scene, spec)]
    motions = [steady(scene, part, spec, speed).moved for part in parts]
    pairs = zip(parts, motions, strict=True)
    rows = [np.einsum("kdn,sn->skd", ring_rows(scene, part), motion) for part, motion in pairs]
    return np.asarray(sum(rows))


def _forces(scene: Scene, linear: Linear, speed: Array, motion: Steady) -> Complex:
    """Return forces of bearings, then supports along y and z (speeds, connections, 2) [N]."""
    linked = {id(connection.link): connection for connection in linear.connections}
    connections = scene.rotor.connections
    force = np.zeros((len(speed), len(connections), 2), dtype=complex)
    axes = [position(axis) for axis in AXES]
    finite = np.isfinite(motion.left).all(axis=1)
    rigid = linear.rigid_force(motion.left[finite])
    for k, link in enumerate(connections):
        if id(link) in linked:
            force[:, k] = linked[id(link)].force(speed, motion.moved)[:, axes]
        if link.name in rigid:
            force[finite, k] += rigid[link.name][:, axes]
    return force


def _film_orbits(spindle: Spindle, speed: Array, ratio: float, force: Array) -> Array:
    """Return orbits of journals over the clearance of their squeeze films (speeds, connections), by
    the amplitude of the film forces; NaN for all other connections."""
    orbits = np.full(force.shape, np.nan)
    for k, damper in enumerate(spindle.connections):
        if isinstance(damper, SqueezeFilmDamper):
            stiffness, damping = film_coefficients(damper)
            size = np.hypot(stiffness, damping) * abs(ratio) * speed * damper.clearance
            orbits[:, k] = force[:, k] / np.where(size > 0.0, size, np.inf)
    return orbits


def _absences(motions: FreeMotions, speed: Array) -> list[str]:
    """Return for each speed why it has no steady solution, or ""."""
    synchronous = motions.at_order(1.0)
    spin, size = speed[:, None], np.abs(speed)[:, None]
    near = np.abs(synchronous.pole - 1j * size) <= UNDAMPED * size
    undamped = (near & (synchronous.whirl * spin >= 0.0)).any(axis=1) & (speed != 0.0)
    why = "an undamped critical speed: the response grows without bound"
    return [why if flag else "" for flag in undamped]


def _outcome(scene: Scene, absent: list[str]) -> tuple[str, ...]:
    """Return for each speed why it has no steady solution, or no state, or ""."""
    outcome = list(scene.outcome)
    for row, word in zip(scene.usable, absent, strict=True):
        outcome[row] = word
    return tuple(outcome)


def _criticals(scene: Scene, ratio: float) -> list[Critical]:
    """Return critical speeds in the range of the case, of rotors with the speed ``ratio``."""
    ratios = scene.spindle.ratios
    criticals = criticals_up_to(scene, abs(ratio), motions=("bending",))
    return [one for one in criticals if one.excited and ratios[one.line.rotor] == ratio]


def _errors(scene: Scene, spec: UnbalanceSpec, ratio: float) -> Array:
    """Return the largest change of the motion (points,) by a finer model, over its peak."""
    if scene.rigid:
        return np.zeros(len(spec.points))
    if not scene.checks.wanted:
        return np.full(len(spec.points), np.nan)

    def values(model: Scene, rows: Indices) -> Complex:
        speed, parts = ratio * model.speed[model.usable[rows]], []
        for k in out_of_balance(model, spec):
            linear = model.linear(k, rows)
            parts.append(displacements(model, linear, spec, steady(model, linear, spec, speed)))
        return np.nan_to_num(np.sum(parts, axis=0))

    excited = np.abs(ratio * scene.speed[scene.usable])[:, None]
    with np.errstate(invalid="ignore", divide="ignore"):
        poles = [scene.system(k).pole for k in out_of_balance(scene, spec)]
        apart = [np.abs(pole - 1j * excited) / np.abs(pole) for pole in poles]
    distance = np.nan_to_num(np.concatenate(apart, axis=1), nan=np.inf)
    return changes(scene, values, 1, AT_REST, sensitive_rows(scene, distance))
