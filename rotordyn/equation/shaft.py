"""The shaft of a rotor: elements of any degree in bending, axial motion and torsion.

Nodes lie at every station and between them so that no wave up to the highest frequency errs by more
than the accuracy allows (``fineness``). At a flexible joint the element behind it has the node and
one more DOF, the motion of the part behind relative to the part in front: so the spring of a joint
is the stiffness of one DOF, and however stiff, no digits of the shaft are lost.

Theory: docs/theory/shaft.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.dofs import DIRECTIONS, Dofs, position
from rotordyn.equation.elements import beam as bending
from rotordyn.equation.elements import rod
from rotordyn.equation.fineness import (
    Fineness,
    bending_wave,
    cut,
    parts_and_degree,
    resolved,
    rod_wave,
)
from rotordyn.equation.mesh import COINCIDENT, Mesh, divided, station_mesh
from rotordyn.equation.section import ENDS, MIDDLE, axial, sections_at, sheared, torsion
from rotordyn.equation.term import Part
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle

Rows = tuple[Indices, Indices, Array]  # places (e, r), DOF (e, k) and factors (e, r, k)
MOST_DOF = 200_000  # of a bending plane
WAYS = {"radial": ("y", "z"), "tilt": ("thy", "thz"), "axial": ("x",), "torsion": ("thx",)}
NAMES = {"x": ("x",), "thx": ("thx",), "y": ("y", "thz"), "z": ("z", "thy")}  # of each line
PLANES = {"y": (("y", "thz"), np.array([1.0, 1.0])), "z": (("z", "thy"), np.array([1.0, -1.0]))}


class Springs(NamedTuple):
    """Springs over ``motions`` (e, d, k) of ``dofs`` (e, k), of ``stiffness`` (e, d, d)."""

    dofs: Indices
    motions: Array
    stiffness: Array


@dataclass(frozen=True, eq=False)
class Shaft:
    """Elements between the nodes of ``mesh``, of a rotor called ``body``.

    ``node`` (nodes, 6): DOF of the nodes, of a joint those of the part in front; ``jump``: DOF of
    joints by node and direction. ``degree`` (elements,) in bending, ``rod_degree`` of rods;
    ``inner``: first inner DOF of each element by line of the rotor.
    """

    body: str
    ratio: float
    spindle: Spindle
    mesh: Mesh
    node: Indices
    jump: dict[tuple[int, str], int]
    degree: Indices
    rod_degree: Indices
    inner: dict[str, Indices]

    @classmethod
    def of(
        cls, dofs: Dofs, spindle: Spindle, body: str, ratio: float, fine: Fineness, shown: Mesh
    ) -> Shaft:
        """Build a rotor as fine as an accuracy requires; without one, of standard elements between
        the nodes of the mesh ``shown``.

        Raises
        ------
        InvalidInput : more DOF than ``MOST_DOF``
        """
        mesh, degree, rod_degree = _elements(spindle, shown, fine)
        node = dofs.add(body, DIRECTIONS, mesh.nodes)
        jump: dict[tuple[int, str], int] = {}
        for joint in spindle.joints:
            at = mesh.node_of(joint.x)
            for way, directions in WAYS.items():
                if math.isfinite(getattr(joint, way)):
                    for name in directions:
                        jump[at, name] = dofs.add(body, [name]).item()
        shaft = cls(body, ratio, spindle, mesh, node, jump, degree, rod_degree, {})
        for way in ("y", "x", "z", "thx"):
            first, inner = dofs.count, shaft._inner_dofs(way)
            dofs.add(body, [way], int(inner.sum()))
            shaft.inner[way] = first + np.cumsum(inner) - inner
        return shaft

    def _degree(self, way: str) -> Indices:
        """Return the degree along a line (elements,)."""
        return self.degree if way in PLANES else self.rod_degree

    def _inner_dofs(self, way: str) -> Indices:
        """Return the number of inner DOF of each element along a line (elements,)."""
        if way in PLANES:
            return bending.inner_dofs(self.degree, sheared(self.spindle))
        return self.rod_degree - 1

    def parts(self) -> Iterator[Part]:
        """Yield mass, stiffness, gyroscopic effect and translational mass (softening)."""
        yield from self._bending_parts()
        yield from self._rod_parts()

    def _bending_parts(self) -> Iterator[Part]:
        for n in np.unique(self.degree).tolist():
            chosen = np.flatnonzero(self.degree == n)
            matrices = self._bending_matrices(chosen, n)
            (y, moves), (z, _) = self.rows("y", chosen), self.rows("z", chosen)
            matrix_of = {"mass": matrices.mass, "stiffness": matrices.stiffness}
            matrix_of["softening"] = matrices.translational_mass
            for (name, matrix), rows in product(matrix_of.items(), (y, z)):
                yield Part(name, rows, rows, _in_dofs(moves, matrix))
            yield Part("gyroscopic", y, z, self.ratio * _in_dofs(moves, matrices.polar))

    def _bending_matrices(self, chosen: Indices, degree: int) -> bending.PlaneBending:
        sections = sections_at(self.spindle, self.mesh, bending.quadrature(degree)[0])
        properties = (values[chosen] for values in sections)
        shape = self.mesh.length[chosen], self._phi[chosen]
        return bending.beam_matrices(*shape, *properties, degree=degree)

    @cached_property
    def _phi(self) -> Array:
        """Shear parameter Φ of every element, of a cone in its middle (elements,)."""
        shear, bend = (e[:, 0] for e in sections_at(self.spindle, self.mesh, MIDDLE)[:2])
        return bending.shear_parameter(self.mesh.length, bend, shear)

    def _rod_parts(self) -> Iterator[Part]:
        for way in ("x", "thx"):
            for n in np.unique(self.rod_degree).tolist():
                chosen = np.flatnonzero(self.rod_degree == n)
                mass, stiffness = self._rod_matrices(way, chosen, n)
                rows, moves = self.rows(way, chosen)
                yield Part("mass", rows, rows, _in_dofs(moves, mass))
                yield Part("stiffness", rows, rows, _in_dofs(moves, stiffness))

    def _rod_matrices(self, way: str, chosen: Indices, degree: int) -> tuple[Array, Array]:
        section = (axial if way == "x" else torsion)(self.mesh, rod.quadrature(degree)[0])
        properties = (values[chosen] for values in section)
        return rod.rod_matrices(self.mesh.length[chosen], *properties, degree=degree)

    def springs(self, way: str) -> Iterator[Springs]:
        """Yield elements of a line as springs over the motions of the rear end and inner DOF with
        the front end held."""
        for n in np.unique(self._degree(way)).tolist():
            chosen = np.flatnonzero(self._degree(way) == n)
            if way in PLANES:
                stiffness, rigid = self._bending_matrices(chosen, n).stiffness, np.eye(2)
            else:
                stiffness, rigid = self._rod_matrices(way, chosen, n)[1], np.eye(1)
            ends, own = len(rigid), stiffness.shape[1]
            motions = np.tile(np.eye(own)[ends:], (len(chosen), 1, 1))
            motions[:, :ends, :ends] = -rigid
            if way in PLANES:
                motions[:, 0, 1] = -self.mesh.length[chosen]
            rows, moves = self.rows(way, chosen)
            motions = motions if moves is None else motions @ moves
            yield Springs(rows, motions, stiffness[:, ends:, ends:])

    def rows(self, way: str, elements: Indices) -> tuple[Indices, Array | None]:
        """Return DOF (e, k) of elements of one degree, those of the ends first, of joints last; and
        the map to their own motions (e, j, k), None where there is no joint in front of any."""
        names = NAMES[way]
        places = [position(name) for name in names]
        inner = self.inner[way][elements][:, None] + np.arange(self._inner_dofs(way)[elements[0]])
        ends = self.node[elements][:, places], self.node[elements + 1][:, places]
        rows = np.concatenate([*ends, inner], axis=1)
        if not self.jump:
            return rows, None
        jumps = [[self.jump.get((e, name), -1) for name in names] for e in elements.tolist()]
        jump = np.array(jumps, dtype=np.intp)
        flexible, ends_of = jump >= 0, np.arange(len(names))
        if not flexible.any():
            return rows, None
        moves = np.zeros((*rows.shape, rows.shape[1] + len(names)))
        moves[:, :, : rows.shape[1]] = np.eye(rows.shape[1])
        moves[:, ends_of, rows.shape[1] + ends_of] = flexible
        return np.hstack([rows, np.where(flexible, jump, rows[:, :1])]), moves

    def nested(self, coarse: Shaft, way: str) -> tuple[Indices, Indices]:
        """Return DOF of a line, and those with the same shape functions in the same shaft of lower
        degrees, of elements of the same lengths."""
        fine_n, coarse_n, count = self._degree(way), coarse._degree(way), coarse._inner_dofs(way)
        leaning = coarse_n if way in PLANES and sheared(self.spindle) else count  # then come more
        element = np.repeat(np.arange(len(count)), count)
        number = np.arange(len(element)) - np.repeat(np.cumsum(count) - count, count)
        behind = np.where(number >= leaning[element], (fine_n - coarse_n)[element], 0)
        fine, coarser = (
            [self.inner[way][element] + number + behind],
            [coarse.inner[way][element] + number],
        )
        for name in NAMES[way]:
            for shaft, rows in ((self, fine), (coarse, coarser)):
                jumps = [
                    number for (_, direction), number in shaft.jump.items() if direction == name
                ]
                rows += [shaft.node[:, position(name)], np.array(jumps, dtype=np.intp)]
        return np.concatenate(fine), np.concatenate(coarser)

    def rigid(self, way: str) -> Iterator[tuple[Indices, Array]]:
        """Yield rigid motions of the DOF of a line: DOF and their displacements, signed."""
        x = self.mesh.x - self.mesh.x.mean()
        if way not in PLANES:
            yield self.node[:, position(way)], np.ones((len(x), 1))
        else:
            deflection, tilt = (self.node[:, position(name)] for name in PLANES[way][0])
            yield deflection, np.stack([np.ones_like(x), x], axis=1)
            yield tilt, np.stack([np.zeros_like(x), np.ones_like(x)], axis=1)

    def displaced(self, way: str, x: Array) -> list[Rows]:
        """Return displacements of stations ``x`` in the six directions by the DOF of a line, row
        6 k + direction of station k; at a joint those of the part in front."""
        if way not in PLANES:
            moved = self._rows_at(way, x, lambda _, *of: rod.shapes(*of))
            return [(6 * places + position(way), dofs, rows) for places, dofs, rows in moved]

        def both(*of: Any) -> Array:
            shape, (_, signs) = self._bending_shapes(*of), PLANES[way]
            return np.concatenate([shape.deflection, signs[1] * shape.rotation], axis=1)

        deflection, tilt = map(position, NAMES[way])
        return [
            (6 * (places // 2) + np.where(places % 2, tilt, deflection), dofs, rows)
            for places, dofs, rows in self._rows_at(way, x, both)
        ]

    def sloped(self, way: str, x: Array) -> list[Rows]:
        """Return the slopes v′ there, a row a station."""
        return self._rows_at(way, x, lambda *of: self._bending_shapes(*of).slope)

    def _bending_shapes(self, elements: Indices, degree: int, xi: Array) -> bending.Shapes:
        return bending.shapes(self.mesh.length[elements], self._phi[elements], degree, xi)

    def _rows_at(self, way: str, x: Array, shapes: Callable[..., Array]) -> list[Rows]:
        """Return rows of stations ``x``; ``shapes``: (e, r, k) of elements of one degree, by their
        numbers, that degree, and ξ (e, 1)."""
        element, xi = self._place(x)
        degree, parts = self._degree(way)[element], []
        for n in np.unique(degree).tolist():
            at = np.flatnonzero(degree == n)
            rows, moves = self.rows(way, element[at])
            shape = shapes(element[at], n, xi[at, None])
            places = shape.shape[1] * at[:, None] + np.arange(shape.shape[1])
            parts.append((places, rows, shape if moves is None else shape @ moves))
        return parts

    def _place(self, x: Array) -> tuple[Indices, Array]:
        """Return element and ξ on [−1, 1] of stations ``x`` [m]; at nodes the element in front."""
        nodes, slack = self.mesh.x, COINCIDENT * float(self.mesh.x[-1] - self.mesh.x[0])
        element = np.clip(np.searchsorted(nodes, x - slack) - 1, 0, len(self.degree) - 1)
        xi = 2.0 * (x - nodes[element]) / self.mesh.length[element] - 1.0
        return element, np.clip(xi, -1.0, 1.0)


def _in_dofs(moves: Array | None, blocks: Array) -> Array:
    """Return blocks (e, k, k) of matrices (e, j, j) of elements by their DOF."""
    return blocks if moves is None else np.asarray(np.swapaxes(moves, 1, 2) @ blocks @ moves)


def _elements(spindle: Spindle, shown: Mesh, fine: Fineness) -> tuple[Mesh, Indices, Indices]:
    """Return nodes, degrees in bending and of rods."""
    if fine.accuracy is None:
        mesh = divided(shown, np.full(shown.nodes - 1, 2**fine.finer, dtype=np.intp))
        return mesh, *np.ones((2, mesh.nodes - 1), dtype=np.intp)
    coarse = shown if fine.static else station_mesh(spindle)
    ratio = coarse.steepness
    wave = bending_wave(fine.band, fine.spin, *sections_at(spindle, coarse, ENDS)).max(axis=1)
    parts, degree = parts_and_degree(wave * coarse.length, fine.accuracy, ratio)
    wave_number = np.maximum(
        *(rod_wave(fine.band, *wave_of(coarse, MIDDLE))[:, 0] for wave_of in (axial, torsion))
    )
    cuts, rod_degree = parts_and_degree(
        wave_number * coarse.length / parts, fine.accuracy, cut(ratio, parts)
    )
    if not sheared(spindle):
        degree = np.maximum(degree, 2)  # degrees 1 and 2 are one element without shear
    parts, degree, rod_degree = parts * cuts, degree + fine.finer, rod_degree + fine.finer
    size = float((bending.inner_dofs(degree, sheared(spindle)) + 2) @ parts)
    if size > MOST_DOF:
        raise InvalidInput(
            f"bending up to {fine.frequency:.6g} Hz takes {size:.3g} degrees of freedom; allowed: "
            f"up to {MOST_DOF}; take lower frequencies or speeds, less accuracy, or join sections "
            "that are alike"
        )
    return divided(coarse, parts), np.repeat(degree, parts), np.repeat(rod_degree, parts)


def half_wave(spindle: Spindle, mesh: Mesh, spin: float) -> float:
    """Return the highest whirl [rad/s] that crosses no element by more than half a wave."""
    sections, length = sections_at(spindle, mesh, ENDS), mesh.length[:, None]

    def phase(omega: float) -> float:
        return float((bending_wave(omega, spin, *sections) * length).max())

    return resolved(phase, math.pi, 1.0)
