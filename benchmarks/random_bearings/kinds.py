"""Random states of every kind:  python -m benchmarks.random_bearings.kinds --states 1000

Per kind: states by outcome, residuals of the equilibrium recomputed from loads and angles
(``residual above 1e-9``), non-finite numbers, contacts in tension, and states that change with
another start. The results are written into ``benchmarks/results.json``.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.ring.state import BearingState
from benchmarks.kept import keep
from tests.oracles.groove_balance import balanced
from tests.oracles.random_kinds import KINDS, Asked, draw

EACH = 50
OFTEN = 20  # batches between kept results
UNEQUAL = 1e-9  # of the largest ball load
OPEN = 1e-12  # of the ball diameter
SAME = 1e-6  # of the largest ball load
ROUNDING = 1e-15  # of the reach of a groove: an approach of no meaning
FIELDS = (
    "load",
    "displacement",
    "speed",
    "contact_load",
    "contact_angle",
    "centrifugal_force",
    "gyroscopic_moment",
)


def survey_kind(kind: str, count: int) -> Iterator[dict[str, Any]]:
    """Results of ``count`` states of a kind: intermediate ones, and at last of all states."""
    tally: Counter[str] = Counter()
    worst: dict[str, float] = Counter()
    odd: list[list[Any]] = []
    seconds = 0.0
    for number in range(-(-count // EACH)):
        asked = draw(kind, number, min(EACH, count - number * EACH))
        begin = time.process_time()
        state = asked.solve()
        seconds += time.process_time() - begin
        _counted(tally, asked, state)
        wrong = _judged(tally, worst, asked, state)
        changed = _restarted(tally, asked, state)
        for word, places in (("residual", wrong), ("start", changed)):
            odd += [[number, int(i), asked.dynamics, word] for i in places]
        if number % OFTEN == 0 or tally["states"] == count:
            spent = 1e6 * seconds / tally["states"]
            yield {**tally, "worst": dict(worst), "odd": odd, "microseconds": spent}


def _counted(tally: Counter[str], asked: Asked, state: BearingState) -> None:
    """States by outcome, dynamics and count of contacts."""
    tally["states"] += state.outcome.size
    for word, times in zip(*np.unique(state.outcome, return_counts=True), strict=True):
        tally[str(word) or "solved"] += int(times)
        if word:
            tally[f"{word}, {asked.dynamics}, {asked.oracle.kinematics}"] += int(times)
    good = state.outcome == ""
    for contacts, times in zip(*np.unique(state.contacts[good], return_counts=True), strict=True):
        tally[f"balls with {contacts} contacts"] += int(times)
    numbers = (state.load, state.displacement, state.stiffness(), state.contact_load)
    tally["not finite"] += int(sum((~np.isfinite(v[good])).sum() for v in numbers))
    tally["tensile"] += int((state.contact_load[good] < 0.0).sum())


def _judged(
    tally: Counter[str], worst: dict[str, float], asked: Asked, state: BearingState
) -> NDArray[np.intp]:
    """Equilibrium recomputed; the states that violate it, or the prescribed values."""
    good = np.flatnonzero(state.outcome == "")
    if not good.size:
        return good
    part = SimpleNamespace(**{name: getattr(state, name)[good] for name in FIELDS})
    found = balanced(asked.oracle, part, asked.dynamics, asked.shift)
    top = part.contact_load.max(axis=(-1, -2))
    dust = (asked.oracle.k * (ROUNDING * asked.oracle.free) ** 1.5).max()
    some = top > dust
    tally["loads of rounding alone"] += int(((top > 0.0) & ~some).sum())
    gap = found.gap / asked.oracle.drawing.ball_diameter
    unmet = np.zeros(good.size, dtype=bool)
    for name, miss, most in (
        ("ball", found.ball, UNEQUAL),
        ("ring", found.ring, UNEQUAL),
        ("motion", found.motion, UNEQUAL),
        ("gap", gap, OPEN),
    ):
        wrong = ~(miss <= most) & some
        tally[f"{name} above {most:g}"] += int(wrong.sum())
        worst[name] = max(worst[name], float(miss[some].max(initial=0.0)))
        unmet |= wrong
    tally["residual above 1e-9"] += int(unmet.sum())
    lever = asked.oracle.lever
    size = part.contact_load.sum(axis=(-1, -2)) + np.abs(part.load / lever).max(axis=-1)
    missed = np.abs(np.where(asked.free, part.load - asked.load[good], 0.0) / lever).max(axis=-1)
    held = np.where(asked.free, True, part.displacement == asked.displacement[good]).all(axis=-1)
    astray = (missed > UNEQUAL * np.maximum(size, 1e-300)) | ~held
    tally["not as asked"] += int(astray.sum())
    return np.asarray(good[unmet | astray])


def _restarted(tally: Counter[str], asked: Asked, cold: BearingState) -> NDArray[np.intp]:
    """States that change with another start: solved from the states of other entries."""
    warm = asked.solve(asked.rolled().solve())
    both = (cold.outcome == "") & (warm.outcome == "")
    size = np.maximum(cold.contact_load.max(axis=(-1, -2)), 1e-12)
    apart = np.abs(cold.contact_load - warm.contact_load).max(axis=(-1, -2)) > SAME * size
    changed = (cold.outcome != warm.outcome) | (both & apart)
    tally["changed by another start"] += int(changed.sum())
    return np.flatnonzero(changed)


def main() -> None:
    """Survey every kind and keep the results."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.random_bearings.kinds",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--states", type=int, default=1000, help="of each kind")
    parser.add_argument("--only", nargs="+", choices=list(KINDS), metavar="KIND")
    given = parser.parse_args()
    for kind in given.only or KINDS:
        for outcome in survey_kind(kind, given.states):
            keep("random_kinds", **{kind: outcome})


if __name__ == "__main__":
    main()
