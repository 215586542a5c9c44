"""Shaft, bearings and axial arrangement under a radial force, with the full bearing model."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.angular_contact import AngularContactBallBearing
from bearings.state import BearingState
from rotordyn.errors import NoSolution
from rotordyn.preload.arrangement import HOUSING, SHAFT
from rotordyn.preload.network import Network
from rotordyn.preload.state import PreloadState
from rotordyn.system.condensed import CondensedRotor

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
PLANE = [0, 1, 4]  # x, y, θz of a bearing's five freedoms
TOLERANCE = 1e-9  # of the radial force
ITERATIONS = 30
States = dict[AngularContactBallBearing, BearingState]


@dataclass(frozen=True, eq=False, slots=True)
class Point:
    """Coordinates (speeds, p + bodies), bearing states, loads and tangents in plane y.

    ``load`` (speeds, seats, 3), ``tangent`` (speeds, seats, 3, 3): (x, y, θz) of the spindle.
    """

    coordinates: Array
    states: States
    load: Array
    tangent: Array


@dataclass(frozen=True, eq=False, slots=True)
class RadialProblem:
    """Unknowns: p coordinates of the condensed rotor, then the positions of the bodies.

    ``rows`` (seats, 3, unknowns) give (x, y, θz) between the rings; ``held`` (speeds, bodies).
    """

    network: Network
    rotor: CondensedRotor
    rows: Array
    position: Array
    held: Flags
    limit: Array

    @classmethod
    def at(
        cls, state: PreloadState, rotor: CondensedRotor, index: NDArray[np.intp]
    ) -> RadialProblem:
        """The problem at some of a preload state's speeds."""
        network = state.network
        part = replace(network, arrangement=network.arrangement.at(index))
        return cls(
            network=part,
            rotor=rotor,
            rows=_rows(part, rotor),
            position=state.net.position[index],
            held=state.net.held[index],
            limit=state.limit,
        )

    def curve(self, force: Array) -> tuple[Array, Array]:
        """Deflection of the point (speeds, loads) [m] and its tangent at no load (speeds,) [N/m].

        Loads ascend evenly from zero; each starts from the parabola through the last three.

        Raises
        ------
        NoSolution : a load is more than the arrangement can carry
        """
        p = len(self.rotor.point)
        start = np.concatenate([np.zeros((len(self.position), p)), self.position], axis=1)
        problem, here = self, self.evaluate(start, None)
        slope = problem._per_newton(here)
        tangent = 1.0 / slope[:, :p].dot(self.rotor.point)
        path = [start, start - (force[1] - force[0]) * slope]  # a point before the first
        deflection = np.zeros((len(start), len(force)))
        for k in range(1, len(force)):
            guess = 2.0 * path[0] - path[1] if k == 1 else 3.0 * (path[0] - path[1]) + path[2]
            problem, here = problem._solved(guess, here, float(force[k]))
            path = [here.coordinates, *path[:2]]
            deflection[:, k] = here.coordinates[:, :p] @ self.rotor.point
        return deflection, tangent

    def evaluate(self, coordinates: Array, near: States | None) -> Point:
        """Bearing loads and tangents at given coordinates."""
        joints = self.network.arrangement.joints
        moved = np.einsum("kiu,su->ski", self.rows, coordinates)
        load, tangent = np.empty_like(moved), np.empty((*moved.shape, 3))
        states: States = {}
        for bearing, members in _members(self.network).items():
            seats = [seat for seat, _ in members]
            owners = [joints[joint] for _, joint in members]
            sign = np.array([[j.thrust, 1.0, j.thrust] for j in owners], dtype=float)
            shift = np.stack([j.shift for j in owners], axis=1)
            displacement = np.zeros((len(moved), len(seats), 5))
            displacement[..., PLANE] = moved[:, seats] * sign
            displacement[..., 0] += sign[:, 0] * shift
            state = bearing.equilibrium(
                displacement=displacement,
                speed=self.network.arrangement.speed[:, None],
                static_growth=np.array([j.static_growth for j in owners]),
                growth=np.stack([j.growth for j in owners], axis=1),
                kinematics=self.network.law.kinematics,
                moment_sharing=self.network.law.moment_sharing,
                start=None if near is None else near[bearing],
            )
            k = state.complete_stiffness[..., PLANE, :][..., PLANE]
            load[:, seats] = state.load[..., PLANE] * sign
            tangent[:, seats] = k * sign[:, :, None] * sign[:, None, :]
            states[bearing] = state
        return Point(coordinates, states, load, tangent)

    @property
    def _fixed(self) -> Flags:
        """Unknowns that cannot move (speeds, unknowns)."""
        free = np.zeros((len(self.held), len(self.rotor.point)), dtype=bool)
        return np.concatenate([free, self.held | self.network.springs.fixed], axis=1)

    def _matrix(self, here: Point) -> Array:
        """Tangent of all forces; fixed unknowns replaced by themselves."""
        p, springs = len(self.rotor.point), self.network.springs
        k = np.einsum("kiu,skij,kjv->suv", self.rows, here.tangent, self.rows, optimize=True)
        k[:, :p, :p] += self.rotor.stiffness
        bodies = p + np.arange(len(springs.stiffness))
        k[:, bodies, bodies] += springs.stiffness
        fixed = self._fixed
        k = np.where(fixed[:, :, None] | fixed[:, None, :], 0.0, k)
        every = np.arange(k.shape[1])
        k[:, every, every] += fixed * np.abs(k).max(axis=(1, 2))[:, None]
        return k

    def _unbalanced(self, here: Point, force: float) -> Array:
        """Forces not balanced at the free unknowns (speeds, unknowns)."""
        p, springs = len(self.rotor.point), self.network.springs
        total = -np.einsum("kiu,ski->su", self.rows, here.load)
        total[:, :p] += force * self.rotor.point - here.coordinates[:, :p] @ self.rotor.stiffness
        total[:, p:] += springs.force - springs.stiffness * (here.coordinates[:, p:] - springs.rest)
        total[:, p + SHAFT] += self.network.arrangement.force
        return np.where(self._fixed, 0.0, total)

    def _per_newton(self, here: Point) -> Array:
        """Change of the unknowns per newton of radial force (speeds, unknowns)."""
        unit = np.zeros((len(self.held), self.rows.shape[2], 1))
        unit[:, : len(self.rotor.point), 0] = self.rotor.point
        return np.asarray(np.linalg.solve(self._matrix(here), unit)[..., 0])

    def _solved(self, guess: Array, near: Point, force: float) -> tuple[RadialProblem, Point]:
        """Equilibrium under ``force`` from a guess; stops close and open as they must."""
        problem = self
        there = problem.evaluate(guess, near.states)
        for _ in range(ITERATIONS):
            miss = problem._unbalanced(there, force)
            error = np.abs(miss).max(axis=1)
            if not np.isfinite(error).all():
                raise NoSolution(
                    f"a bearing has no equilibrium under a radial force of {force:.0f} N; lower "
                    "max_force or raise the preload"
                )
            if (error < TOLERANCE * force).all():
                changed = problem._stops(there)
                if changed is problem:
                    return problem, there
                problem = changed
                continue
            move = np.linalg.solve(problem._matrix(there), miss[..., None])[..., 0]
            there = problem.evaluate(there.coordinates + move, there.states)
        raise NoSolution(
            f"the spindle finds no equilibrium under a radial force of {force:.0f} N; lower "
            "max_force or raise the preload"
        )

    def _stops(self, here: Point) -> RadialProblem:
        """This problem with stops closed where overrun and opened where they would pull."""
        p, pushes = len(self.rotor.point), self.network.arrangement.pushes
        direction = np.zeros(self.held.shape[1])
        for push in pushes:
            direction[push.body] = push.direction
        position = here.coordinates[:, p:]
        overrun = direction * (position - self.limit) < -1e-13
        free = replace(self, held=np.zeros_like(self.held))
        pulls = self.held & (direction * free._unbalanced(here, 0.0)[:, p:] > 0.0)
        wanted = (self.held | overrun) & ~pulls
        if (wanted == self.held).all():
            return self
        here.coordinates[:, p:] = np.where(wanted & ~self.held, self.limit, position)
        return replace(self, held=wanted)


def _members(network: Network) -> dict[AngularContactBallBearing, list[tuple[int, int]]]:
    """(seat, joint) of every seat, by bearing model."""
    found: dict[AngularContactBallBearing, list[tuple[int, int]]] = {}
    for index, joint in enumerate(network.arrangement.joints):
        found.setdefault(joint.bearing, []).extend((seat, index) for seat in joint.seats)
    return found


def _rows(network: Network, rotor: CondensedRotor) -> Array:
    """(x, y, θz) between the rings of every seat, in the unknowns."""
    p, bodies = len(rotor.point), len(network.arrangement.bodies)
    rows = np.zeros((len(rotor.seats), 3, p + bodies))
    rows[:, 1:, :p] = rotor.seats
    for joint in network.arrangement.joints:
        for seat in joint.seats:
            rows[seat, 0, p + SHAFT] = 1.0
            if joint.outer != HOUSING:
                rows[seat, 0, p + joint.outer] = -1.0
    return rows
