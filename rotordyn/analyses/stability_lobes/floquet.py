"""Floquet multipliers of milling at one speed, of a tip that is a sum of modes.

Over each span of the cut the displacement of the tip follows from the state of the modes at its
start and from the forces, expanded in Legendre polynomials: u = F x + L g, and the state after it
from both, x' = P x + W g. Forces of a depth a are g = −a D w, with w the dynamic chip thickness
and, with process damping, the velocity. With H = D N of low rank, w is shorter than u:
N (u − u_old) of evenly spaced teeth. It follows from the forces and the previous period, y = (c, x)
with c = N u_old: w = V g + Q y, so that w = (1 + a V D)⁻¹ Q y, and forces give the map of one
period: from tooth to tooth, or of a pattern of uneven pitches, within which a tooth cuts the
surface that another left in the same period.
The same limits follow from all harmonics of the tooth frequency.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotordyn.analyses.stability_lobes.bessel import modified_bessel
from rotordyn.analyses.stability_lobes.modal import ModalTip
from rotordyn.analyses.stability_lobes.spans import Spans, factors
from rotordyn.arrays import Array, Complex

REMEMBERED = 2.5  # times the highest frequency: modes above it decay within a span of the cut
STATIC = 8.0  # times the highest frequency: modes above it respond statically
REAL = 1e-9  # of an eigenvalue: a smaller imaginary part is rounding
EXTRA = 12  # polynomials added within an integral, to keep truncation out of the others


@dataclass(frozen=True, eq=False)
class Floquet:
    """Map of one period of cutting over ``spans``; ``tip``: all modes of the tip of the tool.

    ``damping`` (2p, 2p): matrix of the forces by velocity between polynomials [N s/m²], by depth.
    """

    spans: Spans
    tip: ModalTip
    damping: Array | None = None

    @cached_property
    def _modes(self) -> ModalTip:
        """Modes (m,) of the state: those that decay too little over a span to be truncated."""
        return self.tip.below(REMEMBERED * self.spans.top)

    @cached_property
    def _times(self) -> list[tuple[float, float, float]]:
        """Start, half length and end of every span [s], from the start of the first."""
        period, first = self.spans.period, self.spans.each[0]
        begin = first[0] - first[1]
        return [
            ((c - h - begin) * period, h * period, (c + h - begin) * period)
            for c, h, _ in self.spans.each
        ]

    @cached_property
    def _integrals(self) -> list[tuple[Complex, Complex]]:
        """Integrals over each span: free decay of every mode from 1 in polynomials (m, p), and the
        state of the mode at the end of the span by forces (m, p)."""
        integrals = []
        for (_, half, _), (*_, count) in zip(self._times, self.spans.each, strict=True):
            order = np.arange(count)
            decay = modified_bessel(self._modes.pole * half, count) * 2.0 * np.sqrt(order + 0.5)
            integrals.append((decay, half * decay * (-1.0) ** order))
        return integrals

    def _free(self, shape: Complex) -> Array:
        """Return F, displacements by the state (2p, 2m): real and imaginary parts of the modes;
        velocities by a ``shape`` times pole."""
        motion = np.zeros((self.spans.size, 2, len(shape)), dtype=complex)
        for place, (begin, _, _), (decay, _) in zip(
            self.spans.places, self._times, self._integrals, strict=True
        ):
            at_start = np.exp(self._modes.pole * begin)
            motion[place] = np.einsum("ma,mi,m->aim", decay, shape, at_start)
        flat = motion.reshape(-1, len(shape))
        return np.concatenate([2.0 * flat.real, -2.0 * flat.imag], axis=1)

    def _forced(self, velocity: bool = False) -> Array:
        """Return L, displacements (``velocity``: velocities) by forces (2p, 2p)."""
        size = self.spans.size
        matrix = np.zeros((size, 2, size, 2))
        near = self.tip.below(STATIC * self.spans.top)
        static = 0.0 * near.constant if velocity else near.constant
        rate = near.pole if velocity else np.ones(len(near.pole))
        residue = np.einsum("m,mi,mj->ijm", rate, near.shape, near.participation).reshape(4, -1)
        for place, (_, half, _), (*_, count) in zip(
            self.spans.places, self._times, self.spans.each, strict=True
        ):
            y = _mode_solutions(near.pole, half, count).reshape(len(near.pole), -1)
            block = 2.0 * (residue.real @ y.real - residue.imag @ y.imag)
            block = block.reshape(2, 2, count, count) + static[:, :, None, None] * np.eye(count)
            matrix[place, :, place] = block.transpose(2, 0, 3, 1)
        slow = self._modes
        shape = slow.shape * slow.pole[:, None] if velocity else slow.shape
        for k, later in enumerate(self.spans.places):
            for j, earlier in enumerate(self.spans.places[:k]):
                decay = np.exp(slow.pole * (self._times[k][0] - self._times[j][2]))
                left = np.einsum("ma,mi,m->aim", self._integrals[k][0], shape, decay)
                by_force = np.einsum("mb,mk->mbk", self._integrals[j][1], slow.participation)
                matrix[later, :, earlier] = 2.0 * np.tensordot(left, by_force, axes=1).real
        return matrix.reshape(2 * size, 2 * size)

    @cached_property
    def _state(self) -> Array:
        """W: states after a period by forces (2m, 2p)."""
        slow = self._modes
        states = np.zeros((len(slow.pole), self.spans.size, 2), dtype=complex)
        for place, (_, _, end), (_, by_force) in zip(
            self.spans.places, self._times, self._integrals, strict=True
        ):
            decay = np.exp(slow.pole * (self.spans.period - end))
            states[:, place] = np.einsum("ma,mi,m->mai", by_force, slow.participation, decay)
        flat = states.reshape(len(slow.pole), -1)
        return np.concatenate([flat.real, flat.imag], axis=0)

    @cached_property
    def _state_by_state(self) -> Array:
        """Monodromy matrix P over one period, without a cut (2m, 2m)."""
        decay = np.exp(self._modes.pole * self.spans.period)
        matrix, size = np.zeros((2, len(decay), 2, len(decay))), np.arange(len(decay))
        matrix[0, size, 0, size] = matrix[1, size, 1, size] = decay.real
        matrix[1, size, 0, size], matrix[0, size, 1, size] = decay.imag, -decay.imag
        return matrix.reshape(2 * len(decay), 2 * len(decay))

    @cached_property
    def _scaled(self) -> tuple[Array, Array]:
        """Largest displacement by each state (2m,), and F by states scaled by it."""
        free = self._free(self._modes.shape)
        size = np.maximum(np.abs(free).max(axis=0, initial=0.0), 1e-300)
        return size, free / size

    @cached_property
    def _transition(self) -> tuple[Array, Array]:
        """Matrices of y = (c, x), kept displacement and state, after a period: by forces
        (q + 2m, 2p), and by y before it (q + 2m, q + 2m)."""
        kept = self.spans.thickness.kept
        size, free = self._scaled
        by_state = np.concatenate([kept @ free, self._state_by_state * (size[:, None] / size)])
        by_force = np.concatenate([kept @ self._motion, self._state * size[:, None]])
        return by_force, np.pad(by_state, ((0, 0), (len(kept), 0)))

    @cached_property
    def _motion(self) -> Array:
        return self._forced()

    @cached_property
    def _teeth(self) -> tuple[Array, Array, Array]:
        """D (2p, n), V (n, 2p) and Q (n, q + 2m) of chip thickness and velocity w (n,)."""
        forces, now, before, kept = self.spans.thickness
        by_force = self._transition[0][: len(kept)] if now is kept else now @ self._motion
        by_state = np.concatenate([-before, now @ self._scaled[1]], axis=1)
        if self.damping is None:
            return forces, by_force, by_state
        rubbing, along = factors(self.damping)
        velocity = self._free(self._modes.shape * self._modes.pole[:, None]) / self._scaled[0]
        return (
            np.concatenate([forces, rubbing], axis=1),
            np.concatenate([by_force, along @ self._forced(velocity=True)]),
            np.concatenate([by_state, np.pad(along @ velocity, ((0, 0), (before.shape[1], 0)))]),
        )

    @cached_property
    def _loop(self) -> tuple[Array, Array]:
        """V D (n, n), and y after a period by w (q + 2m, n)."""
        forces, by_force, _ = self._teeth
        return by_force @ forces, self._transition[0] @ forces

    def _thickness(self, depth: float) -> Array:
        """Return the matrix of w by y (n, q + 2m) at a depth."""
        loop, _ = self._loop
        return np.asarray(np.linalg.solve(np.eye(len(loop)) + depth * loop, self._teeth[2]))

    def map(self, depth: float) -> Array:
        """Return the matrix of y, kept displacement over the cut and state, after a period by y
        before it (q + 2m, q + 2m)."""
        return np.asarray(self._transition[1] - depth * self._loop[1] @ self._thickness(depth))

    def multipliers(self, depth: float) -> Complex:
        """Return the Floquet multipliers at a depth [m], unstable if one exceeds 1 in size."""
        return np.asarray(np.linalg.eigvals(self.map(depth)), dtype=complex)

    def repeating(self, multiplier: float) -> float:
        """Return the least depth [m] with a ``multiplier`` −1, period doubling, or 1; infinite if
        there is none.

        The motion of one period is then that of the last with the opposite or the same sign, and
        depths are reciprocal eigenvalues of one matrix: none is missed.
        """
        (forces, by_force, before), (after, by_state) = self._teeth, self._transition
        back = np.linalg.solve(multiplier * np.eye(len(by_state)) - by_state, after)
        value = -np.linalg.eigvals((by_force + before @ back) @ forces)
        real = value.real[(np.abs(value.imag) <= REAL * np.abs(value)) & (value.real > 0.0)]
        return 1.0 / float(real.max()) if real.size else np.inf

    def dominant(self, depth: float) -> tuple[complex, Complex]:
        """Return the largest multiplier of Im ≥ 0, and forces over the cut of its motion (2p,)."""
        values, vectors = np.linalg.eig(self.map(depth))
        place = int(np.where(values.imag >= 0.0, np.abs(values), 0.0).argmax())
        forces = -depth * self._teeth[0] @ (self._thickness(depth) @ vectors[:, place])
        return complex(values[place]), forces


def _mode_solutions(pole: Complex, half: float, count: int) -> Complex:
    """Return solutions (m, p, p) of x' = pole x + f over a span of half length ``half`` [s] from
    x = 0, as coefficients of orthonormal polynomials by those of f.

    The integral of a polynomial has only adjacent orders, so that systems are tridiagonal.
    """
    from scipy.linalg import solve_banded

    size = count + EXTRA
    k = np.arange(size - 1)
    adjacent = 1.0 / np.sqrt((2.0 * k + 1.0) * (2.0 * k + 3.0))
    right = np.zeros((size, count))
    right[0, 0] = half
    order = np.arange(count)
    right[order + 1, order] = half * adjacent[order]
    right[order[1:] - 1, order[1:]] = -half * adjacent[order[1:] - 1]
    z = (pole * half)[:, None]
    bands = np.zeros((3, len(pole), size), dtype=complex)
    bands[0, :, 1:], bands[2, :, :-1], bands[1] = z * adjacent, -z * adjacent, 1.0
    bands[1, :, :1] -= z
    repeated = np.tile(right, (len(pole), 1))
    solution = solve_banded((1, 1), bands.reshape(3, -1), repeated, check_finite=False)
    return solution.reshape(len(pole), size, count)[:, :count]
