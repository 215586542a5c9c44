"""Displacements between nodes: static shape functions in bending, linear along the axis."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.dofs import position

_PLANES = (("y", "thz", 1.0), ("z", "thy", -1.0))  # deflection, tilt, sign of the tilt


def between_nodes(node: Array, motion: Complex, phi: Array, x: Array) -> Complex:
    """Interpolate the six displacements at stations ``x``, shape (len(x), 6); constant beyond ends.

    ``node``: stations (nodes,) [m], ascending; ``motion`` (nodes, 6): their displacements;
    ``phi`` (nodes − 1,): shear parameter of each element (``beam.shear_parameter``).
    In bending these are the shapes of constant shear force (Nelson 1980, J. Mech. Des. 102, 793).
    """
    inside = np.clip(x, node[0], node[-1])
    left = np.clip(np.searchsorted(node, inside, side="right") - 1, 0, len(node) - 2)
    length = np.diff(node)[left]
    s = (inside - node[left]) / length
    front, rear = motion[left], motion[left + 1]
    between = front * (1.0 - s)[:, None] + rear * s[:, None]
    for deflection, tilt, sign in _PLANES:
        v, t = position(deflection), position(tilt)
        ends = (front[:, v], sign * front[:, t], rear[:, v], sign * rear[:, t])
        between[:, v], slope = _bending(s, length, phi[left], ends)
        between[:, t] = sign * slope
    return between


def _bending(
    s: Array, length: Array, phi: Array, ends: tuple[Complex, Complex, Complex, Complex]
) -> tuple[Complex, Complex]:
    """Return deflection and rotation at ``s`` = 0 … 1 from those of the ends (v1, φ1, v2, φ2)."""
    v1, t1, v2, t2 = ends
    chord = (v2 - v1) / length
    first, second = t1 - chord, t2 - chord  # rotations of the ends against the chord
    bow = s * (1.0 - s)
    shear = phi / (2.0 * (1.0 + phi))
    arc = (1.0 - s - shear * (1.0 - 2.0 * s), s - shear * (2.0 * s - 1.0))
    deflection = v1 + (v2 - v1) * s + length * bow * (first * arc[0] - second * arc[1])
    relative = first * (1.0 - s) + second * s - 3.0 * bow * (first + second) / (1.0 + phi)
    return deflection, chord + relative
