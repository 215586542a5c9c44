"""Equations of every ball, recomputed from what a solved state shows."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.oracles.ball_bearing import MICROMETRE, BallBearingOracle


def ball_faults(oracle: BallBearingOracle, state: Any) -> tuple[NDArray, NDArray]:
    """(closure [m], force and moment faults relative to the largest outer load) of one state.

    Lengths follow from the loads, X from the outer side; the inner side, both force balances, Fc
    and Mg are then checked. Balls without contact at rest are omitted.
    """
    psi = oracle.azimuths()
    a1, a2 = oracle.centres(state.displacement, psi)
    x, lost = _positions(oracle, state, a1, a2)
    held = state.status != "unloaded"
    speed = float(state.speed)
    residual = oracle.residual(x, a1, a2, speed)[:, held]
    ball = oracle.ball(x, a1, a2, speed)
    scale = max(float(np.max(state.outer_load)), 1.0)
    closure = residual[:2] * MICROMETRE
    forces = residual[2:] * 100.0 / scale
    inertia = [
        (ball["fc"] - state.centrifugal_force)[held] / scale,
        (ball["mg"] - state.gyroscopic_moment)[held] / (scale * oracle.d),
    ]
    inside = np.hypot(a1, a2 - x[1]) <= oracle.li + 1e-12
    assert inside[lost].all(), "a ball called lost still reaches the inner race"
    return closure, np.concatenate([forces, inertia])


def _positions(
    oracle: BallBearingOracle, state: Any, a1: NDArray, a2: NDArray
) -> tuple[NDArray, NDArray]:
    do = (state.outer_load / oracle.outer.k) ** (2 / 3)
    di = (state.inner_load / oracle.inner.k) ** (2 / 3)
    length = oracle.lo + do
    x1, x2 = length * np.sin(state.outer_angle), length * np.cos(state.outer_angle)
    lost = state.status == "lost contact"
    di = np.where(lost, np.hypot(a1 - x1, a2 - x2) - oracle.li, di)
    return np.array([x1, x2, di, do]), lost


def ring_fault(oracle: BallBearingOracle, state: Any) -> NDArray:
    """Load of the ring summed from the ball values of a state, minus the load it states."""
    ball = dict(
        qi=state.inner_load,
        qo=state.outer_load,
        ai=state.inner_angle,
        ao=state.outer_angle,
        mg=state.gyroscopic_moment,
        lam=_share(oracle, state),
    )
    ball = {key: np.where(state.inner_load > 0.0, value, 0.0) for key, value in ball.items()}
    return oracle.ring_load(ball, oracle.azimuths()) - state.load


def _share(oracle: BallBearingOracle, state: Any) -> NDArray:
    psi = oracle.azimuths()
    a1, a2 = oracle.centres(state.displacement, psi)
    x, _ = _positions(oracle, state, a1, a2)
    return oracle.ball(x, a1, a2, float(state.speed))["lam"]
