"""Whether a machine is solved once more with a finer model, and what that showed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Checks:
    """``wanted``: models are refined, else their errors are not known (NaN). ``worst``: the largest
    error found so far, over what the accuracy allows; infinite where modes appear or vanish."""

    wanted: bool = True
    worst: float = 0.0
