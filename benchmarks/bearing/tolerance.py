"""Tolerance of Newton's method: time against the error of displacement and K, for given loads."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest import mock

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from bearings.ring.tolerances import ON_THE_WAY
from benchmarks.bearing.reference import Reference, largest
from benchmarks.bearing.subject import SPEED, VEX70, random_states, solver
from benchmarks.bearing.timing import fastest

Array = NDArray[np.float64]
TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)
WARM = 0.95  # of the load: the state a warm start comes from
JUDGED = 20


@contextmanager
def tolerance(asked: float) -> Iterator[None]:
    """Newton's method stops at the tolerance ``asked``, along the path at its default or above."""
    path = max(asked, ON_THE_WAY)
    with (
        solver(compiled=False),
        mock.patch.multiple("bearings.ring.tolerances", TOLERANCE=asked, ON_THE_WAY=path),
    ):
        yield


def measure_tolerance(count: int = 200, repeats: int = 5) -> list[dict[str, Any]]:
    """A line per start and tolerance: µs per state, largest relative errors of d and of K."""
    bearing, states = VEX70, random_states(count)
    with solver(compiled=False):
        near = bearing.equilibrium(load=WARM * states.load, speed=SPEED)
        known = bearing.equilibrium(load=states.load, speed=SPEED)
    true = _true(known)
    lines = []
    for start, name in ((near, "warm"), (None, "cold")):
        for asked in TOLERANCES:

            def solved(start: BearingState | None = start) -> BearingState:
                return bearing.equilibrium(load=states.load, speed=SPEED, start=start)

            with tolerance(asked):
                seconds = fastest(solved, repeats) / len(states.load)
                found = solved()
            error, error_k = _errors(found, true)
            lines.append(
                {
                    "start": name,
                    "tolerance": asked,
                    "state": 1e6 * seconds,
                    "error": error,
                    "error_k": error_k,
                }
            )
    return lines


def _true(known: BearingState) -> list[tuple[int, Array, Array]]:
    """(place, d, K) of some states, in more digits."""
    reference = Reference(VEX70, SPEED)
    chosen = np.unique(np.linspace(0, len(known.load) - 1, JUDGED).astype(int))
    pairs = []
    for i in chosen:
        centre = known.ball_centre[:, i]
        d = reference.displacement(
            known.load[i], known.displacement[i], centre, known.complete_stiffness[i]
        )
        pairs.append((int(i), d, reference.load_and_stiffness(d, centre)[1]))
    return pairs


def _errors(found: BearingState, true: list[tuple[int, Array, Array]]) -> tuple[float, float]:
    half = VEX70.pitch_diameter / 2.0
    lever = np.array([1.0, 1.0, 1.0, 1.0 / half, 1.0 / half])
    stiff = found.stiffness()
    moved = [largest(found.displacement[i] - d, d, 1.0 / lever) for i, d, _ in true]
    k = [largest((stiff[i] - k) * lever, k * lever, lever[:, None]) for i, _, k in true]
    return max(moved), max(k)
