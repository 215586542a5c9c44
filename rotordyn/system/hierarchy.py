"""The rotor in elements of higher degree: matrices, where a station lies, what is left out.

Freedoms: those of the nodes as in ``dofs``, node by node, then the inner ones element by element.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rotordyn.system.mesh import Mesh

Array = NDArray[np.float64]
Degrees = NDArray[np.intp]
LEVELS = 2  # degrees above its own by which what an element leaves out is judged


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """Elements between the nodes of ``mesh``, of ``degree`` (elements,).

    ``width``: freedoms of a node; ``inner``: how many freedoms a degree has between the nodes;
    ``element``: matrices of some elements (indices, degree) by name, (elements, k, k) each;
    ``added``: of the freedoms of a higher degree, which are those of a lower one, which are new.
    """

    mesh: Mesh
    degree: Degrees
    width: int
    inner: Callable[[int], int]
    element: Callable[[Degrees, int], dict[str, Array]]
    added: Callable[[int, int], tuple[list[int], list[int]]]

    @property
    def size(self) -> int:
        """All freedoms."""
        return int(self.first[-1])

    @cached_property
    def first(self) -> Degrees:
        """First inner freedom of every element, then the number of all (elements + 1,)."""
        counts = [self.inner(int(n)) for n in self.degree]
        return self.width * self.mesh.nodes + np.concatenate(
            [[0], np.cumsum(counts, dtype=np.intp)]
        )

    def rows(self, element: int) -> Degrees:
        """All freedoms of an element in the order of its matrices."""
        nodal = self.width * element + np.arange(2 * self.width)
        return np.concatenate([nodal, np.arange(self.first[element], self.first[element + 1])])

    def matrices(self) -> dict[str, Array]:
        """Assembled matrices (size, size) by name, without what is lumped at nodes."""
        whole: dict[str, Array] = {}
        for degree, elements in self._by_degree():
            for name, blocks in self.element(elements, degree).items():
                total = whole.setdefault(name, np.zeros((self.size, self.size)))
                for k, block in zip(elements, blocks, strict=True):
                    rows = self.rows(int(k))
                    total[rows[:, None], rows] += block
        return whole

    def left_out(self, basis: Array) -> dict[str, Array]:
        """What the next ``LEVELS`` degrees would add, seen by the vectors ``basis`` (size, m).

        By name the coupling of every new freedom with the vectors (new, m); ``own_mass`` and
        ``own_stiffness`` (new,): of the new freedoms by themselves.
        """
        found: dict[str, list[Array]] = {}
        for degree, elements in self._by_degree():
            kept, new = self.added(degree, degree + LEVELS)
            blocks = self.element(elements, degree + LEVELS)
            moved = np.stack([basis[self.rows(int(k))] for k in elements])
            for name, block in blocks.items():
                coupling = block[:, new][:, :, kept] @ moved
                found.setdefault(name, []).append(coupling.reshape(-1, basis.shape[1]))
            for name in ("mass", "stiffness"):
                own = blocks[name][:, new, new]
                found.setdefault(f"own_{name}", []).append(own.ravel())
        return {name: np.concatenate(parts) for name, parts in found.items()}

    def place(self, x: Array) -> tuple[Degrees, Array]:
        """Element and ξ on [−1, 1] of stations ``x`` [m]."""
        element = np.clip(
            np.searchsorted(self.mesh.x, x, side="right") - 1, 0, len(self.degree) - 1
        )
        left = self.mesh.x[element]
        return element, 2.0 * (x - left) / self.mesh.length[element] - 1.0

    def _by_degree(self) -> Iterator[tuple[int, Degrees]]:
        for degree in np.unique(self.degree):
            yield int(degree), np.flatnonzero(self.degree == degree)


def divided(mesh: Mesh, parts: Degrees) -> Mesh:
    """Every element of ``mesh`` cut into equal ``parts`` (elements,)."""
    step = np.repeat(mesh.length / parts, parts)
    x = np.concatenate([mesh.x[:1], mesh.x[0] + np.cumsum(step)])
    x[np.concatenate([[0], np.cumsum(parts)])] = mesh.x
    names = ("outer_diameter", "inner_diameter", "young_modulus", "poisson_ratio", "density")
    own = {name: np.repeat(getattr(mesh, name), parts) for name in names}
    return replace(mesh, x=x, **own)
