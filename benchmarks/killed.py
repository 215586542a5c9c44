#!/usr/bin/env python3
"""A long study killed three times:  python -m benchmarks.killed [--side N] [--seed N]

N × N points of the grinding spindle (preload of both springs) at one speed; ``kill -9`` of all its
processes at three random moments, then the same command to the end. Reported: points lost, points
solved twice, and the largest relative difference of fifty of them from single runs.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import rotordyn
from benchmarks.kept import keep
from rotordyn.job.values import values_of

CASE = "grinding_spindle"
SPRINGS = "spindle.sleeves.rear.spring.preload", "spindle.sleeves.rear.spring.stiffness"
ENDS = (800.0, 1600.0), (4e6, 16e6)
UNITS = "N", "N/m"
KILLS, COMPARED = 3, 50
RPM = 12000.0


def study(side: int) -> str:
    """The study's file."""
    spans = [
        f"  {path}: {{from: {low} {unit}, to: {high} {unit}, points: {side}}}"
        for path, unit, (low, high) in zip(SPRINGS, UNITS, ENDS, strict=True)
    ]
    head = ["title: killed three times", "case: one_speed.yaml", "vary:"]
    return "\n".join([*head, *spans, "analyses: [preload]", ""])


def measure(side: int, seed: int) -> dict[str, object]:
    """Kill, continue, compare."""
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        (folder / "one_speed.yaml").write_text(
            f"spindle: {CASE}\nspeeds: [{RPM} rpm]\nanalyses:\n  preload: {{}}\n"
        )
        (folder / "killed.yaml").write_text(study(side))
        journal = folder / "out" / "killed" / "points.jsonl"
        begin = time.perf_counter()
        for share in sorted(chance.uniform(0.05, 0.95) for _ in range(KILLS)):
            running = _started(folder)
            while running.poll() is None and _solved(journal) < share * side**2:
                time.sleep(0.01)
            if running.poll() is not None:
                raise SystemExit("the study ended before it was killed")
            os.killpg(running.pid, signal.SIGKILL)
            running.wait()
        last = _started(folder)
        if last.wait():
            raise SystemExit("the study does not continue")
        seconds = time.perf_counter() - begin
        rows = [json.loads(line) for line in journal.read_text().splitlines()[1:]]
        numbers = [row["point"] for row in rows]
        apart = _apart(folder, chance.sample(rows, COMPARED), side)
    return {
        "points": side**2,
        "kills": KILLS,
        "lost": side**2 - len(set(numbers)),
        "twice": len(numbers) - len(set(numbers)),
        "apart": apart,
        "seconds": seconds,
    }


def _started(folder: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "rotordyn", "sweep", "killed.yaml", "--quiet", "--yes"]
    return subprocess.Popen(command, cwd=folder, start_new_session=True, stdout=subprocess.DEVNULL)


def _solved(journal: Path) -> int:
    return journal.read_bytes().count(b"\n") - 1 if journal.exists() else 0


def _apart(folder: Path, rows: list[dict[str, object]], side: int) -> float:
    """Largest relative difference of points from single runs."""
    case, worst = rotordyn.load(folder / "one_speed.yaml"), 0.0
    for row in rows:
        places = divmod(int(str(row["point"])), side)
        changes = {
            path: low + (high - low) * place / (side - 1)
            for path, (low, high), place in zip(SPRINGS, ENDS, places, strict=True)
        }
        other = rotordyn.vary(case, changes)
        alone = values_of(other, rotordyn.run(other).parts[""].results).numbers
        found = row["numbers"]
        assert isinstance(found, dict)
        for name, number in alone.items():
            if number.value == number.value and number.value:
                worst = max(worst, abs(found[name][0] / number.value - 1.0))
    return worst


def main() -> None:
    """Measure and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--side", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    found = measure(arguments.side, arguments.seed)
    print(found)  # noqa: T201
    if arguments.side == 100:
        keep(killed=found)


if __name__ == "__main__":
    main()
