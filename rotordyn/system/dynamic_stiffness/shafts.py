"""Every rotor of the machine, and how one mesh numbers their nodes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rotordyn.system.dynamic_stiffness.whirling_shaft import WhirlingShaft
from rotordyn.system.mesh import Mesh


@dataclass(frozen=True, eq=False, slots=True)
class Shafts:
    """Every rotor by name, and the ``mesh`` that numbers their nodes."""

    mesh: Mesh
    of: Mapping[str, WhirlingShaft]

    def place(self, node: int) -> tuple[str, float]:
        """The rotor of a node, and where it is there [m]."""
        name = next(n for n, own in self.mesh.spans.items() if own.start <= node < own.stop)
        return name, float(self.mesh.stations[node])

    def element_node(self, node: int) -> int:
        """A node as the elements of its rotor count it."""
        name, x = self.place(node)
        return self.of[name].elements.mesh.node_of(x)

    @property
    def size(self) -> int:
        """Freedoms of a plane."""
        return sum(shaft.elements.size for shaft in self.of.values())
