"""The preload state of a spindle whose balls ride on their oil films.

Films let the inner grooves seem to grow and to move along the axis (``bearings.on_film``), which
raises a rigid preload and shifts a sprung one; they depend on the loads, so that both are found in
turn. At rest there are none: springs keep their stated preload. Loads across the axis act on the
films of the state without them, and the films differ little from ball to ball.

Theory: docs/theory/life.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from bearings.film import Film
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState
    from rotordyn.preload.state import PreloadState

Array = NDArray[np.float64]
CLOSE = 1e-11  # m
MOST = 30


@dataclass(frozen=True, eq=False, slots=True)
class Films:
    """Films of all bearings at speeds ``speed`` (s,) [rad/s], ascending, of an oil at a
    ``temperature`` [°C].

    ``growth``, ``axial`` (s, seats) [m]: by which they let the inner grooves seem to grow, and to
    move the way that loads the bearing; ``without`` (s, seats) [N]: axial loads without them.
    """

    lubricant: Lubricant
    temperature: float
    speed: Array
    growth: Array
    axial: Array
    without: Array

    def at(self, speed: Array) -> tuple[Array, Array]:
        """Growth and shift at other speeds between the own ones (n, seats)."""
        if np.array_equal(speed, self.speed):
            return self.growth, self.axial
        between = (
            np.stack([np.interp(speed, self.speed, column) for column in each.T], axis=1)
            for each in (self.growth, self.axial)
        )
        return next(between), next(between)

    def of(self, state: BearingState) -> Film:
        """The films of a state."""
        from bearings.film import film

        return film(state, self.lubricant, self.temperature)


def on_films(
    solve: Callable[[Films | None], PreloadState], lubricant: Lubricant, temperature: float
) -> PreloadState:
    """The state that ``solve`` gives with the films of that very state."""
    from bearings.on_film import grown

    bare = state = solve(None)
    none = np.zeros_like(bare.seat_load())
    films = Films(lubricant, temperature, bare.speed, none, none, bare.seat_load())
    for _ in range(MOST):
        found = [(grown(balls, films.of(balls)), at) for balls, at in state.seat_states()]
        growth, axial = (
            np.stack([both[part][:, at] for both, at in found], axis=1) for part in (0, 1)
        )
        change = max(np.abs(growth - films.growth).max(), np.abs(axial - films.axial).max())
        films = replace(films, growth=growth, axial=axial)
        state = solve(films)
        if change < CLOSE:
            break
    return state
