"""Balance of shaft, bearings and axial arrangement under loads across the axis.

Every bearing takes part with all its balls, in the DOF in which it moves: all five of them, or
(x, y, θz) where everything lies in plane y.
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
from rotordyn.preload.stops import stops_wanted

if TYPE_CHECKING:
    from bearings.geometry import Geometry

Force = float | Array  # [N], at all speeds or at each (speeds,)
FORCES = 3  # of the five DOF: x, y, z
LEAST = 1e-9  # N
SOFT = 1e-12  # of the largest stiffness, added where bearings may hold nothing
SMALL = 1e3


@dataclass(frozen=True, eq=False, slots=True)
class Point:
    """Coordinates (speeds, p + bodies), bearings, their loads and tangents.

    ``bearings``: by model, at the seats it stands on; ``states``: where each bearing was solved by
    itself. ``load`` (speeds, seats, f), ``tangent`` (speeds, seats, f, f): in the DOF of the
    balance, of the spindle; ``imbalance`` (speeds,) of the balls; ``pressure`` (speeds,): largest
    contact pressure [Pa]; ``lightest`` (speeds, seats): smallest load of a ball on its inner
    race [N], and ``lightest_ball`` (speeds, seats): which one.
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
    """Unknowns: p coordinates of the rotor, then the positions of the bodies.

    ``dof``: those of a bearing's five in which it moves, f of them; ``bearings``: which
    bearing of the arrangement stands for each seat; ``rows`` (seats, f, unknowns) give them between
    the rings, ``offset`` (seats, f) what misaligned seats add; ``rest`` and ``limit`` (bodies,);
    ``start`` (speeds, unknowns): the state to begin from; ``held`` (speeds, bodies): standing at
    their stops; ``rubbing``: the friction of bodies.
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
        """The problem at some of a preload state's speeds."""
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
        """Each bearing solved by itself at given coordinates, from where it was ``near`` by."""
        states = self.network.solve_bearings(
            self.bearings,
            None if near is None else near.states,
            displacement=self._displacement(coordinates),
        )
        return self._point(coordinates, BearingIterates.solved(states, self._assembly), states)

    def first_point(self, state: PreloadState, index: Indices) -> Point:
        """The point of the preload state it was made of, with bearings as solved there."""
        if state.lateral is not None or self.offset.any() or not state.usable[index].all():
            return self.evaluate(self.start, None)
        states = state.net.response.states
        bearings = BearingIterates.chosen(states, self.bearings, index, self._assembly)
        return self._point(self.start, bearings)

    @property
    def _assembly(self) -> Callable[[Geometry], Assembly]:
        """Which balls are solved: half of them where everything lies in plane y."""
        return half_assembly if self.dof == PLANE else full_assembly

    def advance(self, coordinates: Array, near: Point) -> Point:
        """Bearings moved to given coordinates, their balls by a Newton step."""
        return self._point(coordinates, near.bearings.moved(self._displacement(coordinates)))

    def guessed(self, guess: list[Array], near: Point) -> Point:
        """Coordinates and balls where a guess has them, as far as bodies can move."""
        coordinates = self.placed(guess[0])
        displacement = self._displacement(coordinates)
        return self._point(coordinates, near.bearings.at(displacement, guess[1:]))

    def balls_along(self, here: Point, change: Array) -> list[Array]:
        """What the balls of each bearing model do with a ``change`` of the coordinates."""
        moved = self.bearing_motion(change)
        return [each.along(moved[:, places]) for places, each in here.bearings]

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
        """Places of x, y and z among the DOF."""
        return [place for place, number in enumerate(self.dof) if number < FORCES]

    @property
    def _seats(self) -> list[AxialBearing]:
        """The bearing of every seat."""
        return [self.network.arrangement.bearings[k] for k in self.bearings]

    @property
    def thrust(self) -> Array:
        """1 of bearings that a push towards +x loads, −1 of the others (seats,)."""
        return np.array([float(bearing.thrust) for bearing in self._seats])

    @property
    def _sign(self) -> Array:
        """From the DOF of the spindle to those of a bearing (seats, f)."""
        turned = np.array([HALF_TURN_ABOUT_Y if b.thrust < 0 else np.ones(5) for b in self._seats])
        return turned[:, list(self.dof)]

    def bearing_motion(self, coordinates: Array) -> Array:
        """Five DOF of every bearing (speeds, seats, 5) from the unknowns."""
        moved = np.einsum("kiu,su->ski", self.rows, coordinates) * self._sign
        motion = np.zeros((*moved.shape[:2], 5))
        motion[..., list(self.dof)] = moved
        return motion

    def _displacement(self, coordinates: Array) -> Array:
        """Displacements of the bearings (speeds, seats, 5), the shaft's shortening included."""
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

    def matrix(self, here: Point) -> Array:
        """Tangent of all forces; fixed unknowns replaced by themselves."""
        p, springs = len(self.rotor.point), self.network.springs
        k = np.einsum("kiu,skij,kjv->suv", self.rows, here.tangent, self.rows, optimize=True)
        k[:, :p, :p] += self.rotor.stiffness
        bodies = p + np.arange(springs.stiffness.shape[1])
        k[:, bodies, bodies] += springs.stiffness
        fixed = self._fixed
        k = np.where(fixed[:, :, None] | fixed[:, None, :], 0.0, k)
        every = np.arange(k.shape[1])
        largest = np.abs(k).max(axis=(1, 2))[:, None]
        largest = np.where(largest > 0.0, largest, 1.0)
        soft = SOFT * (self.slack(here) | (self.dof != PLANE))[:, None]
        k[:, every, every] += largest * np.where(fixed, 1.0, soft)
        return k

    def slack(self, here: Point) -> Flags:
        """Some bearing holds nothing (speeds,)."""
        return np.asarray((np.abs(here.tangent).max(axis=(2, 3)) == 0.0).any(axis=1))

    def _unbalanced(self, here: Point, force: Force) -> Array:
        """Forces not balanced at the free unknowns (speeds, unknowns)."""
        p, springs = len(self.rotor.point), self.network.springs
        total = -np.einsum("kiu,ski->su", self.rows, here.load)
        total[:, :p] += self.rotor.constant + np.multiply.outer(force, self.rotor.point)
        total[:, :p] -= np.einsum("sij,sj->si", self.rotor.stiffness, here.coordinates[:, :p])
        total[:, p:] += springs.force - springs.stiffness * (here.coordinates[:, p:] - springs.rest)
        total[:, p:] += self.rubbing.force
        total[:, p + SHAFT] += self.network.arrangement.force
        return np.where(self._fixed, 0.0, total)

    def per_newton(self, here: Point, alive: Flags) -> Array:
        """Change of the unknowns per newton of radial force where ``alive`` (speeds, unknowns)."""
        unit = np.zeros((len(self.held), self.rows.shape[2], 1))
        unit[:, : len(self.rotor.point), 0] = self.rotor.point
        matrix = np.where(alive[:, None, None], self.matrix(here), np.eye(unit.shape[1]))
        return np.asarray(np.linalg.solve(matrix, unit)[..., 0])

    def error(self, here: Point, force: Force) -> Array:
        """Largest unbalanced force of balls and shaft over the largest force (speeds,)."""
        return self.errors(here, force)[1]

    def errors(self, here: Point, force: Force) -> tuple[Array, Array]:
        """Unbalanced forces, and the largest of balls and shaft, each over its largest force; of a
        radial force that is small beside the preload, over ``SMALL`` times that."""
        miss = self._unbalanced(here, force)
        acting = np.abs(force)
        size = np.maximum(np.abs(here.load[..., self._forces]).max(axis=(1, 2)), acting)
        size = size + np.abs(self.network.springs.force).max(axis=1) + LEAST
        size = np.minimum(size, np.maximum(SMALL * acting, size / SMALL))
        shaft = np.abs(miss).max(axis=1) / size
        return miss, np.maximum(shaft, here.imbalance)

    def placed(self, coordinates: Array) -> Array:
        """Coordinates with every body that cannot move where it stands."""
        p, springs = len(self.rotor.point), self.network.springs
        position = np.where(self.rubbing.stuck, self.rubbing.place, coordinates[:, p:])
        position = np.where(self.held, self.limit, position)
        position = np.where(springs.fixed, springs.rest, position)
        return np.concatenate([coordinates[:, :p], position], axis=1)

    def begun(self, here: Point) -> Balance:
        """The same where a step of the loads begins ``here``: sleeves slide away from there."""
        position = here.coordinates[:, len(self.rotor.point) :]
        return replace(self, rubbing=replace(self.rubbing, begun=position))

    def where(self, rows: Flags, other: Balance) -> Balance:
        """Stops and friction of this one at some speeds, those of ``other`` at the rest."""
        held = np.where(rows[:, None], self.held, other.held)
        return replace(self, held=held, rubbing=self.rubbing.where(rows, other.rubbing))

    def differs(self, other: Balance) -> Flags:
        """Speeds at which another body stands at a stop or sticks."""
        change = (self.held != other.held) | (self.rubbing.stuck != other.rubbing.stuck)
        return np.asarray(change.any(axis=1))

    def with_contacts(self, here: Point) -> Balance:
        """The same with the bodies at their stops that belong there, and friction as it must be."""
        p, none = len(self.rotor.point), np.zeros_like(self.held)
        free = replace(self, held=none, rubbing=replace(self.rubbing, stuck=none))
        force, position = free._unbalanced(here, 0.0)[:, p:], here.coordinates[:, p:]
        held = stops_wanted(self.network, position, force, self.held, self.limit)
        bare = force - self.rubbing.force
        rubbing = self.rubbing.after(bare, position, self.held, held)
        return replace(self, held=held, rubbing=rubbing)

    def friction(self, here: Point) -> Array:
        """Friction on the bodies (speeds, bodies) [N]."""
        p, none = len(self.rotor.point), np.zeros_like(self.held)
        rubbing = replace(self.rubbing, stuck=none, force=0.0 * self.rubbing.force)
        bare = replace(self, held=none, rubbing=rubbing)._unbalanced(here, 0.0)[:, p:]
        return np.where(self.rubbing.stuck, -bare, self.rubbing.force)

    def travel(self, coordinates: Array) -> Array:
        """How far each body has moved from rest against its spring (speeds, bodies) [m]."""
        moved = coordinates[:, len(self.rotor.point) :] - self.rest
        return -self.network.arrangement.direction * moved


def _offset(spindle: Spindle, dof: tuple[int, ...]) -> Array:
    """What misaligned seats add to the displacements of bearings (seats, f) [m, rad]."""
    offsets = np.array([(0.0, *seat.misalignment.offset) for seat in spindle.seats])
    return -offsets.reshape(-1, 5)[:, list(dof)]


def _rows(network: Network, rotor: StaticRotor) -> Array:
    """The DOF between the rings of every seat, in the unknowns."""
    p, bodies = len(rotor.point), len(network.arrangement.bodies)
    rows = np.zeros((len(rotor.seats), len(rotor.dof), p + bodies))
    rows[:, 1:, :p] = rotor.seats
    for bearing in network.arrangement.bearings:
        for seat in bearing.seats:
            rows[seat, 0, p + SHAFT] = 1.0
            if bearing.outer != HOUSING:
                rows[seat, 0, p + bearing.outer] = -1.0
    return rows
