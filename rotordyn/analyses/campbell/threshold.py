"""The speed from which some motion grows by itself, solved for.

What is led to zero is the largest growth of all modes of a system up to the highest frequency
followed: where two modes meet and part into one that grows and one that decays, no single one could
be followed there. A motion that grows without swinging, a divergence, is none of the followed modes
and counts as well.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.errors import NoSolution
from rotordyn.modes.band import Band
from rotordyn.modes.branches import MOTIONS, Branch, found_in
from rotordyn.numerics.modes import grows, swings
from rotordyn.scene.scene import Scene

DIVERGENCE = "a divergence"  # in place of a mode
CLOSE = 1e-10  # of the speed: it is known so well
ABOVE = 1e-6  # of the speed: what begins to grow has begun
ROUNDING = 1e-12  # of |pole|: growth that is none
HIGHER = 1.01  # than at the speeds beside: between them a mode may be so much


def stability_threshold(
    scene: Scene, band: Band, branches: Sequence[Branch], names: Sequence[str]
) -> tuple[float, str]:
    """Lowest speed [rad/s] of the case's range at which a followed mode begins to grow, and which,
    or ``DIVERGENCE``.

    Infinite and "" where none does; the first speed where one grows from there on.
    """

    def onset(subsystem: int, speed: Array, growing: Flags, known: Flags) -> float:
        row = int(growing.argmax())
        if row and known[row - 1]:
            low, high = float(speed[row - 1]), float(speed[row])
            return _begin(scene, subsystem, followed(subsystem, high), low, high)
        return float(speed[row])

    def followed(subsystem: int, speed: float) -> float:
        return _up_to(band, [each for each in branches if each.subsystem == subsystem], speed)

    onsets: list[tuple[float, str, int]] = []
    subsystems = {branch.subsystem for branch in branches}
    largest = {k: float(scene.system(k).modes.largest.max()) for k in subsystems}
    for branch, name in zip(branches, names, strict=True):
        track = branch.track
        growing = grows(track.pole, largest[branch.subsystem])
        if growing.any():
            begin = onset(branch.subsystem, track.speed, growing, ~track.lost)
            onsets.append((begin, name, branch.subsystem))
    for subsystem in scene.with_motions(MOTIONS):
        diverging = np.asarray(_diverging(scene.system(subsystem)).any(axis=1))
        if diverging.any():
            speed, known = scene.speed[scene.usable], np.ones_like(diverging)
            onsets.append((onset(subsystem, speed, diverging, known), DIVERGENCE, subsystem))
    if not onsets:
        return math.inf, ""
    first, name, subsystem = min(onsets)
    own = [(b, n) for b, n in zip(branches, names, strict=True) if b.subsystem == subsystem]
    return first, _grown(scene, subsystem, followed(subsystem, first), first, own) or name


def _up_to(band: Band, branches: Iterable[Branch], speed: float) -> float:
    """The highest frequency followed about a speed [rad/s]: that of the band, or of modes that
    leave it."""
    highest = band.highest
    for track in (branch.track for branch in branches):
        at = int(np.searchsorted(track.speed, speed))
        beside = track.pole.imag[max(at - 1, 0) : at + 1]
        highest = float(np.fmax.reduce(HIGHER * beside, initial=highest))
    return highest


def _grown(
    scene: Scene, subsystem: int, highest: float, speed: float, own: Sequence[tuple[Branch, str]]
) -> str:
    """Which mode of a subsystem, or ``DIVERGENCE``, grows most just above a speed: the one whose
    pole, straight between the speeds beside, is nearest; of several that grow farther up one has
    begun. Empty where there is no equilibrium."""
    above = min((1.0 + ABOVE) * speed, float(scene.speed[-1]))  # where tables of supports may end
    pole = _fastest(scene, subsystem, highest, above)
    if pole is None or not own:
        return ""
    if not swings(np.array([pole]))[0]:
        return DIVERGENCE

    def away(branch: Branch) -> float:
        track = branch.track
        known = ~track.lost
        if not known.any():
            return math.inf
        return float(abs(np.interp(speed, track.speed[known], track.pole[known]) - pole))

    return min((away(branch), name) for branch, name in own)[1]


def _diverging(motions: FreeMotions) -> Flags:
    """Motions (s, k) that grow without swinging."""
    return np.asarray(motions.growing & ~swings(motions.pole))


def _begin(scene: Scene, subsystem: int, highest: float, low: float, high: float) -> float:
    """Where the largest growth becomes positive between two speeds, by Brent's method, which finds
    jumps too: by loss factors growth changes its sign at once. Where there is no equilibrium on the
    way, the lowest speed known to grow."""
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
        ends = growth(low), growth(high)
        if not ends[0] < 0.0 < ends[1]:
            return low if ends[0] >= 0.0 else high
        return float(brentq(growth, low, high, xtol=CLOSE * high, rtol=CLOSE))
    except NoSolution:
        return min(growing)


def _growth(scene: Scene, subsystem: int, highest: float, speed: float) -> float:
    """Largest Re λ over |λ| of what swings below the ``highest`` frequency [rad/s] or diverges,
    below zero of a motion that rounding alone would let grow; NaN where there is no equilibrium."""
    pole = _fastest(scene, subsystem, highest, speed)
    if pole is None:
        return math.nan
    ratio = pole.real / abs(pole)
    return -ROUNDING if abs(ratio) <= ROUNDING else ratio


def _fastest(scene: Scene, subsystem: int, highest: float, speed: float) -> complex | None:
    """The pole of that motion, −1 where there is none; None without equilibrium."""
    other = scene.at(np.array([speed]))
    if any(other.outcome):
        return None
    motions = other.system(subsystem)
    inside = (found_in(motions, highest) | _diverging(motions))[0]
    pole = np.append(motions.pole[0][inside], -1.0)
    return complex(pole[(pole.real / np.abs(pole)).argmax()])
