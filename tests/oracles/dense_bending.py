"""Bending of a rotor on linear supports with every freedom of its elements, by one dense solve."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigvals, solve

from rotordyn.model.support import node_matrix
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import filled
from tests.oracles.dense_rotor.assemble import loaded_plane
from tests.oracles.dense_rotor.selection import BOTH_PLANES
from rotordyn.system.hierarchic_rotor import bending_hierarchy, deflections, rigid_motions

Complex = NDArray[np.complex128]


def dense_poles(spindle: Spindle, spin: float, highest: float, accuracy: float) -> Complex:
    """All poles [rad/s] that swing, by size; elements good to ``accuracy`` up to ``highest`` [Hz].

    No reduction; the planes side by side. Motions are counted from that of the first node, so that
    rounding of stiff pieces does not hold a rigid one, and the inverse problem, 1/λ, is solved:
    both keep the digits of slow modes.
    """
    elements = bending_hierarchy(spindle, 2.0 * math.pi * highest, spin, accuracy)
    plane = loaded_plane(spindle, elements)
    turn = np.eye(elements.size)
    turn[:, :2] = rigid_motions(elements)
    turn[:, 1] -= turn[0, 1] * turn[:, 0]
    own, polar = (turn.T @ filled(m) @ turn for m in (plane.mass, plane.polar))
    elastic, zero = filled(plane.stiffness).copy(), np.zeros_like(own)
    elastic[:2], elastic[:, :2] = 0.0, 0.0
    mass, stiffness = (np.block([[m, zero], [zero, m]]) for m in (own, elastic))
    damping = spin * np.block([[zero, polar], [-polar, zero]])
    for support in spindle.supports:
        seen = filled(deflections(spindle, elements, np.array([support.x]))) @ turn
        rows = np.block([[seen, 0.0 * seen], [0.0 * seen, seen]])
        stiffness = stiffness + rows.T @ BOTH_PLANES.take(node_matrix(support.stiffness)) @ rows
        damping = damping + rows.T @ BOTH_PLANES.take(node_matrix(support.damping)) @ rows
    size = len(mass)
    damped, moved = np.split(solve(stiffness, np.concatenate([damping, mass], axis=1)), 2, axis=1)
    scale = math.sqrt(np.abs(moved).max())
    whole = np.block([[-damped, -moved / scale], [scale * np.eye(size), np.zeros((size, size))]])
    inverse = eigvals(whole)
    found = 1.0 / inverse[inverse != 0.0]
    found = found[found.imag > 0.0]
    return found[np.argsort(np.abs(found))]
