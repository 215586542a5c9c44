"""The equation of motion of one subsystem in its coordinates, at many speeds:

    q̈ + C(Ω) q̇ + K(Ω) q = f

C holds the gyroscopic effect, K what damping in rotating parts, axial force and bearings add
(``assemble``). Where supports are rigid, q = A p with the motions A that they allow
(``constraint``). Subsystems are components that links or the gyroscopic effect join.

Theory: docs/theory/rotor.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any, TypeVar

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices, Matrix
from rotordyn.equation.component import Component
from rotordyn.equation.connection import Connection
from rotordyn.equation.constraint import DEPENDENT
from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.equation.hysteresis import Hysteresis
from rotordyn.equation.structure import Structure
from rotordyn.equation.support import is_isotropic
from rotordyn.equation.term import LinkMatrices

STRAINED = 1e-13  # of a link's largest motion: a smaller one is rounding
T = TypeVar("T", bound=Matrix)


@dataclass(frozen=True, eq=False)
class Linear:
    """One subsystem at ``speed`` (s,): real ``stiffness`` and ``damping`` (s, n, n), mass 1.

    Coordinates are those of ``components``, in this order: plane y, plane z, all others.
    ``allowed`` A (n, m), orthonormal: the motions that rigid supports allow, in the same order, in
    which few strain very stiff links; None where there are neither. ``bodies`` (s, n, n), with it:
    the part of ``stiffness`` that is not of links. ``axisymmetric``: both planes obey the same
    equations at all speeds of the machine, so that forward and backward whirl are uncoupled.
    """

    structure: Structure
    components: tuple[Component, ...]
    speed: Array
    stiffness: Array
    damping: Array
    connections: tuple[Connection, ...]
    loss: Hysteresis | None = None
    allowed: Array | None = None
    bodies: Array | None = None
    axisymmetric: bool = False

    @cached_property
    def gyroscopic(self) -> Array:
        """G (n, n): part of ``damping`` per unit of the spindle's speed."""
        return self.across(self.structure.gyroscopic)

    @cached_property
    def turning(self) -> Array:
        """N (n, n): part of ``stiffness`` by damping in rotating parts, per unit of speed."""
        return self.across(lambda y, _: y.turning)

    def across(self, block: Callable[[Component, Component], Array]) -> Array:
        """Return a matrix (n, n) that has the ``block`` of plane y and plane z of every shaft from
        z to y, and minus its transpose from y to z."""
        matrix = np.zeros((self.size, self.size))
        for y, z in planes_of(self):
            first, other = self.slices[y], self.slices[z]
            matrix[first, other] = block(self.components[y], self.components[z])
            matrix[other, first] = -matrix[first, other].T
        return matrix

    def scaled(self, stiffness: Array, damping: Array) -> Linear:
        """Return the subsystem with factors (s,) on stiffness and damping but not gyroscopic."""
        stiff, damped, spin = (factor[:, None, None] for factor in (stiffness, damping, self.speed))
        turning, gyroscopic = spin * self.turning, spin * self.gyroscopic

        def factored(matrix: Array) -> Array:
            return np.asarray(stiff * (matrix - turning) + damped * turning)

        def link(c: Connection) -> Connection:
            matrices = c.matrices
            return c._replace(
                matrices=LinkMatrices(stiff * matrices.stiffness, damped * matrices.damping)
            )

        return replace(
            self,
            stiffness=factored(self.stiffness),
            damping=damped * (self.damping - gyroscopic) + gyroscopic,
            connections=tuple(link(c) for c in self.connections),
            bodies=None if self.bodies is None else factored(self.bodies),
        )

    @property
    def size(self) -> int:
        """Number of coordinates n."""
        return self.stiffness.shape[-1]

    def at(self, rows: Indices) -> Linear:
        """Return the subsystem at the speeds ``rows``."""
        return replace(
            self,
            speed=self.speed[rows],
            stiffness=self.stiffness[rows],
            damping=self.damping[rows],
            connections=tuple(c.at(rows) for c in self.connections),
            loss=None if self.loss is None else self.loss.at(rows),
            bodies=None if self.bodies is None else self.bodies[rows],
        )

    def within(self, matrix: T) -> T:
        """Return a matrix (…, n, n) in the motions that rigid supports allow (…, m, m)."""
        if self.allowed is None:
            return matrix
        projected: Any = self.allowed.T @ (matrix @ self.allowed)  # of the type of ``matrix``
        return projected

    @cached_property
    def allowed_stiffness(self) -> Array:
        """Stiffness within the motions that rigid supports allow (s, m, m), summed link by link
        there: motions that do not strain a link get none of it, however stiff it is."""
        if self.allowed is None or self.bodies is None:
            return self.stiffness
        total = self.within(self.bodies)
        for c in self.connections:
            motions, size = c.motions @ self.allowed, np.linalg.norm(c.motions, axis=1)
            motions[np.abs(motions) <= STRAINED * size[:, None]] = 0.0
            total = total + motions.T @ (c.matrices.stiffness @ motions)
        return total

    @property
    def basis(self) -> Array:
        """``allowed``, or all coordinates (n, m)."""
        return np.eye(self.size) if self.allowed is None else self.allowed

    @cached_property
    def slices(self) -> list[slice]:
        """Coordinates of each component."""
        ends = accumulate((c.size for c in self.components), initial=0)
        return [slice(a, b) for a, b in pairwise(ends)]

    @property
    def kinds(self) -> frozenset[str]:
        """Kinds of motion that take part: "bending", "axial", "torsion"."""
        names = {line.kind for component in self.components for line in component.lines}
        return frozenset(names - {""})

    def energy_of(self, kind: str) -> Flags:
        """Return which coordinates (n,) of shafts belong to a kind of motion."""
        chosen = np.zeros(self.size, dtype=bool)
        for component, part in zip(self.components, self.slices, strict=True):
            chosen[part] = component.spindle is not None and component.lines[0].kind == kind
        return chosen

    @cached_property
    def rigid(self) -> Flags:
        """Coordinates that are rigid motions of shafts (n,)."""
        return np.concatenate(
            [c.is_rigid & (c.spindle is not None) for c in self.components] or [np.zeros(0, bool)]
        )

    @cached_property
    def motion(self) -> Array:
        """Displacements of the shown nodes by the coordinates (nodes, 6, n)."""
        structure = self.structure
        motion = np.zeros((len(structure.shown.stations), 6, self.size))
        for component, at in zip(self.components, self.slices, strict=True):
            for line in component.lines:
                if line.body in structure.shafts:
                    nodes = structure.shown.spans[line.body]
                    motion[nodes, :, at] += structure.motion(line, component)
        return motion

    @cached_property
    def planes(self) -> tuple[Indices, Indices]:
        """Coordinates of plane y and, in the same order, of plane z, where bodies have both."""
        pairs = [(self.slices[a], self.slices[b]) for a, b in planes_of(self)]
        coordinates, empty = np.arange(self.size), np.zeros(0, dtype=np.intp)
        return (
            np.concatenate([empty, *(coordinates[y] for y, _ in pairs)]),
            np.concatenate([empty, *(coordinates[z] for _, z in pairs)]),
        )

    def row(self, rotor: str, x: float, direction: str) -> Array:
        """Return the displacement of a rotor's node at ``x`` [m] in one direction (n,)."""
        number = self.structure.node(rotor, x)[position(direction)]
        return self.displaced(np.array([number]))[0]

    def displaced(self, dofs: Indices) -> Array:
        """Return displacements of DOF in their directions by the coordinates (DOF, n); zero of
        those of other subsystems."""
        return np.asarray(self.structure.dofs.sign[dofs, None] * self.moved(dofs))

    def moved(self, dofs: Indices) -> Array:
        """Return displacements of the signed DOF by the coordinates (DOF, n)."""
        rows = np.zeros((len(dofs), self.size))
        for component, part in zip(self.components, self.slices, strict=True):
            included = component.has(dofs)
            rows[included, part] = component.vectors[component.local(dofs[included])]
        return rows

    def rigid_force(self, unbalanced: Complex) -> dict[str, Complex]:
        """Return the forces of rigid supports on what they hold (s, 6), by name, where others leave
        ``unbalanced`` (s, n) to them; along rigid motions only.

        NaN where supports that hold the same motion share it: their shares are not determined.
        """
        connections = [c for c in self.connections if c.link.rigid]
        if not connections:
            return {}
        rows = np.concatenate([c.motions[c.rigid > 0.0] for c in connections])
        acting = np.flatnonzero(rows.any(axis=1))
        force = np.zeros((len(unbalanced), len(rows)), dtype=complex)
        solution, _, rank, _ = np.linalg.lstsq(rows[acting].T, -unbalanced.T, rcond=DEPENDENT)
        force[:, acting] = solution.T if rank == len(acting) else complex(np.nan, np.nan)
        forces, start = {}, 0
        for c in connections:
            reaction = np.zeros((len(unbalanced), len(c.motions)), dtype=complex)
            reaction[:, c.rigid > 0.0] = force[:, start : start + len(c.link.rigid)]
            forces[c.link.name], start = reaction, start + len(c.link.rigid)
        return forces


