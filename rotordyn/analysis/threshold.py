"""The speed from which some motion grows by itself, solved for.

What is led to zero is the largest growth of all modes of a system: where two modes meet and part
into one that grows and one that decays, no single one could be followed there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.branches import MARGIN, Branch, home_of, modes_of
from rotordyn.analysis.certificate import swings
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec
from rotordyn.numerics.modes import NEUTRAL

Array = NDArray[np.float64]
CLOSE = 1e-10  # of the speed: it is known so well
ITERATIONS = 60


def stability_threshold(
    scene: Scene, spec: CampbellSpec, branches: Sequence[Branch], names: Sequence[str]
) -> tuple[float, str]:
    """Lowest speed [rad/s] of the case's range at which a followed mode begins to grow, and which.

    Infinite and "" where none does; the first speed where one grows from there on.
    """
    found = [(math.inf, "")]
    for branch, name in zip(branches, names, strict=True):
        track, speed = branch.track, branch.track.speed
        growing = track.pole.real > NEUTRAL * np.abs(track.pole)
        if not growing.any():
            continue
        row = int(growing.argmax())
        begin = float(speed[row])
        if row and not track.lost[row - 1]:
            home = home_of(scene, branch.kind)
            begin = _begin(scene, spec, home, float(speed[row - 1]), begin)
        found.append((begin, name))
    return min(found)


def _begin(scene: Scene, spec: CampbellSpec, home: str, low: float, high: float) -> float:
    """Where the largest growth becomes positive between two speeds, by false position; each time
    that one end stays its weight is halved (Dowell & Jarratt, BIT 11 (1971) 168)."""
    ends, growth = [low, high], [_growth(scene, spec, home, x) for x in (low, high)]
    if not growth[0] < 0.0 < growth[1]:
        return low if growth[0] >= 0.0 else high
    last = -1
    for _ in range(ITERATIONS):
        if ends[1] - ends[0] <= CLOSE * ends[1] or not math.isfinite(growth[last]):
            break
        at = ends[0] + (ends[1] - ends[0]) * growth[0] / (growth[0] - growth[1])
        at = float(np.clip(at, ends[0] + 0.1 * CLOSE * ends[1], ends[1] - 0.1 * CLOSE * ends[1]))
        value = _growth(scene, spec, home, at)
        side = int(value > 0.0)
        if side == last:
            growth[1 - side] *= 0.5
        ends[side], growth[side], last = at, value, side
    return ends[1]


def _growth(scene: Scene, spec: CampbellSpec, home: str, speed: float) -> float:
    """Largest Re λ over |λ| of what swings in the band; none where there is no equilibrium."""
    other = scene.at(np.array([speed]))
    if any(other.outcome):
        return math.nan
    modes = modes_of(other, home, spec.max_frequency)
    frame = other.bending.frame if home == "bending" else np.zeros(1)
    pole = modes.pole[0] + 1j * frame[0]
    inside = np.abs(pole.imag) < 2.0 * math.pi * MARGIN * spec.max_frequency
    inside &= swings(pole, np.abs(pole.imag)) & ~modes.at_rest(frame)[0]
    return float((pole.real / np.abs(pole))[inside].max(initial=-1.0))
