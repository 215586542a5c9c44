"""Receptance, mobility or inertance between points at independent speed and frequency."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from rotordyn.allowance import require_responses
from rotordyn.analyses.frf.coupled import with_coupled
from rotordyn.analyses.frf.measured import measured_fields
from rotordyn.analyses.frf.orders import line_fields, lines_of
from rotordyn.analyses.frf.peaks import (
    Peaks,
    Poles,
    curve_at,
    frequency_of,
    joined,
    peaks_of,
    poles_of,
)
from rotordyn.analyses.frf.result import (
    FrequencyResponse,
    FrfResult,
    InertanceResult,
    MobilityResult,
    TurningFrfResult,
)
from rotordyn.analyses.frf.spec import ORDERS_TURNED, FrfSpec
from rotordyn.analyses.measured_response import QUANTITIES, Port
from rotordyn.arrays import Array, Complex, Flags, Indices
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.errors import InvalidInput
from rotordyn.machine.plausibility import undamped
from rotordyn.modes.band import Band
from rotordyn.modes.branches import branches_of
from rotordyn.modes.criticals import BEYOND
from rotordyn.modes.names import named
from rotordyn.results.display import RPM
from rotordyn.scene.formulation import ROTATING, require_isotropic, turned
from rotordyn.scene.hardly_damped import LIGHT
from rotordyn.scene.refinement import changes, few_rows, response_accuracy, solve_accurately
from rotordyn.scene.scene import Scene

Answered = Callable[..., Complex]  # by frequency [Hz] and, of some pairs alone, their slice
DOUBTFUL = 1e-2  # error over the peak, from which a response may be rounding alone
NOTHING = 1e-9  # of the direct responses at both ends: less is rounding
GRID = 24  # frequencies at which the finer model is compared, besides those of the modes
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
    InvalidInput : mobility or inertance in the turning frame; more values than fit; a frequency
        at which nothing limits the response
    """
    turning = scene.conditions.formulation == ROTATING
    if turning:
        require_isotropic(scene)
        if spec.quantity != QUANTITIES[0]:
            raise InvalidInput(turned(spec.quantity))
    if turning and spec.engine_orders:
        raise InvalidInput(f"frf: engine_orders: {ORDERS_TURNED}")
    frequency = np.array(spec.frequencies, dtype=float)
    require_responses("frf", len(scene.usable), len(spec.pairs), len(frequency))
    power = QUANTITIES.index(spec.quantity)
    judged = _asked(scene, spec)
    scene, error = solve_accurately(
        scene, lambda one: _errors(one, spec, judged, power), lambda errors: float(errors.max())
    )
    responses = partial(_responses, spec.pairs, power)
    growing = np.zeros(len(scene.usable), dtype=bool)
    for k in _by_system(scene, spec.pairs):
        growing |= scene.system(k).growing.any(axis=1)
    names = tuple(f"{response} / {excitation}" for response, excitation in spec.pairs)
    kind = TurningFrfResult if turning else _KINDS[spec.quantity]
    rest: dict[str, Any] = _on_grid(scene, spec, frequency, power)
    values, peaks = rest.pop("values"), (rest["peak_frequency"], rest["peak_value"])
    rest |= line_fields(scene, spec, responses, partial(responses, few=True))
    computed = partial(_at_speed, scene, spec.pairs, power)
    laid, noise = with_coupled(spec, scene.spindle)
    rest |= measured_fields(laid, scene.speed, frequency, names, computed, peaks, noise)
    return kind(
        speed=scene.speed,
        frequency=frequency,
        pair=names,
        outcome=scene.outcome,
        unstable=scene.scattered(growing),
        error=error,
        error_asked=response_accuracy(scene),
        **{spec.quantity: values},
        **rest,
    )