def name_of(components: Iterable[Component]) -> str:
    """Return the motions of a subsystem: "bending", "bending and axial" …."""
    motions = {line.kind for component in components for line in component.lines}
    named = [name for name in ("bending", "axial", "torsion") if name in motions]
    return " and ".join(named) or "housing"


def planes_identical(linear: Linear) -> bool:
    """True if both planes obey the same equations at every speed."""
    firsts = [c for c in linear.components if c.way == "y"]
    seconds = [c for c in linear.components if c.way == "z"]
    if len(firsts) + len(seconds) != len(linear.components):
        return False
    if [c.lines[0].body for c in firsts] != [c.lines[0].body for c in seconds]:
        return False
    names = ("vectors", "stiffness", "damping", "turning")
    if not all(
        np.array_equal(getattr(y, name), getattr(z, name))
        for y, z in zip(firsts, seconds, strict=True)
        for name in names
    ):
        return False
    return all(
        is_isotropic(part)
        for connection in linear.connections
        for part in (*connection.matrices, np.diag(connection.rigid))
        if part.shape[-1] == len(DIRECTIONS)
    )


def planes_of(linear: Linear) -> list[tuple[int, int]]:
    """Return the indices of plane y and plane z of every shaft among the components."""
    places = {(c.lines[0].body, c.way): k for k, c in enumerate(linear.components) if c.spindle}
    return [
        (k, places[body, "z"])
        for (body, way), k in places.items()
        if way == "y" and (body, "z") in places
    ]
