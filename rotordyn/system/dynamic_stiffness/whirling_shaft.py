"""Bending of one rotor in circular coordinates, every freedom of its elements kept.

Whirl e^(iωt), ω of either sign, is answered by

    α K + β M + ωΩ P − Ω² M_ω + S

with the stiffness K of elements and joints, the mass M, the polar matrix P, the shortening S by the
axial force, and M_ω where the formulation has it; α = 1 + i (ω − κΩ) b + i η sgn(ω − Ω) and
β = −ω² + i (ω − κΩ) a hold Rayleigh's a and b, of which the share κ turns with the shaft, and the
loss factor η; a joint that damps by c adds i (ω − Ω) c. Two ways to the motion of a few nodes: by a
chain of elements, each node eliminated exactly; or with the assembled matrices, which modal damping
asks for, as it joins all freedoms.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements import hierarchic_bending as bending
from rotordyn.elements.plane_bending import shear_parameter
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.chain import Chain, Piece, without_inner
from rotordyn.numerics.reduction import HALF_DIGIT
from rotordyn.numerics.sparse import filled
from rotordyn.system.assemble import (
    loaded_plane,
    lumped_plane,
    shear_coefficients,
)
from rotordyn.system.geometric_stiffness import gauss_points
from rotordyn.system.hierarchic_rotor import bending_rigidities, slopes
from rotordyn.system.hierarchy import Hierarchy
from rotordyn.system.jumps import Jump
from rotordyn.system.mesh import Mesh
from rotordyn.system.rotor_damping import modal_rates

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Values = NDArray[np.inexact[Any]]
RIGID = 2  # motions of a free rotor in a plane
DIGITS = 12  # lengths that agree in so many are the same
NAMES = ("stiffness", "mass", "polar", "translational_mass")


@dataclass(frozen=True, eq=False, slots=True)
class Whirl:
    """Whirl at ``omega`` (f,) [rad/s], ``sign`` (f,) of ω − Ω, of a machine turning at ``spin``;
    ``softened``: Ω² M_ω is subtracted."""

    omega: Array
    sign: Array
    spin: float
    softened: bool = False


@dataclass(frozen=True, eq=False)
class WhirlingShaft:
    """A rotor in ``elements``, turning at ``ratio`` times the speed that whirl is told with.

    ``pressed``: the mesh in whose elements the axial force is told, None where none acts.
    """

    spindle: Spindle
    elements: Hierarchy
    ratio: float = 1.0
    loss_factor: float = 0.0
    pressed: Mesh | None = None

    def chain(
        self, whirl: Whirl, kept: Sequence[int], at: Mapping[int, Values], force: Array | None
    ) -> Chain:
        """All nodes of the elements, of which ``kept`` stay; matrices (2, 2, f or 1) are added
        ``at`` nodes. ``force`` (elements of the mesh ``pressed``,) [N]."""
        doubt, terms = np.ones(len(whirl.omega)), self._terms(whirl)
        order = self._alike if force is None else list(range(len(self.elements.degree)))
        pieces: dict[Hashable, Piece] = {
            k: self._piece(k, whirl, terms, force, doubt) for k in sorted(set(order))
        }
        added = {node: _summed(own, terms) for node, own in self._lumped.items()}
        for node, own in at.items():
            added[node] = added[node] + own if node in added else own
        return Chain(pieces, order, added, kept, doubt)

    def assembled(self, whirl: Whirl, force: Array | None) -> Values:
        """The same of all freedoms as ``elements`` has them, (n, n, f)."""
        terms, whole = self._terms(whirl), self._whole
        if self.spindle.rotor_damping:
            rate = whirl.omega - self.spindle.internal_damping * self.ratio * whirl.spin
            terms = {**terms, "modal": 1j * rate}
        if self.elements.dampers:
            terms = {**terms, "joints": 1j * (whirl.omega - self.ratio * whirl.spin)}
        found = _summed(whole, terms)
        if force is not None and self.pressed is not None:
            x, weight = gauss_points(self.pressed)
            along = ((force * self.pressed.length)[:, None] / 2.0 * weight).reshape(-1, 1)
            slope = filled(slopes(self.spindle, self.elements, x.ravel()))
            found = found + (slope.T @ (along * slope))[..., None]
        return found

    @property
    def rounding(self) -> float:
        """Stiffness to ground that rounding may come to [N/m]: half a last digit of the stiffest
        element for every one of them."""
        length = self.elements.mesh.length
        shear, bend = bending_rigidities(self.spindle, self.elements.mesh)
        stiffest = float((1.0 / (length / shear + length**3 / (12.0 * bend))).max())
        return HALF_DIGIT * len(length) * stiffest

    @cached_property
    def _whole(self) -> dict[str, Array]:
        plane = loaded_plane(self.spindle, self.elements)
        found = {name: filled(getattr(plane, name)) for name in NAMES}
        if self.spindle.rotor_damping:
            given = self.spindle.rotor_damping
            found["modal"] = modal_damping(found["mass"], found["stiffness"], given)
        if self.elements.dampers:
            own = np.zeros(self.elements.size)
            own[list(self.elements.dampers)] = list(self.elements.dampers.values())
            found["joints"] = np.diag(own)
        return found

    def _terms(self, whirl: Whirl) -> Mapping[str, Values]:
        """What each matrix is multiplied by (f,), real where nothing damps."""
        own, omega = self.spindle.rayleigh, whirl.omega
        spin = self.ratio * whirl.spin
        rate = omega - self.spindle.internal_damping * spin
        terms: dict[str, Values] = {
            "stiffness": np.ones_like(omega),
            "mass": -(omega**2),
            "polar": omega * spin,
        }
        if own.stiffness or self.loss_factor:
            loss = own.stiffness * rate + self.loss_factor * whirl.sign
            terms["stiffness"] = terms["stiffness"] + 1j * loss
        if own.mass:
            terms["mass"] = terms["mass"] + 1j * own.mass * rate
        if whirl.softened:
            terms["translational_mass"] = np.full_like(omega, -(whirl.spin**2))
        return terms

    def _piece(
        self, k: int, whirl: Whirl, terms: Mapping[str, Values], force: Array | None, doubt: Array
    ) -> Piece:
        matrix = _summed(self._matrices[k], terms)
        if force is not None:
            where, per_newton = self._shortening[k]
            matrix = matrix + np.tensordot(force[where], per_newton, 1)[..., None]
        jumps = self._jumps[k]
        if jumps:
            places = [1 if jump.tilt else 0 for jump in jumps]
            moved = np.eye(len(matrix))[:, places]
            across = np.tensordot(moved.T, matrix, 1)
            own = np.einsum("jaf,ak->jkf", across, moved)
            spring = np.array([jump.stiffness for jump in jumps])[:, None] * terms["stiffness"]
            if any(jump.damping for jump in jumps):
                rate = whirl.omega - self.ratio * whirl.spin
                spring = spring + 1j * np.array([j.damping for j in jumps])[:, None] * rate
            own = own + np.eye(len(jumps))[..., None] * spring
            back = np.einsum("aif,ij->ajf", matrix, moved)
            matrix = np.concatenate(
                [np.concatenate([matrix, back], axis=1), np.concatenate([across, own], axis=1)]
            )
        return Piece.of(without_inner(matrix, 4, doubt))

    @cached_property
    def _alike(self) -> list[int]:
        """The first element that is like each one."""
        mesh, known = self.elements.mesh, dict[tuple[object, ...], int]()
        own = [mesh.outer_diameter, mesh.inner_diameter, mesh.young_modulus, mesh.poisson_ratio]
        values = np.stack([*own, mesh.density, self.elements.degree], axis=1).tolist()
        lengths = [f"{length:.{DIGITS - 1}e}" for length in mesh.length]
        return [
            known.setdefault((*value, length, k if self._jumps[k] else None), k)
            for k, (value, length) in enumerate(zip(values, lengths, strict=True))
        ]

    @cached_property
    def _jumps(self) -> list[list[Jump]]:
        """Of each element those at its front end."""
        found: list[list[Jump]] = [[] for _ in self.elements.degree]
        for jump in self.elements.jumps:
            found[self.elements.mesh.node_of(jump.x)].append(jump)
        return found

    @cached_property
    def _matrices(self) -> dict[int, dict[str, Array]]:
        """Of one of all elements that are alike, by name (k, k)."""
        chosen = np.unique(self._alike)
        if self.pressed is not None:
            chosen = np.arange(len(self.elements.degree))
        degree = self.elements.degree[chosen]
        found: dict[int, dict[str, Array]] = {}
        for n in np.unique(degree):
            own = chosen[degree == n]
            blocks = self.elements.element(own, int(n))
            for place, k in enumerate(own):
                found[int(k)] = {name: blocks[name][place] for name in NAMES}
        return found

    @cached_property
    def _lumped(self) -> dict[int, dict[str, Array]]:
        """Of nodes with bodies, by name (2, 2)."""
        nodes, blocks = lumped_plane(self.spindle, self.elements.mesh)
        found: dict[int, dict[str, Array]] = {}
        for place, node in enumerate(nodes):
            own = found.setdefault(node, dict.fromkeys(blocks, np.zeros((2, 2))))
            found[node] = {name: own[name] + blocks[name][place] for name in blocks}
        return found

    @cached_property
    def _shortening(self) -> list[tuple[NDArray[np.intp], Array]]:
        """Of each element those of the mesh ``pressed`` that reach into it, and its stiffness per
        newton in each of these (parts, k, k)."""
        assert self.pressed is not None
        mesh, given = self.elements.mesh, self.pressed
        x, weight = gauss_points(given)
        along = (given.length[:, None] / 2.0 * weight).ravel()
        source = np.repeat(np.arange(len(given.length)), len(weight))
        element, place = self.elements.place(x.ravel())
        phi = _shear_parameter(self.spindle, mesh)
        found = []
        for k, degree in enumerate(self.elements.degree):
            at = np.flatnonzero(element == k)
            own = slice(k, k + 1)
            slope = bending.shapes(mesh.length[own], phi[own], int(degree), place[at]).slope[0]
            parts = np.unique(source[at])
            found.append(
                (
                    parts,
                    np.stack(
                        [
                            (slope[chosen] * along[at[chosen], None]).T @ slope[chosen]
                            for chosen in (source[at] == part for part in parts)
                        ]
                    ),
                )
            )
        return found


def modal_damping(mass: Array, stiffness: Array, given: tuple[float, ...]) -> Array:
    """Damping of the free rotor's modes by the ratios ``given`` in order (n, n): M Φ 2ζω Φᵀ M."""
    from scipy.linalg import eigh

    values, vectors = eigh(stiffness, mass)
    values = np.where(np.arange(len(values)) < RIGID, 0.0, np.maximum(values, 0.0))
    shapes = mass @ vectors
    return np.asarray(shapes * modal_rates(values, given) @ shapes.T)


def _summed(matrices: Mapping[str, Array], terms: Mapping[str, Values]) -> Values:
    """Σ term · matrix (k, k, f)."""
    names = [name for name in terms if name in matrices]
    size = matrices[names[0]].shape
    stacked = np.stack([matrices[name].ravel() for name in names], axis=1)
    factors = np.stack([terms[name] for name in names])
    if np.iscomplexobj(factors):
        total = stacked @ factors.real + 1j * (stacked @ factors.imag)
    else:
        total = stacked @ factors
    return np.asarray(total.reshape(*size, -1))


def _shear_parameter(spindle: Spindle, mesh: Mesh) -> Array:
    ring = (mesh.outer_diameter, mesh.inner_diameter)
    bent = mesh.young_modulus * second_moment(*ring)
    return shear_parameter(
        mesh.length, bent, shear_coefficients(spindle, mesh) * mesh.shear_modulus * area(*ring)
    )