def _on_grid(scene: Scene, spec: FrfSpec, frequency: Array, power: int) -> dict[str, Any]:
    """The fields of a result about ``spec.frequencies``; ``values`` (speeds, pairs, f) as well."""
    shape = (len(scene.usable), len(spec.pairs))
    values = np.zeros((*shape, len(frequency)), dtype=complex)
    turning = scene.conditions.formulation == ROTATING
    parts: list[tuple[list[int], Peaks]] = []
    poles: list[Poles] = []
    for k, places in _by_system(scene, spec.pairs).items() if len(frequency) else ():
        motions, pairs = scene.system(k), [spec.pairs[place] for place in places]
        answered = _answered(scene, motions, pairs, power)
        values[:, places] = grid = answered(frequency)
        _refuse_unlimited(scene, answered, motions, frequency, grid)
        poles.append(poles_of(motions, frequency[0], frequency[-1], turning=turning))
        reach = np.linalg.norm(_rows(scene, motions, pairs), axis=2).prod(axis=1)
        reach *= (2.0 * math.pi) ** power
        parts.append((places, peaks_of(answered, poles[-1], frequency, grid, reach, power)))
    at, high = joined(parts, shape)
    damping = np.full(at.shape, np.nan)
    for (places, _), each in zip(parts, poles, strict=True):
        damping[:, places] = each.damping_at(at[:, places])
    slices = _slices(scene, spec) if len(frequency) else np.zeros(0, dtype=np.intp)
    rows = {index: row for row, index in enumerate(scene.usable.tolist())}
    curves = [frequency] * len(slices)
    for place, index in enumerate(slices.tolist()):
        if (row := rows.get(index)) is not None and poles:
            tops = at[row][np.isfinite(at[row]) & np.isfinite(high[row])]  # no undamped ones
            curves[place] = curve_at([each.at(row) for each in poles], frequency, tops)
    longest = max(map(len, curves), default=0)
    axis = np.full((len(slices), longest), np.nan)
    shown = np.full((len(slices), len(spec.pairs), longest), complex(np.nan, np.nan))
    for place, (index, along) in enumerate(zip(slices.tolist(), curves, strict=True)):
        axis[place, : len(along)] = along
        between = np.ones(len(along), dtype=bool)
        between[np.searchsorted(along, frequency)] = False
        curve = shown[place, :, : len(along)]
        if between.any():
            curve[:, between] = _at_speed(scene, spec.pairs, power, index, along[between])
        if index in rows:
            curve[:, ~between] = values[rows[index]]
    return {
        "values": scene.scattered(values),
        "is_slice": np.isin(np.arange(len(scene.speed)), slices),
        "resonance": np.arange(1, at.shape[-1] + 1),
        "peak_frequency": scene.scattered(at),
        "peak_value": scene.scattered(high),
        "peak_damping": scene.scattered(damping),
        "light_mode": _light_modes(scene, spec, at, np.abs(high), damping),
        "slice_speed": scene.speed[slices],
        "place": np.arange(longest),
        "slice_frequency": axis,
        "slice_value": shown,
    }


def _light_modes(
    scene: Scene, spec: FrfSpec, at: Array, size: Array, damping: Array
) -> tuple[str, ...]:
    """The mode of the highest peak of each pair where its damping ratio is below ``LIGHT``; empty
    elsewhere, and where nothing in the machine is damped, which is said otherwise."""
    names = [""] * len(spec.pairs)
    if not np.nanmin(damping, initial=1.0) < LIGHT or undamped(scene.spindle):
        return tuple(names)
    turning = scene.conditions.formulation == ROTATING
    speed = scene.speed[scene.usable] if turning else np.zeros(len(scene.usable))
    branches, called = named(branches_of(scene, Band(BEYOND * spec.frequencies[-1])))
    for k, places in _by_system(scene, spec.pairs).items():
        modes = [(b, name) for b, name in zip(branches, called, strict=True) if b.subsystem == k]
        for place in places:
            high = np.where(np.isnan(at[:, place]), -1.0, size[:, place])
            row, top = np.unravel_index(high.argmax(), high.shape)
            if damping[row, place, top] < LIGHT and modes:
                omega = [mode.frequency_in_frame(speed)[row] for mode, _ in modes]
                hertz = np.nan_to_num(np.array(omega) / (2.0 * math.pi), nan=np.inf)
                away = np.abs(hertz - at[row, place, top])
                names[place] = modes[int(away.argmin())][1]
    return tuple(names)


