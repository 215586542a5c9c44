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
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, LinearForm, MeshQuad

from bearings.arrays import Array, Index
from bearings.flexible_rings.section import Section
from bearings.materials import Material

ORDER = 5  # of the quadrature, which is exact for the energy of straight elements but for 1/r
POINTS = 24  # along a patch


@dataclass(frozen=True, eq=False)
class Body:
    """A section with its materials, ``held`` at its far ends or nowhere: then it moves against the
    mean motion of its backing under the ring."""

    section: Section
    material: Material
    backing: Material
    held: bool

    @cached_property
    def basis(self) -> Any:
        """Three fields over the section."""
        mesh = MeshQuad(self.section.corners, self.section.quads)
        return Basis(mesh, ElementVector(ElementQuad2(), 3), intorder=ORDER)

    @cached_property
    def stiffness(self) -> tuple[csc_matrix, ...]:
        """K₀, K₁, K₂ per radian."""
        first, shear = (
            np.where(self.section.backing, back, ring)[:, None]
            for ring, back in zip(_lame(self.material), _lame(self.backing), strict=True)
        )
        parts = (_constant, _linear, _quadratic)
        given = {"first": first, "shear": shear}
        wide = {k: np.broadcast_to(v, self.basis.dx.shape) for k, v in given.items()}
        return tuple(BilinearForm(part).assemble(self.basis, **wide).tocsc() for part in parts)

    def responses(self, loads: Array, harmonics: Sequence[int]) -> Array:
        """What unit loads at θ = 0 do to one another (harmonics, k, k) [m/N], by each harmonic n.

        ``loads`` (k, unknowns): each as weights of the displacements that it works on.
        """
        found = np.empty((len(harmonics), len(loads), len(loads)))
        for place, n in enumerate(harmonics):
            balanced = loads - loads @ self._rigid(n).T @ self._mean(n)
            free = self._free(n)
            whole = self.stiffness[0] + n * self.stiffness[1] + n * n * self.stiffness[2]
            part = ((2.0 if n == 0 else 1.0) * math.pi * whole[free][:, free]).tocsc()
            factors = splu(
                part, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=_SYMMETRIC
            )
            response = balanced[:, free] @ factors.solve(balanced[:, free].T.copy())
            found[place] = 0.5 * (response + response.T)
        return found

    def patch(self, arc: int, angle: float, half_length: float) -> Array:
        """Mean axial and radial displacement (2, unknowns) over a parabola of a ``half_length`` [m]
        along the groove, its middle at φ = ``angle``."""
        corners, at, _ = self.section.arcs[arc]
        node, weight = np.polynomial.legendre.leggauss(POINTS)
        share = 0.75 * weight * (1.0 - node**2)
        phi = angle + node * half_length / self.section.radius
        place = np.clip(np.searchsorted(at, phi) - 1, 0, len(at) - 2)
        t = (phi - at[place]) / (at[place + 1] - at[place])
        shapes = ((1.0 - t) * (1.0 - 2.0 * t), t * (2.0 * t - 1.0), 4.0 * t * (1.0 - t))
        basis, facet = self.basis, self._facets
        edge = np.array([facet[tuple(sorted(pair))] for pair in _pairs(corners)])
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
        return {(*sorted(map(int, pair)),): k for k, pair in enumerate(self.basis.mesh.facets.T)}

    def _free(self, n: int) -> Index:
        """Unknowns that are solved for; of a body that is held nowhere all but those that fix where
        it is, to which balanced loads are blind."""
        basis, held = self.basis, np.zeros(self.basis.N, dtype=bool)
        corners, x = self.section.corners, self.basis.doflocs[0]
        if self.held:
            far = np.abs(corners[0, self.section.far]).max()
            held |= np.abs(np.abs(x) - far) < 1e-9 * far
        elif n < 2:
            held[basis.nodal_dofs[0, 0]] = True
            if n == 1:
                held[basis.nodal_dofs[1, 0]] = True
        if n == 0:  # no twist
            held[self._component(2)] = True
        return np.flatnonzero(~held)

    def _component(self, k: int) -> Index:
        basis = self.basis
        rows = (basis.nodal_dofs[k], basis.facet_dofs[k], basis.interior_dofs[k])
        return np.concatenate([row.ravel() for row in rows])

    def _rigid(self, n: int) -> Array:
        """Motions of the body as a whole (m, unknowns): along the axis; across it, and tilting."""
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

    def _mean(self, n: int) -> Array:
        """The same motions as means over the backing under the ring (m, unknowns)."""
        if self.held or n > 1:
            return np.zeros((0, self.basis.N))
        x = self.section.corners[0]
        reach = np.abs(x[self.section.seat]).max() * (1.0 + 1e-9)
        quads = self.section.quads
        under = (np.abs(x[quads]) <= reach).all(axis=0) & self.section.backing
        basis = Basis(
            self.basis.mesh, self.basis.elem, elements=np.flatnonzero(under), intorder=ORDER
        )
        forms = (_along,) if n == 0 else (_across, _tilting)
        means = np.stack([LinearForm(form).assemble(basis) for form in forms])
        return np.asarray(means / (means * self._rigid(n)).sum(axis=1, keepdims=True))


_SYMMETRIC = {"SymmetricMode": True}


def _pairs(corners: Index) -> list[tuple[int, int]]:
    return [(int(a), int(b)) for a, b in pairwise(corners)]


def _lame(material: Material) -> tuple[float, float]:
    """λ and μ [Pa]."""
    nu = material.poisson_ratio
    return 2.0 * material.shear_modulus * nu / (1.0 - 2.0 * nu), material.shear_modulus


def _strains(u: Any, r: Any) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """(εx, εr, εθ, γxr, γrθ, γxθ): what does not depend on n, and what is proportional to it."""
    axial, radial, around, slope = u[0], u[1], u[2], u.grad
    zero = 0.0 * r
    still = (
        slope[0, 0],
        slope[1, 1],
        radial / r,
        slope[0, 1] + slope[1, 0],
        slope[2, 1] - around / r,
        slope[2, 0],
    )
    return still, (zero, zero, around / r, zero, -radial / r, -axial / r)


def _work(a: tuple[Any, ...], b: tuple[Any, ...], w: Any) -> Any:
    """Stress of one strain on another, times r."""
    swelling = (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2])
    stretch = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    shear = a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
    return w.x[1] * (w["first"] * swelling + w["shear"] * (2.0 * stretch + shear))


def _constant(u: Any, v: Any, w: Any) -> Any:
    return _work(_strains(u, w.x[1])[0], _strains(v, w.x[1])[0], w)


def _linear(u: Any, v: Any, w: Any) -> Any:
    (a, b), (c, d) = _strains(u, w.x[1]), _strains(v, w.x[1])
    return _work(a, d, w) + _work(b, c, w)


def _quadratic(u: Any, v: Any, w: Any) -> Any:
    return _work(_strains(u, w.x[1])[1], _strains(v, w.x[1])[1], w)


def _along(v: Any, w: Any) -> Any:
    return w.x[1] * v[0]


def _across(v: Any, w: Any) -> Any:
    return 0.5 * w.x[1] * (v[1] - v[2])


def _tilting(v: Any, w: Any) -> Any:
    return w.x[1] ** 2 * v[0]
