"""Loads of the balls around a radially loaded ring, with an integral in place of the sum."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearings.debongnie.ball import HIGHEST, LOWEST, PowerLaw
from bearings.debongnie.equivalent import LIFE

Array = NDArray[np.float64]


class Distribution(NamedTuple):
    """Loads around a ring, each over Fc, of shape (…).

    ``zone`` θ0: half the angle of the loaded balls [rad]; ``inner_peak``: largest Qi; ``radial``:
    Fr/z; ``inner_mean``, ``outer_mean``: steady ball loads of the same life on either race.
    """

    zone: Array
    inner_peak: Array
    radial: Array
    inner_mean: Array
    outer_mean: Array


def distribution(peak: ArrayLike, law: PowerLaw, gap: float = 1.0) -> Distribution:
    """Loads of a ring whose most loaded ball has x = ``peak`` > 0, shape (…) (15 to 18, 31, 32).

    ``law`` may hold arrays that broadcast with ``peak``. ``gap`` > 0 is the displacement over δc
    at which the first ball is loaded: 1 without clearance, so that δc/δr = 1/(1 + peak);
    1 + clearance/(2 δc) with it.
    """
    x = np.asarray(peak, float)[..., None]
    nodes, weights = np.polynomial.legendre.leggauss(48)
    turn = (nodes + 1.0) * math.pi / 4.0  # θ = θ0 sin(turn): smooth where the load zone ends
    zone = np.arccos(gap / (gap + x))
    angle, weight = zone * np.sin(turn), weights / 4.0 * zone * np.cos(turn)
    each = PowerLaw(*(np.asarray(part)[..., None] for part in law))
    y = each(x - (x + gap) * 2.0 * np.sin(angle / 2.0) ** 2)
    outside = 1.0 - zone[..., 0] / math.pi
    return Distribution(
        zone=zone[..., 0],
        inner_peak=law(x[..., 0]),
        radial=np.sum(weight * y * np.cos(angle), axis=-1),
        inner_mean=np.sum(weight * y**3, axis=-1) ** (1.0 / 3.0),
        outer_mean=(np.sum(weight * (1.0 + y) ** LIFE, axis=-1) + outside) ** (1.0 / LIFE),
    )


def peak(radial: ArrayLike, law: PowerLaw, gap: float = 1.0) -> Array:
    """x of the most loaded ball under Fr/(z Fc) = ``radial``, shape (…).

    NaN where it lies outside ``LOWEST`` to ``HIGHEST``: the law of the ball is not meant there.
    """
    from scipy.optimize import elementwise

    wanted, factor, exponent = np.broadcast_arrays(np.asarray(radial, float), *law)
    ends = (np.full_like(wanted, math.log(end)) for end in (LOWEST, HIGHEST))
    found = elementwise.find_root(
        lambda u, f, a, n: distribution(np.exp(u), PowerLaw(a, n), gap).radial / f - 1.0,
        tuple(ends),
        args=(wanted, factor, exponent),
    )
    return np.where(found.success, np.exp(found.x), np.nan)