def _slices(scene: Scene, spec: FrfSpec) -> Indices:
    """Places of the speeds that are drawn, among those of the case."""
    ends = scene.speed[scene.usable[[0, -1]]]
    wanted = *(spec.slices or ends), *spec.measured_speeds
    return np.unique([int(np.abs(scene.speed - each).argmin()) for each in wanted])


def _asked(scene: Scene, spec: FrfSpec) -> Array:
    """All frequencies [Hz] at which responses are asked for."""
    hertz = [line.size * scene.speed[scene.usable] for line in lines_of(scene, spec)]
    orders = np.concatenate([np.zeros(0), *hertz]) / (2.0 * math.pi)
    return np.unique(np.concatenate([spec.frequencies, orders[orders > 0.0]]))


def _at_speed(
    scene: Scene, pairs: Sequence[tuple[Port, Port]], power: int, index: int, frequency: Array
) -> Complex:
    """Responses (pairs, f) at one of the speeds; NaN where it has no solution."""
    row = np.flatnonzero(scene.usable == index)
    if not len(row):
        return np.full((len(pairs), len(frequency)), complex(np.nan, np.nan))
    return _responses(pairs, power, scene, frequency[None], row)[0]


def _responses(
    pairs: Sequence[tuple[Port, Port]],
    power: int,
    scene: Scene,
    frequency: Array,
    rows: Indices | None = None,
    *,
    few: bool = False,
) -> Complex:
    """Of all pairs at frequencies (usable, f) [Hz], or at some ``rows`` of the usable speeds:
    (usable, pairs, f). ``few`` frequencies need no modes."""
    values = np.zeros((len(frequency), len(pairs), frequency.shape[1]), dtype=complex)
    for k, places in _by_system(scene, pairs).items():
        modes = rows is None and not few
        motions = scene.system(k) if modes else scene.system_at(k, rows, few=few)
        chosen = [pairs[place] for place in places]
        values[:, places] = _answered(scene, motions, chosen, power)(frequency)
    return values


def _rows(scene: Scene, motions: FreeMotions, pairs: Sequence[tuple[Port, Port]]) -> Array:
    """Coordinates that pairs move and push (pairs, 2, n)."""
    places = [[(*scene.spindle.place(port.point), port.direction) for port in p] for p in pairs]
    return np.array([[motions.linear.row(*place) for place in both] for both in places])


def _by_system(scene: Scene, pairs: Sequence[tuple[Port, Port]]) -> dict[int, list[int]]:
    """Places of the pairs whose ends move in one subsystem; all others respond with zero."""
    grouped: dict[int, list[int]] = {}
    for place, pair in enumerate(pairs):
        owners = {scene.owner(port.point, port.direction) for port in pair}
        if len(owners) == 1:
            grouped.setdefault(owners.pop(), []).append(place)
    return grouped


def _answered(
    scene: Scene, motions: FreeMotions, pairs: Sequence[tuple[Port, Port]], power: int
) -> Answered:
    """Responses (speeds, pairs, f) of a subsystem, or of some of the pairs, by frequency (f,) or
    (speeds, f) [Hz], of which NaN is taken for 1 Hz."""
    response, excitation = _rows(scene, motions, pairs).swapaxes(0, 1)
    turning = scene.conditions.formulation == ROTATING and motions.whirling
    of_rows = motions.turning_receptance if turning else motions.receptance

    def answered(frequency: Array, some: slice = slice(None)) -> Complex:
        omega = 2.0 * math.pi * np.nan_to_num(frequency, nan=1.0)
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            values = of_rows(omega, response[some], excitation[some])
            return values * (1j * omega[..., None, :]) ** power if power else values

    return answered


