"""Between which speeds motion grows by itself on runs, and how fast."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.steady import out_of_balance
from rotordyn.arrays import Array, Complex
from rotordyn.numerics.crossing import above_zero
from rotordyn.scene.scene import Scene


class Growth(NamedTuple):
    """``first`` and ``last`` speed (r,) [rad/s] of every range of unstable ones, and the ``pole``
    (r,) [rad/s] of what grows fastest there."""

    first: Array
    last: Array
    pole: Complex


def slowest_pole(scene: Scene, spec: UnbalanceSpec) -> Complex:
    """Of the motion that grows fastest, or decays slowest, of what is out of balance (s,); −∞ where
    nothing moves."""
    poles = [np.full((len(scene.usable), 1), -np.inf + 0j)]
    for motions in (scene.system(k) for k in out_of_balance(scene, spec)):
        pole = np.where(np.isnan(motions.pole), -np.inf, motions.pole)
        poles.append(np.where(motions.growing, pole, np.minimum(pole.real, 0.0) + 1j * pole.imag))
    every = np.concatenate(poles, axis=1)
    return np.asarray(np.take_along_axis(every, every.real.argmax(axis=1)[:, None], axis=1)[:, 0])


def growth_of(speed: Array, pole: Complex) -> Growth:
    """Of the slowest ``pole`` (s,) at speeds (s,) in any order."""
    speed, order = np.unique(speed, return_index=True)
    pole = pole[order]
    spans = above_zero(speed, pole.real)
    inside = [pole[(first <= speed) & (speed <= last)] for first, last in spans]
    fastest = [each[each.real.argmax()] for each in inside]
    return Growth(spans[:, 0], spans[:, 1], np.array(fastest, dtype=complex))
