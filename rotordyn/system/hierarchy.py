"""The rotor in elements of higher degree: matrices, where a station lies, what is left out.

Freedoms: those of the nodes as in ``dofs``, node by node, then the inner ones element by element,
then the jumps at joints.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.sparse import LARGE, Matrix, Part, summed
from rotordyn.system.jumps import Jump
from rotordyn.system.mesh import COINCIDENT, Mesh

Array = NDArray[np.float64]
Degrees = NDArray[np.intp]
AT_ONCE = 2000  # elements, whose blocks are kept small
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
        loads = np.zeros((self.size, len(self.dampers)))
        loads[list(self.dampers), np.arange(len(self.dampers))] = 1.0
        return loads

    @property
    def large(self) -> bool:
        """True where matrices are of compressed rows."""
        return self.size >= LARGE

    @property
    def order(self) -> Degrees:
        """Freedoms from front to rear, jumps last: the order in which elimination stays narrow."""
        inner = np.repeat(np.arange(len(self.degree)), np.diff(self.first))
        nodal = np.repeat(np.arange(self.mesh.nodes), self.width)
        last = np.full(len(self.jumps), self.mesh.nodes)
        return np.argsort(np.concatenate([nodal, inner, last]), kind="stable")

    def rows(self, elements: Degrees) -> Degrees:
        """All freedoms of ``elements`` (e,) of one degree, as their matrices have them (e, k)."""
        nodal = self.width * elements[:, None] + np.arange(2 * self.width)
        inner = np.arange(self.inner(int(self.degree[elements[0]])))
        return np.concatenate([nodal, self.first[elements][:, None] + inner], axis=1)

    def matrices(self) -> dict[str, Matrix]:
        """Assembled matrices (size, size) by name, without what is lumped at nodes."""
        parts: dict[str, list[Part]] = {}
        for degree, elements in self.by_degree():
            rows = self.rows(elements)
            for name, blocks in self.element(elements, degree).items():
                own = parts.setdefault(name, [])
                own.append((rows, rows, blocks))
                if name != "stiffness" and self.jumps:
                    own += self._carrying(elements, rows, blocks)
        if self.jumps:
            own_rows = np.arange(self.size - len(self.jumps), self.size)[:, None]
            stiff = np.array([jump.stiffness for jump in self.jumps]).reshape(-1, 1, 1)
            parts["stiffness"].append((own_rows, own_rows, stiff))
        shape = self.size, self.size
        return {name: summed(shape, own, large=self.large) for name, own in parts.items()}

    def _carrying(self, elements: Degrees, rows: Degrees, blocks: Array) -> list[Part]:
        """What elements add to the jumps that carry them."""
        return self._with_jumps(rows, blocks, self.carried(elements, rows.shape[1]))

    def _with_jumps(self, rows: Degrees, blocks: Array, carried: Array) -> list[Part]:
        """Of blocks whose freedoms the jumps move by ``carried`` (…, k, jumps), all but the blocks
        themselves."""
        last = np.arange(self.size - len(self.jumps), self.size)
        own = np.broadcast_to(last, (len(rows), len(last)))
        felt, turned = blocks @ carried, np.swapaxes(carried, 1, 2)
        return [
            (rows, own, felt),
            (own, rows, np.swapaxes(felt, 1, 2)),
            (own, own, turned @ felt),
        ]

    def carried(self, elements: Degrees, freedoms: int) -> Array:
        """Freedoms of ``elements`` (e,) by the jumps (e, freedoms, jumps)."""
        x, ends = self.mesh.x, 2 * self.width
        rows = np.zeros((len(elements), freedoms, len(self.jumps)))
        for column, jump in enumerate(self.jumps):
            behind = (self.mesh.middle[elements] > jump.x)[:, None]
            stations = np.stack([x[elements], x[elements + 1]], axis=1)
            moved = jump.motion(stations.ravel(), self.width).reshape(len(elements), ends)
            rows[:, :ends, column] = np.where(behind, moved, 0.0)
        return rows

    def at_nodes(self, nodes: Sequence[int], blocks: Array) -> Matrix:
        """What sits at nodes, blocks (k, width, width), by all freedoms (size, size); a joint there
        is behind it."""
        place = np.asarray(nodes, dtype=np.intp)
        rows = self.width * place[:, None] + np.arange(self.width)
        parts = [(rows, rows, blocks)]
        if self.jumps:
            carried = self.jumped(self.mesh.x[place]).reshape(len(place), self.width, -1)
            parts += self._with_jumps(rows, blocks, carried)
        return summed((self.size, self.size), parts, large=self.large)

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
        for part in self.left_out_by_parts(basis):
            for name, values in part.items():
                found.setdefault(name, []).append(values)
        return {name: np.concatenate(parts) for name, parts in found.items()}

    def left_out_by_parts(self, basis: Array) -> Iterator[dict[str, Array]]:
        """The same, ``AT_ONCE`` elements at a time."""
        for degree, every in self.by_degree():
            kept, new = self.added(degree, degree + LEVELS)
            for start in range(0, len(every), AT_ONCE):
                elements = every[start : start + AT_ONCE]
                blocks = self.element(elements, degree + LEVELS)
                moved = self._moved(basis, elements)
                part = {
                    name: (block[:, new][:, :, kept] @ moved).reshape(-1, basis.shape[1])
                    for name, block in blocks.items()
                }
                own = {f"own_{n}": blocks[n][:, new, new].ravel() for n in ("mass", "stiffness")}
                yield part | own

    def _moved(self, basis: Array, elements: Degrees) -> Array:
        """Freedoms of elements of one degree by vectors (e, k, m)."""
        rows = self.rows(elements)
        own, jumped = basis[rows], basis[self.size - len(self.jumps) :]
        return own + self.carried(elements, rows.shape[1]) @ jumped if self.jumps else own

    def place(self, x: Array) -> tuple[Degrees, Array]:
        """Element and ξ on [−1, 1] of stations ``x`` [m]."""
        element = np.clip(
            np.searchsorted(self.mesh.x, x, side="right") - 1, 0, len(self.degree) - 1
        )
        left = self.mesh.x[element]
        return element, 2.0 * (x - left) / self.mesh.length[element] - 1.0

    def by_degree(self) -> Iterator[tuple[int, Degrees]]:
        """Every degree and its elements."""
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
