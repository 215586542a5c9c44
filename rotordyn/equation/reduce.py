"""Reduction of one uncoupled motion of a free body to its lowest modes and static modes at ports.

The problem K φ = λ M φ has rigid motions R, K R = 0. Held at as many DOF as it has rigid motions
the body is statically determinate and K is positive definite on the others. There elastic modes
obey K y = λ (M − M R Rᵀ M) y with M-orthonormal R, and φ = y − R Rᵀ M y (inertia relief). Their
inverse values 1/λ are computed: stiff DOF give small ones, which do not drown slow modes in
rounding, and rigid motions take no part. Static modes after Craig, *Structural Dynamics* (1981).

Theory: docs/theory/reduction.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rotordyn.allowance import require_free_modes
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.errors import InvalidInput
from rotordyn.numerics.sparse import LARGE, Matrix
from rotordyn.numerics.threads import linear_algebra_alone

LEAST_MODES = 8  # kept whatever the cutoff, rigid ones included
MOST_DENSE = 6000  # DOF; four matrices of that size are 1.2 GB
MOST_ENTRIES = 200_000_000  # of all vectors of a large body, 1.6 GB
ROUNDING = 1e-15  # of a diagonal entry: a smaller pivot is zero
NEW = 1e-10  # of the flexibility at the ports: vectors that add less (1e-5 squared) are dependent
NOTHING = 1e-16  # of the flexibility at a port: a smaller part not in the modes is rounding
RIGIDLY = 1e-13  # of a load: one with a smaller self-equilibrated part moves the body rigidly
TINY = 1e-200  # [s²], keeps a load of zeros from division by zero
STIFF = 1e-8  # of the largest 1/λ: down to here modes above the cutoff are no rounding
PIECE = 8  # vectors at a time: what is computed of all takes much memory in a large body
ROWS = 4096  # of a factorised matrix at a time
FEW = 32  # rows of a triangular matrix that is inverted directly
ASIDE = 1.2345e-7  # relative shift off round values of the cutoff, at which a pivot may vanish
RESOLVED = 1e-14  # of the largest 1/λ: stiffer modes are rounding, and negligible
NEAR = 1e-5  # relative: an eigenvalue this close to the cutoff may count on either side of it


@contextmanager
def _solvable() -> Iterator[None]:
    """Run linear algebra on one thread; refuse a body whose matrices are not definite."""
    try:
        with linear_algebra_alone():  # that of scipy may have been loaded just now
            yield
    except np.linalg.LinAlgError:
        raise InvalidInput(
            "the modes of a free body cannot be computed: a part of it has no mass, is "
            "unconnected, or is so stiff or light that rounding hides it; join it to others or "
            "leave it out"
        ) from None


@dataclass(frozen=True, eq=False, slots=True)
class Basis:
    """Vectors Φ (n, m) with Φᵀ M Φ = 1 and Φᵀ K Φ = diag(``values``) [rad²/s²], ascending.

    ``modes`` (m,): which of them are eigenvectors; the others are static modes. ``roots`` (m, m):
    Φᵀ M √(M⁻¹K) Φ [rad/s], of a large body as if all vectors were modes.
    """

    vectors: Array
    values: Array
    modes: Flags
    roots: Array


class Coupling(NamedTuple):
    """Forces by a ``matrix`` (n, n), such as the gyroscopic one, in rigid motions, modes up to
    ``band`` [rad/s] and, of axial force, in ``statics``: displacements by loads at ports."""

    matrix: Matrix
    band: float
    statics: bool = False


@_solvable()
def reduce(
    mass: Matrix,
    stiffness: Matrix,
    rigid: Array,
    ports: Array,
    cutoff: float,
    couplings: Sequence[Coupling] = (),
) -> Basis:
    """Return modes of a free body up to ω = ``cutoff`` [rad/s] and static modes for ``ports``.

    Parameters
    ----------
    mass, stiffness : ndarray or csr_array, shape (n, n)
        M positive definite; K positive semi-definite, of null space ``rigid``.
    rigid : ndarray, shape (n, r)
        Rigid motions, kept as they stand; their values are 0.
    ports : ndarray, shape (n, p)
        Loads; the vectors hold the static displacement by their self-equilibrated part.
    cutoff : float
        ``LEAST_MODES`` modes are kept in any case, rigid ones included, if there are as many.
    couplings : sequence of Coupling, optional
        The vectors also hold the static displacement by its forces.

    Raises
    ------
    InvalidInput : M or K is not definite, or the vectors asked for do not fit into memory
    """
    size, rigid_count = rigid.shape
    least, below, large = max(LEAST_MODES - rigid_count, 0), 0, False
    if size >= LARGE:
        from scipy.sparse import csr_array

        mass, stiffness = csr_array(mass), csr_array(stiffness)
        shifted = _factors(stiffness - (1.0 - ASIDE) * cutoff**2 * mass)
        below = int((shifted.U.diagonal() < 0.0).sum()) - rigid_count  # Sylvester's law of inertia
        large = size > MOST_DENSE or 8 * max(below, least) < size
    if large and (3 * below + 4 * ports.shape[1]) * size > MOST_ENTRIES:
        raise InvalidInput(
            f"{below} modes and {ports.shape[1]} loads of a body of {size} DOF do not fit into "
            "memory; take lower frequencies or less accuracy, or join sections that are alike"
        )
    require_free_modes(size, below + least if large else None)
    if not large:
        mass, stiffness = (m.toarray() if hasattr(m, "toarray") else m for m in (mass, stiffness))
    body = _Body.held(mass, stiffness, rigid)
    truncated = np.zeros((size, 0)), np.zeros(0)
    if large:
        values, elastic = _by_lanczos(body, below, least, cutoff)
    else:
        values, elastic, truncated = _by_lapack(body, least, cutoff)
    displaced = body.displaced(ports) if any(coupling.statics for coupling in couplings) else ports
    for coupling in couplings:
        motions = [
            body.rigid,
            elastic[:, values <= coupling.band**2],
            *([displaced] if coupling.statics else []),
        ]
        ports = np.hstack([ports, coupling.matrix @ np.hstack(motions)])
    static_values, static = _static_modes(body, values, elastic, ports)
    all_values = np.concatenate([np.zeros(rigid_count), values, static_values])
    vectors, order = np.hstack([body.rigid, elastic, static]), np.argsort(all_values, kind="stable")
    roots, block = np.diag(np.sqrt(all_values)), slice(rigid_count + len(values), None)
    roots[block, block] = _roots(body, static, static_values, truncated)
    swapped = np.ix_(order, order)
    return Basis(
        vectors[:, order], all_values[order], order < rigid_count + len(values), roots[swapped]
    )


@_solvable()
def enriched(
    mass: Matrix, stiffness: Matrix, rigid: Array, known: Array, couplings: Sequence[Coupling] = ()
) -> Basis:
    """Return a large body in the span of vectors ``known`` (n, k) of a coarser model, without rigid
    motions, and of one step of inverse iteration from each; ``known`` is overwritten.

    The step represents what a vector φ lacks, M φ − K φ/λ with its Rayleigh quotient λ. So where
    the coarser model errs by δ, this one errs by δ². By ``reduce`` a Campbell diagram of a shaft of
    60 to 10 000 sections takes 1.05 to 1.8 times as long.
    """
    body = _Body.held(mass, stiffness, rigid)
    motions = _iterated(body, stiffness, known, couplings)
    pieces = _pieces(motions.shape[1])
    energy = np.hstack([motions.T @ (stiffness @ motions[:, at]) for at in pieces])
    motions = body.independent(motions, energy, np.maximum(energy.diagonal(), 0.0))
    rigid = body.rigid
    del body  # frees its factors, which are as large as the root of the mass matrix
    values, motions = _normalised(_root(mass), motions)
    values = np.concatenate([np.zeros(rigid.shape[1]), values])
    modes = np.ones(len(values), dtype=bool)
    return Basis(np.hstack([rigid, motions]), values, modes, np.diag(np.sqrt(values)))


def _iterated(body: _Body, stiffness: Matrix, known: Array, couplings: Sequence[Coupling]) -> Array:
    """Return the vectors ``known`` (n, k) and a step of inverse iteration from each."""
    known -= body.rigid @ (body.mass_rigid.T @ known)
    energy, inertia = (np.einsum("nk,nk->k", known, m @ known) for m in (stiffness, body.mass))
    values, end = energy / inertia, known.shape[1]
    sources = [np.hstack([body.rigid, known[:, values <= c.band**2]]) for c in couplings]

    def loads() -> Iterator[Array]:
        for at in _pieces(len(values)):
            yield body.mass @ known[:, at] - stiffness @ known[:, at] / values[at]
        for coupling, source in zip(couplings, sources, strict=True):
            yield coupling.matrix @ source

    motions = np.empty((len(known), 2 * end + sum(source.shape[1] for source in sources)))
    motions[:, :end] = known
    for load in loads():
        start, end = end, end + load.shape[1]
        motions[:, start:end] = body.displaced(load)
    return motions


def _roots(body: _Body, static: Array, values: Array, rest: tuple[Array, Array]) -> Array:
    """Return √(M⁻¹K) on static modes (n, s) of ``values``, made of the modes ``rest`` of
    ``_by_lapack``; their remainder counts as a mode. Rigid motions have no part in static modes."""
    vectors, omega = rest
    if not len(omega):
        return np.diag(np.sqrt(values))
    share = omega[:, None] * (vectors.T @ (body.inverse_factor @ (body.mass @ static)[body.free]))
    remainder = np.clip(1.0 - (share**2).sum(axis=0), 0.0, 1.0)
    return np.asarray(share.T @ (omega[:, None] * share) + np.diag(remainder * np.sqrt(values)))


@dataclass(frozen=True, eq=False)
class _Body:
    """A body whose DOF are ``free`` except those that hold it.

    ``rigid`` R (n, r): Rᵀ M R = 1; ``mass_rigid``: M R. ``solve``: y (n − r, k) of K y = f on the
    free DOF; ``inverse_factor`` L⁻¹: L Lᵀ = K there, empty of a sparse K.
    """

    mass: Matrix
    rigid: Array
    mass_rigid: Array
    free: Indices
    inverse_factor: Array
    solve: Callable[[Array], Array]

    @classmethod
    def held(cls, mass: Matrix, stiffness: Matrix, rigid: Array) -> _Body:
        """Return the body held at the DOF that hold it best."""
        factor = np.linalg.cholesky(rigid.T @ (mass @ rigid))
        rigid = np.asarray(np.linalg.solve(factor, rigid.T).T)
        free = np.delete(np.arange(len(rigid)), _holding(rigid, np.sqrt(abs(mass.diagonal()))))
        mass_rigid, stiff = mass @ rigid, stiffness[free][:, free]
        if isinstance(mass, np.ndarray):
            lower = np.linalg.cholesky(stiff)
            _refuse_singular(lower.diagonal() ** 2, stiff)
            inverse_factor = _inverse(lower)

            def solve(load: Array) -> Array:
                return np.asarray(inverse_factor.T @ (inverse_factor @ load))

            return cls(mass, rigid, mass_rigid, free, inverse_factor, solve)
        factors = _factors(stiff)
        _refuse_singular(factors.U.diagonal()[factors.perm_c], stiff)
        return cls(mass, rigid, mass_rigid, free, np.zeros((0, 0)), factors.solve)

    @cached_property
    def root(self) -> Matrix:
        """Upper triangular root U of the mass matrix, Uᵀ U = M."""
        return _root(self.mass)

    def elastic(self, motions: Array) -> Array:
        """Return motions (n, k), without rigid ones, from those (n − r, k) of the free DOF."""
        motion = np.zeros((len(self.rigid), motions.shape[1]))
        motion[self.free] = motions
        motion -= self.rigid @ (self.mass_rigid.T @ motion)
        return motion

    def displaced(self, loads: Array) -> Array:
        """Return elastic displacements (n, k) by the self-equilibrated part of ``loads`` (n, k)."""
        loads = loads - self.mass_rigid @ (self.rigid.T @ loads)
        return self.elastic(self.solve(loads[self.free]))

    def independent(self, motions: Array, energy: Array, size: Array) -> Array:
        """Return combinations of ``motions`` V (n, k) with energy Vᵀ K V = 1, of ``energy`` (k, k);
        those with less than ``NEW`` of the ``size`` (k,) of each are omitted."""
        scale = (size + TINY) ** -0.5
        share, vectors = np.linalg.eigh(scale[:, None] * (energy + energy.T) / 2.0 * scale)
        possible = np.arange(len(share)) >= len(share) - len(self.free)  # no more than DOF
        new = (share > NEW) & possible
        return np.asarray(motions @ (scale[:, None] * vectors[:, new] / np.sqrt(share[new])))


def _pieces(count: int) -> list[slice]:
    """Return slices of at most ``PIECE`` of ``count`` vectors."""
    return [slice(start, start + PIECE) for start in range(0, count, PIECE)]


def _root(mass: Matrix) -> Matrix:
    """Return the upper triangular root U of a mass matrix, Uᵀ U = M."""
    if isinstance(mass, np.ndarray):
        return np.linalg.cholesky(mass).T
    from scipy.sparse import diags_array

    factors = _factors(mass)
    upper, pivots = factors.U.tocsr()[:, factors.perm_c], factors.U.diagonal()
    if pivots.min() <= 0.0:
        raise np.linalg.LinAlgError
    return diags_array(pivots**-0.5) @ upper


def _normalised(root: Matrix, motions: Array) -> tuple[Array, Array]:
    """Return values and vectors of the span of ``motions`` V (n, k), Vᵀ K V = 1.

    They are the singular values of U V, with the ``root`` U; small ones keep as many digits as
    large ones.
    """
    upper: Array = np.zeros((0, motions.shape[1]))
    for start in range(0, len(motions), ROWS):  # a product of all takes much memory
        rows = root[start : start + ROWS] @ motions
        upper = np.asarray(np.linalg.qr(np.concatenate([upper, rows]), mode="r"))
    _, size, right = np.linalg.svd(upper)
    return size**-2, motions @ (right.T / size)


def _holding(rigid: Array, scale: Array) -> list[int]:
    """Return DOF that hold a body with the motions ``rigid`` (n, r), as independent as possible;
    each in its ``scale`` (n,)."""
    remaining, chosen = rigid * scale[:, None], list[int]()
    for _ in range(rigid.shape[1]):
        size = (remaining**2).sum(axis=1)
        chosen.append(int(size.argmax()))
        row = remaining[chosen[-1]] / np.sqrt(size[chosen[-1]])
        remaining = remaining - np.outer(remaining @ row, row)
    return chosen


def _by_lapack(body: _Body, least: int, cutoff: float) -> tuple[Array, Array, tuple[Array, Array]]:
    """Return elastic modes up to the cutoff, at least ``least``: values (k,), vectors (n, k); and
    of those above y (n − r, k) and ω [rad/s]: their vectors are L⁻ᵀ y ω without rigid motions."""
    mass_rigid = body.mass_rigid[body.free]
    inertia = body.mass[body.free][:, body.free] - mass_rigid @ mass_rigid.T
    inner = body.inverse_factor @ inertia @ body.inverse_factor.T  # L⁻¹ (M − M R Rᵀ M) L⁻ᵀ
    inverse, vectors = np.linalg.eigh((inner + inner.T) / 2.0)
    lowest = np.arange(len(inverse))[::-1] < least
    clear = inverse > STIFF * inverse.max(initial=0.0)
    kept = (inverse * cutoff**2 > 1.0) | (lowest & clear)
    truncated = ~kept & (inverse > RESOLVED * inverse.max(initial=0.0))
    modes = _normalised(body.root, body.elastic(body.inverse_factor.T @ vectors[:, kept]))
    return *modes, (vectors[:, truncated], inverse[truncated] ** -0.5)


def _by_lanczos(body: _Body, below: int, least: int, cutoff: float) -> tuple[Array, Array]:
    """Return elastic modes as ``_by_lapack``, of which ``below`` lie below the cutoff."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    transposed = body.root.T.tocsr()

    def inverse_times(motion: Array) -> Array:  # U K⁻¹ Uᵀ, of the eigenvalues 1/ω²
        return np.asarray(body.root @ body.displaced((transposed @ motion)[:, None])).ravel()

    inverse = LinearOperator(body.mass.shape, matvec=inverse_times, dtype=np.float64)
    start = inverse_times(np.random.default_rng(1).standard_normal(len(body.rigid)))
    count = max(below, least)
    squares, modes = eigsh(inverse, count, v0=start)
    order = np.argsort(-squares)
    squares, modes = squares[order], modes[:, order]
    if (
        squares * (1.0 + NEAR) * max(cutoff**2, 1.0 / squares[0]) > 1.0
    ).sum() < below:  # one is missed
        raise np.linalg.LinAlgError
    return 1.0 / squares, body.displaced(transposed @ modes) / squares


