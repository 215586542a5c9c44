"""The rotor of the flagship: cost of its FRF map, and what accuracy costs."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.processes import ROOT
from rotordyn.analysis import frf, stiffness
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import FrfSpec, StiffnessSpec
from rotordyn.case.case import Case
from rotordyn.system import lateral_rotor

Array = NDArray[np.float64]
LENGTHS = (16e-3, 12e-3, None, 8e-3, 6e-3, 4e-3)
FINEST = 1e-3
CUTOFFS = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0)
EVERYTHING = 1e9
FEW = (0, 24, 48)  # speeds at which accuracy is judged


def measure_frf() -> dict[str, Any]:
    """µs per speed and frequency, and the error of the modal sum."""
    case = _case()
    spec: Any = case.analyses["frf"]
    scene = _scene(case, None, None)
    found = _best(lambda: _rerun(scene, spec))
    points = len(case.speeds) * len(spec.frequencies)
    return {
        "speeds": len(case.speeds),
        "frequencies": len(spec.frequencies),
        "pairs": len(spec.pairs),
        "modes": 1e6 * scene.seconds["bending_modes"] / len(case.speeds),
        "point": 1e6 * found / points,
        "error": _modal_error(scene, spec),
    }


def element_lengths() -> list[dict[str, Any]]:
    """Error against 1 mm elements, beside the time of mesh, reduction, modes and map."""
    case = _case()
    state = _scene(case, None, None).preload
    exact = _answers(_scene(case, FINEST, state))
    lines = []
    for length in LENGTHS:
        scene = _scene(case, length, state)
        size = 2 * scene.mesh.nodes
        name = f"{1e3 * length:.0f} mm" if length else "default (1/50 of the shaft)"
        lines.append({"setting": name, "size": size, **_errors(scene, exact)})
    return lines


def cutoffs() -> list[dict[str, Any]]:
    """Error of the reduced basis against all modes of the same mesh."""
    case, standard = _case(), lateral_rotor.CUTOFF
    state = _scene(case, None, None).preload
    lines = []
    try:
        lateral_rotor.CUTOFF = EVERYTHING
        exact = _answers(_scene(case, None, state, FEW))
        for cutoff in CUTOFFS:
            lateral_rotor.CUTOFF = cutoff
            scene = _scene(case, None, state)
            name = f"{cutoff:g}" + (" (used)" if cutoff == standard else "")
            lines.append({"setting": name, "size": scene.rotor.size, **_errors(scene, exact)})
    finally:
        lateral_rotor.CUTOFF = standard
    return lines


def _case() -> Case:
    return rotordyn.load(ROOT / "cases" / "mfw2310.yaml")


def _scene(
    case: Case, length: float | None, preload: Any, speeds: Sequence[int] | None = None
) -> Scene:
    """The stages of the case; a preload state already known is taken over."""
    spindle, spec = case.spindle, case.analyses["frf"]
    if spindle is None or not isinstance(spec, FrfSpec):
        raise ValueError("the case has no spindle or asks for no map")
    ports = tuple(sorted({spindle.points[p.point] for pair in spec.pairs for p in pair}))
    scene = Scene(
        spindle,
        replace(case.conditions, element_length=length),
        np.array(case.speeds),
        max_frequency=4000.0,
        ports=ports,
    )
    if preload is not None:
        scene.solved["preload"] = preload
    scene.few = np.array(speeds if speeds is not None else range(len(case.speeds)))  # type: ignore[attr-defined]
    return scene
