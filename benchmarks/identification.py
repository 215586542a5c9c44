#!/usr/bin/env python3
"""Random machines like the MFW 2310 identified from synthetic noisy curves:
python -m benchmarks.identification [--count N] [--first K]

Nine values of each machine lie anywhere within 10 % of those of the spindle. The data are
displacements of shaft and rear sleeve at three speeds, 25 points on both branches, with noise of
0.4 µm and a tare of 1 µm at each speed. The results are: values within their 95 % intervals, the
radial stiffness at top speed likewise, its error and mean error, computing time, and whether the
true hypothesis and a false one are retained. Shifts of the seats are known.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.kept import keep
from benchmarks.processes import ROOT
from rotordyn.study.identification.along_axis import BRANCHES, RPM, AxialCurve
from rotordyn.study.identification.certainty import certainty
from rotordyn.study.identification.identification import SURVIVES
from rotordyn.study.identification.prediction import Predicted, numbers, predictions
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.search import search
from rotordyn.study.identification.trial import Known

COUNT, POINTS, NOISE, TARE, APART = 100, 25, 0.4e-6, 1e-6, 0.1
SPEEDS = np.array([4000.0, 16000.0, 24000.0]) * RPM
FALSE = (("hybrid", "equal"), ("outer", "outer"), ("hybrid", "hybrid"))  # kinematics, sharing
FILE = ROOT / "out" / "identification_synthetic.jsonl"
STIFFNESS = (Predicted("stiffness: full at 24000 rpm"),)


def measured(problem: Problem, values: np.ndarray, rng: np.random.Generator) -> Problem:
    """The problem with curves of a machine, each with its noise and tares."""
    force = np.linspace(-1691.0, 1809.0, POINTS)
    speed = np.repeat(SPEEDS, 2 * POINTS)
    branch = tuple(np.tile(np.repeat(BRANCHES, POINTS), len(SPEEDS)).tolist())
    along = np.tile(np.concatenate([force[::-1], force]), len(SPEEDS))

    def curve(of: str, displacement: np.ndarray) -> AxialCurve:
        return AxialCurve(
            name=of,
            of=of,
            deviation=NOISE,
            tare=TARE,
            speed=speed,
            branch=branch,
            force=along,
            displacement=displacement,
        )

    bodies = ("shaft", "rear")
    still = replace(problem, measurements=tuple(curve(b, 0.0 * along) for b in bodies))
    true = still.predicted(values)
    assert true is not None, still.why
    noisy = [
        each + rng.normal(0.0, NOISE, len(each)) + np.repeat(rng.normal(0.0, TARE, 3), 2 * POINTS)
        for each in true
    ]
    pairs = zip(bodies, noisy, strict=True)
    return replace(problem, measurements=tuple(curve(b, each) for b, each in pairs))


def identified(number: int) -> dict[str, Any]:
    """One machine identified from its synthetic curves."""
    rng = np.random.default_rng((2310, number))
    asked = read_identification(ROOT / "cases" / "identification" / "mfw2310_twin.yaml")
    base = asked.searches.problem(0)
    middle = np.array([574.0, 528.0, 6.2e6, 5.49e6, 52.2e-6, 80.9, 43.2e-6, 7.3e-6, 0.571])
    true = middle * (1.0 + APART * rng.uniform(-1.0, 1.0, len(middle)))
    true[-1] = middle[-1] + 0.01 * rng.uniform(-1.0, 1.0)
    problem = measured(base, true, rng)
    begin = time.perf_counter()
    fit = search(problem, problem.start)
    sure = certainty(problem, fit)
    seconds = time.perf_counter() - begin
    (stiff,) = predictions(problem, sure, STIFFNESS)
    ((_, stiffness, _),) = numbers(problem, true, STIFFNESS, Known()).values()
    false = FALSE[number % len(FALSE)]
    other = replace(
        problem,
        case=problem.case.vary(
            {"conditions.kinematics": false[0], "conditions.moment_sharing": false[1]}
        ),
    )
    rival = search(other, fit.values)
    inside = (sure.interval[:, 0] <= true) & (true <= sure.interval[:, 1])
    return {
        "number": number,
        "inside": inside.tolist(),
        "words": list(sure.words),
        "off": ((fit.values - true) / true).tolist(),
        "stiffness": [stiffness, stiff.value],
        "predicted": [stiff.low, stiff.high],
        "seconds": seconds,
        "machines": problem.evaluations,
        "reduced": sure.reduced,
        "true retained": bool(fit.cost - rival.cost <= SURVIVES),
        "false retained": bool(rival.cost - fit.cost <= SURVIVES),
        "false": list(false),
    }


def main() -> None:
    """Identify machines as the command line says; those done before are not done again."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--first", type=int, default=0)
    given = parser.parse_args()
    FILE.parent.mkdir(exist_ok=True)
    lines = FILE.read_text().splitlines() if FILE.exists() else []
    found = {row["number"]: row for row in map(json.loads, lines)}
    for number in range(given.first, given.first + given.count):
        if number not in found:
            found[number] = identified(number)
            with FILE.open("a") as file:
                file.write(json.dumps(found[number]) + "\n")
        sys.stdout.write(_said(list(found.values())) + "\n")
        sys.stdout.flush()
    keep("identification", **_summed(list(found.values())))


def _summed(rows: list[dict[str, Any]]) -> dict[str, Any]:
    inside = np.array([row["inside"] for row in rows])
    true, stiff = np.array([row["stiffness"] for row in rows]).T
    low, high = np.array([row["predicted"] for row in rows]).T
    off = stiff / true - 1.0
    return {
        "machines": len(rows),
        "covered": inside.sum(axis=0).tolist(),
        "all": int(inside.all(axis=1).sum()),
        "stiffness covered": int(((low <= true) & (true <= high)).sum()),
        "stiffness half interval": float(np.median((high - low) / 2.0 / stiff)),
        "stiffness off": float(np.abs(off).max()),
        "stiffness within 2 %": int((np.abs(off) <= 0.02).sum()),
        "stiffness mean": float(off.mean()),
        "stiffness error of the mean": float(off.std(ddof=1) / np.sqrt(len(off))),
        "seconds": float(np.median([row["seconds"] for row in rows])),
        "longest": float(max(row["seconds"] for row in rows)),
        "true retained": int(sum(row["true retained"] for row in rows)),
        "false retained": int(sum(row["false retained"] for row in rows)),
    }


def _said(rows: list[dict[str, Any]]) -> str:
    return json.dumps(_summed(rows))


if __name__ == "__main__":
    main()
