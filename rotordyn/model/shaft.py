"""The shaft of a rotor: elements of any degree in bending, axial motion and torsion.

Nodes stand at every station and between them so that no wave up to the highest frequency errs by
more than the accuracy allows (``degrees``). A joint has two nodes, that of the part in front and
that of the part behind, which share the DOF in which it is rigid.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.model.dofs import Dofs, Indices, Line, position
from rotordyn.model.elements import beam as bending
from rotordyn.model.elements import rod
from rotordyn.model.elements.shear import shear_coefficient
from rotordyn.model.elements.standard_beam import PlaneBending, shear_parameter
from rotordyn.model.fineness import Fineness, bending_wave, parts_and_degree, resolved, rod_wave
from rotordyn.model.mesh import COINCIDENT, Mesh, divided, station_mesh
from rotordyn.model.term import Array, Part

Rows = tuple[Indices, Indices, Array]  # places (e, r), DOF (e, k) and factors (e, r, k)
MOST_DOF = 200_000  # of a bending plane
WAYS = {"radial": ("y", "z"), "tilt": ("thy", "thz"), "axial": ("x",), "torsion": ("thx",)}
PLANES = {"y": (("y", "thz"), np.array([1.0, 1.0])), "z": (("z", "thy"), np.array([1.0, -1.0]))}


@dataclass(frozen=True, eq=False)
class Shaft:
    """Elements between the nodes of ``mesh``, of a rotor called ``body``.

    ``node`` (nodes, 6): DOF of the nodes, of a joint those in front; ``behind`` (nodes, 6): those
    of the part behind it, elsewhere the same. ``degree`` (elements,) in bending, ``rod_degree``
    axially and in torsion; ``inner``: by line of the rotor the first inner DOF of each element.
    """

    body: str
    ratio: float
    spindle: Spindle
    mesh: Mesh
    node: Indices
    behind: Indices
    degree: Indices
    rod_degree: Indices
    inner: dict[str, Indices]

    @classmethod
    def of(
        cls, dofs: Dofs, spindle: Spindle, body: str, ratio: float, fine: Fineness, shown: Mesh
    ) -> Shaft:
        """A rotor as fine as an accuracy asks; without one standard elements between the nodes of
        the mesh ``shown``.

        Raises
        ------
        InvalidInput : more DOF than ``MOST_DOF``
        """
        mesh, degree, rod_degree = _elements(spindle, shown, fine)
        node = dofs.add_nodes(body, mesh.nodes)
        behind = node.copy()
        for joint in spindle.joints:
            at = mesh.node_of(joint.x)
            for way, directions in WAYS.items():
                if math.isfinite(getattr(joint, way)):
                    for name in directions:
                        line = Line(body, {"thz": "y", "thy": "z"}.get(name, name))
                        behind[at, position(name)] = dofs.add(
                            line, sign=-1.0 if name == "thy" else 1.0
                        )[0]
        counts = {
            "y": np.where(degree < 2, 0, 2 * degree - 1),
            "x": rod_degree - 1,
        }
        counts["z"], counts["thx"] = counts["y"], counts["x"]
        inner = {}
        for way, own in counts.items():
            first = dofs.add(Line(body, way), int(own.sum()))
            begin = int(first[0]) if len(first) else 0
            inner[way] = begin + np.concatenate([[0], np.cumsum(own)[:-1]]).astype(np.intp)
        return cls(body, ratio, spindle, mesh, node, behind, degree, rod_degree, inner)

    @property
    def sections(self) -> tuple[Array, Array, Array, Array]:
        """κGA [N], EI [N·m²], ρA [kg/m], ρI [kg·m] of every element."""
        return sections(self.spindle, self.mesh)

    def parts(self) -> Iterator[Part]:
        """Mass, stiffness, gyroscopic effect and translational mass (softening)."""
        yield from self._bending_parts()
        yield from self._rod_parts()

    def _bending_parts(self) -> Iterator[Part]:
        mesh, kappa = self.mesh, shear_coefficients(self.spindle, self.mesh)
        every = (
            mesh.length,
            mesh.outer_diameter,
            mesh.inner_diameter,
            mesh.young_modulus,
            mesh.shear_modulus,
            mesh.density,
            kappa,
        )
        for n, tapered in _kinds(self.degree, mesh):
            chosen = np.flatnonzero((self.degree == n) & (mesh.tapered == tapered))
            if tapered:
                own = self._tapered(chosen, n)
            else:
                own = bending.hierarchic_bending(*(each[chosen] for each in every), degree=n)
            y, z = self.rows("y", chosen), self.rows("z", chosen)
            for rows in (y, z):
                yield Part("mass", rows, rows, own.mass)
                yield Part("stiffness", rows, rows, own.stiffness)
                yield Part("softening", rows, rows, own.translational_mass)
            yield Part("gyroscopic", y, z, self.ratio * own.polar)

    def _tapered(self, chosen: Indices, degree: int) -> PlaneBending:
        """Bending elements that are frusta."""
        shear, bend, *_ = (each[chosen] for each in self.sections)
        phi = shear_parameter(self.mesh.length[chosen], bend, shear)

        def along(xi: Array) -> tuple[Array, ...]:
            own = _local(self.mesh, chosen, xi)
            return sections(self.spindle, own)

        return bending.tapered_bending(self.mesh.length[chosen], phi, along, degree=degree)

    def _rod_parts(self) -> Iterator[Part]:
        mesh = self.mesh
        for way, properties in (("x", axial), ("thx", torsion)):
            rigidity, inertia = properties(mesh)
            for n, tapered in _kinds(self.rod_degree, mesh):
                chosen = np.flatnonzero((self.rod_degree == n) & (mesh.tapered == tapered))
                length = mesh.length[chosen]
                if tapered:
                    own = rod.tapered_rod(
                        length,
                        partial(_along, properties, mesh, chosen),
                        degree=n,
                    )
                else:
                    own = rod.hierarchic_rod(length, rigidity[chosen], inertia[chosen], degree=n)
                rows = self.rows(way, chosen)
                yield Part("mass", rows, rows, own.mass)
                yield Part("stiffness", rows, rows, own.stiffness)

    def rows(self, way: str, elements: Indices) -> Indices:
        """DOF (e, k) of elements of one degree, those of the ends first."""
        names = PLANES[way][0] if way in PLANES else (way,)
        places = [position(name) for name in names]
        degree = int((self.degree if way in PLANES else self.rod_degree)[elements[0]])
        count = bending.inner_freedoms(degree) if way in PLANES else rod.inner_freedoms(degree)
        inner = self.inner[way][elements][:, None] + np.arange(count)
        ends = self.behind[elements][:, places], self.node[elements + 1][:, places]
        return np.concatenate([*ends, inner], axis=1)

    def rigid(self, way: str) -> Iterator[tuple[Indices, Array]]:
        """Rigid motions of the DOF of a line: DOF and their displacements, signed."""
        x = self.mesh.x - self.mesh.x.mean()
        for nodes in (self.node, self.behind):
            if way not in PLANES:
                yield nodes[:, position(way)], np.ones((len(x), 1))
            else:
                deflection, tilt = (nodes[:, position(name)] for name in PLANES[way][0])
                yield deflection, np.stack([np.ones_like(x), x], axis=1)
                yield tilt, np.stack([np.zeros_like(x), np.ones_like(x)], axis=1)

    def bent(self, way: str, x: Array) -> list[Rows]:
        """Of a bending plane deflection and tilt at stations ``x``, two rows a station; at a joint
        those of the part in front."""
        found = []
        for at, rows, shape in self._shapes(way, x):
            both = np.stack([shape.deflection[:, 0], shape.rotation[:, 0]], axis=1)
            found.append((2 * at[:, None] + np.arange(2), rows, both))
        return found

    def sloped(self, way: str, x: Array, weight: Array) -> list[Rows]:
        """The slopes v′ there times ``weight`` (stations,), a row a station."""
        return [
            (at[:, None], rows, shape.slope * weight[at, None, None])
            for at, rows, shape in self._shapes(way, x)
        ]

    def _shapes(self, way: str, x: Array) -> Iterator[tuple[Indices, Indices, bending.Shapes]]:
        """Of stations in elements of one degree: which, DOF of their elements, shape functions."""
        element, xi = self._place(x)
        shear, bend, *_ = self.sections
        phi = shear_parameter(self.mesh.length, bend, shear)
        degree = self.degree[element]
        for n in np.unique(degree):
            at = np.flatnonzero(degree == n)
            own = element[at]
            shape = bending.shapes(self.mesh.length[own], phi[own], int(n), xi[at, None])
            yield at, self.rows(way, own), shape

    def moved(self, way: str, x: Array) -> list[Rows]:
        """Axial displacement or twist at stations ``x``, a row a station."""
        element, xi = self._place(x)
        degree, found = self.rod_degree[element], []
        for n in np.unique(degree):
            at = np.flatnonzero(degree == n)
            shape = rod.shapes(int(n), xi[at, None])
            found.append((at[:, None], self.rows(way, element[at]), shape))
        return found

    def _place(self, x: Array) -> tuple[Indices, Array]:
        """Element and ξ on [−1, 1] of stations ``x`` [m]; at a node of the element in front."""
        nodes, slack = self.mesh.x, COINCIDENT * float(self.mesh.x[-1] - self.mesh.x[0])
        element = np.clip(np.searchsorted(nodes, x - slack) - 1, 0, len(self.degree) - 1)
        xi = 2.0 * (x - nodes[element]) / self.mesh.length[element] - 1.0
        return element, np.clip(xi, -1.0, 1.0)


def _kinds(degree: Indices, mesh: Mesh) -> list[tuple[int, bool]]:
    """Degrees of the elements of a mesh, and whether elements of each are frusta."""
    return sorted({(int(n), bool(t)) for n, t in zip(degree, mesh.tapered, strict=True)})


def _along(
    properties: Callable[[Mesh], tuple[Array, Array]], mesh: Mesh, chosen: Indices, xi: Array
) -> tuple[Array, Array]:
    """Properties at ``xi`` of some elements (elements, points)."""
    return properties(_local(mesh, chosen, xi))


def _local(mesh: Mesh, chosen: Indices, xi: Array) -> Mesh:
    """Diameters and material at ``xi`` of some elements: arrays (elements, points)."""
    outer, inner = (each[chosen] for each in mesh.diameters(xi))
    young, poisson, density = (
        each[chosen, None] for each in (mesh.young_modulus, mesh.poisson_ratio, mesh.density)
    )
    return replace(
        mesh,
        outer_diameter=outer,
        inner_diameter=inner,
        young_modulus=young,
        poisson_ratio=poisson,
        density=density,
    )


def sections(spindle: Spindle, mesh: Mesh) -> tuple[Array, Array, Array, Array]:
    """κGA [N], EI [N·m²], ρA [kg/m], ρI [kg·m] of every element of a mesh."""
    ring = area(mesh.outer_diameter, mesh.inner_diameter)
    moment = second_moment(mesh.outer_diameter, mesh.inner_diameter)
    return (
        shear_coefficients(spindle, mesh) * mesh.shear_modulus * ring,
        mesh.young_modulus * moment,
        mesh.density * ring,
        mesh.density * moment,
    )


def axial(mesh: Mesh) -> tuple[Array, Array]:
    """E A [N] and ρ A [kg/m] of every element."""
    ring = area(mesh.outer_diameter, mesh.inner_diameter)
    return mesh.young_modulus * ring, mesh.density * ring


def torsion(mesh: Mesh) -> tuple[Array, Array]:
    """G Ip [N·m²] and ρ Ip [kg·m] of every element."""
    polar = 2.0 * second_moment(mesh.outer_diameter, mesh.inner_diameter)
    return mesh.shear_modulus * polar, mesh.density * polar


def shear_coefficients(spindle: Spindle, mesh: Mesh) -> Array:
    """κ of every element (elements,)."""
    ratio = mesh.inner_diameter / mesh.outer_diameter
    return shear_coefficient(spindle.shaft.shear_coefficient, mesh.poisson_ratio, ratio)


def _elements(spindle: Spindle, shown: Mesh, fine: Fineness) -> tuple[Mesh, Indices, Indices]:
    """Nodes, degrees in bending and of rods."""
    if fine.accuracy is None:
        mesh = divided(shown, np.full(shown.nodes - 1, 2**fine.finer, dtype=np.intp))
        return mesh, *np.ones((2, mesh.nodes - 1), dtype=np.intp)
    coarse = station_mesh(spindle)
    wave = bending_wave(fine.band, fine.spin, *sections(spindle, coarse))
    parts, degree = parts_and_degree(wave * coarse.length, fine.accuracy)
    along = np.maximum(*(rod_wave(fine.band, *own(coarse)) for own in (axial, torsion)))
    more, rod_degree = parts_and_degree(along * coarse.length / parts, fine.accuracy)
    parts, degree, rod_degree = parts * more, degree + fine.finer, rod_degree + fine.finer
    size = float((np.where(degree < 2, 0, 2 * degree - 1) + 2) @ parts)
    if size > MOST_DOF:
        raise InvalidInput(
            f"bending up to {fine.frequency:.6g} Hz takes {size:.3g} degrees of freedom; allowed: "
            f"up to {MOST_DOF}; ask for lower frequencies or speeds, less accuracy, or join "
            "sections that are alike"
        )
    return divided(coarse, parts), np.repeat(degree, parts), np.repeat(rod_degree, parts)


def half_wave(spindle: Spindle, mesh: Mesh, spin: float) -> float:
    """Highest whirl [rad/s] that crosses no element of ``mesh`` by more than half a wave."""
    own = sections(spindle, mesh)

    def phase(omega: float) -> float:
        return float((bending_wave(omega, spin, *own) * mesh.length).max())

    return resolved(phase, math.pi, 1.0)
