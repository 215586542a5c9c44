"""Reactions of bearings and supports to static loads, by the force method.

Unknown are the reactions r and the motion q of the shaft's front end. With F the flexibility of the
shaft held at its front end, u0 its displacements by the loads then, B its rigid motion and K the
stiffness of the supports, displacements at these are u = u0 + F r + B q, and

    r + K u = 0 (elastic),   u = 0 (rigid),   Bᵀ r = −(resultant of the loads).

Reactions that equilibrium alone determines thus come from the last line, whatever F and K are; a
free direction has its motion at the front end set to zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.errors import InvalidInput

WORST_CONDITION = 1e13  # number above which reactions are lost in rounding


@dataclass(frozen=True, eq=False, slots=True)
class Held:
    """A shaft on its connections, n = 6 × connections.

    ``stiffness`` (states, n, n), ``rigid`` (n,), ``motion`` B (n, 6), ``flexibility`` F (n, n),
    ``free`` (6, k): free motions, in lengths; ``scale`` (6,): from displacements to lengths.
    """

    stiffness: Array
    rigid: Flags
    motion: Array
    flexibility: Array
    free: Array
    scale: Array


def reactions(held: Held, loose: Array, resultant: Array) -> tuple[Array, Array]:
    """Return loads of connections on the shaft (states, n) and motion of its front end (states, 6).

    ``loose`` (states, n): displacements by the loads with the front end held; ``resultant``
    (states, 6): of the loads, about the front end; free motions take no part in it.

    Raises
    ------
    InvalidInput : equilibrium and elasticity do not determine the reactions
    """
    n, states, free = len(held.rigid), len(loose), held.free.shape[1]
    to_length = np.tile(held.scale, n // 6)
    flexibility = to_length[:, None] * held.flexibility * to_length
    motion = to_length[:, None] * held.motion / held.scale
    stiffness = held.stiffness / to_length[:, None] / to_length
    compliance = _largest(flexibility) or 1.0 / (_largest(stiffness) or 1.0)
    elastic = ~held.rigid
    matrix = np.zeros((states, n + 6 + free, n + 6 + free))
    resistance = np.where(held.rigid[:, None], np.eye(n) / compliance, stiffness)
    matrix[:, :n, :n] = np.diag(elastic.astype(float)) + resistance @ flexibility
    matrix[:, :n, n : n + 6] = resistance @ motion * compliance
    matrix[:, n : n + 6, :n] = motion.T
    matrix[:, n : n + 6, n + 6 :] = held.free
    matrix[:, n + 6 :, n : n + 6] = held.free.T
    right = np.zeros((states, n + 6 + free, 1))
    right[:, :n] = -resistance @ (to_length * loose)[..., None]
    right[:, n : n + 6, 0] = -resultant / held.scale
    solution = _solved(matrix, right)[..., 0]
    return solution[:, :n] * to_length, solution[:, n : n + 6] * compliance / held.scale


def _solved(matrix: Array, right: Array) -> Array:
    """Return the solution with rows of equal size, refined once."""
    size = np.abs(matrix).max(axis=2, keepdims=True)
    matrix, right = matrix / size, right / size
    if (np.linalg.cond(matrix) > WORST_CONDITION).any():
        raise InvalidInput(
            "the reactions are not determined: the shaft has more rigid supports than its "
            "elasticity can distinguish, or supports are so much softer or stiffer than the shaft "
            "that rounding errors dominate; leave one out, or give it another stiffness"
        )
    solution = np.linalg.solve(matrix, right)
    return np.asarray(solution + np.linalg.solve(matrix, right - matrix @ solution))


def _largest(values: Array) -> float:
    return float(np.abs(values).max(initial=0.0))
