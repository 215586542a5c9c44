"""Speeds of one curve that were measured point by point, and so scatter, taken as one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput

Array = NDArray[np.float64]
RPM = np.pi / 30.0
ALIKE, REST = 0.01, RPM  # of a speed, or about rest: those nearer to one another are one


def joined(name: str, speed: Array) -> Array:
    """Speeds (n,) of points of the measurement ``name``, those alike at their mean.

    Raises
    ------
    InvalidInput : speeds that go over into one another, neither one nor several
    """
    found = speed.copy()
    every = np.unique(speed)
    for group in np.split(every, np.flatnonzero(np.diff(every) > _near(every[1:])) + 1):
        if len(group) < 2:
            continue
        here = (speed >= group[0]) & (speed <= group[-1])
        mean = float(speed[here].mean())
        if np.abs(group - mean).max() > _near(mean):
            low, high = group[[0, -1]] / RPM
            raise InvalidInput(
                f"measurement {name}: speeds from {low:.6g} to {high:.6g} rpm are too far apart "
                "for one curve and too near for several: give each curve one speed"
            )
        found[here] = mean
    return found


def _near(speed: float | Array) -> Array:
    return np.maximum(ALIKE * np.asarray(speed), REST)
