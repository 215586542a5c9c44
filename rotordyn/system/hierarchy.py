"""The rotor in elements of higher degree: matrices, where a station lies, what is left out.

Freedoms: those of the nodes as in ``dofs``, node by node, then the inner ones element by element,
then the jumps at joints.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.system.jumps import Jump
from rotordyn.system.mesh import COINCIDENT, Mesh

Array = NDArray[np.float64]
Degrees = NDArray[np.intp]
LEVELS = 2  # degrees above its own by which what an element leaves out is judged


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """Elements between the nodes of ``mesh``, of ``degree`` (elements,).

    ``width``: freedoms of a node; ``inner``: how many freedoms a degree has between the nodes;
    ``element``: matrices of some elements (indices, degree) by name, (elements, k, k) each;
    ``added``: of the freedoms of a higher degree, which are those of a lower one, which are new.
    ``jumps``: of the part behind a joint.
    """

    mesh: Mesh
    degree: Degrees
    width: int
    inner: Callable[[int], int]
    element: Callable[[Degrees, int], dict[str, Array]]
    added: Callable[[int, int], tuple[list[int], list[int]]]
    jumps: tuple[Jump, ...] = ()

    @property
    def size(self) -> int:
        """All freedoms."""
        return int(self.first[-1]) + len(self.jumps)

    @cached_property
    def first(self) -> Degrees:
        """First inner freedom of every element, then the number of all (elements + 1,)."""
        counts = [self.inner(int(n)) for n in self.degree]
        return self.width * self.mesh.nodes + np.concatenate(
            [[0], np.cumsum(counts, dtype=np.intp)]
        )

    @property
    def dampers(self) -> dict[int, float]:
        """Freedom of every jump that damps, and its damping."""
        first = self.size - len(self.jumps)
        return {first + k: jump.damping for k, jump in enumerate(self.jumps) if jump.damping}

    @property
    def damper_loads(self) -> Array:
        """A unit force in each of these (size, dampers)."""
        return np.eye(self.size)[:, list(self.dampers)]

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
                    if name != "stiffness" and self.jumps:
                        self._add_carried(total, int(k), rows, block)
        own = np.arange(self.size - len(self.jumps), self.size)
        if self.jumps:
            whole["stiffness"][own, own] = [jump.stiffness for jump in self.jumps]
        return whole

    def _add_carried(self, total: Array, k: int, rows: Degrees, block: Array) -> None:
        """What an element adds to the jumps that carry it."""
        carried, own = self.carried(k), slice(self.size - len(self.jumps), None)
        total[rows, own] += block @ carried
        total[own, rows] += carried.T @ block
        total[own, own] += carried.T @ block @ carried

    def carried(self, element: int) -> Array:
        """Freedoms of an element by the jumps (k, jumps)."""
        ends = self.mesh.x[element : element + 2]
        rows = np.zeros((len(self.rows(element)), len(self.jumps)))
        for column, jump in enumerate(self.jumps):
            if self.mesh.middle[element] > jump.x:
                rows[: 2 * self.width, column] = jump.motion(ends, self.width)
        return rows

    def at_node(self, node: int) -> Array:
        """Freedoms of a node, of the part in front at a joint, by all freedoms (width, size)."""
        rows = np.zeros((self.width, self.size))
        own = np.arange(self.width)
        rows[own, self.width * node + own] = 1.0
        rows[:, self.size - len(self.jumps) :] = self.jumped(self.mesh.x[node : node + 1])
        return rows

    def jumped(self, x: Array) -> Array:
        """Motion by the jumps at stations ``x``, in front of a joint there (width·x, jumps)."""
        columns = [np.zeros((self.width * len(x), 0))]
        slack = COINCIDENT * float(self.mesh.x[-1] - self.mesh.x[0])
        for jump in self.jumps:
            behind = np.repeat(x > jump.x + slack, self.width)
            columns.append(np.where(behind, jump.motion(x, self.width), 0.0)[:, None])
        return np.concatenate(columns, axis=1)

    def left_out(self, basis: Array) -> dict[str, Array]:
        """What the next ``LEVELS`` degrees would add, seen by the vectors ``basis`` (size, m).

        By name the coupling of every new freedom with the vectors (new, m); ``own_mass`` and
        ``own_stiffness`` (new,): of the new freedoms by themselves.
        """
        found: dict[str, list[Array]] = {}
        for degree, elements in self._by_degree():
            kept, new = self.added(degree, degree + LEVELS)
            blocks = self.element(elements, degree + LEVELS)
            moved = np.stack([self._moved(basis, int(k)) for k in elements])
            for name, block in blocks.items():
                coupling = block[:, new][:, :, kept] @ moved
                found.setdefault(name, []).append(coupling.reshape(-1, basis.shape[1]))
            for name in ("mass", "stiffness"):
                own = blocks[name][:, new, new]
                found.setdefault(f"own_{name}", []).append(own.ravel())
        return {name: np.concatenate(parts) for name, parts in found.items()}

    def _moved(self, basis: Array, k: int) -> Array:
        """Freedoms of an element by vectors (k, m)."""
        own = basis[self.rows(k)]
        return own + self.carried(k) @ basis[self.size - len(self.jumps) :] if self.jumps else own

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
    own: dict[str, Any] = {name: np.repeat(getattr(mesh, name), parts) for name in names}
    return replace(mesh, x=x, **own)
