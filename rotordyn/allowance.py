"""Limits of time and memory of a run: stages that would exceed them are refused before they begin.

The limits apply only if requested, as by the command line. There a refusal ends the run as Ctrl-C
does: finished results are kept.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from threading import Event

from rotordyn.errors import TooCostly

LONGEST = 600.0  # s, by estimate
MOST_BYTES = 4e9
# Seconds on one processor of 2 GHz: eigenproblems of LAPACK, of general and of symmetric matrices,
# for each cubed row; of ARPACK for each row and squared mode.
GENERAL, SYMMETRIC, SPARSE = 3.5e-9, 5e-10, 2e-8
ARRAYS = 5  # complex arrays: matrix, right and left vectors, LAPACK workspace
MATRICES = 6  # matrices: stiffness, damping, and temporaries of their sums
VALUE, VALUE_BYTES = 7e-7, 120.0  # s, and bytes at most, of one response at one frequency
CORRECTION = 1.5e-9  # s of a mode with loss factors, for each cubed row
TABLE, TABLE_BYTES = 8.5e-3, 8e4  # of the law of one bearing at one speed
STEP, STEP_BYTES = 2e-3, 3e2  # of a history: 0.5e-3 s where sleeves stick, 14e-3 s where they slide
# Response over time: exponentials for each cubed row; a step by itself, for each squared row, for
# each bearing; what is kept of each number that is followed.
EXPONENTIAL, PASS, ENTRY, BEARING_STEP, FOLLOWED_BYTES = 8e-9, 2e-4, 1e-9, 2e-4, 2e2
FIGURE, PICTURE = 0.3, 0.1  # s of a figure in two formats, of a picture in space
REMEDY = "take fewer speeds, steps or points, or lower frequencies, or allow it with --yes"
DRAWN = "draw some of them (rotordyn.open, plot), or allow all with --yes"


@dataclass(frozen=True, slots=True)
class Allowance:
    """Limits of a run: seconds, end ``until`` by ``time.perf_counter`` [s], memory [bytes]."""

    seconds: float
    until: float
    memory: float


_allowance: ContextVar[Allowance | None] = ContextVar("allowance", default=None)


@contextmanager
def within(seconds: float = math.inf, memory: float = MOST_BYTES) -> Iterator[None]:
    """Limit the estimated time and memory [bytes] of runs inside."""
    token = _allowance.set(Allowance(seconds, time.perf_counter() + seconds, memory))
    try:
        yield
    finally:
        _allowance.reset(token)


Stop = KeyboardInterrupt | TooCostly
STOPS = (KeyboardInterrupt, TooCostly)  # what ends a run
ASKED = Event()  # set when a signal has requested a stop


@contextmanager
def heeding_stops() -> Iterator[None]:
    """Turn errors inside into KeyboardInterrupt if a signal has requested a stop: libraries may
    replace the interrupt by their own error, as NumPy does when it compares types."""
    try:
        yield
    except Exception as error:
        if ASKED.is_set():
            raise KeyboardInterrupt from error
        raise


def keeps_finished() -> bool:
    """Whether an ended run keeps its finished results."""
    return _allowance.get() is not None


def require_modes(name: str, speeds: int, size: int) -> None:
    """Raise TooCostly if eigenproblems of ``size`` coordinates at ``speeds`` speeds exceed the
    limits."""
    rows = 2 * size
    seconds = GENERAL * float(rows) ** 3 * speeds
    _require(
        f"{name}: {speeds} eigenproblems of {rows} rows", seconds, 16.0 * ARRAYS * rows**2 * speeds
    )


def require_free_modes(size: int, count: int | None) -> None:
    """Raise TooCostly if free modes of a body of ``size`` DOF exceed the limits; ``count`` of them
    by Lanczos' method, or all (None)."""
    seconds = SYMMETRIC * float(size) ** 3 if count is None else SPARSE * float(count) ** 2 * size
    many, wide = ("all", size) if count is None else (f"{count}", 3 * count)
    what = f"reduction of a body: {many} modes of {size} DOF"
    _require(what, seconds, 8.0 * ARRAYS * size * wide)


