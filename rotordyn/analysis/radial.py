"""Shaft, bearings and axial arrangement under a radial force, with the full bearing model."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.arrangement import HOUSING, SHAFT
from rotordyn.preload.network import Network, States
from rotordyn.preload.state import PreloadState
from rotordyn.preload.stops import stops_wanted
from rotordyn.system.condensed import CondensedRotor

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Words = NDArray[np.str_]
PLANE = [0, 1, 4]  # x, y, θz of a bearing's five freedoms
TOLERANCE = 1e-9  # of the largest force in the balance
ITERATIONS = 20
HALVINGS = 8


@dataclass(frozen=True, eq=False, slots=True)
class Point:
    """Coordinates (speeds, p + bodies), bearing states, loads and tangents in plane y.

    ``load`` (speeds, seats, 3), ``tangent`` (speeds, seats, 3, 3): (x, y, θz) of the spindle;
    ``pressure`` (speeds,): largest contact pressure [Pa].
    """

    coordinates: Array
    states: States
    load: Array
    tangent: Array
    pressure: Array


@dataclass(frozen=True, eq=False, slots=True)
class RadialCurve:
    """``deflection`` of the loaded point (speeds, loads), ``tangent`` at no load (speeds,) [N/m].

    ``outcome`` (speeds,): empty, or why the curve ends early (then NaN from there on). ``reach``
    (speeds, bodies): furthest position of each body against its spring along the curve, as travel
    from rest [m].
    """

    deflection: Array
    tangent: Array
    outcome: Words
    reach: Array


@dataclass(frozen=True, eq=False, slots=True)
class RadialProblem:
    """Unknowns: p coordinates of the condensed rotor, then the positions of the bodies.

    ``joints``: the joint of every seat; ``rows`` (seats, 3, unknowns) give (x, y, θz) between the
    rings; ``rest`` and ``limit`` (bodies,); ``held`` (speeds, bodies): standing at their stops.
    """

    network: Network
    rotor: CondensedRotor
    joints: tuple[int, ...]
    rows: Array
    rest: Array
    limit: Array
    position: Array
    held: Flags

    @classmethod
    def at(
        cls, state: PreloadState, rotor: CondensedRotor, index: NDArray[np.intp]
    ) -> RadialProblem:
        """The problem at some of a preload state's speeds."""
        network = state.network
        part = replace(network, arrangement=network.arrangement.at(index))
        return cls(
            network=part,
            rotor=rotor.at(index),
            joints=_joint_of_seats(part),
            rows=_rows(part, rotor),
            rest=state.rest,
            limit=state.limit,
            position=state.net.position[index],
            held=state.net.held[index],
        )

    def curve(self, force: Array) -> RadialCurve:
        """Deflection under loads that ascend evenly from zero.

        Each load starts from the cubic that has the places and slopes of the last two; every speed
        stands on its own.
        """
        p = len(self.rotor.point)
        start = np.concatenate([np.zeros((len(self.position), p)), self.position], axis=1)
        problem, here = self, self.evaluate(start, None)
        every = np.ones(len(start), dtype=bool)
        step, slope = float(force[1] - force[0]), problem._per_newton(here, every)
        first, last = None, (start, step * slope)
        deflection = np.zeros((len(start), len(force)))
        outcome = np.full(len(start), "", dtype=object)
        reach = problem._travel(start)
        for k in range(1, len(force)):
            if (outcome != "").all():
                deflection[:, k:] = np.nan
                break
            guess = _ahead(first, last)
            problem, here, found = problem._solved(guess, here, float(force[k]), outcome == "")
            lost = (outcome == "") & ~found
            outcome[lost] = [_why(point, force[k]) for point in here.pressure[lost]]
            first, last = last, (here.coordinates, step * problem._per_newton(here, outcome == ""))
            deflection[:, k] = here.coordinates[:, :p] @ self.rotor.point
            deflection[outcome != "", k] = np.nan
            reach = np.fmax(reach, problem._travel(here.coordinates))
        tangent = 1.0 / slope[:, :p].dot(self.rotor.point)
        return RadialCurve(deflection, tangent, outcome.astype(str), reach)

    def evaluate(self, coordinates: Array, near: States | None) -> Point:
        """Bearing loads and tangents at given coordinates."""
        joints = [self.network.arrangement.joints[k] for k in self.joints]
        sign = np.array([[j.thrust, 1.0, j.thrust] for j in joints], dtype=float)
        moved = np.einsum("kiu,su->ski", self.rows, coordinates)
        displacement = np.zeros((*moved.shape[:2], 5))
        displacement[..., PLANE] = moved * sign
        displacement[..., 0] += sign[:, 0] * np.stack([j.shortening for j in joints], axis=1)
        states = self.network.solve_bearings(self.joints, displacement, near)
        load, tangent = np.empty_like(moved), np.empty((*moved.shape, 3))
        pressure = np.zeros(len(moved))
        for solved in states.values():
            state, own = solved.state, sign[solved.places]
            k = state.complete_stiffness[..., PLANE, :][..., PLANE]
            load[:, solved.places] = state.load[..., PLANE] * own
            tangent[:, solved.places] = k * own[:, :, None] * own[:, None, :]
            peak = np.fmax(state.inner_pressure, state.outer_pressure)
            pressure = np.maximum(pressure, peak.max(axis=(1, 2)))
        return Point(coordinates, states, load, tangent, pressure)

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
        total[:, :p] += force * self.rotor.point - np.einsum(
            "sij,sj->si", self.rotor.stiffness, here.coordinates[:, :p]
        )
        total[:, p:] += springs.force - springs.stiffness * (here.coordinates[:, p:] - springs.rest)
        total[:, p + SHAFT] += self.network.arrangement.force
        return np.where(self._fixed, 0.0, total)

    def _per_newton(self, here: Point, alive: Flags) -> Array:
        """Change of the unknowns per newton of radial force where ``alive`` (speeds, unknowns)."""
        unit = np.zeros((len(self.held), self.rows.shape[2], 1))
        unit[:, : len(self.rotor.point), 0] = self.rotor.point
        matrix = np.where(alive[:, None, None], self._matrix(here), np.eye(unit.shape[1]))
        return np.asarray(np.linalg.solve(matrix, unit)[..., 0])

    def _error(self, here: Point, force: float) -> tuple[Array, Array]:
        """Unbalanced forces, and the largest over the largest force of the balance (speeds,)."""
        miss = self._unbalanced(here, force)
        size = np.maximum(np.abs(here.load[..., :2]).max(axis=(1, 2)), abs(force))
        return miss, np.abs(miss).max(axis=1) / (size + np.abs(self.network.springs.force).max())

    def _placed(self, coordinates: Array) -> Array:
        """Coordinates with every body that cannot move where it stands."""
        p, springs = len(self.rotor.point), self.network.springs
        position = np.where(self.held, self.limit, coordinates[:, p:])
        position = np.where(springs.fixed, springs.rest, position)
        return np.concatenate([coordinates[:, :p], position], axis=1)

    def _solved(
        self, guess: Array, near: Point, force: float, alive: Flags
    ) -> tuple[RadialProblem, Point, Flags]:
        """Equilibrium under ``force`` from a guess, and where there is one (speeds,).

        Only speeds still ``alive`` are sought; where no step helps any more the search ends. Stops
        close and open as they must.
        """
        problem = self
        guess = np.where(alive[:, None], guess, near.coordinates)
        there = problem.evaluate(problem._placed(guess), near.states)
        found = np.zeros(len(guess), dtype=bool)
        for _ in range(ITERATIONS):
            miss, error = problem._error(there, force)
            found = (error < TOLERANCE) & (there.pressure <= HIGHEST_PRESSURE)
            wanted = problem._stops(there)
            changed = found & (wanted != problem.held).any(axis=1)
            if changed.any():
                problem = replace(problem, held=np.where(changed[:, None], wanted, problem.held))
                there = problem.evaluate(problem._placed(there.coordinates), there.states)
                continue
            alive = alive & (there.pressure <= HIGHEST_PRESSURE)
            moving = alive & np.isfinite(error) & ~(error < TOLERANCE)
            if not moving.any():
                break
            there, helped = problem._moved(there, miss, error, moving, force)
            alive = alive & helped
        return problem, there, found

    def _stops(self, here: Point) -> Flags:
        """Bodies that belong at their stops (speeds, bodies)."""
        p = len(self.rotor.point)
        free = replace(self, held=np.zeros_like(self.held))
        force = free._unbalanced(here, 0.0)[:, p:]
        return stops_wanted(self.network, here.coordinates[:, p:], force, self.held, self.limit)

    def _moved(
        self, here: Point, miss: Array, error: Array, moving: Flags, force: float
    ) -> tuple[Point, Flags]:
        """A Newton step at the speeds still moving, shortened where the balance gets worse.

        Also where it helped, or was not needed.
        """
        matrix = np.where(moving[:, None, None], self._matrix(here), np.eye(miss.shape[1]))
        step = np.linalg.solve(matrix, np.where(moving[:, None], miss, 0.0)[..., None])[..., 0]
        length = moving.astype(float)
        there, worse = here, moving
        for _ in range(HALVINGS):
            there = self.evaluate(here.coordinates + length[:, None] * step, here.states)
            worse = moving & ~(self._error(there, force)[1] < error)
            if not worse.any():
                break
            length = np.where(worse, 0.5 * length, length)
        return there, ~worse

    def _travel(self, coordinates: Array) -> Array:
        """How far each body has moved from rest against its spring (speeds, bodies) [m]."""
        moved = coordinates[:, len(self.rotor.point) :] - self.rest
        direction = np.zeros(len(self.rest))
        for push in self.network.arrangement.pushes:
            direction[push.body] = push.direction
        return -direction * moved


def _ahead(first: tuple[Array, Array] | None, last: tuple[Array, Array]) -> Array:
    """Where the next of evenly spaced points is likely to be, from (place, slope) of two; slopes
    are per spacing."""
    place, slope = last
    if first is None:
        return place + slope
    return 5.0 * first[0] + 2.0 * first[1] - 4.0 * place + 4.0 * slope


def _why(pressure: float, force: float) -> str:
    """Why a curve ends at ``force`` [N]."""
    if pressure > HIGHEST_PRESSURE:
        return (
            f"bearings are overloaded under a radial force of {force:g} N (peak pressure "
            f"{pressure / 1e9:.1f} GPa, at most {HIGHEST_PRESSURE / 1e9:g} GPa): lower max_force"
        )
    return (
        f"no equilibrium under a radial force of {force:g} N: lower max_force or raise the preload"
    )


def _joint_of_seats(network: Network) -> tuple[int, ...]:
    """The joint that stands for every seat."""
    owner = {
        seat: index
        for index, joint in enumerate(network.arrangement.joints)
        for seat in joint.seats
    }
    return tuple(owner[seat] for seat in sorted(owner))


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
