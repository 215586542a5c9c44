"""How far poles and receptances are off for what a reduced system leaves out (``remainder``).

With x the right and y the left vector of a pole s, normalised so that the receptance is
x y / (iω − s), and r = T x, l = Tᵀ y the forces that are not balanced on the vectors left out, the
pole moves by Σ l r / (k + s² m). Rounding δ of the stiffness moves it by y δ x. A receptance moves
likewise, with x and y the answers to forces at both ends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.system.remainder import Remainder

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Inexact = NDArray[np.inexact]
HALF_DIGIT = np.finfo(float).eps / 2.0


class Reduced(Protocol):
    """What is asked of a reduced system: bending, axial motion or torsion.

    ``rows`` (c, k, m): k displacements between the ends of each bearing or support in the m
    coordinates of a plane; ``held``, ``damped`` (speeds, c, p·k, p·k): their matrices over p
    planes; ``connected`` (c, nodes): what they join; ``freedoms``: per node of a plane.
    """

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
    def frame(self) -> Array: ...
    @property
    def weightless(self) -> Array: ...
    @property
    def force(self) -> Array | None: ...
    @property
    def remainder(self) -> Remainder | None: ...


class LeftOut(Protocol):
    """What a reduced system leaves out: forces on it, and how it answers them."""

    def forces(self, s: Complex, vector: Complex, side: float) -> Complex: ...
    def answer(self, s: Complex) -> Complex: ...
    @property
    def weightless(self) -> Array: ...
    @property
    def rounding(self) -> Array: ...
    def at(self, row: int) -> LeftOut: ...


def pole_shift(
    left_out: LeftOut, pole: Complex, vector: Complex, participation: Complex
) -> Complex:
    """Shift of poles (speeds, k) [rad/s], fixed frame, with their vectors (speeds, n, k) and left
    ones (speeds, k, n)."""
    right = left_out.forces(pole, vector, 1.0)
    left = left_out.forces(pole, np.swapaxes(participation, 1, 2), -1.0)
    missed = (left * right * left_out.answer(pole)).sum(axis=1)
    return np.asarray(missed + _lent(left_out, pole, vector, np.swapaxes(participation, 1, 2)))


def rounding_shift(
    left_out: LeftOut, stiffness: Inexact, vector: Complex, participation: Complex
) -> Array:
    """How far rounding of the elements and of the reduced ``stiffness`` (speeds, n, n) is likely to
    move the same poles (speeds, k) [rad/s].

    The root of Σ (y_i δ_ij x_j)², δ of the stiffness half its last digit, of the elements
    √(ρ_i ρ_j) with the ``rounding`` ρ of the coordinates.
    """
    right, left = np.abs(vector) ** 2, np.abs(np.swapaxes(participation, 1, 2)) ** 2
    digits = (left * ((HALF_DIGIT * np.abs(stiffness)) ** 2 @ right)).sum(axis=1)
    own = left_out.rounding[:, None]
    return np.asarray(np.sqrt(digits + (own * left).sum(axis=1) * (own * right).sum(axis=1)))


def receptance_shift(
    left_out: LeftOut, s: Complex, given: Complex, taken: Complex, ends: tuple[Array, Array]
) -> Complex:
    """Change of receptances (speeds, f) at ``s`` (speeds, f).

    ``given``, ``taken`` (speeds, n, f): answers to a unit force where it acts, and (as left
    vectors) where the response is taken; ``ends``: what is left out, seen at these two (r,).
    """
    right = left_out.forces(s, given, 1.0) - ends[0][:, None]
    left = left_out.forces(s, taken, -1.0) - ends[1][:, None]
    missed = (left * right * left_out.answer(s)).sum(axis=1)
    return np.asarray(missed + _lent(left_out, s, given, taken))


def _lent(left_out: LeftOut, s: Complex, right: Complex, left: Complex) -> Complex:
    """What taking away the mass lent to sleeves without any would do (speeds, k)."""
    return np.asarray(s * s * (left_out.weightless[:, None] * left * right).sum(axis=1))


@dataclass(frozen=True, eq=False, slots=True)
class Unbalanced:
    """Forces on what a system leaves out, at ``spin`` (speeds,) [rad/s].

    ``connected`` (r, c, k): the vectors left out at bearings and supports; ``pressed``
    (speeds or 1, r, m): their coupling by the axial force.
    """

    system: Reduced
    remainder: Remainder
    spin: Array
    held: Inexact
    damped: Inexact
    connected: Array
    pressed: Array

    @classmethod
    def of(cls, system: Reduced, spin: Array) -> Unbalanced | None:
        """None where nothing is left out (a rigid rotor)."""
        left_out = system.remainder
        if left_out is None:
            return None
        nodal = left_out.at_nodes.reshape(len(left_out.own_mass), -1, system.freedoms)
        at_ends = np.einsum("cn,rnf->rcf", system.connected, nodal, optimize=True)
        pressed = np.zeros((1, *left_out.mass.shape))
        if system.force is not None:
            pressed = left_out.per_newton.under(system.force)
        return cls(system, left_out, spin, system.held, system.damped, at_ends, pressed)

    @property
    def weightless(self) -> Array:
        """1 for coordinates whose mass is none of the machine's, else 0 (n,)."""
        return self.system.weightless

    @property
    def rounding(self) -> Array:
        """Of the stiffness of every coordinate by its elements (n,) [1/s²]."""
        return np.tile(self.remainder.rounding, self.system.planes)

    def at(self, row: int) -> Unbalanced:
        """The same at one of the speeds; what is the same at all may have one only."""
        spin, held, damped, pressed = (
            values[min(row, len(values) - 1)][None]
            for values in (self.spin, self.held, self.damped, self.pressed)
        )
        return replace(self, spin=spin, held=held, damped=damped, pressed=pressed)

    def forces(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Unbalanced forces (speeds, p·r, k) of motions e^(st); ``side`` −1: of left vectors."""
        spun = (s * self.spin[:, None])[:, None, :]
        square = (s * s)[:, None, :]
        m = self.remainder.mass.shape[1]
        if self.system.planes == 1:
            own = self._plane(square, vector) - 1j * spun * (self.remainder.polar @ vector)
            return np.asarray(own + self._held(s, vector[:, None], side)[:, 0])
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
        still = (own.stiffness + self.pressed) @ vector
        return np.asarray(still + square * (own.mass @ vector))

    def _held(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Of bearings and supports (speeds, p, r, k) for motions (speeds, p, m, k) of p planes."""
        moved = np.einsum("cim,spmk->scpik", self.system.rows, vector, optimize=True)
        shape = moved.shape
        moved = moved.reshape(*shape[:2], shape[2] * shape[3], shape[-1])
        held, damped = self.held, self.damped
        if side < 0.0:
            held, damped = np.swapaxes(held, -1, -2), np.swapaxes(damped, -1, -2)
        force = held @ moved + (damped @ moved) * s[:, None, None, :]
        force = force.reshape(shape)
        return np.einsum("rci,scpik->sprk", self.connected, force, optimize=True)

    def answer(self, s: Complex) -> Complex:
        """1/(k + s² m) of every vector left out (speeds, p·r, k)."""
        own = self.remainder
        dynamic = own.own_stiffness[:, None] + (s * s)[:, None, :] * own.own_mass[:, None]
        return np.concatenate([1.0 / dynamic] * self.system.planes, axis=1)


@dataclass(frozen=True, eq=False, slots=True)
class Ground:
    """Bearings, then supports, on housings: matrices (speeds, c, 6, 6) and motion ``under`` them
    (c, 6, n), of which the last ``size`` coordinates are those of the housings."""

    held: Inexact
    damped: Array
    under: Array
    size: int

    def at(self, row: int) -> Ground:
        """The same at one of the speeds."""
        return replace(self, held=self.held[row][None], damped=self.damped[row][None])

    def forces(self, s: Complex, vector: Complex, side: float) -> Complex:
        """What the connections answer to motion under them (speeds, c, 6, k)."""
        held, damped = self.held, self.damped
        if side < 0.0:
            held, damped = np.swapaxes(held, -1, -2), np.swapaxes(damped, -1, -2)
        moved = np.einsum("cin,snk->scik", self.under, vector, optimize=True)
        return np.asarray(held @ moved + (damped @ moved) * s[:, None, None, :])


@dataclass(frozen=True, eq=False, slots=True)
class Joined:
    """The same of motions that supports couple: ``parts`` with their ``places`` among the
    coordinates, and the ``supports``' matrices (2, supports, 6, 6), stiffness and damping, of which
    only what is between two motions counts; ``motion`` (supports, 6, n): of their nodes.
    ``ground``: what stands on housings, whose coordinates are the last and leave nothing out."""

    parts: Mapping[str, Unbalanced]
    places: Mapping[str, slice]
    supports: Inexact
    motion: Array
    ground: Ground | None = None

    @property
    def weightless(self) -> Array:
        """Of all parts, in the order of the coordinates (n,)."""
        return self._padded([part.weightless for part in self.parts.values()])

    @property
    def rounding(self) -> Array:
        """Of all parts, likewise (n,)."""
        return self._padded([part.rounding for part in self.parts.values()])

    def _padded(self, values: list[Array]) -> Array:
        return np.concatenate([*values, np.zeros(self.ground.size if self.ground else 0)])

    def at(self, row: int) -> Joined:
        """The same at one of the speeds."""
        parts = {name: part.at(row) for name, part in self.parts.items()}
        return replace(self, parts=parts, ground=self.ground.at(row) if self.ground else None)

    def forces(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Unbalanced forces (speeds, r, k) of motions e^(st); ``side`` −1: of left vectors."""
        blocks = self.supports if side > 0.0 else np.swapaxes(self.supports, -1, -2)
        moved = np.einsum("cin,snk->scik", self.motion, vector, optimize=True)
        between = blocks[0] @ moved + (blocks[1] @ moved) * s[:, None, None, :]
        found = []
        for name, part in self.parts.items():
            own = part.forces(s, vector[:, self.places[name]], side)
            own = own + _onto(part, name, between)
            if self.ground is not None:
                own = own - _onto(part, name, self.ground.forces(s, vector, side))
            found.append(own)
        return np.concatenate(found, axis=1)

    def answer(self, s: Complex) -> Complex:
        """1/(k + s² m) of every vector left out."""
        return np.concatenate([part.answer(s) for part in self.parts.values()], axis=1)


_ENDS = {"bending": (1, 5, 2, 4), "axial": (0,), "torsion": (3,)}
_SIGNS = np.array([1.0, 1.0, 1.0, -1.0])


def _onto(part: Unbalanced, name: str, force: Complex) -> Complex:
    """Forces (speeds, c, 6, k) on nodes of bearings and supports, as met by what a part leaves
    out; of supports alone where there are as many."""
    places = list(_ENDS[name])
    force = force[:, max(0, force.shape[1] - part.connected.shape[1]) :]
    own = force[:, :, places] * _SIGNS[: len(places), None]
    planes = part.system.planes
    shaped = own.reshape(*own.shape[:2], planes, len(places) // planes, own.shape[-1])
    at_supports = part.connected[:, part.connected.shape[1] - force.shape[1] :]
    found = np.einsum("rci,scpik->sprk", at_supports, shaped, optimize=True)
    return found.reshape(len(force), -1, force.shape[-1])
