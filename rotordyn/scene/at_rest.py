"""The shaft at rest under static loads on its bearings and supports, at every usable speed.

Linear: bearings act with the tangent of their preload state, and the axial force of that state acts
on the bent shaft. A shaft of further rotors is not among them.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.holding import (
    free_names,
    length_scale,
    rigid_motion,
    unrestrained_motions,
)
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.section_forces import SectionForces, on_deformed, section_forces
from rotordyn.equation.static_equation import Acting, AtRest, StaticEquation, Undetermined
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import gravity_vector

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

BALANCED = 1e-6  # of all loads along a free motion
ROUNDING = 1e-12  # of all loads
UNDETERMINED = (
    "the reactions are not determined: the shaft has more rigid supports than its elasticity can "
    "distinguish, or supports are so much softer or stiffer than the shaft that rounding errors "
    "dominate; leave one out, or give it another stiffness"
)


def at_rest(scene: Scene, mesh: Mesh, acting: Sequence[Acting]) -> list[AtRest]:
    """Return the shaft at rest at every usable speed, under each of the loads ``acting``.

    Raises
    ------
    InvalidInput : the shaft is a free body, or its reactions are not determined
    NoSolution : the bent shaft has no equilibrium under its axial force
    """
    spindle, axial, front = scene.spindle, axial_force(scene, mesh), np.zeros((0, 6))
    for loads in acting:
        on_shaft = on_nodes(loads.point, loads.line, mesh.x)
        front = require_balance(spindle, mesh.x, on_shaft).T * length_scale(spindle)
    equation = StaticEquation(spindle, mesh, front, rigid=scene.rigid, bent=axial is not None)
    try:
        return equation.solve(scene.state, axial, acting)
    except Undetermined as failed:
        speed = float(scene.speed[scene.usable[failed.row]])
    _require_springs(spindle, speed)
    try:
        if axial is not None:
            equation.solve(scene.state, None, acting)
    except Undetermined:
        axial = None  # it is not the cause
    if axial is None:
        raise InvalidInput(UNDETERMINED)
    raise NoSolution(
        "the bent shaft has no static equilibrium under its axial force at "
        f"{speed * RPM.factor:.0f} rpm: it is near buckling; lower the axial force, or leave it "
        "out by axial_stiffening: false"
    )


def cut_forces(scene: Scene, mesh: Mesh, acting: Acting, rest: AtRest) -> SectionForces:
    """Return the section forces (usable, elements, 6) of the bent shaft under the loads."""
    loads = np.broadcast_to(acting.point, rest.moved.shape).copy()
    for k, part in enumerate(scene.spindle.connections):
        loads[:, mesh.node_of(part.x)] += rest.push[:, k]
    forces, axial = section_forces(mesh.x, loads, acting.line), axial_force(scene, mesh)
    if axial is None:
        return forces
    bent = (rest.moved[:, 1:] - rest.moved[:, :-1] - rest.apart)[..., 1:3]
    return on_deformed(forces, axial, bent, rest.pulled, mesh.length)


def axial_force(scene: Scene, mesh: Mesh) -> Array | None:
    """Return the axial force that acts on bending (usable, elements) [N]; None where none does."""
    if not scene.conditions.axial_stiffening:
        return None
    force = scene.shaft_force.bending(mesh.middle)[scene.bearing_row[scene.usable]]
    return force if force.any() else None


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


def require_balance(spindle: Spindle, x: Array, loads: Sequence[Array] | Array) -> Array:
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


def _require_springs(spindle: Spindle, speed: float) -> None:
    """Require that supports with tables hold at ``speed`` [rad/s] what they hold elsewhere.

    Raises
    ------
    InvalidInput : their stiffness is zero there
    """
    there = replace(spindle, supports=tuple(each.at(speed) for each in spindle.supports))
    free = unrestrained_motions(there)
    if free.shape[1] > unrestrained_motions(spindle).shape[1]:
        raise InvalidInput(
            f"free body in a static case at {speed * RPM.factor:.0f} rpm: {free_names(free)} "
            "unrestrained, since the table of a support has no stiffness there; give it some, or "
            "leave this speed out"
        )


def _free_body(imbalance: Array, scale: Array) -> str:
    names = free_names(imbalance[:, None] / np.abs(imbalance).max())
    force, moment = np.abs(imbalance[:3]).max(), np.abs(imbalance * scale)[3:].max()
    amount = f"{moment:.6g} N m" if names.startswith("th") else f"{force:.6g} N"
    return (
        f"free body in a static case: {names} unrestrained, with loads out of balance by {amount}; "
        "balance them, or restrain the body by a support"
    )
