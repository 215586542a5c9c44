"""How strongly a reduced rotor is joined to what its coordinates leave out, at most.

For every motion e^(st) with |s| = R of the coordinates, the forces that it puts on the rest of the
assembled rotor (``Unreduced``), and how far that rest is from resting stiffness alone. These are
norms, bounds for the whole circle: (R² + σ) ‖ΨᵀMv‖ of inertia, R Ω ‖ΨᵀPv‖ of the gyroscopic effect,
the work of the axial force, and what bearings, supports and drawbar add.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import position
from rotordyn.numerics.products import times
from rotordyn.system.connections import moved
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.dofs import BOTH_PLANES
from rotordyn.system.unreduced import Unreduced

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Inexact = NDArray[np.inexact]
Flags = NDArray[np.bool_]


class Joined(Protocol):
    """What is asked of a reduced system: bending, axial motion or torsion (see ``estimate``)."""

    @property
    def planes(self) -> int: ...
    @property
    def freedoms(self) -> int: ...
    @property
    def rows(self) -> Array: ...
    @property
    def connected(self) -> Array: ...
    @property
    def held(self) -> Inexact: ...
    @property
    def damped(self) -> Inexact: ...
    @property
    def force(self) -> Array | None: ...
    @property
    def unreduced(self) -> Unreduced | None: ...


@dataclass(frozen=True, eq=False, slots=True)
class Leakage:
    """Of one motion at ``spin`` (speeds,) [rad/s] on circles of ``radius`` (speeds,) [rad/s].

    ``softened`` [1/s²] (speeds,): Ω² where it is subtracted with the translational mass, else 0.
    ``loss``: of the rotor's stiffness, a factor of it in either plane or between them.
    """

    system: Joined
    whole: Unreduced
    spin: Array
    radius: Array
    softened: Array
    loss: float = 0.0

    def own(self) -> Array:
        """q: the rest of the rotor over its stiffness K + σM, less 1 (speeds,)."""
        whole, ends = self.whole, self._ends()
        blocks = _norms(self.system.held) + self.radius[:, None] * _norms(self.system.damped)
        return np.asarray(
            self.loss
            + (self.radius**2 + whole.shift + self.softened) * whole.mass_norm
            + self.radius * np.abs(self.spin) * whole.polar_norm
            + self._force() * whole.slope_norm**2
            + _norm(whole.bar_rows[0]) ** 2
            + self._turning @ np.linalg.norm(whole.damper_rows[0], axis=1) ** 2
            + self._material * self._damped()
            + blocks @ ends**2
        )

    def forces(self, vector: Complex, side: float, *, grounded: bool = True) -> Array:
        """Norms of the forces on the rest (speeds, k) by motions (speeds, n, k); ``side`` −1: by
        left vectors. Without those of bearings and supports where these are not ``grounded``."""
        whole, planes = self.whole, self.system.planes
        v = vector.reshape(len(vector), planes, -1, vector.shape[-1])
        inertia = self.radius**2 + (1.0 + self.loss) * whole.shift
        total = inertia[:, None] * _lengths(_triangle(whole.mass_coupling), v)
        if self.spin.any() and whole.polar is not None:
            gyroscopic = self.radius * np.abs(self.spin)
            total += gyroscopic[:, None] * _lengths(_triangle(whole.polar_coupling), v)
        if whole.slope is not None and self._force().any():
            slope = _triangle(np.pad(whole.slope @ whole.basis.vectors, ((0, 0), (0, whole.more))))
            total += (self._force() * whole.slope_norm)[:, None] * _lengths(slope, v)
        own = self.whole.material
        if own.mass or own.stiffness:
            rate = self._material * (own.mass + own.stiffness * whole.shift)
            total += rate[:, None] * _lengths(_triangle(whole.mass_coupling), v)
        if own.ratio:
            answers = whole.answers[:, None] * v
            swift = whole.frequencies[:, None] * answers
            size = np.sqrt(_length(answers) * _length(swift))
            total += (self._material * 2.0 * own.ratio * whole.mass_norm**0.25)[:, None] * size
        if self.softened.any():
            reach = self.softened * np.sqrt(whole.mass_norm)
            total += reach[:, None] * _length(v)
        rest, bar = whole.bar_rows
        if len(bar):
            total += _norm(rest) * _lengths(bar, v)
        for rate, rest, damped in zip(self._turning.T, *whole.damper_rows, strict=True):
            total += (rate * np.linalg.norm(rest))[:, None] * _lengths(damped[None], v)
        return np.asarray(total + self._held(v, side) if grounded else total)

    @property
    def _material(self) -> Array:
        """|s − iΩ·share| of the rotor's own damping, at most (speeds,)."""
        return self.radius + self.whole.material.turns * np.abs(self.spin)

    @property
    def _turning(self) -> Array:
        """|s − iΩ| of every damper that turns with its rotor, at most (speeds, dampers)."""
        ratio = np.abs(np.array(self.whole.turning))
        return np.asarray(self.radius[:, None] + np.abs(self.spin)[:, None] * ratio)

    def _held(self, v: Complex, side: float) -> Array:
        """By bearings and supports (speeds, k)."""
        if not len(self.system.rows):
            return np.zeros((1, 1))
        stretched = np.einsum("cim,spmk->scpik", self.system.rows, v, optimize=True)
        stretched = stretched.reshape(*stretched.shape[:2], -1, stretched.shape[-1])
        held, damped = self.system.held, self.system.damped
        if side < 0.0:
            held, damped = np.swapaxes(held, -1, -2), np.swapaxes(damped, -1, -2)
        force = np.linalg.norm(held @ stretched, axis=2)
        force = force + self.radius[:, None, None] * np.linalg.norm(damped @ stretched, axis=2)
        return np.einsum("c,sck->sk", self._ends(), force)

    def _damped(self) -> float:
        """Norm of the rotor's own damping [s]: of a mode left out, of unit stiffness, 2ζ/ω."""
        own, mass = self.whole.material, self.whole.mass_norm
        return own.stiffness + own.mass * mass + 2.0 * own.ratio * math.sqrt(mass)

    def _force(self) -> Array:
        """Largest axial force (speeds,) [N]."""
        force = self.system.force
        return np.zeros(1) if force is None else np.abs(force).max(axis=1, initial=0.0)

    def _ends(self) -> Array:
        """Motion at every bearing and support by what is left out, at most (c,)."""
        acts = _acting(self.system.held, self.system.damped)
        planes = np.split(acts, self.system.planes, axis=1)
        return self.ends(self.system.connected, np.any(planes, axis=0))

    def ends(self, connected: Array, acts: Flags) -> Array:
        """The same at some of them, by the freedoms (c, k) there that something ``acts`` on."""
        seen = self.whole.seen
        width = self.system.freedoms
        nodal = seen.reshape(len(seen) // width, width, seen.shape[1])
        each = np.where(acts[:, :, None], moved(connected, nodal), 0.0)
        squares = np.linalg.eigvalsh(each @ np.swapaxes(each, 1, 2))
        return np.asarray(np.sqrt(squares.max(axis=1, initial=0.0)))

    def acted_on(self, acts: Flags) -> Flags:
        """Of freedoms of nodes (c, 6) those of this motion (c, k), in bending both planes together;
        all of a motion that has but one."""
        if self.system.freedoms == 1:
            return np.ones((len(acts), 1), dtype=bool)
        y, tilt_z, z, tilt_y = (acts[:, position(name)] for name in BOTH_PLANES.names)
        return np.stack([y | z, tilt_z | tilt_y], axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class CoupledLeakage:
    """Of motions that supports couple: ``parts`` by their names in ``system``."""

    system: CoupledSystem
    parts: Mapping[str, Leakage]
    radius: Array

    def own(self) -> Array:
        """q of all parts and of what supports add between them (speeds,)."""
        ends = self._ends()
        stiff, damped = (np.linalg.norm(block, 2, axis=(-2, -1)) for block in self.system.supports)
        between = (ends**2 * stiff).sum() + self.radius * (ends**2 * damped).sum()
        largest = np.max([np.broadcast_to(p.own(), len(self.radius)) for p in self.parts.values()])
        return np.asarray(between + largest)

    def forces(self, vector: Complex, side: float) -> Array:
        """As of one motion."""
        system, grounded = self.system, self.system.carried is None
        own = [
            part.forces(vector[:, system.places[name]], side, grounded=grounded)
            for name, part in self.parts.items()
        ]
        squares = np.sum([part**2 for part in own], axis=0)
        joined = self._between(vector, side) if grounded else self._on_housings(vector, side)
        return np.asarray(np.sqrt(squares) + joined)

    def _between(self, vector: Complex, side: float) -> Array:
        """By what supports add between motions (speeds, k)."""
        system = self.system
        blocks = system.supports if side > 0.0 else np.swapaxes(system.supports, -1, -2)
        at = np.einsum("cin,snk->scik", system.at_supports, vector, optimize=True)
        stiff, damped = (np.linalg.norm(block @ at, axis=2) for block in blocks)
        between = stiff + self.radius[:, None, None] * damped
        return np.einsum("c,sck->sk", self._ends(), between)

    def _on_housings(self, vector: Complex, side: float) -> Array:
        """By bearings and supports, which answer to the motion against what they stand on."""
        on = self.system.carried
        assert on is not None, "asked of a rotor on housings only"
        held, damped = on.held, on.damped
        if side < 0.0:
            held, damped = np.swapaxes(held, -1, -2), np.swapaxes(damped, -1, -2)
        apart = np.einsum("cin,snk->scik", on.apart, vector, optimize=True)
        force = np.linalg.norm(held @ apart, axis=2)
        force = force + self.radius[:, None, None] * np.linalg.norm(damped @ apart, axis=2)
        acts = _acting(on.held, on.damped)
        parts = self.parts.values()
        ends = np.max([part.ends(on.connected, part.acted_on(acts)) for part in parts], axis=0)
        return np.einsum("c,sck->sk", ends, force)

    def _ends(self) -> Array:
        """Motion at every support by what is left out, at most (supports,)."""
        count, acts = len(self.system.at_supports), _acting(self.system.supports)
        parts = ((part, part.system.connected) for part in self.parts.values())
        found = [
            part.ends(connected[len(connected) - count :], part.acted_on(acts))
            for part, connected in parts
        ]
        return np.asarray(np.max(found, axis=0))


def _acting(*blocks: Inexact) -> Flags:
    """Which freedoms (c, k) matrices (…, c, k, k) of connections act on, or answer to."""
    size = sum(np.abs(block).max(axis=0) for block in blocks)
    return np.asarray((size.sum(axis=-1) + size.sum(axis=-2)) > 0.0)


def _triangle(matrix: Array) -> Array:
    """A matrix of as few rows that makes vectors as long."""
    return np.asarray(np.linalg.qr(matrix, mode="r"))


def _lengths(matrix: Array, v: Complex) -> Array:
    """Length of matrix · v (speeds, k), v (speeds, planes, m, k)."""
    found = times(matrix, v)
    return np.asarray(np.sqrt((found.real**2 + found.imag**2).sum(axis=(1, 2))))


def _length(v: Complex) -> Array:
    """Of vectors (speeds, k), v (speeds, planes, m, k)."""
    return np.asarray(np.linalg.norm(v, axis=(1, 2)))


def _norms(blocks: Inexact) -> Array:
    """Largest singular values (speeds, c) of blocks (speeds, c, k, k), at most."""
    return np.asarray(np.linalg.norm(blocks, axis=(-2, -1)))


def _norm(matrix: Array) -> float:
    return float(np.linalg.norm(matrix, 2)) if matrix.size else 0.0
