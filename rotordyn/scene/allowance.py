"""What a run may take: stages that would take longer or more memory are refused before they begin.

Only where somebody asks for it, as the command line does. There Ctrl-C ends an analysis, and those
before it are kept.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from rotordyn.errors import InvalidInput

LONGEST = 120.0  # s, by estimate
MOST_BYTES = 4e9
EIGENPROBLEM = 3.5e-9  # s for each cubed row; LAPACK's of general matrices on one processor
ARRAYS = 5  # of complex numbers: matrix, vectors, left vectors, what LAPACK takes
MATRICES = 6  # stiffness, damping, and what their sums take
REMEDY = "take fewer speeds, lower frequencies or fewer points, or say yes to that (--yes)"


@dataclass(frozen=True, slots=True)
class Allowance:
    """Until when a run may go on, by the clock of ``time.perf_counter`` [s]."""

    seconds: float
    until: float


_allowance: ContextVar[Allowance | None] = ContextVar("allowance", default=None)


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Runs inside may take so long by estimate, and ``MOST_BYTES``."""
    token = _allowance.set(Allowance(seconds, time.perf_counter() + seconds))
    try:
        yield
    finally:
        _allowance.reset(token)


def limited() -> bool:
    """Whether runs are limited here."""
    return _allowance.get() is not None


def require(name: str, speeds: int, size: int) -> None:
    """Raise InvalidInput where eigenproblems of ``size`` coordinates at so many speeds, beside what
    has been spent, take more than is allowed."""
    allowance = _allowance.get()
    if allowance is None:
        return
    left = allowance.until - time.perf_counter()
    seconds = EIGENPROBLEM * (2.0 * size) ** 3 * speeds
    memory = 16.0 * ARRAYS * (2.0 * size) ** 2 * speeds
    if seconds > left or memory > MOST_BYTES:
        raise InvalidInput(
            f"{name}: {speeds} eigenproblems of {2 * size} rows take about {seconds:.3g} s and "
            f"{memory / 1e9:.2g} GB; allowed: {allowance.seconds:g} s for the whole run, of which "
            f"{max(left, 0.0):.0f} s are left, and {MOST_BYTES / 1e9:g} GB; {REMEDY}"
        )


def require_memory(name: str, speeds: int, size: int) -> None:
    """Raise InvalidInput where matrices of ``size`` rows at so many speeds do not fit."""
    memory = 8.0 * MATRICES * size**2 * speeds
    if limited() and memory > MOST_BYTES:
        raise InvalidInput(
            f"{name}: matrices of {size} rows at {speeds} speeds take {memory / 1e9:.2g} GB; "
            f"allowed: {MOST_BYTES / 1e9:g} GB; {REMEDY}"
        )


def require_time(name: str) -> None:
    """Raise InvalidInput where the time of the run is over before a stage begins."""
    allowance = _allowance.get()
    if allowance is not None and time.perf_counter() > allowance.until:
        raise InvalidInput(
            f"{name}: not begun, since {allowance.seconds:g} s for the whole run are over; {REMEDY}"
        )
