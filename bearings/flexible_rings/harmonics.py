"""The elastic body of a ring as a sum of harmonics around its axis.

Displacements are u_x = U cos nθ, u_r = V cos nθ, u_θ = W sin nθ with U, V, W over the section; the
energy of every n is that of a plane problem, a quadratic polynomial in n:
K_n = K₀ + n K₁ + n² K₂ (O. C. Zienkiewicz & R. L. Taylor, The Finite Element Method, vol. 2,
"Semi-analytical finite element processes"). Quadrilaterals of nine nodes by scikit-fem.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu
from skfem import Basis, ElementQuad2, ElementVector, LinearForm, MeshQuad

from bearings.arrays import Array, Index
from bearings.flexible_rings.describe import TOUCHING
from bearings.flexible_rings.section import Section
from bearings.materials import Material

ORDER = 5  # of the quadrature, which is exact for the energy of straight elements but for 1/r
POINTS = 24  # along a patch


@dataclass(frozen=True, eq=False)
class Body:
    """A section with its materials, ``held`` at its far ends or nowhere: then every ring moves
    relative to the mean motion of its backing."""

    section: Section
    material: Material
    backing: Material
    held: bool

    @cached_property
    def basis(self) -> Any:
        """Finite-element basis of three displacement fields over the section."""
        mesh = MeshQuad(self.section.corners, self.section.quads)
        return Basis(mesh, ElementVector(ElementQuad2(), 3), intorder=ORDER)

    @cached_property
    def stiffness(self) -> tuple[csc_matrix, ...]:
        """Stiffness matrices K₀, K₁, K₂ per radian."""
        basis = self.basis
        r = np.asarray(basis.global_coordinates())[1]
        first, shear = (
            np.where(self.section.backing, back, ring)[:, None] * r * basis.dx
            for ring, back in zip(_lame(self.material), _lame(self.backing), strict=True)
        )
        constant, linear = zip(*(_strains(field, r) for (field,) in basis.basis), strict=True)
        a, b = (np.moveaxis(np.array(part), 2, 0) for part in (constant, linear))
        stress_a, stress_b = (_stress(part, first, shear) for part in (a, b))
        mixed = _work(stress_a, b)
        works = _work(stress_a, a), mixed + mixed.swapaxes(1, 2), _work(stress_b, b)
        rows, columns = np.broadcast_arrays(
            basis.element_dofs.T[:, :, None], basis.element_dofs.T[:, None, :]
        )
        where, shape = (rows.ravel(), columns.ravel()), (basis.N, basis.N)
        return tuple(coo_matrix((work.ravel(), where), shape).tocsc() for work in works)

    def responses(self, loads: Array, harmonics: Sequence[int]) -> Array:
        """Responses at the places of all rings to unit loads at θ = 0 on the first ring, by each
        harmonic n (harmonics, rings, k, k) [m/N]; the last k is that of the loads.

        ``loads`` (rings, k, unknowns): each as weights of the displacements that it does work on.
        """
        rings, count = loads.shape[:2]
        responses = np.empty((len(harmonics), rings, count, count))
        for place, n in enumerate(harmonics):
            rigid = self._rigid(n)
            balanced = np.stack(
                [
                    load - load @ rigid.T @ self._mean(n, ring)
                    for load, ring in zip(loads, self.section.rings, strict=True)
                ]
            )
            free = self._free(n)
            stiffness = self.stiffness[0] + n * self.stiffness[1] + n * n * self.stiffness[2]
            part = ((2.0 if n == 0 else 1.0) * math.pi * stiffness[free][:, free]).tocsc()
            factors = splu(
                part,
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
            responses[place] = balanced[..., free] @ factors.solve(balanced[0][:, free].T.copy())
        return responses

    def patch(self, ring: int, arc: int, angle: float, half_length: float) -> Array:
        """Mean axial and radial displacement (2, unknowns) over a parabola of a ``half_length`` [m]
        along a groove of a ring, its middle at φ = ``angle``."""
        corners, at, _ = self.section.arcs[ring][arc]
        node, weight = np.polynomial.legendre.leggauss(POINTS)
        share = 0.75 * weight * (1.0 - node**2)
        phi = angle + node * half_length / self.section.radius
        place = np.clip(np.searchsorted(at, phi) - 1, 0, len(at) - 2)
        t = (phi - at[place]) / (at[place + 1] - at[place])
        shapes = ((1.0 - t) * (1.0 - 2.0 * t), t * (2.0 * t - 1.0), 4.0 * t * (1.0 - t))
        basis, facet = self.basis, self._facets
        edge = np.array([facet[tuple(sorted(pair))] for pair in pairwise(corners.tolist())])
        functional = np.zeros((2, basis.N))
        for k in range(2):
            unknowns = (
                basis.nodal_dofs[k, corners[place]],
                basis.nodal_dofs[k, corners[place + 1]],
                basis.facet_dofs[k, edge[place]],
            )
            for shape, unknown in zip(shapes, unknowns, strict=True):
                np.add.at(functional[k], unknown, share * shape)
        return functional

    @cached_property
    def _facets(self) -> dict[tuple[int, ...], int]:
        return {(*sorted(pair),): k for k, pair in enumerate(self.basis.mesh.facets.T.tolist())}

    def _free(self, n: int) -> Index:
        """Unknowns that are solved for; of a body that is held nowhere all but those that fix its
        rigid-body motion, on which balanced loads do no work."""
        basis, fixed = self.basis, np.zeros(self.basis.N, dtype=bool)
        if self.held:
            x, ends = self.basis.doflocs[0], self.section.far
            fixed |= np.abs(np.subtract.outer(x, ends)).min(axis=1) < 1e-9 * (ends[1] - ends[0])
        elif n < 2:
            fixed[basis.nodal_dofs[0, 0]] = True
            if n == 1:
                fixed[basis.nodal_dofs[1, 0]] = True
        if n == 0:  # no twist
            fixed[self._component(2)] = True
        return np.flatnonzero(~fixed)

    def _component(self, k: int) -> Index:
        """Unknowns of displacement component ``k``: axial, radial, circumferential."""
        basis = self.basis
        rows = (basis.nodal_dofs[k], basis.facet_dofs[k], basis.interior_dofs[k])
        return np.concatenate([row.ravel() for row in rows])

    def _rigid(self, n: int) -> Array:
        """Rigid-body motions (m, unknowns): along the axis for n = 0; across it and tilt for 1."""
        if self.held or n > 1:
            return np.zeros((0, self.basis.N))
        moves = np.zeros((1 + n, self.basis.N))
        along, out, around = (self._component(k) for k in range(3))
        if n == 0:
            moves[0, along] = 1.0
            return moves
        moves[0, out], moves[0, around] = 1.0, -1.0
        x, r = self.basis.doflocs
        moves[1, along], moves[1, out], moves[1, around] = r[along], -x[out], x[around]
        return moves

    def _mean(self, n: int, ring: float) -> Array:
        """Rigid-body motions as means over the backing under the ``ring`` there (m, unknowns)."""
        if self.held or n > 1:
            return np.zeros((0, self.basis.N))
        away = np.abs(self.section.corners[0] - ring)
        reach = self.section.half_width * (1.0 + TOUCHING)
        under = (away[self.section.quads] <= reach).all(axis=0) & self.section.backing
        basis = Basis(
            self.basis.mesh, self.basis.elem, elements=np.flatnonzero(under), intorder=ORDER
        )
        forms = (_along,) if n == 0 else (_across, _tilting)
        means = np.stack([LinearForm(form).assemble(basis) for form in forms])
        return np.linalg.solve(means @ self._rigid(n).T, means)


def _lame(material: Material) -> tuple[float, float]:
    """Lamé constants λ and μ [Pa]."""
    nu = material.poisson_ratio
    return 2.0 * material.shear_modulus * nu / (1.0 - 2.0 * nu), material.shear_modulus


def _strains(u: Any, r: Array) -> tuple[list[Array], list[Array]]:
    """Strains (εx, εr, εθ, γxr, γrθ, γxθ): a part independent of n, and one proportional to n."""
    (axial, radial, around), slope = u, u.grad
    zero = 0.0 * r
    constant = [
        slope[0, 0],
        slope[1, 1],
        radial / r,
        slope[0, 1] + slope[1, 0],
        slope[2, 1] - around / r,
        slope[2, 0],
    ]
    return constant, [zero, zero, around / r, zero, -radial / r, -axial / r]


def _stress(strain: Array, first: Array, shear: Array) -> Array:
    """Stresses (q, functions, 6, points) by strains, λ and μ (q, points) times the area."""
    stress = shear[:, None, None] * strain
    stress[:, :, :3] *= 2.0
    stress[:, :, :3] += first[:, None, None] * strain[:, :, :3].sum(axis=2, keepdims=True)
    return stress


def _work(stress: Array, strain: Array) -> Array:
    """Work of the stresses of each function on the strains of each (q, functions, functions)."""
    flat = (*strain.shape[:2], -1)
    return stress.reshape(flat) @ strain.reshape(flat).swapaxes(1, 2)


def _along(v: Any, w: Any) -> Any:
    return w.x[1] * v[0]


def _across(v: Any, w: Any) -> Any:
    return 0.5 * w.x[1] * (v[1] - v[2])


def _tilting(v: Any, w: Any) -> Any:
    return w.x[1] ** 2 * v[0]
