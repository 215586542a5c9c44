"""Nonlinear forces of the bearings: their loads minus those of their tangents."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from bearings.ring.assembly import full_assembly
from bearings.ring.iterate import Settled, settled
from bearings.ring.request import solved
from bearings.ring.state import BearingState
from rotordyn.arrays import Array, Flags
from rotordyn.scene.scene import Scene

PLACES = 2  # instants at which bearings are solved together: middle and end of a step


class BearingForces(NamedTuple):
    """Nonlinear forces (s, 2, seats, 5), their slopes (s, 2, seats, 5, 5), speeds at which every
    bearing has a state (s,), and the bearings at the present displacements."""

    force: Array
    slope: Array
    exists: Flags
    bearings: Bearings


@dataclass(frozen=True, eq=False, slots=True)
class Bearings:
    """All bearings about their preload states at usable speeds (s,), in their own frames.

    ``displacement``, ``load`` (s, seats, 5) and ``tangent`` (s, seats, 5, 5) of these states;
    ``radius`` (seats,) of the pitch circles [m]; ``states``: seats and their states (s, places) of
    each model; ``near``: last states of their balls (s, places, 2), from which iterations start.
    """

    displacement: Array
    load: Array
    tangent: Array
    radius: Array
    states: list[tuple[list[int], BearingState]]
    near: list[Settled]

    @classmethod
    def of(cls, scene: Scene) -> Bearings:
        """Return the bearings about the preload state of a scene."""
        placed, rows = scene.preload.seat_states(), scene.bearing_row[scene.usable]
        by_model: dict[int, tuple[BearingState, list[int]]] = {}
        for seat, (state, _) in enumerate(placed):
            by_model.setdefault(id(state), (state, []))[1].append(seat)
        displacement, load = np.zeros((2, len(rows), len(placed), 5))
        states, near = [], []
        for state, seats in by_model.values():
            columns = np.array([placed[seat][1] for seat in seats])
            chosen = state.rows(np.ix_(rows, columns))
            repeated = np.repeat(chosen.displacement[:, :, None], PLACES, axis=2)
            balls = settled(chosen.operation.at(repeated), full_assembly)
            states.append((seats, chosen))
            near.append(balls)
            displacement[:, seats], load[:, seats] = chosen.displacement, balls.load[:, :, 0]
        radius = np.array([0.5 * seat.bearing.pitch_diameter for seat in scene.spindle.seats])
        return cls(displacement, load, scene.seat_stiffness, radius, states, near)

    @property
    def lever(self) -> Array:
        """Factors from displacements of rings to lengths (5·seats,): 1, 1, 1, radius and radius."""
        one = np.ones_like(self.radius)
        return np.stack([one, one, one, self.radius, self.radius], axis=1).ravel()

    def at(self, moved: Array) -> BearingForces:
        """Return forces with rings displaced by ``moved`` (s, 2, seats, 5) from their states."""
        moved, near = moved.swapaxes(1, 2), []
        force, slope = np.zeros(moved.shape), np.zeros((*moved.shape, 5))
        exists = np.ones(len(moved), dtype=bool)
        for (seats, _), last in zip(self.states, self.near, strict=True):
            balls = last.moved(self.displacement[:, seats, None] + moved[:, seats])
            near.append(balls)
            force[:, seats] = balls.load - self.load[:, seats, None]
            slope[:, seats] = balls.stiffness - self.tangent[:, seats, None]
            exists &= np.isfinite(balls.error).all(axis=(1, 2))
        force -= np.einsum("skij,sknj->skni", self.tangent, moved)
        return BearingForces(
            force.swapaxes(1, 2), slope.swapaxes(1, 2), exists, replace(self, near=near)
        )

    def loads(self, moved: Array, force: Array) -> Array:
        """Return total loads (s, t, seats, 5) of rings displaced by ``moved``, with the nonlinear
        ``force`` there, both (s, t, 5·seats)."""
        shape = (*moved.shape[:2], len(self.radius), 5)
        linear = np.einsum("skij,stkj->stki", self.tangent, moved.reshape(shape))
        return np.asarray(self.load[:, None] + linear + force.reshape(shape))

    def balls_at(self, moved: Array) -> tuple[Array, Array, Flags]:
        """Return, with rings displaced by ``moved`` (s, seats, k, 5): largest contact pressure
        [Pa], infinite where contacts are crushed beyond any state, number of balls that the inner
        race does not load, and whether it loads none (s, seats, k)."""
        pressure, idle = np.zeros((2, *moved.shape[:3]))
        unloaded = np.zeros(moved.shape[:3], dtype=bool)
        for seats, state in self.states:
            displacement = self.displacement[:, seats, None] + moved[:, seats]
            state_at = solved(state.operation.at(displacement))
            largest = np.maximum(state_at.inner_pressure, state_at.outer_pressure)
            crushed = state_at.outcome == "overloaded"
            pressure[:, seats] = np.where(crushed, np.inf, largest.max(axis=-1))
            no_load = state_at.inner_load <= 0.0
            idle[:, seats], unloaded[:, seats] = no_load.sum(axis=-1), no_load.all(axis=-1)
        return pressure, idle, unloaded
