"""What the axial force does to bending: N ∫ v′² dx in the shaft, and the string of the drawbar.

The bar is a string under tension P that runs straight between the stations at which it touches the
shaft: between two of them, a distance L apart, it answers with P/L to their relative deflection.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.plane_bending import axial_force_stiffness, shear_parameter
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import LONG, Matrix, summed
from rotordyn.system.assemble import chain, shear_coefficients
from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class Stiffening:
    """Stiffness of one bending plane per newton of axial force, and that of the drawbar.

    ``per_newton`` (elements, 4, 4) [1/m, 1, m]; ``spans``: node, node and stiffness [N/m] of every
    straight part of the bar.
    """

    per_newton: Array
    spans: tuple[tuple[int, int, float], ...]

    def shaft(self, force: Array) -> Matrix:
        """Stiffness (2·nodes, 2·nodes) under the axial ``force`` (elements,) [N]."""
        return chain(self.per_newton * force[:, None, None])

    def projected(self, rows: Array) -> Array:
        """Per newton in each element (elements, m, m), nodes moving by ``rows`` (nodes, 2, m)."""
        ends = np.concatenate([rows[:-1], rows[1:]], axis=1)
        return np.asarray(np.swapaxes(ends, 1, 2) @ self.per_newton @ ends)

    def strung(self, nodes: int) -> Matrix:
        """Stiffness of the drawbar by the freedoms of all nodes (2·nodes, 2·nodes)."""
        size, sign = 2 * nodes, np.array([[1.0, -1.0], [-1.0, 1.0]])
        ends = np.array([(2 * left, 2 * right) for left, right, _ in self.spans])
        stiffness = np.array([stiffness for *_, stiffness in self.spans])[:, None, None]
        return summed((size, size), [(ends, ends, stiffness * sign)], large=size >= LONG)

    def bar(self, rows: Array, others: Array | None = None) -> Array:
        """Stiffness of the drawbar (m, k), nodes moving by ``rows`` (nodes, 2, m) and ``others``
        (nodes, 2, k), the same if left out."""
        others = rows if others is None else others
        total = np.zeros((rows.shape[2], others.shape[2]))
        for left, right, stiffness in self.spans:
            one, other = (each[right, 0] - each[left, 0] for each in (rows, others))
            total += stiffness * np.outer(one, other)
        return total


def stiffening(spindle: Spindle, mesh: Mesh) -> Stiffening:
    """The elements of ``mesh`` and the drawbar of ``spindle``, if it has one."""
    ring = (mesh.outer_diameter, mesh.inner_diameter)
    phi = shear_parameter(
        mesh.length,
        mesh.young_modulus * second_moment(*ring),
        shear_coefficients(spindle, mesh) * mesh.shear_modulus * area(*ring),
    )
    bar = spindle.drawbar
    return Stiffening(
        per_newton=axial_force_stiffness(mesh.length, phi, np.ones_like(phi)),
        spans=tuple(
            (mesh.node_of(a), mesh.node_of(b), bar.force / (b - a))
            for a, b in pairwise(bar.contacts if bar else ())
            if bar
        ),
    )
