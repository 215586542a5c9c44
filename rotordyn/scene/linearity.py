"""Deviation of bearing loads from their tangents under the motions of linear analyses."""

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
from rotordyn.results.severity import Severity, of_severity

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

RING = [position(way) for way in BEARING_DIRECTIONS]
PHASES = np.exp(0.25j * np.pi * np.arange(8))  # of an orbit at which loads are compared
SEEN = 1e-4  # of the load in the preload state: smaller changes are not compared
REPORTED = 0.25  # of the load that the tangent adds
FAR = 0.1  # m: no machine moves so far
SMALL = 0.1  # rad: of such an inclination 1 − cos is half a percent, of the curvature 1.5 percent
LINEAR = Absence(
    "of supports, beside oil films, and without a steady motion", by=("speed", "support")
)


def ring_rows(scene: Scene, part: Linear) -> Array:
    """Return the rows (seats, 5, n) that give the displacement of the rings of every seat, inner
    against outer in the frame of the bearing, by the coordinates of a subsystem; zero for seats
    outside it."""
    seats, links = scene.spindle.seats, scene.rotor.seats
    motions = {id(connection.link): connection.motions for connection in part.connections}
    rows = np.zeros((len(seats), len(RING), part.size))
    for k, (seat, link) in enumerate(zip(seats, links, strict=True)):
        if id(link) in motions:
            turn = HALF_TURN_ABOUT_Y if seat.thrust < 0 else np.ones(len(RING))
            rows[k] = turn[:, None] * motions[id(link)][RING]
    return rows


def ring_displacements(scene: Scene, strained: Array) -> Array:
    """Return the displacement of rings, inner against outer in the frames of the bearings (usable,
    seats, 5), from that in the spindle's frame (usable, seats, 6)."""
    turns = [HALF_TURN_ABOUT_Y if seat.thrust < 0 else 1.0 for seat in scene.spindle.seats]
    return strained[..., RING] * np.array([np.broadcast_to(turn, len(RING)) for turn in turns])


def departure(scene: Scene, moved: Array | Complex) -> Array:
    """Return the relative deviation of every bearing's load at usable speeds (usable, seats): what
    its law adds to the preload state, against what its tangent adds, over the latter; infinite
    where a bearing is overloaded or has no equilibrium, or where one without load comes under load;
    NaN with oil films.

    ``moved`` (usable, seats, 5): displacement of the rings, or amplitude of a harmonic one.
    """
    from bearings.ring.request import solved

    seats, rows = scene.spindle.seats, scene.bearing_row[scene.usable]
    deviation = np.full((len(rows), len(seats)), np.nan)
    if scene.conditions.films is not None:
        return deviation
    phases = PHASES if np.iscomplexobj(moved) else np.ones(1)
    moved = np.where(np.isfinite(moved), moved, 0.0)  # of speeds without a steady motion
    turned = (moved[..., None, :] * phases[:, None]).real  # (usable, seats, phases, 5)
    for seat, (state, column) in enumerate(scene.preload.seat_states()):
        preload = state.rows(np.ix_(rows, [column]))
        displacement = preload.displacement[:, :, None] + turned[:, seat, None]
        solution = solved(preload.operation.at(displacement))
        radius = 0.5 * seats[seat].bearing.pitch_diameter
        lever = np.array([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])  # moments as forces at balls
        linear = turned[:, seat] @ np.swapaxes(scene.seat_stiffness[:, seat], -1, -2)
        size = np.linalg.norm(linear * lever, axis=-1)
        miss = np.linalg.norm((solution.load[:, 0] - preload.load - linear) * lever, axis=-1)
        least = SEEN * np.linalg.norm(preload.load * lever, axis=-1)
        share = np.where(size > least, miss / np.maximum(size, least + 1e-300), 0.0)  # never 0 / 0
        share = np.where((size == 0.0) & (miss > least), np.inf, share)  # of a bearing without load
        exists = np.asarray(solution.outcome[:, 0] == "")
        deviation[:, seat] = np.where(exists, share, np.inf).max(axis=-1)
    return deviation


@of_severity(Severity.INVALID)
def tangent_warnings(
    what: str, names: Sequence[str], speed: Array | None, apart: NDArray[np.floating]
) -> Iterator[str]:
    """Yield a warning where loads of bearings, by ``names``, deviate from those of their tangents
    in a result with ``apart`` (speeds, names), with the first such speed unless ``what`` says
    where."""
    worst = np.nan_to_num(apart, posinf=np.inf).max(axis=0, initial=0.0)
    reported = [
        f"{name} by {100.0 * share:.0f} %"
        if np.isfinite(share)
        else f"{name} is overloaded or has no equilibrium, or comes under load"
        for name, share in zip(names, worst, strict=True)
        if share > REPORTED
    ]
    if reported:
        where = ""
        if speed is not None:
            beyond = (np.nan_to_num(apart, posinf=np.inf) > REPORTED).any(axis=1)
            where = f", first at {number(float(speed[beyond.argmax()]) * RPM.factor, 0)} rpm"
        yield (
            f"{what}: bearings are displaced so far that their loads differ from the linearised "
            f"ones{where}: {', '.join(reported)}; results there are qualitative only: lower the "
            "loads, or use bearing_loads, stiffness or time_response, which have nonlinear bearings"
        )


@of_severity(Severity.INVALID)
def not_small(what: str, speed: Array, slope: NDArray[np.floating]) -> Iterator[str]:
    """Yield a warning where the inclination ``slope`` (speeds, …) [rad] of the shaft exceeds that
    of small deflections."""
    largest = np.nan_to_num(np.abs(slope)).reshape(len(speed), -1).max(axis=1, initial=0.0)
    row = int(largest.argmax())
    if largest[row] > SMALL:
        yield (
            f"{what}: the shaft is inclined by up to {np.degrees(largest[row]):.3g}° at "
            f"{number(float(speed[row]) * RPM.factor, 0)} rpm, beyond small deflections; results "
            "there are qualitative only: lower the loads (or an axial force near buckling), or "
            "support the shaft more closely"
        )
