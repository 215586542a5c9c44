"""Loads, angles, pressures and stiffness of every bearing at its dynamic preload state."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.arrays import Array, Indices
from rotordyn.errors import InvalidInput
from rotordyn.preload.arrangement import SHAFT, rigid
from rotordyn.preload.mounting import ring_offset
from rotordyn.preload.state import PreloadState
from rotordyn.results.balls import BALL_QUANTITIES, DOFS
from rotordyn.results.display import RPM
from rotordyn.scene.scene import Scene


def solve(scene: Scene, spec: PreloadSpec) -> PreloadResult:
    """The preload state over speeds and bearings; of the balls, that of the largest load."""
    state, rows, solved_only = scene.preload, scene.bearing_row, scene.solved_only
    solved = np.array([word == "" for word in scene.outcome])

    seats = state.seat_states()
    heaviest = [_heaviest(s, column) for s, column in seats]

    def of_heaviest(name: str) -> NDArray[Any]:
        return np.stack(
            [getattr(s, name)[:, c][at] for (s, c), at in zip(seats, heaviest, strict=True)], axis=1
        )

    balls = {name: solved_only(of_heaviest(name)) for name in BALL_QUANTITIES}
    slips = of_heaviest("slipping")[rows]
    pitch = np.array([seat.bearing.pitch_diameter for seat in scene.spindle.seats])
    factor = np.outer(scene.speed * RPM.factor, pitch * 1e3)
    return PreloadResult(
        speed=scene.speed,
        bearing=tuple(seat.name for seat in scene.spindle.seats),
        sleeve=tuple(sleeve.name for sleeve in scene.spindle.sleeves),
        body=state.network.arrangement.bodies,
        dof=DOFS,
        dof_other=DOFS,
        outcome=scene.outcome,
        axial_load=solved_only(state.seat_load()),
        mounted_load=state.mounted_load(),
        mounted_preload=np.array([p.preload for p in state.network.arrangement.pushes]),
        ring_offset=np.array([_offset(state, k) for k in range(len(state.spindle.sleeves))]),
        deflection=solved_only(np.stack([s.displacement[:, c, 0] for s, c in seats], axis=1)),
        stiffness=solved_only(state.seat_stiffness()),
        slipping=np.where(solved[:, None], slips, ""),
        growth=solved_only(state.seat_growth()),
        film_growth=solved_only(_film_growth(state)),
        speed_factor=factor,
        position=solved_only(state.shift),
        spring_force=solved_only(state.spring_force),
        stop_force=solved_only(state.stop_force),
        friction_force=solved_only(state.friction_force),
        friction_limit=state.rubs[SHAFT + 1 :],
        stop_reached=state.stopped[rows] & solved[:, None],
        stop_speed=scene.stop_speeds,
        **balls,
    )


def _heaviest(state: BearingState, column: int) -> tuple[Indices, Indices]:
    """Indices, into values (speeds, balls) of a bearing, of the ball with the largest load on its
    inner race (speeds,); without transverse loads all balls are equal."""
    ball = np.nan_to_num(state.inner_load[:, column]).argmax(axis=1)
    return np.arange(len(ball)), ball


def _film_growth(state: PreloadState) -> Array:
    """Part of the ring growth that represents oil films (speeds, seats) [m]."""
    if state.films is None:
        return np.zeros((len(state.speed), len(state.spindle.seats)))
    return state.films.at(state.speed)[0]


def _offset(state: PreloadState, k: int) -> float:
    """Axial offset of the free rings of a locked set [m]; NaN for a sprung sleeve, and where
    nothing in the housing faces its bearings."""
    sleeve, push = state.spindle.sleeves[k], state.network.arrangement.pushes[k]
    if not rigid(push):
        return math.nan
    try:
        return ring_offset(state.spindle, sleeve, push.preload)
    except InvalidInput:
        return math.nan
