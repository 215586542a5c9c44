"""How far poles and receptances are off for what a reduced system leaves out (``remainder``).

With x the right and y the left vector of a pole s, normalised so that the receptance is
x y / (iω − s), and r = T x, l = Tᵀ y the forces that are not balanced on the vectors left out, the
pole moves by Σ l r / (k + s² m). Rounding δ of the stiffness moves it by y δ x. A receptance moves
likewise, with x and y the answers to forces at both ends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.products import times
from rotordyn.numerics.reduction import HALF_DIGIT
from rotordyn.system.remainder import Remainder

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Inexact = NDArray[np.inexact]


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
    def returned(self, s: Complex, moved: Complex, side: float) -> Complex: ...
    def lent(self, s: Complex, vector: Complex) -> Complex: ...
    def answer(self, s: Complex) -> Complex: ...
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
    lent = left_out.lent(pole, vector) * np.swapaxes(participation, 1, 2)
    return np.asarray((left * right * left_out.answer(pole)).sum(axis=1) + lent.sum(axis=1))


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


def met(
    left_out: LeftOut, s: Complex, answer: Complex, end: Array, side: float
) -> tuple[Complex, Complex]:
    """What is left out moves by (speeds, r, f), and its forces back on the system (speeds, n, f).

    ``answer`` (speeds, n, f): of the system at ``s`` (speeds, f) to a unit force where what is left
    out is seen as ``end`` (r,); ``side`` −1: as a left vector. With rows t and u of another end a
    receptance changes by t Z⁻¹ F − u m, m the motion and F the forces: one more solution serves
    all receptances that have an end in common.
    """
    moved = (left_out.forces(s, answer, side) - end[:, None]) * left_out.answer(s)
    return moved, left_out.returned(s, moved, side) + left_out.lent(s, answer)


class Loss(NamedTuple):
    """What a loss factor adds to a stiffness: its ``even`` times that within a plane, ``odd`` times
    it from plane z to y, and back with opposite sign."""

    even: complex
    odd: complex


NO_LOSS = Loss(0j, 0j)


@dataclass(frozen=True, eq=False, slots=True)
class ResidualForces:
    """Forces on what a system leaves out, at ``spin`` (speeds,) [rad/s].

    ``connected`` (r, c, k): the vectors left out at bearings and supports; ``pressed``
    (speeds or 1, r, m): their coupling by the axial force and the drawbar; ``loss``: of the shaft;
    ``elements``: only what these leave out answers, and not modes.
    """

    system: Reduced
    remainder: Remainder
    spin: Array
    held: Inexact
    damped: Inexact
    connected: Array
    pressed: Array
    loss: Loss
    elements: bool

    @classmethod
    def of(
        cls, system: Reduced, spin: Array, loss: Loss = NO_LOSS, *, elements: bool = False
    ) -> ResidualForces | None:
        """None where nothing is left out (a rigid rotor); ``elements``: by these alone."""
        left_out = system.remainder
        if left_out is None:
            return None
        nodal = left_out.at_nodes.reshape(len(left_out.own_mass), -1, system.freedoms)
        at_ends = np.einsum("cn,rnf->rcf", system.connected, nodal, optimize=True)
        pressed = np.zeros((1, *left_out.mass.shape))
        if system.force is not None:
            pressed = left_out.per_newton.under(system.force) + left_out.strung
        return cls(
            system, left_out, spin, system.held, system.damped, at_ends, pressed, loss, elements
        )

    @property
    def weightless(self) -> Array:
        """1 for coordinates whose mass is none of the machine's, else 0 (n,)."""
        return self.system.weightless

    @property
    def rounding(self) -> Array:
        """Of the stiffness of every coordinate by its elements (n,) [1/s²]."""
        return np.tile(self.remainder.rounding, self.system.planes)

    def at(self, row: int) -> ResidualForces:
        """The same at one of the speeds; what is the same at all may have one only."""
        spin, held, damped, pressed = (
            values[min(row, len(values) - 1)][None]
            for values in (self.spin, self.held, self.damped, self.pressed)
        )
        return replace(self, spin=spin, held=held, damped=damped, pressed=pressed)

    def forces(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Unbalanced forces (speeds, p·r, k) of motions e^(st); ``side`` −1: of left vectors."""
        spun = (s * self.spin[:, None])[:, None, :]
        m = self.remainder.mass.shape[1]
        if self.system.planes == 1:
            own = self._plane(s, vector) - 1j * spun * times(self.remainder.polar, vector)
            own = own - 1j * self._turned(vector)
            return np.asarray(own + self._held(s, vector[:, None], side)[:, 0])
        y, z = vector[:, :m], vector[:, m:]
        across = [side * (spun * times(self.remainder.polar, v) + self._turned(v)) for v in (z, y)]
        held = self._held(s, np.stack([y, z], axis=1), side)
        forces = (
            self._plane(s, y) + across[0] + held[:, 0],
            self._plane(s, z) - across[1] + held[:, 1],
        )
        return np.concatenate(forces, axis=1)

    def returned(self, s: Complex, moved: Complex, side: float) -> Complex:
        """Forces on the coordinates (speeds, n, k) of motions (speeds, p·r, k) of what is left out:
        transposed to ``forces`` of the other side."""
        spun = (s * self.spin[:, None])[:, None, :]
        polar = self.remainder.polar.T
        if self.system.planes == 1:
            own = self._plane_back(s, moved) - 1j * spun * (polar @ moved)
            own = own - 1j * self._turned_back(moved)
            return np.asarray(own + self._held_back(s, moved[:, None], side)[:, 0])
        y, z = np.split(moved, 2, axis=1)
        held = self._held_back(s, np.stack([y, z], axis=1), side)
        across = [side * (spun * (polar @ v) + self._turned_back(v)) for v in (z, y)]
        forces = (
            self._plane_back(s, y) + across[0] + held[:, 0],
            self._plane_back(s, z) - across[1] + held[:, 1],
        )
        return np.concatenate(forces, axis=1)

    def _plane_back(self, s: Complex, moved: Complex) -> Complex:
        own, at = self.remainder, s[:, None, :]
        held = (1.0 + self.loss.even) * own.stiffness + self.pressed
        still = np.swapaxes(held, -1, -2) @ moved
        if own.damped is not None:
            still = still + at * (own.damped.coupling.T @ moved)
        return np.asarray(still + at * at * (own.mass.T @ moved))

    def _turned_back(self, moved: Complex) -> Complex:
        own = self.remainder
        turned = self.loss.odd * (own.stiffness.T @ moved)
        if own.damped is not None:
            turned = turned + self.spin[:, None, None] * (own.damped.turning.T @ moved)
        return np.asarray(turned)

    def _held_back(self, s: Complex, moved: Complex, side: float) -> Complex:
        rows, onto = self.connected.transpose(1, 2, 0), self.system.rows.transpose(2, 0, 1)
        return self._between(s, moved, side, rows, onto)

    def _plane(self, s: Complex, vector: Complex) -> Complex:
        """Of stiffness, damping in the fixed frame and inertia within a plane."""
        own, at = self.remainder, s[:, None, :]
        held = own.stiffness if self.loss is NO_LOSS else (1.0 + self.loss.even) * own.stiffness
        still = times(held + self.pressed, vector)
        if own.damped is not None:
            still = still + at * times(own.damped.coupling, vector)
        return np.asarray(still + at * at * times(own.mass, vector))

    def _turned(self, vector: Complex) -> Complex:
        """Of damping that turns with the rotor, a quarter turn ahead."""
        own, turned = self.remainder, np.zeros((1, 1, 1), dtype=complex)
        if self.loss.odd:
            turned = self.loss.odd * times(own.stiffness, vector)
        if own.damped is not None:
            turned = turned + self.spin[:, None, None] * times(own.damped.turning, vector)
        return turned

    def lent(self, s: Complex, vector: Complex) -> Complex:
        """Forces on the coordinates (speeds, n, k) by the mass lent to what has none, which the
        system has and the machine has not, of motions (speeds, n, k)."""
        if self.elements or not self.weightless.any():
            return np.zeros_like(vector)
        return np.asarray((s * s)[:, None, :] * self.weightless[:, None] * vector)

    def _held(self, s: Complex, vector: Complex, side: float) -> Complex:
        """Of bearings and supports (speeds, p, r, k) for motions (speeds, p, m, k) of p planes."""
        return self._between(s, vector, side, self.system.rows, self.connected)

    def _between(
        self, s: Complex, vector: Complex, side: float, rows: Array, onto: Array
    ) -> Complex:
        """Forces of bearings and supports on vectors that move as ``onto`` (b, c, i) there, of
        motions (speeds, p, a, k) of vectors that do as ``rows`` (c, i, a)."""
        moved = np.einsum("cia,spak->scpik", rows, vector, optimize=True)
        shape = moved.shape
        moved = moved.reshape(*shape[:2], shape[2] * shape[3], shape[-1])
        held, damped = self.held, self.damped
        if side < 0.0:
            held, damped = np.swapaxes(held, -1, -2), np.swapaxes(damped, -1, -2)
        force = held @ moved + (damped @ moved) * s[:, None, None, :]
        return np.einsum("bci,scpik->spbk", onto, force.reshape(shape), optimize=True)

    def answer(self, s: Complex) -> Complex:
        """1/(k + s² m) of every vector left out (speeds, p·r, k)."""
        own = self.remainder
        held = (1.0 + self.loss.even) * own.own_stiffness[:, None]
        dynamic = held + (s * s)[:, None, :] * own.own_mass[:, None]
        if own.damped is not None:
            dynamic = dynamic + s[:, None, :] * own.damped.own[:, None]
        moved = 1.0 / dynamic
        if self.elements:  # what finer ones add vanishes at nodes
            moved[:, (own.at_nodes != 0.0).any(axis=1)] = 0.0
        return np.concatenate([moved] * self.system.planes, axis=1)


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

    def returned(self, s: Complex, moved: Complex, side: float) -> Complex:
        """Forces on the coordinates (speeds, n, k) of motions (speeds, c, 6, k) at connections, or
        at supports alone where there are as many."""
        moved = np.pad(moved, ((0, 0), (len(self.under) - moved.shape[1], 0), (0, 0), (0, 0)))
        held, damped = self.held, self.damped
        if side < 0.0:
            held, damped = np.swapaxes(held, -1, -2), np.swapaxes(damped, -1, -2)
        force = held @ moved + (damped @ moved) * s[:, None, None, :]
        return np.einsum("cin,scik->snk", self.under, force, optimize=True)


@dataclass(frozen=True, eq=False, slots=True)
class CoupledResidualForces:
    """The same of motions that supports couple: ``parts`` with their ``places`` among the
    coordinates, and the ``supports``' matrices (2, supports, 6, 6), stiffness and damping, of which
    only what is between two motions counts; ``motion`` (supports, 6, n): of their nodes.
    ``ground``: what stands on housings, whose coordinates are the last and leave nothing out."""

    parts: Mapping[str, ResidualForces]
    places: Mapping[str, slice]
    supports: Inexact
    motion: Array
    ground: Ground | None = None

    def lent(self, s: Complex, vector: Complex) -> Complex:
        """Of all parts, in the order of the coordinates (speeds, n, k)."""
        whole = np.zeros_like(vector)
        for name, part in self.parts.items():
            own = self.places[name]
            whole[:, own] = part.lent(s, vector[:, own])
        return whole

    @property
    def rounding(self) -> Array:
        """Of all parts, likewise (n,)."""
        return self._padded([part.rounding for part in self.parts.values()])

    def _padded(self, values: list[Array]) -> Array:
        return np.concatenate([*values, np.zeros(self.ground.size if self.ground else 0)])

    def at(self, row: int) -> CoupledResidualForces:
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

    def returned(self, s: Complex, moved: Complex, side: float) -> Complex:
        """Forces on the coordinates (speeds, n, k) of motions (speeds, r, k) of what is left out:
        transposed to ``forces`` of the other side."""
        blocks = self.supports if side > 0.0 else np.swapaxes(self.supports, -1, -2)
        size, count = self.motion.shape[-1], len(self.motion)
        whole = np.zeros((len(moved), size, moved.shape[-1]), dtype=complex)
        sizes = [len(part.answer(s)[0]) for part in self.parts.values()]
        own = np.split(moved, np.cumsum(sizes)[:-1], axis=1)
        for (name, part), mine in zip(self.parts.items(), own, strict=True):
            whole[:, self.places[name]] += part.returned(s, mine, side)
            ends = _at_connections(part, name, mine)
            at = ends[:, ends.shape[1] - count :]
            between = blocks[0] @ at + (blocks[1] @ at) * s[:, None, None, :]
            whole += np.einsum("cin,scik->snk", self.motion, between, optimize=True)
            if self.ground is not None:
                whole -= self.ground.returned(s, ends, side)
        return whole

    def answer(self, s: Complex) -> Complex:
        """1/(k + s² m) of every vector left out."""
        return np.concatenate([part.answer(s) for part in self.parts.values()], axis=1)


_ENDS = {"bending": (1, 5, 2, 4), "axial": (0,), "torsion": (3,)}
_SIGNS = np.array([1.0, 1.0, 1.0, -1.0])


def _onto(part: ResidualForces, name: str, force: Complex) -> Complex:
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


def _at_connections(part: ResidualForces, name: str, moved: Complex) -> Complex:
    """Motion (speeds, c, 6, k) of nodes of bearings and supports by what a part leaves out, moved
    by (speeds, p·r, k)."""
    planes, places = part.system.planes, list(_ENDS[name])
    shaped = moved.reshape(len(moved), planes, -1, moved.shape[-1])
    found = np.einsum("rci,sprk->scpik", part.connected, shaped, optimize=True)
    own = found.reshape(*found.shape[:2], len(places), -1)
    whole = np.zeros((*own.shape[:2], 6, own.shape[-1]), dtype=complex)
    whole[:, :, places] = own * _SIGNS[: len(places), None]
    return whole
