#!/usr/bin/env python3
"""Response over time, time against true error:  python -m benchmarks.marching

The blow of the shipped case ``mfw2310_shock`` at 24 000 rpm, 4 ms of it. The equation is that of the
program with its bearings; what differs is the method, ours by ever more steps and an implicit one
of SciPy for stiff equations (Radau) with ever closer tolerances. Errors are the largest of the
displacement of the tool over its largest, against steps a quarter as long as the shortest.
"""

from __future__ import annotations

import time
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import ROOT
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.forces import applied
from rotordyn.analyses.time_response.march import march
from rotordyn.analyses.time_response.remainder import Remainder
from rotordyn.analyses.time_response.spec import TimeResponseSpec
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
DURATION, SHOWN = 4e-3, 60  # s, and instants that are compared
STEPS = (30, 60, 120, 240, 480)
TOLERANCES = (1e-3, 1e-4, 1e-5)


def measure() -> list[dict[str, Any]]:
    """A line per method and setting."""
    case = rotordyn.load(ROOT / "cases" / "mfw2310_shock.yaml")
    asked = case.analyses["time_response"]
    assert isinstance(asked, TimeResponseSpec), "what the case asks"
    spec = replace(asked, duration=DURATION)
    assert case.spindle is not None, "the flagship is a spindle"
    ports = tuple({case.spindle.place(at) for at in spec.places})
    speed = np.array(case.speeds[-1:])
    scene = Scene(case.spindle, case.conditions, speed, spec.max_frequency, ports)
    equation, bearings = Equation.of(scene, spec), Remainder.of(scene)
    truth = _marched(equation, bearings, spec, 4 * STEPS[-1])
    lines = []
    for way, settings, solve in (
        ("rotordyn", STEPS, partial(_marched, equation, bearings, spec)),
        ("Radau", TOLERANCES, partial(_integrated, equation, bearings, spec)),
    ):
        for setting in settings:
            begin = time.perf_counter()
            found = solve(setting)
            spent = time.perf_counter() - begin
            error = float(np.abs(found - truth).max() / np.abs(truth).max())
            asked_for = f"{setting} steps" if way == "rotordyn" else f"{setting:.0e}"
            lines.append({"way": way, "setting": asked_for, "error": error, "seconds": spent})
    return lines


def _force(spec: TimeResponseSpec, instants: Array) -> Array:
    return applied(spec, np.zeros((1, 0)), instants)


def _marched(
    equation: Equation, bearings: Remainder, spec: TimeResponseSpec, steps: int
) -> Array:
    """Displacement of the points (shown, 3·points)."""
    path = march(equation, partial(_force, spec), DURATION / steps, steps, bearings)
    return path.watched[0, :: 2 * steps // SHOWN, : len(equation.points)]


def _integrated(
    equation: Equation, bearings: Remainder, spec: TimeResponseSpec, tolerance: float
) -> Array:
    """The same, by another integrator of the same equation."""
    stiffness, damping, size = equation.stiffness[0], equation.damping[0], len(equation.pushed)

    def rate(t: float, state: Array) -> Array:
        q, v = state[:size], state[size:]
        ring = (equation.rings @ q).reshape(1, 1, -1, 5).repeat(2, axis=1)
        beyond = bearings.at(ring).beyond[0, 1].ravel()
        pushed = equation.pushed @ _force(spec, np.array([t]))[0, :, 0] - equation.rings.T @ beyond
        return np.concatenate([v, pushed - stiffness @ q - damping @ v])

    instants = np.linspace(0.0, DURATION, SHOWN + 1)
    found = solve_ivp(
        rate,
        (0.0, DURATION),
        np.zeros(2 * size),
        "Radau",
        instants,
        rtol=tolerance,
        atol=tolerance * 1e-6,
    )
    return np.asarray((equation.points @ found.y[:size]).T)


if __name__ == "__main__":
    found = measure()
    for line in found:
        print(line)  # noqa: T201
    keep(marching=found)
