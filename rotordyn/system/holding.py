"""What holds the shaft at rest: bearings, in series with their sleeves, and supports, side by side.

Connections are the bearings, then the supports, in order; each has the six freedoms of its node.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS, position
from rotordyn.elements.support import BEARING_FREEDOMS, node_matrix, support_matrices, turn
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.system.foundation import foundation

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
ZERO = 1e-9  # of the largest: below that a motion is not held


def rigid_motion(x: Array, front: float) -> Array:
    """Displacements (…, 6, 6) of stations ``x`` by those of the rigid shaft at ``front`` [m].

    Its transpose gathers loads at ``x`` to their resultant about ``front``.
    """
    lever = np.asarray(x) - front
    motion = np.zeros((*lever.shape, 6, 6))
    motion[...] = np.eye(6)
    motion[..., 1, 5] = lever
    motion[..., 2, 4] = -lever
    return motion


def length_scale(spindle: Spindle) -> Array:
    """What turns the six displacements of a node into lengths: the length of the shaft (6,)."""
    length = spindle.shaft.end - spindle.shaft.start
    return np.array([1.0, 1.0, 1.0, length, length, length])


def rigidly_held(spindle: Spindle) -> Flags:
    """Freedoms held without give (connections, 6)."""
    held = np.zeros((len(spindle.seats) + len(spindle.supports), 6), dtype=bool)
    for row, support in zip(held[len(spindle.seats) :], spindle.supports, strict=True):
        row[[position(freedom) for freedom in support.rigid]] = True
    return held


def held_stiffness(spindle: Spindle, seat_stiffness: Array, closed: Flags, speed: Array) -> Array:
    """Stiffness of everything but what is rigid (states, 6 × connections, 6 × connections).

    ``seat_stiffness`` (states, seats, 5, 5): tangents in the bearings' own frames; ``closed``
    (states, sleeves): stops that hold their sleeve; ``speed`` (states,) [rad/s]. Sleeves follow
    their springs along the axis and their radial stiffness across it; they do not tilt. Housings
    follow their own stiffness.
    """
    states, seats = len(seat_stiffness), len(spindle.seats)
    count = seats + len(spindle.supports)
    whole = np.zeros((states, count, 6, count, 6))
    for k, seat in enumerate(spindle.seats):
        whole[:, k, :, k] = turn(seat_stiffness[:, k], seat.thrust)
    for k, support in enumerate(spindle.supports, start=seats):
        whole[:, k, :, k] = support_matrices(support, "stiffness", speed)
    flat = whole.reshape(states, 6 * count, 6 * count)
    rows, own = _with_housings(spindle, *_sleeves(spindle, closed, 6 * count))
    inner = np.swapaxes(rows, 1, 2) @ flat @ rows + own
    return np.asarray(flat - flat @ rows @ np.linalg.solve(inner, np.swapaxes(rows, 1, 2) @ flat))


def _sleeves(spindle: Spindle, closed: Flags, size: int) -> tuple[Array, Array]:
    """Freedoms of sleeves by those of their bearings (states, size, k), and what holds them
    (states, k, k); one that a stop holds moves nothing."""
    parts = [
        (place, position(freedom), sleeve.bearings, stiff)
        for place, sleeve in enumerate(spindle.sleeves)
        for freedom, stiff in _springs(sleeve.spring.stiffness, sleeve.radial_stiffness)
        if math.isfinite(stiff)
    ]
    rows = np.zeros((len(closed), size, len(parts)))
    own = np.zeros((len(closed), len(parts), len(parts)))
    for column, (place, freedom, bearings, stiff) in enumerate(parts):
        carried = [k for k, seat in enumerate(spindle.seats) if seat.name in bearings]
        free = ~closed[:, place] if freedom == position("x") else np.full(len(closed), True)
        rows[:, [6 * k + freedom for k in carried], column] = free[:, None]
        own[:, column, column] = stiff
    return rows, own


def _with_housings(spindle: Spindle, rows: Array, own: Array) -> tuple[Array, Array]:
    """The same with the coordinates of housings behind those of the sleeves."""
    if not spindle.housings:
        return rows, own
    base, (states, size, k) = foundation(spindle), rows.shape
    under = np.broadcast_to(base.under.reshape(size, base.size), (states, size, base.size))
    whole = np.zeros((states, k + base.size, k + base.size))
    whole[:, :k, :k], whole[:, k:, k:] = own, base.stiffness
    return np.concatenate([rows, under], axis=2), whole


def _springs(axial: float, radial: float) -> tuple[tuple[str, float], ...]:
    return ("x", axial), ("y", radial), ("z", radial)


def free_motions(spindle: Spindle) -> Array:
    """Motions of the rigid shaft that nothing holds (6, k), orthonormal.

    They are those of the front end, in lengths (``length_scale``).
    """
    scale, front = length_scale(spindle), spindle.shaft.start
    rows = [np.zeros((6, 6))]
    for seat in spindle.seats:
        own = rigid_motion(np.array(seat.x), front)
        rows.append(own[[position(freedom) for freedom in BEARING_FREEDOMS]])
    for support in spindle.supports:
        own = rigid_motion(np.array(support.x), front)
        stiff = node_matrix(_largest(support)) / scale / scale[:, None]
        largest = np.abs(stiff).max()
        rows.append(own[[position(freedom) for freedom in support.rigid]])
        rows.append(stiff / largest @ (scale[:, None] * own) if largest > 0.0 else own[:0])
    _, size, ways = np.linalg.svd(np.concatenate(rows) / scale * scale[3])
    return np.asarray(ways[size <= ZERO * size[0]].T)


def _largest(support: LinearSupport) -> dict[tuple[str, str], float]:
    """The stiffness of a support, of a table the largest values: what it holds at some speed."""
    return {
        pair: max(value, key=abs) if isinstance(value, tuple) else value
        for pair, value in support.stiffness.items()
    }


def holds_twice(spindle: Spindle) -> bool:
    """True where rigid supports hold the shaft, taken as a rigid body, more often than they can."""
    scale, front = length_scale(spindle), spindle.shaft.start
    rows = [np.zeros((0, 6))]
    for support in spindle.supports:
        own = scale[:, None] * rigid_motion(np.array(support.x), front) / scale
        rows.append(own[[position(freedom) for freedom in support.rigid]])
    held = np.concatenate(rows)
    return bool(np.linalg.matrix_rank(held, tol=ZERO) < len(held)) if held.size else False


def free_names(motions: Array) -> str:
    """The freedoms that free motions move, as one names them."""
    moved = np.abs(motions).max(axis=1, initial=0.0) > ZERO
    return ", ".join(name for name, moves in zip(FREEDOMS, moved, strict=True) if moves)
