"""What can go wrong with one rolling bearing.

BearingError
├── InvalidBearing        the description itself is impossible (also a ValueError)
└── NoEquilibrium         the description is fine, but no physical state exists
"""

from __future__ import annotations


class BearingError(Exception):
    """Root of every error raised on purpose by ``bearings``."""


class InvalidBearing(BearingError, ValueError):
    """The description or the call is impossible: geometry, material, shapes, non-finite numbers."""


class NoEquilibrium(BearingError):
    """No physical state exists for the load or displacement asked for.

    Parameters
    ----------
    outcome : what happened, in a few words (``"unloaded"``, ``"no equilibrium"`` …)
    speed : rotation speed of the inner ring [rad/s]
    remedy : what the user can do about it, one sentence
    """

    def __init__(self, outcome: str, *, speed: float, remedy: str) -> None:
        super().__init__(f"{outcome} at {speed:.6g} rad/s: {remedy}")
        self.outcome = outcome
        self.speed = speed
        self.remedy = remedy
