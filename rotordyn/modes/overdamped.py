"""Overdamped motions, which hardly oscillate."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Flags

ROUNDING = 1e-6  # of a damping ratio
OVERDAMPED = 0.99  # damping ratio above which a motion hardly oscillates


def is_overdamped(damping_ratio: Array) -> Flags:
    """Return which motions (modes,) have a damping ratio (speeds, modes) above ``OVERDAMPED`` at
    most of the speeds at which they exist; it is NaN where they do not."""
    present = np.isfinite(damping_ratio).sum(axis=0)
    overdamped = (damping_ratio > OVERDAMPED).sum(axis=0)
    return np.asarray((2 * overdamped > present) | (present == 0))
