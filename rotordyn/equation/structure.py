"""A machine without its states: DOF, parts and links of all terms, and its components.

Components are motions that nothing but links joins.

Theory: docs/theory/rotor.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from copy import copy
from dataclasses import replace
from functools import cached_property

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.axial_force import Slopes, slope_rows, weighted
from rotordyn.equation.component import Coarse, Component, Solved
from rotordyn.equation.dofs import DIRECTIONS, Dofs, Line, position
from rotordyn.equation.drawbar import drawbar_links
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.housing import Foundation
from rotordyn.equation.joint import joint_parts
from rotordyn.equation.lumped import lumped_parts
from rotordyn.equation.mesh import Mesh
from rotordyn.equation.seat import seat_law
from rotordyn.equation.shaft import Rows, Shaft
from rotordyn.equation.sleeve import Sleeves, springs
from rotordyn.equation.squeeze_film import film_law
from rotordyn.equation.support import support_law
from rotordyn.equation.term import Link, LinkLaw, Part
from rotordyn.machine.joint import WAYS
from rotordyn.machine.plausibility import SOFT
from rotordyn.machine.rotor import Place
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.machine.support import GROUND, SPINDLE, LinearSupport
from rotordyn.numerics.groups import first_joined, join
from rotordyn.numerics.sparse import summed

PAIRED = {"y": "z", "z": "y", "thy": "thz", "thz": "thy"}  # planes keep the same static modes
LAWS: dict[type, Callable[..., LinkLaw]] = {
    LinearSupport: support_law,
    SqueezeFilmDamper: film_law,
}
JOINING = ("mass", "stiffness", "damping")  # matrices that make DOF one component


class Structure:
    """All terms of a ``spindle``.

    ``shown``: nodes at which motion is displayed; ``fine``: fineness of elements and reduction;
    ``ports``: further places at which forces act or motion is read; ``rigid``: shafts do not bend;
    ``pressed``: an axial force is given that may approach buckling; ``softened``: the
    parts of S are kept, which take much memory; ``coarse``: structure of lower degrees, or None.

    Raises
    ------
    InvalidInput : as ``Shaft.of`` and ``Foundation``
    """

    def __init__(
        self,
        spindle: Spindle,
        shown: Mesh,
        fine: Fineness,
        ports: Iterable[Place] = (),
        *,
        rigid: bool = False,
        pressed: bool = False,
        softened: bool = False,
        coarse: Structure | None = None,
    ) -> None:
        self.spindle, self.shown, self.fine, self.rigid = spindle, shown, fine, rigid
        self.pressed, self.coarse = pressed, coarse
        self.dofs = Dofs()
        self.shafts = {
            name: Shaft.of(
                self.dofs,
                spindle.part(name),
                name,
                ratio,
                replace(fine, spin=abs(ratio) * fine.spin),
                shown.of_rotors[name],
            )
            for name, ratio in spindle.ratios.items()
        }
        self.sleeves = Sleeves(self.dofs, spindle, fine)
        self.housings = [Foundation(self.dofs, spindle, housing) for housing in spindle.housings]
        terms = [housing.parts() for housing in self.housings]
        for shaft in self.shafts.values():
            terms += [shaft.parts(), lumped_parts(shaft), joint_parts(shaft)]
        self._sleeve_parts = list(self.sleeves.parts(spindle))
        rest = (p for term in terms for p in term if softened or p.matrix != "softening")
        self.parts: list[Part] = [*self._sleeve_parts, *rest]
        self.laws = [seat_law(seat, k) for k, seat in enumerate(spindle.seats)]
        further = spindle.connections[len(spindle.seats) :]
        self.laws += [LAWS[type(each)](each) for each in further]
        self.connections = list(map(self._link, spindle.connections, self.laws))
        self.sleeve_springs = list(self.sleeves.links(spindle))
        self.drawbar = list(drawbar_links(self.shafts[SPINDLE]))
        self._ports = self._port_dofs(ports)
        self._gyroscopic: dict[tuple[int, int], Array] = {}
        self._slopes: dict[int, Slopes] = {}

    def on_springs_of(self, spindle: Spindle) -> Structure:
        """Return the structure with the sleeve springs of a ``spindle`` that differs in these
        alone; shafts and housings, and what is solved of them, are shared."""
        if [springs(sleeve) for sleeve in spindle.sleeves] == [
            springs(sleeve) for sleeve in self.spindle.sleeves
        ]:
            return self
        other = copy(self)
        other.spindle = spindle
        other._sleeve_parts = list(self.sleeves.parts(spindle))
        other.parts = [*other._sleeve_parts, *self.parts[len(self._sleeve_parts) :]]
        other.sleeve_springs = list(self.sleeves.links(spindle))
        sleeve_dofs = [*self.sleeves.dofs.values()]
        other.components = [
            replace(c, parts=[p for p in other._sleeve_parts if np.isin(p.rows, c.dofs).all()])
            if np.isin(c.dofs, sleeve_dofs).all()
            else c
            for c in self.components
        ]
        return other

    @property
    def seats(self) -> list[Link]:
        """Links of the bearings, the first of all ``connections``."""
        return self.connections[: len(self.spindle.seats)]

    def node(self, rotor: str, x: float) -> Indices:
        """Return the DOF (6,) of the node of a rotor at station ``x`` [m]."""
        shaft = self.shafts[rotor]
        return np.asarray(shaft.node[shaft.mesh.node_of(x)])

    def _link(self, part: BearingSeat | LinearSupport | SqueezeFilmDamper, law: LinkLaw) -> Link:
        """Return motion (6, DOF) relative to what carries a bearing, support or damper."""
        sides = zip(law.ends, (1.0, -1.0), strict=True)
        nodes = [(self.node(end, part.x), side) for end, side in sides if end != GROUND]
        dofs = [node for node, _ in nodes]
        motions = [side * np.diag(self.dofs.sign[node]) for node, side in nodes]
        for housing in self.housings:
            if part.name in housing.under:
                dofs.append(housing.dofs)
                motions.append(-housing.under[part.name])
        if isinstance(part, BearingSeat):
            for direction, number in self.sleeves.under(self.spindle, part.name).items():
                dofs.append(np.array([number]))
                motions.append(-np.eye(6)[:, [position(direction)]])
        ends = np.concatenate(dofs), np.hstack(motions)
        return Link(part.name, *ends, law.matrices, law.loss_factor, law.rigid)

    def _port_dofs(self, places: Iterable[Place]) -> Indices:
        """Return the DOF of shafts at which links, heavy discs, dampers of joints and users act."""
        ports: set[tuple[str, int, str]] = set()
        for rotor, x, names in [*self._loaded(), *((*place, DIRECTIONS) for place in places)]:
            node = self.shafts[rotor].mesh.node_of(x)
            ports |= {(rotor, node, n) for name in names for n in (name, PAIRED.get(name, name))}
        dofs = {int(self.shafts[r].node[node, position(name)]) for r, node, name in ports}
        for shaft in self.shafts.values():
            for joint in shaft.spindle.joints:
                if any(getattr(joint, f"{kind}_damping") for kind in WAYS):
                    joint_node = shaft.mesh.node_of(joint.x)
                    dofs |= {
                        number for (node, _), number in shaft.jump.items() if node == joint_node
                    }
        return np.array(sorted(dofs), dtype=np.intp)

    def _loaded(self) -> Iterator[tuple[str, float, Iterable[str]]]:
        """Yield rotor, station and directions in which the terms act on shafts."""
        for part, law in zip(self.spindle.connections, self.laws, strict=True):
            yield from ((end, part.x, law.acts) for end in law.ends if end != GROUND)
        for x in self.spindle.drawbar.stations if self.spindle.drawbar else ():
            yield SPINDLE, x, PAIRED
        for rotor, shaft in self.shafts.items():
            for body in shaft.spindle.lumped:
                if body.polar_inertia:
                    yield rotor, body.x, ("thy", "thz")
            for joint in shaft.spindle.joints:
                if joint.radial_damping or joint.tilt_damping:
                    yield rotor, joint.x, PAIRED

    @cached_property
    def components(self) -> list[Component]:
        """Lines joined by constant matrices, in the order of their first one."""
        lines, of_dof = self.dofs.lines, self.dofs.line
        joining = np.zeros((len(lines), len(lines)), dtype=bool)
        square = [part for part in self.parts if part.matrix != "gyroscopic" and part.rows.size]
        for part in square:
            joined = of_dof[part.rows[0]]
            if part.matrix in JOINING and (joined != joined[0]).any():
                join(joining, joined, np.abs(part.blocks).max(axis=0) > 0.0)
        root_of = first_joined(joining)
        parts: dict[int, list[Part]] = {root: [] for root in np.unique(root_of).tolist()}
        for part in square:
            roots = root_of[of_dof[part.rows[0]]]
            for root in set(roots.tolist()):
                parts[root].append(_cut(part, roots == root))
        components, solved = list[Component](), Solved()
        for root, parts_of in parts.items():
            joined = tuple(
                line for line, first in zip(lines, root_of, strict=True) if first == root
            )
            dofs = np.flatnonzero(root_of[of_dof] == root)
            if len(dofs):
                components.append(self._component(joined, dofs, parts_of, solved))
        return components

    @cached_property
    def owner(self) -> Indices:
        """Index of the component of every DOF."""
        owner = np.zeros(self.dofs.count, dtype=np.intp)
        for k, component in enumerate(self.components):
            owner[component.dofs] = k
        return owner

    def _component(
        self, lines: tuple[Line, ...], dofs: Indices, parts: list[Part], solved: Solved
    ) -> Component:
        shaft, included = self.shafts.get(lines[0].body), np.zeros(self.dofs.count, dtype=bool)
        included[dofs] = True
        return Component(
            lines=lines,
            dofs=dofs,
            parts=parts,
            rigid=[] if shaft is None else list(shaft.rigid(lines[0].way)),
            ports=self._ports[included[self._ports]],
            spindle=None if shaft is None else shaft.spindle,
            cutoff=0.0 if self.rigid else self.fine.cutoff,
            bends=lines[0].kind == "bending",
            solved=solved,
            ratio=1.0 if shaft is None else shaft.ratio,
            polar=self._polar(included, lines[0].way) if self.fine.gyroscopic else [],
            band=self.fine.slow,
            inertial=self.fine.finer > 0 and not self._nearly_free,
            pressed=self._pressed(lines[0]),
            coarse=self._coarser(lines),
        )

    @cached_property
    def _nearly_free(self) -> bool:
        """True if a support is meant as none: rounding of more static modes hides slow modes."""
        values = (
            value for support in self.spindle.supports for value in support.stiffness.values()
        )
        sizes = (np.abs(np.asarray(value, float)) for value in values)
        return any(((size > 0.0) & (size < SOFT[0])).any() for size in sizes)

    def _coarser(self, lines: tuple[Line, ...]) -> Coarse | None:
        """Return the component of the same lines in the coarser model, for a line of a shaft."""
        body, way = lines[0]
        if self.coarse is None or body not in self.shafts or len(lines) > 1:
            return None
        component = next(c for c in self.coarse.components if c.lines == lines)
        return Coarse(component, *self.shafts[body].nested(self.coarse.shafts[body], way))

    def _pressed(self, line: Line) -> tuple[int, list[Rows]] | None:
        """Return slopes in a plane of the spindle's shaft under a drawbar or if ``pressed``."""
        bar = self.spindle.drawbar
        barred = bar is not None and bool(bar.contacts)
        if line.body != SPINDLE or line.kind != "bending" or not (barred or self.pressed):
            return None
        rows, element = slope_rows(self.shafts[SPINDLE], self.shown, line.way)
        if bar is None or self.pressed:
            return len(element), rows
        middle = self.shown.middle[element]
        inside = ((bar.start < middle) & (middle < bar.end)).astype(float)
        return len(element), weighted(rows, inside)

    def _polar(self, included: np.ndarray, way: str) -> list[Part]:
        """Return gyroscopic parts that act on a bending plane, both sides of them in that plane."""
        parts = []
        for part in self.parts:
            if part.matrix == "gyroscopic" and part.rows.size:
                rows = part.rows if way == "y" else part.columns
                if included[rows[0, 0]]:
                    parts.append(Part("gyroscopic", rows, rows, part.blocks))
        return parts

    def gyroscopic(self, y: Component, z: Component) -> Array:
        """Return the coupling of velocities of plane z to plane y of a rotor (m, m), per unit of
        the spindle's speed."""
        key = id(y), id(z)
        if key not in self._gyroscopic:
            parts = [
                p for p in self.parts if p.matrix == "gyroscopic" and y.has(p.rows[:1, 0]).all()
            ]
            shape = len(y.dofs), len(z.dofs)
            blocks = [(y.local(p.rows), z.local(p.columns), p.blocks) for p in parts]
            matrix = summed(shape, blocks, large=y.large)
            self._gyroscopic[key] = np.asarray(y.vectors.T @ (matrix @ z.vectors))
        return self._gyroscopic[key]

    def slopes(self, component: Component) -> Slopes:
        """Return weighted slopes in a bending plane of the spindle's shaft."""
        key = id(component.vectors)  # one of both planes where they have one reduction
        if key not in self._slopes:
            rows, element = slope_rows(self.shafts[SPINDLE], self.shown, component.way)
            self._slopes[key] = Slopes(component.displaced(len(element), rows), element)
        return self._slopes[key]

    def motion(self, line: Line, component: Component) -> Array:
        """Return displacements of the shown nodes of a shaft by the coordinates of one of its
        components (nodes, 6, m), along one line of it."""
        x = self.shown.of_rotors[line.body].x
        rows = self.shafts[line.body].displaced(line.way, x)
        return component.displaced(6 * len(x), rows).reshape(len(x), 6, -1)


def _cut(part: Part, kept: np.ndarray) -> Part:
    """Return a part on rows = columns reduced to some of its DOF (r,)."""
    if kept.all():
        return part
    return Part(
        part.matrix, part.rows[:, kept], part.rows[:, kept], part.blocks[:, kept][:, :, kept]
    )
