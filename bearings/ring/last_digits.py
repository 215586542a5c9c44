"""Ball loads with more digits than the lengths they come from.

A contact approach of nanometres is the difference of two lengths of millimetres, and of a ball
under a millinewton few of its digits are left. The Newton step that a solved state still asks for
is smaller than these lengths resolve; added to the approaches themselves it is not lost.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ball.balance import Balance
from bearings.ball.plane import Pair, direction, dot
from bearings.ring.problem import Problem

Array = NDArray[np.float64]
Place = tuple[Array, Array]
LEAST = 0.5  # of an approach is left


def after_step(problem: Problem, balance: Balance, at: Place, step: Place) -> Balance:
    """Loads and directions of the contacts after a ``step`` (dd, dX) to ``at`` (d, X).

    d and dd (s, 5), X and dX (2, s, n). Fc and Mg notice such a step only where they depend on the
    ratio of the loads; they are left as they are.
    """
    c, (d, x), (dd, dx) = problem.model.constants, at, step
    a, moved = problem.centres(d), problem.ring.moved(dd)
    still = balance.inner_load, balance.inner_direction
    if not problem.turning:
        load = _loaded(c.series_stiffness, *still, (moved[0], moved[1]))
        way = direction((a[0], a[1]))[:2]
        return balance._replace(
            inner_load=load, outer_load=load, inner_direction=way, outer_direction=way
        )
    outer = _loaded(c.outer_stiffness, balance.outer_load, balance.outer_direction, (dx[0], dx[1]))
    return balance._replace(
        inner_load=_loaded(c.inner_stiffness, *still, (moved[0] - dx[0], moved[1] - dx[1])),
        outer_load=outer,
        inner_direction=direction((a[0] - x[0], a[1] - x[1]))[:2],
        outer_direction=direction((x[0], x[1]))[:2],
    )


def _loaded(stiffness: float, load: Array, along: Pair, step: Pair) -> Any:
    """k (δ + dδ)^1.5 of contacts that carry ``load``; open ones stay open."""
    approach = (load / stiffness) ** (2.0 / 3.0)
    deeper = np.maximum(approach + dot(along, step), LEAST * approach)
    return np.where(load > 0.0, stiffness * deeper**1.5, 0.0)
