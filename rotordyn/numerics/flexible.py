"""The few vectors of a large problem (``reduction``), from its static answers alone.

Eigenvectors come one by one from the flexible side, by Lanczos on K⁺M; that none below the cutoff
was missed is counted (``eigenvalue_count``). All others stay unknown. In their place stand the
vectors by which the problem answers what the kept ones ask of it: inertia, gyroscopic effect, axial
force.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.numerics.eigenvalue_count import count_below
from rotordyn.numerics.reduction import (
    HALF_DIGIT,
    LEAST_MODES,
    RitzBasis,
    orthonormal,
)
from rotordyn.numerics.sparse import Matrix
from rotordyn.numerics.static_answers import (
    Answers,
    Coupling,
    added,
    completing,
    made_of_lowest,
)
from rotordyn.numerics.threads import linear_algebra_alone

Array = NDArray[np.float64]
Answer = Callable[[Array], Array]
BETWEEN = 0.9  # of the way from the last eigenvalue kept to the next, where they are counted
ROUNDS = 3
CLEARLY_NEW = 1e-5, 1e-4, 1e-3, 1e-2  # of their length: what vectors must add to the others
ROUNDING = 1e-6
NEAR = 1e-3  # relative: how well a norm is known
SEED = 1


@dataclass(frozen=True, eq=False, slots=True)
class Problem:
    """K φ = λ M φ of compressed rows (n, n), with motions ``rigid`` (n, r) that have no stiffness.

    ``held`` (n, k) -> (n, k): some x with K x = f of loads f without resultant; ``order`` (n,):
    in which elimination stays narrow.
    """

    mass: Matrix
    stiffness: Matrix
    rigid: Array
    held: Answer
    order: NDArray[np.intp]

    @property
    def size(self) -> int:
        """n."""
        return len(self.rigid)

    def below(self, omega: float) -> int:
        """Eigenvalues below ``omega``²; 0 where they cannot be counted."""
        return self.count(omega**2) or 0

    def count(self, bound: float) -> int | None:
        """Eigenvalues below ``bound``; None where they cannot be counted."""
        return count_below(self.stiffness, self.mass, bound, self.order)


@dataclass(frozen=True, eq=False)
class Flexible:
    """K⁺: the answer, free of ``known`` motions (n, k), to what of a load these do not answer.

    ``known`` are M-orthonormal eigenvectors, rigid motions first; ``pushed`` (n, k) is M · known.
    """

    held: Answer
    known: Array
    pushed: Array

    @classmethod
    def of(cls, problem: Problem, known: Array) -> Flexible:
        return cls(problem.held, known, problem.mass @ known)

    def unanswered(self, load: Array) -> Array:
        """What of a load (n, k) the known motions do not answer."""
        return np.asarray(load - self.pushed @ (self.known.T @ load))

    def free(self, motion: Array) -> Array:
        """A motion (n, k) without its share of the known ones."""
        return np.asarray(motion - self.known @ (self.pushed.T @ motion))

    def __call__(self, load: Array) -> Array:
        return self.free(self.held(self.unanswered(load)))


@dataclass(frozen=True, eq=False)
class Outside:
    """All that a basis leaves out of a large problem, at its ``rows`` of several side by side.

    ``flexible``: by its eigenvectors; ``added`` A (n, l): the answers that it has besides,
    AᵀK A = diag(``values``). ``above``: no eigenvalue left out is lower.
    """

    rows: slice
    flexible: Flexible
    added: Array
    values: Array
    above: float

    def behind(self, before: int) -> Outside:
        """With as many rows ``before`` it."""
        return replace(self, rows=slice(self.rows.start + before, self.rows.stop + before))

    @property
    def mass_norm(self) -> float:
        """Of M on vectors of unit stiffness left out, at most [s²]."""
        return 1.0 / self.above if self.above > 0.0 else np.inf

    def norm(self, matrix: Matrix) -> float:
        """The same of a semi-definite matrix (n of all, n of all)."""
        own = matrix[self.rows][:, self.rows]
        trace = float(own.diagonal().sum())
        if trace == 0.0:
            return 0.0
        start = np.random.default_rng(SEED).standard_normal(own.shape[0])
        found, _ = _lowest(own * np.sign(trace), self._answer, start, 1, NEAR)
        return float((1.0 + 10.0 * NEAR) / found[0])

    def _answer(self, load: Array) -> Array:
        """To a load (n,), of what is left out alone."""
        rest = self.flexible.unanswered(load.reshape(-1, 1))
        answer = self.flexible.free(self.flexible.held(rest))
        answer = answer - self.added @ ((self.added.T @ rest) / self.values[:, None])
        return answer.ravel()


def ritz_basis_of_large(
    problem: Problem,
    cutoff: float,
    loads: Array,
    couplings: Sequence[Coupling] = (),
    fields: Sequence[Matrix] = (),
) -> RitzBasis:
    """As ``reduction.ritz_basis``, with σ = 0 and a rest that is not all there is.

    The rest are Ritz vectors: they hold the answers to all that inertia and ``fields`` (n, n), the
    gyroscopic matrix, unit axial force, make of the vectors.

    Raises
    ------
    InvalidInput : Lanczos and the count of eigenvalues do not agree
    """
    low, values, above = _eigenvectors(problem, cutoff)
    flexible = Flexible.of(problem, low)
    low_forces = flexible.pushed * values

    def answered(loads: Array) -> Answers:
        return _answers(problem, flexible, flexible.unanswered(loads))

    made = made_of_lowest(couplings, low, values, cutoff, LEAST_MODES)
    found = completing(problem.mass, (low, low_forces), answered, loads, made)
    added_values, found = found.diagonal()
    both = np.concatenate([values, added_values])
    order = np.argsort(both, kind="stable")
    known = (
        np.concatenate([low, found.vectors], axis=1),
        np.concatenate([low_forces, found.forces], axis=1),
    )
    vectors = known[0][:, order]
    asked = [problem.mass @ found.vectors, *(field @ vectors for field in fields)]
    rest, rest_values, share = _rest(problem, flexible, known, added_values, asked, above)
    rest_mass = np.concatenate([np.zeros((len(rest_values), len(values))), share], axis=1)
    rounding = HALF_DIGIT * np.sqrt(problem.size) * both[order]
    return RitzBasis(
        vectors,
        both[order],
        order < len(values),
        rest,
        rest_values,
        rest_mass[:, order],
        rounding,
        0.0,
        (Outside(slice(0, problem.size), flexible, found.vectors, added_values, above),),
    )


def _answers(problem: Problem, flexible: Flexible, loads: Array) -> Answers:
    """To loads that the known motions do not answer; of other modes nothing is known."""
    none = np.zeros((0, loads.shape[1]))
    return Answers(flexible.free(problem.held(loads)), loads, none)


def _rest(
    problem: Problem,
    flexible: Flexible,
    known: tuple[Array, Array],
    values: Array,
    asked: Sequence[Array],
    above: float,
) -> tuple[Array, Array, Array]:
    """Ritz vectors (n, r) of the answers added, of ``values`` (l,), and of those to loads
    ``asked``, their values (r,), and RᵀM of the answers added (r, l).

    A value that is not ``above`` shows that vectors were taken for new that rounding tells apart.
    """
    loads = flexible.unanswered(np.concatenate(asked, axis=1))
    loads = loads[:, np.abs(loads).max(axis=0, initial=0.0) > 0.0]
    answers, count = _answers(problem, flexible, loads), len(values)
    already = known[0][:, known[0].shape[1] - count :]
    for new in CLEARLY_NEW:
        more, forces, _ = added(problem.mass, known, answers, new)
        across, own = already.T @ forces, more.T @ forces
        inner = np.block([[np.diag(values), across], [across.T, (own + own.T) / 2.0]])
        rest_values, turn = np.linalg.eigh(inner)
        if (rest_values > above * (1.0 - ROUNDING)).all():
            return np.concatenate([already, more], axis=1) @ turn, rest_values, turn[:count].T
    return already, values, np.eye(count)


def _eigenvectors(problem: Problem, cutoff: float) -> tuple[Array, Array, float]:
    """Rigid motions and eigenvectors up to ω = ``cutoff`` (n, k), their values (k,), and a bound
    that counts as many below it."""
    rigid = orthonormal(problem.mass, problem.rigid)
    still = rigid.shape[1]
    wanted = max(problem.below(cutoff), LEAST_MODES) - still
    for _ in range(ROUNDS):
        vectors, values = _lanczos(problem, Flexible.of(problem, rigid), wanted + 1)
        kept = max(int(np.searchsorted(values, cutoff**2)), LEAST_MODES - still)
        if kept > wanted:
            wanted = kept
            continue
        above = float(values[kept - 1] + BETWEEN * (values[kept] - values[kept - 1]))
        counted = problem.count(above)
        if counted is None or counted == kept + still:
            low = orthonormal(problem.mass, np.concatenate([rigid, vectors[:, :kept]], axis=1))
            proven = 0.0 if counted is None else above
            return low, np.concatenate([np.zeros(still), values[:kept]]), proven
        wanted = max(wanted, counted - still)
    raise InvalidInput(
        "the vibrations of the free rotor cannot be told from one another to the last one: its "
        "sections differ by more than its matrices keep; join or leave out what hardly matters"
    )


def _lanczos(problem: Problem, flexible: Flexible, count: int) -> tuple[Array, Array]:
    """The ``count`` lowest eigenvectors (n, count) that bend, and their values, ascending."""
    start = np.random.default_rng(SEED).standard_normal((problem.size, 1))

    def answer(load: Array) -> Array:
        return flexible(load.reshape(-1, 1)).ravel()

    values, vectors = _lowest(
        problem.mass, answer, flexible(problem.mass @ start).ravel(), count, 0.0
    )
    vectors = flexible.free(vectors[:, np.argsort(values)])
    vectors = orthonormal(problem.mass, vectors)
    inverse = np.einsum("ij,ij->j", vectors, problem.mass @ flexible(problem.mass @ vectors))
    return vectors, 1.0 / inverse


def _lowest(
    mass: Matrix, answer: Answer, start: Array, count: int, tolerance: float
) -> tuple[Array, Array]:
    """λ (count,) and φ (n, count) of the lowest K φ = λ M φ, from ``answer`` (n,) -> (n,)."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    inverse = LinearOperator(mass.shape, matvec=answer, dtype=np.float64)
    with linear_algebra_alone():  # its library of linear algebra may have come just now
        found: tuple[Array, Array] = eigsh(
            mass, count, M=mass, sigma=0.0, OPinv=inverse, v0=start, tol=tolerance
        )
    return found
