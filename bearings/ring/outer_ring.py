"""What the balls of a solved state put on the outer ring."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.kinematics import SHARINGS
from bearings.geometry import Geometry
from bearings.ring.contact_motion import race_weight
from bearings.ring.data import StateData
from bearings.ring.sums import outer_maps

Array = NDArray[np.float64]


def outer_ring_load(state: StateData) -> Array:
    """(Fx, Fy, Fz, My, Mz) of the balls on the outer ring (…, 5) [N, N·m].

    Per ball, of the contacts Σ Q n and of friction (λo Mg/D) across the resultant: axial fa, radial
    fr, and m = Ro fa − x̄ fr + λo fo Mg about the middle of the outer ring, x̄ the axial place where
    the resultant acts (0 with one groove), Ro the radius of the circle of outer groove centres.
    """
    g = state.cause.geometry
    share = 2.0 - SHARINGS[state.cause.law.moment_sharing](race_weight(state))[0]
    moment = share * state.gyroscopic_moment
    along, across = state.outer_load, moment / g.ball_diameter
    sin, cos = np.sin(state.outer_angle), np.cos(state.outer_angle)
    axial, radial = along * sin + across * cos, along * cos - across * sin
    tilting = -g.outer_conformity * moment + _middle(state, g) * radial
    action = np.stack([axial, radial, tilting]).reshape(3, -1, g.balls)
    return outer_maps(g).load(action).reshape(*state.outcome.shape, 5)


def _middle(state: StateData, g: Geometry) -> Array | float:
    """x̄ = Σ x Q cos α / Σ Q cos α of the outer contacts (…, balls) [m]."""
    if len(g.outer_grooves) == 1:
        return 0.0
    load = state.contact_load[..., -2:] * np.cos(np.nan_to_num(state.contact_angle[..., -2:]))
    total = load.sum(axis=-1)
    return (load @ np.array([x.offset for x in g.outer_grooves])) / np.where(
        total != 0.0, total, 1.0
    )
