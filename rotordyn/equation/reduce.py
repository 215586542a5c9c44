"""One uncoupled motion of a free body in a few vectors: its lowest modes, static modes at ports.

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

LEAST_MODES = 8
MOST_DENSE = 6000  # DOF; four matrices of that size are 1.2 GB
MOST_ENTRIES = 200_000_000  # of all vectors of a large body, 1.6 GB
ROUNDING = 1e-15  # of a diagonal entry: a pivot that small is zero
NEW = 1e-10  # of the flexibility at the ports: vectors that add less (1e-5 squared) are dependent
NOTHING = 1e-16  # of the flexibility at a port: modes that lack so little lack rounding
RIGIDLY = 1e-13  # of a load: with less beside inertia it moves the body rigidly
TINY = 1e-200  # [s²], keeps a load of zeros from division by zero
STIFF = 1e-8  # of the largest 1/λ: modes above the cutoff are told from rounding down to here
FEW = 32  # rows of a triangular matrix that is inverted as any other
ASIDE = 1.2345e-7  # relative, from round values of the cutoff, at which a pivot may vanish
RESOLVED = 1e-14  # of the largest 1/λ: stiffer modes are rounding, and matter to nobody
NEAR = 1e-5  # relative: an eigenvalue so near the cutoff may be counted on either side of it


@contextmanager
def _solvable() -> Iterator[None]:
    """Linear algebra on one thread; a body whose matrices are not definite is refused."""
    try:
        with linear_algebra_alone():  # that of scipy may have been loaded just now
            yield
    except np.linalg.LinAlgError:
        raise InvalidInput(
            "the modes of a free body cannot be computed: a part of it has no mass, is held by "
            "nothing, or is stiff or light beyond the digits of its matrices; join it to others "
            "or leave it out"
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
    """Forces that ``matrix`` (n, n), such as the gyroscopic one, makes of rigid motions, of modes
    up to ``band`` [rad/s] and, of axial force, of ``statics``: displacements by loads at ports."""

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
    """Modes of a free body up to ω = ``cutoff`` [rad/s] and static modes for loads ``ports``.

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
    size, still = rigid.shape
    least, below, large = max(LEAST_MODES - still, 0), 0, False
    if size >= LARGE:
        from scipy.sparse import csr_array

        mass, stiffness = csr_array(mass), csr_array(stiffness)
        shifted = _factors(stiffness - (1.0 - ASIDE) * cutoff**2 * mass)
        below = int((shifted.U.diagonal() < 0.0).sum()) - still  # Sylvester's law of inertia
        large = size > MOST_DENSE or 8 * max(below, least) < size
    if large and (3 * below + 4 * ports.shape[1]) * size > MOST_ENTRIES:
        raise InvalidInput(
            f"{below} modes and {ports.shape[1]} loads of a body of {size} DOF do not fit into "
            "memory; ask for lower frequencies or less accuracy, or join sections that are alike"
        )
    require_free_modes(size, below + least if large else None)
    if not large:
        mass, stiffness = (m.toarray() if hasattr(m, "toarray") else m for m in (mass, stiffness))
    body = _Body.held(mass, stiffness, rigid)
    rest = np.zeros((size, 0)), np.zeros(0)
    if large:
        values, elastic = _by_lanczos(body, below, least, cutoff)
    else:
        values, elastic, rest = _by_lapack(body, least, cutoff)
    moved = body.displaced(ports) if any(each.statics for each in couplings) else ports
    for each in couplings:
        swung = [body.rigid, elastic[:, values <= each.band**2], *([moved] if each.statics else [])]
        ports = np.hstack([ports, each.matrix @ np.hstack(swung)])
    static_values, static = _static_modes(body, values, elastic, ports)
    every = np.concatenate([np.zeros(still), values, static_values])
    vectors, order = np.hstack([body.rigid, elastic, static]), np.argsort(every, kind="stable")
    roots, made = np.diag(np.sqrt(every)), slice(still + len(values), None)
    roots[made, made] = _roots(body, static, static_values, rest)
    swapped = np.ix_(order, order)
    return Basis(vectors[:, order], every[order], order < still + len(values), roots[swapped])


@_solvable()
def enriched(
    mass: Matrix,
    stiffness: Matrix,
    rigid: Array,
    known: Array,
    couplings: Sequence[Coupling] = (),
) -> Basis:
    """A large body in the span of vectors ``known`` (n, k) of a coarser model, without rigid
    motions, and of one step of inverse iteration from each.

    The step answers what a vector φ lacks, M φ − K φ/λ with its Rayleigh quotient λ. So where the
    coarser model errs by δ, this one errs by δ². A study takes 1.1 times as long by ``reduce``.
    """
    body = _Body.held(mass, stiffness, rigid)
    known = known - body.rigid @ (body.pushed.T @ known)
    pushed, pulled = mass @ known, stiffness @ known
    values = (known * pulled).sum(axis=0) / (known * pushed).sum(axis=0)
    lacking = [pushed - pulled / values]
    for each in couplings:
        swung = np.hstack([body.rigid, known[:, values <= each.band**2]])
        lacking.append(each.matrix @ swung)
    motions = np.hstack([known, body.displaced(np.hstack(lacking))])
    energy = motions.T @ (stiffness @ motions)
    size = np.maximum(energy.diagonal(), 0.0)
    values, elastic = body.normalised(body.independent(motions, energy, size))
    every = np.concatenate([np.zeros(rigid.shape[1]), values])
    vectors, modes = np.hstack([body.rigid, elastic]), np.ones(len(every), dtype=bool)
    return Basis(vectors, every, modes, np.diag(np.sqrt(every)))


