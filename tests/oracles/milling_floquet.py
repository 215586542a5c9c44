"""Milling of a modal machine in the time domain: Floquet multipliers by Chebyshev collocation.

x' = A x + B F, F = −a H(t) (u(t) − u(t − T)) − a C(t) u', u = E x. Spans in which a tooth cuts are
pieces of at most one wave of the fastest mode, each with Chebyshev points; where no tooth cuts the
motion is free. Written apart from ``rotordyn``: no receptance, no harmonics (Butcher 2009).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

Array = NDArray[np.float64]
POINTS = 16


@dataclass(frozen=True)
class Machine:
    """Modes along feed and normal, or inclined: frequency [Hz], damping ratio, stiffness [N/m] and
    direction (x, y)."""

    modes: tuple[tuple[float, float, float, tuple[float, float]], ...]

    def receptance(self, omega: Array) -> NDArray[np.complex128]:
        found = np.zeros((len(omega), 2, 2), dtype=complex)
        for hertz, ratio, stiffness, direction in self.modes:
            r = omega / (2.0 * math.pi * hertz)
            shape = np.outer(direction, direction)
            found += (1.0 / (stiffness * (1.0 - r**2 + 2j * ratio * r)))[:, None, None] * shape
        return found

    @cached_property
    def system(self) -> tuple[Array, Array, Array]:
        n = len(self.modes)
        A, B, E = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, 2)), np.zeros((2, 2 * n))
        for k, (hertz, ratio, stiffness, direction) in enumerate(self.modes):
            w = 2.0 * math.pi * hertz  # q scaled by w: states are of one size
            A[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = [[0.0, w], [-w, -2.0 * ratio * w]]
            B[2 * k + 1] = np.array(direction) * w / stiffness
            E[:, 2 * k] = direction
        return A, B, E


def tooth(kt: float, kn: float, angle: float) -> Array:
    s, c = math.sin(angle), math.cos(angle)
    return np.array(
        [
            [(kt * c + kn * s) * s, (kt * c + kn * s) * c],
            [(kn * c - kt * s) * s, (kn * c - kt * s) * c],
        ]
    )


@dataclass(frozen=True)
class Milling:
    machine: Machine
    teeth: int
    kt: float
    kn: float
    entry: float
    exit: float
    speed: float
    lag: float = 0.0
    ploughing: float = 0.0

    def rubbing(self, angle: float) -> Array:
        """C of all teeth: process damping along the normal to the cut surface."""
        return replace(self, kt=0.0, kn=self.ploughing).force(angle)

    def force(self, angle: float) -> Array:
        """H of all teeth; a helical edge by Gauss points over the part in cut."""
        pitch, total = 2.0 * math.pi / self.teeth, np.zeros((2, 2))
        x, w = np.polynomial.legendre.leggauss(8)
        for k in range(-2 * self.teeth, 3 * self.teeth):
            at = angle + k * pitch
            if self.lag == 0.0:
                total += tooth(self.kt, self.kn, at) if self.entry < at < self.exit else 0.0
                continue
            low, high = max(at - self.lag, self.entry), min(at, self.exit)
            if high > low:
                for xi, wi in zip(x, w, strict=True):
                    own = 0.5 * (low + high) + 0.5 * (high - low) * xi
                    share = 0.5 * (high - low) * wi / self.lag
                    total += share * tooth(self.kt, self.kn, own)
        return total

    @cached_property
    def pieces(self) -> list[tuple[float, float, bool]]:
        """Start and length [s] over a tooth period, and whether a tooth cuts."""
        pitch, period = 2.0 * math.pi / self.teeth, 2.0 * math.pi / self.teeth / self.speed
        marks = np.array([self.entry, self.exit, self.entry + self.lag, self.exit + self.lag])
        ends = np.unique(np.round(np.mod(marks - self.entry, pitch) / pitch, 12) % 1.0)
        ends = np.append(ends, 1.0)
        found = []
        fastest = max(mode[0] for mode in self.machine.modes)
        for low, high in pairwise(ends):
            cuts = self.force(self.entry + 0.5 * (low + high) * pitch).any()
            many = math.ceil((high - low) * period * fastest) if cuts else 1
            step = (high - low) / many
            found += [((low + k * step) * period, step * period, bool(cuts)) for k in range(many)]
        return found

    @cached_property
    def parts(self):
        """Per piece: free motion and response to forces at its points, of displacements, of
        velocities and of the state at its end; H and C at points."""
        A, B, E = self.machine.system
        k = np.arange(POINTS)
        x = 0.5 - 0.5 * np.cos(math.pi * k / (POINTS - 1))
        weight = (-1.0) ** k
        weight[[0, -1]] *= 0.5
        with np.errstate(divide="ignore"):
            D = weight[None, :] / weight[:, None] / (x[:, None] - x[None, :] + np.eye(POINTS))
        np.fill_diagonal(D, 0.0)
        np.fill_diagonal(D, -D.sum(axis=1))
        ns, cache, found = len(A), {}, []
        for start, length, cuts in self.pieces:
            if not cuts:
                found.append((expm(A * length),))
                continue
            key = round(length * 1e12)
            if key not in cache:
                big = np.kron(D / length, np.eye(ns)) - np.kron(np.eye(POINTS), A)
                big[:ns] = 0.0
                big[:ns, :ns] = np.eye(ns)
                right = np.zeros((POINTS * ns, ns + 2 * POINTS))
                right[:ns, :ns] = np.eye(ns)
                for j in range(1, POINTS):
                    right[j * ns : (j + 1) * ns, ns + 2 * j : ns + 2 * j + 2] = B
                whole = np.linalg.solve(big, right)
                rows = [np.kron(np.eye(POINTS), each) @ whole for each in (E, E @ A)] + [
                    whole[-ns:]
                ]
                cache[key] = [part for each in rows for part in (each[:, :ns], each[:, ns:])]
            inside = np.clip(x, 1e-9, 1.0 - 1e-9)
            angles = self.entry + (start + inside * length) * self.speed
            H, C = np.zeros((2, 2 * POINTS, 2 * POINTS))
            for j, angle in enumerate(angles):
                H[2 * j : 2 * j + 2, 2 * j : 2 * j + 2] = self.force(angle)
                C[2 * j : 2 * j + 2, 2 * j : 2 * j + 2] = self.rubbing(angle)
            found.append((*cache[key], H, C))
        return found

    def multipliers(self, depth: float) -> NDArray[np.complex128]:
        """Of depth [m]; the state is the displacement at all points of the cut, then x."""
        ns = len(self.machine.system[0])
        cutting = [part for part in self.parts if len(part) > 1]
        m = 2 * POINTS * len(cutting)
        state = np.zeros((ns, m + ns))
        state[:, m:] = np.eye(ns)
        rows, at = np.zeros((m, m + ns)), 0
        for part in self.parts:
            if len(part) == 1:
                state = part[0] @ state
                continue
            free, forced, moving, moved, end, end_forced, H, C = part
            own = np.zeros((2 * POINTS, m + ns))
            own[:, at : at + 2 * POINTS] = np.eye(2 * POINTS)
            force = np.linalg.solve(
                np.eye(2 * POINTS) + depth * (H @ forced + C @ moved),
                -depth * (H @ (free @ state - own) + C @ moving @ state),
            )
            rows[at : at + 2 * POINTS] = free @ state + forced @ force
            state = end @ state + end_forced @ force
            at += 2 * POINTS
        return np.linalg.eigvals(np.vstack([rows, state]))

    def radius(self, depth: float) -> float:
        return float(np.abs(self.multipliers(depth)).max())

    def limit(self, low: float, high: float, count: int = 200) -> tuple[float, str]:
        """The least depth between two at which stability is lost, by a scan and bisection; its
        kind."""
        last = low
        for depth in np.geomspace(low, high, count):
            if self.radius(depth) > 1.0:
                a, b = last, float(depth)
                while b - a > 1e-9 * b:
                    middle = 0.5 * (a + b)
                    a, b = (a, middle) if self.radius(middle) > 1.0 else (middle, b)
                return b, self.kind(b)
            last = float(depth)
        return math.inf, ""

    def kind(self, depth: float) -> str:
        found = self.multipliers(depth)
        worst = found[np.abs(found).argmax()]
        return "flip" if abs(worst.imag) < 1e-6 and worst.real < 0.0 else "hopf"
