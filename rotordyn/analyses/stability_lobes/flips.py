"""Period doubling between the speeds at which limits are solved.

It limits the cut near speeds at which a mode makes k + ½ waves in a tooth period, over a relative
range of speeds that is a small part of its damping ratio, so that steps between speeds miss it.
Its depths follow from one eigenvalue problem, with the modes of the nearest solved speed.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import ZERO_ORDER
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.arrays import Array, Flags

# offsets of waves from k + ½, in damping ratios: where the limit is least, there are fewer waves
# along the normal in down-milling and more along the feed, the offset larger at small immersion
BESIDE = np.arange(-6.0, 6.0 + 1e-9, 0.5)
NEARER = np.array([-3, -2, -1, 1, 2, 3]) / 8.0  # offsets about that of the least depth
FINER = 8  # points from one offset to the next at which steps are searched
# of a depth, for an offset of one damping ratio: of modes that give nearly the same depth, the
# nearest one gives its speed best
ALIKE = 0.005
FINE = 0.25  # of the damping ratio: shorter steps do not miss it
LOBE = 0.5  # waves from one speed to the next: with more, lobes themselves are missed
SAME = 0.05  # of its frequency: largest change of a mode from one speed to the next


class Flips(NamedTuple):
    """Least ``depth`` [m] of period doubling between every speed and the next one, and its
    ``speed`` [rad/s] (s,); NaN where no mode makes k + ½ waves."""

    depth: Array
    speed: Array


def flips(limits: Limits, operation: Operation) -> Flips:
    """Return period doubling of evenly spaced teeth with straight edges, on a tip that is a sum of
    modes; of others, and by zero order, all NaN."""
    speed = limits.speed
    result = Flips(np.full(len(speed), np.nan), np.full(len(speed), np.nan))
    spec, tip = operation.spec, limits.tip
    if spec.method == ZERO_ORDER or spec.turning or spec.helix or not operation.cut.even:
        return result
    if not isinstance(tip, Tip) or tip.modes is None:
        return result
    pole = tip.high_poles[limits.rows]
    hertz, ratio = pole.imag / (2.0 * math.pi), -pole.real / np.abs(pole)
    turn = operation.cut.turn
    waves = hertz * turn / speed[:, None]
    with np.errstate(invalid="ignore"):
        wide = np.diff(speed)[:, None] > FINE * ratio[:-1] * speed[:-1, None]
        wide &= (waves[1:] < waves[:-1]) & (waves[:-1] - waves[1:] < LOBE)
        wide &= np.abs(np.diff(hertz, axis=0)) < SAME * hertz[:-1]
    least = np.full(len(speed), np.inf)
    for mode in np.flatnonzero(wide.any(axis=0)).tolist():
        steps = _Steps(speed, hertz[:, mode], waves[:, mode], wide[:, mode], turn)
        for order in steps.orders(BESIDE[-1] * float(np.nanmax(ratio[:, mode]))):

            def depth(count: float, mode: int = mode) -> float:
                """Return the depth where ``mode`` makes ``count`` waves, by the nearest speed."""
                row = int(np.nanargmin(np.abs(waves[:, mode] - count)))
                speed = float(hertz[row, mode]) * turn / count
                return _doubling(tip, int(limits.rows[row]), operation, speed)

            damping = float(ratio[np.nanargmin(np.abs(waves[:, mode] - order)), mode])
            for value, count in _least(order, damping, depth, steps):
                place, at = steps.at(count)
                penalized = value * (1.0 + ALIKE * abs(count / order - 1.0) / damping)
                if penalized < least[place]:
                    least[place] = penalized
                    result.depth[place], result.speed[place] = value, at
    return result


def _least(
    order: float, ratio: float, depth: Callable[[float], float], steps: _Steps
) -> Iterator[tuple[float, float]]:
    """Yield depths [m] and numbers of waves within the steps, near the least depths of a mode: the
    least of all, and the least within the steps."""

    def at(offset: Array) -> tuple[Array, Array, Flags]:
        waves = order * (1.0 + ratio * offset)
        depths = np.array([depth(count) for count in waves.tolist()])
        return waves, depths, np.array([steps.hold(count) for count in waves.tolist()], dtype=bool)

    waves = order * (1.0 + ratio * BESIDE)
    if not any(steps.hold(count) for count in np.linspace(waves[0], waves[-1], FINER * len(waves))):
        return
    waves, depths, inside = at(BESIDE)
    centres = {int(depths.argmin())}
    if inside.any():
        centres.add(int(np.where(inside, depths, math.inf).argmin()))
    yield from zip(depths[inside].tolist(), waves[inside].tolist(), strict=True)
    for centre in centres:
        waves, depths, inside = at(BESIDE[centre] + NEARER)
        yield from zip(depths[inside].tolist(), waves[inside].tolist(), strict=True)


class _Steps(NamedTuple):
    """Steps between speeds [rad/s] (s,) that may miss period doubling by one mode, of frequency
    ``hertz`` (s,), which makes ``waves`` (s,) in a tooth period, of the angle ``turn`` [rad];
    ``wide`` (s − 1,): which steps may."""

    speed: Array
    hertz: Array
    waves: Array
    wide: Flags
    turn: float

    def orders(self, reach: float) -> Array:
        """Return all k + ½ among the waves of the steps, or within ``reach`` of them, relative."""
        ends = self.waves[:-1][self.wide], self.waves[1:][self.wide]
        low, high = ends[1].min() / (1.0 + reach), ends[0].max() / max(1.0 - reach, 0.5)
        return np.arange(max(math.ceil(low - 0.5), 0), math.floor(high - 0.5) + 1) + 0.5

    def _steps_with(self, waves: float) -> Flags:
        return np.asarray(self.wide & (self.waves[1:] < waves) & (waves <= self.waves[:-1]))

    def hold(self, waves: float) -> bool:
        """Return whether the mode makes that number of waves within some step."""
        return bool(self._steps_with(waves).any())

    def at(self, waves: float) -> tuple[int, float]:
        """Return the step in which the mode makes that number of waves, and its speed [rad/s]."""
        k = int(self._steps_with(waves).argmax())
        slope = (self.hertz[k + 1] - self.hertz[k]) / (self.speed[k + 1] - self.speed[k])
        return k, (self.hertz[k] - slope * self.speed[k]) / (waves / self.turn - slope)


def _doubling(tip: Tip, row: int, operation: Operation, speed: float) -> float:
    """Return the least depth of period doubling [m] at a speed, by the modes of a ``row``."""
    assert tip.modes is not None
    floquet = operation.process(speed).floquet(tip.modes.at(row), float(tip.tops[row]), 0.0)
    return floquet.repeating(-1.0)
