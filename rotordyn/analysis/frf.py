"""Receptance, mobility or inertance between points at independent speed and frequency."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.accuracy import receptance_error
from rotordyn.analysis.direct import direct_bending, end, receptance
from rotordyn.analysis.display import RPM
from rotordyn.analysis.formulation import ROTATING, turned
from rotordyn.analysis.measured import measured_fields
from rotordyn.analysis.results import (
    FrequencyResponse,
    FrfResult,
    InertanceResult,
    MobilityResult,
    TurningFrfResult,
)
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.shaft import EXACT
from rotordyn.analysis.specs import DIRECT, QUANTITIES, REDUCED, FrfSpec, Port, not_direct
from rotordyn.elements.node import FREEDOMS
from rotordyn.errors import InvalidInput
from rotordyn.machine.support import MOTIONS
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.whirl_in_planes import receptance_in_planes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pairs = list[tuple[Port, Port]]
Answered = Callable[[Array], Complex]
DIRECTLY, JUDGE = "direct receptance", "modes that direct receptances are judged by"
MOST_VALUES = 100_000_000
UNDAMPED = 1e-9  # of the frequency: a pole so near to it has no damping
BESIDE = 1e-8  # of the frequency, to either side of which a response is compared with its
CLOSE = 1e-10  # likewise, where it is taken too: on a pole itself it may cancel by rounding
PEAK, FEW = 1e5, 3  # of the smallest response, frequencies: to tell a peak by
WIDE = 1e-6  # of the frequency, beyond which its neighbours are not on the same pole
SOME = 24  # frequencies at which rounding is estimated
HIGHER = 10.0  # times what it is there: so near to a pole its size is nothing but rounding
_KINDS: dict[str, type[FrequencyResponse]] = {
    kind.kind: kind for kind in (FrfResult, MobilityResult, InertanceResult)
}


def answer(scene: Scene, spec: FrfSpec) -> FrequencyResponse:
    """H (speeds, pairs, frequencies): response per unit force or moment, bearing speed included.

    Between motions that nothing couples it is zero.

    Raises
    ------
    InvalidInput : mobility or inertance in the turning frame; more values than fit; a frequency at
        which nothing limits the response
    """
    if spec.quantity != QUANTITIES[0] and scene.conditions.formulation == ROTATING:
        raise InvalidInput(turned(spec.quantity))
    frequency = np.array(spec.frequencies)
    count = len(scene.usable) * len(spec.pairs) * len(frequency)
    if count > MOST_VALUES:
        raise InvalidInput(
            f"frf: too many values: given {count:.3g} by {len(scene.usable)} speeds, "
            f"{len(spec.pairs)} pairs and {len(frequency)} frequencies; allowed: up to "
            f"{MOST_VALUES:.0e}"
        )
    values = np.zeros((len(scene.usable), len(spec.pairs), len(frequency)), dtype=complex)
    error, power = np.zeros(len(spec.pairs)), QUANTITIES.index(spec.quantity)
    for group in _groups(scene):
        own = [
            k
            for k, pair in enumerate(spec.pairs)
            if all(MOTIONS[port.direction] in group for port in pair)
        ]
        if own:
            pairs = [spec.pairs[k] for k in own]
            way = _way(scene, group, spec.method)
            within = _WITHIN[way](scene, group, pairs)
            with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
                values[:, own] = within(frequency)
            suspects = partial(_near_poles, scene, group) if way == REDUCED else _high_peaks
            _refuse_unlimited(scene, within, suspects, frequency, values[:, own])
            error[own] = _error(way, scene, group, pairs, frequency, power)
    ends = scene.speed[scene.usable[[0, -1]]]
    slices = {int(np.abs(scene.speed - wanted).argmin()) for wanted in spec.slices or ends}
    values = scene.scattered(values * (2j * math.pi * frequency) ** power)
    kind = _KINDS[spec.quantity]
    rest: dict[str, Any] = {spec.quantity: values}
    names = tuple(f"{response} / {excitation}" for response, excitation in spec.pairs)
    rest |= measured_fields(spec, scene.speed, frequency, names, values)
    if scene.conditions.formulation == ROTATING:
        kind = TurningFrfResult
    return kind(
        speed=scene.speed,
        frequency=frequency,
        pair=names,
        outcome=scene.outcome,
        is_slice=np.isin(np.arange(len(scene.speed)), sorted(slices)),
        error=error,
        **rest,
    )


def _refuse_unlimited(
    scene: Scene,
    within: Answered,
    suspects: Callable[[Array, Complex], NDArray[np.bool_]],
    frequency: Array,
    values: Complex,
) -> None:
    """Raise InvalidInput where ``values`` (speeds, pairs, frequencies) have no limit: at the pole
    of a motion without damping, or so slow that a free one's overflow.

    ``suspects``: frequencies (f,) that may lie on such a pole.
    """
    lost = np.asarray(~np.isfinite(values).all(axis=1))
    own = suspects(frequency, values)
    if own.any() and not lost.any():
        near = frequency[own]
        around = [near * (1.0 + apart) for apart in (-BESIDE, BESIDE, -CLOSE, CLOSE)]
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            found = np.split(np.abs(within(np.concatenate(around))), len(around), axis=-1)
        size = np.fmax.reduce([np.abs(values[..., own]), *found[2:]])
        lost[:, own] = (size > HIGHER * np.maximum(*found[:2])).any(axis=1)
    if lost.any():
        row, column = np.argwhere(lost)[0]
        rpm = scene.speed[scene.usable[min(row, len(scene.usable) - 1)]] * RPM.factor
        raise InvalidInput(
            f"frf: nothing limits the response at {frequency[column]:.10g} Hz and {rpm:.6g} rpm, "
            "where a motion that nothing damps, or nothing holds, has its frequency: damp or hold "
            "it, or leave that frequency out"
        )


def _high_peaks(frequency: Array, values: Complex) -> NDArray[np.bool_]:
    """Where poles are not known: far above the frequencies beside, unless these are as near."""
    size = np.abs(values)
    high = size > PEAK * size.min(axis=-1, keepdims=True)
    beside = np.zeros_like(size)
    beside[..., 1:] = size[..., :-1]
    beside[..., :-1] = np.maximum(beside[..., :-1], size[..., 1:])
    apart = np.diff(frequency, prepend=-math.inf, append=math.inf) / WIDE
    dense = np.minimum(apart[:-1], apart[1:]) < frequency
    high &= dense | (size > HIGHER * beside)
    return np.asarray(high.any(axis=(0, 1)) | (len(frequency) < FEW))


def _near_poles(
    scene: Scene, group: frozenset[str], frequency: Array, values: Complex
) -> NDArray[np.bool_]:
    """Where poles are known."""
    pole = scene.vibration(min(group))[1].pole
    own = np.unique(np.abs(pole.imag[np.abs(pole.real) <= UNDAMPED * np.abs(pole)]))
    omega = 2.0 * math.pi * frequency
    if not own.size:
        return np.zeros(len(omega), dtype=bool)
    place = np.searchsorted(own, omega)
    gaps = [np.abs(own[np.clip(place + k, 0, len(own) - 1)] - omega) for k in (-1, 0)]
    return np.asarray(np.minimum(*gaps) <= UNDAMPED * omega)


def _error(
    way: str, scene: Scene, group: frozenset[str], pairs: Pairs, frequency: Array, power: int
) -> Array | float:
    """Estimated errors of pairs; the exact shaft has none."""
    if way == REDUCED:
        return receptance_error(scene, min(group), pairs, frequency, power)
    if way == EXACT:
        return 0.0
    few = scene.seen_from(tuple({scene.spindle.place(e.point) for _, e in pairs}))
    scene.solved[JUDGE] = few.vibration("bending")[1]  # growth is told of all modes solved
    elements = receptance_error(few, "bending", pairs, frequency, power, elements=True)
    return elements + _rounding(few, pairs, frequency, power)


def _rounding(few: Scene, pairs: Pairs, frequency: Array, power: int) -> Array:
    """What rounding of many short elements may come to in direct responses (pairs,).

    A stiffness δ to ground changes the response of a to a force at b by H_ae δ H_eb, which is taken
    for deflections e at both ends, at some frequencies.
    """
    frequency = frequency[np.unique(np.linspace(0, len(frequency) - 1, SOME).astype(int))]
    weight = (2.0 * math.pi * frequency) ** power
    around = [[Port(p.point, name) for p in pair for name in ("y", "z")] for pair in pairs]
    paths = [[(a, e, b) for e in ends] for (a, b), ends in zip(pairs, around, strict=True)]
    steps = [step for every in paths for a, e, b in every for step in ((a, e), (e, b))]
    asked = list(dict.fromkeys([*pairs, *steps]))
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        found = _modal(few, frozenset({"bending"}), asked)(frequency)
    size = dict(zip(asked, np.moveaxis(np.abs(found), 1, 0), strict=True))
    off = []
    for pair, every in zip(pairs, paths, strict=True):
        change = np.sum([size[a, e] * size[e, b] for a, e, b in every], axis=0) * weight
        largest = (size[pair] * weight).max()
        off.append(float(change.max() / largest) if largest > 0.0 else 0.0)
    return direct_bending(few).rounding * np.nan_to_num(np.array(off))


def _groups(scene: Scene) -> list[frozenset[str]]:
    """Motions that answer one another's forces."""
    coupled = scene.coupled_motions
    alone = [frozenset({m}) for m in ("bending", "axial", "torsion") if m not in coupled]
    return [coupled, *alone] if coupled else alone


