"""Eigenvalues of q̈ + D q̇ + K q = f of many systems at once, and receptances as sums over them."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from rotordyn.arrays import Array, Complex, Flags, Indices, Matrix
from rotordyn.numerics.conservative import conservative_modes
from rotordyn.numerics.lightly_damped import lightly_damped_modes
from rotordyn.numerics.products import times
from rotordyn.numerics.threads import in_threads

NOISE = 1e-7  # of the highest natural frequency: a zero pole after rounding, at most
HELD = 1e-13  # of a coordinate's own stiffness: a motion with less is free
STRAIGHT = 1e-6  # of |pole|: with less imaginary part it is no vibration
NEUTRAL = 1e-6  # of |pole|: less growth or decay is rounding
SMALL = 1e-3  # of a pole: a larger correction is not due to rounding
NOTHING = 1e-23  # of the largest stiffness: a coordinate with less counts as free
EPSILON = 1.1e-16  # half the spacing of numbers of double precision around 1
UNSEEN = 1e-15  # of the largest |pole|: growth below that is rounding as well
LARGE = 120  # coordinates
LEAST = 4  # systems to a thread
PIECE, FEW = 1024, 32  # frequencies summed, and solved for, at a time
WELL_CONDITIONED = 1e7  # of unit vectors: the sum over poles then keeps nine digits


@dataclass(frozen=True, eq=False, slots=True)
class Modes:
    """Poles and vectors of a batch of systems of order n with unit mass.

    ``stiffness``, ``damping`` (…, n, n): the systems. ``pole`` (…, 2n) [rad/s]; ``vector``
    (…, n, 2n): displacement part of the right vectors; ``participation`` (…, 2n, n): excitation of
    each pole by a force on each coordinate, so that the receptance at s is
    vector · diag(1/(s − pole)) · participation. ``condition`` (…): of the vectors, very large where
    poles coincide and share one vector (a free body at rest).
    """

    stiffness: Matrix
    damping: Matrix
    pole: Complex
    vector: Complex
    participation: Complex
    condition: Array

    def at_rest(self) -> Flags:
        """Return which poles are zero, those of rigid-body motions (…, 2n).

        There are as many such motions as directions without stiffness, each coordinate scaled by
        its own, and up to two poles for each; so slow motions on soft springs are not among them,
        however stiff the rest is.
        """
        size = np.abs(self.pole)
        largest = np.abs(self.stiffness).max(axis=(-2, -1), initial=0.0)
        small = np.asarray(size <= NOISE * np.sqrt(largest)[..., None])
        rows = small.any(axis=-1)
        if rows.any():
            rank = size[rows].argsort(axis=-1).argsort(axis=-1)
            free = self.stiffness.shape[-1] - _held(self.stiffness[rows])
            small[rows] &= rank < 2 * free[:, None]
        return small

    def representatives(self) -> tuple[Indices, Array]:
        """Return columns (…, k) that represent all poles, and how many each: of a real system those
        of Im ≥ 0, two for a pair of conjugates. One that fills up a row represents none."""
        if np.iscomplexobj(self.stiffness) or np.iscomplexobj(self.damping):
            columns = np.broadcast_to(np.arange(self.pole.shape[-1]), self.pole.shape)
            return columns, np.ones(self.pole.shape)
        descending = np.argsort(-self.pole.imag, axis=-1, kind="stable")
        columns = descending[..., : int((self.pole.imag >= 0.0).sum(axis=-1).max())]
        return columns, 1.0 + np.sign(np.take_along_axis(self.pole.imag, columns, axis=-1))

    def at(self, rows: Indices) -> Modes:
        """Return the systems ``rows`` of a batch along one axis."""
        return Modes(*(getattr(self, field.name)[rows] for field in fields(self)))

    @property
    def largest(self) -> Array:
        """Largest |pole| of each system (…, 1) [rad/s]."""
        return np.abs(self.pole).max(axis=-1, keepdims=True, initial=0.0)

    @property
    def rounding(self) -> Array:
        """Expected change of each pole (…, 2n) [rad/s] by rounding of the stiffness: by independent
        errors of all entries, to first order."""
        with np.errstate(invalid="ignore", over="ignore"):
            left, right = (np.abs(part) ** 2 for part in (self.participation, self.vector))
            spread = np.abs(self.stiffness) ** 2 @ right
            return EPSILON * np.sqrt(np.einsum("...kn,...nk->...k", left, spread))

    def receptance(self, omega: Array, responses: Array, excitations: Array) -> Complex:
        """Return receptances of paired rows (…, pairs, f) at i·``omega``, (f,) or (…, f) by system.

        ``responses`` and ``excitations`` (pairs, n). ``omega`` of Im < 0 is a force that grows.
        """
        batch = self.pole.shape[:-1]
        omegas = np.broadcast_to(omega, (*batch, omega.shape[-1]))
        total = np.empty((*batch, len(responses), omega.shape[-1]), dtype=complex)
        systems = list(np.ndindex(*batch))

        def fill(part: slice) -> None:
            for system in systems[part]:
                summed = self.condition[system] < WELL_CONDITIONED and not np.iscomplexobj(omega)
                method = self._summed if summed else self._solved
                total[system] = method(system, omegas[system], responses, excitations)

        in_threads(fill, len(systems), LEAST)
        return total

    def _summed(
        self, place: tuple[int, ...], omega: Array, responses: Array, excitations: Array
    ) -> Complex:
        """Sum over the poles: with λ = σ + iν, 1/(iω − λ) is (iν − σ − iω)/(σ² + (ω − ν)²).

        One real table serves all pairs; pieces of it stay in fast memory. A whole run of
        mfw2310 takes a fifth of the time that it takes by ``_solved``.
        """
        pole, count = self.pole[place], len(responses)
        residue = (responses @ self.vector[place]) * (self.participation[place] @ excitations.T).T
        numerator = residue * (1j * pole.imag - pole.real)
        weights = np.concatenate([numerator.real, numerator.imag, residue.real, residue.imag])
        total = np.empty((count, len(omega)), dtype=complex)
        squared = pole.real[:, None] ** 2
        for start in range(0, len(omega), PIECE):
            piece = omega[start : start + PIECE]
            table = piece - pole.imag[:, None]
            with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
                table *= table
                table += squared
                np.reciprocal(table, out=table)
                parts = (weights @ table).reshape(4, count, -1)
            total[:, start : start + PIECE].real = parts[0] + piece * parts[3]
            total[:, start : start + PIECE].imag = parts[1] - piece * parts[2]
        return total

    def _solved(
        self, place: tuple[int, ...], omega: Array, responses: Array, excitations: Array
    ) -> Complex:
        """Solve the dynamic stiffness at every frequency; infinite where one is singular."""
        k, d = self.stiffness[place], self.damping[place]
        loads, which = np.unique(excitations, axis=0, return_inverse=True)
        total = np.empty((len(responses), len(omega)), dtype=complex)
        for start in range(0, len(omega), FEW):
            part = slice(start, start + FEW)
            w = omega[part, None, None]
            with np.errstate(over="ignore", invalid="ignore"):
                try:
                    dynamic = k + 1j * w * d - w**2 * np.eye(len(k))
                    displacement = np.linalg.solve(dynamic, loads.T + 0j)
                except np.linalg.LinAlgError:
                    return np.full_like(total, np.inf)
            total[:, part] = np.einsum("pn,fnp->pf", responses, displacement[:, :, which.ravel()])
        return total


def unsolved(stiffness: Matrix, damping: Matrix) -> Modes:
    """Return the systems without any poles, for receptances at a few frequencies alone."""
    shape = np.broadcast_shapes(stiffness.shape, damping.shape)
    empty = np.zeros((*shape[:-1], 0), dtype=complex)
    return Modes(
        np.broadcast_to(stiffness, shape),
        np.broadcast_to(damping, shape),
        np.zeros((*shape[:-2], 0), dtype=complex),
        empty,
        np.swapaxes(empty, -1, -2),
        np.full(shape[:-2], np.inf),
    )


def oscillates(pole: Complex) -> Flags:
    """Return which poles are those of vibrations."""
    return np.asarray(np.abs(pole.imag) > STRAIGHT * np.abs(pole))


def grows(pole: Complex, largest: Array | float) -> Flags:
    """Return which poles grow by more than rounding; ``largest``: |pole| of their system."""
    return np.asarray(pole.real > np.maximum(NEUTRAL * np.abs(pole), UNSEEN * largest))


def _held(stiffness: Matrix) -> Indices:
    """Return the number of directions in which K (s, n, n), scaled by its diagonal, is stiff."""
    size = np.abs(np.diagonal(stiffness, axis1=-2, axis2=-1))
    size = np.where(size > 0.0, size, np.abs(stiffness).max(axis=-1))
    scale = np.sqrt(np.where(size > 0.0, size, 1.0))
    scaled = stiffness / scale[:, None, :] / scale[:, :, None]
    values = np.linalg.svd(scaled, compute_uv=False)
    return np.asarray((values > HELD * values[:, :1]).sum(axis=-1))


def modes(stiffness: Matrix, damping: Matrix) -> Modes:
    """Return the modes of q̈ + D q̇ + K q = f; ``stiffness``, ``damping`` (…, n, n), real or not.

    A coordinate with less than ``NOTHING`` of the largest stiffness counts as free.
    """
    shape = np.broadcast_shapes(stiffness.shape, damping.shape)
    if not shape[-1]:  # no coordinates
        return replace(unsolved(stiffness, damping), condition=np.ones(shape[:-2]))
    stiffness = np.broadcast_to(_without_free(stiffness), shape)
    damping = np.broadcast_to(damping, shape)
    conservative = conservative_modes(stiffness, damping)
    if conservative is None:
        pole, vector, left, condition = _damped(stiffness, damping)
    else:
        (pole, vector, left), condition = conservative, np.ones(shape[:-2])
    pole = _polished(pole, vector, left, stiffness, damping)
    pole = pole if conservative is None else np.asarray(1j * pole.imag)
    return Modes(stiffness, damping, pole, vector, left, condition)


def _damped(stiffness: Matrix, damping: Matrix) -> tuple[Complex, Complex, Complex, Array]:
    """Return what ``_general`` does, faster for lightly damped systems of two planes as a complex
    one: a study takes 1.2 times as long without. ``LARGE`` single systems are faster by QR."""
    complex_planes = stiffness.ndim == 3 and np.iscomplexobj(damping)
    single = len(stiffness) == 1 and stiffness.shape[-1] >= LARGE
    if not complex_planes or single or not np.isfinite(stiffness).all():
        return _general(stiffness, damping)
    pole, vector, left, converged = lightly_damped_modes(stiffness, damping)
    solved = pole, *_normalised(stiffness, pole, vector, left)
    failed = np.flatnonzero(~converged)
    if failed.size:
        general = _general(stiffness[failed], damping[failed])
        for part, other in zip(solved, general, strict=True):
            part[failed] = other
    return solved


def _normalised(
    stiffness: Matrix, pole: Complex, vector: Complex, left: Complex
) -> tuple[Complex, Complex, Array]:
    """Return vectors, participations and conditions as ``_general`` does."""
    scale = float(np.sqrt(np.abs(stiffness).max())) or 1.0
    size = np.sqrt((np.abs(vector) ** 2).sum(axis=1) * (1.0 + np.abs(pole / scale) ** 2))
    vector, left = vector / size[:, None], left * size[..., None]
    displaced = np.abs(left @ stiffness).sum(axis=-1) / np.abs(pole)
    condition = (displaced + scale * np.abs(left).sum(axis=-1)).max(axis=-1)
    return vector, left, condition


def _general(stiffness: Matrix, damping: Matrix) -> tuple[Complex, Complex, Complex, Array]:
    """Return poles, vectors, participations and the condition of the vectors, of any system."""
    n = stiffness.shape[-1]
    shape = (*stiffness.shape[:-2], 2 * n, 2 * n)
    matrix = np.zeros(shape, dtype=np.result_type(stiffness, damping))
    matrix[..., :n, n:] = np.eye(n)
    matrix[..., n:, :n] = -stiffness
    matrix[..., n:, n:] = -damping
    scale = float(np.sqrt(np.abs(stiffness).max())) or 1.0  # balances displacement and velocity
    matrix[..., :n, n:] *= scale
    matrix[..., n:, :n] /= scale
    flat = matrix.reshape(-1, 2 * n, 2 * n)

    def solved(part: slice) -> tuple[Complex, Complex, Complex]:
        pole, vectors = (np.asarray(array, dtype=complex) for array in np.linalg.eig(flat[part]))
        return pole, vectors, _inverse(vectors)

    parts = zip(*in_threads(solved, len(flat), LEAST), strict=True)
    pole, vectors, left = (np.concatenate(part) for part in parts)
    left = left.reshape(shape)
    condition: Array = np.abs(left).sum(axis=-1).max(axis=-1)
    participation = np.asarray(left[..., n:] / scale, dtype=complex)
    return pole.reshape(shape[:-1]), vectors.reshape(shape)[..., :n, :], participation, condition


def _without_free(stiffness: Matrix) -> Matrix:
    """Return the stiffness without rows and columns of coordinates that count as free."""
    size = np.abs(stiffness)
    row_largest = np.maximum(size.max(axis=-1), size.max(axis=-2))
    free = row_largest < NOTHING * size.max(axis=(-2, -1))[..., None]
    if not row_largest[free].any():
        return stiffness
    return np.where(free[..., None] | free[..., None, :], 0.0, stiffness)


def _polished(
    pole: Complex, vector: Complex, participation: Complex, stiffness: Matrix, damping: Matrix
) -> Complex:
    """Refine poles by a step of two-sided Newton: rounding by the stiffest motions is squared."""
    at = pole[..., None, :]
    defect = at**2 * vector + at * times(damping, vector) + times(stiffness, vector)
    with np.errstate(invalid="ignore", over="ignore"):
        step = np.einsum("...kn,...nk->...k", participation, defect)
        small = np.abs(step) < SMALL * np.abs(pole)
    step = np.where(pole.imag == 0.0, step.real, step)  # overdamped poles stay real
    return np.where(small, pole - step, pole)


def _inverse(vectors: Complex) -> Complex:
    """Return left vectors; infinite where the right ones are dependent to the last bit."""
    try:
        return np.asarray(np.linalg.inv(vectors), dtype=complex)
    except np.linalg.LinAlgError:
        regular = np.linalg.matrix_rank(vectors) == vectors.shape[-1]
        safe = np.where(regular[..., None, None], vectors, np.eye(vectors.shape[-1]))
        return np.where(regular[..., None, None], np.linalg.inv(safe), np.inf)


def residual(solution: Modes, stiffness: Matrix, damping: Matrix) -> float:
    """Return the largest |(λ² + λ D + K) v| over (|λ|² + |λ D| + |K|) |v| of all eigenpairs."""
    if not solution.pole.size:
        return 0.0
    columns, _ = solution.representatives()
    pole_of = np.take_along_axis(solution.pole, columns, axis=-1)
    pole, vector = (
        pole_of[..., None, :],
        np.take_along_axis(solution.vector, columns[..., None, :], -1),
    )
    defect = pole**2 * vector + pole * times(damping, vector) + times(stiffness, vector)
    size = np.abs(pole_of) ** 2 + np.abs(pole_of) * _norm(damping) + _norm(stiffness)
    return float((np.abs(defect).max(axis=-2) / (size * np.abs(vector).max(axis=-2))).max())


def _norm(matrix: Matrix) -> Array:
    return np.abs(matrix).sum(axis=-1).max(axis=-1)[..., None]
