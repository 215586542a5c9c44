"""Quasi-static radial stiffness of a point, for each way of modelling the bearings.

The load lies in plane y, so shaft and bearings move in (x, y, θz) only. Tilts and the axial
arrangement are free to follow.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.radial import PLANE, RadialProblem
from rotordyn.analysis.results import StiffnessResult
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import StiffnessSpec
from rotordyn.preload.state import PreloadState, dynamic_preload
from rotordyn.system.condensed import CondensedRotor, condensed_rotor

Array = NDArray[np.float64]
SHORT_STOP = "short_stop"
Curve = tuple[Array, Array]


def answer(scene: Scene, spec: StiffnessSpec) -> StiffnessResult:
    """Deflection curves, tangent at no load and secant at full load (speeds, variants, …)."""
    force = np.linspace(0.0, spec.max_force, spec.steps + 1)
    point = scene.spindle.points[spec.point]
    rotor = condensed_rotor(scene.spindle, scene.mesh, point, rigid=scene.rigid)
    curves: dict[str, Curve] = {}
    for name in spec.variants:
        curves[name] = scene.timed(
            f"stiffness: {name}", partial(_variant, scene, rotor, name, force)
        )
    if spec.second_stop:
        curves[SHORT_STOP] = scene.timed(
            f"stiffness: {SHORT_STOP}",
            lambda: _short_stop(scene, spec, rotor, force, curves.get("nonlinear")),
        )
    deflection = np.stack([curve for curve, _ in curves.values()], axis=1)
    tangent = np.stack([slope for _, slope in curves.values()], axis=1)
    return StiffnessResult(
        speed=scene.speed,
        variant=tuple(curves),
        force=force,
        outcome=scene.outcome,
        deflection=scene.scattered(deflection),
        tangent=scene.scattered(tangent),
        secant=scene.scattered(force[-1] / deflection[..., -1]),
    )


def _variant(scene: Scene, rotor: CondensedRotor, name: str, force: Array) -> Curve:
    """Deflection (usable, loads) and tangent at no load (usable,) of one variant."""
    rows = scene.bearing_row[scene.usable]
    if name == "nonlinear":
        return _nonlinear(scene.preload, rotor, rows, force)
    if name == "constant_preload":
        stiffness = _constant_preload(scene)[rows]
    else:
        stiffness = scene.preload.seat_stiffness()[rows]
    block = _plane_blocks(scene, stiffness)
    if name == "diagonal":
        block = block * np.eye(2)
    flexibility = _flexibility(rotor, block)
    return flexibility[:, None] * force, 1.0 / flexibility


def _nonlinear(
    state: PreloadState, rotor: CondensedRotor, rows: NDArray[np.intp], force: Array
) -> Curve:
    """The full bearing model at every load; equal rows are solved once."""
    distinct, place = np.unique(rows, return_inverse=True)
    deflection, tangent = RadialProblem.at(state, rotor, distinct).curve(force)
    return deflection[place], tangent[place]


def _short_stop(
    scene: Scene,
    spec: StiffnessSpec,
    rotor: CondensedRotor,
    force: Array,
    usual: Curve | None,
) -> Curve:
    """The nonlinear variant with other stop travels; solved anew only where they are reached."""
    rows = scene.bearing_row[scene.usable]
    if usual is None:
        usual = _nonlinear(scene.preload, rotor, rows, force)
    deflection, tangent = usual[0].copy(), usual[1].copy()
    reached = np.flatnonzero(_overrun(scene, spec)[rows])
    if reached.size:
        sleeves = tuple(
            replace(s, stop_travel=spec.second_stop.get(s.name, s.stop_travel))
            for s in scene.spindle.sleeves
        )
        other = dynamic_preload(
            replace(scene.spindle, sleeves=sleeves),
            scene.bearing_speed[rows[reached]],
            scene.law,
            scene.axial_force,
        )
        every = np.arange(reached.size)
        deflection[reached], tangent[reached] = _nonlinear(other, rotor, every, force)
    return deflection, tangent


def _overrun(scene: Scene, spec: StiffnessSpec) -> NDArray[np.bool_]:
    """Rows of the preload state where another stop travel would change it."""
    state = scene.preload
    differs = np.zeros(len(state.speed), dtype=bool)
    for push, sleeve in zip(state.network.arrangement.pushes, scene.spindle.sleeves, strict=True):
        travel = spec.second_stop.get(sleeve.name, sleeve.stop_travel)
        moved = -push.direction * state.shift[:, push.body]
        if travel != sleeve.stop_travel:
            differs |= state.net.held[:, push.body] | (moved > travel)
    return differs


def _constant_preload(scene: Scene) -> Array:
    """Bearing tangents under the axial load each carries at rest, speed effects acting."""
    state = scene.preload
    rest = state.rest_loads()
    arrangement = state.network.arrangement
    blocks = np.empty((len(state.speed), len(scene.spindle.seats), 5, 5))
    for k, joint in enumerate(arrangement.joints):
        load = np.zeros(5)
        load[0] = rest[k]
        held = joint.bearing.equilibrium(
            load=np.broadcast_to(load, (len(state.speed), 5)),
            speed=state.speed,
            static_growth=joint.static_growth,
            growth=joint.growth,
            kinematics=scene.law.kinematics,
            moment_sharing=scene.law.moment_sharing,
        )
        blocks[:, list(joint.seats)] = held.stiffness("complete")[:, None]
    return blocks


def _plane_blocks(scene: Scene, stiffness: Array) -> Array:
    """(…, seats, 2, 2) over (y, θz) of the spindle, from tangents in the bearings' own frames."""
    thrust = np.array([float(seat.thrust) for seat in scene.spindle.seats])
    sign = np.stack([np.ones_like(thrust), thrust], axis=1)
    block = stiffness[..., PLANE[1:], :][..., PLANE[1:]]
    return block * sign[:, :, None] * sign[:, None, :]


def _flexibility(rotor: CondensedRotor, block: Array) -> Array:
    """Deflection of the point per unit force (speeds,) [m/N]."""
    bearings = np.einsum("kip,skij,kjq->spq", rotor.seats, block, rotor.seats, optimize=True)
    load = np.broadcast_to(rotor.point[:, None], (len(block), len(rotor.point), 1))
    answer = np.linalg.solve(rotor.stiffness + bearings, load)
    return np.asarray((rotor.point @ answer)[:, 0])
