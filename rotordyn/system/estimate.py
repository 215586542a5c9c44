"""How far poles and receptances are off for what a reduced system leaves out (``remainder``).

With x the right and y the left vector of a pole s, normalised so that the receptance is
x y / (iω − s), and r = T x, l = Tᵀ y the forces that are not balanced on the vectors left out, the
pole moves by Σ l r / (k + s² m). A receptance moves likewise, with x and y the answers to forces at
both ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.system.lateral import LateralSystem
from rotordyn.system.remainder import Remainder

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Inexact = NDArray[np.inexact]


@dataclass(frozen=True, eq=False, slots=True)
class Unbalanced:
    """Forces on what a lateral system leaves out, at ``spin`` (speeds,) [rad/s].

    ``connected`` (r, c, 2): deflection and tilt of the vectors left out at bearings and supports.
    """

    system: LateralSystem
    remainder: Remainder
    spin: Array
    connected: Array

    @classmethod
    def of(cls, system: LateralSystem, spin: Array) -> Unbalanced | None:
        """None where nothing is left out (a rigid rotor)."""
        left_out = system.rotor.remainder
        if left_out is None:
            return None
        nodal = left_out.at_nodes.reshape(len(left_out.own_mass), -1, 2)
        return cls(system, left_out, spin, nodal[:, list(system.rotor.connected)])

    def pole_shift(self, pole: Complex, vector: Complex, participation: Complex) -> Complex:
        """Shift of poles (speeds, k) [rad/s] with their vectors (speeds, n, k) and left ones
        (speeds, k, n)."""
        s = pole + 1j * self.system.frame[:, None]
        right = self._forces(s, vector, 1.0)
        left = self._forces(s, np.swapaxes(participation, 1, 2), -1.0)
        return np.asarray((left * right * self._answer(s)).sum(axis=1))

    def receptance_shift(
        self, s: Complex, given: Complex, taken: Complex, force: Array, response: Array
    ) -> Complex:
        """Change of a receptance (speeds, f) at i·frequencies ``s`` (f,).

        ``given``, ``taken`` (speeds, n, f): answers to a unit force where it acts and where the
        response is taken; ``force``, ``response`` (p·r,): those places seen by what is left out.
        """
        at = s + 1j * self.system.frame[:, None]
        right = self._forces(at, given, 1.0) - force[:, None]
        left = self._forces(at, taken, -1.0) - response[:, None]
        return np.asarray((left * right * self._answer(at)).sum(axis=1))

    def at_node(self, node: int, freedom: str) -> Array:
        """A node's freedom y, z, thy or thz seen by what is left out (p·r,)."""
        own = self.remainder.at_nodes[:, 2 * node + (0 if freedom in ("y", "z") else 1)]
        if self.system.isotropic:
            return own
        zero = np.zeros_like(own)
        sign = -1.0 if freedom == "thy" else 1.0
        planes = (own, zero) if freedom in ("y", "thz") else (zero, sign * own)
        return np.concatenate(planes)

    def _forces(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Unbalanced forces (speeds, p·r, k) of motions e^(st); ``side`` −1: of left vectors."""
        spun = (s * self.spin[:, None])[:, None, :]
        square = (s * s)[:, None, :]
        m = self.system.rotor.size
        if self.system.isotropic:
            own = self._plane(square, vector) - 1j * spun * (self.remainder.polar @ vector)
            return own + self._held(s, vector[:, None], side)[:, 0]
        y, z = vector[:, :m], vector[:, m:]
        across = [side * spun * (self.remainder.polar @ v) for v in (z, y)]
        held = self._held(s, np.stack([y, z], axis=1), side)
        forces = (
            self._plane(square, y) + across[0] + held[:, 0],
            self._plane(square, z) - across[1] + held[:, 1],
        )
        return np.concatenate(forces, axis=1)

    def _plane(self, square: Complex, vector: Complex) -> Complex:
        """Of stiffness and inertia within a plane."""
        own = self.remainder
        return np.asarray(own.stiffness @ vector + square * (own.mass @ vector))

    def _held(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Of bearings and supports (speeds, p, r, k) for motions (speeds, p, m, k) of p planes."""
        rotor = self.system.rotor
        rows = np.concatenate([rotor.seats, rotor.supports])
        moved = np.einsum("cim,spmk->scpik", rows, vector, optimize=True)
        shape = moved.shape
        moved = moved.reshape(*shape[:2], -1, shape[-1])
        blocks = self.system.held, self.system.damped
        if side < 0.0:
            blocks = tuple(np.swapaxes(b, -1, -2) for b in blocks)
        force = blocks[0] @ moved + (blocks[1] @ moved) * s[:, None, None, :]
        force = force.reshape(shape)
        return np.einsum("rci,scpik->sprk", self.connected, force, optimize=True)

    def _answer(self, s: Complex) -> Complex:
        """1/(k + s² m) of every vector left out (speeds, p·r, k)."""
        own = self.remainder
        dynamic = own.own_stiffness[:, None] + (s * s)[:, None, :] * own.own_mass[:, None]
        planes = 1 if self.system.isotropic else 2
        return np.concatenate([1.0 / dynamic] * planes, axis=1)
