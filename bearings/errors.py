"""Errors of one rolling bearing.

BearingError
├── InvalidBearing        the description itself is impossible (also a ValueError)
└── NoEquilibrium         the description is fine, but no physical state exists
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any


def shown(value: object, most: int = 60) -> str:
    """Quote a value for messages, on one line of at most ``most`` characters."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # an integer of more digits than Python writes
        text = f"a very large {type(value).__name__}"
    except RecursionError:
        text = f"a {type(value).__name__} nested too deeply to be shown"
    return text if len(text) <= most else text[: most - 3] + "..."


class BearingError(Exception):
    """Root of every error raised on purpose by ``bearings``."""


class InvalidBearing(BearingError, ValueError):
    """The description or the call is impossible: geometry, material, shapes, non-finite numbers."""


class NoEquilibrium(BearingError):
    """No physical state exists for the given load or displacement.

    Parameters
    ----------
    outcome : what happened, in a few words (``"unloaded"``, ``"no equilibrium"`` …)
    speed : rotation speed of the inner ring [rad/s]
    remedy : what the user can do about it, one sentence
    look : returns what ends the state, and above which speed; called when the message is read
    """

    def __init__(
        self, outcome: str, *, speed: float, remedy: str, look: Callable[[], str] | None = None
    ) -> None:
        super().__init__(outcome)
        self.outcome = outcome
        self.speed = speed
        self.remedy = remedy
        self._look = look

    @cached_property
    def ending(self) -> str:
        """What ends the state, and above which speed; may be empty."""
        return self._look() if self._look else ""

    def __str__(self) -> str:
        why = f"{self.outcome}: {self.ending}," if self.ending else self.outcome
        return f"{why} at {self.speed * 30.0 / math.pi:.6g} rpm: {self.remedy}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self.outcome, self.speed, self.remedy, self.ending)


def _unpickled(outcome: str, speed: float, remedy: str, ending: str) -> NoEquilibrium:
    """Rebuild a pickled error, in another process."""
    return NoEquilibrium(outcome, speed=speed, remedy=remedy, look=lambda: ending)
