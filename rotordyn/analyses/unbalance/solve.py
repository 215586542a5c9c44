"""Steady response to unbalance: orbits at points, forces of bearings and supports, over speed.

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
from rotordyn.equation.hysteresis import SYNCHRONOUS
from rotordyn.equation.linear import Linear
from rotordyn.equation.squeeze_film import film_coefficients
from rotordyn.errors import NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.modes.criticals import Critical, criticals_up_to
from rotordyn.numerics.peaks import NARROW, tops
from rotordyn.scene.linearity import departure, ring_rows
from rotordyn.scene.refinement import AT_REST, changes, response_accuracy, solve_accurately
from rotordyn.scene.sampling import over_speed
from rotordyn.scene.scene import Scene

UNDAMPED = 1e-9  # of the speed: a pole so near to the excitation has no damping
BESIDE = 0.2 * NARROW  # of a speed: nearer to a pole without damping a sample is of the pole alone


def answer(scene: Scene, spec: UnbalanceSpec) -> UnbalanceResult:
    """At every speed with a steady solution, of a model refined until it is as accurate as asked
    for.

    Raises
    ------
    NoSolution : no speed has one
    """
    for k in out_of_balance(scene, spec):
        scene.system(k)  # tells of instability (``Scene.warnings``)
    spindle, rotor = scene.spindle, unbalanced(scene.spindle, spec)
    ratio = spindle.ratios[rotor]
    scene = scene.whirling(abs(ratio))
    scene, error = solve_accurately(
        scene,
        lambda one: _errors(one, spec, ratio),
        lambda errors: float(np.nanmax(errors, initial=0.0)),
    )
    speed = ratio * scene.speed[scene.usable]
    motions = [scene.system(k) for k in out_of_balance(scene, spec)]
    absent = [max(words) for words in zip(*(_absences(one, speed) for one in motions), strict=True)]
    counts = (speed != 0.0) | (speed == 0.0).all()  # at rest nothing acts
    why = [word for word, one in zip(absent, counts, strict=True) if one]
    if all(why):
        raise NoSolution(f"no speed of the case has a steady response to unbalance: {why[0]}")
    known = np.array([word == "" for word in absent])
    moved, pushed, apart = _response(spec, ratio, scene)
    moved[~known] = pushed[~known] = complex(np.nan, np.nan)
    apart[~known] = np.nan
    displacement, force = scene.scattered(moved), scene.scattered(pushed)
    ellipse = orbit(displacement[..., 0], displacement[..., 1])
    placed = acting(spindle, scene.mesh, spec)
    critical = _criticals(scene, ratio)
    fine, (fine_moved, fine_pushed, fine_apart) = _sampled(scene, spec, ratio, critical)
    lost = np.isin(fine, scene.speed[scene.usable][~known])
    fine_moved[lost] = fine_pushed[lost] = complex(np.nan, np.nan)
    endless = [each.speed for each in critical if abs(each.damping_ratio) <= UNDAMPED]
    peaks, pushes = (
        _peaks(fine, orbit(each[..., 0], each[..., 1]).major, endless)
        for each in (fine_moved, fine_pushed)
    )
    for at in endless:
        lost |= np.abs(fine - at) <= BESIDE * at
    fine_moved[lost] = fine_pushed[lost] = complex(np.nan, np.nan)
    fine_apart[lost] = np.nan
    fine_orbit = orbit(fine_moved[..., 0], fine_moved[..., 1])
    fine_force = orbit(fine_pushed[..., 0], fine_pushed[..., 1]).major
    outcome = _outcome(scene, absent)
    runs = runs_of(scene, spec, ratio, outcome)
    return UnbalanceResult(
        speed=scene.speed,
        point=spec.points,
        axis=AXES,
        support=tuple(each.name for each in spindle.connections),
        unbalance=tuple(one.name for one in placed),
        critical=tuple(each.mode for each in critical),
        outcome=outcome,
        unstable=scene.scattered(np.any([one.growing.any(axis=1) for one in motions], axis=0)),
        displacement=displacement,
        amplitude=np.abs(displacement),
        phase=np.angle(displacement),
        major_axis=ellipse.major,
        minor_axis=ellipse.minor,
        inclination=ellipse.inclination,
        force=force,
        departure=scene.scattered(apart),
        force_amplitude=orbit(force[..., 0], force[..., 1]).major,
        rotor=rotor,
        grade_speed=spec.grade.speed if spec.grade else 0.0,
        speed_ratio=ratio,
        unbalance_station=np.array([one.place.x for one in placed]),
        unbalance_size=np.array([abs(one.size) for one in placed]),
        unbalance_angle=np.array([np.angle(one.size) for one in placed]),
        critical_speed=np.array([each.speed for each in critical]),
        critical_damping=np.array([each.damping_ratio for each in critical]),
        error=error,
        error_asked=response_accuracy(scene),
        fine_speed=fine,
        fine_displacement=fine_moved,
        fine_major_axis=fine_orbit.major,
        fine_minor_axis=fine_orbit.minor,
        fine_force_amplitude=fine_force,
        fine_departure=fine_apart,
        force_unbounded=_first(pushes),
        film_orbit=_film_orbits(spindle, fine, ratio, fine_force),
        film_ratio=np.array(
            [getattr(each, "eccentricity_ratio", np.nan) for each in spindle.connections]
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
    """Displacements (usable, points, 2) [m], forces (usable, connections, 2) [N] and how far loads
    of bearings depart from those of their tangents (usable, connections)."""
    speed, every = ratio * scene.speed[scene.usable], []
    for linear in map(scene.linear, out_of_balance(scene, spec)):
        motion = steady(scene, linear, spec, speed)
        moved = displacements(scene, linear, spec, motion)
        every.append((moved, _forces(scene, linear, speed, motion)))
    parts = [np.sum(each, axis=0) for each in zip(*every, strict=True)]
    if ratio < 0.0:  # e^(irΩt) as e^(i|r|Ωt)
        parts = [each.conj() for each in parts]
    apart, seats = np.full(parts[1].shape[:2], np.nan), len(scene.spindle.seats)
    if seats:
        apart[:, :seats] = departure(scene, _rings(scene, spec, speed))
    return [*parts, apart]


def _sampled(
    scene: Scene, spec: UnbalanceSpec, ratio: float, critical: Sequence[Critical]
) -> tuple[Array, list[NDArray[Any]]]:
    """Speeds, those of the case and more about every peak, and the response there."""

    def amplitude(arrays: Sequence[NDArray[Any]]) -> Array:
        y, z = arrays[0][..., 0], arrays[0][..., 1]
        return np.concatenate([orbit(y, z).major, np.abs(y), np.abs(z)], axis=1)

    at = np.array([each.speed for each in critical])
    widths = at * np.abs([each.damping_ratio for each in critical])
    return over_speed(scene, partial(_response, spec, ratio), amplitude, at, widths)


def _peaks(speed: Array, amplitude: Array, endless: Sequence[float]) -> Array:
    """Speed and height of every local maximum of the amplitudes (speeds, points): (2, points, n),
    NaN where a point has fewer; infinite beside a critical speed without damping (``endless``)."""
    places = [tops(each) for each in amplitude.T]
    peaks = np.full((2, len(places), max(map(len, places), default=0)), np.nan)
    for row, (place, each) in enumerate(zip(places, amplitude.T, strict=True)):
        peaks[0, row, : len(place)], peaks[1, row, : len(place)] = speed[place], each[place]
        for at in endless:
            near = np.abs(peaks[0, row] - at) <= 2.0 * NARROW * at
            peaks[0, row, near], peaks[1, row, near] = at, np.inf
    return peaks


def _first(peaks: Array) -> Array:
    """The first speed at which one of ``peaks`` (2, curves, n) is infinite, NaN without one."""
    at = np.where(np.isinf(peaks[1]), peaks[0], np.inf).min(axis=1, initial=np.inf)
    return np.where(np.isinf(at), np.nan, at)


def _rings(scene: Scene, spec: UnbalanceSpec, speed: Array) -> Complex:
    """Of the rings of every bearing, in its frame (speeds, seats, 5)."""
    parts = [scene.linear(k) for k in out_of_balance(scene, spec)]
    motions = [steady(scene, part, spec, speed).moved for part in parts]
    each = zip(parts, motions, strict=True)
    rows = [np.einsum("kdn,sn->skd", ring_rows(scene, part), moved) for part, moved in each]
    return np.asarray(sum(rows))


def _forces(scene: Scene, linear: Linear, speed: Array, motion: Steady) -> Complex:
    """Of bearings, then supports on the shaft along y and z (speeds, connections, 2) [N]."""
    linked = {id(each.link): each for each in linear.connections}
    connections = scene.rotor.connections
    force = np.zeros((len(speed), len(connections), 2), dtype=complex)
    axes = [position(way) for way in AXES]
    known = np.isfinite(motion.left).all(axis=1)
    rigid = linear.rigid_force(motion.left[known])
    for k, link in enumerate(connections):
        if id(link) in linked:
            force[:, k] = linked[id(link)].force(speed, motion.moved)[:, axes]
        if link.name in rigid:
            force[known, k] += rigid[link.name][:, axes]
    return force


def _film_orbits(spindle: Spindle, speed: Array, ratio: float, force: Array) -> Array:
    """Orbits of journals over the clearance of their squeeze films (speeds, connections), of the
    amplitude of the forces that these carry; NaN of all other connections."""
    orbits = np.full(force.shape, np.nan)
    for k, damper in enumerate(spindle.connections):
        if isinstance(damper, SqueezeFilmDamper):
            stiffness, damping = film_coefficients(damper)
            size = np.hypot(stiffness, damping) * abs(ratio) * speed * damper.clearance
            orbits[:, k] = force[:, k] / np.where(size > 0.0, size, np.inf)
    return orbits


def _absences(motions: FreeMotions, speed: Array) -> list[str]:
    """Per speed: empty, or why there is no steady solution."""
    turning = motions.answering(SYNCHRONOUS)
    spin, size = speed[:, None], np.abs(speed)[:, None]
    near = np.abs(turning.pole - 1j * size) <= UNDAMPED * size
    lost = (near & (turning.whirl * spin >= 0.0)).any(axis=1) & (speed != 0.0)
    why = "a critical speed without damping: the response grows without bound"
    return [why if one else "" for one in lost]


def _outcome(scene: Scene, absent: list[str]) -> tuple[str, ...]:
    """Why a speed has no steady solution, or no state at all."""
    words = list(scene.outcome)
    for row, word in zip(scene.usable, absent, strict=True):
        words[row] = word
    return tuple(words)


def _criticals(scene: Scene, ratio: float) -> list[Critical]:
    """Critical speeds among those of the case of what turns ``ratio`` times as fast."""
    ratios = scene.spindle.ratios
    every = criticals_up_to(scene, abs(ratio), motions=("bending",))
    return [each for each in every if each.excited and ratios[each.line.rotor] == ratio]


def _errors(scene: Scene, spec: UnbalanceSpec, ratio: float) -> Array:
    """Largest change of the motion of each point by the finer model, over its peak (points,)."""
    if scene.rigid:
        return np.zeros(len(spec.points))
    if not scene.checks.wanted:
        return np.full(len(spec.points), np.nan)

    def values(one: Scene, rows: Indices) -> Complex:
        speed, moved = ratio * one.speed[one.usable[rows]], []
        for k in out_of_balance(one, spec):
            linear = one.linear(k, rows)
            moved.append(displacements(one, linear, spec, steady(one, linear, spec, speed)))
        return np.nan_to_num(np.sum(moved, axis=0))

    return changes(scene, values, 1, AT_REST)
