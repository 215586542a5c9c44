"""Time against true error of two sweeps of the flagship: its preload states and its FRF map.

The map is compared with that of the exact shaft, over its largest value; the 49 preload states with
those of a tolerance of 10⁻¹³, by axial shifts over the largest one. Times are the fastest of some
runs, those of the map with known bearing states.
"""

from __future__ import annotations

import time
from typing import Any
from unittest import mock

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.precision import Machine
from benchmarks.processes import ROOT
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.bending import exact_receptance

TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-11)  # of the forces on rings; of those on balls the root
FINEST = 1e-13
ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
PARTS = (25, 50, 100, 200)
POINT = Port("Oc2", "y")
FREQUENCIES = tuple(np.linspace(10.0, 4000.0, 400))
RUNS = 5


def measure_sweeps() -> dict[str, list[dict[str, Any]]]:
    """A line per setting of each sweep: seconds and error."""
    return {"preload": preload_lines(), "map": map_lines()}


def preload_lines() -> list[dict[str, Any]]:
    """By the tolerance of the force equilibrium."""
    case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
    assert case.spindle is not None

    def found(tolerance: float) -> tuple[float, NDArray[np.float64]]:
        small = {"TOLERANCE": tolerance, "BALLS": min(1e-2, 10.0 * tolerance**0.5)}
        with mock.patch.multiple("rotordyn.preload.equilibrium", **small):
            scene = Scene(case.spindle, case.conditions, np.array(case.speeds))
            begin = time.perf_counter()
            state = scene.preload
            return time.perf_counter() - begin, state.shift

    truth = found(FINEST)[1]
    lines = []
    for tolerance in TOLERANCES:
        runs = [found(tolerance) for _ in range(RUNS)]
        error = float(np.abs(runs[0][1] - truth).max() / np.abs(truth).max())
        lines.append({"tolerance": tolerance, "seconds": min(r[0] for r in runs), "error": error})
    return lines


def map_lines() -> list[dict[str, Any]]:
    """By the requested accuracy, and by the length of standard elements."""
    machine = Machine.of_case("mfw2310", "", 4000.0)
    truth = exact_receptance(machine.scene(), ((POINT, POINT),), np.array(FREQUENCIES))
    length = machine.spindle.shaft.end - machine.spindle.shaft.start
    asked = [("any degree", f"{a:.0e}", {"accuracy": a}) for a in ACCURACIES]
    asked += [("standard", f"1/{n} of the shaft", {"element_length": length / n}) for n in PARTS]
    lines = []
    for way, setting, conditions in asked:
        runs = [_map(machine, conditions) for _ in range(RUNS)]
        error = float(np.abs(runs[0][1] - truth).max() / np.abs(truth).max())
        best, reported = min(r[0] for r in runs), runs[0][2]
        lines.append(
            {"way": way, "setting": setting, "seconds": best, "error": error, "reported": reported}
        )
    return lines


def _map(
    machine: Machine, conditions: dict[str, Any]
) -> tuple[float, NDArray[np.complex128], float]:
    """Seconds, receptances (speeds, 1, frequencies) and the reported error."""
    asked = FrfSpec(FREQUENCIES, ((POINT, POINT),))
    scene = machine.scene(**conditions)
    scene.ports = (machine.spindle.points[POINT.point],)
    begin = time.perf_counter()
    found = frf.solve(scene, asked)
    return time.perf_counter() - begin, found.response, float(found.error.max())
