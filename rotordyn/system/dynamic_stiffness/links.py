"""What joins rotors with one another and with ground: bearings, supports, sleeves, the drawbar."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import Sleeve
from rotordyn.system.connections import connections
from rotordyn.system.dynamic_stiffness.coordinates import Array, Coordinates, Values
from rotordyn.system.mesh import Mesh
from rotordyn.system.stiffening import stiffening


@dataclass(frozen=True, eq=False, slots=True)
class Links:
    """Connections, which are bearings, then supports, and what else acts between nodes.

    ``ends`` (c, nodes): 1 at the node that each holds, −1 at the one it stands on; ``sleeves`` on
    springs, whose deflections are coordinates behind those of the rotors; ``on_sleeves``
    (c, sleeves): −1 where a connection stands on one; ``spans`` of the drawbar: node, node and
    stiffness [N/m].
    """

    ends: Array
    sleeves: Sequence[Sleeve]
    on_sleeves: Array
    spans: Sequence[tuple[int, int, float]]

    @classmethod
    def of(cls, spindle: Spindle, mesh: Mesh, *, pulled: bool) -> Links:
        """``pulled``: the drawbar acts on bending."""
        ends = connections(spindle, mesh)
        sleeves = [s for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
        on_sleeves = np.zeros((len(ends), len(sleeves)))
        for row, seat in zip(on_sleeves, spindle.seats, strict=False):  # supports have none
            row[:] = [-float(seat.name in sleeve.bearings) for sleeve in sleeves]
        return cls(ends, sleeves, on_sleeves, stiffening(spindle, mesh).spans if pulled else ())

    @property
    def local(self) -> list[int]:
        """Connections of one node with ground."""
        alone = (np.abs(self.ends).sum(axis=1) == 1.0) & ~self.on_sleeves.any(axis=1)
        return np.flatnonzero(alone).tolist()

    def nodes(self, chosen: Sequence[int]) -> set[int]:
        """Those that some connections, or the drawbar, join to others."""
        found = set(np.flatnonzero(self.ends[list(chosen)].any(axis=0)).tolist())
        return found.union(*((left, right) for left, right, _ in self.spans))

    def rows(self, coordinates: Coordinates, chosen: Sequence[int]) -> Array:
        """Deflection and tilt between the ends of some connections (chosen, 2, n)."""
        size = coordinates.size
        rows = np.zeros((len(chosen), 2, size + len(self.sleeves)))
        for own, c in zip(rows, chosen, strict=True):
            for node in np.flatnonzero(self.ends[c]):
                own[:, :size] += self.ends[c, node] * coordinates.rows(int(node))
            own[0, size:] = self.on_sleeves[c]
        return rows

    def widened(self, coordinates: Coordinates, matrix: Values, omega: Array) -> Values:
        """``matrix`` (n, n, f) of rotors with sleeves and the drawbar, at ``omega`` (f,)."""
        more = len(self.sleeves)
        wide = np.pad(matrix, ((0, more), (0, more), (0, 0))) if more else matrix
        for place, sleeve in enumerate(self.sleeves, start=coordinates.size):
            wide[place, place] += sleeve.radial_stiffness - omega**2 * sleeve.mass
        for left, right, stiffness in self.spans:
            stretch = np.zeros(len(wide))
            stretch[: coordinates.size] = (coordinates.rows(right) - coordinates.rows(left))[0]
            wide = wide + stiffness * np.outer(stretch, stretch)[..., None]
        return wide
