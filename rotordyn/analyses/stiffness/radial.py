"""Balance of shaft, bearings and axial arrangement under a radial force: full bearing model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ring.assembly import half_assembly
from rotordyn.equation.statics import PlaneRotor
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload.arrangement import HOUSING, SHAFT, AxialBearing
from rotordyn.preload.bearing_iterates import BearingIterates, States
from rotordyn.preload.network import Network
from rotordyn.preload.state import PreloadState
from rotordyn.preload.stops import stops_wanted

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Place = Callable[["RadialProblem", Array, Any], "Point"]
PLANE = [0, 1, 4]  # x, y, θz of a bearing's five DOF
TOLERANCE = 1e-9  # of the largest force in the balance, and of the largest ball load
SMALL = 1e3
ITERATIONS = 20
HALVINGS = 8


@dataclass(frozen=True, eq=False, slots=True)
class Point:
    """Coordinates (speeds, p + bodies), bearings, their loads and tangents in plane y.

    ``bearings``: by model, at the seats it stands on; ``states``: where each bearing was solved by
    itself. ``load`` (speeds, seats, 3), ``tangent`` (speeds, seats, 3, 3): (x, y, θz) of the
    spindle; ``imbalance`` (speeds,) of the balls; ``pressure`` (speeds,): largest contact pressure
    [Pa]; ``lightest`` (speeds, seats): smallest load of a ball on its inner race [N].
    """

    coordinates: Array
    bearings: BearingIterates
    states: States | None
    load: Array
    tangent: Array
    imbalance: Array
    pressure: Array
    lightest: Array


@dataclass(frozen=True, eq=False, slots=True)
class RadialProblem:
    """Unknowns: p coordinates of the rotor, then the positions of the bodies.

    ``bearings``: which bearing of the arrangement stands for each seat; ``rows`` (seats, 3,
    unknowns) give (x, y, θz) between the rings; ``rest`` and ``limit`` (bodies,); ``held`` (speeds,
    bodies): standing at their stops.
    """

    network: Network
    rotor: PlaneRotor
    bearings: tuple[int, ...]
    rows: Array
    rest: Array
    limit: Array
    position: Array
    held: Flags

    @classmethod
    def at(cls, state: PreloadState, rotor: PlaneRotor, index: NDArray[np.intp]) -> RadialProblem:
        """The problem at some of a preload state's speeds."""
        network = state.network
        part = replace(network, arrangement=network.arrangement.at(index))
        return cls(
            network=part,
            rotor=rotor.at(index),
            bearings=_bearing_of_seats(part),
            rows=_rows(part, rotor),
            rest=state.rest,
            limit=state.limit,
            position=state.net.position[index],
            held=state.net.held[index],
        )

    def evaluate(self, coordinates: Array, near: Point | None) -> Point:
        """Each bearing solved by itself at given coordinates, from where it was ``near`` by."""
        states = self.network.solve_bearings(
            self.bearings,
            None if near is None else near.states,
            displacement=self._displacement(coordinates),
        )
        return self._point(coordinates, BearingIterates.solved(states, half_assembly), states)

    def advance(self, coordinates: Array, near: Point) -> Point:
        """Bearings moved to given coordinates, their balls by a Newton step."""
        return self._point(coordinates, near.bearings.moved(self._displacement(coordinates)))

    def _at(self, guess: list[Array], near: Point) -> Point:
        """Coordinates and balls where a guess has them, as far as bodies can move."""
        coordinates = self._placed(guess[0])
        displacement = self._displacement(coordinates)
        return self._point(coordinates, near.bearings.at(displacement, guess[1:]))

    def balls_along(self, here: Point, change: Array) -> list[Array]:
        """What the balls of each bearing model do with a ``change`` of the coordinates."""
        moved = self._own(change)
        return [each.along(moved[:, places]) for places, each in here.bearings]

    def _point(
        self, coordinates: Array, bearings: BearingIterates, states: States | None = None
    ) -> Point:
        load = np.empty((len(coordinates), len(self.bearings), len(PLANE)))
        tangent = np.empty((*load.shape, len(PLANE)))
        lightest = np.empty(load.shape[:2])
        for places, balls in bearings:
            sign = self._sign[places]
            k = balls.stiffness[..., PLANE, :][..., PLANE]
            load[:, places] = balls.load[..., PLANE] * sign
            tangent[:, places] = k * sign[:, :, None] * sign[:, None, :]
            lightest[:, places] = balls.lightest
        imbalance, pressure = bearings.imbalance, bearings.pressure
        return Point(coordinates, bearings, states, load, tangent, imbalance, pressure, lightest)

    @property
    def _seats(self) -> list[AxialBearing]:
        """The bearing of every seat."""
        return [self.network.arrangement.bearings[k] for k in self.bearings]

    @property
    def _sign(self) -> Array:
        """From (x, y, θz) of the spindle to those of a bearing (seats, 3)."""
        return np.array([[b.thrust, 1.0, b.thrust] for b in self._seats], dtype=float)

    def _own(self, coordinates: Array) -> Array:
        """Five DOF of every bearing (speeds, seats, 5) from the unknowns."""
        moved = np.einsum("kiu,su->ski", self.rows, coordinates) * self._sign
        motion = np.zeros((*moved.shape[:2], 5))
        motion[..., PLANE] = moved
        return motion

    def _displacement(self, coordinates: Array) -> Array:
        """Displacements of the bearings (speeds, seats, 5), the shaft's shortening included."""
        shift = np.stack([b.thrust * b.shortening for b in self._seats], axis=1)
        displacement = self._own(coordinates)
        displacement[..., 0] += shift
        return displacement

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

    def per_newton(self, here: Point, alive: Flags) -> Array:
        """Change of the unknowns per newton of radial force where ``alive`` (speeds, unknowns)."""
        unit = np.zeros((len(self.held), self.rows.shape[2], 1))
        unit[:, : len(self.rotor.point), 0] = self.rotor.point
        matrix = np.where(alive[:, None, None], self._matrix(here), np.eye(unit.shape[1]))
        return np.asarray(np.linalg.solve(matrix, unit)[..., 0])

    def _error(self, here: Point, force: float) -> tuple[Array, Array]:
        """Unbalanced forces, and the largest of balls and shaft, each over its largest force; of a
        radial force that is small beside the preload, over ``SMALL`` times that."""
        miss = self._unbalanced(here, force)
        size = np.maximum(np.abs(here.load[..., :2]).max(axis=(1, 2)), abs(force))
        size = size + np.abs(self.network.springs.force).max()
        size = np.minimum(size, np.maximum(SMALL * abs(force), size / SMALL))
        shaft = np.abs(miss).max(axis=1) / size
        return miss, np.maximum(shaft, here.imbalance)

    def _placed(self, coordinates: Array) -> Array:
        """Coordinates with every body that cannot move where it stands."""
        p, springs = len(self.rotor.point), self.network.springs
        position = np.where(self.held, self.limit, coordinates[:, p:])
        position = np.where(springs.fixed, springs.rest, position)
        return np.concatenate([coordinates[:, :p], position], axis=1)

    def solved(
        self, guess: list[Array], near: Point, force: float, alive: Flags
    ) -> tuple[RadialProblem, Point, Flags]:
        """Equilibrium under ``force`` from a guess, and where there is one (speeds,).

        Shaft and balls together; where that fails, or balls know two branches, with every bearing
        solved by itself on the way.
        """
        problem, start = self, np.where(alive[:, None], guess[0], near.coordinates)
        if self.network.one_branch:
            first = self._at([start, *guess[1:]], near)
            problem, there, converged = self._searched(
                first, force, alive, RadialProblem.advance, 1
            )
            converged &= there.bearings.follows(near.bearings)
            if not (alive & ~converged).any():
                return problem, there, converged
            start = np.where(converged[:, None], there.coordinates, start)
            problem = replace(self, held=np.where(converged[:, None], problem.held, self.held))
        there = problem.evaluate(problem._placed(start), None)
        return problem._searched(there, force, alive, RadialProblem.evaluate, HALVINGS)

    def _searched(
        self, there: Point, force: float, alive: Flags, place: Place, tries: int
    ) -> tuple[RadialProblem, Point, Flags]:
        """Newton steps with at most so many ``tries`` of their length, and where they end well.

        Only speeds still ``alive`` are sought; where no step helps any more the search ends. Stops
        close and open as they must.
        """
        problem, converged = self, np.zeros(len(alive), dtype=bool)
        for _ in range(ITERATIONS):
            miss, error = problem._error(there, force)
            converged = (error < TOLERANCE) & (there.pressure <= HIGHEST_PRESSURE)
            wanted = problem._stops(there)
            changed = converged & (wanted != problem.held).any(axis=1)
            if changed.any():
                problem = replace(problem, held=np.where(changed[:, None], wanted, problem.held))
                there = place(problem, problem._placed(there.coordinates), there)
                continue
            moving = alive & np.isfinite(error) & ~(error < TOLERANCE)
            if not moving.any():
                break
            there, helped = problem._moved(there, miss, error, moving, force, place, tries)
            alive = alive & helped
        return problem, there, converged

    def _stops(self, here: Point) -> Flags:
        """Bodies that belong at their stops (speeds, bodies)."""
        p = len(self.rotor.point)
        free = replace(self, held=np.zeros_like(self.held))
        force = free._unbalanced(here, 0.0)[:, p:]
        return stops_wanted(self.network, here.coordinates[:, p:], force, self.held, self.limit)

    def _moved(
        self,
        here: Point,
        miss: Array,
        error: Array,
        moving: Flags,
        force: float,
        place: Place,
        tries: int,
    ) -> tuple[Point, Flags]:
        """A Newton step at the speeds still moving, shortened where the balance gets worse.

        Also where it helped, or was not needed.
        """
        matrix = np.where(moving[:, None, None], self._matrix(here), np.eye(miss.shape[1]))
        step = np.linalg.solve(matrix, np.where(moving[:, None], miss, 0.0)[..., None])[..., 0]
        length = moving.astype(float)
        there, worse = here, moving
        for _ in range(tries):
            there = place(self, here.coordinates + length[:, None] * step, here)
            worse = moving & ~(self._error(there, force)[1] < error)
            if not worse.any():
                break
            length = np.where(worse, 0.5 * length, length)
        return there, ~worse

    def travel(self, coordinates: Array) -> Array:
        """How far each body has moved from rest against its spring (speeds, bodies) [m]."""
        moved = coordinates[:, len(self.rotor.point) :] - self.rest
        direction = np.zeros(len(self.rest))
        for push in self.network.arrangement.pushes:
            direction[push.body] = push.direction
        return -direction * moved


def _bearing_of_seats(network: Network) -> tuple[int, ...]:
    """The bearing that stands for every seat."""
    owner = {
        seat: index
        for index, bearing in enumerate(network.arrangement.bearings)
        for seat in bearing.seats
    }
    return tuple(owner[seat] for seat in sorted(owner))


def _rows(network: Network, rotor: PlaneRotor) -> Array:
    """(x, y, θz) between the rings of every seat, in the unknowns."""
    p, bodies = len(rotor.point), len(network.arrangement.bodies)
    rows = np.zeros((len(rotor.seats), 3, p + bodies))
    rows[:, 1:, :p] = rotor.seats
    for bearing in network.arrangement.bearings:
        for seat in bearing.seats:
            rows[seat, 0, p + SHAFT] = 1.0
            if bearing.outer != HOUSING:
                rows[seat, 0, p + bearing.outer] = -1.0
    return rows
