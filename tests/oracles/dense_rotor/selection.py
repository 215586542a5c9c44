"""The order of freedoms: the only place that turns node and name into a row.

Rows run node by node (narrow bands); a ``Selection`` says which freedoms a node contributes, with
which sign. The two lateral planes, (y, thz) and (z, −thy), then have the same matrices, and with
r = y + i z and φ = θz − i θy the vector of PLANE_Y plus i times that of PLANE_Z is the complex form
(r, φ) of a rotor whose bearings are isotropic.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.model.dofs import DIRECTIONS, position


def place_of(direction: str, directions: tuple[str, ...]) -> int:
    """Place of a direction in an order of them.

    Raises
    ------
    ValueError : it is not among them
    """
    if direction not in directions:
        raise ValueError(f"no direction {direction!r}: one of {', '.join(directions)}")
    return directions.index(direction)


@dataclass(frozen=True, slots=True)
class Selection:
    """The freedoms ``names`` of every node, in this order, each with its sign (+1 or −1)."""

    names: tuple[str, ...]
    signs: tuple[int, ...]

    @property
    def width(self) -> int:
        """Freedoms per node."""
        return len(self.names)

    def size(self, nodes: int) -> int:
        """Freedoms of a rotor with that many nodes."""
        return self.width * nodes

    def row(self, node: int, freedom: str) -> int:
        """Row of a node's freedom.

        Raises
        ------
        ValueError : the freedom is not part of this selection
        """
        return self.width * node + place_of(freedom, self.names)

    def rows(self, freedom: str, nodes: int) -> NDArray[np.intp]:
        """Rows of one freedom at all nodes."""
        return np.arange(nodes) * self.width + place_of(freedom, self.names)

    def sign(self, freedom: str) -> int:
        """−1 where the selected coordinate is minus the freedom."""
        return self.signs[place_of(freedom, self.names)]

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
