"""Dry friction of sleeves: its forces at the end of the history, and while further loads grow.

Friction is a force on each sleeve within ± its limit. A sleeve that sticks keeps its position; on
one that slides friction opposes the motion.

Theory: docs/theory/network.md#friction-in-all-analyses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from bearings.ball.law import Law
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.machine.history import ASSEMBLED, Past
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.on_films import Films
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload, settled

BEYOND = 1e-9  # of the limit: a body that needs more excess friction slips
STILL = 1e-13  # m: a body that moved less did not slide


def operating_state(
    spindle: Spindle,
    speed: Array,
    law: Law,
    axial_force: float = 0.0,
    temperatures: Temperatures | None = None,
    past: Past = ASSEMBLED,
    films: Films | None = None,
) -> PreloadState:
    """Return the preload state at every ``speed`` [rad/s], with the friction that remains at the
    end of the history ``past``; equal to ``dynamic_preload`` where no sleeve rubs."""
    state = dynamic_preload(spindle, speed, law, axial_force, temperatures, films)
    return with_friction(replace(state, past=past))


def with_friction(state: PreloadState) -> PreloadState:
    """Return the state with the friction that its history has left on the sleeves."""
    if not state.rubs.any():
        return state
    from rotordyn.preload.history import history

    path = history(state, 0.0)
    force, position = np.zeros_like(state.net.position), state.net.position.copy()
    failures = [""] * len(force)
    for row, end in enumerate(path.run_up()):
        if isinstance(end, str):
            rpm = state.speed[row] * 30.0 / math.pi
            failures[row] = f"the history leads to no state at {rpm:.0f} rpm: {end}"
            continue
        force[row] = end.friction @ path.network.frictions.row
        position[row] = state.rest + end.x
    rubbed = replace(state, network=replace(state.network, friction=force))
    (solution,) = settled([rubbed], [position])
    outcome = tuple(
        failure or solved for failure, solved in zip(failures, solution.outcome, strict=True)
    )
    return replace(solution, outcome=outcome)


@dataclass(frozen=True, eq=False, slots=True)
class Rubbing:
    """Friction of bodies while a load grows, of shape (states, bodies).

    ``limit`` (bodies,) [N] of friction; ``stuck``: bodies that friction holds at ``place`` [m];
    ``force`` [N]: friction on all others; ``begun`` [m]: positions before the last step.
    """

    limit: Array
    stuck: Flags
    place: Array
    force: Array
    begun: Array

    @classmethod
    def of(cls, state: PreloadState, rows: Indices) -> Rubbing:
        """Return friction by which every rubbing sleeve sticks in place, except at a stop."""
        position, held = state.net.position[rows], state.net.held[rows]
        force = np.broadcast_to(state.network.friction, state.net.position.shape)[rows]
        return cls(state.rubs, (state.rubs > 0.0) & ~held, position, force, position)

    def after(self, force: Array, position: Array, was: Flags, held: Flags) -> Rubbing:
        """Return friction corrected for the equilibrium at ``position`` [m].

        ``force`` (states, bodies) [N]: sum of all forces but friction and stops; ``was``, ``held``:
        bodies that stood at a stop before the step, and that stand there now.
        """
        if not self.limit.any():
            return self
        needed = -force  # friction that would hold each body
        slips = self.stuck & (np.abs(needed) > self.limit * (1.0 + BEYOND))
        friction = np.where(slips, np.sign(needed) * self.limit, self.force)
        free = (self.limit > 0.0) & ~held
        # friction along the motion would drive the body: it has reversed, and sticks where it began
        reversing = friction * (position - self.begun) > self.limit * STILL
        sticks = free & ~self.stuck & ~was & reversing
        leaves = free & was  # a body that leaves its stop begins to stick there
        place = np.where(sticks, self.begun, np.where(leaves, position, self.place))
        stuck = (self.stuck & ~slips) | sticks | leaves
        return replace(self, stuck=stuck, force=friction, place=place)

    def where(self, rows: Flags, other: Rubbing) -> Rubbing:
        """Return this friction at the states ``rows``, elsewhere that of ``other``."""
        merged = {
            name: np.where(rows[:, None], getattr(self, name), getattr(other, name))
            for name in ("stuck", "place", "force", "begun")
        }
        return replace(self, **merged)
