"""The shaft at rest, K u = f of all terms, with the forces r of all springs among the unknowns:

    K_N u − Mᵀ r = f,    r + S (M u + e) = 0,    or M u + e = 0 where rigid

Springs are the links, the elements of the shaft, of which M u is the motion of the rear end with
the front end held, and what holds other bodies; S is their stiffness, e an offset between both
sides of a link, K_N the stiffness by the axial force: K = K_N + Mᵀ S M. So neither stiff nor short
springs take digits of others, and forces that equilibrium alone determines are exact to rounding.
Nodes of cylinders move as their exact solution; elements of cones are as fine as ``ACCURACY``
requires, those under an axial force ``BENT`` degrees higher.

Theory: docs/theory/statics.md#equilibrium.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.axial_force import slope_rows
from rotordyn.equation.dofs import position
from rotordyn.equation.elements.polynomials import points
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.joint import joint_parts
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.shaft import NAMES, PLANES, Rows, Springs
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import Link, State
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE
from rotordyn.numerics.sparse import Matrix, summed

ACCURACY = 1e-9  # of cones
BENT = 2  # degrees more of elements under an axial force, in whose bending they are not exact
GAUSS = 9  # degree up to which the work of line loads is integrated exactly
LOST = 1e-6  # of the largest displacement or force: larger rounding errors are refused
ROUNDING = 2.0**-52
REFINED = 2  # times


class Undetermined(Exception):
    """Rounding errors dominate the solution at ``row`` of the states."""

    def __init__(self, row: int) -> None:
        super().__init__(row)
        self.row = row


class LoadCase(NamedTuple):
    """Loads: on nodes ``point`` (states or 1, nodes, 6) [N, N·m], along elements ``line``
    (elements, 2, 3) [N/m], at both ends and linear in between; ``offset`` (connections, 6) of
    connections from the shaft [m, rad], as of an eccentric ring: each reacts to the sum of
    displacement and offset."""

    point: Array
    line: Array
    offset: Array | None = None


@dataclass(frozen=True, eq=False, slots=True)
class AtRest:
    """``displacement`` (states, nodes, 6) of the shaft [m, rad], at a joint that of the part in
    front; ``jump`` (states, elements, 6): additional displacement of the front end of an element
    behind a joint; ``push`` (states, connections, 6): loads of connections on the shaft [N, N·m];
    ``strained`` (states, connections, 6): displacement of the shaft there against what carries it;
    ``bar_force`` (states, elements, 2): along y and z, of a drawbar inside the shaft [N].
    """

    displacement: Array
    jump: Array
    push: Array
    strained: Array
    bar_force: Array


class StaticEquation:
    """The equation of a spindle's shaft with nodes of a ``mesh``, on its connections.

    ``free`` (k, 6): combinations of the displacements of the front end that nothing holds, set to
    zero. ``rigid``: the shaft does not deform; ``axial`` (states, elements) [N]: force on bending,
    tension positive, beside which the drawbar is a string; None where neither acts.
    """

    def __init__(
        self,
        spindle: Spindle,
        mesh: Mesh,
        free: Array,
        *,
        rigid: bool = False,
        axial: Array | None = None,
    ) -> None:
        fine = Fineness(0.0, accuracy=ACCURACY, finer=0 if axial is None else BENT)
        structure = Structure(spindle, mesh, fine, rigid=rigid)
        self.structure, self.mesh, self.shaft = structure, mesh, structure.shafts[SPINDLE]
        self.basis = _rigid_motions(structure) if rigid else None
        self.bars = structure.drawbar if axial is not None else []
        self.links = [*structure.connections, *structure.sleeve_springs, *self.bars]
        springs = [_by_state(link) for link in self.links]
        springs += [] if rigid else [each for way in NAMES for each in self.shaft.springs(way)]
        springs += _other_springs(structure)
        numbers, m = list[Indices](), 0  # of the motions of each
        for each in springs:
            shape = each.motions.shape[:2]
            numbers.append(m + np.arange(math.prod(shape)).reshape(shape))
            m += math.prod(shape)
        numbered = [*zip(numbers, springs, strict=True)]
        self.motions = self._by_coordinates(m, ((at, s.dofs, s.motions) for at, s in numbered))
        self.stiffness = summed((m, m), ((at, at, s.stiffness) for at, s in numbered), large=True)
        self.of_link = [at[0] for at in numbers[: len(self.links)]]
        self.rigid = np.zeros(m, dtype=bool)
        for at, link in zip(self.of_link, self.links, strict=True):
            self.rigid[at[list(link.rigid)]] = True
        self.slopes = list[tuple[Matrix, Array]]()  # weighted, and the axial force (states,) there
        if axial is not None:
            for plane in PLANES:
                rows, element = slope_rows(self.shaft, mesh, plane)
                self.slopes.append((self._by_coordinates(len(element), rows), axial[:, element]))
        self.at_nodes = self._displaced(mesh.x)
        self.free = free @ self.at_nodes[:6]

    def _by_coordinates(self, count: int, rows: Iterable[Rows]) -> Matrix:
        by_dofs = summed((count, self.structure.dofs.count), rows, large=True)
        return by_dofs if self.basis is None else by_dofs @ self.basis

    def _displaced(self, x: Array) -> Matrix:
        """Return displacements of stations ``x`` by the coordinates (6 stations, n)."""
        rows = [row for way in NAMES for row in self.shaft.displaced(way, x)]
        return self._by_coordinates(6 * len(x), rows)

    def solve(self, state: State, cases: Sequence[LoadCase]) -> list[AtRest]:
        """Return the shaft in each of the load ``cases`` at every state.

        Raises
        ------
        Undetermined : there is no solution at a state, or none beyond rounding
        """
        from scipy.sparse import block_array, csr_array, diags_array

        (m, n), k, states = self.motions.shape, len(self.free), len(state.speed)
        loads = np.stack([np.broadcast_to(self._load(c), (states, n)) for c in cases], axis=-1)
        offset = np.zeros((m, len(cases)))
        for column, case in enumerate(cases):
            if case.offset is not None:
                offset[: case.offset.size, column] = case.offset.ravel()
        unit = self._unit()  # forces over it are of the size of displacements
        solution = np.zeros((states, n + m, len(cases)))
        for s, springs in enumerate(self._springs(state._replace(standing=True))):
            by_axial_force = csr_array((n, n))
            for rows, force in self.slopes:
                by_axial_force = by_axial_force + rows.T @ (diags_array(force[s]) @ rows)
            scale = unit / np.maximum(unit, abs(springs).max(axis=1).toarray().ravel())
            scale[self.rigid] = 0.0
            laws = diags_array(scale) @ springs + diags_array(unit * self.rigid)
            matrix = block_array(
                [
                    [by_axial_force, -unit * self.motions.T, -unit * self.free.T],
                    [laws @ self.motions, diags_array(unit * scale), None],
                    [unit * self.free, None, csr_array((k, k))],
                ]
            )
            right = np.concatenate([loads[s], -laws @ offset, np.zeros((k, len(cases)))])
            solved = _solved(matrix.tocsc(), right, unit, n)
            if solved is None:
                raise Undetermined(s)
            solution[s] = solved[: n + m]
        u, r = solution[:, :n], unit * solution[:, n:]
        return [self._at_rest(u[..., case], r[..., case]) for case in range(len(cases))]

    def _unit(self) -> float:
        """Return the stiffness of all elements in series: a larger one takes digits of soft ones,
        a smaller one those of stiff ones."""
        diagonal = self.stiffness.diagonal()
        return float(1.0 / (1.0 / diagonal[diagonal > 0.0]).sum()) if diagonal.any() else 1.0

    def _load(self, case: LoadCase) -> Array:
        """Return forces on the coordinates (states or 1, n)."""
        mesh, (xi, weight) = self.mesh, points(GAUSS)
        at_nodes = np.asarray(case.point.reshape(len(case.point), -1) @ self.at_nodes)
        if not case.line.any():
            return at_nodes
        half = mesh.length[:, None] / 2.0
        front, rear = (case.line[:, None, k] for k in (0, 1))
        force = np.zeros((len(half), len(xi), 6))
        force[..., :3] = front + (1.0 + xi[:, None]) / 2.0 * (rear - front)
        force *= (half * weight)[..., None]
        along = self._displaced((mesh.middle[:, None] + half * xi).ravel())
        return np.asarray(at_nodes + force.ravel() @ along)

    def _springs(self, state: State) -> Iterator[Matrix]:
        """Yield the stiffness of all springs over their motions (m, m) at every state."""
        blocks = [link.matrices(state).stiffness for link in self.links]
        for s in range(len(state.speed)):
            laws = [
                (at[None], at[None], block[min(s, len(block) - 1)][None])
                for at, block in zip(self.of_link, blocks, strict=True)
            ]
            yield self.stiffness + summed(self.stiffness.shape, laws, large=True)

    def _at_rest(self, u: Array, r: Array) -> AtRest:
        """Return the shaft with coordinates ``u`` (states, n) and forces ``r`` (states, m)."""
        states, elements = len(u), len(self.mesh.x) - 1
        jump, bar_force = np.zeros((states, elements, 6)), np.zeros((states, elements, 2))
        for (node, name), dof in self.shaft.jump.items() if self.basis is None else ():
            element = self.mesh.node_of(float(self.shaft.mesh.x[node]))
            jump[:, element, position(name)] = self.structure.dofs.sign[dof] * u[:, dof]
        if self.bars and (bar := self.structure.spindle.drawbar):
            of_bar = self.of_link[-len(self.bars) :]
            for ends, at in zip(pairwise(bar.contacts), of_bar, strict=True):
                bar_force[:, slice(*map(self.mesh.node_of, ends))] = -r[:, None, at]
        connections = len(self.structure.connections)
        moved = u @ self.motions[: 6 * connections].T
        return AtRest(
            displacement=(u @ self.at_nodes.T).reshape(states, elements + 1, 6),
            jump=jump,
            push=r[:, : 6 * connections].reshape(states, connections, 6),
            strained=moved.reshape(states, connections, 6),
            bar_force=bar_force,
        )


def _by_state(link: Link) -> Springs:
    """Return the motions of a link; its stiffness follows the state."""
    k = len(link.motions)
    return Springs(link.dofs[None], link.motions[None], np.zeros((1, k, k)))


def _other_springs(structure: Structure) -> Iterator[Springs]:
    """Yield springs of joints, sleeves and housings."""
    terms = [housing.parts() for housing in structure.housings]
    terms += [joint_parts(structure.shafts[SPINDLE]), structure.sleeves.parts(structure.spindle)]
    for part in (part for term in terms for part in term):
        if part.matrix == "stiffness":
            motions = np.broadcast_to(np.eye(part.rows.shape[1]), part.blocks.shape)
            yield Springs(part.rows, motions, part.blocks)


def _rigid_motions(structure: Structure) -> Matrix:
    """Return the motions of a rigid shaft, and of other bodies, by coordinates (DOF, n)."""
    parts, n = [], 0
    for c in structure.components:
        parts.append((c.dofs, n + np.arange(c.size), c.vectors))
        n += c.size
    return summed((structure.dofs.count, n), parts, large=True)


def _solved(matrix: Matrix, right: Array, unit: float, n: int) -> Array | None:
    """Return the solution, of n displacements and then forces over ``unit``; None where rounding
    errors dominate it.

    These are the changes by a right-hand side whose rows change either way, by as much as their
    terms round and by what remains of them.
    """
    from scipy.sparse.linalg import splu

    try:
        factors = splu(matrix)
    except RuntimeError:
        return None
    solution = factors.solve(right)
    for _ in range(REFINED):
        solution += factors.solve(right - matrix @ solution)
    terms = abs(matrix) @ np.abs(solution) + np.abs(right)
    either_way = np.where(np.random.default_rng(1).random(len(right)) < 0.5, -1.0, 1.0)
    rounded = ROUNDING * terms + np.abs(right - matrix @ solution)
    error = np.abs(factors.solve(either_way[:, None] * rounded))
    least = np.abs(right).max(axis=0) / unit
    for part in (slice(n), slice(n, None)):
        largest = np.maximum(np.abs(solution[part]).max(axis=0, initial=0.0), least)
        if not (error[part].max(axis=0, initial=0.0) <= LOST * largest).all():
            return None
    return np.asarray(solution)
