"""Which directions of every node matrices are of: the only place that turns node and name into a
row.

Rows run node by node; a ``Selection`` says which directions a node contributes, with which sign.
The two bending planes, (y, thz) and (z, −thy), then have the same matrices, and with r = y + i z
and φ = θz − i θy the vector of PLANE_Y plus i times that of PLANE_Z is the complex form (r, φ).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.dofs import DIRECTIONS, position


@dataclass(frozen=True, slots=True)
class Selection:
    """The directions ``names`` of every node, in this order, each with its sign (+1 or −1)."""

    names: tuple[str, ...]
    signs: tuple[int, ...]

    @property
    def width(self) -> int:
        """Directions per node."""
        return len(self.names)

    def size(self, nodes: int) -> int:
        """DOF of a rotor with that many nodes."""
        return self.width * nodes

    def row(self, node: int, direction: str) -> int:
        """Row of a node's direction."""
        return self.width * node + self.names.index(direction)

    def rows(self, direction: str, nodes: int) -> NDArray[np.intp]:
        """Rows of one direction at all nodes."""
        return np.arange(nodes) * self.width + self.names.index(direction)

    def sign(self, direction: str) -> int:
        """−1 where the selected coordinate is minus the displacement."""
        return self.signs[self.names.index(direction)]

    def take(self, matrix: NDArray[Any], columns: Selection | None = None) -> NDArray[Any]:
        """The selected part of a node's (…, 6, 6) or an element's (…, 12, 12) matrix.

        With ``columns`` another selection, the block that couples the two.
        """
        nodes = matrix.shape[-1] // len(DIRECTIONS)
        other = columns or self
        block = matrix[..., self._places(nodes)[:, None], other._places(nodes)]
        return block * np.outer(np.tile(self.signs, nodes), np.tile(other.signs, nodes))

    def _places(self, nodes: int) -> NDArray[np.intp]:
        local = np.array([position(name) for name in self.names])
        return (np.arange(nodes)[:, None] * len(DIRECTIONS) + local).ravel()


ALL = Selection(DIRECTIONS, (1, 1, 1, 1, 1, 1))
LATERAL = Selection(("y", "z", "thy", "thz"), (1, 1, 1, 1))
PLANE_Y = Selection(("y", "thz"), (1, 1))
PLANE_Z = Selection(("z", "thy"), (1, -1))
BOTH_PLANES = Selection(PLANE_Y.names + PLANE_Z.names, PLANE_Y.signs + PLANE_Z.signs)
AXIAL = Selection(("x",), (1,))
TORSION = Selection(("thx",), (1,))
