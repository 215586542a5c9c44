"""All poles and receptances of assembled matrices, every freedom kept, solved densely."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigvals, solve

from benchmarks.peer import machine
from rotordyn.equation.dofs import position
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE
from tests.oracles.dense_rotor.unreduced import unreduced

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
    points = {f"station {k}": x for k, x in enumerate(machine.STATIONS)}
    spindle = replace(spindle, points=points)  # so that nodes are there
    mesh = build_mesh(spindle, 1.0001 * machine.ELEMENT if accuracy is None else None)
    structure = Structure(spindle, mesh, Fineness(highest, spin, accuracy))
    state = State(np.zeros(1), np.zeros((1, 0, 5, 5)), np.zeros((1, 0), dtype=bool))
    own = unreduced(structure, state, "bending")
    seen, sign = [], structure.dofs.sign
    for x in machine.STATIONS:
        for number in structure.node(SPINDLE, x)[[position(name) for name in machine.MOTIONS]]:
            row = np.zeros(len(own.dofs))
            row[own.row(int(number))] = sign[number]
            seen.append(row)
    return Dense(own.mass, own.damping, own.gyroscopic, own.stiffness + own.held, np.array(seen))


def of_theirs(arrays: dict[str, Array], freedoms: tuple[int, ...]) -> Dense:
    """The matrices of the peer; ``freedoms``: bending DOF of its nodes, not coupled to others.

    Raises
    ------
    ValueError : something couples them
    """
    rows = (6 * np.arange(machine.NODES)[:, None] + np.array(freedoms)).ravel()
    others = np.setdiff1d(np.arange(6 * machine.NODES), rows)
    matrices = [arrays[name] for name in ("mass", "damping", "spin", "stiffness")]
    if any(m[np.ix_(rows, others)].any() or m[np.ix_(others, rows)].any() for m in matrices):
        raise ValueError("the peer's matrices couple bending with other motions")
    return Dense(*(m[np.ix_(rows, rows)] for m in matrices), np.eye(len(rows)))
