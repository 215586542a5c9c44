"""Stability limit of a tip that is a sum of modes, by Floquet multipliers."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.analyses.stability_lobes.first_loss import first_loss
from rotordyn.analyses.stability_lobes.floquet import Floquet
from rotordyn.analyses.stability_lobes.modal import ModalTip
from rotordyn.analyses.stability_lobes.spans import SPARE, Spans, refuse_waves
from rotordyn.analyses.stability_lobes.spec import FLIP, FOLD, HOPF, NONE

CERTAIN = 0.9  # of the depth at which a bound on the gain of the loop of force and motion is 1
DEEPEST = 3000.0  # times that depth, if a tooth always cuts: deeper limits count as infinite
DEEP = 0.1  # [m]: limits are searched to this depth at least, however soft the tip
LEAST_DAMPED = 0.01  # least damping ratio for that: away from peaks, damping does not set limits
JUST_BELOW = 1e-7  # of the depth of period doubling
SHARE = 0.05  # of the axial pitch: step of the depths tried with helical edges
COARSE, COARSE_SPARE = 0.7, 5  # of the highest frequency, and extra polynomials: map for trials
MOST_POLYNOMIALS = 500  # of forces over the cut: a limit then takes a minute
ANGLES = 181  # of each piece, at which the largest cutting force is searched


class Limit(NamedTuple):
    """Largest stable ``depth`` [m], infinite where no depth is unstable; chatter ``frequency`` [Hz]
    just beyond, that of the largest motion; ``kind`` "hopf", "flip" (period doubling), "fold" (of
    uneven teeth: vibration that repeats with their pattern) or "without a cut" (a mode that is
    unstable without it)."""

    depth: float
    frequency: float
    kind: str


UNLIMITED = Limit(math.inf, math.nan, NONE)


class Process(NamedTuple):
    """A cut with the ``period`` [s] of its teeth; ``lag`` [rad/m] of the edges by depth;
    ``ploughing``: its process damping as a cut whose coefficients are forces by velocity [N s/m²],
    or None."""

    cut: Cut
    period: float
    lag: float = 0.0
    ploughing: Cut | None = None

    def floquet(self, tip: ModalTip, top: float, depth: float, spare: int = SPARE) -> Floquet:
        """Return the map of a period, edges lagging as at a depth; ``spare``: extra polynomials."""
        lag = self.lag * depth
        spans = Spans(replace(self.cut, lag=lag), self.period, top, spare)
        rubbing = self.ploughing and replace(self.ploughing, lag=lag)
        return Floquet(spans, tip, spans.between(rubbing) if rubbing else None)


def modal_limit(tip: ModalTip, top: float, process: Process) -> Limit:
    """Return the depth of cut up to which milling is stable; ``top`` [rad/s]: highest frequency
    that matters.

    Raises
    ------
    InvalidInput : a cut over more waves than can be resolved
    """
    refuse_waves(Spans(process.cut, process.period, top), MOST_POLYNOMIALS)
    low = CERTAIN / _gain(tip, process)
    coarse = _maps(tip, COARSE * top, process, COARSE_SPARE)
    fine = _maps(tip, top, process, SPARE)
    step = SHARE * min(process.cut.gaps) / process.lag if process.lag > 0.0 else math.inf
    # motion that repeats with evenly spaced teeth cuts no chip
    signs = (-1.0,) if process.cut.even else (-1.0, 1.0)
    real = math.inf if process.lag > 0.0 else min(fine(0.0).repeating(sign) for sign in signs)
    damped = _with_damping(tip)
    deepest = DEEPEST * (low if damped is tip else CERTAIN / _gain(damped, process))
    if process.lag == 0.0:
        deepest *= process.cut.interruption
    deepest = max(deepest, DEEP)
    high = min(deepest, (1.0 - JUST_BELOW) * real)  # ``real`` is exact: only lower ones are sought
    depth = min(first_loss(_radius(coarse), _radius(fine), low, high, step), real)
    if depth > deepest:
        return UNLIMITED
    final = fine(depth)
    value, force = final.dominant(depth)
    angle = abs(float(np.angle(value)))
    return Limit(
        depth, final.spans.chatter(tip.receptance, angle, force), _kind(value, process.cut)
    )


def _kind(multiplier: complex, cut: Cut) -> str:
    """Return the kind of loss; of even teeth a real multiplier > 0 is one of the machine alone."""
    if multiplier.imag != 0.0 or (multiplier.real > 0.0 and cut.even):
        return HOPF
    return FLIP if multiplier.real < 0.0 else FOLD


def _with_damping(tip: ModalTip) -> ModalTip:
    """Return the tip with damping ratios of at least ``LEAST_DAMPED``; itself if none is less."""
    decay = np.minimum(tip.pole.real, -LEAST_DAMPED * np.abs(tip.pole))
    if (decay == tip.pole.real).all():
        return tip
    return replace(tip, pole=decay + 1j * tip.pole.imag)


def _maps(tip: ModalTip, top: float, process: Process, spare: int) -> Callable[[float], Floquet]:
    """Return the map as a function of depth; straight edges have one map for all depths."""
    if process.lag > 0.0:
        return lambda depth: process.floquet(tip, top, depth, spare)
    straight = process.floquet(tip, top, 0.0, spare)
    return lambda _: straight


def _radius(maps: Callable[[float], Floquet]) -> Callable[[float], float]:
    return lambda depth: float(np.abs(maps(depth).multipliers(depth)).max())


def _gain(tip: ModalTip, process: Process) -> float:
    """Return a bound on the loop gain, cutting force → motion → cutting force, by depth [1/m]."""
    omega = tip.frequencies
    size = np.linalg.norm(tip.receptance(omega), 2, axis=(1, 2))
    bound = sum(_largest(process.cut)) * float(size.max())
    if process.ploughing is not None:
        bound += _largest(process.ploughing)[0] * float((omega * size).max())
    return bound


@lru_cache
def _largest(cut: Cut) -> tuple[float, float]:
    """Return the largest forces by depth, of the present motion, and of the motions at the previous
    teeth's cuts: [Pa], or of process damping [N s/m²]."""
    angle = np.concatenate([np.linspace(*piece, ANGLES) for piece in cut.pieces()])
    delayed = np.linalg.norm(cut.by_gap(angle), 2, axis=(2, 3)).sum(axis=0)
    return float(np.linalg.norm(cut.matrix(angle), 2, axis=(1, 2)).max()), float(delayed.max())
