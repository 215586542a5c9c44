"""The weight of a rotor on the nodes and elements of its shaft."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.mesh import Mesh
from rotordyn.machine.spindle import Spindle
from rotordyn.units import STANDARD_GRAVITY

WAYS = {
    "none": (0.0, 0.0),
    "+y": (1.0, 0.0),
    "-y": (-1.0, 0.0),
    "+z": (0.0, 1.0),
    "-z": (0.0, -1.0),
}


def weight(spindle: Spindle, mesh: Mesh, gravity: str) -> tuple[Array, Array]:
    """Of discs and masses on nodes (nodes, 6) [N], of the shaft along elements (elements, 2, 3)
    [N/m]."""
    pull = STANDARD_GRAVITY * np.array([0.0, *WAYS[gravity]])
    point = np.zeros((mesh.nodes, 6))
    for body in spindle.lumped:
        point[mesh.node_of(body.x), :3] += body.mass * pull
    return point, mesh.weight_line[..., None] * pull
