"""Optima against brute force on random design problems:  python -m benchmarks.optima [--restart]

Each problem varies two spans (or a span and a choice) of a shipped spindle within random ends,
under random limits; brute force solves a grid of it. ``behind``: relative difference of the best
found from the best of the grid, negative where it is better. Kept in ``benchmarks/results.json``
after each problem; a further run continues where the last one ended.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from itertools import islice
from typing import Any

import numpy as np

import rotordyn
from benchmarks.kept import RESULTS, keep
from rotordyn import Goal, Limit, Span, optimise
from rotordyn.case.case import Case
from rotordyn.study.optimum.problem import as_it_stands
from rotordyn.study.optimum.solve import problem_of
from rotordyn.study.optimum.trials import Trials

SEED, TRIALS, FINE = 11, 120, 25
PRELOAD = "spindle.sleeves.rear.spring.preload"
STIFFNESS = "spindle.sleeves.rear.spring.stiffness"
MODEL = "spindle.bearings.*.model"
MIDDLE = "spindle.shaft.sections.middle.outer_diameter"
BALL = "spindle.bearings.*.model.ball_diameter"
SPANS = {
    PRELOAD: (400.0, 3000.0),
    STIFFNESS: (1e6, 60e6),
    MIDDLE: (0.072, 0.090),
    BALL: (0.008, 0.0115),
}
MODELS = ["vex70", "s6014e", "kh6014e", "kh61914e"]
GOALS = (
    Goal(highest="stiffness.tangent", where={"variant": "nonlinear"}),
    Goal(highest="campbell.frequency", where={"mode": "bending 1*"}),
    Goal(lowest="preload.axial_load"),
)
READ = ("preload: sum", "campbell.frequency")


def problems(count: int) -> Iterator[tuple[dict[str, object], Goal, list[Limit]]]:
    """Random choices, goals and limits; each limit is close to the value of the unchanged case."""
    for number in range(count):
        rng = np.random.default_rng([SEED, number])
        paths = [str(p) for p in rng.choice(list(SPANS), 2, replace=False)]
        varied: dict[str, object] = {p: _span(rng, *SPANS[p]) for p in paths}
        if rng.uniform() < 0.4 and BALL not in varied:
            varied = {paths[0]: varied[paths[0]], MODEL: list(rng.permutation(MODELS)[:3])}
        goal = GOALS[rng.integers(len(GOALS))]
        force = float(rng.uniform(1300.0, 3000.0))
        limits = [Limit("preload: sum", at_most=f"{force:.1f} N")]
        if rng.uniform() < 0.5:
            least = float(rng.uniform(450.0, 800.0))
            where = {"mode": "bending 1*"}
            limits.append(Limit("campbell.frequency", where, at_least=f"{least:.1f} Hz"))
        yield varied, goal, limits


def _span(rng: np.random.Generator, low: float, high: float) -> Span:
    ends = low + (high - low) * np.sort(rng.uniform(size=2))
    return Span(float(ends[0]), float(max(ends[1], ends[0] + 0.2 * (high - low))))


def judged(case: Case, varied: dict[str, Any], goal: Goal, limits: list[Limit]) -> dict[str, Any]:
    """The best found compared with the best of a grid."""
    begin = time.process_time()
    found = optimise(case, varied, [goal], limits, trials=TRIALS, workers=1)
    spent = time.process_time() - begin
    problem = problem_of(case, varied, [goal], limits)
    as_it_stands(problem)
    axes = [
        np.linspace(0.0, n, FINE if n == 1.0 and not w else int(n) + 1)
        for n, w in zip(problem.last, problem.whole, strict=True)
    ]
    grid = [problem.place(x) for x in np.stack(np.meshgrid(*axes), -1).reshape(-1, len(axes))]
    force = Trials(problem, len(grid), 1, None, lambda done, of: None)
    best = min((goal.cost(t.goals[0]) for t in force.at(grid) if t.feasible), default=math.inf)
    ours = math.inf if found.best is None else goal.cost(found.best.goals[0])
    if math.isinf(best) or math.isinf(ours):
        behind = 0.0 if math.isinf(best) else math.inf
    else:
        behind = (ours - best) / abs(best)
    return {
        "behind": behind,
        "trials": len(found.trials),
        "grid": len(grid),
        "none feasible": math.isinf(best) and math.isinf(ours),
        "seconds": spent,
    }


def main() -> None:
    """Solve the problems and keep the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problems", type=int, default=20)
    parser.add_argument("--restart", action="store_true", help="begin again with the first one")
    given = parser.parse_args()
    case = rotordyn.vary(rotordyn.load("grinding_spindle"), {"speeds": (0.0, 400.0 * math.pi)})
    kept = json.loads(RESULTS.read_text(encoding="utf-8")).get("optima", {})
    rows = [] if given.anew else kept.get("problems", [])
    for problem in islice(problems(given.problems), len(rows), None):
        rows.append(judged(case, *problem))
        keep("optima", problems=rows, worst=max(row["behind"] for row in rows))


if __name__ == "__main__":
    main()