def _static_modes(body: _Body, values: Array, elastic: Array, ports: Array) -> tuple[Array, Array]:
    """Return what displacements by ``ports`` add to ``elastic`` modes (n, k) of ``values`` (k,)."""
    balanced = np.abs(ports - body.mass_rigid @ (body.rigid.T @ ports)).max(axis=0, initial=0.0)
    ports = ports[:, balanced > RIGIDLY * np.abs(ports).max(axis=0, initial=0.0)]
    inertia, response = body.mass @ elastic, elastic.T @ ports
    loads = ports - inertia @ response
    motions = body.displaced(loads)
    motions -= elastic @ (inertia.T @ motions)
    remainder = (motions * loads).sum(axis=0)
    flexibility = np.maximum(remainder, NOTHING * (response**2 / values[:, None]).sum(axis=0))
    motions = body.independent(motions, motions.T @ loads, flexibility)
    return _normalised(body.root, motions - elastic @ (inertia.T @ motions))


def _refuse_singular(pivots: Array, matrix: Matrix) -> None:
    """Raise LinAlgError if a pivot (n,) is rounding: a part of the body is free."""
    if (pivots <= ROUNDING * matrix.diagonal()).any():
        raise np.linalg.LinAlgError


def _inverse(lower: Array) -> Array:
    """Return the inverse of a lower triangular matrix, by halves: half the time of a general
    inverse, of large ones a fifth."""
    if len(lower) <= FEW:
        return np.asarray(np.linalg.inv(lower))
    half, inverse = len(lower) // 2, np.zeros_like(lower)
    first = inverse[:half, :half] = _inverse(lower[:half, :half])
    last = inverse[half:, half:] = _inverse(lower[half:, half:])
    inverse[half:, :half] = -last @ (lower[half:, :half] @ first)
    return inverse


def _factors(matrix: Matrix) -> Any:
    """Return sparse L U of a symmetric matrix, pivots on its diagonal; LinAlgError if one is 0."""
    from scipy.sparse.linalg import splu

    options = {"SymmetricMode": True, "Equil": False}
    try:
        # panels of one column are a third faster in a band
        factors = splu(matrix.tocsc(), "MMD_AT_PLUS_A", 0.0, panel_size=1, options=options)
    except RuntimeError:
        raise np.linalg.LinAlgError from None
    if (factors.perm_r != factors.perm_c).any():
        raise np.linalg.LinAlgError
    return factors
