"""Balance of shaft, bearings and axial arrangement under loads across the axis.

Every bearing is represented by all its balls, in the DOF in which it moves: all five of them, or
(x, y, θz) if all motion lies in plane y.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bearings.ring.assembly import Assembly, full_assembly, half_assembly
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.equation.statics import PLANE, StaticRotor
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.arrangement import HOUSING, SHAFT, AxialBearing
from rotordyn.preload.bearing_iterates import BearingIterates, States
from rotordyn.preload.friction import Rubbing
from rotordyn.preload.network import Network
from rotordyn.preload.state import PreloadState
from rotordyn.preload.stops import bodies_at_stops

if TYPE_CHECKING:
    from bearings.geometry import Geometry

Force = float | Array  # [N], at all speeds or at each (speeds,)
FORCES = 3  # of the five DOF: x, y, z
LEAST = 1e-9  # N: keeps relative errors finite without any load
SOFT = 1e-12  # of the largest stiffness, added where bearings may hold nothing
SMALL = 1e3  # errors are relative to SMALL radial forces at most, the preload over SMALL at least


@dataclass(frozen=True, eq=False, slots=True)
class Point:
    """Iterate of the balance: coordinates (speeds, p + bodies), bearings, their loads and tangents.

    ``bearings``: by model, at their seats; ``states``: bearing states where each was solved by
    itself, else None. ``load`` (speeds, seats, f), ``tangent`` (speeds, seats, f, f): in the DOF of
    the balance, of the spindle; ``imbalance`` (speeds,) of the balls; ``pressure`` (speeds,):
    largest contact pressure [Pa]; ``lightest`` (speeds, seats): smallest load of a ball on its
    inner race [N], and ``lightest_ball`` (speeds, seats): index of that ball.
    """

    coordinates: Array
    bearings: BearingIterates
    states: States | None
    load: Array
    tangent: Array
    imbalance: Array
    pressure: Array
    lightest: Array
    lightest_ball: Indices


@dataclass(frozen=True, eq=False, slots=True)
class Balance:
    """Balance problem: p coordinates of the rotor, then the positions of the bodies are unknown.

    ``dof``: those of a bearing's five in which it moves, f of them; ``bearings``: index of the
    bearing of the arrangement at each seat; ``rows`` (seats, f, unknowns): DOF between the rings
    from the unknowns; ``offset`` (seats, f): displacements of misaligned seats; ``rest`` and
    ``limit`` (bodies,): positions at rest and at stops; ``start`` (speeds, unknowns): initial
    state; ``held`` (speeds, bodies): bodies at their stops; ``rubbing``: friction of bodies.
    """

    dof: tuple[int, ...]
    network: Network
    rotor: StaticRotor
    bearings: list[int]
    rows: Array
    offset: Array
    rest: Array
    limit: Array
    start: Array
    held: Flags
    rubbing: Rubbing

    @classmethod
    def at(cls, state: PreloadState, rotor: StaticRotor, index: Indices) -> Balance:
        """Return the problem at the speeds ``index`` of a preload state."""
        part = state.network.at(index)
        return cls(
            dof=rotor.dof,
            network=part,
            rotor=rotor.at(index),
            bearings=part.arrangement.bearing_of_seat,
            rows=_rows(part, rotor),
            offset=_offset(state.spindle, rotor.dof),
            rest=state.rest,
            limit=state.limit,
            start=state.coordinates(len(rotor.point))[index],
            held=state.net.held[index],
            rubbing=Rubbing.of(state, index),
        )

    def evaluate(self, coordinates: Array, near: Point | None) -> Point:
        """Solve each bearing by itself at given coordinates, starting from the iterate ``near``."""
        states = self.network.solve_bearings(
            self.bearings,
            None if near is None else near.states,
            displacement=self._displacement(coordinates),
        )
        return self._point(coordinates, BearingIterates.solved(states, self._assembly), states)

    def first_point(self, state: PreloadState, index: Indices) -> Point:
        """Return the initial iterate, with the bearings of the preload state where they apply."""
        if state.lateral is not None or self.offset.any() or not state.usable[index].all():
            return self.evaluate(self.start, None)
        states = state.net.response.states
        bearings = BearingIterates.chosen(states, self.bearings, index, self._assembly)
        return self._point(self.start, bearings)

    @property
    def _assembly(self) -> Callable[[Geometry], Assembly]:
        """Balls that are solved: half of them if all motion lies in plane y."""
        return half_assembly if self.dof == PLANE else full_assembly

    def advance(self, coordinates: Array, near: Point) -> Point:
        """Move bearings to given coordinates, their balls by one Newton step."""
        return self._point(coordinates, near.bearings.moved(self._displacement(coordinates)))

    def guessed(self, guess: list[Array], near: Point) -> Point:
        """Return the iterate of guessed coordinates and balls, bodies that cannot move in place."""
        coordinates = self.placed(guess[0])
        displacement = self._displacement(coordinates)
        return self._point(coordinates, near.bearings.at(displacement, guess[1:]))

    def balls_along(self, here: Point, change: Array) -> list[Array]:
        """Return the change of the balls of each bearing model for a ``change`` of coordinates."""
        motion = self.bearing_motion(change)
        return [balls.along(motion[:, places]) for places, balls in here.bearings]

    def _point(
        self, coordinates: Array, bearings: BearingIterates, states: States | None = None
    ) -> Point:
        dof = list(self.dof)
        load = np.empty((len(coordinates), len(self.bearings), len(dof)))
        tangent = np.empty((*load.shape, len(dof)))
        lightest, which = np.empty(load.shape[:2]), np.empty(load.shape[:2], dtype=np.intp)
        for places, balls in bearings:
            sign = self._sign[places]
            k = balls.stiffness[..., dof, :][..., dof]
            load[:, places] = balls.load[..., dof] * sign
            tangent[:, places] = k * sign[:, :, None] * sign[:, None, :]
            lightest[:, places] = balls.inner_load.min(axis=-1)
            which[:, places] = balls.inner_load.argmin(axis=-1)
        return Point(
            coordinates,
            bearings,
            states,
            load,
            tangent,
            bearings.imbalance,
            bearings.pressure,
            lightest,
            which,
        )

    @property
    def _forces(self) -> list[int]:
        """Indices of x, y and z in ``dof``."""
        return [place for place, number in enumerate(self.dof) if number < FORCES]

    @property
    def _seats(self) -> list[AxialBearing]:
        """Bearing of the arrangement at every seat."""
        return [self.network.arrangement.bearings[k] for k in self.bearings]

    @property
    def thrust(self) -> Array:
        """Thrust of the seats (seats,): 1 where a force on the shaft along +x loads it, else −1."""
        return np.array([float(bearing.thrust) for bearing in self._seats])

    @property
    def _sign(self) -> Array:
        """Signs that map the DOF of the spindle to those of a bearing (seats, f)."""
        signs = np.array([HALF_TURN_ABOUT_Y if b.thrust < 0 else np.ones(5) for b in self._seats])
        return signs[:, list(self.dof)]

    def bearing_motion(self, coordinates: Array) -> Array:
        """Return the five DOF of every bearing (speeds, seats, 5) from the unknowns."""
        active = np.einsum("kiu,su->ski", self.rows, coordinates) * self._sign
        motion = np.zeros((*active.shape[:2], 5))
        motion[..., list(self.dof)] = active
        return motion

    def _displacement(self, coordinates: Array) -> Array:
        """Return bearing displacements (speeds, seats, 5), misalignment and shortening included."""
        shift = np.stack([b.thrust * b.shortening for b in self._seats], axis=1)
        displacement = self.bearing_motion(coordinates)
        displacement[..., list(self.dof)] += self.offset * self._sign
        displacement[..., 0] += shift
        return displacement

    @property
    def _fixed(self) -> Flags:
        """Unknowns that cannot move (speeds, unknowns)."""
        free = np.zeros((len(self.held), len(self.rotor.point)), dtype=bool)
        fixed = self.held | self.rubbing.stuck | self.network.springs.fixed
        return np.concatenate([free, fixed], axis=1)

    def matrix(self, point: Point) -> Array:
        """Return the tangent of all forces; fixed unknowns have a diagonal entry only."""
        p, springs = len(self.rotor.point), self.network.springs
        k = np.einsum("kiu,skij,kjv->suv", self.rows, point.tangent, self.rows, optimize=True)
        k[:, :p, :p] += self.rotor.stiffness
        bodies = p + np.arange(springs.stiffness.shape[1])
        k[:, bodies, bodies] += springs.stiffness
        fixed = self._fixed
        k = np.where(fixed[:, :, None] | fixed[:, None, :], 0.0, k)
        diagonal = np.arange(k.shape[1])
        largest = np.abs(k).max(axis=(1, 2))[:, None]
        largest = np.where(largest > 0.0, largest, 1.0)
        soft = SOFT * (self.slack(point) | (self.dof != PLANE))[:, None]
        # fixed rows as large as the others keep the matrix well conditioned
        k[:, diagonal, diagonal] += largest * np.where(fixed, 1.0, soft)
        return k

    def slack(self, point: Point) -> Flags:
        """True at speeds where some bearing has no stiffness (speeds,)."""
        return np.asarray((np.abs(point.tangent).max(axis=(2, 3)) == 0.0).any(axis=1))

    def _unbalanced(self, point: Point, force: Force) -> Array:
        """Return the residual forces at the free unknowns (speeds, unknowns)."""
        p, springs = len(self.rotor.point), self.network.springs
        residual = -np.einsum("kiu,ski->su", self.rows, point.load)
        residual[:, :p] += self.rotor.constant + np.multiply.outer(force, self.rotor.point)
        residual[:, :p] -= np.einsum("sij,sj->si", self.rotor.stiffness, point.coordinates[:, :p])
        residual[:, p:] += springs.force - springs.stiffness * (
            point.coordinates[:, p:] - springs.rest
        )
        residual[:, p:] += self.rubbing.force
        residual[:, p + SHAFT] += self.network.arrangement.force
        return np.where(self._fixed, 0.0, residual)

    def per_newton(self, point: Point, alive: Flags) -> Array:
        """Return unknowns per newton of radial force where ``alive`` (speeds, unknowns)."""
        unit = np.zeros((len(self.held), self.rows.shape[2], 1))
        unit[:, : len(self.rotor.point), 0] = self.rotor.point
        matrix = np.where(alive[:, None, None], self.matrix(point), np.eye(unit.shape[1]))
        return np.asarray(np.linalg.solve(matrix, unit)[..., 0])

    def error(self, point: Point, force: Force) -> Array:
        """Return the largest residual force of balls and shaft over the largest force (speeds,)."""
        return self.errors(point, force)[1]

    def errors(self, point: Point, force: Force) -> tuple[Array, Array]:
        """Return residual forces, and the largest of balls and shaft, each over its largest force;
        over at most ``SMALL`` times a radial force that is small compared with the preload."""
        residual = self._unbalanced(point, force)
        radial = np.abs(force)
        reference = np.maximum(np.abs(point.load[..., self._forces]).max(axis=(1, 2)), radial)
        reference = reference + np.abs(self.network.springs.force).max(axis=1) + LEAST
        reference = np.minimum(reference, np.maximum(SMALL * radial, reference / SMALL))
        shaft = np.abs(residual).max(axis=1) / reference
        return residual, np.maximum(shaft, point.imbalance)

    def placed(self, coordinates: Array) -> Array:
        """Return coordinates with every body that cannot move in its position."""
        p, springs = len(self.rotor.point), self.network.springs
        position = np.where(self.rubbing.stuck, self.rubbing.place, coordinates[:, p:])
        position = np.where(self.held, self.limit, position)
        position = np.where(springs.fixed, springs.rest, position)
        return np.concatenate([coordinates[:, :p], position], axis=1)

    def begun(self, point: Point) -> Balance:
        """Return the problem of a load step that begins at ``point``: sleeves slide from there."""
        position = point.coordinates[:, len(self.rotor.point) :]
        return replace(self, rubbing=replace(self.rubbing, begun=position))

    def where(self, rows: Flags, other: Balance) -> Balance:
        """Return the problem with these stops and friction at ``rows``, elsewhere ``other``'s."""
        held = np.where(rows[:, None], self.held, other.held)
        return replace(self, held=held, rubbing=self.rubbing.where(rows, other.rubbing))

    def differs(self, other: Balance) -> Flags:
        """True at speeds where another body stands at a stop or sticks (speeds,)."""
        change = (self.held != other.held) | (self.rubbing.stuck != other.rubbing.stuck)
        return np.asarray(change.any(axis=1))

    def with_contacts(self, point: Point) -> Balance:
        """Return the problem with stops and friction as they must be at ``point``."""
        p, never = len(self.rotor.point), np.zeros_like(self.held)
        free = replace(self, held=never, rubbing=replace(self.rubbing, stuck=never))
        force, position = free._unbalanced(point, 0.0)[:, p:], point.coordinates[:, p:]
        held = bodies_at_stops(self.network, position, force, self.held, self.limit)
        bare = force - self.rubbing.force
        rubbing = self.rubbing.after(bare, position, self.held, held)
        return replace(self, held=held, rubbing=rubbing)

    def friction(self, point: Point) -> Array:
        """Return the friction on the bodies (speeds, bodies) [N]."""
        p, never = len(self.rotor.point), np.zeros_like(self.held)
        rubbing = replace(self.rubbing, stuck=never, force=0.0 * self.rubbing.force)
        bare = replace(self, held=never, rubbing=rubbing)._unbalanced(point, 0.0)[:, p:]
        return np.where(self.rubbing.stuck, -bare, self.rubbing.force)

    def travel(self, coordinates: Array) -> Array:
        """Return the travel of each body from rest against its spring (speeds, bodies) [m]."""
        displacement = coordinates[:, len(self.rotor.point) :] - self.rest
        return -self.network.arrangement.direction * displacement


def _offset(spindle: Spindle, dof: tuple[int, ...]) -> Array:
    """Return the displacements of bearings at misaligned seats (seats, f) [m, rad]."""
    offsets = np.array([(0.0, *seat.misalignment.offset) for seat in spindle.seats])
    return -offsets.reshape(-1, 5)[:, list(dof)]


def _rows(network: Network, rotor: StaticRotor) -> Array:
    """Return the map (seats, f, unknowns) from the unknowns to the DOF between the rings."""
    p, bodies = len(rotor.point), len(network.arrangement.bodies)
    rows = np.zeros((len(rotor.seats), len(rotor.dof), p + bodies))
    rows[:, 1:, :p] = rotor.seats
    for bearing in network.arrangement.bearings:
        for seat in bearing.seats:
            rows[seat, 0, p + SHAFT] = 1.0
            if bearing.outer != HOUSING:
                rows[seat, 0, p + bearing.outer] = -1.0
    return rows
