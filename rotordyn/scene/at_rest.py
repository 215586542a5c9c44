"""The shaft at rest under static loads on its bearings and supports, at every usable speed.

Linear: bearings act with the tangent of their preload state, and the axial force of that state acts
on the bent shaft. Shafts of further rotors take no part.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.restraint import (
    free_names,
    on_nodes,
    require_balance,
    unrestrained_motions,
)
from rotordyn.equation.section_forces import SectionForces, on_deformed, section_forces
from rotordyn.equation.static_equation import AtRest, LoadCase, StaticEquation, Undetermined
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import gravity_vector

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

UNDETERMINED = (
    "the reactions are not determined: the shaft has more rigid supports than its elasticity can "
    "distinguish, or supports are so much softer or stiffer than the shaft that rounding errors "
    "dominate; leave one out, or give it another stiffness"
)


def at_rest(scene: Scene, mesh: Mesh, cases: Sequence[LoadCase]) -> list[AtRest]:
    """Return the shaft at rest at every usable speed, in each of the load ``cases``.

    Raises
    ------
    InvalidInput : the shaft is a free body, or its reactions are not determined
    NoSolution : the bent shaft has no equilibrium under its axial force
    """
    spindle, axial = scene.spindle, axial_force(scene, mesh)
    loads = [load for case in cases for load in on_nodes(case.point, case.line, mesh.x)]
    free = require_balance(spindle, mesh.x, loads)
    equation = StaticEquation(spindle, mesh, free, rigid=scene.rigid, axial=axial)
    try:
        return equation.solve(scene.state, cases)
    except Undetermined as failed:
        speed = float(scene.speed[scene.usable[failed.row]])
    _require_springs(spindle, speed)
    try:  # whether the axial force is the cause
        StaticEquation(spindle, mesh, free, rigid=scene.rigid).solve(scene.state, cases)
    except Undetermined:
        raise InvalidInput(UNDETERMINED) from None
    raise NoSolution(
        "the bent shaft has no static equilibrium under its axial force at "
        f"{speed * RPM.factor:.0f} rpm: it is near buckling; lower the axial force, or leave it "
        "out by axial_stiffening: false"
    )


def cut_forces(scene: Scene, mesh: Mesh, case: LoadCase, rest: AtRest) -> SectionForces:
    """Return the section forces (usable, elements, 6) of the bent shaft in a load case."""
    loads = np.broadcast_to(case.point, rest.displacement.shape).copy()
    for k, part in enumerate(scene.spindle.connections):
        loads[:, mesh.node_of(part.x)] += rest.push[:, k]
    forces, axial = section_forces(mesh.x, loads, case.line), axial_force(scene, mesh)
    if axial is None:
        return forces
    bent = (rest.displacement[:, 1:] - rest.displacement[:, :-1] - rest.jump)[..., 1:3]
    return on_deformed(forces, axial, bent, rest.bar_force, mesh.length)


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
