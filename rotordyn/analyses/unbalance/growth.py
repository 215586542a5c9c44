"""Ranges of unstable speeds, with ends solved for, and the fastest growth in each."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.steady import out_of_balance
from rotordyn.arrays import Array, Complex
from rotordyn.errors import NoSolution
from rotordyn.scene.scene import Scene
from rotordyn.scene.stability import fastest_growth, rank

CLOSE = 1e-9  # of a speed: tolerance of the ends of a range
NONE = -1e-12  # of |pole|: stands for growth 0 of an undamped motion


class Growth(NamedTuple):
    """``first`` and ``last`` speed (r,) [rad/s] of every range of unstable speeds, and the ``pole``
    (r,) [rad/s] of the most unstable mode there."""

    first: Array
    last: Array
    pole: Complex


def slowest_pole(scene: Scene, spec: UnbalanceSpec) -> Complex:
    """Return the pole (s,) of the fastest growing or slowest decaying motion of the subsystems out
    of balance; −∞ where nothing moves."""
    systems = [scene.system(k) for k in out_of_balance(scene, spec)]
    fastest = fastest_growth(systems, len(scene.usable))
    poles = [np.full((len(scene.usable), 1), -np.inf + 0j)]
    for motions in systems:
        pole = np.where(np.isnan(motions.pole), -np.inf, motions.pole)
        poles.append(np.minimum(pole.real, 0.0) + 1j * pole.imag)
    all_poles = np.concatenate(poles, axis=1)
    slowest = np.take_along_axis(all_poles, all_poles.real.argmax(axis=1)[:, None], axis=1)[:, 0]
    return np.where(fastest.real > 0.0, fastest, slowest)


def growth_of(scene: Scene, spec: UnbalanceSpec, speed: Array, pole: Complex) -> Growth:
    """Return the ranges of growth by the slowest ``pole`` (s,) at speeds (s,) in any order."""
    speed, order = np.unique(speed, return_index=True)
    pole = pole[order]
    steps = np.diff(np.pad((pole.real > 0.0).astype(int), 1))
    ends, fastest = [], []
    for first, last in zip(*(np.flatnonzero(steps == sign) for sign in (1, -1)), strict=True):
        begin, end = speed[first], speed[last - 1]
        if first:
            begin = _edge(scene, spec, speed[first - 1], begin)
        if last < len(speed):
            end = _edge(scene, spec, speed[last], end)
        ends.append((begin, end))
        inside = pole[first:last]
        fastest.append(inside[rank(inside, scene.fineness.frequency).argmax()])
    first_last = np.array(ends).reshape(-1, 2)
    return Growth(first_last[:, 0], first_last[:, 1], np.array(fastest, dtype=complex))


def _edge(scene: Scene, spec: UnbalanceSpec, calm: float, growing: float) -> float:
    """Return the speed at which growth begins, between a ``calm`` speed and a ``growing`` one; the
    latter if the machine has no state between them, or if only rounding separates them."""
    from scipy.optimize import brentq

    def growth(speed: float) -> float:
        solved = scene.at(np.array([speed]))
        if any(solved.outcome):
            raise NoSolution(f"no state at {speed:.6g} rad/s")
        pole = slowest_pole(solved, spec)[0]
        ratio = pole.real / abs(pole) if np.isfinite(pole) and pole else 0.0
        return float(ratio) if ratio > 0.0 else min(float(ratio), NONE)

    try:
        if not growth(calm) < 0.0 < growth(growing):
            return growing
        return float(brentq(growth, calm, growing, xtol=CLOSE * max(calm, growing)))
    except NoSolution:
        return growing
