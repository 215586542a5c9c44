"""Deformation of a shaft under its section forces: strain integrated from the front end on."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.elements.polynomials import points
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.section import axial, sections_at, torsion
from rotordyn.equation.section_forces import SectionForces
from rotordyn.machine.spindle import Spindle

GAUSS = 31  # degree of the quadrature over an element: exact for cylinders, to rounding for cones


@dataclass(frozen=True, eq=False, slots=True)
class Compliance:
    """∫ sᵏ/EA ds, ∫ sᵏ/κGA ds, ∫ sᵏ/EI ds and ∫ sᵏ/GIp ds over every element (elements,), k from 0
    on along the first axis, with s [m] counted from its rear end; ``joints`` (elements, 6): 1/k of
    a joint at its front end along and about x, y, z, 0 without one."""

    stretch: Array
    shear: Array
    bending: Array
    torsion: Array
    joints: Array = field(default_factory=lambda: np.zeros((1, 6)))


def compliance(spindle: Spindle, mesh: Mesh, *, rigid: bool) -> Compliance:
    """Return the compliance of a Timoshenko shaft with its joints; zero if it is ``rigid``."""
    xi, weight = points(GAUSS)
    s = mesh.length[:, None] * (1.0 - xi) / 2.0
    powers = np.stack([s**k for k in range(5)]) * weight * mesh.length[:, None] / 2.0
    shear, bending, *_ = sections_at(spindle, mesh, xi)
    rigidities = axial(mesh, xi)[0], shear, bending, torsion(mesh, xi)[0]
    elastic, joints = 0.0 if rigid else 1.0, np.zeros((mesh.nodes - 1, 6))
    for joint in spindle.joints:
        stiffness = joint.axial, joint.radial, joint.radial, joint.torsion, joint.tilt, joint.tilt
        joints[mesh.node_of(joint.x)] = elastic / np.array(stiffness)
    shaft = Compliance(*(elastic * (powers / rigidity).sum(axis=-1) for rigidity in rigidities))
    return replace(shaft, joints=joints)


def elastic_line(
    x: Array, give: Compliance, forces: SectionForces, line: Array, joined: Array | None = None
) -> Array:
    """Return the displacement (…, nodes, 6) of nodes at ``x`` [m] with the front end held, at a
    joint of the part in front; exact.

    ``line`` (…, elements, 2, 3): the line loads [N/m] that are part of ``forces``; ``joined``
    (…, elements, 6): forces of joints at front ends, where these are others.
    """
    h = np.diff(x)
    qx, qy, qz = np.moveaxis(line[..., 1, :], -1, 0)
    rx, ry, rz = np.moveaxis((line[..., 0, :] - line[..., 1, :]) / h[:, None], -1, 0)
    n, ty, tz, mt, my, mz = np.moveaxis(forces.rear, -1, 0)
    jump = np.moveaxis((forces.front if joined is None else joined) * give.joints, -1, 0)
    gap_x, gap_y, gap_z, twisted, tilted_y, tilted_z = jump

    def strain(give: Array, k: int, *series: Array) -> Array:
        """∫ sᵏ (a + b s + …) give ds."""
        return np.asarray(sum(term * give[k + j] for j, term in enumerate(series)))

    bent_y, bent_z = (my, -tz, -qz / 2.0, -rz / 6.0), (mz, ty, qy / 2.0, ry / 6.0)
    thy = _from_front(tilted_y + strain(give.bending, 0, *bent_y))
    thz = _from_front(tilted_z + strain(give.bending, 0, *bent_z))
    bow_y, bow_z = (strain(give.bending, 1, *series) for series in (bent_y, bent_z))
    y = gap_y + h * (thz[..., :-1] + tilted_z) + bow_z + strain(give.shear, 0, ty, qy, ry / 2.0)
    z = gap_z - h * (thy[..., :-1] + tilted_y) - bow_y + strain(give.shear, 0, tz, qz, rz / 2.0)
    stretch = gap_x + strain(give.stretch, 0, n, qx, rx / 2.0)
    columns = (_from_front(stretch), _from_front(y), _from_front(z))
    twist = _from_front(twisted + strain(give.torsion, 0, mt))
    return np.stack([*columns, twist, thy, thz], axis=-1)


def _from_front(change: Array) -> Array:
    """Return values at the nodes (…, nodes) from changes over the elements, 0 at the front."""
    return np.concatenate([np.zeros_like(change[..., :1]), np.cumsum(change, axis=-1)], axis=-1)
