"""Motions of a rigid shaft that its bearings and supports leave free, and loads along these.

Theory: docs/theory/statics.md#equilibrium.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.equation.seat import BEARING_DIRECTIONS
from rotordyn.equation.support import node_matrix
from rotordyn.errors import InvalidInput
from rotordyn.machine.plausibility import SOFT
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.numerics.groups import first_joined

ZERO = 1e-9  # of the largest: a motion with less is free
BALANCED = 1e-6  # of all loads along a free motion
ROUNDING = 1e-12  # of all loads


def rigid_motion(x: Array, front: float) -> Array:
    """Return displacements (…, 6, 6) of stations ``x`` by those of a rigid shaft at ``front`` [m].

    Its transpose gathers loads at ``x`` to their resultant about ``front``.
    """
    lever = np.asarray(x) - front
    motion = np.zeros((*lever.shape, 6, 6))
    motion[...] = np.eye(6)
    motion[..., 1, 5] = lever
    motion[..., 2, 4] = -lever
    return motion


def length_scale(spindle: Spindle) -> Array:
    """Return factors from the six displacements of a node to lengths: the shaft's length (6,)."""
    length = spindle.shaft.end - spindle.shaft.start
    return np.array([1.0, 1.0, 1.0, length, length, length])


def unrestrained_motions(spindle: Spindle) -> Array:
    """Return the free motions of the rigid shaft (6, k), orthonormal.

    They are motions of the front end, in lengths (``length_scale``).
    """
    scale, front = length_scale(spindle), spindle.shaft.start
    rows = [np.zeros((6, 6))]
    for seat in spindle.seats:
        motion = rigid_motion(np.array(seat.x), front)
        rows.append(motion[[position(direction) for direction in BEARING_DIRECTIONS]])
    for support in spindle.supports:
        motion = rigid_motion(np.array(support.x), front)
        stiff = node_matrix(_largest(support)) / scale / scale[:, None]
        rows.append(motion[[position(direction) for direction in support.rigid]])
        rows.append(_relative(stiff) @ (scale[:, None] * motion))
    _, size, directions = np.linalg.svd(np.concatenate(rows) / scale * scale[3])
    return np.asarray(directions[size <= ZERO * size[0]].T)


def _relative(stiff: Array) -> Array:
    """Return a stiffness (6, 6) over the largest entry of the directions that it couples: a spring
    without coupling holds as well beside a far stiffer one, unless it is meant as none."""
    first, size = first_joined(stiff != 0.0), np.abs(stiff)
    largest = np.array([size[first == each].max() for each in first])
    largest = np.where(largest < SOFT[0], size.max(), largest)
    return stiff / np.where(largest > 0.0, largest, 1.0)[:, None]


def _largest(support: LinearSupport) -> dict[tuple[str, str], float]:
    """Return the stiffness of a support, the largest of a table: what it holds at some speed."""
    return {
        pair: max(value, key=abs) if isinstance(value, tuple) else value
        for pair, value in support.stiffness.items()
    }


def has_redundant_supports(spindle: Spindle) -> bool:
    """True if rigid supports are redundant for the shaft as a rigid body."""
    scale, front = length_scale(spindle), spindle.shaft.start
    rows = [np.zeros((0, 6))]
    for support in spindle.supports:
        motion = scale[:, None] * rigid_motion(np.array(support.x), front) / scale
        rows.append(motion[[position(direction) for direction in support.rigid]])
    held = np.concatenate(rows)
    return bool(np.linalg.matrix_rank(held, tol=ZERO) < len(held)) if held.size else False


def on_nodes(point: Array, line: Array, x: Array) -> Array:
    """Add line loads to point loads (…, nodes, 6), with the same resultant at the element ends."""
    front, rear = np.moveaxis(line, 1, 0)
    length, loads = np.diff(x)[:, None], point.copy()
    loads[..., :-1, :3] += (2.0 * front + rear) * length / 6.0
    loads[..., 1:, :3] += (front + 2.0 * rear) * length / 6.0
    return loads


def require_balance(spindle: Spindle, x: Array, loads: Sequence[Array]) -> Array:
    """Return the combinations of displacements of the front end that nothing holds (k, 6), along
    which each of ``loads`` (nodes, 6) on nodes at ``x`` [m] must balance.

    Raises
    ------
    InvalidInput : they do not: the shaft is a free body
    """
    free, scale = unrestrained_motions(spindle), length_scale(spindle)
    motion = rigid_motion(x, float(x[0])) / scale
    for load in loads if free.size else ():
        work = np.einsum("nij,ni,jk->nik", motion, load, free, optimize=True)
        imbalance, size = work.sum(axis=(0, 1)), np.abs(work).sum(axis=(0, 1))
        unbalanced = np.abs(imbalance) > BALANCED * size + ROUNDING * np.abs(load / scale).sum()
        if unbalanced.any():
            raise InvalidInput(_free_body(free[:, unbalanced] @ imbalance[unbalanced], scale))
    return np.asarray(free.T * scale)


def free_names(motions: Array) -> str:
    """Return the names of the directions in which free motions (6, k) move."""
    moving = np.abs(motions).max(axis=1, initial=0.0) > ZERO
    return ", ".join(name for name, moves in zip(DIRECTIONS, moving, strict=True) if moves)


def _free_body(imbalance: Array, scale: Array) -> str:
    names = free_names(imbalance[:, None] / np.abs(imbalance).max())
    force, moment = np.abs(imbalance[:3]).max(), np.abs(imbalance * scale)[3:].max()
    amount = f"{moment:.6g} N m" if names.startswith("th") else f"{force:.6g} N"
    return (
        f"free body in a static case: {names} unrestrained, with loads out of balance by {amount}; "
        "balance them, or restrain the body by a support"
    )
