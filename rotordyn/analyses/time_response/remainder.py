"""What bearings push beyond their tangents: their load less that of the linear machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bearings.ring.assembly import full_assembly
from bearings.ring.iterate import Settled, settled
from bearings.ring.request import solved
from bearings.ring.state import BearingState
from rotordyn.arrays import Array, Flags
from rotordyn.scene.scene import Scene

NODES = 2  # of a step at which bearings are solved: its middle and its end


class Beyond(NamedTuple):
    """Load beyond that of the tangents (s, 2, seats, 5), its slope (s, 2, seats, 5, 5), and speeds
    at which every bearing has a state (s,)."""

    beyond: Array
    slope: Array
    exists: Flags


@dataclass(eq=False, slots=True)
class Remainder:
    """All bearings about their states at usable speeds (s,), in their own frames.

    ``displacement``, ``load`` (s, seats, 5) and ``tangent`` (s, seats, 5, 5) of these states;
    ``lever`` (5·seats,) makes displacements lengths; ``alike``: by model the seats and their
    bearings (s, places, 2 nodes), sought from where they stood last, and ``states`` (s, places);
    ``largest`` (s,): largest way of a ring so far [m].
    """

    displacement: Array
    load: Array
    tangent: Array
    lever: Array
    alike: list[tuple[list[int], Settled]]
    states: list[tuple[list[int], BearingState]]
    largest: Array

    @classmethod
    def of(cls, scene: Scene) -> Remainder:
        """About the preload state."""
        states, rows = scene.preload.seat_states(), scene.bearing_row[scene.usable]
        by_model: dict[int, tuple[BearingState, list[int]]] = {}
        for seat, (state, _) in enumerate(states):
            by_model.setdefault(id(state), (state, []))[1].append(seat)
        radii = [0.5 * seat.bearing.pitch_diameter for seat in scene.spindle.seats]
        lever = np.concatenate([[1.0, 1.0, 1.0, radius, radius] for radius in radii])
        none, tangent = np.zeros((2, len(rows), len(states), 5)), scene.seat_stiffness
        about = cls(none[0], none[1], tangent, lever, [], [], np.zeros(len(rows)))
        for state, seats in by_model.values():
            columns = np.array([states[seat][1] for seat in seats])
            chosen = state.rows(np.ix_(rows, columns))
            nodes = np.repeat(chosen.displacement[:, :, None], NODES, axis=2)
            balls = settled(chosen.operation.at(nodes), full_assembly)
            about.alike.append((seats, balls))
            about.states.append((seats, chosen))
            about.displacement[:, seats] = chosen.displacement
            about.load[:, seats] = balls.load[:, :, 0]
        return about

    def at(self, moved: Array) -> Beyond:
        """Rings ``moved`` (s, 2, seats, 5) from their states."""
        moved = moved.swapaxes(1, 2)
        beyond, slope = np.zeros(moved.shape), np.zeros((*moved.shape, 5))
        exists = np.ones(len(moved), dtype=bool)
        for k, (seats, before) in enumerate(self.alike):
            here = before.moved(self.displacement[:, seats, None] + moved[:, seats])
            self.alike[k] = seats, here
            beyond[:, seats] = here.load - self.load[:, seats, None]
            slope[:, seats] = here.stiffness - self.tangent[:, seats, None]
            exists &= np.isfinite(here.error).all(axis=(1, 2))
        beyond -= np.einsum("skij,sknj->skni", self.tangent, moved)
        return Beyond(beyond.swapaxes(1, 2), slope.swapaxes(1, 2), exists)

    def balls_at(self, moved: Array) -> tuple[Array, Array]:
        """Of rings ``moved`` (s, seats, 5): largest contact pressure [Pa], and how many balls the
        inner race does not load (s, seats)."""
        pressure, idle = np.zeros((2, *moved.shape[:2]))
        for seats, state in self.states:
            there = (self.displacement + moved)[:, seats, None]
            found = solved(state.operation.at(there))
            largest = np.maximum(found.inner_pressure, found.outer_pressure)
            pressure[:, seats] = largest.max(axis=-1)[..., 0]
            idle[:, seats] = (found.inner_load <= 0.0).sum(axis=-1)[..., 0]
        return pressure, idle
