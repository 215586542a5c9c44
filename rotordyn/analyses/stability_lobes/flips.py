"""Period doubling between the speeds at which limits are solved.

It limits near where a mode makes k + ½ waves in a period of the teeth, over a range of speeds that
is a small part of its damping ratio wide, so that steps between speeds pass it over. There depths
of period doubling are those of one eigenvalue problem, with the modes of the nearest speed solved.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import ZERO_ORDER
from rotordyn.analyses.stability_lobes.tip import Tip

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
# damping ratios by which waves may be off k + ½: along the normal in down-milling there are fewer
# where the limit is least, along the feed more, the farther the smaller the immersion
BESIDE = np.arange(-6.0, 6.0 + 1e-9, 0.5)
NEARER = np.array([-3, -2, -1, 1, 2, 3]) / 8.0  # about the least depth of these
FINER = 8  # places from one to the next at which steps are looked for
# of a depth for every damping ratio: of modes that lead to nearly the same one the nearest knows
# its speed best
ALIKE = 0.005
FINE = 0.25  # of the damping ratio: shorter steps do not pass it over
LOBE = 0.5  # waves from one speed to the next: of more, lobes themselves are passed over
SAME = 0.05  # of its frequency: by which a mode changes from one speed to the next


class Flips(NamedTuple):
    """Of every speed the least ``depth`` [m] of period doubling on the way to the next one, and the
    ``speed`` [rad/s] there (s,); NaN where no mode makes k + ½ waves."""

    depth: Array
    speed: Array


def flips(limits: Limits, operation: Operation) -> Flips:
    """Of evenly spaced teeth with straight edges, on a tip that is a sum of modes; of others, and
    by zero order, none are looked for."""
    speed = limits.speed
    found = Flips(np.full(len(speed), np.nan), np.full(len(speed), np.nan))
    spec, tip = operation.spec, limits.tip
    if spec.method == ZERO_ORDER or spec.turning or spec.helix or not operation.cut.even:
        return found
    if not isinstance(tip, Tip) or tip.modes is None:
        return found
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

            def depth(own: float, mode: int = mode) -> float:
                """By the modes of the nearest speed, where one of them makes as many waves."""
                row = int(np.nanargmin(np.abs(waves[:, mode] - own)))
                waving = float(hertz[row, mode]) * turn / own
                return _doubling(tip, int(limits.rows[row]), operation, waving)

            damping = float(ratio[np.nanargmin(np.abs(waves[:, mode] - order)), mode])
            for each, own in _least(order, damping, depth, steps):
                place, where = steps.at(own)
                judged = each * (1.0 + ALIKE * abs(own / order - 1.0) / damping)
                if judged < least[place]:
                    least[place] = judged
                    found.depth[place], found.speed[place] = each, where
    return found


def _least(
    order: float, ratio: float, depth: Callable[[float], float], steps: _Steps
) -> Iterator[tuple[float, float]]:
    """Depths [m] and waves within the steps, near those at which a mode is least stable: about the
    least of all, and about the least within the steps."""

    def at(beside: Array) -> tuple[Array, Array, Flags]:
        own = order * (1.0 + ratio * beside)
        depths = np.array([depth(each) for each in own.tolist()])
        return own, depths, np.array([steps.hold(each) for each in own.tolist()], dtype=bool)

    own = order * (1.0 + ratio * BESIDE)
    if not any(steps.hold(each) for each in np.linspace(own[0], own[-1], FINER * len(own))):
        return
    own, depths, inside = at(BESIDE)
    middles = {int(depths.argmin())}
    if inside.any():
        middles.add(int(np.where(inside, depths, math.inf).argmin()))
    yield from zip(depths[inside].tolist(), own[inside].tolist(), strict=True)
    for middle in middles:
        own, depths, inside = at(BESIDE[middle] + NEARER)
        yield from zip(depths[inside].tolist(), own[inside].tolist(), strict=True)


class _Steps(NamedTuple):
    """Steps between speeds [rad/s] (s,) that may pass period doubling over by one mode, of
    ``hertz`` (s,), which makes ``waves`` (s,) in a period of the teeth that ``turn`` by so much;
    ``wide`` (s − 1,): which steps."""

    speed: Array
    hertz: Array
    waves: Array
    wide: Flags
    turn: float

    def orders(self, reach: float) -> Array:
        """All k + ½ that lie among the waves of the steps, or so far from them, relative."""
        ends = self.waves[:-1][self.wide], self.waves[1:][self.wide]
        low, high = ends[1].min() / (1.0 + reach), ends[0].max() / max(1.0 - reach, 0.5)
        return np.arange(max(math.ceil(low - 0.5), 0), math.floor(high - 0.5) + 1) + 0.5

    def _within(self, waves: float) -> Flags:
        return np.asarray(self.wide & (self.waves[1:] < waves) & (waves <= self.waves[:-1]))

    def hold(self, waves: float) -> bool:
        """Whether the mode makes so many within some step."""
        return bool(self._within(waves).any())

    def at(self, waves: float) -> tuple[int, float]:
        """The step within which it does, and the speed there."""
        k = int(self._within(waves).argmax())
        slope = (self.hertz[k + 1] - self.hertz[k]) / (self.speed[k + 1] - self.speed[k])
        return k, (self.hertz[k] - slope * self.speed[k]) / (waves / self.turn - slope)


def _doubling(tip: Tip, row: int, operation: Operation, speed: float) -> float:
    """Least depth of period doubling [m] at a speed, of the modes at another one."""
    assert tip.modes is not None
    floquet = operation.process(speed).floquet(tip.modes.at(row), float(tip.tops[row]), 0.0)
    return floquet.repeating(-1.0)
