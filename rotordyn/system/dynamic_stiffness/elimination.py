"""Rotors by the motion of a few nodes, all others eliminated exactly."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.machine.support import SPINDLE
from rotordyn.numerics.chain import Chain
from rotordyn.system.dynamic_stiffness.coordinates import Array, Motion, Values, side_by_side
from rotordyn.system.dynamic_stiffness.shafts import Shafts
from rotordyn.system.dynamic_stiffness.whirling_shaft import Whirl


@dataclass(frozen=True, eq=False, slots=True)
class Eliminated:
    """The motion of the nodes ``kept``, ascending."""

    shafts: Shafts
    kept: Sequence[int]

    @property
    def size(self) -> int:
        """Deflection and tilt of each."""
        return 2 * len(self.kept)

    def rows(self, node: int) -> Array:
        """Of one of the nodes kept."""
        place = self.kept.index(node)
        return np.eye(self.size)[2 * place : 2 * place + 2]

    def dynamic(self, whirl: Whirl, force: Array | None, at: Mapping[int, Values]) -> _Chains:
        """With matrices (2, 2, f or 1) added ``at`` nodes, kept or not."""
        chains = {}
        for name, span in self.shafts.mesh.spans.items():
            own = [node for node in self.kept if span.start <= node < span.stop]
            if own:
                added = {
                    self.shafts.element_node(node): matrix
                    for node, matrix in at.items()
                    if span.start <= node < span.stop
                }
                nodes = [self.shafts.element_node(node) for node in own]
                pulled = force if name == SPINDLE else None
                chains[name] = self.shafts.of[name].chain(whirl, nodes, added, pulled)
        return _Chains(self.shafts, chains)


@dataclass(frozen=True, eq=False, slots=True)
class _Chains:
    shafts: Shafts
    chains: Mapping[str, Chain]

    @property
    def matrix(self) -> Values:
        blocks = [chain.condensed() for chain in self.chains.values()]
        return side_by_side([b.reshape(2 * len(b), 2 * len(b), -1) for b in blocks])

    @property
    def doubt(self) -> Array:
        return np.asarray(np.max([chain.doubt for chain in self.chains.values()], axis=0))

    def motion(self, moved: Values, wanted: Collection[int]) -> Motion:
        found: Motion = {}
        begin = 0
        for name, chain in self.chains.items():
            own = moved[begin : begin + 2 * len(chain.kept)]
            begin += len(own)
            nodes = self._by_element_node(name, wanted)
            shaped = own.reshape(-1, 2, *own.shape[1:])
            for element_node, motion in chain.motion(shaped, nodes):
                found |= dict.fromkeys(nodes[element_node], motion)
        return found

    def _by_element_node(self, name: str, wanted: Collection[int]) -> Mapping[int, list[int]]:
        """Nodes of a rotor by the node of its elements."""
        span = self.shafts.mesh.spans[name]
        nodes: dict[int, list[int]] = {}
        for node in wanted:
            if span.start <= node < span.stop:
                nodes.setdefault(self.shafts.element_node(node), []).append(node)
        return nodes
