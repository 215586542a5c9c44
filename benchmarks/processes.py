"""Whole processes from outside: wall time, processor time, memory."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
MEGABYTE = 1e6
POLL = 0.01  # s between two readings of the memory


@dataclass(frozen=True, slots=True)
class Cost:
    """``wall`` and ``cpu`` [s], ``memory`` of the largest process of the tree [MB]."""

    wall: float
    cpu: float
    memory: float


def python(*arguments: str) -> list[str]:
    """A command that runs this interpreter."""
    return [sys.executable, *arguments]


def cost(command: Sequence[str], environment: Mapping[str, str] | None = None) -> Cost:
    """Run ``command`` from the root of the project once; it must succeed.

    The memory of a child includes that of this process at the fork: keep this process small.

    Raises
    ------
    CalledProcessError : it fails
    """
    begin = time.perf_counter()
    child = _started(command, environment)
    _, status, used = os.wait4(child.pid, 0)
    wall = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise subprocess.CalledProcessError(child.returncode, list(command))
    per_unit = 1.0 if sys.platform == "darwin" else 1024.0
    return Cost(wall, used.ru_utime + used.ru_stime, used.ru_maxrss * per_unit / MEGABYTE)


def first_cost(command: Sequence[str]) -> Cost:
    """As ``cost``, without files of an earlier run: an empty cache of matplotlib."""
    with tempfile.TemporaryDirectory() as empty:
        return cost(command, {"MPLCONFIGDIR": empty})


def in_turn(jobs: Mapping[str, Callable[[], Cost]], runs: int) -> dict[str, list[Cost]]:
    """Costs of every job, one of each in turn, so that a load on the machine affects all alike.

    The first round is not counted.
    """
    rounds = [{name: job() for name, job in jobs.items()} for _ in range(runs + 1)]
    return {name: [each[name] for each in rounds[1:]] for name in jobs}


def summary(name: str, found: Sequence[Cost]) -> dict[str, Any]:
    """Median of each cost, and the shortest wall time."""
    return {
        "name": name,
        "wall": median(c.wall for c in found),
        "fastest": min(c.wall for c in found),
        "cpu": median(c.cpu for c in found),
        "memory": median(c.memory for c in found),
        "runs": len(found),
    }


def tree_memory(command: Sequence[str]) -> float | None:
    """Peak memory of the command and its children together [MB], shared pages counted once.

    None where the system does not report it (it needs ``/proc``).
    """
    if not Path("/proc/self/smaps_rollup").exists():
        return None
    peak, child = 0.0, _started(command, None)
    while child.poll() is None:
        peak = max(peak, sum(_proportional(pid) for pid in (child.pid, *_children(child.pid))))
        time.sleep(POLL)
    return peak * 1024.0 / MEGABYTE


def _started(
    command: Sequence[str], environment: Mapping[str, str] | None
) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        command,
        cwd=ROOT,
        env={**os.environ, **(environment or {})},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def _children(pid: int) -> list[int]:
    try:
        return [int(p) for p in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def _proportional(pid: int) -> float:
    """Proportional set size of a process [kB], 0 once it has ended."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0.0
    return next((float(line.split()[1]) for line in lines if line.startswith("Pss:")), 0.0)
