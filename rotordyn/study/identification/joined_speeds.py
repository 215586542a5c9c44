"""Merge the speeds of points of one curve, which scatter if each point has its own reading."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput

RPM = np.pi / 30.0
ALIKE, REST = 0.01, RPM  # distance up to which speeds are one: relative, or about rest


def joined(name: str, speed: Array) -> Array:
    """Replace nearly equal speeds (n,) of the measurement ``name`` by their mean.

    Raises
    ------
    InvalidInput : a chain of speeds that is too wide for one speed and too dense for several
    """
    merged = speed.copy()
    distinct = np.unique(speed)
    for group in np.split(distinct, np.flatnonzero(np.diff(distinct) > _near(distinct[1:])) + 1):
        if len(group) < 2:
            continue
        members = (speed >= group[0]) & (speed <= group[-1])
        mean = float(speed[members].mean())
        if np.abs(group - mean).max() > _near(mean):
            low, high = group[[0, -1]] / RPM
            raise InvalidInput(
                f"measurement {name}: speeds from {low:.6g} to {high:.6g} rpm are too far apart "
                "for one curve and too near for several: give each curve one speed"
            )
        merged[members] = mean
    return merged


def _near(speed: float | Array) -> Array:
    return np.maximum(ALIKE * np.asarray(speed), REST)
