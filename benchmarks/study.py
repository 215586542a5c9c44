#!/usr/bin/env python3
"""A designer's study:  python -m benchmarks.study [--count N] [--processes P]

Random variants of the flagship: preloads, stiffness of the springs, travel of the stop, diameter of
the shaft between the bearings. Of each the preload state and the Campbell diagram at 13 speeds.
Every process has a processor of its own, and loads the compiled bearing solver before its first.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import time
from collections import Counter
from dataclasses import replace
from statistics import median

import numpy as np

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import ROOT
from rotordyn.case.case import Case
from rotordyn.errors import NoSolution
from rotordyn.job.solving import restricted, solve

SPEEDS = np.linspace(0.0, 24000.0, 13) * math.pi / 30.0
COUNT = 1000
# Dotted path -> bounds of the factor on what the flagship has.
CHANGES = {
    "spindle.sleeves.front.spring.preload": (0.5, 2.0),
    "spindle.sleeves.front.spring.stiffness": (0.5, 2.0),
    "spindle.sleeves.rear.spring.preload": (0.5, 2.0),
    "spindle.sleeves.rear.spring.stiffness": (0.5, 2.0),
    "spindle.sleeves.front.stop_travel": (0.5, 1.5),
}
SECTION = "spindle.shaft.sections.{}.outer_diameter"


def machine() -> Case:
    """The flagship with the questions of the study."""
    case = restricted(rotordyn.load(ROOT / "cases" / "mfw2310.yaml"), ("preload", "campbell"))
    return replace(case, speeds=tuple(SPEEDS.tolist()))


def variant(case: Case, seed: int) -> Case:
    """A random one."""
    draw = np.random.default_rng(seed)
    changes = {path: _value(case, path) * draw.uniform(*b) for path, b in CHANGES.items()}
    assert case.spindle is not None, "the flagship is a spindle"
    widest = max(case.spindle.shaft.sections, key=lambda section: section.length)
    changes[SECTION.format(widest.name)] = widest.outer_diameter * draw.uniform(0.97, 1.03)
    return rotordyn.vary(case, changes)


def _value(case: Case, path: str) -> float:
    """What a dotted path leads to."""
    here: object = case
    for step in path.split("."):
        if isinstance(here, tuple):
            here = next(item for item in here if item.name == step)
        else:
            here = getattr(here, step)
    return float(here)  # type: ignore[arg-type]


def solved(seed: int) -> tuple[float, str, int]:
    """Seconds of one variant, why it has no answer if it has none, and how many modes it has."""
    begin = time.perf_counter()
    try:
        answers = solve(variant(machine_of_process(), seed))
    except NoSolution as error:
        return time.perf_counter() - begin, str(error), 0
    return time.perf_counter() - begin, "", len(answers.results["campbell"].mode)


_case: list[Case] = []


def machine_of_process() -> Case:
    """The flagship, read once a process."""
    return _case[0]


def _ready(free: multiprocessing.Queue[int]) -> None:
    """A processor for this process alone, the case read, the compiled solver loaded."""
    processor = free.get()
    if processor >= 0:
        os.sched_setaffinity(0, {processor})
    _case.append(machine())
    bearing = _case[0].spindle.seats[0].bearing
    bearing.equilibrium(load=[100.0, 0.0, 0.0, 0.0, 0.0], speed=1000.0, compiled=True)


def measure(count: int, processes: int) -> dict[str, object]:
    """Wall time of the study, its processes started and warmed included."""
    free: multiprocessing.Queue[int] = multiprocessing.Queue()
    known = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    for k in range(processes):
        free.put(known[k % len(known)] if known else -1)
    begin = time.perf_counter()
    with multiprocessing.Pool(processes, _ready, (free,)) as pool:
        found = pool.map(solved, range(count), chunksize=8)
    seconds = time.perf_counter() - begin
    words = Counter(word.partition(":")[0] for _, word, _ in found if word)
    return {
        "count": count,
        "processes": processes,
        "speeds": len(SPEEDS),
        "seconds": seconds,
        "variant": median(own for own, _, _ in found),
        "unsolved": dict(words),
        "modes": sorted({modes for _, word, modes in found if not word}),
    }


def main() -> None:
    """Measure and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--processes", type=int, default=2)
    arguments = parser.parse_args()
    found = measure(arguments.count, arguments.processes)
    print(found)  # noqa: T201
    if arguments.count == COUNT:
        keep(study=found)


if __name__ == "__main__":
    main()
