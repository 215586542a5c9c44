"""Floquet multipliers of milling at one speed, of a tip that is a sum of modes.

Over each span of the cut the displacement of the tip follows from the state of the modes at its
start and from the forces, expanded in Legendre polynomials: u = F x + L g, and the state after it
from both, x' = P x + W g. Forces of a depth a are g = −a D w by what the teeth feel, which is the
chip thickness and, with process damping, the velocity. With H = D N of low rank w is shorter than
u: N (u − u_old) of evenly spaced teeth. It follows from the forces and from what was before,
y = (c, x) with c = N u_old: w = V g + Q y, so that w = (1 + a V D)⁻¹ Q y, and forces give the map
of one period: from tooth to tooth, or of a pattern of uneven pitches, within which a tooth cuts
what another left in the same period.
The same limits follow from all harmonics of the tooth frequency.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.bessel import modified_bessel
from rotordyn.analyses.stability_lobes.modal import ModalTip
from rotordyn.analyses.stability_lobes.spans import Spans, factors

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
REMEMBERED = 2.5  # times the highest frequency: modes above it forget a span of the cut
STATIC = 8.0  # times the highest frequency: modes above it follow forces at once
REAL = 1e-9  # of an eigenvalue: a smaller imaginary part is rounding
EXTRA = 12  # polynomials more within an integral, which truncation would spoil


@dataclass(frozen=True, eq=False)
class Floquet:
    """The map of one period of cutting over ``spans``; ``tip`` all modes of the tool's tip.

    ``damping`` (2p, 2p): matrix of the forces by velocity between polynomials [N s/m²], per depth.
    """

    spans: Spans
    tip: ModalTip
    damping: Array | None = None

    @cached_property
    def _slow(self) -> ModalTip:
        """Modes that decay too little over a span to be left out of the state (m,)."""
        return self.tip.below(REMEMBERED * self.spans.top)

    @cached_property
    def _times(self) -> list[tuple[float, float, float]]:
        """Begin, half length and end of every span from that of the first [s]."""
        period, first = self.spans.period, self.spans.each[0]
        begin = first[0] - first[1]
        return [
            ((c - h - begin) * period, h * period, (c + h - begin) * period)
            for c, h, _ in self.spans.each
        ]

    @cached_property
    def _integrals(self) -> list[tuple[Complex, Complex]]:
        """Per span, the decay of every mode from 1 expanded in polynomials (m, p), and the state of
        the mode at the end of the span by forces (m, p)."""
        found = []
        for (_, half, _), (*_, count) in zip(self._times, self.spans.each, strict=True):
            order = np.arange(count)
            own = modified_bessel(self._slow.pole * half, count) * 2.0 * np.sqrt(order + 0.5)
            found.append((own, half * own * (-1.0) ** order))
        return found

    def _free(self, shape: Complex) -> Array:
        """F: displacements by the state (2p, 2m), real and imaginary parts of the modes; with
        ``shape`` times pole, velocities."""
        found = np.zeros((self.spans.size, 2, len(shape)), dtype=complex)
        for place, (begin, _, _), (own, _) in zip(
            self.spans.places, self._times, self._integrals, strict=True
        ):
            decayed = np.exp(self._slow.pole * begin)
            found[place] = np.einsum("ma,mi,m->aim", own, shape, decayed)
        flat = found.reshape(-1, len(shape))
        return np.concatenate([2.0 * flat.real, -2.0 * flat.imag], axis=1)

    def _forced(self, velocity: bool = False) -> Array:
        """L: displacements by forces (2p, 2p); ``velocity``: velocities instead."""
        size = self.spans.size
        found = np.zeros((size, 2, size, 2))
        near = self.tip.below(STATIC * self.spans.top)
        static = 0.0 * near.constant if velocity else near.constant
        rate = near.pole if velocity else np.ones(len(near.pole))
        residue = np.einsum("m,mi,mj->ijm", rate, near.shape, near.participation).reshape(4, -1)
        for place, (_, half, _), (*_, count) in zip(
            self.spans.places, self._times, self.spans.each, strict=True
        ):
            y = _integrated(near.pole, half, count).reshape(len(near.pole), -1)
            own = 2.0 * (residue.real @ y.real - residue.imag @ y.imag)
            own = own.reshape(2, 2, count, count) + static[:, :, None, None] * np.eye(count)
            found[place, :, place] = own.transpose(2, 0, 3, 1)
        slow = self._slow
        shape = slow.shape * slow.pole[:, None] if velocity else slow.shape
        for k, later in enumerate(self.spans.places):
            for j, earlier in enumerate(self.spans.places[:k]):
                decay = np.exp(slow.pole * (self._times[k][0] - self._times[j][2]))
                left = np.einsum("ma,mi,m->aim", self._integrals[k][0], shape, decay)
                right = np.einsum("mb,mk->mbk", self._integrals[j][1], slow.participation)
                found[later, :, earlier] = 2.0 * np.tensordot(left, right, axes=1).real
        return found.reshape(2 * size, 2 * size)

    @cached_property
    def _left(self) -> Array:
        """W: states after the period by forces (2m, 2p)."""
        slow = self._slow
        found = np.zeros((len(slow.pole), self.spans.size, 2), dtype=complex)
        for place, (_, _, end), (_, own) in zip(
            self.spans.places, self._times, self._integrals, strict=True
        ):
            decay = np.exp(slow.pole * (self.spans.period - end))
            found[:, place] = np.einsum("ma,mi,m->mai", own, slow.participation, decay)
        flat = found.reshape(len(slow.pole), -1)
        return np.concatenate([flat.real, flat.imag], axis=0)

    @cached_property
    def _kept(self) -> Array:
        """P: states after the period by those before (2m, 2m)."""
        decay = np.exp(self._slow.pole * self.spans.period)
        turn, size = np.zeros((2, len(decay), 2, len(decay))), np.arange(len(decay))
        turn[0, size, 0, size] = turn[1, size, 1, size] = decay.real
        turn[1, size, 0, size], turn[0, size, 1, size] = decay.imag, -decay.imag
        return turn.reshape(2 * len(decay), 2 * len(decay))

    @cached_property
    def _measured(self) -> tuple[Array, Array]:
        """The largest displacement that each state gives (2m,), and F by states measured by it."""
        free = self._free(self._slow.shape)
        size = np.maximum(np.abs(free).max(axis=0, initial=0.0), 1e-300)
        return size, free / size

    @cached_property
    def _after(self) -> tuple[Array, Array]:
        """What is kept of the displacement, and the state, after a period by forces (q + 2m, 2p),
        and without these by both before (q + 2m, q + 2m)."""
        kept = self.spans.thickness.kept
        size, free = self._measured
        still = np.concatenate([kept @ free, self._kept * (size[:, None] / size)])
        by_force = np.concatenate([kept @ self._moved, self._left * size[:, None]])
        return by_force, np.pad(still, ((0, 0), (len(kept), 0)))

    @cached_property
    def _moved(self) -> Array:
        return self._forced()

    @cached_property
    def _teeth(self) -> tuple[Array, Array, Array]:
        """D (2p, n), V (n, 2p) and Q (n, q + 2m) of what the teeth feel."""
        forces, now, before, kept = self.spans.thickness
        by_force = self._after[0][: len(kept)] if now is kept else now @ self._moved
        own = np.concatenate([-before, now @ self._measured[1]], axis=1)
        if self.damping is None:
            return forces, by_force, own
        rubbing, along = factors(self.damping)
        velocity = self._free(self._slow.shape * self._slow.pole[:, None]) / self._measured[0]
        return (
            np.concatenate([forces, rubbing], axis=1),
            np.concatenate([by_force, along @ self._forced(velocity=True)]),
            np.concatenate([own, np.pad(along @ velocity, ((0, 0), (before.shape[1], 0)))]),
        )

    @cached_property
    def _loop(self) -> tuple[Array, Array]:
        """V D (n, n), and what is kept and the state after a period by D (q + 2m, n)."""
        forces, by_force, _ = self._teeth
        return by_force @ forces, self._after[0] @ forces

    def _felt(self, depth: float) -> Array:
        """w by y (n, q + 2m)."""
        loop, _ = self._loop
        return np.asarray(np.linalg.solve(np.eye(len(loop)) + depth * loop, self._teeth[2]))

    def map(self, depth: float) -> Array:
        """What is kept of the displacement over the cut, and the state, after a period by those
        before, both (q + 2m,)."""
        return np.asarray(self._after[1] - depth * self._loop[1] @ self._felt(depth))

    def multipliers(self, depth: float) -> Complex:
        """Floquet multipliers at a depth [m]; beyond 1 in size the cut is unstable."""
        return np.asarray(np.linalg.eigvals(self.map(depth)), dtype=complex)

    def repeating(self, multiplier: float) -> float:
        """The least depth [m] of a ``multiplier`` −1, period doubling, or 1; infinite where there
        is none.

        The motion of one period is then that of the last with the opposite or the same sign, and
        depths are the eigenvalues of one matrix: none is missed.
        """
        (forces, by_force, before), (after, still) = self._teeth, self._after
        back = np.linalg.solve(multiplier * np.eye(len(still)) - still, after)
        value = -np.linalg.eigvals((by_force + before @ back) @ forces)
        real = value.real[(np.abs(value.imag) <= REAL * np.abs(value)) & (value.real > 0.0)]
        return 1.0 / float(real.max()) if real.size else np.inf

    def dominant(self, depth: float) -> tuple[complex, Complex]:
        """The largest multiplier of Im ≥ 0, and forces over the cut of its motion (2p,)."""
        values, vectors = np.linalg.eig(self.map(depth))
        place = int(np.where(values.imag >= 0.0, np.abs(values), 0.0).argmax())
        forces = -depth * self._teeth[0] @ (self._felt(depth) @ vectors[:, place])
        return complex(values[place]), forces


def _integrated(pole: Complex, half: float, count: int) -> Complex:
    """Of x' = pole x + f over a span of half length ``half`` [s] from x = 0, between orthonormal
    polynomials (m, p, p).

    The integral of a polynomial has neighbours of its order alone, so that systems are tridiagonal.
    """
    from scipy.linalg import solve_banded

    size = count + EXTRA
    k = np.arange(size - 1)
    beside = 1.0 / np.sqrt((2.0 * k + 1.0) * (2.0 * k + 3.0))
    right = np.zeros((size, count))
    right[0, 0] = half
    own = np.arange(count)
    right[own + 1, own] = half * beside[own]
    right[own[1:] - 1, own[1:]] = -half * beside[own[1:] - 1]
    z = (pole * half)[:, None]
    bands = np.zeros((3, len(pole), size), dtype=complex)
    bands[0, :, 1:], bands[2, :, :-1], bands[1] = z * beside, -z * beside, 1.0
    bands[1, :, :1] -= z
    every = np.tile(right, (len(pole), 1))
    found = solve_banded((1, 1), bands.reshape(3, -1), every, check_finite=False)
    return found.reshape(len(pole), size, count)[:, :count]
