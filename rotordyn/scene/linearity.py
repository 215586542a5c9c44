"""How far loads of bearings are from those of their tangents, where linear analyses move them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Complex
from rotordyn.equation.dofs import position
from rotordyn.equation.linear import Linear
from rotordyn.equation.seat import BEARING_DIRECTIONS, HALF_TURN_ABOUT_Y
from rotordyn.results.declaration import Absence
from rotordyn.results.display import RPM, number

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

RING = [position(way) for way in BEARING_DIRECTIONS]
PHASES = np.exp(0.25j * np.pi * np.arange(8))  # of an orbit at which loads are compared
SEEN = 1e-4  # of the load in the preload state: a smaller one beside it is not compared
TOLD = 0.25  # of the load that the tangent adds
FAR = 0.1  # m: no machine moves so far
SMALL = 0.1  # rad: of such an inclination 1 − cos is half a percent, of the curvature 1.5 percent
LINEAR = Absence(
    "of supports, beside oil films, and without a steady motion", by=("speed", "support")
)


def ring_rows(scene: Scene, part: Linear) -> Array:
    """Displacement of the rings of every seat, inner against outer in the frame of the bearing, by
    the coordinates of a subsystem (seats, 5, n); zero of what is not in it."""
    seats, links = scene.spindle.seats, scene.rotor.seats
    motions = {id(each.link): each.motions for each in part.connections}
    rows = np.zeros((len(seats), len(RING), part.size))
    for k, (seat, link) in enumerate(zip(seats, links, strict=True)):
        if id(link) in motions:
            turn = HALF_TURN_ABOUT_Y if seat.thrust < 0 else np.ones(len(RING))
            rows[k] = turn[:, None] * motions[id(link)][RING]
    return rows


def moved_by(scene: Scene, load: Array) -> Array:
    """Displacement of rings (usable, seats, 5) under loads by tangents, which have the components
    of forces and moments on them in the spindle's frame (usable, seats, 6)."""
    turns = [HALF_TURN_ABOUT_Y if seat.thrust < 0 else 1.0 for seat in scene.spindle.seats]
    own = load[..., RING] * np.array([np.broadcast_to(turn, len(RING)) for turn in turns])
    inverse = np.linalg.pinv(scene.seat_stiffness, rcond=1e-12)
    return np.asarray((inverse @ own[..., None])[..., 0])


def departure(scene: Scene, moved: Array | Complex) -> Array:
    """Of the load of every bearing at usable speeds (usable, seats): how far what its law adds to
    the preload state differs from what its tangent adds, over the latter; infinite where no state
    is left, NaN beside oil films.

    ``moved`` (usable, seats, 5): displacement of the rings, or amplitude of a harmonic one.
    """
    from bearings.ring.request import solved

    seats, rows = scene.spindle.seats, scene.bearing_row[scene.usable]
    apart = np.full((len(rows), len(seats)), np.nan)
    if scene.conditions.films is not None:
        return apart
    phases = PHASES if np.iscomplexobj(moved) else np.ones(1)
    moved = np.where(np.isfinite(moved), moved, 0.0)  # of speeds without a steady motion
    turned = (moved[..., None, :] * phases[:, None]).real  # (usable, seats, phases, 5)
    for seat, (state, column) in enumerate(scene.preload.seat_states()):
        still = state.rows(np.ix_(rows, [column]))
        there = still.displacement[:, :, None] + turned[:, seat, None]
        found = solved(still.operation.at(there))
        radius = 0.5 * seats[seat].bearing.pitch_diameter
        lever = np.array([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])
        linear = turned[:, seat] @ np.swapaxes(scene.seat_stiffness[:, seat], -1, -2)
        size = np.linalg.norm(linear * lever, axis=-1)
        miss = np.linalg.norm((found.load[:, 0] - still.load - linear) * lever, axis=-1)
        least = SEEN * np.linalg.norm(still.load * lever, axis=-1)
        share = np.where(size > least, miss / np.maximum(size, least + 1e-300), 0.0)
        share = np.where((size == 0.0) & (miss > least), np.inf, share)  # of a bearing without load
        lost = np.asarray(found.outcome[:, 0] == "overloaded")
        apart[:, seat] = np.where(lost, np.inf, share).max(axis=-1)
    return apart


def beyond_tangents(
    what: str, names: Sequence[str], speed: Array | None, apart: NDArray[np.floating]
) -> Iterator[str]:
    """A warning where loads of bearings, by ``names``, depart from those of their tangents, of a
    result with ``apart`` (speeds, names), and the first speed, unless ``what`` says where."""
    worst = np.nan_to_num(apart, posinf=np.inf).max(axis=0, initial=0.0)
    told = [
        f"{name} by {100.0 * share:.0f} %" if np.isfinite(share) else f"{name} loses any state"
        for name, share in zip(names, worst, strict=True)
        if share > TOLD
    ]
    if told:
        where = ""
        if speed is not None:
            beyond = (np.nan_to_num(apart, posinf=np.inf) > TOLD).any(axis=1)
            where = f", first at {number(float(speed[beyond.argmax()]) * RPM.factor, 0)} rpm"
        yield (
            f"{what}: bearings are moved so far that their loads depart from those of their "
            f"tangents{where}: {', '.join(told)}; "
            "results there are right in kind only, not in size: lower the loads, or see "
            "bearing_loads, stiffness or time_response, which follow the law of the bearings"
        )


def not_small(what: str, speed: Array, slope: NDArray[np.floating]) -> Iterator[str]:
    """A warning where the shaft is inclined by more than small deflections are, of a result with
    ``slope`` (speeds, …) [rad]."""
    most = np.nan_to_num(np.abs(slope)).reshape(len(speed), -1).max(axis=1, initial=0.0)
    row = int(most.argmax())
    if most[row] > SMALL:
        yield (
            f"{what}: the shaft is inclined by up to {np.degrees(most[row]):.3g}° at "
            f"{number(float(speed[row]) * RPM.factor, 0)} rpm, where only small deflections are "
            "meant: results there are right in kind only, not in size: lower the loads, an axial "
            "force near buckling among them, or hold the shaft closer"
        )
