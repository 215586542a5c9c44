"""The machine at rest under static loads, by the stiffness of its equation of motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.assemble import assemble, subsystems
from rotordyn.equation.component import Component
from rotordyn.equation.dofs import position
from rotordyn.equation.linear import Linear
from rotordyn.equation.seat import BEARING_DIRECTIONS
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
from rotordyn.machine.rotor import Place
from rotordyn.machine.support import SPINDLE

PLANE = (0, 1, 4)  # x, y, θz of a bearing's five DOF
EVERY = (0, 1, 2, 3, 4)  # all of them
NOTHING = 1e-8  # of the root of the largest stiffness: a motion with less is free
ROUNDING = 1e-12  # of a stiffness matrix with unit diagonal


@dataclass(frozen=True, eq=False, slots=True)
class StaticRotor:
    """Static stiffness (states, m, m) of shaft, drawbar, sleeves and supports across the axis,
    without the bearings, in m coordinates; a state is an axial force in the shaft and a speed.

    ``dof``: those of a bearing's five in which it moves, x first; ``seats`` (seats, dof − 1, m):
    the others between the rings of each bearing; ``point`` (m,): deflection where the load acts
    along it, or loads per newton of their size; ``constant`` (m,): additional loads.
    """

    dof: tuple[int, ...]
    stiffness: Array
    seats: Array
    point: Array
    constant: Array

    def at(self, rows: Indices) -> StaticRotor:
        """Return the rotor in the states ``rows``."""
        return replace(self, stiffness=self.stiffness[rows])


def plane_rotor(
    structure: Structure, speed: Array, point: Place, force: Array | None = None
) -> StaticRotor:
    """Return plane y of a structure with a port at ``point``, under the axial ``force`` [N]
    (states, elements)."""
    components = [
        c
        for c in structure.components
        if c.way == "y" and not c.lines[0].body.startswith("housing")
    ]
    linear = assemble(structure, components, _without_bearings(structure, speed), force)
    return _rotor(structure, linear, PLANE, linear.row(*point, "y"))


def loaded_rotor(
    structure: Structure,
    speed: Array,
    loads: Across,
    force: Array | None = None,
    constant: Across | None = None,
) -> StaticRotor:
    """Return both planes of a structure, with housings and sleeves, under ``loads`` per newton of
    their size, additional ``constant`` ones, and the axial ``force`` (states, elements) [N]."""
    components = [c for c in structure.components if _moves_across(c)]
    linear = assemble(structure, components, _without_bearings(structure, speed), force)
    rotor = _rotor(structure, linear, EVERY, _forces(linear, loads))
    if constant is None:
        return rotor
    return replace(rotor, constant=_forces(linear, constant) @ linear.basis)


def _forces(linear: Linear, loads: Across) -> Array:
    """Return forces on the coordinates (m,)."""
    force = np.zeros(linear.size)
    for place, load in loads.points:
        force += load @ linear.displaced(linear.structure.node(*place))
    for plane, pull in zip(("y", "z"), loads.pull, strict=True):
        if pull:
            force += pull * _weight(linear, plane)
    return force


class Across(NamedTuple):
    """Loads across the axis: at places (Fx, Fy, Fz, Mx, My, Mz) (6,) [N, N·m], of which those along
    and about x are ignored, and the ``pull`` of weight along y and z [m/s²]."""

    points: tuple[tuple[Place, Array], ...]
    pull: tuple[float, float]

    def per_newton(self, length: float, mass: float) -> tuple[Across, float]:
        """Return the loads per newton of their size, and that size [N]: moments count by ``length``
        [m], weight by ``mass`` [kg]."""
        size = float(np.hypot(*self.pull)) * mass
        for _, load in self.points:
            size += float(np.linalg.norm(load[1:3]) + np.linalg.norm(load[4:]) / length)
        share = 1.0 / size if size > 0.0 else 0.0
        (y, z), points = self.pull, tuple((at, share * load) for at, load in self.points)
        return Across(points, (share * y, share * z)), size


def _moves_across(component: Component) -> bool:
    """True if a component moves across the axis: bending of shafts, sleeves and housings."""
    return bool({line.way for line in component.lines} - {"x", "thx"})


def _weight(linear: Linear, way: str) -> Array:
    """Return the force on the coordinates (m,) per acceleration of gravity along y or z, of shafts.

    Mass is the identity: it is the translation of the spindle's shaft in rigid coordinates.
    """
    mass = np.zeros(linear.size)
    for component, part in zip(linear.components, linear.slices, strict=True):
        if component.way != way or component.spindle is None:
            continue
        shaft = linear.structure.shafts[component.lines[0].body]
        nodes = shaft.node[:, position(way)]
        rigid = np.flatnonzero(component.is_rigid)
        sign = linear.structure.dofs.sign[nodes]
        motion = sign[:, None] * component.vectors[component.local(nodes)][:, rigid]
        share = np.linalg.lstsq(motion, np.ones(len(nodes)), rcond=None)[0]
        mass[part][rigid] = share
    return mass


def _rotor(structure: Structure, linear: Linear, dof: tuple[int, ...], point: Array) -> StaticRotor:
    motions = {id(c.link): c.motions for c in linear.connections}
    indices = [position(BEARING_DIRECTIONS[k]) for k in dof[1:]]
    rows = [motions[id(link)][indices] for link in structure.seats]
    rings = np.array(rows).reshape(-1, len(indices), linear.size)
    stiffness, load = linear.allowed_stiffness, point @ linear.basis
    return StaticRotor(dof, stiffness, rings @ linear.basis, load, 0.0 * load)


def stays_stable(structure: Structure, state: State, force: Array, pull: float = 1.0) -> Flags:
    """Return the states (s,) in which the axial ``force`` (s, elements) [N] leaves bending stable.

    The symmetric stiffness of bending must have as many negative eigenvalues as without axial
    force, which is none in any stable machine. ``pull``: share of the drawbar's tension.
    """
    loaded, free = (_bending(structure, state, axial, pull) for axial in (force, None))
    return np.asarray(_negative(loaded) <= _negative(free))


def stands(structure: Structure, state: State, force: Array | None) -> Flags:
    """Return the states (s,) in which bending has no negative stiffness, under the axial ``force``
    (s, elements) [N] if there is one."""
    return np.asarray(_negative(_bending(structure, state, force)) == 0)


def _bending(structure: Structure, state: State, force: Array | None, pull: float = 1.0) -> Array:
    """Return the stiffness (s, m, m) of the shaft's bending with all that moves with it."""
    first = structure.node(SPINDLE, structure.spindle.shaft.start)[position("y")]
    bent = structure.components[structure.owner[first]]
    groups = subsystems(structure, state, drawbar=True)
    components = next(components_of for components_of in groups if bent in components_of)
    return assemble(structure, components, state, force, pull=pull).allowed_stiffness