def _roots(body: _Body, static: Array, values: Array, rest: tuple[Array, Array]) -> Array:
    """√(M⁻¹K) on static modes (n, s) of ``values``, made of the modes ``rest`` of ``_by_lapack``;
    what these do not make up is taken for a mode. Rigid motions have no part in static modes."""
    turn, omega = rest
    if not len(omega):
        return np.diag(np.sqrt(values))
    share = omega[:, None] * (turn.T @ (body.upwards @ (body.mass @ static)[body.free]))
    lacking = np.clip(1.0 - (share**2).sum(axis=0), 0.0, 1.0)
    return np.asarray(share.T @ (omega[:, None] * share) + np.diag(lacking * np.sqrt(values)))


@dataclass(frozen=True, eq=False)
class _Body:
    """A body whose DOF are ``free`` but for those that hold it.

    ``rigid`` R (n, r): Rᵀ M R = 1; ``pushed``: M R. ``solve``: y (n − r, k)
    of K y = f on the free DOF; ``upwards`` L⁻¹: L Lᵀ = K there, empty of a sparse K.
    """

    mass: Matrix
    rigid: Array
    pushed: Array
    free: Indices
    upwards: Array
    solve: Callable[[Array], Array]

    @classmethod
    def held(cls, mass: Matrix, stiffness: Matrix, rigid: Array) -> _Body:
        """At the DOF that hold it best."""
        size = np.linalg.cholesky(rigid.T @ (mass @ rigid))
        rigid = np.asarray(np.linalg.solve(size, rigid.T).T)
        free = np.delete(np.arange(len(rigid)), _holding(rigid, np.sqrt(abs(mass.diagonal()))))
        pushed, stiff = mass @ rigid, stiffness[free][:, free]
        if isinstance(mass, np.ndarray):
            lower = np.linalg.cholesky(stiff)
            _refuse_singular(lower.diagonal() ** 2, stiff)
            upwards = _inverse(lower)

            def solve(load: Array) -> Array:
                return np.asarray(upwards.T @ (upwards @ load))

            return cls(mass, rigid, pushed, free, upwards, solve)
        held = _factors(stiff)
        _refuse_singular(held.U.diagonal()[held.perm_c], stiff)
        return cls(mass, rigid, pushed, free, np.zeros((0, 0)), held.solve)

    @cached_property
    def root(self) -> Matrix:
        """Upper triangular root U of the mass matrix, Uᵀ U = M."""
        if isinstance(self.mass, np.ndarray):
            return np.linalg.cholesky(self.mass).T
        from scipy.sparse import diags_array

        factors = _factors(self.mass)
        upper, pivots = factors.U.tocsr()[:, factors.perm_c], factors.U.diagonal()
        if pivots.min() <= 0.0:
            raise np.linalg.LinAlgError
        return diags_array(pivots**-0.5) @ upper

    def elastic(self, motions: Array) -> Array:
        """Motions (n, k) of those (n − r, k) of the free DOF, without rigid ones."""
        every = np.zeros((len(self.rigid), motions.shape[1]))
        every[self.free] = motions
        return np.asarray(every - self.rigid @ (self.pushed.T @ every))

    def displaced(self, loads: Array) -> Array:
        """Elastic displacements (n, k) by the self-equilibrated part of ``loads`` (n, k)."""
        loads = loads - self.pushed @ (self.rigid.T @ loads)
        return self.elastic(self.solve(loads[self.free]))

    def independent(self, motions: Array, energy: Array, size: Array) -> Array:
        """Combinations of ``motions`` V (n, k) with energy Vᵀ K V = 1, of ``energy`` (k, k); less
        than ``NEW`` beside the ``size`` (k,) of each is none."""
        scale = (size + TINY) ** -0.5
        share, turn = np.linalg.eigh(scale[:, None] * (energy + energy.T) / 2.0 * scale)
        most = np.arange(len(share)) >= len(share) - len(self.free)  # no more than DOF
        new = (share > NEW) & most
        return np.asarray(motions @ (scale[:, None] * turn[:, new] / np.sqrt(share[new])))

    def normalised(self, motions: Array) -> tuple[Array, Array]:
        """Values and vectors of the span of ``motions`` V (n, k), Vᵀ K V = 1.

        They are the singular values of U V; small ones keep as many digits as large ones."""
        _, size, turn = np.linalg.svd(np.linalg.qr(self.root @ motions, mode="r"))
        return size**-2, motions @ (turn.T / size)


