"""Receptance, mobility or inertance between points at independent speed and frequency."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.measured import measured_fields
from rotordyn.analyses.frf.result import (
    FrequencyResponse,
    FrfResult,
    InertanceResult,
    MobilityResult,
    TurningFrfResult,
)
from rotordyn.analyses.frf.spec import QUANTITIES, FrfSpec, Port
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.errors import InvalidInput
from rotordyn.results.display import RPM
from rotordyn.scene.formulation import ROTATING, require_isotropic, turned
from rotordyn.scene.refinement import Rows, changes, few_rows, settled
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Answered = Callable[[Array], Complex]
DOUBTFUL = 1e-2  # error over the peak, from which a response may be rounding alone
NOTHING = 1e-9  # of the direct responses at both ends: less is rounding
GRID = 24  # frequencies at which the finer model is compared, besides those of the modes
MOST_VALUES = 100_000_000
UNDAMPED = 1e-9  # of the frequency: a pole so near to it has no damping
BESIDE = 1e-8  # of the frequency, to either side of which a response is compared with its
CLOSE = 1e-10  # likewise, where it is taken too: on a pole itself it may cancel by rounding
HIGHER = 10.0  # times what it is there: so near to a pole its size is nothing but rounding
_KINDS: dict[str, type[FrequencyResponse]] = {
    kind.kind: kind for kind in (FrfResult, MobilityResult, InertanceResult)
}


def answer(scene: Scene, spec: FrfSpec) -> FrequencyResponse:
    """H (speeds, pairs, frequencies): response per unit force or moment, bearing speed included,
    of a model refined until they are as accurate as asked for.

    Between motions that nothing couples it is zero.

    Raises
    ------
    InvalidInput : mobility or inertance in the turning frame; more values than fit; a frequency at
        which nothing limits the response
    """
    turning = scene.conditions.formulation == ROTATING
    if turning:
        require_isotropic(scene)
        if spec.quantity != QUANTITIES[0]:
            raise InvalidInput(turned(spec.quantity))
    frequency = np.array(spec.frequencies)
    count = len(scene.usable) * len(spec.pairs) * len(frequency)
    if count > MOST_VALUES:
        raise InvalidInput(
            f"frf: too many values: given {count:.3g} by {len(scene.usable)} speeds, "
            f"{len(spec.pairs)} pairs and {len(frequency)} frequencies; allowed: up to "
            f"{MOST_VALUES:.0e}"
        )
    power = QUANTITIES.index(spec.quantity)
    scene, error = settled(
        scene, lambda one: _errors(one, spec, frequency, power), lambda found: float(found.max())
    )
    values = np.zeros((len(scene.usable), len(spec.pairs), len(frequency)), dtype=complex)
    growing = np.zeros(len(scene.usable), dtype=bool)
    for k, own in _by_system(scene, spec.pairs).items():
        found = scene.system(k)
        growing |= found.growing.any(axis=1)
        within = _receptance(scene, found, [spec.pairs[place] for place in own])
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            values[:, own] = within(frequency)
        _refuse_unlimited(scene, within, found, frequency, values[:, own])
    ends = scene.speed[scene.usable[[0, -1]]]
    slices = {int(np.abs(scene.speed - wanted).argmin()) for wanted in spec.slices or ends}
    values = scene.scattered(values * (2j * math.pi * frequency) ** power)
    kind = TurningFrfResult if turning else _KINDS[spec.quantity]
    rest: dict[str, Any] = {spec.quantity: values}
    names = tuple(f"{response} / {excitation}" for response, excitation in spec.pairs)
    rest |= measured_fields(spec, scene.speed, frequency, names, values)
    return kind(
        speed=scene.speed,
        frequency=frequency,
        pair=names,
        outcome=scene.outcome,
        unstable=scene.flagged(growing),
        is_slice=np.isin(np.arange(len(scene.speed)), sorted(slices)),
        error=error,
        **rest,
    )


def _by_system(scene: Scene, pairs: Sequence[tuple[Port, Port]]) -> dict[int, list[int]]:
    """Places of the pairs whose ends move in one subsystem; all others respond with zero."""
    found: dict[int, list[int]] = {}
    for place, pair in enumerate(pairs):
        owners = {scene.owner(port.point, port.direction) for port in pair}
        if len(owners) == 1:
            found.setdefault(owners.pop(), []).append(place)
    return found


def _receptance(scene: Scene, found: FreeMotions, pairs: Sequence[tuple[Port, Port]]) -> Answered:
    """Receptances (speeds, pairs, f) of a subsystem by frequency (f,) [Hz]."""
    rows = [
        [found.linear.row(*scene.spindle.place(port.point), port.direction) for port in pair]
        for pair in pairs
    ]
    response, excitation = np.array(rows).swapaxes(0, 1)
    bends = pairs[0][0].direction not in ("x", "thx")
    turning = scene.conditions.formulation == ROTATING and bends
    answer = found.turning_receptance if turning else found.receptance
    return lambda frequency: answer(2.0 * math.pi * frequency, response, excitation)


def _errors(scene: Scene, spec: FrfSpec, frequency: Array, power: int) -> Array:
    """Largest change of each pair by the finer model over its peak (pairs,), at a few speeds and
    frequencies."""
    error = np.zeros(len(spec.pairs))
    if scene.rigid:
        return error
    for k, own in _by_system(scene, spec.pairs).items():
        pairs, at = [spec.pairs[place] for place in own], _judged(scene, k, frequency)
        error[own] = np.nan_to_num(changes(scene, partial(_weighed, k, pairs, at, power), 1))
        for place in own:
            if error[place] > DOUBTFUL and _is_rounding(scene, k, spec.pairs[place], at):
                error[place] = 0.0
    return error


def _is_rounding(scene: Scene, k: int, pair: tuple[Port, Port], at: Array) -> bool:
    """A response that symmetry makes zero: nothing beside the direct ones of its two ends."""
    response, excitation = pair
    every = [pair, (response, response), (excitation, excitation)]
    own, *ends = np.abs(_weighed(k, every, at, 0, scene, few_rows(scene))).max(axis=(0, 2))
    return bool(own <= NOTHING * math.sqrt(ends[0] * ends[1]))


def _weighed(
    k: int, pairs: Sequence[tuple[Port, Port]], at: Array, power: int, scene: Scene, rows: Rows
) -> Complex:
    """Receptances times ω to a power (rows, pairs, f) at frequencies ``at`` (f,) [Hz]."""
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        found = _receptance(scene, scene.system_at(k, rows), pairs)(at)
        return np.asarray(found * (2.0 * math.pi * at) ** power)


def _judged(scene: Scene, k: int, frequency: Array) -> Array:
    """Frequencies at which receptances are compared: some, and those next to the modes."""
    some = np.unique(np.linspace(0, len(frequency) - 1, min(GRID, len(frequency))).astype(int))
    found = scene.system(k)
    turning = found.pole.imag
    if scene.conditions.formulation == ROTATING:
        turning = np.abs(found.whirl * turning - scene.speed[scene.usable][:, None])
    hertz = turning / (2.0 * math.pi)
    inside = hertz[(hertz >= frequency[0]) & (hertz <= frequency[-1])]
    after = np.searchsorted(frequency, inside)
    near = np.clip(np.concatenate([after - 1, after]), 0, len(frequency) - 1)
    return frequency[np.unique(np.concatenate([some, near]))]


def _refuse_unlimited(
    scene: Scene,
    within: Answered,
    found: FreeMotions,
    frequency: Array,
    values: Complex,
) -> None:
    """Raise InvalidInput where ``values`` (speeds, pairs, frequencies) have no limit: at the pole
    of a motion without damping, or so slow that a free one's overflow."""
    lost = np.asarray(~np.isfinite(values).all(axis=1))
    own = _near_poles(found, frequency)
    if own.any() and not lost.any():
        near = frequency[own]
        around = [near * (1.0 + apart) for apart in (-BESIDE, BESIDE, -CLOSE, CLOSE)]
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            beside = np.split(np.abs(within(np.concatenate(around))), len(around), axis=-1)
        size = np.fmax.reduce([np.abs(values[..., own]), *beside[2:]])
        lost[:, own] = (size > HIGHER * np.maximum(*beside[:2])).any(axis=1)
    if lost.any():
        row, column = np.argwhere(lost)[0]
        rpm = scene.speed[scene.usable[min(row, len(scene.usable) - 1)]] * RPM.factor
        raise InvalidInput(
            f"frf: the response is unbounded at {frequency[column]:.10g} Hz and {rpm:.6g} rpm, "
            "where an undamped or rigid-body mode lies: add damping or a support, or drop this "
            "frequency"
        )


def _near_poles(found: FreeMotions, frequency: Array) -> NDArray[np.bool_]:
    """Frequencies (f,) that may lie on the pole of a motion without damping."""
    pole = found.pole
    with np.errstate(invalid="ignore"):
        own = np.unique(pole.imag[np.abs(pole.real) <= UNDAMPED * np.abs(pole)])
    omega = 2.0 * math.pi * frequency
    if not own.size:
        return np.zeros(len(omega), dtype=bool)
    place = np.searchsorted(own, omega)
    gaps = [np.abs(own[np.clip(place + k, 0, len(own) - 1)] - omega) for k in (-1, 0)]
    return np.asarray(np.minimum(*gaps) <= UNDAMPED * omega)
