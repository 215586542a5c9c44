"""Processor time of operating states of the MFW 2310: axial, under a radial load on all bearings,
and along a path of axial forces with friction.

``python -m benchmarks.states``: the fastest of five, compiled solver loaded before.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

import rotordyn
from rotordyn.preload.friction import operating_state
from rotordyn.preload.history import history
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene

SPEEDS = np.linspace(0.0, 24000.0, 49) * np.pi / 30.0
REPEATS = 5
STEPS = 200


def main() -> None:
    """Print one line for each state."""
    case = rotordyn.load(Path(__file__).parents[1] / "cases" / "mfw2310.yaml")
    spindle, conditions = case.spindle, case.conditions
    if spindle is None:
        raise ValueError("the case has no spindle")
    front = replace(spindle.sleeves[0], friction=80.9)
    rubbing = replace(spindle, sleeves=(front, *spindle.sleeves[1:]))
    load = PointLoad(at="Oc2", Fy=500.0)
    pulled = replace(conditions, loads=(load,))
    still = operating_state(rubbing, np.zeros(1), conditions.law)
    path = history(still, 1900.0)
    start = path.run_up()[0]
    if isinstance(start, str):
        raise TypeError(start)
    turn = np.array([1600.0, -1900.0, 1600.0, -1900.0, 1600.0])
    force = np.interp(np.linspace(0.0, 4.0, STEPS), np.arange(5.0), turn).tolist()
    states: dict[str, Callable[[], object]] = {
        "49 speeds, axial": lambda: operating_state(spindle, SPEEDS, conditions.law),
        "49 speeds, 500 N across": lambda: Scene(spindle, pulled, SPEEDS).preload,
        "49 speeds, axial, friction": lambda: operating_state(rubbing, SPEEDS, conditions.law),
        f"friction path of {STEPS} steps": lambda: path.loaded(0, start, force),
        "its tables of bearings": lambda: history(still, 1900.0),
    }
    for name, work in states.items():
        work()
        taken = []
        for _ in range(REPEATS):
            begin = time.process_time()
            work()
            taken.append(time.process_time() - begin)
        sys.stdout.write(f"{name}: {min(taken):.3f} s\n")


if __name__ == "__main__":
    main()
