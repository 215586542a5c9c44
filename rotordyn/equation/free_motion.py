"""Free motions of a subsystem: poles and vectors at every speed, and receptances as their sums.

Where both planes obey the same equations they are solved as one complex plane r = y + i z, half the
unknowns: whirl at a pole of Im > 0 is forward, of Im < 0 backward. In whatever form they are
solved, motions are returned over all coordinates of the subsystem, one of every pair of conjugates.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rotordyn.allowance import require_modes
from rotordyn.arrays import Array, Complex, Flags, Indices, Matrix
from rotordyn.equation.constraint import along
from rotordyn.equation.free_directions import free_directions, too_stiff
from rotordyn.equation.hysteresis import Hysteresis, Hysteretic, Signs, signs_at
from rotordyn.equation.linear import Linear, name_of
from rotordyn.errors import InvalidInput
from rotordyn.numerics.modes import Modes, grows, modes, residual, unsolved
from rotordyn.numerics.synchronous import synchronous

S = TypeVar("S", bound=np.generic)
LOST = 0.1  # of a pole: with a larger change by rounding it has no meaning
FORWARD = np.array([1.0, -1.0j])  # planes y and z of whirl r e^(iωt)


@dataclass(frozen=True, eq=False)
class FreeMotions:
    """Free motions of ``linear``, solved as ``modes`` of one complex plane or of all coordinates;
    those of one system serve all speeds where nothing changes with speed.

    ``pole`` (s, k) [rad/s], Im ≥ 0, NaN where a speed has fewer; ``vector`` (s, n, k); ``left``
    (s, k, n): the receptance at iω is Σ vector left / (iω − pole) and, of those ``paired``, the
    conjugate.
    """

    linear: Linear
    modes: Modes
    lossy: Hysteretic | None = None

    @property
    def solved_once(self) -> bool:
        """True if one system serves all speeds."""
        return len(self.modes.pole) == 1

    def _each(self, values: NDArray[S]) -> NDArray[S]:
        """Return values (s or 1, …) at every speed."""
        return np.broadcast_to(values, (len(self.linear.speed), *values.shape[1:]))

    @property
    def whirling(self) -> bool:
        """True if solved as one complex plane."""
        return self.linear.axisymmetric

    @cached_property
    def _chosen(self) -> tuple[Indices, Flags]:
        """Columns of ``modes`` (s, k), and which of them only fill up a row."""
        columns, number = self.modes.representatives()
        return columns, number == 0.0

    @cached_property
    def pole(self) -> Complex:
        """Poles of Im ≥ 0 (s, k) [rad/s]; NaN where a speed has fewer."""
        if self.whirling:
            pole = self.modes.pole
            return self._each(np.where(pole.imag < 0.0, pole.conj(), pole))
        columns, filler = self._chosen
        pole = np.take_along_axis(self.modes.pole, columns, axis=-1)
        pole[filler] = complex(np.nan, np.nan)
        return self._each(pole)

    @cached_property
    def rounding(self) -> Array:
        """Relative change of each pole by rounding of the stiffness (s, k): supports far stiffer
        than the shaft leave few of its digits."""
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = self.modes.rounding / np.abs(self.modes.pole)
        return self._each(self._of_returned(relative))

    @cached_property
    def vector(self) -> Complex:
        """Right vectors (s, n, k)."""
        return self._in_coordinates(self.modes.vector, 0.5, -1j)

    @cached_property
    def left(self) -> Complex:
        """Left vectors (s, k, n)."""
        columns = self._in_coordinates(np.swapaxes(self.modes.participation, 1, 2), 1.0, 1j)
        return np.swapaxes(columns, 1, 2)

    def _in_coordinates(self, columns: Complex, size: float, turn: complex) -> Complex:
        """Return ``columns`` (s, m, 2n) of the modes that are returned over all coordinates
        (s, n, k): whirl of some ``size`` in plane y and, by a quarter ``turn``, in plane z."""
        if not self.whirling:
            chosen = np.take_along_axis(columns, self._chosen[0][:, None, :], axis=2)
            return self._each(self._expanded(chosen))
        expanded, back = self._expanded(columns), (self.modes.pole.imag < 0.0)[:, None]
        y = size * np.where(back, expanded.conj(), expanded)
        return self._each(np.concatenate([y, np.where(back, -turn, turn) * y], axis=1))

    @cached_property
    def _allowed(self) -> Array | None:
        """Motions that the modes are made of, in the coordinates of the subsystem or of its plane;
        None where these are coordinates of the modes."""
        allowed = self.linear.allowed
        if allowed is None or not self.whirling:
            return allowed
        return allowed[: allowed.shape[0] // 2, : allowed.shape[1] // 2]

    def _expanded(self, vector: Complex) -> Complex:
        return vector if self._allowed is None else np.asarray(self._allowed @ vector)

    def _restricted(self, rows: Array) -> Array:
        """Return rows (pairs, n) in the coordinates of the modes."""
        return rows if self._allowed is None else along(rows, self._allowed)

    @cached_property
    def whirl(self) -> Array:
        """+1 for forward and −1 for backward whirl where planes are one, else 0 (s, k)."""
        sign = np.where(self.modes.pole.imag < 0.0, -1.0, 1.0)
        return self._each(sign) if self.whirling else np.zeros(self.pole.shape)

    @property
    def turning_frequency(self) -> Array:
        """Angular frequency (s, k) in a frame rotating with the shaft [rad/s]."""
        frequency = self.pole.imag
        if not self.whirling:
            return frequency
        return np.abs(self.whirl * frequency - self.linear.speed[:, None])

    @property
    def paired(self) -> Flags:
        """Poles (s, k) whose conjugates are poles, too: all but real ones, which stand for a pair
        where planes are one."""
        return (self.pole.imag != 0.0) | self.whirling

    @cached_property
    def at_rest(self) -> Flags:
        """Rigid-body motions: poles at zero (s, k).

        Raises
        ------
        InvalidInput : a support so stiff that motions on other supports are lost in rounding
        """
        return self._each(self._of_returned(self._free))

    @cached_property
    def _free(self) -> Flags:
        """The same of all ``modes``: no more than the links of the parts leave free, for with very
        stiff supports slow motions look like free ones."""
        free = self.modes.at_rest()
        order = np.abs(self.modes.pole).argsort(axis=-1).argsort(axis=-1)
        rows = np.flatnonzero(free.any(axis=-1))
        count = free_directions(self.linear, rows) * (1 if self.whirling else 2)
        constrained = free[rows] & (order[rows] >= count[:, None])
        lost = self.modes.rounding[rows] > LOST * np.abs(self.modes.pole[rows])
        if lost[constrained].any():
            raise InvalidInput(too_stiff(self.linear))
        free[rows] &= ~constrained
        return free

    @cached_property
    def free_count(self) -> Array:
        """Number of poles at zero (s,), both of a pair."""
        return self._each(self._free.sum(axis=-1) * (2.0 if self.whirling else 1.0))

    @cached_property
    def growing(self) -> Flags:
        """Unstable motions (s, k); vibrations only below ``Fineness.own_mass``, if shafts bend."""
        pole, structure = self.modes.pole, self.linear.structure
        limit = math.inf if structure.rigid else structure.fine.own_mass
        growing = grows(pole, self.modes.largest) & ~self._free & (np.abs(pole.imag) < limit)
        return self._each(self._of_returned(growing)) & ~np.isnan(self.pole)

    def _of_returned(self, values: NDArray[S]) -> NDArray[S]:
        """Return values of all ``modes`` (s, 2n) for those that are returned (s, k)."""
        return values if self.whirling else np.take_along_axis(values, self._chosen[0], axis=-1)

    def receptance(self, omega: Array, responses: Array, excitations: Array) -> Complex:
        """Return receptances of paired rows (pairs, n) at ``omega`` > 0, (f,) or (s, f) of every
        speed: (s, pairs, f). A force e^(iωt) that grows, Im ω < 0, flattens resonances."""
        if self.solved_once and omega.ndim > 1:
            once = self.receptance(omega.ravel(), responses, excitations)[0]
            return np.swapaxes(once.reshape(len(responses), *omega.shape), 0, 1)
        evaluate = (self.lossy or self.modes).receptance
        if not self.whirling:
            folded = self._restricted(responses), self._restricted(excitations)
            return self._each(evaluate(omega, *folded))
        both = np.concatenate([omega, -omega.conj()], axis=-1)
        total = self._in_planes(lambda r, e: evaluate(both, r, e), responses, excitations)
        return self._each(total)

    def turning_receptance(self, omega: Array, responses: Array, excitations: Array) -> Complex:
        """Return receptances in a frame rotating with the shaft: whirl at ω + Ω has ω there, axial
        motion and torsion have the same frequency."""
        if not self.whirling:
            return self.receptance(omega, responses, excitations)

        def evaluate(rows: Array, other: Array) -> Complex:
            spin, modes = self.linear.speed[:, None], self.modes
            if self.solved_once:
                modes = modes.at(np.zeros(len(spin), dtype=np.intp))
            both = np.concatenate([omega + spin, spin - omega], axis=-1)
            return modes.receptance(both, rows, other)

        return self._in_planes(evaluate, responses, excitations)

    def _in_planes(
        self, evaluate: Callable[[Array, Array], Complex], responses: Array, excitations: Array
    ) -> Complex:
        """Combine receptances of whirl at ω, then at −ω: each row acts in one plane."""
        half = self.linear.size // 2
        folded = [rows[:, :half] + rows[:, half:] for rows in (responses, excitations)]
        plane = [
            np.abs(rows[:, half:]).any(axis=1).astype(int) for rows in (responses, excitations)
        ]
        forward, backward = np.split(evaluate(*map(self._restricted, folded)), 2, axis=-1)
        backward = backward.conj()
        turn = plane[0] - plane[1]
        total = forward + backward
        total *= 0.5
        if (crossed := turn != 0).any():
            across = -0.5j * turn[crossed, None] * (forward - backward)[:, crossed]
            if not self._coupled.all():
                across = np.where(self._coupled[:, None, None], across, 0.0)
            total[:, crossed] = across
        return np.asarray(total)

    @cached_property
    def _coupled(self) -> Flags:
        """Speeds (s or 1,) at which the planes are coupled."""
        coupled = np.zeros(len(self.modes.pole), dtype=bool)
        if self.lossy is not None and self.lossy.loss.turns:
            coupled |= self.lossy.spin != 0.0
        for matrix in (self.modes.stiffness, self.modes.damping):
            coupled |= matrix.imag.any(axis=(1, 2))
        return coupled

    @property
    def residual(self) -> float:
        """Largest relative residual of the eigenpairs."""
        if self.lossy is not None:
            return self.lossy.residual
        return residual(self.modes, self.modes.stiffness, self.modes.damping)

    def at(self, rows: Indices) -> FreeMotions:
        """Return the motions at the speeds ``rows``."""
        linear = self.linear.at(rows)
        if self.lossy is not None:
            return free_motions(linear, self.lossy.ceiling)
        return FreeMotions(linear, self.modes if self.solved_once else self.modes.at(rows))

    def at_order(self, order: float, side: float = 1.0) -> FreeMotions:
        """Return the motions of the linear system whose losses are those of motions at ``order``
        times the spin, of a whirl to one ``side`` where planes are one."""
        if self.lossy is None:
            return self
        order = side * order if self.whirling else order
        signs = signs_at(order, whirling=self.whirling)
        return replace(self, modes=self.lossy.with_signs(signs))

    def in_modes(self, force: Complex, rows: Sequence[Array]) -> tuple[Complex, list[Matrix]]:
        """Return a ``force`` (n,) that rotates forward, and output ``rows`` (…, n), in the
        coordinates of ``modes``."""
        load = along(force, self.linear.basis)
        within: list[Matrix] = [along(values, self.linear.basis) for values in rows]
        if not self.whirling:
            return load, within
        half = len(load) // 2
        return load[:half], [values[..., :half] - 1j * values[..., half:] for values in within]


def stiffness_with_signs(linear: Linear, signs: Signs) -> NDArray[np.inexact]:
    """Return the stiffness (s, m, m) within the motions that rigid supports allow, for some signs
    of loss."""
    if linear.loss is None:
        return linear.allowed_stiffness
    return linear.allowed_stiffness + linear.within(linear.loss.stiffness(signs))


def free_motions(linear: Linear, ceiling: float = math.inf) -> FreeMotions:
    """Return all free motions; with loss factors, each of |λ| below ``ceiling`` [rad/s] with those
    of its own frequency. What is the same at all speeds is solved once."""
    stiffness: Matrix = linear.allowed_stiffness
    damping: Matrix = linear.within(linear.damping)
    loss = linear.loss
    if loss is not None:
        loss = Hysteresis(*(linear.within(part) for part in loss if part is not None))
    parts = [stiffness, damping] if loss is None else [stiffness, damping, loss.fixed]
    turns = loss is not None and loss.turns
    if len(linear.speed) > 1 and not turns and all((part == part[:1]).all() for part in parts):
        return replace(free_motions(linear.at(np.zeros(1, dtype=np.intp)), ceiling), linear=linear)
    if linear.axisymmetric:
        half = stiffness.shape[-1] // 2
        stiffness, damping = (_circular(part, half) for part in (stiffness, damping))
        if loss is not None:
            fixed = _circular(loss.fixed, half)
            loss = Hysteresis(fixed, loss.turning[:half, :half], None)
    name = f"{name_of(linear.components)} modes"
    require_modes(name, len(linear.speed), stiffness.shape[-1])
    if loss is None:
        return FreeMotions(linear, modes(stiffness, damping), None)
    lossy = Hysteretic(stiffness, damping, loss, linear.speed, ceiling)
    return FreeMotions(linear, lossy.free_motions(), lossy)


def without_poles(linear: Linear) -> FreeMotions | None:
    """Return motions without poles, for receptances at a few frequencies alone; None with loss
    factors, and where planes are one.

    Coaxial rotors with orders take three times as long with poles, spindles on bearings hardly.
    """
    if linear.axisymmetric or linear.loss is not None:
        return None
    return FreeMotions(linear, unsolved(linear.allowed_stiffness, linear.within(linear.damping)))


def synchronous_motions(
    linear: Linear, stiffness: Matrix, slope: Matrix, order: float
) -> Iterator[tuple[float, Complex, float]]:
    """Yield spins Ω > 0, vectors (n,) and directions of undamped motions at ``order`` times Ω.

    ``stiffness`` and ``slope`` (m, m), within the motions that rigid supports allow: K₀ + Ω K₁.
    The direction is 0 but where planes are one: such of both directions may be at one speed.
    """
    gyroscopic, half = linear.within(linear.gyroscopic), len(stiffness) // 2
    motions = []
    if not linear.axisymmetric:
        motions.append((0.0, *synchronous(stiffness, gyroscopic, order, slope)))
    else:
        constant, change = (_circular(matrix[None], half)[0] for matrix in (stiffness, slope))
        for side in (1.0, -1.0):
            turning = -1j * side * gyroscopic[:half, half:]
            spins, plane = synchronous(constant, turning, order, change)
            plane = plane if side > 0.0 else plane.conj()
            motions.append((side, spins, np.concatenate([plane, -1j * side * plane])))
    for side, spins, vectors in motions:
        for spin, vector in zip(spins, (linear.basis @ vectors).T, strict=True):
            yield float(spin), vector, side


def _circular(matrix: Matrix, half: int) -> Matrix:
    """Return A − iB of [[A, B], [−B, A]] (s, n, n), acting on r = y + i z; real where the planes
    are not coupled."""
    direct, coupling = matrix[:, :half, :half], matrix[:, :half, half:]
    return np.asarray(direct - 1j * coupling) if coupling.any() else direct
