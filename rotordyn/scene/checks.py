"""Whether a machine is solved once more with a finer model, and what that showed."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Checks:
    """``wanted``: models are refined, else their errors are not known (NaN).

    Largest errors found so far, over what the accuracy allows, infinite where modes appear or
    vanish: ``worst`` of models that answered, or of the last one before them where no finer one
    was asked for; ``first`` of those that were tried first.
    """

    wanted: bool = True
    worst: float = 0.0
    first: float = 0.0
