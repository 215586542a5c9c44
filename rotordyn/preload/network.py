"""Forces on the bodies of the arrangement, at all speeds at once.

Positions x (speeds, bodies) are measured from where every bearing is just unloaded at rest, or in
the middle of its play where it takes thrust both ways. The state at rest, with the springs at their
stated preload, determines the position of each spring and stop.
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
        """Return the springs at the speeds ``index``."""

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
        """Return the response at the speeds ``index``, every bearing solved by itself."""
        states = {
            (model, law.take(index)): Solved(solved.places, solved.state.rows(index))
            for (model, law), solved in self.states.items()
        }
        return Response(self.load[index], self.slope[index], states)

    @cached_property
    def bearings(self) -> BearingIterates:
        """Balls of each bearing, to ``move`` on from: one ball where all are identical."""
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
        """Join machines of one structure into one network, their speeds in sequence."""
        if len(machines) == 1:
            return machines[0]

        def over_speed(values: Iterable[Array]) -> Array:
            rows = [len(machine.arrangement.speed) for machine in machines]
            pairs = zip(values, rows, strict=True)
            return np.concatenate([np.broadcast_to(v, (n, v.shape[1])) for v, n in pairs])

        springs = [machine.springs for machine in machines]
        return cls(
            side_by_side([machine.arrangement for machine in machines]),
            Springs(
                over_speed(spring.force for spring in springs),
                over_speed(spring.stiffness for spring in springs),
                over_speed(spring.rest for spring in springs),
                springs[0].fixed,
            ),
            over_speed(machine.friction for machine in machines),
        )

    def at(self, index: Indices) -> Network:
        """Return the network at the speeds ``index``."""
        friction = self.friction if len(self.friction) == 1 else self.friction[index]
        return Network(self.arrangement.at(index), self.springs.at(index), friction)

    @property
    def one_branch(self) -> bool:
        """True if ball contacts open and close continuously: neighbours may be a start."""
        return all(np.all(bearing.law.one_branch) for bearing in self.arrangement.bearings)

    @cached_property
    def tandem(self) -> Array:
        """Number of seats of each bearing of the arrangement (bearings,)."""
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
        """Return the axial deflection of every bearing (speeds, bearings) [m]."""
        return x @ self.incidence.T + self._shift

    @cached_property
    def _shift(self) -> Array:
        return np.stack([b.thrust * b.shortening for b in self.arrangement.bearings], axis=1)

    def respond(self, x: Array, near: Response | None = None) -> Response:
        """Return loads and slopes at positions ``x``, every bearing solved by itself."""
        displacement = self._displacement(x)
        start = near.states if near is not None and near.states else None
        bearings = range(displacement.shape[1])
        states = self.solve_bearings(bearings, start, displacement=displacement)
        load, slope = np.empty((2, *displacement.shape[:2]))
        for batch in states.values():
            load[:, batch.places] = batch.state.load[..., 0]
            slope[:, batch.places] = batch.state.complete_stiffness[..., 0, 0]
        return Response(load, slope, states)

    def begin(self, x: Array) -> Response:
        """Return a response to ``move`` on from, without states if the compiled solver is used."""
        from bearings.ball.law import Law
        from bearings.geometry import geometry
        from bearings.ring.assembly import axial_assembly
        from bearings.ring.compiled.states import loaded

        if not all(
            isinstance(b.law, Law) and loaded(geometry(b.model.grooves))
            for b in self.arrangement.bearings
        ):
            return self.respond(x)
        from bearings.ring.iterate import settled

        displacement = self._displacement(x)
        operations = self._operations(
            range(displacement.shape[1]), displacement=displacement, load=None
        )
        iterates = {
            kind: (places, settled(points, axial_assembly))
            for kind, (places, points) in operations.items()
        }
        return self._response(BearingIterates(iterates))

    def move(self, x: Array, near: Response) -> Response:
        """Return loads and slopes at positions ``x``, balls iterated from their last positions."""
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
        """Solve bearings at displacements or under loads in their own frames (speeds, places, 5).

        ``bearings``: index of the arrangement's bearing at every place. All of one model and law
        are solved in one call; ``near``: states close by, which speed up the search.
        """
        from bearings.ring.request import solved

        states = {}
        operations = self._operations(bearings, displacement=displacement, load=load)
        for kind, (places, points) in operations.items():
            kind[0].check_load(points.load, points.free)
            start = None if near is None else near[kind].state
            states[kind] = Solved(places, solved(points, start))
        return states

    def _operations(
        self, bearings: Sequence[int], *, displacement: Array | None, load: Array | None
    ) -> dict[Alike, tuple[list[int], Operation]]:
        """Return places and operating conditions of the bearings by model and law."""
        from bearings.ring.operation import operation

        rows = np.arange(len(self.arrangement.speed))
        chosen = [self.arrangement.bearings[k] for k in bearings]
        places: dict[Alike, list[int]] = {}
        for place, bearing in enumerate(chosen):
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
                    static_growth=np.stack([chosen[p].static_growth for p in where], axis=1),
                    growth=np.stack([chosen[p].growth for p in where], axis=1),
                ),
            )
            for (model, law), where in places.items()
        }

    def forces(self, x: Array, response: Response) -> Array:
        """Return the sum of forces on each body towards +x (speeds, bodies) [N]."""
        springs = self.springs
        total = springs.force - springs.stiffness * (x - springs.rest) + self.friction
        total = total - (self.tandem * response.load) @ self.incidence
        total[:, SHAFT] += self.arrangement.force
        return total

    def error(self, x: Array, response: Response, fixed: Flags) -> tuple[Array, Array]:
        """Return residual forces of the free bodies, and the largest over the largest force."""
        residual = np.where(fixed, 0.0, self.forces(x, response))
        reference = (self.tandem * np.abs(response.load)).max(axis=1)
        reference = reference + np.abs(self.springs.force).max(axis=1) + 1e-9  # never zero
        return residual, np.abs(residual).max(axis=1) / reference


@dataclass(frozen=True, eq=False, slots=True)
class NetworkState:
    """Axial state: ``position`` (speeds, bodies) [m], bodies ``held`` by a stop; ``error``,
    ``converged`` (speeds,)."""

    position: Array
    held: Flags
    response: Response
    error: Array
    converged: Flags

    def rows(self, index: Indices) -> NetworkState:
        """Return the state at the speeds ``index``."""
        return NetworkState(
            self.position[index],
            self.held[index],
            self.response.rows(index),
            self.error[index],
            self.converged[index],
        )

    def parts(self, rows: Sequence[int]) -> Iterator[NetworkState]:
        """Yield the state of each machine side by side; ``rows``: number of speeds of each."""
        if len(rows) == 1:
            yield self
            return
        for last, count in zip(np.cumsum(rows), rows, strict=True):
            yield self.rows(np.arange(last - count, last))
