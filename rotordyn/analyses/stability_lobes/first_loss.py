"""Least depth of cut at which the largest multiplier leaves the unit circle.

Depths are tried from one that is certainly stable, in ratios small against the width of lobes; at
every maximum of the spectral radius below 1 its height is refined, so that an island of instability
between two depths tried is not skipped.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

Radius = Callable[[float], float]
RATIO = 1.25  # of successive depths tried
SHORTEST = 0.01  # of the depth: least step, since over many pitches of a helix forces are even
EVEN = 200.0  # steps: 10 axial pitches, over which forces pulse by 1/(10 π); ratios are tried first
PULSING = 0.05  # of the depth: largest change of a limit by pulsing forces
NEAR = 0.8  # a maximum of the radius below this is not refined
DOUBTFUL = 0.02  # distance of the radius from 1 within which a coarse map may err in stability
WITHIN = 1e-8  # of the depth: tolerance
ROUGH = 1e-3  # of the depth: tolerance by a coarse map
PEAK = 1e-3  # of the logarithm of the depth: tolerance
AROUND = (1e-3, 0.03)  # of the depth: usual and possible error of a coarse map


def first_loss(coarse: Radius, fine: Radius, low: float, high: float, step: float) -> float:
    """Return the depth [m] of the first loss from ``low``, which is stable, to ``high``; infinite
    where all depths are stable, 0 where the machine is unstable without a cut.

    ``coarse``: spectral radius over depth of a quick map, by which depths are tried; ``fine``: of
    the map that gives the depth. ``step``: longest step [m] up to depths of ``EVEN`` steps.
    """
    coarse, fine = cache(coarse), cache(fine)
    if fine(low) >= 1.0:
        return 0.0
    guess = _search(coarse, low, high, step, ROUGH, DOUBTFUL)
    if math.isinf(guess):
        return guess
    for share in AROUND if guess > 0.0 else ():
        ends = max((1.0 - share) * guess, low), min((1.0 + share) * guess, high)
        if fine(ends[0]) < 1.0 <= fine(ends[1]):
            return _root(fine, *ends, WITHIN)
    return _search(fine, low, high, step, WITHIN)


def _search(
    radius: Radius, low: float, high: float, step: float, within: float, doubtful: float = 0.0
) -> float:
    """Return the least depth at which the radius is 1, to a relative tolerance ``within``; 0 where
    it is above 1 at ``low``; NaN where a maximum is nearer to 1 than ``doubtful``; infinite if it
    stays below 1 up to ``high``."""
    depth = [low]
    while radius(depth[-1]) < 1.0 and depth[-1] < high:
        depth.append(min(depth[-1] * RATIO, depth[-1] + _longest_step(depth[-1], step), high))
    if radius(depth[-1]) >= 1.0 and len(depth) > 1 and depth[-1] > EVEN * step:
        depth = _refined(radius, depth, step)
    size, doubt = [radius(value) for value in depth], False
    for k in range(1, len(depth) - 1):
        if NEAR < size[k] < 1.0 and size[k] >= max(size[k - 1], size[k + 1]):
            top = _peak(radius, depth[k - 1], depth[k + 1])
            if radius(top) >= 1.0:
                return _root(radius, depth[k - 1], top, within)
            doubt |= radius(top) > 1.0 - doubtful
    if size[0] >= 1.0:
        return 0.0
    if doubt:
        return math.nan
    return _root(radius, depth[-2], depth[-1], within) if size[-1] >= 1.0 else math.inf


def _longest_step(depth: float, step: float) -> float:
    """Return the longest step to the next depth tried."""
    return math.inf if depth > EVEN * step else max(step, SHORTEST * depth)


def _refined(radius: Radius, depth: list[float], step: float) -> list[float]:
    """Refine the depths tried, of which the last one is unstable, by small steps before it."""
    last = depth[-1]
    refined = [value for value in depth if value < (1.0 - PULSING) * depth[-2]] or depth[:1]
    fine = max(refined[-1], (1.0 - PULSING) * depth[-2])
    while radius(fine) < 1.0:
        refined.append(fine)
        fine = min(fine + max(step, SHORTEST * fine), last)
    return [*refined, fine]


def _peak(radius: Radius, low: float, high: float) -> float:
    """Return the depth between two depths at which the radius is largest."""
    from scipy.optimize import minimize_scalar

    optimum = minimize_scalar(
        lambda log_depth: -radius(math.exp(log_depth)),
        bounds=(math.log(low), math.log(high)),
        method="bounded",
        options={"xatol": PEAK},
    )
    return math.exp(float(optimum.x))


def _root(radius: Radius, low: float, high: float, within: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(lambda depth: math.log(radius(depth)), low, high, rtol=within, xtol=1e-15))
