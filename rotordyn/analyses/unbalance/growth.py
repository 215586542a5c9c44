"""Between which speeds motion grows by itself, each of them solved for, and how fast."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.steady import out_of_balance
from rotordyn.arrays import Array, Complex
from rotordyn.errors import NoSolution
from rotordyn.scene.scene import Scene
from rotordyn.scene.stability import fastest_growth, rank

CLOSE = 1e-9  # of a speed: it is known so well
NONE = -1e-12  # of |pole|: growth of motion that does not grow


class Growth(NamedTuple):
    """``first`` and ``last`` speed (r,) [rad/s] of every range of unstable ones, and the ``pole``
    (r,) [rad/s] of what grows fastest there."""

    first: Array
    last: Array
    pole: Complex


def slowest_pole(scene: Scene, spec: UnbalanceSpec) -> Complex:
    """Of the motion that grows fastest, or decays slowest, of what is out of balance (s,); −∞ where
    nothing moves."""
    systems = [scene.system(k) for k in out_of_balance(scene, spec)]
    fastest = fastest_growth(systems, len(scene.usable))
    poles = [np.full((len(scene.usable), 1), -np.inf + 0j)]
    for motions in systems:
        pole = np.where(np.isnan(motions.pole), -np.inf, motions.pole)
        poles.append(np.minimum(pole.real, 0.0) + 1j * pole.imag)
    every = np.concatenate(poles, axis=1)
    slowest = np.take_along_axis(every, every.real.argmax(axis=1)[:, None], axis=1)[:, 0]
    return np.where(fastest.real > 0.0, fastest, slowest)


def growth_of(scene: Scene, spec: UnbalanceSpec, speed: Array, pole: Complex) -> Growth:
    """Of the slowest ``pole`` (s,) at speeds (s,) in any order."""
    speed, order = np.unique(speed, return_index=True)
    pole = pole[order]
    steps = np.diff(np.pad((pole.real > 0.0).astype(int), 1))
    ends, fastest = [], []
    for first, last in zip(*(np.flatnonzero(steps == way) for way in (1, -1)), strict=True):
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
    """Where motion begins to grow between a speed at which none grows and one at which some does;
    the latter where the machine has no state on the way, and where rounding alone tells which."""
    from scipy.optimize import brentq

    def growth(speed: float) -> float:
        other = scene.at(np.array([speed]))
        if any(other.outcome):
            raise NoSolution(f"no state at {speed:.6g} rad/s")
        pole = slowest_pole(other, spec)[0]
        ratio = pole.real / abs(pole) if np.isfinite(pole) and pole else 0.0
        return float(ratio) if ratio > 0.0 else min(float(ratio), NONE)

    try:
        if not growth(calm) < 0.0 < growth(growing):
            return growing
        return float(brentq(growth, calm, growing, xtol=CLOSE * max(calm, growing)))
    except NoSolution:
        return growing
