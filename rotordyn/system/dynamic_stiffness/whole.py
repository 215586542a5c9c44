"""Rotors by all freedoms of their elements."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.machine.support import SPINDLE
from rotordyn.numerics.sparse import filled
from rotordyn.system.dynamic_stiffness.coordinates import Array, Motion, Values, side_by_side
from rotordyn.system.dynamic_stiffness.shafts import Shafts
from rotordyn.system.dynamic_stiffness.whirling_shaft import Whirl
from rotordyn.system.hierarchic_rotor import deflections


@dataclass(frozen=True, eq=False, slots=True)
class Whole:
    """All freedoms of all rotors."""

    shafts: Shafts

    @property
    def size(self) -> int:
        """Of all rotors."""
        return self.shafts.size

    def rows(self, node: int) -> Array:
        """Of any node."""
        return self.rows_of([node])[0]

    def rows_of(self, nodes: Sequence[int]) -> Array:
        """Of some of them (nodes, 2, n)."""
        rows = np.zeros((len(nodes), 2, self.size))
        begin = 0
        for name, span in self.shafts.mesh.spans.items():
            shaft = self.shafts.of[name]
            own = [k for k, node in enumerate(nodes) if span.start <= node < span.stop]
            x = self.shafts.mesh.stations[np.array([nodes[k] for k in own], dtype=np.intp)]
            size = shaft.elements.size
            if own:
                seen = filled(deflections(shaft.spindle, shaft.elements, x))
                rows[own, :, begin : begin + size] = seen.reshape(len(own), 2, size)
            begin += size
        return rows

    def dynamic(self, whirl: Whirl, force: Array | None, at: Mapping[int, Values]) -> _Assembled:
        """With matrices (2, 2, f or 1) added ``at`` nodes."""
        whole = side_by_side(
            [
                shaft.assembled(whirl, force if name == SPINDLE else None)
                for name, shaft in self.shafts.of.items()
            ]
        )
        for node, added in at.items():
            rows = self.rows(node)
            whole = whole + np.einsum("in,ijf,jm->nmf", rows, added, rows)
        return _Assembled(self, whole)


@dataclass(frozen=True, eq=False, slots=True)
class _Assembled:
    coordinates: Whole
    matrix: Values

    @property
    def doubt(self) -> Array:
        return np.ones(self.matrix.shape[-1])

    def motion(self, moved: Values, wanted: Collection[int]) -> Motion:
        nodes = list(wanted)
        found = np.tensordot(self.coordinates.rows_of(nodes), moved, 1)
        return dict(zip(nodes, found, strict=True))
