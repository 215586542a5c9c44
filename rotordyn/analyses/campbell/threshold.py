"""Stability threshold: the speed from which some motion grows.

It is the zero of the largest growth of all modes of a system up to the highest frequency followed:
where two modes coalesce and split into a growing and a decaying one, no single one can be followed.
A divergence, which grows without oscillation, is none of the followed modes and counts as well.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.errors import NoSolution
from rotordyn.modes.branches import MOTIONS, Branch, found_in
from rotordyn.numerics.modes import grows, oscillates
from rotordyn.scene.scene import Scene

DIVERGENCE = "a divergence"  # in place of a mode
CLOSE = 1e-10  # of the speed: tolerance of the threshold
ABOVE = 1e-6  # of the speed: beyond the threshold by this much a motion grows
ROUNDING = 1e-12  # of |pole|: smaller growth counts as zero
HIGHER = 1.01  # highest frequency followed between two speeds, over that of the mode at them


class Threshold(NamedTuple):
    """``speed`` [rad/s] from which a motion grows, infinite without one; ``is_bound`` where it
    already grows at the lowest speed at which it is solved, which only bounds the threshold;
    ``name`` of the mode, ``DIVERGENCE``, or ""."""

    speed: float
    is_bound: bool = False
    name: str = ""


def stability_threshold(
    scene: Scene, highest: float, branches: Sequence[Branch], names: Sequence[str]
) -> Threshold:
    """Return the lowest speed of the case's range at which a mode followed up to the ``highest``
    angular frequency [rad/s] begins to grow."""

    def begin_at(subsystem: int, speed: Array, growing: Flags, valid: Flags) -> tuple[float, bool]:
        row = int(growing.argmax())
        if row and valid[row - 1]:
            low, high = float(speed[row - 1]), float(speed[row])
            return _onset(scene, subsystem, followed(subsystem, high), low, high)
        return float(speed[row]), bool(speed[row] > 0.0)

    def followed(subsystem: int, speed: float) -> float:
        return _highest(highest, [each for each in branches if each.subsystem == subsystem], speed)

    onsets: list[tuple[float, bool, str, int]] = []
    subsystems = {branch.subsystem for branch in branches}
    largest = {k: float(scene.system(k).modes.largest.max()) for k in subsystems}
    for branch, name in zip(branches, names, strict=True):
        track = branch.track
        growing = grows(track.pole, largest[branch.subsystem])
        if growing.any():
            begin = begin_at(branch.subsystem, track.speed, growing, ~track.lost)
            onsets.append((*begin, name, branch.subsystem))
    for subsystem in scene.with_motions(MOTIONS):
        diverging = np.asarray(_diverging(scene.system(subsystem)).any(axis=1))
        if diverging.any():
            speed, known = scene.speed[scene.usable], np.ones_like(diverging)
            begin = begin_at(subsystem, speed, diverging, known)
            onsets.append((*begin, DIVERGENCE, subsystem))
    if not onsets:
        return Threshold(math.inf)
    first, is_bound, name, subsystem = min(onsets)
    members = [(b, n) for b, n in zip(branches, names, strict=True) if b.subsystem == subsystem]
    fastest = _unstable(scene, subsystem, followed(subsystem, first), first, members)
    return Threshold(first, is_bound, fastest or name)


def _highest(highest: float, branches: Iterable[Branch], speed: float) -> float:
    """Return the highest frequency followed near a speed [rad/s]: that given, or of modes that
    exceed it."""
    for track in (branch.track for branch in branches):
        row = int(np.searchsorted(track.speed, speed))
        adjacent = track.pole.imag[max(row - 1, 0) : row + 1]
        highest = float(np.fmax.reduce(HIGHER * adjacent, initial=highest))
    return highest


def _unstable(
    scene: Scene, subsystem: int, highest: float, speed: float, modes: Sequence[tuple[Branch, str]]
) -> str:
    """Return the mode of a subsystem, or ``DIVERGENCE``, that grows most just above a speed: the
    one whose pole, interpolated over speed, is nearest to the fastest growing pole there, since
    several modes may grow farther up. Empty where there is no equilibrium."""
    above = min((1.0 + ABOVE) * speed, float(scene.speed[-1]))  # where tables of supports may end
    pole = _fastest_pole(scene, subsystem, highest, above)
    if pole is None or not modes:
        return ""
    if not oscillates(np.array([pole]))[0]:
        return DIVERGENCE

    def distance(branch: Branch) -> float:
        track = branch.track
        valid = ~track.lost
        if not valid.any():
            return math.inf
        return float(abs(np.interp(speed, track.speed[valid], track.pole[valid]) - pole))

    return min((distance(branch), name) for branch, name in modes)[1]


def _diverging(motions: FreeMotions) -> Flags:
    """Return which motions (s, k) grow without oscillation."""
    return np.asarray(motions.growing & ~oscillates(motions.pole))


def _onset(
    scene: Scene, subsystem: int, highest: float, low: float, high: float
) -> tuple[float, bool]:
    """Return the speed between two at which the largest growth becomes positive, by Brent's method,
    which locates jumps too: with loss factors growth changes its sign abruptly. Where there is no
    equilibrium in between, return the lowest speed at which growth is positive, and that it is a
    bound."""
    from scipy.optimize import brentq

    growing = [high]

    def growth(speed: float) -> float:
        value = _growth(scene, subsystem, highest, speed)
        if not math.isfinite(value):
            raise NoSolution(f"no equilibrium at {speed:.6g} rad/s")
        if value > 0.0:
            growing.append(speed)
        return value

    try:
        values = growth(low), growth(high)
        if not values[0] < 0.0 < values[1]:
            # growth jumped, or is rounding, at one end
            return low if values[0] >= 0.0 else high, False
        return float(brentq(growth, low, high, xtol=CLOSE * high, rtol=CLOSE)), False
    except NoSolution:
        return min(growing), True


def _growth(scene: Scene, subsystem: int, highest: float, speed: float) -> float:
    """Return the largest Re λ / |λ| of motions that oscillate below the ``highest`` frequency
    [rad/s] or diverge; negative where it is rounding alone, NaN where there is no equilibrium."""
    pole = _fastest_pole(scene, subsystem, highest, speed)
    if pole is None:
        return math.nan
    ratio = pole.real / abs(pole)
    return -ROUNDING if abs(ratio) <= ROUNDING else ratio


def _fastest_pole(scene: Scene, subsystem: int, highest: float, speed: float) -> complex | None:
    """Return the pole of largest Re λ / |λ| as in ``_growth``, −1 where no motion is below the
    ``highest`` frequency [rad/s] or diverges; None without equilibrium."""
    other = scene.at(np.array([speed]))
    if any(other.outcome):
        return None
    motions = other.system(subsystem)
    inside = (found_in(motions, highest) | _diverging(motions))[0]
    pole = np.append(motions.pole[0][inside], -1.0)
    return complex(pole[(pole.real / np.abs(pole)).argmax()])
