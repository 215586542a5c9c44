"""The stable depth of cut at one speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from bearings.arguments import typed
from rotordyn.analyses.stability_lobes.as_modes import as_modes
from rotordyn.analyses.stability_lobes.crossings import largest_crossing
from rotordyn.analyses.stability_lobes.cutting import Cut, checked
from rotordyn.analyses.stability_lobes.modal_limit import UNLIMITED, Limit, Process, modal_limit
from rotordyn.analyses.stability_lobes.multi_frequency import Harmonics
from rotordyn.analyses.stability_lobes.sampling import (
    LOWEST,
    along,
    folded,
    peaks,
    resolving,
    shaped,
)
from rotordyn.analyses.stability_lobes.spans import Spans, refuse_waves
from rotordyn.analyses.stability_lobes.spec import FLIP, FOLD, HOPF, METHODS, NONE
from rotordyn.analyses.stability_lobes.zero_order import Mean, zero_order
from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput

Receptance = Callable[[Array], Complex]
SHALLOW = 0.05  # of the limit with straight edges: first depth tried with helical ones
DEEPEST = 50.0  # times that limit: deeper limits count as infinite
AHEAD, SHARE, LEAST_STEP = 0.4, 0.05, 0.005  # of the margin, of the axial pitch, of the depth
WITHIN = 1e-6  # of the depth: tolerance of a limit
MOST_INTERRUPTED = 1e4  # tooth period over time in cut: the number of harmonics grows with it
MOST_POLYNOMIALS = 200  # of forces over the cut, solved at hundreds of samples
AT_END = 1e-9  # of π: a crossing there is a flip
REPEATING = 1e-15  # rad: a smaller phase from period to period is a fold
SLOW, SLOWER = 1e-6, 16  # rad, and number of samples from there to those of even teeth


@typed(InvalidInput, besides=("receptance",))
def limit_depth(  # noqa: PLR0913  what a user of cutting data has at hand
    receptance: Receptance,
    teeth: int = 2,
    tangential: float = 6e8,
    radial: float = 2e8,
    entry: float = 0.0,
    exit: float = math.pi,
    speed: float = 1000.0,
    method: str = "multi-frequency",
    helix: float = 0.0,
    diameter: float = 0.0,
    pitch: Sequence[float] = (),
    process_damping: float = 0.0,
) -> Limit:
    """Return the depth of cut up to which milling is stable.

    receptance : angular frequencies (f,) > 0 [rad/s] -> (f, 2, 2) [m/N], tip in feed and normal
    teeth : number of teeth, evenly spaced unless ``pitch`` is given
    tangential, radial : cutting coefficients [Pa]
    entry, exit : angles of a tooth in cut [rad], from the normal towards the feed
    speed : of the cutter [rad/s]
    method : "multi-frequency" or "zero-order"
    helix : angle of the edges [rad], which needs the ``diameter`` [m]
    pitch : angles from each tooth to the one that cut before it [rad], in the order in which they
        cut, 2π together
    process_damping : force normal to the cut surface by velocity there, times cutting speed, per
        depth [N/m], which needs the ``diameter``

    Raises
    ------
    InvalidInput : an impossible cut, an unknown method, a helix of 90°; a helix or process damping
        without diameter, or process damping with a receptance that is no sum of modes; a receptance
        of another shape or size, without damping, or that does not reach over the band; a cut so
        slow that it lasts over more waves than can be resolved

    Sources: Altintas and Budak (1995), Budak and Altintas (1998), Merdol and Altintas (2004).
    """
    cut = checked(Cut(teeth, tangential, radial, entry, exit, pitches=tuple(pitch)))
    _refuse(speed, method, helix, diameter, process_damping)
    receptance = shaped(receptance, (2, 2))
    omega, top = resolving(receptance)
    period = cut.turn / speed
    lag = 2.0 * math.tan(helix) / diameter if helix > 0.0 else 0.0
    ploughing = None
    if process_damping > 0.0:
        rate = process_damping / (0.5 * diameter * speed)
        ploughing = replace(cut, tangential=0.0, radial=rate)
    process = Process(cut, period, lag, ploughing)
    if method == METHODS[1]:
        return _zero_order_limit(receptance, process, omega, top)
    tip = as_modes(receptance, omega)
    if tip is not None:
        return modal_limit(tip, top, process)
    if ploughing is not None:
        raise InvalidInput(
            "process_damping: the receptance is not a sum of modes, which it needs: leave "
            "process_damping out, take method zero-order, or give a modal fit"
        )
    return sampled_limit(receptance, peaks(omega, top), top, process)


def _zero_order_limit(receptance: Receptance, process: Process, omega: Array, top: float) -> Limit:
    gaps = np.array(process.cut.gaps)
    delays = process.period * gaps / process.cut.turn
    samples = along(omega, top, float(delays.max()))[None]
    rubbing = process.ploughing.mean() if process.ploughing else np.zeros((2, 2))
    mean = Mean(process.cut.mean()[None], rubbing[None])
    depth, at = zero_order(lambda rows: receptance(rows[0])[None], mean, delays[None], samples)
    kind = HOPF if math.isfinite(depth[0]) else NONE
    return Limit(float(depth[0]), float(at[0]) / (2.0 * math.pi), kind)


def sampled_limit(receptance: Receptance, near: Array, top: float, process: Process) -> Limit:
    """Return the limit with a receptance that is no sum of modes; samples ``near`` (f,) [rad/s]
    resolve its peaks.

    Raises
    ------
    InvalidInput : a cut over more waves than can be resolved, or too short a cut
    """
    refuse_waves(Spans(process.cut, process.period, top), MOST_POLYNOMIALS)
    if process.cut.interruption > MOST_INTERRUPTED:
        raise InvalidInput(
            f"entry and exit: a tooth cuts for 1/{process.cut.interruption:.3g} of its period; "
            f"allowed for a receptance that is not a sum of modes: from 1/{MOST_INTERRUPTED:g}: "
            "raise the immersion, or leave the loss factor out"
        )
    angle, unclamped = folded(near, process.period), receptance
    if not process.cut.even:  # vibration may repeat with the teeth, at a phase of 0
        angle = np.concatenate([[REPEATING], np.geomspace(SLOW, angle[0], SLOWER)[:-1], angle])

        def receptance(omega: Array) -> Complex:  # infinite at 0 with rigid-body modes
            return unclamped(np.maximum(omega, LOWEST))

    if process.lag > 0.0:
        return with_helix(process, top, receptance, angle)
    spans = Spans(process.cut, process.period, top)
    return at_depth(Harmonics(spans, receptance), angle)


def at_depth(harmonics: Harmonics, angle: Array) -> Limit:
    """Return the limit of a cut whose edges lag as at one depth."""
    ends = (0, -1) if angle[0] <= REPEATING else (-1,)
    crossing = largest_crossing(harmonics.eigenvalues, angle, ends)
    if crossing.value <= 0.0:
        return UNLIMITED
    kind = HOPF
    if crossing.angle >= math.pi * (1.0 - AT_END):
        kind = FLIP
    elif crossing.angle <= REPEATING:
        kind = FOLD
    return Limit(1.0 / crossing.value, harmonics.chatter(crossing.angle, crossing.value), kind)


def with_helix(process: Process, top: float, receptance: Receptance, angle: Array) -> Limit:
    """Return the least depth that is the limit of the cutting forces at that same depth.

    Depths are tried from below in steps short against the axial pitch,
    so that no closed region of period doubling is skipped; the first loss is bisected.
    """

    def limit_at(depth: float) -> Limit:
        cut = replace(process.cut, lag=process.lag * depth)
        return at_depth(Harmonics(Spans(cut, process.period, top), receptance), angle)

    straight = limit_at(0.0)
    if math.isinf(straight.depth):
        return straight
    deepest = DEEPEST * straight.depth
    low, limit = 0.0, straight
    high = SHALLOW * straight.depth
    while (limit := limit_at(high)).depth > high:
        if high > deepest:
            return UNLIMITED
        step = min(AHEAD * (limit.depth - high), SHARE * min(process.cut.gaps) / process.lag)
        low, high = high, high + max(step, LEAST_STEP * high)
    while high - low > WITHIN * high:
        middle = 0.5 * (low + high)
        at_middle = limit_at(middle)
        if at_middle.depth > middle:
            low = middle
        else:
            high, limit = middle, at_middle
    return limit._replace(depth=0.5 * (low + high))


def _refuse(
    speed: float, method: str, helix: float, diameter: float, process_damping: float
) -> None:
    if method not in METHODS:
        raise InvalidInput(f"method: given '{method}'; allowed: {', '.join(METHODS)}")
    if not speed > 0.0:
        raise InvalidInput(f"speed: given {speed:.6g} rad/s; allowed: above 0")
    if not 0.0 <= helix < 0.5 * math.pi * (1.0 - 1e-9):
        raise InvalidInput(
            f"helix: given {math.degrees(helix):.6g}°; allowed: from 0 to below 90°, at which an "
            "edge does not cut"
        )
    if not process_damping >= 0.0:
        raise InvalidInput(f"process_damping: given {process_damping:.6g} N/m; allowed: from 0")
    for name, value in (("helix", helix), ("process_damping", process_damping)):
        if value > 0.0 and not diameter > 0.0:
            raise InvalidInput(f"{name}: it needs the diameter of the cutter, which is not given")
