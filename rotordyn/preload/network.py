"""Forces on the bodies of the arrangement, at all speeds at once.

Positions x (speeds, bodies) are measured from where every bearing is just unloaded at rest, or
stands in the middle of its play where it takes thrust both ways. The state at rest, with the
springs at their stated preload, fixes where each spring and stop is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.preload.arrangement import HOUSING, SHAFT, Arrangement, side_by_side
from rotordyn.preload.bearing_iterates import Alike, BearingIterates, Solved, States

if TYPE_CHECKING:
    from bearings.ring.operation import Operation


@dataclass(frozen=True, eq=False, slots=True)
class Springs:
    """Forces on the bodies towards +x: ``force`` − ``stiffness``·(x − ``rest``), each
    (speeds, bodies), or (1, bodies) where it is the same at all speeds.

    ``fixed`` bodies (bodies,) cannot move from ``rest``.
    """

    force: Array
    stiffness: Array
    rest: Array
    fixed: Flags

    def at(self, index: Indices) -> Springs:
        """Those at some of the speeds."""

        def chosen(values: Array) -> Array:
            return values if len(values) == 1 else values[index]

        return Springs(chosen(self.force), chosen(self.stiffness), chosen(self.rest), self.fixed)


@dataclass(frozen=True, eq=False)
class Response:
    """Axial loads and slopes (speeds, bearings) [N, N/m], and the bearing states behind them.

    ``states``: empty where balls were ``moved`` together with the bodies.
    """

    load: Array
    slope: Array
    states: States
    moved: BearingIterates | None = None

    def rows(self, index: Indices) -> Response:
        """The same of some speeds, every bearing solved by itself."""
        states = {
            (model, law.take(index)): Solved(each.places, each.state.rows(index))
            for (model, law), each in self.states.items()
        }
        return Response(self.load[index], self.slope[index], states)

    @cached_property
    def bearings(self) -> BearingIterates:
        """The balls of each bearing, to move on from: one where all are alike."""
        from bearings.ring.assembly import axial_assembly

        return self.moved or BearingIterates.solved(self.states, axial_assembly)


@dataclass(frozen=True, eq=False)
class Network:
    """An arrangement with its springs; ``friction`` on bodies towards +x [N], (speeds, bodies), or
    (1, 1) where nothing rubs."""

    arrangement: Arrangement
    springs: Springs
    friction: Array = field(default_factory=lambda: np.zeros((1, 1)))

    @classmethod
    def side_by_side(cls, machines: Sequence[Network]) -> Network:
        """Machines of one structure as one network, the speeds of one after those of the other."""
        if len(machines) == 1:
            return machines[0]

        def over_speed(values: Iterable[Array]) -> Array:
            rows = [len(each.arrangement.speed) for each in machines]
            one = zip(values, rows, strict=True)
            return np.concatenate([np.broadcast_to(v, (n, v.shape[1])) for v, n in one])

        springs = [each.springs for each in machines]
        return cls(
            side_by_side([each.arrangement for each in machines]),
            Springs(
                over_speed(each.force for each in springs),
                over_speed(each.stiffness for each in springs),
                over_speed(each.rest for each in springs),
                springs[0].fixed,
            ),
            over_speed(each.friction for each in machines),
        )

    def at(self, index: Indices) -> Network:
        """The network at some of its speeds."""
        friction = self.friction if len(self.friction) == 1 else self.friction[index]
        return Network(self.arrangement.at(index), self.springs.at(index), friction)

    @property
    def one_branch(self) -> bool:
        """True where no ball is loaded or lost at the same place: neighbours may be a start."""
        return all(np.all(bearing.law.one_branch) for bearing in self.arrangement.bearings)

    @cached_property
    def tandem(self) -> Array:
        """How many seats each bearing of the arrangement stands for (bearings,)."""
        return np.array([float(len(bearing.seats)) for bearing in self.arrangement.bearings])

    @cached_property
    def incidence(self) -> Array:
        """B (bearings, bodies): δ = B x + s·shortening; bodies are pushed by −Bᵀ (tandem·F)."""
        b = np.zeros((len(self.arrangement.bearings), len(self.arrangement.bodies)))
        for k, bearing in enumerate(self.arrangement.bearings):
            b[k, SHAFT] = bearing.thrust
            if bearing.outer != HOUSING:
                b[k, bearing.outer] = -bearing.thrust
        return b

    @cached_property
    def both_ways(self) -> Flags:
        """Bearings that carry axial loads of either sign, none within their play (bearings,)."""
        return np.array([bearing.model.both_ways for bearing in self.arrangement.bearings])

    def deflection(self, x: Array) -> Array:
        """Axial deflection of every bearing (speeds, bearings) [m]."""
        return x @ self.incidence.T + self._shift

    @cached_property
    def _shift(self) -> Array:
        return np.stack([b.thrust * b.shortening for b in self.arrangement.bearings], axis=1)

    def respond(self, x: Array, near: Response | None = None) -> Response:
        """Loads and slopes of the bearings at positions ``x``, every bearing solved by itself."""
        displacement = self._displacement(x)
        near_by = near.states if near is not None and near.states else None
        every = range(displacement.shape[1])
        states = self.solve_bearings(every, near_by, displacement=displacement)
        load, slope = np.empty((2, *displacement.shape[:2]))
        for each in states.values():
            load[:, each.places] = each.state.load[..., 0]
            slope[:, each.places] = each.state.complete_stiffness[..., 0, 0]
        return Response(load, slope, states)

    def begin(self, x: Array) -> Response:
        """The same to ``move`` on from, without states where the compiled solver does it."""
        from bearings.ball.law import Law
        from bearings.geometry import geometry
        from bearings.ring.assembly import axial_assembly
        from bearings.ring.compiled.states import loaded

        if not all(
            isinstance(each.law, Law) and loaded(geometry(each.model.grooves))
            for each in self.arrangement.bearings
        ):
            return self.respond(x)
        from bearings.ring.iterate import settled

        displacement = self._displacement(x)
        asked = self._asked(range(displacement.shape[1]), displacement=displacement, load=None)
        found = {
            alike: (where, settled(points, axial_assembly))
            for alike, (where, points) in asked.items()
        }
        return self._response(BearingIterates(found))

    def move(self, x: Array, near: Response) -> Response:
        """Loads and slopes at positions ``x``, balls sought from where they were."""
        return self._response(near.bearings.moved(self._displacement(x)))

    def _displacement(self, x: Array) -> Array:
        deflection = self.deflection(x)
        displacement = np.zeros((*deflection.shape, 5))
        displacement[..., 0] = deflection
        return displacement

    def _response(self, bearings: BearingIterates) -> Response:
        load, slope = np.empty((2, len(self.arrangement.speed), len(self.arrangement.bearings)))
        for places, balls in bearings:
            load[:, places] = balls.load[..., 0]
            slope[:, places] = balls.stiffness[..., 0, 0]
        return Response(load, slope, {}, bearings)

    def solve_bearings(
        self,
        bearings: Sequence[int],
        near: States | None,
        *,
        displacement: Array | None = None,
        load: Array | None = None,
    ) -> States:
        """Bearings at given displacements or under loads in their own frames (speeds, places, 5).

        ``bearings``: which of the arrangement's is at every place. All of one model and law are
        solved in one call; ``near``, states of the same places close by, speeds the search up.
        """
        from bearings.ring.request import solved

        found = {}
        asked = self._asked(bearings, displacement=displacement, load=load)
        for alike, (where, points) in asked.items():
            alike[0].check_load(points.load, points.free)
            start = None if near is None else near[alike].state
            found[alike] = Solved(where, solved(points, start))
        return found

    def _asked(
        self, bearings: Sequence[int], *, displacement: Array | None, load: Array | None
    ) -> dict[Alike, tuple[list[int], Operation]]:
        """Of all bearings of one model and law: their places, and what is asked of them."""
        from bearings.ring.operation import operation

        rows = np.arange(len(self.arrangement.speed))
        at = [self.arrangement.bearings[k] for k in bearings]
        places: dict[Alike, list[int]] = {}
        for place, bearing in enumerate(at):
            places.setdefault((bearing.model, bearing.law), []).append(place)
        return {
            (model, law): (
                where,
                operation(
                    model.grooves,
                    law.take(rows.repeat(len(where))),
                    load=None if load is None else load[:, where],
                    displacement=None if displacement is None else displacement[:, where],
                    speed=self.arrangement.speed[:, None],
                    static_growth=np.stack([at[p].static_growth for p in where], axis=1),
                    growth=np.stack([at[p].growth for p in where], axis=1),
                ),
            )
            for (model, law), where in places.items()
        }

    def forces(self, x: Array, response: Response) -> Array:
        """Sum of forces on each body towards +x (speeds, bodies) [N]."""
        springs = self.springs
        total = springs.force - springs.stiffness * (x - springs.rest) + self.friction
        total = total - (self.tandem * response.load) @ self.incidence
        total[:, SHAFT] += self.arrangement.force
        return total

    def error(self, x: Array, response: Response, fixed: Flags) -> tuple[Array, Array]:
        """Unbalanced forces of the free bodies, and the largest over the largest force."""
        miss = np.where(fixed, 0.0, self.forces(x, response))
        size = (self.tandem * np.abs(response.load)).max(axis=1)
        size = size + np.abs(self.springs.force).max(axis=1) + 1e-9
        return miss, np.abs(miss).max(axis=1) / size


@dataclass(frozen=True, eq=False, slots=True)
class NetworkState:
    """``position`` (speeds, bodies) [m], bodies ``held`` by a stop; ``error``, ``converged``
    (speeds,)."""

    position: Array
    held: Flags
    response: Response
    error: Array
    converged: Flags

    def rows(self, index: Indices) -> NetworkState:
        """The same of some speeds."""
        return NetworkState(
            self.position[index],
            self.held[index],
            self.response.rows(index),
            self.error[index],
            self.converged[index],
        )

    def parts(self, rows: Sequence[int]) -> Iterator[NetworkState]:
        """Of machines side by side each one's, so many ``rows``."""
        if len(rows) == 1:
            yield self
            return
        for last, count in zip(np.cumsum(rows), rows, strict=True):
            yield self.rows(np.arange(last - count, last))
