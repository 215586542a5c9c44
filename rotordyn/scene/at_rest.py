"""The shaft at rest under static loads on its bearings and supports, at every usable speed.

Linear: bearings act with the tangent of their preload state, and the axial force of that state acts
on the bent shaft. Shafts of further rotors take no part.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.restraint import on_nodes, require_balance
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
        if axial is None:
            raise InvalidInput(UNDETERMINED) from None
        rpm = scene.speed[scene.usable[failed.row]] * RPM.factor
        raise NoSolution(
            f"the bent shaft has no static equilibrium under its axial force at {rpm:.0f} rpm: it "
            "is near buckling; lower the axial force, or leave it out by axial_stiffening: false"
        ) from None


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
