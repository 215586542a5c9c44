"""The machine at rest under static loads, by the stiffness of its equation of motion."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.dofs import position
from rotordyn.equation.linear import linear, subsystems
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import Array, State
from rotordyn.machine.rotor import Place
from rotordyn.machine.support import SPINDLE

PLANE = [position("y"), position("thz")]
NOTHING = 1e-8  # of the root of the largest stiffness: a motion that nothing holds
ROUNDING = 1e-12  # of a stiffness matrix with unit diagonal


@dataclass(frozen=True, eq=False, slots=True)
class PlaneRotor:
    """Static stiffness (states, m, m) of shaft, drawbar, sleeves and supports in plane y, without
    the bearings, in m coordinates; a state is an axial force in the shaft and a speed.

    ``seats`` (seats, 2, m): deflection and tilt between the rings of each bearing; ``point`` (m,):
    deflection of the point loaded.
    """

    stiffness: Array
    seats: Array
    point: Array

    def at(self, rows: NDArray[np.intp]) -> PlaneRotor:
        """In some of its states."""
        return replace(self, stiffness=self.stiffness[rows])


def plane_rotor(
    structure: Structure, speed: Array, point: Place, force: Array | None = None
) -> PlaneRotor:
    """Of a structure with a port at ``point``, under the axial ``force`` (states, elements) [N]."""
    components = [
        c
        for c in structure.components
        if c.way == "y" and not c.lines[0].body.startswith("housing")
    ]
    state = _without_bearings(structure, speed)
    own = linear(structure, components, state, force)
    number = structure.node(*point)[position("y")]
    motions = {id(each.link): each.motions for each in own.connections}
    rows = [motions[id(link)][PLANE] for link in structure.seats]
    seated, moved = np.array(rows).reshape(-1, 2, own.size), own.displaced(np.array([number]))[0]
    return PlaneRotor(own.within(own.stiffness), seated @ own.basis, moved @ own.basis)


def withstands(
    structure: Structure, state: State, force: Array, pull: float = 1.0
) -> NDArray[np.bool_]:
    """States (s,) in which the axial ``force`` (s, elements) [N] takes away no stable direction.

    The symmetric stiffness of bending must have as many negative eigenvalues as without axial
    force, which is none in any machine that stands. ``pull``: share of the drawbar's tension.
    """
    first = structure.node(SPINDLE, structure.spindle.shaft.start)[position("y")]
    bent = structure.components[structure.owner[first]]
    every = subsystems(structure, state, strings=True)
    components = next(own for own in every if bent in own)
    both = [linear(structure, components, state, each, pull=pull) for each in (force, None)]
    loaded, free = (own.within(own.stiffness) for own in both)
    return np.asarray(_negative(loaded) <= _negative(free))


def _negative(matrix: Array) -> Array:
    """Number of negative eigenvalues (s,) of the symmetric part; infinite where it is not known."""
    matrix = 0.5 * (matrix + np.swapaxes(matrix, 1, 2))
    known = np.asarray(np.isfinite(matrix).all(axis=(1, 2)))
    size = np.sqrt(np.abs(np.diagonal(matrix, axis1=1, axis2=2)))
    largest = size.max(axis=1, keepdims=True)
    size = np.where(size > NOTHING * largest, size, largest)  # held by nothing: rounding
    size = np.where(known[:, None] & (size > 0.0), size, 1.0)
    scaled = np.where(known[:, None, None], matrix, 0.0) / size[:, :, None] / size[:, None, :]
    try:
        np.linalg.cholesky(scaled)
    except np.linalg.LinAlgError:
        values = np.linalg.eigvalsh(scaled)
        return np.where(known, (values < -ROUNDING).sum(axis=1), np.inf)
    return np.zeros(len(matrix))


def _without_bearings(structure: Structure, speed: Array) -> State:
    seats, sleeves = len(structure.spindle.seats), len(structure.spindle.sleeves)
    none = np.zeros((len(speed), seats, 5, 5))
    stops = np.zeros((len(speed), sleeves), dtype=bool)
    return State(speed, none, stops, standing=True)
