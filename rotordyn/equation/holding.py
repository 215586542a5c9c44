"""Connections that hold a shaft at rest: bearings on their sleeves and housings, and supports.

Connections are the bearings, then the supports, in order; each has the six directions of its node.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.equation.assemble import assemble
from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.equation.seat import BEARING_DIRECTIONS
from rotordyn.equation.structure import Structure
from rotordyn.equation.support import node_matrix
from rotordyn.equation.term import State
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport

ZERO = 1e-9  # of the largest: a motion with less is free


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


def rigidly_held(spindle: Spindle) -> Flags:
    """Return which directions are held rigidly (connections, 6); dampers hold none."""
    held = np.zeros((len(spindle.connections), 6), dtype=bool)
    for row, support in zip(held[len(spindle.seats) :], spindle.supports, strict=False):
        row[[position(direction) for direction in support.rigid]] = True
    return held


def held_stiffness(structure: Structure, state: State) -> Array:
    """Return the stiffness of all that is not rigid (s, 6 × connections, 6 × connections).

    Sleeves and housings are condensed, in series; sleeves do not tilt.
    """
    state = state._replace(standing=True)
    links, states = structure.connections, len(state.speed)
    blocks = np.zeros((states, len(links), 6, len(links), 6))
    for k, link in enumerate(links):
        blocks[:, k, :, k] = link.matrices(state).stiffness
    flat = blocks.reshape(states, 6 * len(links), 6 * len(links))
    bodies = [component for component in structure.components if component.spindle is None]
    if not bodies:
        return flat
    linear = assemble(structure, bodies, state)
    motions = [link.motions @ linear.moved(link.dofs) for link in links]
    rows = np.concatenate([np.zeros((0, linear.size)), *motions])
    return np.asarray(flat - flat @ rows @ np.linalg.solve(linear.stiffness, rows.T @ flat))


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
        largest = np.abs(stiff).max()
        rows.append(motion[[position(direction) for direction in support.rigid]])
        rows.append(stiff / largest @ (scale[:, None] * motion) if largest > 0.0 else motion[:0])
    _, size, directions = np.linalg.svd(np.concatenate(rows) / scale * scale[3])
    return np.asarray(directions[size <= ZERO * size[0]].T)


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


def free_names(motions: Array) -> str:
    """Return the names of the directions in which free motions move."""
    moving = np.abs(motions).max(axis=1, initial=0.0) > ZERO
    return ", ".join(name for name, moves in zip(DIRECTIONS, moving, strict=True) if moves)