def _errors(scene: Scene, spec: FrfSpec, frequency: Array, power: int) -> Array:
    """Largest change of each pair by the finer model over its peak (pairs,), at a few speeds and
    frequencies."""
    error = np.zeros(len(spec.pairs))
    if scene.rigid or not len(frequency):
        return error
    if not scene.checks.wanted:
        return np.full_like(error, np.nan)
    for k, places in _by_system(scene, spec.pairs).items():
        pairs, at = [spec.pairs[place] for place in places], _judged(scene, k, frequency)
        values = partial(_few, k, pairs, at, power)
        error[places] = np.nan_to_num(changes(scene, values, 1))
        for place in places:
            if error[place] > DOUBTFUL and _is_rounding(scene, k, spec.pairs[place], at):
                error[place] = 0.0
    return error


def _is_rounding(scene: Scene, k: int, pair: tuple[Port, Port], at: Array) -> bool:
    """A response that symmetry makes zero: nothing beside the direct ones of its two ends."""
    response, excitation = pair
    every = [pair, (response, response), (excitation, excitation)]
    between, *ends = np.abs(_few(k, every, at, 0, scene, few_rows(scene))).max(axis=(0, 2))
    return bool(between <= NOTHING * math.sqrt(ends[0] * ends[1]))


def _few(
    k: int, pairs: Sequence[tuple[Port, Port]], at: Array, power: int, scene: Scene, rows: Indices
) -> Complex:
    """Responses (rows, pairs, f) at few frequencies ``at`` (f,) [Hz]."""
    return _answered(scene, scene.system_at(k, rows, few=True), pairs, power)(at)


def _judged(scene: Scene, k: int, frequency: Array) -> Array:
    """Frequencies at which receptances are compared: some, and those next to the modes."""
    some = np.unique(np.linspace(0, len(frequency) - 1, min(GRID, len(frequency))).astype(int))
    motions = scene.system_at(k, few_rows(scene))
    hertz = frequency_of(motions, turning=scene.conditions.formulation == ROTATING)
    inside = hertz[(hertz >= frequency[0]) & (hertz <= frequency[-1])]
    after = np.searchsorted(frequency, inside)
    near = np.clip(np.concatenate([after - 1, after]), 0, len(frequency) - 1)
    return frequency[np.unique(np.concatenate([some, near]))]


def _refuse_unlimited(
    scene: Scene,
    answered: Answered,
    motions: FreeMotions,
    frequency: Array,
    values: Complex,
) -> None:
    """Raise InvalidInput where ``values`` (speeds, pairs, frequencies) have no limit: at the pole
    of a motion without damping, or so slow that a free one's overflow."""
    lost = np.asarray(~np.isfinite(values).all(axis=1))
    undamped = _near_poles(motions, frequency)
    if undamped.any() and not lost.any():
        near = frequency[undamped]
        around = [near * (1.0 + apart) for apart in (-BESIDE, BESIDE, -CLOSE, CLOSE)]
        beside = np.split(np.abs(answered(np.concatenate(around))), len(around), axis=-1)
        size = np.fmax.reduce([np.abs(values[..., undamped]), *beside[2:]])
        lost[:, undamped] = (size > HIGHER * np.maximum(*beside[:2])).any(axis=1)
    if lost.any():
        row, column = np.argwhere(lost)[0]
        rpm = scene.speed[scene.usable[min(row, len(scene.usable) - 1)]] * RPM.factor
        raise InvalidInput(
            f"frf: the response is unbounded at {frequency[column]:.10g} Hz and {rpm:.6g} rpm, "
            "where an undamped or rigid-body mode lies: add damping or a support, or drop this "
            "frequency"
        )


def _near_poles(motions: FreeMotions, frequency: Array) -> Flags:
    """Frequencies (f,) that may lie on the pole of a motion without damping."""
    pole = motions.pole
    with np.errstate(invalid="ignore"):
        undamped = np.unique(pole.imag[np.abs(pole.real) <= UNDAMPED * np.abs(pole)])
    omega = 2.0 * math.pi * frequency
    if not undamped.size:
        return np.zeros(len(omega), dtype=bool)
    place = np.searchsorted(undamped, omega)
    gaps = [np.abs(undamped[np.clip(place + k, 0, len(undamped) - 1)] - omega) for k in (-1, 0)]
    return np.asarray(np.minimum(*gaps) <= UNDAMPED * omega)
