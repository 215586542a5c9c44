"""The shaft at rest under static loads on its bearings and supports, at every usable speed.

Linear: bearings act with the tangent of their preload state, and the axial force of that state acts
on the bent shaft. A shaft of further rotors is not among them.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.deformed import BENT, bent, on_deformed
from rotordyn.equation.elastic_line import Compliance, compliance, elastic_line
from rotordyn.equation.holding import (
    free_names,
    held_stiffness,
    length_scale,
    rigid_motion,
    rigidly_held,
    unrestrained_motions,
)
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.reactions import Held, reactions
from rotordyn.equation.section_forces import SectionForces, section_forces
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.affine import fixed_points
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import gravity_vector

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

BALANCED = 1e-6  # of all loads along a free motion
ROUNDING = 1e-12  # of all loads


@dataclass(frozen=True, eq=False, slots=True)
class AtRest:
    """Section ``forces`` of the shaft; ``moved`` (usable, nodes, 6): its displacements [m, rad], at
    a joint those of the part in front; ``apart`` (usable, elements, 6): additional displacement of
    the front end of an element behind a joint; ``push`` (usable, connections, 6): loads of bearings
    and supports on it [N, N·m]."""

    forces: SectionForces
    moved: Array
    apart: Array
    push: Array


def at_rest(
    scene: Scene, mesh: Mesh, point: Array, line: Array, offset: Array | None = None
) -> AtRest:
    """Solve the shaft under point loads (usable, nodes, 6) and line loads (elements, 2, 3).

    ``offset`` (usable, connections, 6): offset of connections from the shaft [m, rad], as of an
    eccentric ring; a connection reacts to the sum of displacement and offset.

    Raises
    ------
    InvalidInput : the shaft is a free body, or its reactions are not determined
    NoSolution : the bent shaft has no equilibrium under its axial force
    """
    spindle, x = scene.spindle, mesh.x
    states, nodes = len(scene.usable), [mesh.node_of(part.x) for part in spindle.connections]
    point = np.broadcast_to(point, (states, mesh.nodes, 6))
    loads = on_nodes(point, line, x)
    unheld = require_balance(spindle, x, loads)
    beam = compliance(spindle, mesh, rigid=scene.rigid)
    restraint = Held(
        stiffness=held_stiffness(scene.rotor, scene.state),
        rigid=rigidly_held(spindle).ravel(),
        motion=rigid_motion(x[nodes], float(x[0])).reshape(-1, 6),
        flexibility=_flexibility(mesh, beam, nodes),
        free=unheld,
        scale=length_scale(spindle),
    )
    axial, taut, total = _axial(scene, mesh), _drawbar_tension(scene, mesh), resultant(loads, x)

    def within(acting: Array, bend: Array) -> tuple[SectionForces, Array]:
        """Return section forces of the bent shaft, and displacements with its front end clamped."""
        straight = section_forces(x, acting, line)
        if axial is None:
            return straight, elastic_line(x, beam, straight, line)
        pulled = taut @ bend[..., :2]
        forces, sheared, loads = on_deformed(straight, line, axial, bend, pulled, mesh.length)
        return forces, elastic_line(x, beam, sheared, loads, forces.front)

    def solve(bend: Array) -> AtRest:
        forces, displacement = within(point, bend)
        unrestrained, resultants = displacement[:, nodes], total.copy()
        # the axial force on the bent shaft adds moments about y and z
        resultants[:, 4:] += (forces.front - section_forces(x, point, line).front)[:, 0, 4:]
        if offset is not None:
            unrestrained = unrestrained + offset
        push, front = reactions(restraint, unrestrained.reshape(states, -1), resultants)
        push = push.reshape(states, -1, 6)
        acting = point.copy()
        for k, node in enumerate(nodes):
            acting[:, node] += push[:, k]
        forces, displacement = within(acting, bend)
        displacement += np.einsum("nij,sj->sni", rigid_motion(x, float(x[0])), front, optimize=True)
        return AtRest(forces, displacement, forces.front * beam.joints, push)

    shape = states, mesh.nodes - 1, len(BENT)
    if axial is None:
        return solve(np.zeros(shape))
    # makes displacements and rotations of the same order of magnitude
    unit = np.array([1.0, 1.0, *[1.0 / (x[-1] - x[0])] * 2])

    def update(bend: Array) -> Array:
        state = solve(bend.reshape(shape) * unit)
        return (bent(state.moved, state.apart) / unit).reshape(states, -1)

    solution, converged = fixed_points(update, math.prod(shape[1:]), states)
    if not converged.all():
        rpm = scene.speed[scene.usable[int(converged.argmin())]] * RPM.factor
        raise NoSolution(
            f"the bent shaft has no static equilibrium under its axial force at {rpm:.0f} rpm: it "
            "is near buckling; lower the axial force, or leave it out by axial_stiffening: false"
        )
    return solve(solution.reshape(shape) * unit)


def _axial(scene: Scene, mesh: Mesh) -> Array | None:
    """Return the axial force that acts on bending (usable, elements) [N]; None where none does."""
    if not scene.conditions.axial_stiffening:
        return None
    force = scene.shaft_force.bending(mesh.middle)[scene.bearing_row[scene.usable]]
    return force if force.any() else None


def _drawbar_tension(scene: Scene, mesh: Mesh) -> Array:
    """Return the drawbar's tension times its inclination, per relative displacement of the ends of
    each element (elements, elements) [N/m]; the bar runs straight between its contacts."""
    taut, bar = np.zeros((mesh.nodes - 1, mesh.nodes - 1)), scene.spindle.drawbar
    for low, high in pairwise(bar.contacts if bar else ()):
        part = slice(mesh.node_of(low), mesh.node_of(high))
        taut[part, part] = bar.force / (high - low) if bar else 0.0
    return taut


def weight(spindle: Spindle, mesh: Mesh, gravity: str) -> tuple[Array, Array]:
    """Return the weight of discs and masses on nodes (nodes, 6) [N], and of the shaft along
    elements (elements, 2, 3) [N/m]."""
    pull, point = np.array(gravity_vector(gravity)), np.zeros((mesh.nodes, 6))
    for body in spindle.lumped:
        point[mesh.node_of(body.x), :3] += body.mass * pull
    return point, mesh.weight_line[..., None] * pull


def on_nodes(point: Array, line: Array, x: Array) -> Array:
    """Add line loads to point loads (…, nodes, 6), with the same resultant at the element ends."""
    front, rear = np.moveaxis(line, 1, 0)
    length, loads = np.diff(x)[:, None], point.copy()
    loads[..., :-1, :3] += (2.0 * front + rear) * length / 6.0
    loads[..., 1:, :3] += (front + 2.0 * rear) * length / 6.0
    return loads


def resultant(point: Array, x: Array) -> Array:
    """Return the resultant (…, 6) about the front end of loads (…, nodes, 6) at ``x`` [m]."""
    return np.einsum("nij,...ni->...j", rigid_motion(x, float(x[0])), point, optimize=True)


def require_balance(spindle: Spindle, x: Array, loads: Iterable[Array]) -> Array:
    """Return the unrestrained rigid-body motions (6, k), in lengths, along which each of ``loads``
    (nodes, 6) on nodes at ``x`` [m] must balance.

    Raises
    ------
    InvalidInput : they do not: the shaft is a free body
    """
    free, scale = unrestrained_motions(spindle), length_scale(spindle)
    if not free.shape[1]:
        return free
    motion = rigid_motion(x, float(x[0])) / scale
    for acting in loads:
        work = np.einsum("nij,ni,jk->nik", motion, acting, free, optimize=True)
        imbalance, size = work.sum(axis=(0, 1)), np.abs(work).sum(axis=(0, 1))
        unbalanced = np.abs(imbalance) > BALANCED * size + ROUNDING * np.abs(acting / scale).sum()
        if unbalanced.any():
            raise InvalidInput(_free_body(free[:, unbalanced] @ imbalance[unbalanced], scale))
    return free


def _free_body(imbalance: Array, scale: Array) -> str:
    names = free_names(imbalance[:, None] / np.abs(imbalance).max())
    force, moment = np.abs(imbalance[:3]).max(), np.abs(imbalance * scale)[3:].max()
    amount = f"{moment:.6g} N m" if names.startswith("th") else f"{force:.6g} N"
    return (
        f"free body in a static case: {names} unrestrained, with loads out of balance by {amount}; "
        "balance them, or restrain the body by a support"
    )


def _flexibility(mesh: Mesh, beam: Compliance, nodes: list[int]) -> Array:
    """Return displacements at ``nodes`` under unit loads, the front end clamped (6 k, 6 k)."""
    count = len(nodes)
    unit = np.zeros((6 * count, mesh.nodes, 6))
    for k, node in enumerate(nodes):
        unit[6 * k + np.arange(6), node, np.arange(6)] = 1.0
    unloaded = np.zeros((mesh.nodes - 1, 2, 3))
    displacement = elastic_line(mesh.x, beam, section_forces(mesh.x, unit, unloaded), unloaded)
    return np.asarray(displacement[:, nodes].reshape(6 * count, 6 * count).T)
