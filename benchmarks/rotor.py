"""The rotor of the flagship: cost of its FRF map, and what accuracy costs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.processes import ROOT
from rotordyn.analysis import frf
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import FrfSpec
from rotordyn.case.case import Case
from rotordyn.preload.state import PreloadState
from rotordyn.system import lateral_rotor

Array = NDArray[np.float64]
LENGTHS = (16e-3, 12e-3, None, 8e-3, 6e-3, 4e-3)
FINEST = 1e-3
CUTOFFS = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0)
NEARLY_ALL = 40.0
FEW = 24  # accuracy is judged at every 24th speed: rest, half and top speed
MODES = 4  # of each whirl
STAGES = ("mesh", "rotor", "bending", "bending_modes", "frf")


@dataclass(frozen=True, slots=True)
class Job:
    """The map that a case asks for, at some of its speeds, with its preload state known."""

    case: Case
    spec: FrfSpec
    speed: Array
    preload: PreloadState

    @classmethod
    def of_flagship(cls, every: int = 1) -> Job:
        """The flagship at every so many of its speeds."""
        case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
        spec, spindle = case.analyses["frf"], case.spindle
        if spindle is None or not isinstance(spec, FrfSpec):
            raise ValueError("the case has no spindle, or asks for no map")
        speed = np.array(case.speeds[::every])
        return cls(case, spec, speed, Scene(spindle, case.conditions, speed).preload)

    def solved(self, length: float | None = None) -> tuple[Scene, NDArray[np.complex128]]:
        """A scene with its modes and the map (speeds, pairs, frequencies)."""
        spindle = self.case.spindle
        if spindle is None:
            raise ValueError("the case has no spindle")
        ports = {spindle.points[port.point] for pair in self.spec.pairs for port in pair}
        scene = Scene(
            spindle,
            replace(self.case.conditions, element_length=length),
            self.speed,
            max_frequency=4000.0,
            ports=tuple(sorted(ports)),
        )
        scene.solved["preload"] = self.preload
        found = scene.timed("frf", lambda: frf.answer(scene, self.spec))
        return scene, found.receptance


def measure_frf() -> dict[str, Any]:
    """µs per speed and frequency, and the error of the modal sum."""
    job = Job.of_flagship()
    runs = [job.solved()[0].seconds for _ in range(5)]
    few = Job.of_flagship(FEW)
    scene, found = few.solved()
    points = len(job.speed) * len(job.spec.frequencies)
    return {
        "speeds": len(job.speed),
        "frequencies": len(job.spec.frequencies),
        "pairs": len(job.spec.pairs),
        "modes": 1e6 * median(run["bending_modes"] for run in runs) / len(job.speed),
        "point": 1e6 * median(run["frf"] for run in runs) / points,
        "error": _modal_error(scene, few.spec, found),
    }


def element_lengths() -> list[dict[str, Any]]:
    """Error against the finest elements, beside the time of all stages of the rotor."""
    all_speeds, few = Job.of_flagship(), Job.of_flagship(FEW)
    exact = few.solved(FINEST)
    lines = []
    for length in LENGTHS:
        name = f"{1e3 * length:.0f} mm" if length else "1/50 of the shaft (default)"
        lines.append(_line(name, all_speeds.solved(length)[0], few.solved(length), exact))
    return lines


def cutoffs() -> list[dict[str, Any]]:
    """Error of the reduced basis against one that keeps modes up to ``NEARLY_ALL``."""
    all_speeds, few, standard = Job.of_flagship(), Job.of_flagship(FEW), lateral_rotor.CUTOFF
    lines = []
    try:
        _keep(NEARLY_ALL)
        exact = few.solved()
        for cutoff in CUTOFFS:
            _keep(cutoff)
            name = f"{cutoff:g}" + (" (default)" if cutoff == standard else "")
            lines.append(_line(name, all_speeds.solved()[0], few.solved(), exact))
    finally:
        _keep(standard)
    return lines


def _keep(cutoff: float) -> None:
    setattr(lateral_rotor, "CUTOFF", cutoff)  # noqa: B010 (a constant of the module, for once)


Solved = tuple[Scene, NDArray[np.complex128]]


def _line(name: str, timed: Scene, found: Solved, exact: Solved) -> dict[str, Any]:
    (scene, h), (reference, h_exact) = found, exact
    frequency, known = _frequencies(scene), _frequencies(reference)
    largest = np.abs(h_exact).max(axis=(0, 2))[:, None]
    driven = np.abs(h[:, 0, 0] / h_exact[:, 0, 0] - 1.0)
    return {
        "setting": name,
        "elements": scene.mesh.nodes - 1,
        "size": scene.rotor.size,
        "frequency": float(np.abs(frequency / known - 1.0).max()),
        "low": float(driven.max()),
        "receptance": float((np.abs(h - h_exact) / largest).max()),
        "seconds": sum(timed.seconds[stage] for stage in STAGES),
    }


def _frequencies(scene: Scene) -> Array:
    """The lowest ``MODES`` backward and forward of every speed (speeds, 2 · MODES)."""
    found = []
    for pole in scene.bending_modes.pole:
        back, forward = np.sort(-pole.imag[pole.imag < 0.0]), np.sort(pole.imag[pole.imag > 0.0])
        found.append([*back[:MODES], *forward[:MODES]])
    return np.array(found)


def _modal_error(scene: Scene, spec: FrfSpec, found: NDArray[np.complex128]) -> float:
    """The map against one linear solution per speed and frequency with the same matrices."""
    response, excitation = spec.pairs[0]
    spindle, system = scene.spindle, scene.bending
    rows = [
        system.rotor.row(scene.mesh.node_of(spindle.points[port.point]), port.direction)
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