def _holding(rigid: Array, scale: Array) -> list[int]:
    """DOF that hold a body with the motions ``rigid`` (n, r), as far apart as they are; each in
    its ``scale`` (n,)."""
    rest, chosen = rigid * scale[:, None], list[int]()
    for _ in range(rigid.shape[1]):
        size = (rest**2).sum(axis=1)
        chosen.append(int(size.argmax()))
        row = rest[chosen[-1]] / np.sqrt(size[chosen[-1]])
        rest = rest - np.outer(rest @ row, row)
    return chosen


def _by_lapack(body: _Body, least: int, cutoff: float) -> tuple[Array, Array, tuple[Array, Array]]:
    """Elastic modes up to the cutoff, so many at ``least``: values (k,), vectors (n, k); and
    of those above y (n − r, k) and ω [rad/s]: their vectors are L⁻ᵀ y ω without rigid motions."""
    pushed = body.pushed[body.free]
    inertia = body.mass[body.free][:, body.free] - pushed @ pushed.T
    inner = body.upwards @ inertia @ body.upwards.T  # L⁻¹ (M − M R Rᵀ M) L⁻ᵀ
    inverse, turn = np.linalg.eigh((inner + inner.T) / 2.0)
    lowest = np.arange(len(inverse))[::-1] < least
    clear = inverse > STIFF * inverse.max(initial=0.0)
    kept = (inverse * cutoff**2 > 1.0) | (lowest & clear)
    rest = ~kept & (inverse > RESOLVED * inverse.max(initial=0.0))
    modes = body.normalised(body.elastic(body.upwards.T @ turn[:, kept]))
    return *modes, (turn[:, rest], inverse[rest] ** -0.5)


def _by_lanczos(body: _Body, below: int, least: int, cutoff: float) -> tuple[Array, Array]:
    """The same, so many known to be ``below`` the cutoff."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    back = body.root.T.tocsr()

    def turned(motion: Array) -> Array:  # U K⁻¹ Uᵀ, of the eigenvalues 1/ω²
        return np.asarray(body.root @ body.displaced((back @ motion)[:, None])).ravel()

    inverse = LinearOperator(body.mass.shape, matvec=turned, dtype=np.float64)
    start = turned(np.random.default_rng(1).standard_normal(len(body.rigid)))
    wanted = max(below, least)
    squares, modes = eigsh(inverse, wanted, v0=start)
    order = np.argsort(-squares)
    squares, modes = squares[order], modes[:, order]
    if (
        squares * (1.0 + NEAR) * max(cutoff**2, 1.0 / squares[0]) > 1.0
    ).sum() < below:  # one is missed
        raise np.linalg.LinAlgError
    return 1.0 / squares, body.displaced(back @ modes) / squares


def _static_modes(body: _Body, values: Array, elastic: Array, ports: Array) -> tuple[Array, Array]:
    """What displacements by ``ports`` add to ``elastic`` modes (n, k) of ``values`` (k,)."""
    bending = np.abs(ports - body.pushed @ (body.rigid.T @ ports)).max(axis=0, initial=0.0)
    ports = ports[:, bending > RIGIDLY * np.abs(ports).max(axis=0, initial=0.0)]
    pushed, answer = body.mass @ elastic, elastic.T @ ports
    loads = ports - pushed @ answer
    motions = body.displaced(loads)
    motions -= elastic @ (pushed.T @ motions)
    lacking = (motions * loads).sum(axis=0)
    flexibility = np.maximum(lacking, NOTHING * (answer**2 / values[:, None]).sum(axis=0))
    motions = body.independent(motions, motions.T @ loads, flexibility)
    return body.normalised(motions - elastic @ (pushed.T @ motions))


def _refuse_singular(pivots: Array, matrix: Matrix) -> None:
    """Raise LinAlgError where a pivot (n,) is rounding: a part of the body is held by nothing."""
    if (pivots <= ROUNDING * matrix.diagonal()).any():
        raise np.linalg.LinAlgError


def _inverse(lower: Array) -> Array:
    """Of a lower triangular matrix, by halves: half the time of a general inverse, of large ones a
    fifth."""
    if len(lower) <= FEW:
        return np.asarray(np.linalg.inv(lower))
    half, inverse = len(lower) // 2, np.zeros_like(lower)
    first = inverse[:half, :half] = _inverse(lower[:half, :half])
    last = inverse[half:, half:] = _inverse(lower[half:, half:])
    inverse[half:, :half] = -last @ (lower[half:, :half] @ first)
    return inverse


def _factors(matrix: Matrix) -> Any:
    """Sparse L U of a symmetric matrix, pivots on its diagonal; LinAlgError where one vanishes."""
    from scipy.sparse.linalg import splu

    options = {"SymmetricMode": True, "Equil": False}
    try:
        factors = splu(matrix.tocsc(), "MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    except RuntimeError:
        raise np.linalg.LinAlgError from None
    if (factors.perm_r != factors.perm_c).any():
        raise np.linalg.LinAlgError
    return factors
