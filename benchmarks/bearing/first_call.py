"""Time of the first call of a process: empty cache, cache on disk, without compiling."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from typing import Any

from benchmarks.processes import ROOT, python

CHILD = """
import json, time
begin = time.perf_counter()
import numpy
numpy_in = time.perf_counter()
from bearings import Follower
from tests.oracles.known_bearings import VEX70
imported = time.perf_counter()
d = (20e-6, 0.0, 0.0, 0.0, 0.0)
{call}
first = time.perf_counter()
{call}
second = time.perf_counter()
print(json.dumps(
    dict(imported=imported - numpy_in, first=first - imported, second=second - first)
))
"""
FOLLOWED = "Follower(VEX70, speed=2500.0).load(d)"
PLAIN = "VEX70.equilibrium(displacement=d, speed=2500.0, compiled=False)"


def measure_first_call(repeats: int = 3) -> list[dict[str, Any]]:
    """Seconds of the import of ``bearings``, of the first call and of a second one."""
    with tempfile.TemporaryDirectory() as kept:
        compiling = _run(FOLLOWED, kept)
        loading = [_run(FOLLOWED, kept) for _ in range(repeats)]
        plain = [_run(PLAIN, kept) for _ in range(repeats)]
    return [
        {"what": "`Follower.load`, empty cache: numba imported, all compiled", **compiling},
        {"what": "`Follower.load`, compiled by an earlier process", **_least(loading)},
        {"what": "`equilibrium` in numpy", **_least(plain)},
    ]


def _least(runs: list[dict[str, float]]) -> dict[str, float]:
    return {name: min(run[name] for run in runs) for name in runs[0]}


def _run(call: str, kept: str) -> dict[str, float]:
    done = subprocess.run(
        python("-c", CHILD.format(call=call)),
        cwd=ROOT,
        env={**os.environ, "NUMBA_CACHE_DIR": kept},
        capture_output=True,
        text=True,
        check=True,
    )
    found: dict[str, float] = json.loads(done.stdout)
    return found
