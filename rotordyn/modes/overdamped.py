"""Motions that hardly swing."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Flags

ROUNDING = 1e-6  # of a damping ratio
OVERDAMPED = 0.99  # damping ratio above which a motion hardly swings


def is_overdamped(damping_ratio: Array) -> Flags:
    """Which motions (modes,) hardly swing at most of the speeds (speeds, modes) at which they are
    there, NaN where they are not: those of a damping ratio above ``OVERDAMPED``."""
    known = np.isfinite(damping_ratio).sum(axis=0)
    crept = (damping_ratio > OVERDAMPED).sum(axis=0)
    return np.asarray((2 * crept > known) | (known == 0))
