"""How the balls of a solved state move on their races: Jones' race control, spinning over rolling.

A ball turns against a race about an axis with a part along the contact normal (spin) and one in the
plane of the contact (roll). Their ratio depends on angles and on the attitude β of the ball's axis,
not on speed: at rest it is what the first slow turn would show.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.ball.kinematics import HYPOTHESES, Angles, orbit_and_spin
from bearings.ring.data import StateData

Array = NDArray[np.float64]
ROUNDING = 1e-15  # of a ratio


def race_weight(state: StateData) -> Array:
    """C = Qi ai Ei/(Qo ao Eo) of the spin friction moments (…, balls); 0 where a race is free."""
    g = state.cause.geometry
    outer = np.where(state.outer_load > 0.0, state.outer_load, np.inf)
    deep = (state.inner_load / g.inner.stiffness) / (outer / g.outer.stiffness)
    return np.asarray(g.race_ratio * deep ** (4.0 / 3.0))


def control(state: StateData) -> NDArray[np.str_]:
    """Which race controls each ball: ``"inner"``, ``"outer"``, ``"neither"``; ``""`` without load.

    The one whose margin is positive (``control_margins``); never both. Control has no meaning where
    a ball has more than two contacts, one of which slides: ``""``.
    """
    inner, outer = control_margins(state)
    word = np.where(inner > 0.0, "inner", np.where(outer > 0.0, "outer", "neither"))
    one_each = (state.inner_load > 0.0) & ((state.contact_load > 0.0).sum(axis=-1) == 2)
    return np.where(one_each, word, "")


def control_margins(state: StateData) -> tuple[Array, Array]:
    """C cos(αi − αo) − 1 and cos(αi − αo) − C of each ball, inner and outer race (…, balls).

    Jones (1959): a race controls where its friction moment, turned onto the normal of the other
    race, is the larger one, that is where its margin is positive.
    """
    weight, cosine = race_weight(state), np.cos(state.inner_angle - state.outer_angle)
    return weight * cosine - 1.0, cosine - weight


def spin_to_roll(state: StateData) -> tuple[Array, Array]:
    """Spin over roll at the inner and the outer race, each (…, balls); 0 where a ball is not held.

    Of the ball's rotation against the race: the part along the contact line (sin α, cos α), over
    that along the tangent (cos α, −sin α), components axial and radial. Without gross slip
    (1 − γ cos αi) tan(αi − β) + γ sin αi   and   (1 + γ cos αo) tan(αo − β) − γ sin αo (Harris).
    """
    g = state.cause.geometry.size_ratio
    si, ci = np.sin(state.inner_angle), np.cos(state.inner_angle)
    so, co = np.sin(state.outer_angle), np.cos(state.outer_angle)
    t = _tilt(state, Angles(si, ci, so, co, g, race_weight(state)))
    inner = (1.0 - g * ci) * (si - ci * t) / (ci + si * t) + g * si
    outer = (1.0 + g * co) * (so - co * t) / (co + so * t) - g * so
    return _held(state, inner), _held(state, outer)


def _tilt(state: StateData, angles: Angles) -> Array:
    """tan β as the hypothesis has it, less where a race slips."""
    wanted = np.asarray(HYPOTHESES[state.cause.law.kinematics](angles).value)
    if state.cause.law.friction is None:
        return wanted
    inertia = state.cause.geometry.ball_inertia * state.speed[..., None] ** 2
    moment = inertia * orbit_and_spin(angles, wanted)[1].value
    slips = state.slipping != ""
    return np.where(slips, state.gyroscopic_moment / np.where(slips, moment, 1.0), 1.0) * wanted


def _held(state: StateData, ratio: Array) -> Array:
    """A ratio without its rounding, 0 of balls that carry nothing."""
    real = (state.inner_load > 0.0) & (np.abs(ratio) > ROUNDING)
    return np.where(real | np.isnan(state.inner_load), ratio, 0.0)
