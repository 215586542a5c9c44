"""What sits at the nodes of an exact rotor, in circular parts.

Sprung sleeves and the straight parts of the drawbar reach over several nodes. Each adds a
displacement that all nodes share: the deflection u of a sleeve, whose bearings answer to y − u, or
the stretch v of a part of the bar, with (P/L) (v (y₂ − y₁) − v²/2) for its energy P (y₂ − y₁)²/2L.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.mesh import Mesh
from rotordyn.equation.seat import turn
from rotordyn.equation.support import ALIKE, node_matrix
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from tests.oracles.dense_rotor.lumped import lumped_element
from tests.oracles.exact_shaft.circular import PLANES, TURNING

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, slots=True)
class NodeTerms:
    """K + iω C − ω² M + ωΩ P, each (nodes, w, w), in circular parts."""

    stiffness: Complex
    damping: Complex
    mass: Complex
    polar: Complex

    def at(self, omega: complex | NDArray[np.inexact], spin: float) -> Complex:
        """Dynamic stiffness (…, nodes, w, w) at whirl frequencies (…,) [rad/s]."""
        w = np.asarray(omega)[..., None, None, None]
        turning = w * spin * self.polar - w * w * self.mass
        return np.asarray(self.stiffness + 1j * w * self.damping + turning)

    def spread(self, places: NDArray[np.intp]) -> NodeTerms:
        """The same nodes at ``places`` of a longer row, whose last is the last of these."""
        grown = {}
        for f in fields(self):
            own = getattr(self, f.name)
            grown[f.name] = np.zeros((places[-1] + 1, *own.shape[1:]), dtype=complex)
            grown[f.name][places] = own
        return NodeTerms(**grown)


def node_terms(
    spindle: Spindle, mesh: Mesh, tangents: Array, *, pulled: bool
) -> tuple[NodeTerms, int]:
    """Bearings, supports, sleeves, masses and discs, and how many circular parts they couple.

    ``tangents`` (seats, 5, 5): of the bearings in their own frames; ``pulled``: the drawbar acts on
    bending.
    """
    gathered = _Gathered(spindle, mesh, pulled)
    for seat, tangent in zip(spindle.seats, tangents, strict=True):
        gathered.seat(seat, tangent)
    for support in spindle.supports:
        node = mesh.node_of(support.x)
        gathered.held("stiffness", node, PLANES.take(node_matrix(support.stiffness)))
        gathered.held("damping", node, PLANES.take(node_matrix(support.damping)))
    planes = 1 if gathered.alike else 2
    for body in spindle.lumped:
        node = mesh.node_of(body.x)
        gathered.real["mass"][node, :4, :4] += PLANES.take(lumped_element(body).mass)
        gathered.polar[node, (1, 3)] += (body.polar_inertia, -body.polar_inertia)
    return gathered.circular(planes), planes


class _Gathered:
    """Matrices (nodes, 4 + 2c, 4 + 2c) over (y, θz, z, −θy), then y and z of what is carried."""

    def __init__(self, spindle: Spindle, mesh: Mesh, pulled: bool) -> None:
        self.spindle, self.mesh, self.alike = spindle, mesh, True
        self.sprung = [s for s in spindle.sleeves if math.isfinite(s.radial_stiffness)]
        bar = spindle.drawbar if pulled and spindle.drawbar and spindle.drawbar.force else None
        parts = list(pairwise(bar.contacts)) if bar else []
        self.width = 4 + 2 * (len(self.sprung) + len(parts))
        shape = (mesh.nodes, self.width, self.width)
        self.real = {name: np.zeros(shape) for name in ("stiffness", "damping", "mass")}
        self.polar = np.zeros((mesh.nodes, self.width))  # diagonal, in circular parts
        for place, sleeve in enumerate(self.sprung):
            self._sleeve(sleeve, place)
        for place, (a, b) in enumerate(parts, start=len(self.sprung)):
            ends = mesh.node_of(a), mesh.node_of(b)
            self._string(ends, bar.force / (b - a) if bar else 0.0, place)

    def held(self, name: str, node: int, matrix: Array, rows: Array | None = None) -> None:
        """Add a matrix (4, 4) between displacements that are ``rows`` (4, width) of the node's."""
        self.alike &= _alike(matrix)
        rows = np.eye(4, self.width) if rows is None else rows
        self.real[name][node] += rows.T @ matrix @ rows

    def seat(self, seat: BearingSeat, tangent: Array) -> None:
        """A bearing between the shaft and its sleeve, or the housing."""
        node, rows = self.mesh.node_of(seat.x), np.eye(4, self.width)
        for place, sleeve in enumerate(self.sprung):
            if seat.name in sleeve.bearings:
                rows[(0, 2), self._carried(place)] = -1.0
        self.held("stiffness", node, PLANES.take(turn(tangent, seat.thrust)), rows)
        self.held("damping", node, seat.radial_damping * np.diag([1.0, 0.0, 1.0, 0.0]), rows)

    def _sleeve(self, sleeve: Sleeve, place: int) -> None:
        own = self._carried(place)
        self.real["stiffness"][0, own, own] = sleeve.radial_stiffness
        self.real["mass"][0, own, own] = sleeve.mass

    def _string(self, ends: tuple[int, int], stiffness: float, place: int) -> None:
        own, k = self._carried(place), self.real["stiffness"]
        for node, value in zip(ends, (-stiffness, stiffness), strict=True):
            k[node, (0, 2), own] += value
            k[node, own, (0, 2)] += value
        k[ends[1], own, own] = -stiffness

    def _carried(self, place: int) -> tuple[int, int]:
        return 4 + 2 * place, 5 + 2 * place

    def circular(self, planes: int) -> NodeTerms:
        """In circular parts; of one plane the forward ones only."""
        pairs = (self.width - 4) // 2
        across = np.zeros((self.width, self.width), dtype=complex)
        across[:4, :4] = np.kron(TURNING, np.eye(2))
        across[4:, 4:] = np.kron(np.eye(pairs), TURNING)
        back = np.linalg.inv(across)
        one = [0, 1, *range(4, self.width, 2)]
        kept = np.array(one if planes == 1 else range(self.width))
        turned = {name: across @ own @ back for name, own in self.real.items()}
        turned["polar"] = self.polar[:, :, None] * np.eye(self.width)
        chosen = {name: own[:, kept[:, None], kept] for name, own in turned.items()}
        return NodeTerms(**{name: own.astype(complex) for name, own in chosen.items()})


def _alike(matrix: Array) -> bool:
    """True where a support answers alike in all directions: [[P, Q], [−Q, P]]."""
    turned = np.block([[matrix[2:, 2:], -matrix[2:, :2]], [-matrix[:2, 2:], matrix[:2, :2]]])
    return bool((np.abs(matrix - turned) <= ALIKE * np.maximum(abs(matrix), abs(turned))).all())
