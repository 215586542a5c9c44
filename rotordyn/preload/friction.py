"""Dry friction of sleeves in the state of a spindle: what it holds at the end of the history, and
as loads go on from there.

Friction is a force on each sleeve within ± its limit. A sleeve that sticks stands where it stood;
one that slides is pushed against the way it goes.

Theory: docs/theory/network.md#friction-in-all-analyses.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from rotordyn.machine.history import ASSEMBLED, Past
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.history import history
from rotordyn.preload.on_films import Films
from rotordyn.preload.state import PreloadState, dynamic_preload, settled

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
BEYOND = 1e-9  # of the limit: friction that sticks carries too much
STILL = 1e-13  # m: a body that went less far did not slide


def operating_state(
    spindle: Spindle,
    speed: Array,
    law: Law,
    axial_force: float = 0.0,
    temperatures: Temperatures | None = None,
    past: Past = ASSEMBLED,
    films: Films | None = None,
) -> PreloadState:
    """The preload state at every ``speed`` [rad/s], with the friction that is left at the end of
    the history ``past``; as ``dynamic_preload`` where no sleeve rubs."""
    state = dynamic_preload(spindle, speed, law, axial_force, temperatures, films)
    return remembered(replace(state, past=past))


def remembered(state: PreloadState) -> PreloadState:
    """The state with the friction that its history has left on the sleeves."""
    if not state.rubs.any():
        return state
    path = history(state, 0.0)
    force, position = np.zeros_like(state.net.position), state.net.position.copy()
    words = [""] * len(force)
    for row, there in enumerate(path.run_up()):
        if isinstance(there, str):
            words[row] = f"no history leads there: {there}"
            continue
        force[row] = there.friction @ path.network.frictions.row
        position[row] = state.rest + there.x
    found = settled(state, replace(state.network, friction=force), position)
    outcome = tuple(word or other for word, other in zip(words, found.outcome, strict=True))
    return replace(found, outcome=outcome)


@dataclass(frozen=True, eq=False, slots=True)
class Rubbing:
    """Friction of bodies while a load grows.

    ``limit`` (bodies,) [N]; ``stuck`` (states, bodies) where they stand at ``place`` [m]; ``force``
    (states, bodies) [N] on all others; ``begun`` (states, bodies) [m]: before the last step.
    """

    limit: Array
    stuck: Flags
    place: Array
    force: Array
    begun: Array

    @classmethod
    def of(cls, state: PreloadState, rows: NDArray[np.intp]) -> Rubbing:
        """Every sleeve that rubs sticks where it is, but for those at a stop."""
        position, held = state.net.position[rows], state.net.held[rows]
        force = np.broadcast_to(state.network.friction, state.net.position.shape)[rows]
        return cls(state.rubs, (state.rubs > 0.0) & ~held, position, force, position)

    def after(self, force: Array, position: Array, was: Flags, held: Flags) -> Rubbing:
        """Friction as it must be where the balance was found.

        ``force`` (states, bodies) [N] without friction and stops; bodies that ``was`` and are now
        ``held`` at stops.
        """
        if not self.limit.any():
            return self
        needs = -force
        slides = self.stuck & (np.abs(needs) > self.limit * (1.0 + BEYOND))
        rub = np.where(slides, np.sign(needs) * self.limit, self.force)
        rubbing = (self.limit > 0.0) & ~held
        way = position - self.begun
        back = rubbing & ~self.stuck & ~was & (rub * way > self.limit * STILL)
        leaves = rubbing & was
        place = np.where(back, self.begun, np.where(leaves, position, self.place))
        return replace(self, stuck=(self.stuck & ~slides) | back | leaves, force=rub, place=place)

    def where(self, rows: Flags, other: Rubbing) -> Rubbing:
        """This one at some states, ``other`` at the rest."""
        pairs = {
            name: np.where(rows[:, None], getattr(self, name), getattr(other, name))
            for name in ("stuck", "place", "force", "begun")
        }
        return replace(self, **pairs)
