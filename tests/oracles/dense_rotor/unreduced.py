"""The elements of the product, of any degree, with every DOF: assembled densely, not reduced.

What a reduction and its error are judged against; the elements themselves are judged by the exact
shaft and by the standard ones beside this file.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigvals, solve

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import summed


@dataclass(frozen=True, eq=False)
class Unreduced:
    """M q̈ + (C + Ω G) q̇ + (K + Ω T) q = f over chosen ``dofs`` (n,) of a structure, each (n, n).

    ``held``: the share of K that links add, apart from the elastic rest ``stiffness``. ``turning``
    T: of dampers that turn with their rotor, those of joints.
    """

    dofs: Indices
    mass: Array
    gyroscopic: Array
    damping: Array
    stiffness: Array
    held: Array
    turning: Array

    def row(self, dof: int) -> int:
        """Place of a DOF."""
        return int(np.searchsorted(self.dofs, dof))


def unreduced(structure: Structure, state: State, motion: str | None = None) -> Unreduced:
    """At the first speed of ``state``; of one ``motion`` of the shafts ("bending", …), or all DOF.

    Damping of the rotor itself is not included: it is defined by modes.
    """
    size = structure.dofs.count

    def assembled(name: str) -> Array:
        own = [p for p in structure.parts if p.matrix == name and p.rows.size]
        return np.asarray(summed((size, size), [p[1:] for p in own], large=False))

    held, dampers = np.zeros((2, size, size))
    for link in (*structure.connections, *structure.sleeve_springs):
        matrices, at = link.matrices(state), np.ix_(link.dofs, link.dofs)
        held[at] += link.motions.T @ matrices.stiffness[0] @ link.motions
        dampers[at] += link.motions.T @ matrices.damping[0] @ link.motions
    across = assembled("gyroscopic")
    ways = np.array([line.kind for line in structure.dofs.lines])[structure.dofs.line]
    chosen = np.flatnonzero((ways == motion) | (motion is None))
    every = (
        assembled("mass"),
        across - across.T,
        assembled("damping") + dampers,
        assembled("stiffness"),
        held,
        _turning(structure, assembled("turning")),
    )
    return Unreduced(chosen, *(matrix[np.ix_(chosen, chosen)] for matrix in every))


def _turning(structure: Structure, dampers: Array) -> Array:
    """Of dampers that turn (n, n), alike in both planes: what couples these per unit of speed."""
    across = np.zeros_like(dampers)
    for shaft in structure.shafts.values():
        for (node, name), y in shaft.jump.items():
            if name in ("y", "thz"):
                z = shaft.jump[node, {"y": "z", "thz": "thy"}[name]]
                across[y, z], across[z, y] = dampers[y, y], -dampers[z, z]
    return across


def dense_poles(spindle: Spindle, spin: float, highest: float, accuracy: float | None) -> Complex:
    """All poles of bending [rad/s] that oscillate, by size; elements good to ``accuracy`` up to
    ``highest`` [Hz], of a rotor on linear supports.

    Motions are counted from that of the first node, so that rounding of stiff pieces does not hold
    a rigid one, and the inverse problem, 1/λ, is solved: both keep the digits of slow modes.
    """
    structure = Structure(spindle, build_mesh(spindle), Fineness(highest, spin, accuracy))
    state = State(np.array([spin]), np.zeros((1, 0, 6, 6)), np.zeros((1, 0), dtype=bool))
    whole = unreduced(structure, state, "bending")
    turn, rigid = _from_first_node(structure, whole)
    links = whole.held + spin * whole.turning
    mass, gyroscopic, damping, elastic, held = (
        turn.T @ matrix @ turn
        for matrix in (whole.mass, whole.gyroscopic, whole.damping, whole.stiffness, links)
    )
    elastic[rigid], elastic[:, rigid] = 0.0, 0.0
    return poles_by_inverse(mass, damping + spin * gyroscopic, elastic + held)


def _from_first_node(structure: Structure, whole: Unreduced) -> tuple[Array, Indices]:
    """Coordinates that are rigid motions of each plane at the first DOF, and which these are."""
    turn, rigid = np.eye(len(whole.dofs)), []
    for component in structure.components:
        if component.lines[0].kind != "bending":
            continue
        motions = np.zeros((len(whole.dofs), 2))
        for dofs, motion in component.rigid:
            motions[np.searchsorted(whole.dofs, dofs)] = motion
        first = np.searchsorted(whole.dofs, component.rigid[0][0][0])
        tilt = np.searchsorted(whole.dofs, component.rigid[1][0][0])
        motions[:, 1] -= motions[first, 1] * motions[:, 0]
        turn[:, [first, tilt]] = motions
        rigid += [first, tilt]
    return turn, np.array(rigid)


def poles_by_inverse(mass: Array, damping: Array, stiffness: Array) -> Complex:
    """Poles [rad/s] with Im > 0 by size, of the inverse problem 1/λ."""
    size = len(mass)
    both = np.concatenate([damping, mass], axis=1)
    damped, moved = np.split(solve(stiffness, both), 2, axis=1)
    scale = math.sqrt(np.abs(moved).max())
    whole = np.block([[-damped, -moved / scale], [scale * np.eye(size), np.zeros((size, size))]])
    inverse = eigvals(whole)
    found = 1.0 / inverse[inverse != 0.0]
    found = found[found.imag > 0.0]
    return found[np.argsort(np.abs(found))]
