"""The rotor of the flagship: computing time of its FRF map."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.processes import ROOT
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.case.case import Case
from rotordyn.preload.state import PreloadState
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
FEW = 24  # the error is computed at every 24th speed: rest, half and top speed


@dataclass(frozen=True, slots=True)
class Job:
    """The FRF map of a case, at some of its speeds, with known preload state."""

    case: Case
    spec: FrfSpec
    speed: Array
    preload: PreloadState

    @classmethod
    def of_flagship(cls, every: int = 1) -> Job:
        """The flagship at every n-th of its speeds."""
        case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
        spec, spindle = case.analyses["frf"], case.spindle
        if spindle is None or not isinstance(spec, FrfSpec):
            raise ValueError("the case has no spindle, or asks for no map")
        speed = np.array(case.speeds[::every])
        return cls(case, spec, speed, Scene(spindle, case.conditions, speed).preload)

    def solved(self) -> tuple[Scene, NDArray[np.complex128]]:
        """A scene with its modes and the map (speeds, pairs, frequencies)."""
        spindle = self.case.spindle
        if spindle is None:
            raise ValueError("the case has no spindle")
        ports = {spindle.points[port.point] for pair in self.spec.pairs for port in pair}
        scene = Scene(
            spindle,
            self.case.conditions,
            self.speed,
            max_frequency=4000.0,
            ports=tuple(sorted(ports)),
        )
        scene.solved["preload"] = self.preload
        found = scene.timed("frf", lambda: frf.solve(scene, self.spec))
        return scene, found.receptance


def measure_frf() -> dict[str, Any]:
    """µs per speed and frequency, and the error of the modal sum."""
    job = Job.of_flagship()
    runs = [job.solved()[0].clock.seconds for _ in range(5)]
    few = Job.of_flagship(FEW)
    scene, found = few.solved()
    points = len(job.speed) * len(job.spec.frequencies)
    return {
        "speeds": len(job.speed),
        "frequencies": len(job.spec.frequencies),
        "pairs": len(job.spec.pairs),
        "modes": 1e6 * median(run["bending modes"] for run in runs) / len(job.speed),
        "point": 1e6 * median(run["frf"] for run in runs) / points,
        "error": _modal_error(scene, few.spec, found),
    }


def _modal_error(scene: Scene, spec: FrfSpec, found: NDArray[np.complex128]) -> float:
    """The map against one linear solution per speed and frequency with the same matrices."""
    response, excitation = spec.pairs[0]
    (bending,) = scene.with_motions(("bending",))
    free = scene.system(bending)
    system, half = free.modes, free.linear.size // 2
    rows = [
        free.linear.row(*scene.spindle.place(port.point), port.direction)[:half]
        for port in (response, excitation)
    ]
    omega = 2.0 * math.pi * np.array(spec.frequencies)[::20]
    both = [
        np.stack([_direct(system.stiffness, system.damping, sign * w, rows) for w in omega], axis=1)
        for sign in (1.0, -1.0)
    ]
    exact = 0.5 * (both[0] + both[1].conj())
    return float(np.abs(found[:, 0, ::20] - exact).max() / np.abs(exact).max())


def _direct(stiffness: Any, damping: Any, omega: float, rows: list[Array]) -> Any:
    """Receptance of the complex form at i·ω, at every speed (speeds,)."""
    matrix = stiffness + 1j * omega * damping - omega**2 * np.eye(stiffness.shape[-1])
    load = np.broadcast_to(rows[1][:, None], (*matrix.shape[:-1], 1))
    return (rows[0] @ np.linalg.solve(matrix, load))[:, 0]
