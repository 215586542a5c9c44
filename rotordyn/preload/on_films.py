"""The preload state of a spindle whose balls run on their oil films.

A film acts as if the inner groove were larger and shifted along the axis (``bearings.on_film``): a
rigid preload rises, the rings of a sprung one shift. Films depend on the loads, so that state and
films are iterated in turn. At rest there are none: springs keep their stated preload. Loads across
the axis act on the films of the state without such loads: films differ little from ball to ball.

Theory: docs/theory/life.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array

if TYPE_CHECKING:
    from bearings.film import Film
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState
    from rotordyn.preload.state import PreloadState

CLOSE = 1e-11  # m, change of the films at which the iteration ends
MOST = 30  # iterations; a few suffice, as films vary with the load to the power −0.067


@dataclass(frozen=True, eq=False, slots=True)
class Films:
    """Films of all bearings at speeds ``speed`` (s,) [rad/s], ascending, of an oil at a
    ``temperature`` [°C].

    ``growth``, ``axial`` (s, seats) [m]: apparent growth of the inner grooves, and their apparent
    shift in the loading direction; ``without`` (s, seats) [N]: axial loads without films.
    """

    lubricant: Lubricant
    temperature: float
    speed: Array
    growth: Array
    axial: Array
    without: Array

    def at(self, speed: Array) -> tuple[Array, Array]:
        """Return growth and shift (n, seats) [m] at other speeds, interpolated linearly between the
        speeds of the films; 0 at rest."""
        if np.array_equal(speed, self.speed):
            return self.growth, self.axial
        speeds = np.concatenate([[0.0], self.speed])
        growth, axial = (
            np.stack([np.interp(speed, speeds, [0.0, *column]) for column in values.T], axis=1)
            for values in (self.growth, self.axial)
        )
        return growth, axial

    def of(self, state: BearingState) -> Film:
        """Return the films of a bearing state."""
        from bearings.film import film

        return film(state, self.lubricant, self.temperature)


def on_films(
    solve: Callable[[Films | None], PreloadState], lubricant: Lubricant, temperature: float
) -> PreloadState:
    """Return the fixed point of ``solve``: the state whose films are those of that state."""
    from bearings.on_film import grown, kept

    dry = state = solve(None)
    zero = np.zeros_like(dry.seat_load())
    films = Films(lubricant, temperature, dry.speed, zero, zero, dry.seat_load())
    for _ in range(MOST):
        shifted = [(grown(balls, films.of(balls)), at) for balls, at in state.seat_states()]
        growth, axial = (
            np.stack([pair[part][:, at] for pair, at in shifted], axis=1) for part in (0, 1)
        )
        growth, axial = kept((growth, axial), (films.growth, films.axial))
        change = max(np.abs(growth - films.growth).max(), np.abs(axial - films.axial).max())
        films = replace(films, growth=growth, axial=axial)
        state = solve(films)
        if change < CLOSE:
            break
    return state
