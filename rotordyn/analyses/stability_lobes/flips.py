"""Period doubling between the speeds at which limits are solved.

It limits where a mode makes k + ½ waves in a period of the teeth, over a range of speeds that is a
small part of its damping ratio wide, so that steps between speeds pass it over. There depths of
period doubling are those of one eigenvalue problem, with the modes of the nearest speed solved.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import ZERO_ORDER
from rotordyn.analyses.stability_lobes.tip import Tip

Array = NDArray[np.float64]
# damping ratios by which waves may be off k + ½: along the normal in down-milling there are fewer
# where the limit is least, along the feed more
BESIDE = np.arange(-2.0, 2.0 + 1e-9, 0.125)
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
        passed = np.floor(waves[:-1] - 0.5) > np.floor(waves[1:] - 0.5)
        passed &= np.diff(speed)[:, None] > FINE * ratio[:-1] * speed[:-1, None]
        passed &= waves[:-1] - waves[1:] < LOBE
        passed &= np.abs(np.diff(hertz, axis=0)) < SAME * hertz[:-1]
    for k, mode in np.argwhere(passed).tolist():
        order = math.floor(waves[k, mode] - 0.5) + 0.5
        row = k if waves[k, mode] - order < order - waves[k + 1, mode] else k + 1
        own = order * (1.0 + ratio[row, mode] * BESIDE)  # waves in a period
        slope = (hertz[k + 1, mode] - hertz[k, mode]) / (speed[k + 1] - speed[k])
        at = (hertz[k, mode] - slope * speed[k]) / (own / turn - slope)
        places = np.searchsorted(speed, at) - 1
        for each, where, place in zip(own, at, places.tolist(), strict=True):
            if not 0 <= place < len(speed) - 1:
                continue
            waving = hertz[row, mode] * turn / each  # speed at which the nearest one makes as many
            depth = _doubling(tip, int(limits.rows[row]), operation, waving)
            if not depth >= found.depth[place]:
                found.depth[place], found.speed[place] = depth, where
    return found


def _doubling(tip: Tip, row: int, operation: Operation, speed: float) -> float:
    """Least depth of period doubling [m] at a speed, of the modes at another one."""
    assert tip.modes is not None
    floquet = operation.process(speed).floquet(tip.modes.at(row), float(tip.tops[row]), 0.0)
    return floquet.repeating(-1.0)
