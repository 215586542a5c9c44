"""The shaft at rest, K u = f of all terms, with the forces r of all springs among the unknowns:

    G u − Mᵀ r = f,    r + S (M u + e) = 0,    or M u + e = 0 where rigid

Springs are the links, the elements of the shaft, of which M u is the motion of the rear end with
the front end held, and what holds other bodies; S is their stiffness, e an offset between both
sides of a link, G the stiffness by the axial force: K = G + Mᵀ S M. So neither stiff nor short
springs take digits of others, and forces that equilibrium alone determines are exact to rounding.
Nodes of cylinders move as their exact solution; elements of cones are as fine as ``ACCURACY``
requires, those under an axial force ``BENT`` degrees higher.

Theory: docs/theory/statics.md#equilibrium.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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
from rotordyn.equation.shaft import NAMES, PLANES, Rows
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
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


class Acting(NamedTuple):
    """Loads: on nodes ``point`` (states or 1, nodes, 6) [N, N·m], along elements ``line``
    (elements, 2, 3) [N/m], at both ends and linear in between; ``offset`` (connections, 6) of
    connections from the shaft [m, rad], as of an eccentric ring: each reacts to the sum of
    displacement and offset."""

    point: Array
    line: Array
    offset: Array | None = None


@dataclass(frozen=True, eq=False, slots=True)
class AtRest:
    """``moved`` (states, nodes, 6): displacements of the shaft [m, rad], at a joint those of the
    part in front; ``apart`` (states, elements, 6): additional displacement of the front end of an
    element behind a joint; ``push`` (states, connections, 6): loads of connections on the shaft
    [N, N·m]; ``strained`` (states, connections, 6): displacement of the shaft there against what
    carries it; ``pulled`` (states, elements, 2): force along y and z of a drawbar inside the shaft.
    """

    moved: Array
    apart: Array
    push: Array
    strained: Array
    pulled: Array


class Springs(NamedTuple):
    """Springs over ``motions`` (e, d, k) of ``dofs`` (e, k), of ``stiffness`` (e, d, d)."""

    dofs: Indices
    motions: Array
    stiffness: Array


class StaticEquation:
    """The equation of a spindle's shaft with nodes of a ``mesh``, on its connections.

    ``front`` (k, 6): combinations of the displacements of the front end that are zero, those that
    nothing holds. ``rigid``: the shaft does not deform; ``bent``: the axial force acts on bending,
    and so does the tension of a drawbar.
    """

    def __init__(
        self, spindle: Spindle, mesh: Mesh, front: Array, *, rigid: bool, bent: bool
    ) -> None:
        fine = Fineness(0.0, accuracy=ACCURACY, finer=BENT if bent else 0)
        structure = Structure(spindle, mesh, fine, rigid=rigid)
        self.structure, self.mesh, self.shaft = structure, mesh, structure.shafts[SPINDLE]
        self.basis = _rigid_motions(structure) if rigid else None
        self.bars = structure.drawbar if bent else []
        self.links = [*structure.connections, *structure.sleeve_springs, *self.bars]
        moving = [(link.dofs[None], link.motions[None]) for link in self.links]
        springs = [] if rigid else [each for way in NAMES for each in self._elements(way)]
        springs += _holding(structure)
        moving += [each[:2] for each in springs]
        numbers, end = [], 0  # of the motions of each
        for dofs, motions in moving:
            start, end = end, end + len(dofs) * motions.shape[1]
            numbers.append(np.arange(start, end).reshape(len(dofs), -1))
        self.at = [at[0] for at in numbers[: len(self.links)]]
        of_springs = zip(numbers[len(self.links) :], springs, strict=True)
        laws = [(at, at, each.stiffness) for at, each in of_springs]
        self.stiffness = summed((end, end), laws, large=True)
        rows = [(at, *each) for at, each in zip(numbers, moving, strict=True)]
        self.motions = self._by_coordinates(end, rows)
        self.rigid = np.zeros(end, dtype=bool)
        for at, link in zip(self.at, self.links, strict=True):
            self.rigid[at[list(link.rigid)]] = True
        self.shown = self._displaced(mesh.x)
        self.front = front @ self.shown[:6]

    def _elements(self, way: str) -> Iterator[Springs]:
        return (Springs(*each) for each in self.shaft.springs(way))

    def _by_coordinates(self, count: int, rows: Sequence[Rows]) -> Matrix:
        by_dofs = summed((count, self.structure.dofs.count), rows, large=True)
        return by_dofs if self.basis is None else by_dofs @ self.basis

    def _displaced(self, x: Array) -> Matrix:
        """Return displacements of stations ``x`` by the coordinates (6 stations, n)."""
        rows = [row for way in NAMES for row in self.shaft.displaced(way, x)]
        return self._by_coordinates(6 * len(x), rows)

    def solve(self, state: State, axial: Array | None, acting: Sequence[Acting]) -> list[AtRest]:
        """Return the shaft under each of the loads ``acting`` at every state; ``axial`` (states,
        elements) [N]: force on bending, tension positive.

        Raises
        ------
        Undetermined : there is no solution at a state, or none beyond rounding
        """
        from scipy.sparse import block_array, csr_array, diags_array

        (m, n), held, states = self.motions.shape, len(self.front), len(state.speed)
        loads = np.stack([np.broadcast_to(self._load(a), (states, n)) for a in acting], axis=-1)
        offset = np.zeros((m, len(acting)))
        for k, each in enumerate(acting):
            if each.offset is not None:
                offset[: each.offset.size, k] = each.offset.ravel()
        unit = self._unit()  # forces over it are of the size of displacements
        slopes = self._slopes() if axial is not None else []
        solution = np.zeros((states, n + m, len(acting)))
        for s, springs in enumerate(self._springs(state._replace(standing=True))):
            of_force = csr_array((n, n))
            for rows, element in slopes:
                assert axial is not None
                of_force = of_force + rows.T @ (diags_array(axial[s, element]) @ rows)
            scale = unit / np.maximum(unit, abs(springs).max(axis=1).toarray().ravel())
            laws = diags_array(np.where(self.rigid, unit, 0.0))
            laws = laws + diags_array(np.where(self.rigid, 0.0, scale)) @ springs
            inverse = np.where(self.rigid, 0.0, unit * scale)
            matrix = block_array(
                [
                    [of_force, -unit * self.motions.T, -unit * self.front.T],
                    [laws @ self.motions, diags_array(inverse), None],
                    [unit * self.front, None, csr_array((held, held))],
                ]
            )
            right = np.concatenate([loads[s], -laws @ offset, np.zeros((held, len(acting)))])
            solved = _solved(matrix.tocsc(), right, unit, n)
            if solved is None:
                raise Undetermined(s)
            solution[s] = solved[: n + m]
        moved, force = solution[:, :n], unit * solution[:, n:]
        return [self._at_rest(moved[..., k], force[..., k]) for k in range(len(acting))]

    def _unit(self) -> float:
        """Return the stiffness of all elements in series: a larger one takes digits of soft ones,
        a smaller one those of stiff ones."""
        diagonal = self.stiffness.diagonal()
        return float(1.0 / (1.0 / diagonal[diagonal > 0.0]).sum()) if diagonal.any() else 1.0

    def _load(self, acting: Acting) -> Array:
        """Return forces on the coordinates (states or 1, n)."""
        mesh, (xi, weight) = self.mesh, points(GAUSS)
        nodes = acting.point.reshape(len(acting.point), -1) @ self.shown
        if not acting.line.any():
            return np.asarray(nodes)
        half = mesh.length[:, None] / 2.0
        front, rear = (acting.line[:, None, k] for k in (0, 1))
        force = np.zeros((len(half), len(xi), 6))
        force[..., :3] = front + (1.0 + xi[:, None]) / 2.0 * (rear - front)
        force *= (half * weight)[..., None]
        along = self._displaced((mesh.middle[:, None] + half * xi).ravel())
        return np.asarray(nodes + force.ravel() @ along)

    def _springs(self, state: State) -> Iterator[Matrix]:
        """Yield the stiffness of all springs over their motions (m, m) at every state."""
        blocks = [link.matrices(state).stiffness for link in self.links]
        for s in range(len(state.speed)):
            laws = [
                (at[None], at[None], block[min(s, len(block) - 1)][None])
                for at, block in zip(self.at, blocks, strict=True)
            ]
            yield self.stiffness + summed(self.stiffness.shape, laws, large=True)

    def _slopes(self) -> list[tuple[Matrix, Indices]]:
        """Return weighted slopes of both planes by the coordinates, and their elements."""
        planes = (slope_rows(self.shaft, self.mesh, way) for way in PLANES)
        return [(self._by_coordinates(len(element), rows), element) for rows, element in planes]

    def _at_rest(self, moved: Array, force: Array) -> AtRest:
        states, x = len(moved), self.mesh.x
        nodes = (moved @ self.shown.T).reshape(states, len(x), 6)
        apart = np.zeros((states, len(x) - 1, 6))
        for (node, name), dof in self.shaft.jump.items() if self.basis is None else ():
            at = self.mesh.node_of(float(self.shaft.mesh.x[node]))
            apart[:, at, position(name)] = self.structure.dofs.sign[dof] * moved[:, dof]
        connections = len(self.structure.connections)
        push = force[:, : 6 * connections].reshape(states, connections, 6)
        strained = (moved @ self.motions[: 6 * connections].T).reshape(states, connections, 6)
        pulled = np.zeros((states, len(x) - 1, 2))
        bar, last = self.structure.spindle.drawbar, self.at[len(self.at) - len(self.bars) :]
        contacts = bar.contacts if bar and self.bars else ()
        for ends, at in zip(pairwise(contacts), last, strict=True):
            low, high = map(self.mesh.node_of, ends)
            pulled[:, low:high] = -force[:, None, at]
        return AtRest(nodes, apart, push, strained, pulled)


def _holding(structure: Structure) -> Iterator[Springs]:
    """Yield springs of joints, sleeves and housings."""
    terms = [housing.parts() for housing in structure.housings]
    terms += [joint_parts(structure.shafts[SPINDLE]), structure.sleeves.parts(structure.spindle)]
    for part in (part for term in terms for part in term):
        if part.matrix == "stiffness":
            motions = np.broadcast_to(np.eye(part.rows.shape[1]), part.blocks.shape)
            yield Springs(part.rows, motions, part.blocks)


def _rigid_motions(structure: Structure) -> Matrix:
    """Return the motions of a rigid shaft, and of other bodies, by coordinates (DOF, n)."""
    parts, end = [], 0
    for c in structure.components:
        start, end = end, end + c.size
        parts.append((c.dofs, np.arange(start, end), c.vectors))
    return summed((structure.dofs.count, end), parts, large=True)


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
    size = abs(matrix)
    for _ in range(REFINED):
        residual = right - matrix @ solution
        terms = size @ np.abs(solution) + np.abs(right)
        solution += factors.solve(residual)
    either_way = np.where(np.random.default_rng(1).random(len(right)) < 0.5, -1.0, 1.0)
    rounded = ROUNDING * terms + np.abs(right - matrix @ solution)
    error = np.abs(factors.solve(either_way[:, None] * rounded))
    least = np.abs(right).max(axis=0) / unit
    for part in (slice(n), slice(n, None)):
        largest = np.maximum(np.abs(solution[part]).max(axis=0, initial=0.0), least)
        if not (error[part].max(axis=0, initial=0.0) <= LOST * largest).all():
            return None
    return np.asarray(solution)
