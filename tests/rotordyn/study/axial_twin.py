"""A spindle whose axial load test is known, with noise and tare."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rotordyn import AxialCurve, Unknown
from rotordyn.case.case import Case
from rotordyn.study.identification.along_axis import RPM
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.trial import Known
from rotordyn.study.identification.unknown import sought

Array = np.ndarray[Any, np.dtype[np.float64]]
STUDIES = Path(__file__).parents[3] / "cases" / "identification"
FRONT, REAR = "spindle.sleeves.front.", "spindle.sleeves.rear."
SPRINGS = {
    FRONT + "spring.preload": Unknown("100 N", "1050 N", start="500 N", name="P1"),
    REAR + "spring.preload": Unknown("150 N", "1100 N", start="600 N", name="P2"),
    FRONT + "stop_travel": Unknown("20 um", "100 um", start="60 um", name="stop"),
    FRONT + "friction": Unknown("0 N", "200 N", start="60 N", name="friction"),
}
TRUE = np.array([574.0, 528.0, 52.2e-6, 80.9])
SPEEDS = (4000.0 * RPM, 20000.0 * RPM)
KNOWN = Known()  # tables of bearings, the same in all twins


def curve(of: str, displacement: Array | None = None, points: int = 9, **given: Any) -> AxialCurve:
    """Both branches at two speeds."""
    force = np.linspace(-1700.0, 1800.0, points)
    along = np.tile(np.concatenate([force[::-1], force]), 2)
    branch = tuple(np.tile(np.repeat(("falling", "rising"), points), 2).tolist())
    speed = np.repeat(SPEEDS, 2 * points)
    values = 0.0 * along if displacement is None else displacement
    usual: dict[str, Any] = dict(name=of, of=of, deviation=0.4e-6, tare=1e-6)
    return AxialCurve(**usual | given, speed=speed, branch=branch, force=along, displacement=values)


def twin(
    case: Case, seed: int, asked: Mapping[str, Unknown] = SPRINGS, true: Array = TRUE
) -> Problem:
    """A problem whose measurements are those of the machine with ``true`` values, with noise."""
    rng = np.random.default_rng(seed)
    still = Problem(case, sought(case, asked), (curve("shaft"), curve("rear")), known=KNOWN)
    found = still.predicted(true)
    assert found is not None
    noisy = []
    for each, exact in zip(still.measurements, found, strict=True):
        tare = np.repeat(rng.normal(0.0, 1e-6, 2), len(exact) // 2)
        noisy.append(curve(each.data.name, exact + tare + rng.normal(0.0, 0.4e-6, len(exact))))
    return replace(still, measurements=tuple(noisy))
