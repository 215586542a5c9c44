#!/usr/bin/env python3
"""Flexible rings, time against error:  python -m benchmarks.ring_bodies

Outer ring of a bearing of 70 mm bore in a cartridge of 5 mm. The error is the largest of the shifts
of the groove under equal loads of all balls, at three contact angles, over the largest, against a
computation three times as fine. Then 49 states of the bearing at speed, rings rigid and elastic.
"""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

import numpy as np

import bearings.flexible_rings.computed as computed
import bearings.flexible_rings.section as sections
from bearings import AngularContactBallBearing, ElasticRing, FlexibleRings
from bearings.arrays import Array
from benchmarks.kept import keep

ANGLES = np.radians([10.0, 20.0, 30.0])
FINENESS = ((12.0, 20), (9.0, 30), (6.0, 40), (4.0, 60), (3.0, 80))  # step [°], harmonics
FINEST = (2.0, 120)
RUNS = 3
RINGS = FlexibleRings(
    ElasticRing(0.020, 0.070, 0.040), ElasticRing(0.020, 0.110, 0.120, ends="free")
)
BEARING = AngularContactBallBearing(
    ball_diameter=0.0119,
    pitch_diameter=0.090,
    balls=19,
    contact_angle=np.radians(20.0),
    rings=RINGS,
)


def deflection(step: float, harmonics: int) -> tuple[Array, float]:
    """Shifts (angles, balls, 2) of the outer groove under a unit load, and the time it took [s]."""
    assert RINGS.outer is not None
    usual = sections.STEP, computed.HARMONICS
    sections.STEP, computed.HARMONICS = np.radians(step), harmonics
    try:
        computed.compliance.cache_clear()
        begin = time.perf_counter()
        known = computed.compliance(replace(BEARING.grooves, rings=None), RINGS.outer, inner=False)
        spent = time.perf_counter() - begin
    finally:
        sections.STEP, computed.HARMONICS = usual
        computed.compliance.cache_clear()
    way = np.stack([np.sin(ANGLES), np.cos(ANGLES)], axis=-1)[:, None, None]
    way = np.broadcast_to(way, (len(ANGLES), BEARING.balls, 1, 2))
    load = np.ones(way.shape[:3])
    return known.shifts(way, load, 0.0 * load).shift[:, :, 0], spent


def measure() -> dict[str, Any]:
    """``bodies``: lines of ``step``, ``harmonics``, ``error``, ``seconds``; ``states``: seconds of
    49 states with rigid rings and with elastic ones, and the time of their bodies."""
    truth = deflection(*FINEST)[0]
    lines = []
    for step, harmonics in FINENESS:
        found = [deflection(step, harmonics) for _ in range(RUNS)]
        error = float(np.abs(found[0][0] - truth).max() / np.abs(truth).max())
        seconds = min(spent for _, spent in found)
        lines.append({"step": step, "harmonics": harmonics, "error": error, "seconds": seconds})
    return {"bodies": lines, "states": {"rigid": _states(None), "elastic": _states(RINGS)}}


def _states(rings: FlexibleRings | None) -> float:
    bearing, speed = replace(BEARING, rings=rings), np.linspace(0.0, 2000.0, 49)
    load = [800.0, 200.0, 0.0, 0.0, 0.0]
    bearing.equilibrium(load=load, speed=speed, compiled=False)  # bodies are computed once
    spent = []
    for _ in range(RUNS):
        begin = time.perf_counter()
        bearing.equilibrium(load=load, speed=speed, compiled=False)
        spent.append(time.perf_counter() - begin)
    return min(spent)


if __name__ == "__main__":
    measured = measure()
    print(measured)  # noqa: T201
    keep(ring_bodies=measured)
