"""The orbit of a point of the axis over one period, and its direction."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.surface.motion import at_phase

FLAT = 1e-6  # share of the two circular parts by which an orbit must differ from a line


def phases(count: int) -> Array:
    """Return ``count`` evenly spaced phases of one period [rad]."""
    return np.asarray(2.0 * np.pi * np.arange(count) / count)


def orbit(motion: Complex, count: int) -> Array:
    """Return displacements (count, 3) of a point over a period, from complex ones (3,) or (6,)."""
    return np.stack([at_phase(motion[:3], phase) for phase in phases(count)])


def turning(motion: Complex) -> int:
    """Return +1 forward (from y to z, counter-clockwise seen from +x), −1 backward, 0 along a line.

    The circular parts of y, z turn with amplitudes |y + i z| / 2 and |y − i z| / 2, forward being
    y = 1, z = −i.
    """
    y, z = motion[1], motion[2]
    forward, backward = abs(y + 1j * z) ** 2, abs(y - 1j * z) ** 2
    difference = forward - backward
    return 0 if abs(difference) <= FLAT * (forward + backward) else int(np.sign(difference))
