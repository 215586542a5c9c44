"""All poles and receptances of assembled matrices, every freedom kept, solved densely."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from rotordyn.system.hierarchic_rotor import beams, bending_hierarchy, deflections
from rotordyn.system.hierarchy import Hierarchy
from scipy.linalg import eigvals, solve

from benchmarks.peer import machine
from rotordyn.machine.spindle import Spindle
from rotordyn.model.mesh import build_mesh
from rotordyn.model.support import node_matrix
from rotordyn.numerics.sparse import filled
from tests.oracles.dense_rotor.assemble import loaded_plane
from tests.oracles.dense_rotor.selection import BOTH_PLANES

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
SWINGING = 1e-3  # of |pole|: slower ones hardly swing


@dataclass(frozen=True, eq=False, slots=True)
class Dense:
    """M q̈ + (C + Ω G) q̇ + K q = f; ``seen`` (nodes·4, n): motions of the nodes."""

    mass: Array
    damping: Array
    gyroscopic: Array
    stiffness: Array
    seen: Array

    def poles(self, spin: float) -> Complex:
        """Poles at ``spin`` [rad/s] that swing, by their frequency.

        From the inverse problem, 1/λ, which keeps the digits of slow modes.
        """
        both = np.concatenate([self._turning(spin), self.mass], axis=1)
        damped, moved = np.split(solve(self.stiffness, both), 2, axis=1)
        size, scale = len(self.mass), math.sqrt(np.abs(moved).max())
        zero, one = np.zeros_like(moved), np.eye(size)
        inverse = eigvals(np.block([[-damped, -moved / scale], [scale * one, zero]]))
        found = 1.0 / inverse[inverse != 0.0]
        found = found[found.imag > SWINGING * np.abs(found)]
        return found[np.argsort(found.imag)]

    def response(self, spin: float, omega: Array, loaded: int) -> Complex:
        """Motions of the nodes (frequencies, nodes, 4) per force on row ``loaded`` of ``seen``."""
        force = self.seen[loaded] + 0j
        damping = self._turning(spin)
        answers = [
            np.linalg.solve(self.stiffness + 1j * w * damping - w**2 * self.mass, force)
            for w in omega
        ]
        return (np.array(answers) @ self.seen.T).reshape(len(omega), -1, 4)

    def _turning(self, spin: float) -> Array:
        return self.damping + spin * self.gyroscopic


def of_ours(spindle: Spindle, accuracy: float | None, highest: float, spin: float) -> Dense:
    """The bending elements that a run takes for ``accuracy`` up to ``highest`` [Hz].

    Standard ones of the peer's length where ``accuracy`` is None.
    """
    if accuracy is None:
        mesh = build_mesh(spindle, 1.0001 * machine.ELEMENT)
        elements = beams(spindle, mesh, np.ones(mesh.nodes - 1, dtype=np.intp))
    else:
        elements = bending_hierarchy(spindle, 2.0 * math.pi * highest, spin, accuracy)
    plane = loaded_plane(spindle, elements)
    own, polar = filled(plane.mass), filled(plane.polar)
    zero = np.zeros_like(own)
    mass, stiffness = (np.block([[m, zero], [zero, m]]) for m in (own, filled(plane.stiffness)))
    damping = np.zeros_like(mass)
    for support in spindle.supports:
        rows = _both(spindle, elements, (support.x,))
        stiffness = stiffness + rows.T @ BOTH_PLANES.take(node_matrix(support.stiffness)) @ rows
        damping = damping + rows.T @ BOTH_PLANES.take(node_matrix(support.damping)) @ rows
    return Dense(
        mass,
        damping,
        np.block([[zero, polar], [-polar, zero]]),
        stiffness,
        np.concatenate([_in_order(_both(spindle, elements, (x,))) for x in machine.STATIONS]),
    )


def _both(spindle: Spindle, elements: Hierarchy, x: tuple[float, ...]) -> Array:
    """Deflection and slope in plane y, then in plane z, at one station (4, 2n)."""
    seen = filled(deflections(spindle, elements, np.array(x)))
    return np.block([[seen, 0.0 * seen], [0.0 * seen, seen]])


def _in_order(rows: Array) -> Array:
    """Of (y, thz, z, −thy): ``machine.MOTIONS``."""
    return rows[[0, 2, 3, 1]] * np.array([1.0, 1.0, -1.0, 1.0])[:, None]


def of_theirs(arrays: dict[str, Array], freedoms: tuple[int, ...]) -> Dense:
    """The peer's own matrices; ``freedoms`` of its nodes bend, and nothing couples them to others.

    Raises
    ------
    ValueError : something does
    """
    rows = (6 * np.arange(machine.NODES)[:, None] + np.array(freedoms)).ravel()
    others = np.setdiff1d(np.arange(6 * machine.NODES), rows)
    matrices = [arrays[name] for name in ("mass", "damping", "spin", "stiffness")]
    if any(m[np.ix_(rows, others)].any() or m[np.ix_(others, rows)].any() for m in matrices):
        raise ValueError("the peer's matrices couple bending with other motions")
    return Dense(*(m[np.ix_(rows, rows)] for m in matrices), np.eye(len(rows)))