def _way(scene: Scene, group: frozenset[str], method: str) -> str:
    """How pairs whose motions are of one group are answered.

    Raises
    ------
    InvalidInput : directly, and they are not of bending alone
    """
    if scene.bends_exactly and group == {"bending"}:
        return EXACT
    if method == DIRECT and (why := not_direct(group, scene.coupled_motions)):
        raise InvalidInput(f"frf: {why}")
    return REDUCED if scene.rigid else method


def _modal(scene: Scene, group: frozenset[str], pairs: Pairs) -> Answered:
    """By the reduced system."""
    system = scene.vibration(min(group))[0]
    motion = system.motion
    rows = [[_row(scene, motion, port) for port in pair] for pair in pairs]
    response, excitation = np.array(rows).swapaxes(0, 1)

    def answered(frequency: Array) -> Complex:
        omega = 2.0 * math.pi * frequency
        if isinstance(system, LateralSystem) and system.isotropic:
            return _whirling(scene, system, omega, pairs, response, excitation)
        # one speed serves all in torsion
        return scene.receptance(min(group), omega, response, excitation)

    return answered


def _row(scene: Scene, motion: Array, port: Port) -> Array:
    """A port's displacement by the coordinates."""
    node = scene.node(port.point)
    return np.asarray(motion[node, FREEDOMS.index(port.direction)])


