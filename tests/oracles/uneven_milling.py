"""Milling with teeth that stand unevenly, in the time domain: first-order semi-discretisation.

x' = A x + B F, F = −a Σ H(φ_k(t)) (u(t) − u(t − τ_k)) over the teeth k in cut, u = E x. Tooth 0 is
at φ = entry + Ω t, tooth k stands ahead of tooth k − 1 by pitches[k − 1] and cuts what the tooth
ahead of it left: τ_k = pitches[k] / Ω. Over a step H is its mean and the displacement one delay ago
linear (Insperger and Stépán 2011); steps are split where an edge enters or leaves. Written apart
from ``rotordyn``: no receptance, no harmonics.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm
from scipy.optimize import bisect
from scipy.sparse.linalg import ArpackError, eigs

from tests.oracles.milling_floquet import Machine, tooth

Array = NDArray[np.float64]
LARGEST = 8  # multipliers sought for the radius


class Pieces(NamedTuple):
    """Steps of a revolution, split where an edge enters or leaves."""

    step: NDArray[np.intp]  # number of the step
    start: Array  # of the piece, as a share of its step
    share: Array  # of the step that the piece takes
    forces: Array  # mean H of each tooth over the piece: piece, tooth, 2, 2


@dataclass(frozen=True)
class UnevenMilling:
    """Pitches [rad] sum to a revolution; an edge lags its tip by ``lag`` + ``slope`` × depth."""

    machine: Machine
    pitches: tuple[float, ...]
    kt: float
    kn: float
    entry: float
    exit: float
    speed: float
    lag: float = 0.0
    slope: float = 0.0

    def delays(self, steps: int) -> list[int]:
        """Of each tooth, in steps."""
        if not math.isclose(sum(self.pitches), 2.0 * math.pi, rel_tol=1e-9):
            raise ValueError("pitches do not sum to a revolution")
        exact = [pitch / (2.0 * math.pi) * steps for pitch in self.pitches]
        found = [round(each) for each in exact]
        if min(found) < 1 or max(abs(e - f) for e, f in zip(exact, found, strict=True)) > 1e-6:
            raise ValueError(f"a pitch is no whole number of steps of {steps} a revolution")
        return found

    @cached_property
    def _integral(self) -> tuple[Array, Array, Array]:
        """H of a tooth is a constant and a wave of two periods a revolution: those three."""
        first, second = (tooth(self.kt, self.kn, angle) for angle in (0.0, 0.5 * math.pi))
        mean = 0.5 * (first + second)
        return mean, 0.5 * (first - second), tooth(self.kt, self.kn, 0.25 * math.pi) - mean

    def integral(self, angle: Array) -> Array:
        """∫ H of a tooth up to angles, which grows between entry and exit alone."""
        mean, cosine, sine = self._integral
        at = np.clip(angle, self.entry, self.exit)[:, None, None]
        return mean * at + 0.5 * (cosine * np.sin(2.0 * at) - sine * np.cos(2.0 * at))

    def means(self, low: Array, high: Array, lag: float) -> Array:
        """Mean H of a tooth while its tip turns from ``low`` to ``high``, within [entry,
        entry + 4 π]."""
        total = np.zeros((len(low), 2, 2))
        x, w = np.polynomial.legendre.leggauss(6)
        for turn in range(math.floor(-1.0 - lag / (2.0 * math.pi)), 2):
            a, b = low - 2.0 * math.pi * turn, high - 2.0 * math.pi * turn
            if lag == 0.0:
                total += (self.integral(b) - self.integral(a)) / (b - a)[:, None, None]
                continue
            for xi, wi in zip(x, w, strict=True):
                at = 0.5 * (a + b) + 0.5 * (b - a) * xi
                total += 0.5 * wi / lag * (self.integral(at) - self.integral(at - lag))
        return total

    def moves(self, depth: float, steps: int, pieces: Pieces) -> tuple[Array, Array]:
        """State at the end of a piece by that at its start, and by the displacements one delay ago
        at the start and the end of its step for each tooth, exact for the mean H."""
        A, B, E = self.machine.system
        n, many = len(A), len(pieces.step)
        length = (pieces.share * 2.0 * math.pi / steps / self.speed)[:, None, None]
        big = np.zeros((many, n + 4, n + 4))  # x, force at the start, its growth over the piece
        big[:, :n, :n] = (A - depth * B @ pieces.forces.sum(axis=1) @ E) * length
        big[:, :n, n : n + 2] = B * length
        big[:, n : n + 2, n + 2 :] = np.eye(2)
        found = expm(big)
        level, growth = (
            found[:, None, :n, at : at + 2] @ (depth * pieces.forces) for at in (n, n + 2)
        )
        start, share = (each[:, None, None, None] for each in (pieces.start, pieces.share))
        before = (1.0 - start) * level - share * growth
        after = start * level + share * growth
        return found[:, :n, :n], np.concatenate([before, after], axis=-1)

    def monodromy(self, depth: float, steps: int) -> Array:
        """Over a revolution; the state is x and what of the past displacements is cut again."""
        E = self.machine.system[2]
        n, delays = E.shape[1], self.delays(steps)
        pieces = revolution(self, steps, self.lag + self.slope * depth)
        free, forced = self.moves(depth, steps, pieces)
        cuts = np.abs(pieces.forces).max(axis=(2, 3)) > 1e-12 * (abs(self.kt) + abs(self.kn))
        longest = max(delays)
        used = np.zeros(longest + 1, dtype=bool)  # of displacements from −longest to 0
        for k, delay in enumerate(delays):
            first = pieces.step[cuts[:, k]] - delay + longest
            for rows in (first, first + 1):
                used[rows[rows < longest]] = True
        kept = np.flatnonzero(used)
        size = n + 2 * len(kept)
        past = np.zeros((longest + steps + 1, 2, size))
        for c, row in enumerate(kept):
            past[row, :, n + 2 * c : n + 2 * c + 2] = np.eye(2)
        state = np.eye(n, size)
        past[longest] = E @ state
        for j, i in enumerate(pieces.step):
            state = free[j] @ state
            for k in np.flatnonzero(cuts[j]):
                at = i - delays[k] + longest
                state += forced[j, k] @ past[at : at + 2].reshape(4, size)
            past[longest + i + 1] = E @ state  # the last piece of a step stays
        return np.vstack([state, past[kept + steps].reshape(-1, size)])

    def multipliers(self, depth: float, steps: int) -> NDArray[np.complex128]:
        """Over a revolution of ``steps``, of which every pitch is a whole number (else a
        ValueError); of evenly spaced teeth those of a tooth period to the power of their number."""
        return np.linalg.eigvals(self.monodromy(depth, steps))

    def largest(self, depth: float, steps: int) -> complex:
        """The multiplier of largest modulus."""
        matrix = self.monodromy(depth, steps)
        with suppress(ArpackError):  # else, and if small, all of them
            if len(matrix) > 100:
                start = np.ones(len(matrix))
                found = eigs(matrix, LARGEST, ncv=40, v0=start, return_eigenvectors=False)
                return complex(found[np.abs(found).argmax()])
        found = np.linalg.eigvals(matrix)
        return complex(found[np.abs(found).argmax()])

    def radius(self, depth: float, steps: int) -> float:
        return abs(self.largest(depth, steps))

    def kind(self, depth: float, steps: int) -> str:
        """Over a revolution: an even number of tooth periods of a flip is a fold."""
        worst = self.largest(depth, steps)
        if abs(worst.imag) > 1e-6 * abs(worst):
            return "hopf"
        return "flip" if worst.real < 0.0 else "fold"

    def limit(self, low: float, high: float, steps: int, count: int = 200) -> tuple[float, str]:
        """The least depth between two at which stability is lost, by a scan and bisection; its
        kind."""
        last = low
        for depth in map(float, np.geomspace(low, high, count)):
            if self.radius(depth, steps) > 1.0:
                if depth == last:
                    raise ValueError(f"unstable at the least depth, {low}")
                found = bisect(
                    lambda each: self.radius(each, steps) - 1.0, last, depth, xtol=1e-7 * depth
                )
                return float(found), self.kind(found * (1.0 + 1e-6), steps)
            last = depth
        return math.inf, ""

    def extrapolated(
        self, low: float, high: float, steps: tuple[int, int], count: int = 200
    ) -> tuple[float, str]:
        """The limit of steps without length by those of two numbers of steps, the second the
        larger, whose errors go by the square of that length; its kind."""
        coarse, kind = self.limit(low, high, steps[0], count)
        if math.isinf(coarse):
            return coarse, kind
        fine, kind = self.limit(max(low, 0.8 * coarse), 1.25 * coarse, steps[1], 20)
        return fine + (fine - coarse) / ((steps[1] / steps[0]) ** 2 - 1.0), kind


@lru_cache(maxsize=8)
def revolution(cut: UnevenMilling, steps: int, lag: float) -> Pieces:
    """Pieces of its steps, from tooth 0 at entry."""
    offsets = np.concatenate([[0.0], np.cumsum(cut.delays(steps))[:-1]])  # in steps
    span = (cut.exit - cut.entry) * steps / (2.0 * math.pi)
    late = lag * steps / (2.0 * math.pi)
    marks = np.array([0.0, span, late, span + late])
    inner = np.mod(marks[None, :] - offsets[:, None], steps).ravel()
    inner = inner[np.abs(inner - np.round(inner)) > 1e-7]
    nodes = np.sort(np.concatenate([np.arange(steps + 1.0), inner]))
    nodes = nodes[np.append(True, np.diff(nodes) > 1e-9)]
    low, high = nodes[:-1], nodes[1:]
    step = np.floor(0.5 * (low + high)).astype(np.intp)
    turn = 2.0 * math.pi / steps
    tips = ((cut.entry + (low + o) * turn, cut.entry + (high + o) * turn) for o in offsets)
    forces = np.stack([cut.means(*tip, lag) for tip in tips], axis=1)
    return Pieces(step, low - step, high - low, forces)
