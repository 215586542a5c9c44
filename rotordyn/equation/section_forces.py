"""Section forces of a shaft under point loads and line loads, from equilibrium alone.

The shaft is cut; the part behind the cut acts on the part in front with the sum of all loads behind
it, moments about the displaced centre of the section. No stiffness enters.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array


@dataclass(frozen=True, eq=False, slots=True)
class SectionForces:
    """N, Ty, Tz [N], Mt, My, Mz [N·m] at both ends of every element (…, elements, 6).

    ``front`` and ``rear`` are within the element, behind its front node and before its rear one: at
    a node they differ by the point load there. In between, moments are cubic where a line load
    acts, else linear.
    """

    front: Array
    rear: Array


def section_forces(x: Array, point: Array, line: Array) -> SectionForces:
    """Return section forces between nodes at ``x`` (nodes,) [m], ascending.

    ``point`` (nodes, 6): forces and moments on nodes [N, N·m]; ``line`` (…, elements, 2, 3): force
    per length [N/m] at both ends of each element, linear in between; supports are loads like any
    other.
    """
    h = np.diff(x)[:, None]
    start, end = line[..., 0, :], line[..., 1, :]
    resultant, arm = (start + end) * h / 2.0, (start + 2.0 * end) * h / 6.0
    force_rear = _behind(point[..., 1:, :3]) + point[..., 1:, :3] + _behind(resultant)
    force_front = force_rear + resultant
    gain = h * _lever(force_rear) + h * _lever(arm)
    moment_rear = _behind(point[..., 1:, 3:]) + point[..., 1:, 3:] + _behind(gain)
    return SectionForces(
        np.concatenate([force_front, moment_rear + gain], axis=-1),
        np.concatenate([force_rear, moment_rear], axis=-1),
    )


def on_deformed(
    forces: SectionForces, axial: Array, bent: Array, bar_force: Array, length: Array
) -> SectionForces:
    """Return section ``forces`` of the straight shaft as those of the bent one: the axial force N
    acts with its displacement as lever arm, dMz/dx = −(Ty − N v′) and dMy/dx = Tz − N w′.

    ``axial`` N (…, elements) [N], tension positive; ``bent`` (…, elements, 2): displacement along y
    and z of rear ends from front ends; ``bar_force`` (…, elements, 2): forces along y and z of a
    drawbar that runs straight inside the shaft; ``length`` (elements,) [m].
    """
    y, z = np.moveaxis(axial[..., None] * bent + bar_force * length[:, None], -1, 0)
    zero = np.zeros_like(y)
    couple = np.stack([zero, zero, zero, zero, z, -y], axis=-1)
    rear = _behind(couple)
    return SectionForces(forces.front + rear + couple, forces.rear + rear)


def _lever(force: Array) -> Array:
    """Return the moment of a force one metre behind: x̂ × F."""
    return np.stack([np.zeros_like(force[..., 0]), -force[..., 2], force[..., 1]], axis=-1)


def _behind(values: Array) -> Array:
    """Return the sum over all later elements."""
    total = np.zeros_like(values)
    total[..., :-1, :] = np.cumsum(values[..., :0:-1, :], axis=-2)[..., ::-1, :]
    return total
