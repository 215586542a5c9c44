#!/usr/bin/env python3
"""Response over time, time against true error:  python -m benchmarks.marching

The shock of the case ``mfw2310_shock`` at its three speeds, 20 ms of it, with more and more steps.
The error is the largest of the displacement of the tool over its largest, against steps an eighth
as long as the shortest.
"""

from __future__ import annotations

import time
from functools import partial
from typing import Any

import numpy as np

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import ROOT
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.forces import mean_inputs
from rotordyn.analyses.time_response.march import march
from rotordyn.analyses.time_response.nonlinear import Nonlinear
from rotordyn.analyses.time_response.spec import TimeResponseSpec
from rotordyn.arrays import Array
from rotordyn.scene.scene import Scene

STEPS = (150, 300, 600, 1200, 2400)
SHOWN = 150  # instants that are compared
RUNS = 3


def measure() -> list[dict[str, Any]]:
    """A line per number of steps: ``error``, and the fastest of some runs, ``seconds``."""
    case = rotordyn.load(ROOT / "cases" / "mfw2310_shock.yaml")
    spec, spindle = case.analyses["time_response"], case.spindle
    assert isinstance(spec, TimeResponseSpec), "what the case asks"
    assert spindle is not None, "the flagship is a spindle"
    ports = tuple({spindle.place(at) for at in spec.places})
    speed = np.array(case.speeds)
    scene = Scene(spindle, case.conditions, speed, spec.max_frequency, ports)
    equation = Equation.of(scene, spec)
    nonlinear = Nonlinear.of(scene, equation)
    inputs, still = partial(mean_inputs, spec, equation.speed), 0.0 * equation.damping[:, 0]

    def displacement(steps: int) -> Array:
        length = spec.duration / steps
        path = march(equation, inputs, length, steps, (still, still), nonlinear)
        return path.points[:, :: 2 * steps // SHOWN]

    truth = displacement(8 * STEPS[-1])
    lines = []
    for steps in STEPS:
        spent = []
        for _ in range(RUNS):
            begin = time.perf_counter()
            found = displacement(steps)
            spent.append(time.perf_counter() - begin)
        error = float(np.abs(found - truth).max() / np.abs(truth).max())
        per_period = steps / (spec.duration * spec.max_frequency)
        lines.append({"steps": per_period, "error": error, "seconds": min(spent)})
    return lines


if __name__ == "__main__":
    measured = measure()
    print(measured)  # noqa: T201
    keep(marching=measured)