def _whirling(
    scene: Scene,
    system: LateralSystem,
    omega: Array,
    pairs: Pairs,
    response: Array,
    excitation: Array,
) -> Complex:
    """Receptance in the complex form."""
    m = system.rotor.size
    folded = [r[:, :m] + r[:, m:] for r in (response, excitation)]
    both = scene.receptance("bending", np.concatenate([omega, -omega]), *folded)
    planar = system.planar(scene.speed[scene.usable])
    return receptance_in_planes(both, _quarter_turns(pairs), planar)


def _direct(scene: Scene, group: frozenset[str], pairs: Pairs) -> Answered:
    """By the assembled matrices."""
    system = direct_bending(scene)
    known = {port: end(scene, port) for port in {port for pair in pairs for port in pair}}
    ends = [(known[response], known[excitation]) for response, excitation in pairs]

    def answered(frequency: Array) -> Complex:
        omega = 2.0 * math.pi * frequency
        if not system.whirling:
            return receptance(system, omega, ends)
        both = receptance(system, np.concatenate([omega, -omega]), ends)
        return receptance_in_planes(both, _quarter_turns(pairs), system.planar)

    return lambda frequency: scene.timed(DIRECTLY, partial(answered, frequency))


def _exact(scene: Scene, group: frozenset[str], pairs: Pairs) -> Answered:
    """By the exact shaft."""
    points = scene.spindle.points
    ends = [(points[r.point], r, points[e.point], e) for r, e in pairs]

    def answered(frequency: Array) -> Complex:
        omega = 2.0 * math.pi * frequency
        if not scene.exact.isotropic:
            return scene.exact.receptance(omega, ends)
        both = scene.exact.receptance(np.concatenate([omega, -omega]), ends)
        return receptance_in_planes(both, _quarter_turns(pairs), scene.exact.planar)

    return lambda frequency: scene.timed("exact receptance", partial(answered, frequency))


# Receptances (speeds, pairs, frequencies) of pairs whose motions are of one group, by frequency.
_WITHIN: dict[str, Callable[[Scene, frozenset[str], Pairs], Answered]] = {
    REDUCED: _modal,
    DIRECT: _direct,
    EXACT: _exact,
}


def _quarter_turns(pairs: Pairs) -> NDArray[np.intp]:
    """Of pairs (pairs,): 0 within a plane, +1 from plane y to plane z, −1 back."""
    plane = {"y": 0, "thz": 0, "z": 1, "thy": 1}
    turns = [plane[response.direction] - plane[force.direction] for response, force in pairs]
    return np.array(turns, dtype=np.intp)
