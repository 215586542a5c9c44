"""The least depth of cut at which the largest multiplier leaves the unit circle.

Depths are tried from one that is stable for certain, in ratios small beside the width of lobes; at
every maximum of the radius that stays inside, its height is refined, so that an island of
instability between two depths tried is not passed over.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

Radius = Callable[[float], float]
RATIO = 1.25  # of depths tried
SHORTEST = 0.01  # of the depth between depths tried: over many pitches of a helix forces are even
EVEN = 200.0  # steps: 10 axial pitches, over which forces pulse by 1/(10 π); ratios are tried first
PULSING = 0.05  # of the depth, by which pulsing forces move a limit at most
NEAR = 0.8  # a maximum of the radius below that is not refined
DOUBTFUL = 0.02  # of 1: so near, the radius of a coarse map does not tell which side
WITHIN = 1e-8  # of the depth
ROUGH = 1e-3  # of the depth by a coarse map
PEAK = 1e-3  # of the logarithm of the depth
AROUND = (1e-3, 0.03)  # of the depth, by which a coarse map usually errs, and may err


def first_loss(coarse: Radius, fine: Radius, low: float, high: float, step: float) -> float:
    """Depth [m] from ``low``, which is stable, to ``high``; infinite where all is stable.

    ``coarse``: radius over depth of a quick map, by which depths are tried; ``fine``: of the map
    that gives the depth. ``step``: longest step [m] between depths tried, up to a hundred of
    it. 0 where the machine is unstable by itself.
    """
    coarse, fine = cache(coarse), cache(fine)
    if fine(low) >= 1.0:
        return 0.0
    guess = _tried(coarse, low, high, step, ROUGH, DOUBTFUL)
    if math.isinf(guess):
        return guess
    for share in AROUND if guess > 0.0 else ():
        ends = max((1.0 - share) * guess, low), min((1.0 + share) * guess, high)
        if fine(ends[0]) < 1.0 <= fine(ends[1]):
            return _root(fine, *ends, WITHIN)
    return _tried(fine, low, high, step, WITHIN)


def _tried(
    radius: Radius, low: float, high: float, step: float, within: float, doubtful: float = 0.0
) -> float:
    """The least depth at which the radius is 1, ``within`` of it, 0 where it is larger at the first
    one; NaN where a maximum is nearer to 1 than ``doubtful``."""
    depth = [low]
    while radius(depth[-1]) < 1.0 and depth[-1] < high:
        depth.append(min(depth[-1] * RATIO, depth[-1] + _further(depth[-1], step), high))
    if radius(depth[-1]) >= 1.0 and len(depth) > 1 and depth[-1] > EVEN * step:
        depth = _finely(radius, depth, step)
    size, doubt = [radius(each) for each in depth], False
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


def _further(depth: float, step: float) -> float:
    """To the next depth tried."""
    return math.inf if depth > EVEN * step else max(step, SHORTEST * depth)


def _finely(radius: Radius, depth: list[float], step: float) -> list[float]:
    """Depths tried, of which the last is unstable, with small steps before that one."""
    last = depth[-1]
    found = [each for each in depth if each < (1.0 - PULSING) * depth[-2]] or depth[:1]
    fine = max(found[-1], (1.0 - PULSING) * depth[-2])
    while radius(fine) < 1.0:
        found.append(fine)
        fine = min(fine + max(step, SHORTEST * fine), last)
    return [*found, fine]


def _peak(radius: Radius, low: float, high: float) -> float:
    """Where the radius is largest between two depths."""
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(
        lambda own: -radius(math.exp(own)),
        bounds=(math.log(low), math.log(high)),
        method="bounded",
        options={"xatol": PEAK},
    )
    return math.exp(float(found.x))


def _root(radius: Radius, low: float, high: float, within: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(lambda own: math.log(radius(own)), low, high, rtol=within, xtol=1e-15))
