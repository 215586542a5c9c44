"""A few vectors that carry a symmetric vibration problem: modes and static answers to forces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.sparse import Matrix
from rotordyn.numerics.static_answers import Answers, Coupling, completing, made_of_lowest

Array = NDArray[np.float64]
LEAST_MODES = 8
ROUNDING = 1e-14
HALF_DIGIT = np.finfo(float).eps / 2.0
CLEAR, MORE = 1e4, 10.0  # of K's rounding; σ grows in such steps until it is clear of it
SHIFT = 1e-5  # of cutoff²: eigenvalues much below it keep fewer digits


class OutsideNorms(Protocol):
    """What else is known of all that a basis leaves out of a large problem (``flexible``)."""

    @property
    def mass_norm(self) -> float: ...
    def norm(self, matrix: Matrix) -> float: ...
    def behind(self, before: int) -> OutsideNorms: ...


@dataclass(frozen=True, eq=False, slots=True)
class RitzBasis:
    """``vectors`` Φ (n, m) with ΦᵀMΦ = 1 and ΦᵀKΦ = diag(``values``), ascending.

    ``are_modes`` (m,): which of them are eigenvectors; the others are static answers. ``rest``
    (n, r) and ``rest_values``: the eigenvectors that were not kept as such, as far as they are
    known; ``rest_mass`` (r, m): restᵀMΦ, from the loads, since stiff modes meet too little of the
    answers to be seen in their difference. ``rounding`` (m,): how far rounding of the entries of K
    is likely to move the value of each vector: the root of Σ (u K_ij φ_i φ_j)², u half the last
    digit; none for rigid motions. ``shift`` σ: the answers are those of K + σM; of bases side by
    side one for each vector of the rest (r,). ``outside``: of large problems, whose rest holds but
    what the vectors ask of it, what else is known of all that is left out.
    """

    vectors: Array
    values: Array
    are_modes: NDArray[np.bool_]
    rest: Array
    rest_values: Array
    rest_mass: Array
    rounding: Array
    shift: float | Array
    outside: tuple[OutsideNorms, ...] = ()

    @property
    def complement(self) -> Complement:
        """What the vectors leave out, (K + σM)-orthogonal to them: forces that they answer do not
        reach it."""
        root = np.sqrt(self.rest_values + self.shift)[:, None]
        answers = root * self.rest_mass
        added = answers[:, np.abs(answers).max(axis=0, initial=0.0) > 0.0]
        whole = np.linalg.qr(added, mode="complete")[0] if added.size else np.eye(len(root))
        turn = whole[:, added.shape[1] :] / root
        return Complement(self.rest @ turn, turn.T @ turn, turn.T @ self.rest_mass, self.outside)


def side_by_side(bases: Sequence[RitzBasis]) -> RitzBasis:
    """Of problems that nothing couples, as one; the values ascend within each alone."""
    from scipy.linalg import block_diag

    sizes = [len(basis.vectors) for basis in bases]
    return RitzBasis(
        vectors=block_diag(*(basis.vectors for basis in bases)),
        values=np.concatenate([basis.values for basis in bases]),
        are_modes=np.concatenate([basis.are_modes for basis in bases]),
        rest=block_diag(*(basis.rest for basis in bases)),
        rest_values=np.concatenate([basis.rest_values for basis in bases]),
        rest_mass=block_diag(*(basis.rest_mass for basis in bases)),
        rounding=np.concatenate([basis.rounding for basis in bases]),
        shift=np.concatenate([np.full(len(b.rest_values), b.shift) for b in bases]),
        outside=tuple(
            part.behind(before)
            for before, basis in zip(accumulate(sizes, initial=0), bases, strict=False)
            for part in basis.outside
        ),
    )


@dataclass(frozen=True, eq=False, slots=True)
class Complement:
    """``vectors`` Ψ (n, c) with Ψᵀ(K + σM)Ψ = 1 and Ψᵀ(K + σM)Φ = 0; ``mass`` ΨᵀMΨ (c, c) and
    ``coupling`` ΨᵀMΦ (c, m).

    Norms are those of all that is left out, vectors of a large problem that are not here
    included (``outside``)."""

    vectors: Array
    mass: Array
    coupling: Array
    outside: tuple[OutsideNorms, ...] = ()

    @property
    def mass_norm(self) -> float:
        """Of M on vectors of unit stiffness."""
        return max([norm_of(self.mass), *(part.mass_norm for part in self.outside)])

    def norm(self, matrix: Matrix) -> float:
        """Of a semi-definite matrix (n, n), likewise."""
        own = norm_of(self.vectors.T @ (matrix @ self.vectors))
        return max([own, *(part.norm(matrix) for part in self.outside)])

    def reach(self, rows: Matrix) -> float:
        """Of ``rows`` (k, n), likewise."""
        if not self.outside:
            return norm_of(rows @ self.vectors)
        return math.sqrt(self.norm(rows.T @ rows))


def ritz_basis(
    mass: Array,
    stiffness: Array,
    cutoff: float,
    loads: Array,
    rigid: Array,
    couplings: Sequence[Coupling] = (),
) -> RitzBasis:
    """Eigenvectors of K φ = ω² M φ up to ω = ``cutoff``, completed by static answers.

    Those are the answers to ``loads`` (n, l), so that forces on those freedoms meet the right
    flexibility, and to what ``couplings`` make of the lowest modes. The motions ``rigid`` (n, r)
    are known to have no stiffness and are taken as they stand, so that none comes to them by
    rounding of K; M must be positive definite, K at least semi-definite. All is computed from the
    flexible side, (K + σM)⁻¹ M, where stiff freedoms do not drown the slow ones in rounding.
    """
    shift, factor = _definite(mass, stiffness, SHIFT * cutoff**2)
    inverse, vectors = _flexible(mass, factor)
    known = inverse > ROUNDING * inverse[-1]  # others are too stiff to be told apart, or to matter
    inverse, vectors = inverse[known][::-1], vectors[:, known][:, ::-1]
    vectors = _with_rigid(mass, rigid, vectors / np.sqrt(inverse))
    values = np.maximum(1.0 / inverse - shift, 0.0)
    values[: rigid.shape[1]] = 0.0
    kept = max(int(np.searchsorted(values, cutoff**2)), min(LEAST_MODES, len(values)))
    low, rest, rest_values = vectors[:, :kept], vectors[:, kept:], values[kept:]
    low_forces = mass @ (low * values[:kept])

    def answered(loads: Array) -> Answers:
        loads = loads - mass @ (low @ (low.T @ loads))  # what the modes kept do not answer
        answers = np.linalg.solve(factor.T, np.linalg.solve(factor, loads))
        share = (rest.T @ loads) / (rest_values + shift)[:, None]
        return Answers(answers, loads - shift * (mass @ answers), share)

    made = made_of_lowest(couplings, low, values[:kept], cutoff, LEAST_MODES)
    found = completing(mass, (low, low_forces), answered, loads, made)
    values_added, added = found.diagonal()
    both = np.concatenate([values[:kept], values_added])
    order = np.argsort(both, kind="stable")
    whole = np.concatenate([low, added.vectors], axis=1)[:, order]
    rest_mass = np.concatenate([np.zeros((rest.shape[1], kept)), added.share], axis=1)
    spread = np.sqrt(np.einsum("ij,ij->j", whole**2, stiffness**2 @ whole**2))
    return RitzBasis(
        whole,
        both[order],
        order < kept,
        rest,
        rest_values,
        rest_mass[:, order],
        HALF_DIGIT * np.where(np.arange(len(order)) < rigid.shape[1], 0.0, spread),
        shift,
    )


def _with_rigid(mass: Array, rigid: Array, vectors: Array) -> Array:
    """``vectors``, the first of them replaced by the ``rigid`` motions, M-orthonormal in turn.

    The eigensolver leaves stiff ones askew by rounding of the slow.
    """
    return orthonormal(mass, np.concatenate([rigid, vectors[:, rigid.shape[1] :]], axis=1))


def orthonormal(mass: Matrix, vectors: Array) -> Array:
    """Vectors (n, k) made M-orthonormal in turn."""
    factor = np.linalg.cholesky(vectors.T @ (mass @ vectors))
    return np.asarray(np.linalg.solve(factor, vectors.T).T)


def _flexible(mass: Array, factor: Array) -> tuple[Array, Array]:
    """1/λ (n,), ascending, and φ (n, n) of M φ = L Lᵀ φ/λ with L the lower triangular ``factor``,
    φᵀ L Lᵀ φ = 1."""
    half = np.linalg.solve(factor, mass)
    inner = np.linalg.solve(factor, half.T)
    inverse, turned = np.linalg.eigh((inner + inner.T) / 2.0)
    return inverse, np.linalg.solve(factor.T, turned)


def _definite(mass: Array, stiffness: Array, shift: float) -> tuple[float, Array]:
    """σ, from ``shift`` upwards, and Cholesky's L of K + σM, where rounding of K is small beside
    σM.

    Of a cutoff far below all that bends, σ would drown in the rounding of stiff freedoms.
    """
    while True:
        try:
            np.linalg.cholesky(stiffness + shift / CLEAR * mass)
        except np.linalg.LinAlgError:
            shift *= MORE
        else:
            return shift, np.asarray(np.linalg.cholesky(stiffness + shift * mass))


def norm_of(matrix: Array) -> float:
    """Largest singular value; nothing for an empty matrix."""
    return float(np.linalg.norm(matrix, 2)) if matrix.size else 0.0
