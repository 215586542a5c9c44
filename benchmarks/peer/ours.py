"""The side of rotordyn in the comparison, in a separate process with its own threads.

``python -m benchmarks.peer.ours FOLDER REPEATS`` writes times into FOLDER; with ``--once WORK
KIND`` it computes one case and ends, as a script of a user would.
"""

from __future__ import annotations

import argparse
import cProfile
import json
import pstats
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

import rotordyn
from benchmarks.peer import machine
from benchmarks.peer.cases import SETTINGS, WORKS, case, settings

LINES = 8  # of a profile


def measured(repeats: int) -> list[dict[str, Any]]:
    """A line per work, kind of bearings and setting: seconds of ``rotordyn.run`` on a case.

    The works take turns, so that a varying speed of the machine favours none.
    """
    lines = [
        {"work": work, "kind": kind, "setting": setting}
        for work in WORKS
        for kind in machine.KINDS
        for setting in settings(work)
    ]
    asked = [case(own["work"], own["kind"], SETTINGS[own["setting"]]) for own in lines]
    rounds = [[seconds(partial(rotordyn.run, one)) for one in asked] for _ in range(1 + repeats)]
    return [
        {**line, "seconds": median(found), "fastest": min(found), "repeats": repeats}
        for line, found in zip(lines, zip(*rounds[1:], strict=True), strict=True)
    ]


def seconds(work: Callable[[], Any]) -> float:
    """Seconds that some work takes."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def profile(work: str, kind: str) -> str:
    """Where the time of ``rotordyn.run`` is spent: functions with most time of their own."""
    asked = case(work, kind)
    rotordyn.run(asked)
    with cProfile.Profile() as kept:
        rotordyn.run(asked)
    ranked = sorted(pstats.Stats(kept).stats.items(), key=lambda item: -item[1][2])  # type: ignore[attr-defined]
    whole = sum(item[1][2] for item in ranked)
    lines = [
        f"{100.0 * own / whole:5.1f} % own {100.0 * both / whole:5.1f} % with callees "
        f"{calls:7d} calls  {Path(file).name}:{line} {name}"
        for (file, line, name), (_, calls, own, both, _) in ranked[:LINES]
    ]
    return "\n".join([f"{work}, {kind}: {whole:.3f} s under the profiler", *lines])


def main() -> None:
    """Compute one case, show where the time is spent, or measure all works."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument("repeats", nargs="?", type=int, default=9)
    parser.add_argument("--once", nargs=2, metavar=("WORK", "KIND"))
    parser.add_argument("--profile", action="store_true")
    asked = parser.parse_args()
    if asked.once:
        rotordyn.run(case(*asked.once))
    elif asked.profile:
        for work in WORKS:
            for kind in machine.KINDS:
                print(profile(work, kind))  # noqa: T201
    else:
        (asked.folder / "ours.json").write_text(json.dumps(measured(asked.repeats)))


if __name__ == "__main__":
    main()
