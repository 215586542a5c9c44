"""From a case to its results, and to a results folder and back."""

from rotordyn.analyses.solving import Progress
from rotordyn.job.delivery import Delivery, deliver
from rotordyn.job.results import Results
from rotordyn.job.solved import run
from rotordyn.job.solving import one_variant, restricted, solve, solve_variants, unsolved
from rotordyn.job.stored import open

__all__ = [
    "Delivery",
    "Progress",
    "Results",
    "deliver",
    "one_variant",
    "open",
    "restricted",
    "run",
    "solve",
    "solve_variants",
    "unsolved",
]
