"""Circular parts of motion across the axis: forward y + i z and backward y − i z.

A tilt goes with each: θz − i θy forward, θz + i θy backward. Where supports answer alike in all
directions only the forward part is needed, its sign of ω being the direction of whirl.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.oracles.dense_rotor.selection import Selection

Complex = NDArray[np.complex128]
PLANES = Selection(("y", "thz", "z", "thy"), (1, 1, 1, -1))
TURNING = np.array([[1.0, 1.0j], [1.0, -1.0j]])  # from (y, z)
_WITH_TILTS = np.kron(TURNING, np.eye(2))


def load(direction: str, planes: int) -> Complex:
    """A unit force or moment in circular parts (2·planes,); of one plane, that of plane y."""
    place, sign = PLANES.names.index(direction), PLANES.sign(direction)
    return sign * (_in_plane(place) if planes == 1 else _WITH_TILTS[:, place])


def response(direction: str, planes: int) -> Complex:
    """What takes a displacement from its circular parts (2·planes,); of one plane, as in y."""
    place, sign = PLANES.names.index(direction), PLANES.sign(direction)
    return sign * (_in_plane(place) if planes == 1 else np.linalg.inv(_WITH_TILTS)[place])


def _in_plane(place: int) -> Complex:
    return np.eye(2, dtype=complex)[place % 2]
