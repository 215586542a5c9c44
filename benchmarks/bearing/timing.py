"""The fastest of some runs, per call."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

LEAST = 2e-3  # s that one run takes at least, by calling more often


def fastest(work: Callable[[], Any], repeats: int) -> float:
    """Seconds of one call: the fastest of ``repeats`` runs, after one that is not counted."""
    begin = time.perf_counter()
    work()
    once = time.perf_counter() - begin
    calls = max(1, min(1000, round(LEAST / once)))
    return min(_seconds(work, calls) for _ in range(repeats))


def _seconds(work: Callable[[], Any], calls: int) -> float:
    begin = time.perf_counter()
    for _ in range(calls):
        work()
    return (time.perf_counter() - begin) / calls