def require_matrices(name: str, speeds: int, size: int, own: int) -> None:
    """Raise TooCostly if matrices of ``size`` rows at ``speeds`` speeds exceed the limits; ``own``
    of the speeds are those of the case."""
    more = f" ({own} of the case, others added between them)" if speeds > own else ""
    what = f"{name}: matrices of {size} rows at {speeds} speeds{more}"
    _require(what, 0.0, 8.0 * MATRICES * size**2 * speeds)


def require_corrections(modes: int, at_once: int, size: int) -> None:
    """Raise TooCostly if corrections of modes with loss factors exceed the limits; ``size`` DOF,
    ``at_once`` modes together."""
    what = f"loss factors: corrections of {modes} modes of {size} DOF"
    seconds = CORRECTION * modes * float(size) ** 3
    _require(what, seconds, 64.0 * at_once * float(size) ** 2)


def require_responses(name: str, speeds: int, pairs: int, frequencies: int) -> None:
    """Raise TooCostly if responses of ``pairs`` pairs of points exceed the limits."""
    count = float(speeds) * pairs * frequencies
    what = f"{name}: {speeds} speeds by {pairs} pairs by {frequencies} frequencies"
    _require(what, VALUE * count, VALUE_BYTES * count)


def require_history(what: str, tables: int, steps: int) -> None:
    """Raise TooCostly if a load history of ``steps`` steps, with ``tables`` of bearing laws,
    exceeds the limits."""
    seconds = TABLE * tables + STEP * steps
    _require(what, seconds, TABLE_BYTES * tables + STEP_BYTES * steps)


def require_marching(
    name: str, states: int, bearings: int, steps: int, rows: int, followed: int
) -> None:
    """Raise TooCostly if a time integration exceeds the limits: ``steps`` at ``states`` (speeds),
    each with ``bearings``, matrices of ``rows`` rows and ``followed`` stored numbers."""
    what = f"{name}: {steps} steps of time at {states} speeds with {bearings} bearings"
    exponentials = EXPONENTIAL * float(rows) ** 3 * states
    each = PASS + states * (ENTRY * float(rows) ** 2 + BEARING_STEP * bearings)
    memory = states * (MATRICES * 8.0 * float(rows) ** 2 + FOLLOWED_BYTES * followed * steps)
    _require(what, exponentials + each * steps, memory)


def require_figures(figures: int, pictures: int) -> None:
    """Raise TooCostly if drawing ``figures``, and ``pictures`` in 3D, exceeds the limits."""
    what = f"{figures} figures" + f" with {pictures} pictures in space" * (pictures > 0)
    _require(what, FIGURE * figures + PICTURE * pictures, 0.0, DRAWN)


def _require(what: str, seconds: float, memory: float, remedy: str = REMEDY) -> None:
    allowance = _allowance.get()
    if allowance is None:
        return
    rest = allowance.until - time.perf_counter()
    if seconds > rest or memory > allowance.memory:
        also = f" and {memory / 1e9:.2g} GB" if memory else ""
        raise TooCostly(
            f"{what} take about {seconds:.3g} s{also}; allowed: "
            f"{allowance.seconds:g} s for the whole run, of which {max(rest, 0.0):.0f} s are left, "
            f"and {allowance.memory / 1e9:g} GB; {remedy}"
        )


def require_time(name: str, how: str = "not begun") -> None:
    """Raise TooCostly if the time of the run is over before a stage begins, or within it."""
    allowance = _allowance.get()
    if allowance is not None and time.perf_counter() > allowance.until:
        raise TooCostly(
            f"{name}: {how}, since {allowance.seconds:g} s for the whole run are over; {REMEDY}"
        )
