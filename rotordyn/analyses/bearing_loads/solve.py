"""Loads of every bearing and every ball at every speed, and where balls lose contact."""

from __future__ import annotations

import math

import numpy as np

from bearings import ring_deflection
from rotordyn.analyses.bearing_loads.result import BearingLoadsResult
from rotordyn.analyses.bearing_loads.spec import BearingLoadsSpec
from rotordyn.arrays import Array, Indices
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.scene.scene import Scene

OF_BALLS = ("inner_load", "outer_load", "inner_angle", "outer_angle")


def solve(scene: Scene, spec: BearingLoadsSpec) -> BearingLoadsResult:
    """Solve loads on the inner rings, in the directions of the spindle, and loads of the balls."""
    seats, states = scene.spindle.seats, scene.preload.seat_states()
    shown, most_balls = scene.solved_only, max(seat.bearing.balls for seat in seats)

    load, shift = np.zeros((2, len(scene.preload.speed), len(seats), 5))
    azimuth = np.full((len(seats), most_balls), np.nan)
    deflections = np.full((2, *load.shape[:2], most_balls), np.nan)
    balls = {name: np.full((*load.shape[:2], most_balls), np.nan) for name in OF_BALLS}
    for k, (seat, (state, column)) in enumerate(zip(seats, states, strict=True)):
        turn = HALF_TURN_ABOUT_Y if seat.thrust < 0 else 1.0  # from the frame of the bearing
        load[:, k], shift[:, k] = state.load[:, column] * turn, state.displacement[:, column] * turn
        count = seat.bearing.balls
        angle = seat.thrust * 2.0 * math.pi * np.arange(count) / count
        azimuth[k, :count] = np.mod(angle, 2.0 * math.pi)
        for name, values_ in balls.items():
            values_[:, k, :count] = getattr(state, name)[:, column]
        deformed = ring_deflection(state.rows((slice(None), column)))
        deflections[0][:, k, :count], deflections[1][:, k, :count] = deformed.inner, deformed.outer
    share, ball = _losses(scene, spec, balls["inner_load"])
    angles = np.take_along_axis(azimuth[None].repeat(len(ball), 0), ball[..., None], axis=2)[..., 0]
    return BearingLoadsResult(
        speed=scene.speed,
        bearing=tuple(seat.name for seat in seats),
        ball=np.arange(1.0, most_balls + 1.0),
        outcome=scene.outcome,
        axial_load=shown(load[..., 0]),
        radial_load=shown(np.hypot(load[..., 1], load[..., 2])),
        load_angle=shown(np.arctan2(load[..., 2], load[..., 1])),
        moment=shown(np.hypot(load[..., 3], load[..., 4])),
        deflection=shown(shift[..., 0]),
        radial_displacement=shown(np.hypot(shift[..., 1], shift[..., 2])),
        tilt=shown(np.hypot(shift[..., 3], shift[..., 4])),
        loaded_balls=shown((balls["inner_load"] > 0.0).sum(axis=2)),
        loss_share=shown(share),
        loss_azimuth=shown(np.where(np.isnan(share), np.nan, angles)),
        ball_azimuth=azimuth,
        inner_ring_deflection=shown(deflections[0]),
        outer_ring_deflection=shown(deflections[1]),
        **{f"ball_{name}": shown(values) for name, values in balls.items()},
    )


def _losses(scene: Scene, spec: BearingLoadsSpec, inner: Array) -> tuple[Array, Indices]:
    """Return the share of loads at which a bearing's first ball loses contact, and that ball."""
    share, ball = np.full(inner.shape[:2], np.nan), np.zeros(inner.shape[:2], dtype=np.intp)
    # states with every ball loaded under the full loads need not be followed up to them
    unloaded = (np.nan_to_num(inner, nan=np.inf).min(axis=2) <= 0.0).any(axis=1)
    rows = np.flatnonzero(unloaded & scene.preload.usable & scene.unloaded.net.converged)
    if not (scene.loaded and spec.loss_steps and rows.size):
        return share, ball
    from rotordyn.preload.under_load import contact_loss

    loss = contact_loss(scene.unloaded, *scene.static_rotor, rows, spec.loss_steps)
    share[rows], ball[rows] = loss.share, np.maximum(loss.ball, 0)
    return share, ball
