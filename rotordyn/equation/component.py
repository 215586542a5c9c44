"""One uncoupled motion of one body, reduced: the DOF that constant matrices of terms couple.

A free shaft has four: axial motion, torsion, bending in plane y and in plane z. Its coordinates are
free modes up to a cut-off and static modes at ports (``reduce``), or its rigid motions alone; those
of a sleeve or a housing are its own DOF. Mass is the identity in all of them.

Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.damping import modal_damping
from rotordyn.equation.dofs import Line
from rotordyn.equation.fineness import HEAVIEST
from rotordyn.equation.reduce import Coupling, enriched, reduce
from rotordyn.equation.shaft import Rows
from rotordyn.equation.term import Part
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import LARGE, Matrix, summed

Solved = dict[tuple[Any, ...], tuple[Array, Array, Array]]  # reductions by what they follow from
REDUCED = ("mass", "stiffness")  # matrices that the reduction of a shaft follows from


class Coarse(NamedTuple):
    """The ``component`` of a coarser model: its DOF ``there`` have the shape functions of the DOF
    ``here`` of the finer one."""

    component: Component
    here: Indices
    there: Indices


@dataclass(eq=False)
class Component:
    """DOF ``dofs`` (n,) of ``lines``, and the ``parts`` on them.

    ``rigid``: rigid motions of a free shaft, empty for other bodies; ``ports``: DOF that keep a
    static mode; ``spindle``: the rotor whose damping it has, None for other bodies, and ``ratio``,
    its speed over the spindle's. ``solved``: components with the same matrices share one reduction.
    ``polar``: gyroscopic parts in one plane whose forces on modes up to ``band`` [rad/s] static
    modes represent; empty where they need not. ``pressed``: weighted slopes where an axial force
    may come near to buckling, None elsewhere. ``coarse``: the coarser model, if any, whose vectors
    begin the reduction of a large component. ``inertial``: static modes represent the inertia
    forces of those at ports as well.
    """

    lines: tuple[Line, ...]
    dofs: Indices
    parts: list[Part]
    rigid: list[tuple[Indices, Array]]
    ports: Indices
    spindle: Spindle | None
    cutoff: float
    bends: bool
    solved: Solved
    ratio: float
    polar: list[Part]
    band: float
    pressed: tuple[int, list[Rows]] | None
    coarse: Coarse | None
    inertial: bool

    @property
    def way(self) -> str:
        """ "y", "z", "x", "thx", or "" where lines of several directions or none are joined."""
        ways = {line.way for line in self.lines}
        return ways.pop() if len(ways) == 1 else ""

    def local(self, dofs: Indices) -> Indices:
        """Return the indices of DOF within the component."""
        return np.asarray(self._place[dofs])

    @cached_property
    def _place(self) -> Indices:
        place = np.zeros(self.dofs[-1] + 1, dtype=np.intp)
        place[self.dofs] = np.arange(len(self.dofs))
        return place

    def has(self, dofs: Indices) -> np.ndarray:
        """Return which DOF belong to the component."""
        index = np.minimum(np.searchsorted(self.dofs, dofs), len(self.dofs) - 1)
        return np.asarray(self.dofs[index] == dofs)

    def assembled(self, name: str, parts: list[Part] | None = None) -> Matrix:
        """Return the matrix (n, n) of the parts of that name."""
        chosen = [p for p in parts or self.parts if p.matrix == name]
        size = len(self.dofs)
        blocks = [(self.local(p.rows), self.local(p.columns), p.blocks) for p in chosen]
        return summed((size, size), blocks, large=self.large)

    @property
    def large(self) -> bool:
        """True if matrices have compressed rows."""
        return len(self.dofs) >= LARGE

    def displaced(self, count: int, rows: list[Rows]) -> Array:
        """Return motions (count, m) of ``count`` places by the coordinates, from a shaft's rows."""
        return np.asarray(self.placed(count, rows) @ self.vectors)

    def placed(self, count: int, rows: list[Rows]) -> Matrix:
        """Return the motion of ``count`` places by the DOF (count, n)."""
        local = [(places, self.local(dofs), factors) for places, dofs, factors in rows]
        large = self.large or count * len(self.dofs) > 1_000_000
        return summed((count, len(self.dofs)), local, large=large)

    @property
    def size(self) -> int:
        """Number of coordinates m."""
        return self.vectors.shape[1]

    @property
    def vectors(self) -> Array:
        """Displacements of the DOF by the coordinates (n, m)."""
        return self._reduced[0]

    @property
    def values(self) -> Array:
        """Stiffness of the coordinates of a shaft (m,); (m, m) of other bodies."""
        return self._reduced[1]

    @property
    def is_rigid(self) -> np.ndarray:
        """Coordinates that are rigid motions of a shaft (m,)."""
        stiffness = self.values if self.values.ndim == 1 else np.ones(self.size)
        return np.asarray(stiffness == 0.0)

    @cached_property
    def stiffness(self) -> Array:
        """Stiffness in the coordinates (m, m)."""
        return np.diag(self.values) if self.values.ndim == 1 else self.values

    @cached_property
    def own_damping(self) -> Array:
        """Modal and Rayleigh damping (m, m)."""
        if self.spindle is None:
            return np.zeros((self.size, self.size))
        return modal_damping(self.spindle, self.values, self._reduced[2], bending=self.bends)

    @cached_property
    def damping(self) -> Array:
        """Damping (m, m), with that of dampers inside the body."""
        return self.own_damping + self.projected("damping")

    @cached_property
    def turning(self) -> Array:
        """Bending damping that rotates with the rotor, per unit of the spindle's speed (m, m)."""
        damping = self.projected("turning")
        if self.spindle is None or not self.spindle.internal_damping or not self.bends:
            return damping
        return damping + self.ratio * self.spindle.internal_damping * self.own_damping

    def projected(self, name: str) -> Array:
        """Return a matrix in the coordinates (m, m)."""
        if not any(part.matrix == name for part in self.parts):
            return np.zeros((self.size, self.size))
        return np.asarray(self.vectors.T @ (self.assembled(name) @ self.vectors))

    @cached_property
    def _reduced(self) -> tuple[Array, Array, Array]:
        if self.spindle is None:
            mass, stiffness = self.assembled("mass"), self.assembled("stiffness")
            inverse = np.linalg.inv(np.linalg.cholesky((mass + mass.T) / 2.0))
            values = inverse @ stiffness @ inverse.T
            return inverse.T, values, np.zeros_like(values)
        parts = [
            (p.matrix, self.local(p.rows), p.blocks) for p in self.parts if p.matrix in REDUCED
        ]
        key = (
            self.local(self.ports).tobytes(),
            *((name, _digest(rows), _digest(blocks)) for name, rows, blocks in parts),
        )
        if key not in self.solved:
            self.solved[key] = self._of_shaft()
        return self.solved[key]

    def _of_shaft(self) -> tuple[Array, Array, Array]:
        mass, stiffness = self.assembled("mass"), self.assembled("stiffness")
        rigid = np.zeros((len(self.dofs), self.rigid[0][1].shape[1]))
        for dofs, motion in self.rigid:
            rigid[self.local(dofs)] = motion
        if self.cutoff == 0.0:  # a rigid rotor
            factor = np.linalg.cholesky(rigid.T @ (mass @ rigid))
            zero = np.zeros(rigid.shape[1])
            return np.asarray(np.linalg.solve(factor, rigid.T).T), zero, np.diag(zero)
        ports = np.zeros((len(self.dofs), len(self.ports)))
        ports[self.local(self.ports), np.arange(len(self.ports))] = 1.0
        couplings = []
        if self.polar:
            couplings.append(Coupling(self.assembled("gyroscopic", self.polar), self.band))
        if self.pressed is not None:
            count, rows = self.pressed
            slopes = self.placed(count, rows)
            couplings.append(Coupling(slopes.T @ slopes, self.cutoff, statics=True))
        if self.coarse is not None and self.large:
            coarser, fine_dofs, coarse_dofs = self.coarse
            vectors = coarser.vectors[:, ~coarser.is_rigid]
            start = np.zeros((len(self.dofs), vectors.shape[1]))
            start[self.local(fine_dofs)] = vectors[coarser.local(coarse_dofs)]
            basis = enriched(mass, stiffness, rigid, start, couplings)
        else:
            if self.inertial:
                couplings.append(Coupling(mass, 0.0, statics=True))
            basis = reduce(mass, stiffness, rigid, ports, self.cutoff, couplings)
        # nearly massless coordinates get a fictitious mass, or their damping drowns slow modes
        stiff = np.maximum(np.sqrt(basis.values) / (HEAVIEST * self.cutoff), 1.0)
        roots = basis.roots / stiff[:, None] / stiff
        return basis.vectors / stiff, basis.values / stiff**2, roots


def _digest(values: Array | Indices) -> bytes:
    """Return what stands for ``values`` as a key: those of large shafts take much memory."""
    return hashlib.blake2b(values.tobytes()).digest()
