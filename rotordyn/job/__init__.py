"""From a case to its results folder."""

from rotordyn.analyses.solving import Progress
from rotordyn.job.delivery import Delivery, deliver
from rotordyn.job.solving import (
    one_variant,
    restricted,
    run,
    solve,
    solve_variants,
    unsolved,
)

__all__ = [
    "Delivery",
    "Progress",
    "deliver",
    "one_variant",
    "restricted",
    "run",
    "solve",
    "solve_variants",
    "unsolved",
]
