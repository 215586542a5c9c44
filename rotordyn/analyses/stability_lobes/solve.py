"""The stable depth of cut over speed, at every speed's own receptance."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks

from rotordyn.analyses.stability_lobes.cutting import Cut, checked
from rotordyn.analyses.stability_lobes.limit import Limit, at_depth, with_helix
from rotordyn.analyses.stability_lobes.multi_frequency import Harmonics
from rotordyn.analyses.stability_lobes.result import StabilityLobesResult
from rotordyn.analyses.stability_lobes.sampling import TURN
from rotordyn.analyses.stability_lobes.spec import HOPF, METHODS, NONE, StabilityLobesSpec
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.analyses.stability_lobes.zero_order import zero_order
from rotordyn.errors import InvalidInput
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
THREADS = 2
MOST_SAMPLES = 4000  # of a speed: below, the tooth passes more often than modes decay
POCKETS = 8
PROMINENT = 0.05  # of its depth, by which a pocket is deeper than what is around it


def answer(scene: Scene, spec: StabilityLobesSpec) -> StabilityLobesResult:
    """Limits at every speed asked for, with the machine in its state there; and with that at rest.

    Raises
    ------
    InvalidInput : a mode without damping; no mode within the frequencies
    NoSolution : the machine has none at any of the speeds
    """
    cut = checked(Cut(spec.teeth, spec.tangential, spec.radial, *spec.ends))
    speeds = np.array(spec.speeds) if spec.speeds else scene.speed[scene.speed > 0.0]
    turning = scene.at(speeds) if spec.speeds else scene
    rows = np.flatnonzero(turning.speed[turning.usable] > 0.0)
    if not rows.size:
        raise InvalidInput("stability_lobes: no speed above 0 has a solution")
    usable = turning.speed[turning.usable[rows]]
    tip = Tip(turning, spec.point, spec.feed, spec.max_frequency)
    limits = _limits(tip, rows, cut, usable, spec)
    still = Tip(scene.at(np.zeros(1)), spec.point, spec.feed, spec.max_frequency)
    standing = _limits(still, np.zeros(len(rows), dtype=np.intp), cut, usable, spec)
    depth = np.full(len(speeds), np.nan)
    chatter, at_rest = depth.copy(), depth.copy()
    loss = np.full(len(speeds), NONE, dtype=object)
    modes = np.full((2, len(speeds)), np.nan)
    for at, row, own, other in zip(
        np.searchsorted(speeds, usable), rows, limits, standing, strict=True
    ):
        depth[at], chatter[at], loss[at] = own
        at_rest[at] = other.depth
        modes[:, at] = _nearest(tip.poles[row], own.frequency)
    removal = depth * _width(spec) * spec.feed_per_tooth * spec.teeth * speeds / (2.0 * math.pi)
    deepest = _pockets(depth)
    return StabilityLobesResult(
        speed=scene.speed,
        outcome=scene.outcome,
        cutting_speed=speeds,
        depth=depth,
        chatter=chatter,
        loss=tuple(loss.tolist()),
        mode_frequency=modes[0],
        mode_damping=modes[1],
        removal=removal,
        at_rest=at_rest,
        pocket=np.arange(1, len(deepest) + 1),
        pocket_speed=speeds[deepest],
        pocket_depth=depth[deepest],
        pocket_removal=removal[deepest],
    )


def _width(spec: StabilityLobesSpec) -> float:
    """Radial depth of cut [m]."""
    return spec.immersion * spec.diameter


def _limits(
    tip: Tip, rows: NDArray[np.intp], cut: Cut, speed: Array, spec: StabilityLobesSpec
) -> list[Limit]:
    """Limits at speeds of the cutter, with the receptance of a row of ``tip`` each."""
    period = cut.pitch / speed
    if spec.method == METHODS[1]:
        return _zero_order(tip, rows, cut, period)
    lag = 2.0 * math.tan(spec.helix) / spec.diameter
    tip.poles, tip.tops  # noqa: B018  solved once, before threads ask for them
    solve = partial(_multi_frequency, tip, cut, lag)
    with ThreadPoolExecutor(THREADS) as pool:  # eigenvalues leave the interpreter free
        return list(pool.map(solve, rows.tolist(), period.tolist()))


def _multi_frequency(tip: Tip, cut: Cut, lag: float, row: int, period: float) -> Limit:
    one, top = tip.at(row), float(tip.tops[row])

    def receptance(omega: Array) -> Complex:
        return one.receptance(omega[None])[0]

    even = np.linspace(0.0, math.pi, round(math.pi / TURN) + 1)[1:]
    angle = np.mod(tip.about_poles(row) * period, 2.0 * math.pi)
    angle = np.unique(np.concatenate([even, np.minimum(angle, 2.0 * math.pi - angle)]))
    angle = angle[np.append(True, np.diff(angle) > 1e-6)]
    angle[-1] = math.pi
    if lag > 0.0:
        return with_helix(cut, lag, period, top, receptance, angle)
    return at_depth(Harmonics(cut, period, top), receptance, angle)


def _zero_order(tip: Tip, rows: NDArray[np.intp], cut: Cut, period: Array) -> list[Limit]:
    near = [tip.about_poles(row) for row in rows.tolist()]
    tops = tip.tops[rows]
    even = min(math.ceil(float((tops * period).max()) / TURN), MOST_SAMPLES)
    longest = max(map(len, near))
    omega = np.empty((len(rows), even + longest))
    for k, own in enumerate(near):
        omega[k, :even] = np.linspace(0.0, tops[k], even + 1)[1:]
        omega[k, even:] = np.interp(np.linspace(0, len(own) - 1, longest), np.arange(len(own)), own)
    omega.sort(axis=1)
    one = tip.at(0) if len(tip.scene.usable) == 1 else tip

    def receptance(at: Array) -> Complex:
        if one is not tip:
            return one.receptance(at.reshape(1, -1)).reshape(*at.shape, 2, 2)
        if len(at) == len(tip.scene.usable):
            return tip.receptance(at)
        every = np.ones((len(tip.scene.usable), at.shape[1]))
        every[rows] = at
        return tip.receptance(every)[rows]

    depth, at, _ = zero_order(receptance, cut.mean(), period, omega)
    return [
        Limit(float(a), float(w) / (2.0 * math.pi), HOPF if math.isfinite(a) else NONE)
        for a, w in zip(depth, at, strict=True)
    ]


def _nearest(pole: Complex, hertz: float) -> tuple[float, float]:
    """Frequency [Hz] and damping ratio of the mode next to a chatter frequency."""
    known = pole[np.isfinite(pole)]
    if not math.isfinite(hertz) or not known.size:
        return math.nan, math.nan
    own = known[np.abs(known.imag - 2.0 * math.pi * hertz).argmin()]
    return float(own.imag) / (2.0 * math.pi), float(-own.real / abs(own))


def _pockets(depth: Array) -> NDArray[np.intp]:
    """Places of the deepest maxima over speed, the deepest first."""
    finite = np.where(np.isfinite(depth), depth, 0.0)
    tops, _ = find_peaks(finite, prominence=PROMINENT * finite.max(initial=0.0) or None)
    return np.asarray(tops[np.argsort(-finite[tops])][:POCKETS], dtype=np.intp)