def _negative(matrix: Array) -> Array:
    """Return the number of negative eigenvalues (s,) of the symmetric part; infinity if unknown."""
    matrix = 0.5 * (matrix + np.swapaxes(matrix, 1, 2))
    finite = np.asarray(np.isfinite(matrix).all(axis=(1, 2)))
    size = np.sqrt(np.abs(np.diagonal(matrix, axis1=1, axis2=2)))
    largest = size.max(axis=1, keepdims=True)
    size = np.where(size > NOTHING * largest, size, largest)  # free: rounding
    size = np.where(finite[:, None] & (size > 0.0), size, 1.0)
    scaled = np.where(finite[:, None, None], matrix, 0.0) / size[:, :, None] / size[:, None, :]
    try:
        np.linalg.cholesky(scaled)
    except np.linalg.LinAlgError:
        values = np.linalg.eigvalsh(scaled)
        return np.where(finite, (values < -ROUNDING).sum(axis=1), np.inf)
    return np.zeros(len(matrix))


def _without_bearings(structure: Structure, speed: Array) -> State:
    seats, sleeves = len(structure.spindle.seats), len(structure.spindle.sleeves)
    tangents = np.zeros((len(speed), seats, 6, 6))
    stops = np.zeros((len(speed), sleeves), dtype=bool)
    return State(speed, tangents, stops, standing=True)
