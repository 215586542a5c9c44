#!/usr/bin/env python3
"""Ranges over tolerances against random machines:
python -m benchmarks.intervals [--count N] [--first K] [--parts N] [--only MACHINE]

Sum of preloads and radial stiffness of four spindles at rest and at top speed, with the usual
uncertainties. The range from few runs (``rotordyn.study.interval``) is compared with the 2.5 % and
97.5 % quantiles of machines drawn within the same tolerances (Latin hypercube), all of which are
solved. The difference is relative to the width of the range; its sampling error is that of the
bootstrap. Parts of the sample are kept and put together.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import ROOT
from rotordyn.analyses import PreloadSpec, StiffnessSpec
from rotordyn.case.asked import asked_of, certain
from rotordyn.case.case import Case
from rotordyn.case.uncertain import Uncertain
from rotordyn.errors import NoSolution
from rotordyn.job import solve
from rotordyn.scene.scene import Scene
from rotordyn.scene.stage import Memo
from rotordyn.study.interval import interval, sampled

MACHINES = {  # case -> point
    "mfw2310": "Oc2",
    "grinding_spindle_fits": "nose",
    "grinding_spindle_catalogue": "nose",
    "grinding_spindle_interval": "nose",
}
COUNT, PARTS, RUNS, RESAMPLED = 10_000, 40, 3, 1000
SETS = (
    (("outer", "hybrid"), ("equal", "outer")),
    (("outer", "hybrid"), ("equal", "outer", "inner")),
    ("all", "all"),
)
FOLDER = ROOT / "out" / "intervals"
Array = NDArray[np.float64]


def machine(name: str) -> Case:
    """A shipped case at rest and at top speed, with the usual uncertainties."""
    case = rotordyn.load(ROOT / "cases" / f"{name}.yaml")
    stiffness = StiffnessSpec(MACHINES[name], max_force=100.0, steps=1, variants=("full",))
    return replace(
        case,
        variants={},
        analyses={"preload": PreloadSpec(), "stiffness": stiffness},
        speeds=(0.0, case.speeds[-1]),
        uncertain=Uncertain(as_usual=True),
    )


def drawn(case: Case, changes: Sequence[dict[str, Any]]) -> Array:
    """Sum of preloads [N] and radial stiffness [N/µm], each at both speeds (machines, 4)."""
    memo, plain, rows = Memo(), certain(case), []
    for each in changes:
        try:
            rows.append(_numbers(plain.vary(each), memo))
        except NoSolution:
            rows.append(np.full(4, np.nan))
        for held in memo.values.values():
            del held[1:-1]
    return np.array(rows)


def _numbers(case: Case, memo: Memo) -> Array:
    from rotordyn.analyses.stiffness.solve import solve as solve_stiffness

    spindle, spec = case.spindle, case.analyses["stiffness"]
    assert spindle is not None
    assert isinstance(spec, StiffnessSpec)
    speed, ports = np.array(case.speeds), (spindle.place(spec.point),)
    scene = Scene(spindle, case.conditions, speed, ports=ports, memo=memo)
    scene.require_solution()
    carried = {name for sleeve in spindle.sleeves for name in sleeve.bearings}
    summed = [k for k, seat in enumerate(spindle.seats) if seat.name in carried]
    total = np.abs(scene.preload.seat_load()[:, summed].sum(axis=1))
    usable = np.isin(np.arange(len(speed)), scene.usable)
    tangent = solve_stiffness(scene, spec).tangent[:, 0] / 1e6
    return np.array([*np.where(usable, total, np.nan), *tangent])


def measure(name: str, values: Array) -> dict[str, Any]:
    """A line for each quantity: both ranges, and the difference of their ends."""
    case = machine(name)
    begin = time.process_time()
    held = rotordyn.run(case, interval=True).held_intervals[""]
    seconds = time.process_time() - begin
    top = f"{case.speeds[-1] * 30.0 / math.pi:.0f}"
    names = [f"preload: sum at {rpm} rpm" for rpm in ("0", top)]
    names += [f"stiffness: full at {rpm} rpm" for rpm in ("0", top)]
    lines = []
    for name_of, column in zip(names, values.T, strict=True):
        k = held.number.index(name_of)
        few, ends = held.tolerances[k], np.nanpercentile(column, (2.5, 97.5))
        width = max(np.ptp(ends), 1e-9 * ends[1])
        apart, scatter = np.abs(few - ends) / width, _scatter(column) / width
        lines.append(
            {
                "number": f"{name_of} [{held.unit[k]}]",
                "nominal": float(held.nominal[k]),
                "few": few.tolist(),
                "random": ends.tolist(),
                "error": float(apart.max()),
                "sampling": float(scatter[apart.argmax()]),
                "without": float(np.isnan(column).mean()),
                "interaction": float(held.interaction[k]),
            }
        )
    return {"runs": held.runs, "count": len(values), "seconds": seconds, "lines": lines}


def _scatter(column: Array) -> Array:
    """Standard deviation of both quantiles as of other samples of that size, by the bootstrap."""
    known, rng = column[np.isfinite(column)], np.random.default_rng(0)
    again = (rng.choice(known, len(known)) for _ in range(RESAMPLED))
    return np.std([np.percentile(each, (2.5, 97.5)) for each in again], axis=0)


def costs() -> list[dict[str, Any]]:
    """Processor time of the run of the flagship, and of its interval over sets of hypotheses."""
    whole = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
    solved = solve(whole)
    run = _fastest(lambda: solve(whole))
    lines = []
    for kinematics, sharing in SETS:
        asked = {"kinematics": kinematics, "moment_sharing": sharing}
        case = replace(whole, uncertain=Uncertain(hypotheses=asked))
        seconds = _fastest(lambda case=case: interval(case, solved.results))
        count = sum(1 for _ in asked_of(case).combinations)
        lines.append({"combinations": count, "run": run, "interval": seconds})
    return lines


def _fastest(work: Callable[[], object]) -> float:
    """Least processor time of some runs [s]."""
    taken = []
    for _ in range(RUNS):
        begin = time.process_time()
        work()
        taken.append(time.process_time() - begin)
    return min(taken)


def _part(name: str, number: int) -> Path:
    return FOLDER / f"{name}_{number}.npy"


def main() -> None:
    """Solve the parts of the sample that are not kept yet, then compare; with ``--costs`` time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT, help="machines of each")
    parser.add_argument("--parts", type=int, default=PARTS, help="number of parts that are kept")
    parser.add_argument("--first", type=int, default=0, help="part to begin with")
    parser.add_argument("--last", type=int, help="part to end with; none is compared then")
    parser.add_argument("--only", choices=[*MACHINES], help="one machine")
    parser.add_argument("--kept", action="store_true", help="compare the kept parts, solve nothing")
    parser.add_argument("--costs", action="store_true", help="time hypotheses of the flagship")
    asked = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    if asked.costs:
        keep("intervals", costs=costs())
        return
    names = [asked.only] if asked.only else [*MACHINES]
    for name in [] if asked.kept else names:
        case, end = machine(name), asked.parts if asked.last is None else asked.last + 1
        for number in range(asked.first, end):
            if not _part(name, number).exists():
                given = asked_of(case).tolerances
                changes = sampled(given, asked.count // asked.parts, number)
                np.save(_part(name, number), drawn(case, changes))
    for name in [] if asked.last is not None else names:
        parts = [np.load(path) for path in sorted(FOLDER.glob(f"{name}_*.npy"))]
        if parts:
            keep("intervals", **{name: measure(name, np.concatenate(parts))})


if __name__ == "__main__":
    main()
