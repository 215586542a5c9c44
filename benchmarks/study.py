#!/usr/bin/env python3
"""A designer's study:  python -m benchmarks.study [--count N] [--workers N] [--beside TREE]

Variants of the flagship by Latin hypercube: preloads, stiffness of the springs, travel of the stop,
diameter of the shaft between the bearings. Of each the preload state and the Campbell diagram at 13
speeds; the time of ``rotordyn.sweep`` for all of them, its processes included.

``--beside``: alternating with the version of the recorded time, so that the speed of the machine
does not matter; the ratio of both is kept.
"""

from __future__ import annotations

import argparse
import math
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import ROOT
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.numerics.threads import processors

SPEEDS = np.linspace(0.0, 24000.0, 13) * math.pi / 30.0
COUNT = 1000
# Dotted path -> bounds of the factor on the value of the flagship.
CHANGES = {
    "spindle.sleeves.front.spring.preload": (0.5, 2.0),
    "spindle.sleeves.front.spring.stiffness": (0.5, 2.0),
    "spindle.sleeves.rear.spring.preload": (0.5, 2.0),
    "spindle.sleeves.rear.spring.stiffness": (0.5, 2.0),
    "spindle.sleeves.front.stop_travel": (0.5, 1.5),
}


def machine() -> Case:
    """The flagship at the speeds of the study."""
    case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
    only = {name: case.analyses[name] for name in ("preload", "campbell")}
    return rotordyn.vary(case, {"speeds": tuple(SPEEDS.tolist()), "analyses": only})


def spans(case: Case) -> dict[str, rotordyn.Span]:
    """The varied values."""
    assert case.spindle is not None, "the flagship is a spindle"
    widest = max(case.spindle.shaft.sections, key=lambda section: section.length)
    factors = {**CHANGES, f"spindle.shaft.sections.{widest.name}.outer_diameter": (0.97, 1.03)}
    values = {path: found_at(case, path)[0][0] for path in factors}
    return {
        p: rotordyn.Span(values[p] * low, values[p] * high) for p, (low, high) in factors.items()
    }


def measure(count: int, workers: int) -> dict[str, object]:
    """Wall time of the study, its processes started and warmed included."""
    case = machine()
    how = dict(sampling="latin-hypercube", samples=count, seed=1, workers=workers)
    begin = time.perf_counter()
    found = rotordyn.sweep(case, spans(case), **how)
    seconds = time.perf_counter() - begin
    words = found["sentence"].values
    return {
        "count": count,
        "processes": workers,
        "speeds": len(SPEEDS),
        "seconds": seconds,
        "variant": seconds * workers / count,
        "unsolved": int((words != "").sum()),
    }


def _in_its_own_process(tree: Path, count: int, workers: int) -> float:
    """Seconds of the study with the sources of a tree."""
    code = f"from benchmarks.study import measure; print(measure({count}, {workers})['seconds'])"
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    command = [sys.executable, "-c", code]
    done = subprocess.check_output(command, cwd=tree, env=environment, text=True)
    return float(done.splitlines()[-1])


def beside(tree: Path, count: int, workers: int, pairs: int = 3) -> dict[str, object]:
    """Ratio of the times of pairs of runs, with this tree and with the other one."""
    trees = ROOT, tree
    times = [[_in_its_own_process(each, count, workers) for each in trees] for _ in range(pairs)]
    ratios = sorted(here / there for here, there in times)
    command = ["git", "-C", str(tree), "rev-parse", "--short", "HEAD"]
    revision = subprocess.check_output(command, text=True).strip()
    ends = {"least": ratios[0], "most": ratios[-1]}
    return {"revision": revision, "pairs": pairs, "ratio": statistics.median(ratios), **ends}


def main() -> None:
    """Measure and keep the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--workers", type=int, default=processors())
    parser.add_argument("--beside", type=Path, metavar="TREE")
    arguments = parser.parse_args()
    if arguments.beside:
        compared = beside(arguments.beside.resolve(), arguments.count, arguments.workers)
        print(compared)  # noqa: T201
        if arguments.count == COUNT:
            keep("study", beside=compared)
        return
    found = measure(arguments.count, arguments.workers)
    print(found)  # noqa: T201
    if arguments.count == COUNT:
        keep(study=found)


if __name__ == "__main__":
    main()
