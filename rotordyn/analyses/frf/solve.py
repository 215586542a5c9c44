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
from rotordyn.modes.branches import branches_of
from rotordyn.modes.criticals import BEYOND
from rotordyn.modes.names import named
from rotordyn.results.display import RPM
from rotordyn.scene.formulation import ROTATING, require_axisymmetric, turned
from rotordyn.scene.lightly_damped import LIGHT
from rotordyn.scene.refinement import (
    changes,
    few_rows,
    response_accuracy,
    sensitive_rows,
    solve_accurately,
)
from rotordyn.scene.scene import Scene

Answered = Callable[..., Complex]  # responses by frequency [Hz], of all pairs or a slice
DOUBTFUL = 1e-2  # error over the peak, from which a response may be rounding alone
NOTHING = 1e-9  # of the direct responses at both ends: less is rounding
GRID = 24  # frequencies at which the finer model is compared, besides those of the modes
UNDAMPED = 1e-9  # of the frequency: a smaller damping, or distance from a pole, is none
BESIDE = 1e-8  # of the frequency: distance to both sides at which the reference response is taken
CLOSE = 1e-10  # likewise, for the response itself: exactly on a pole it may cancel by rounding
HIGHER = 10.0  # times the reference: a larger response is bounded by rounding alone
_KINDS: dict[str, type[FrequencyResponse]] = {
    kind.kind: kind for kind in (FrfResult, MobilityResult, InertanceResult)
}


def solve(scene: Scene, spec: FrfSpec) -> FrequencyResponse:
    """Frequency responses H (speeds, pairs, frequencies) to unit forces and moments, bearing speed
    included, of a model refined to the accuracy requested.

    Between subsystems that nothing couples H is zero.

    Raises
    ------
    InvalidInput : mobility or inertance in the rotating frame; more values than fit; a frequency
        at which the response is unbounded
    """
    turning = scene.conditions.formulation == ROTATING
    if turning:
        require_axisymmetric(scene)
        if spec.quantity != QUANTITIES[0]:
            raise InvalidInput(turned(spec.quantity))
    if turning and spec.engine_orders:
        raise InvalidInput(f"frf: engine_orders: {ORDERS_TURNED}")
    frequency = np.array(spec.frequencies, dtype=float)
    require_responses("frf", len(scene.usable), len(spec.pairs), len(frequency))
    power = QUANTITIES.index(spec.quantity)
    hertz = _requested(scene, spec)
    scene, error = solve_accurately(
        scene, lambda finer: _errors(finer, spec, hertz, power), lambda errors: float(errors.max())
    )
    responses = partial(_responses, spec.pairs, power)
    growing = np.zeros(len(scene.usable), dtype=bool)
    for k in _by_system(scene, spec.pairs):
        growing |= scene.system(k).growing.any(axis=1)
    names = tuple(f"{response} / {excitation}" for response, excitation in spec.pairs)
    kind = TurningFrfResult if turning else _KINDS[spec.quantity]
    fields: dict[str, Any] = _on_grid(scene, spec, frequency, power)
    values, peaks = fields.pop("values"), (fields["peak_frequency"], fields["peak_value"])
    fields |= line_fields(scene, spec, responses, partial(responses, few=True))
    computed = partial(_at_speed, scene, spec.pairs, power)
    with_tip, noise = with_coupled(spec, scene.spindle)
    fields |= measured_fields(with_tip, scene.speed, frequency, names, computed, peaks, noise)
    return kind(
        speed=scene.speed,
        frequency=frequency,
        pair=names,
        outcome=scene.outcome,
        unstable=scene.scattered(growing),
        error=error,
        error_asked=response_accuracy(scene),
        **{spec.quantity: values},
        **fields,
    )


def _on_grid(scene: Scene, spec: FrfSpec, frequency: Array, power: int) -> dict[str, Any]:
    """Fields of a result over ``spec.frequencies``; responses as ``values`` (speeds, pairs, f)."""
    shape = (len(scene.usable), len(spec.pairs))
    values = np.zeros((*shape, len(frequency)), dtype=complex)
    turning = scene.conditions.formulation == ROTATING
    parts: list[tuple[list[int], Peaks]] = []
    poles: list[Poles] = []
    for k, places in _by_system(scene, spec.pairs).items() if len(frequency) else ():
        motions, pairs = scene.system(k), [spec.pairs[place] for place in places]
        responses = _responses_of(scene, motions, pairs, power)
        values[:, places] = grid = responses(frequency)
        _refuse_unlimited(scene, responses, motions, frequency, grid)
        poles.append(poles_of(motions, frequency[0], frequency[-1], turning=turning))
        reach = np.linalg.norm(_rows(scene, motions, pairs), axis=2).prod(axis=1)
        reach *= (2.0 * math.pi) ** power
        parts.append((places, peaks_of(responses, poles[-1], frequency, grid, reach, power)))
    peak_at, peak = joined(parts, shape)
    damping = np.full(peak_at.shape, np.nan)
    for (places, _), subsystem in zip(parts, poles, strict=True):
        damping[:, places] = subsystem.damping_at(peak_at[:, places])
    slices = _slices(scene, spec) if len(frequency) else np.zeros(0, dtype=np.intp)
    rows = {index: row for row, index in enumerate(scene.usable.tolist())}
    curves = [frequency] * len(slices)
    for place, index in enumerate(slices.tolist()):
        if (row := rows.get(index)) is not None and poles:
            # undamped peaks are infinite
            tops = peak_at[row][np.isfinite(peak_at[row]) & np.isfinite(peak[row])]
            curves[place] = curve_at([subsystem.at(row) for subsystem in poles], frequency, tops)
    longest = max(map(len, curves), default=0)
    slice_frequency = np.full((len(slices), longest), np.nan)
    slice_value = np.full((len(slices), len(spec.pairs), longest), complex(np.nan, np.nan))
    for place, (index, along) in enumerate(zip(slices.tolist(), curves, strict=True)):
        slice_frequency[place, : len(along)] = along
        is_extra = np.ones(len(along), dtype=bool)
        is_extra[np.searchsorted(along, frequency)] = False
        curve = slice_value[place, :, : len(along)]
        if is_extra.any():
            curve[:, is_extra] = _at_speed(scene, spec.pairs, power, index, along[is_extra])
        if index in rows:
            curve[:, ~is_extra] = values[rows[index]]
    return {
        "values": scene.scattered(values),
        "is_slice": np.isin(np.arange(len(scene.speed)), slices),
        "resonance": np.arange(1, peak_at.shape[-1] + 1),
        "peak_frequency": scene.scattered(peak_at),
        "peak_value": scene.scattered(peak),
        "peak_damping": scene.scattered(damping),
        "light_mode": _light_modes(scene, spec, peak_at, np.abs(peak), damping),
        "slice_speed": scene.speed[slices],
        "place": np.arange(longest),
        "slice_frequency": slice_frequency,
        "slice_value": slice_value,
    }


def _light_modes(
    scene: Scene, spec: FrfSpec, peak_frequency: Array, size: Array, damping: Array
) -> tuple[str, ...]:
    """The mode of the highest peak of each pair where its damping ratio is below ``LIGHT``; empty
    elsewhere, and where nothing in the machine is damped, which another warning reports."""
    names = [""] * len(spec.pairs)
    if not np.nanmin(damping, initial=1.0) < LIGHT or undamped(scene.spindle):
        return tuple(names)
    turning = scene.conditions.formulation == ROTATING
    speed = scene.speed[scene.usable] if turning else np.zeros(len(scene.usable))
    branches, titles = named(branches_of(scene, 2.0 * math.pi * BEYOND * spec.frequencies[-1]))
    for k, places in _by_system(scene, spec.pairs).items():
        modes = [(b, name) for b, name in zip(branches, titles, strict=True) if b.subsystem == k]
        for place in places:
            height = np.where(np.isnan(peak_frequency[:, place]), -1.0, size[:, place])
            row, top = np.unravel_index(height.argmax(), height.shape)
            if damping[row, place, top] < LIGHT and modes:
                omega = [mode.frequency_in_frame(speed)[row] for mode, _ in modes]
                hertz = np.nan_to_num(np.array(omega) / (2.0 * math.pi), nan=np.inf)
                distance = np.abs(hertz - peak_frequency[row, place, top])
                names[place] = modes[int(distance.argmin())][1]
    return tuple(names)


def _slices(scene: Scene, spec: FrfSpec) -> Indices:
    """Indices, among the speeds of the case, of those drawn as slices."""
    ends = scene.speed[scene.usable[[0, -1]]]
    drawn_speeds = *(spec.slices or ends), *spec.measured_speeds
    return np.unique([int(np.abs(scene.speed - speed).argmin()) for speed in drawn_speeds])


def _requested(scene: Scene, spec: FrfSpec) -> Array:
    """All frequencies [Hz] at which responses are requested."""
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
    """Responses (usable, pairs, f) of all pairs at frequencies (usable, f) [Hz]; ``rows``: at these
    of the usable speeds; ``few``: there are so few frequencies that modes do not pay."""
    values = np.zeros((len(frequency), len(pairs), frequency.shape[1]), dtype=complex)
    for k, places in _by_system(scene, pairs).items():
        modes = rows is None and not few
        motions = scene.system(k) if modes else scene.system_at(k, rows, few=few)
        chosen = [pairs[place] for place in places]
        values[:, places] = _responses_of(scene, motions, chosen, power)(frequency)
    return values


def _rows(scene: Scene, motions: FreeMotions, pairs: Sequence[tuple[Port, Port]]) -> Array:
    """Rows (pairs, 2, n) of response and excitation of every pair over n coordinates."""
    places = [[(*scene.spindle.place(port.point), port.direction) for port in p] for p in pairs]
    return np.array([[motions.linear.row(*place) for place in ends] for ends in places])


def _by_system(scene: Scene, pairs: Sequence[tuple[Port, Port]]) -> dict[int, list[int]]:
    """Indices of the pairs by the subsystem that holds both ends; other responses are zero."""
    grouped: dict[int, list[int]] = {}
    for place, pair in enumerate(pairs):
        owners = {scene.owner(port.point, port.direction) for port in pair}
        if len(owners) == 1:
            grouped.setdefault(owners.pop(), []).append(place)
    return grouped


def _responses_of(
    scene: Scene, motions: FreeMotions, pairs: Sequence[tuple[Port, Port]], power: int
) -> Answered:
    """Function of frequency (f,) or (speeds, f) [Hz] and, optionally, a slice of the pairs, which
    gives responses (speeds, pairs, f) of a subsystem; NaN counts as 1 Hz."""
    response, excitation = _rows(scene, motions, pairs).swapaxes(0, 1)
    turning = scene.conditions.formulation == ROTATING
    of_rows = motions.turning_receptance if turning else motions.receptance

    def responses(frequency: Array, chosen: slice = slice(None)) -> Complex:
        omega = 2.0 * math.pi * np.nan_to_num(frequency, nan=1.0)
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            values = of_rows(omega, response[chosen], excitation[chosen])
            return values * (1j * omega[..., None, :]) ** power if power else values

    return responses


def _errors(scene: Scene, spec: FrfSpec, frequency: Array, power: int) -> Array:
    """Largest change of each pair by the finer model over its peak (pairs,), at a few speeds and
    frequencies: where that is within the accuracy, at those closest to poles too."""
    error = np.zeros(len(spec.pairs))
    if scene.rigid or not len(frequency):
        return error
    if not scene.checks.wanted:
        return np.full_like(error, np.nan)
    for k, places in _by_system(scene, spec.pairs).items():
        chosen = partial(_changes, scene, k, [spec.pairs[place] for place in places], power)
        error[places] = chosen(frequency, few_rows(scene))
        if len(scene.usable) > 2 and error[places].max() <= response_accuracy(scene):
            rows = sensitive_rows(scene, _distance(scene, k, frequency))
            if len(rows) > len(few_rows(scene)):
                error[places] = chosen(frequency, rows)
    return error


def _changes(
    scene: Scene,
    k: int,
    pairs: Sequence[tuple[Port, Port]],
    power: int,
    frequency: Array,
    rows: Indices,
) -> Array:
    """Largest change of each pair of a subsystem over its peak (pairs,), at the speeds ``rows``."""
    at = _compared(scene, k, frequency, rows)
    error = np.nan_to_num(changes(scene, partial(_at_few, k, pairs, at, power), 1, rows=rows))
    for place, pair in enumerate(pairs):
        if error[place] > DOUBTFUL and _is_rounding(scene, k, pair, at):
            error[place] = 0.0
    return error


def _distance(scene: Scene, k: int, frequency: Array) -> Array:
    """Distance of the poles from the closest of the frequencies [Hz], over the pole (usable, k);
    infinite outside the band."""
    motions = scene.system(k)
    hertz = frequency_of(motions, turning=scene.conditions.formulation == ROTATING)
    place = np.clip(np.searchsorted(frequency, hertz), 1, len(frequency) - 1)
    gap = np.minimum(*(np.abs(frequency[place - side] - hertz) for side in (0, 1)))
    inside = (hertz >= frequency[0]) & (hertz <= frequency[-1])
    with np.errstate(invalid="ignore", divide="ignore"):
        distance = np.hypot(gap, motions.pole.real / (2.0 * math.pi)) / hertz
    return np.where(inside, distance, np.inf)


def _is_rounding(scene: Scene, k: int, pair: tuple[Port, Port], at: Array) -> bool:
    """Whether a response is zero by symmetry: no more than rounding of those at its ends."""
    response, excitation = pair
    with_direct = [pair, (response, response), (excitation, excitation)]
    between, *ends = np.abs(_at_few(k, with_direct, at, 0, scene, few_rows(scene))).max(axis=(0, 2))
    return bool(between <= NOTHING * math.sqrt(ends[0] * ends[1]))


def _at_few(
    k: int, pairs: Sequence[tuple[Port, Port]], at: Array, power: int, scene: Scene, rows: Indices
) -> Complex:
    """Responses (rows, pairs, f) at few frequencies ``at`` (f,) [Hz]."""
    return _responses_of(scene, scene.system_at(k, rows, few=True), pairs, power)(at)


def _compared(scene: Scene, k: int, frequency: Array, rows: Indices) -> Array:
    """Frequencies [Hz] at which the finer model is compared: a few, and those adjacent to modes."""
    spread = np.unique(np.linspace(0, len(frequency) - 1, min(GRID, len(frequency))).astype(int))
    motions = scene.system_at(k, rows)
    hertz = frequency_of(motions, turning=scene.conditions.formulation == ROTATING)
    inside = hertz[(hertz >= frequency[0]) & (hertz <= frequency[-1])]
    after = np.searchsorted(frequency, inside)
    adjacent = np.clip(np.concatenate([after - 1, after]), 0, len(frequency) - 1)
    return frequency[np.unique(np.concatenate([spread, adjacent]))]


def _refuse_unlimited(
    scene: Scene,
    responses: Answered,
    motions: FreeMotions,
    frequency: Array,
    values: Complex,
) -> None:
    """Raise InvalidInput where ``values`` (speeds, pairs, frequencies) are unbounded: at the pole
    of an undamped mode, or at so low a frequency that the rigid-body response overflows."""
    unbounded = np.asarray(~np.isfinite(values).all(axis=1))
    on_pole = _near_poles(motions, frequency)
    if on_pole.any() and not unbounded.any():
        suspect = frequency[on_pole]
        around = [suspect * (1.0 + offset) for offset in (-BESIDE, BESIDE, -CLOSE, CLOSE)]
        neighbours = np.split(np.abs(responses(np.concatenate(around))), len(around), axis=-1)
        size = np.fmax.reduce([np.abs(values[..., on_pole]), *neighbours[2:]])
        unbounded[:, on_pole] = (size > HIGHER * np.maximum(*neighbours[:2])).any(axis=1)
    if unbounded.any():
        row, column = np.argwhere(unbounded)[0]
        rpm = scene.speed[scene.usable[min(row, len(scene.usable) - 1)]] * RPM.factor
        raise InvalidInput(
            f"frf: the response is unbounded at {frequency[column]:.10g} Hz and {rpm:.6g} rpm, "
            "where an undamped or rigid-body mode lies: add damping or a support, or drop this "
            "frequency"
        )


def _near_poles(motions: FreeMotions, frequency: Array) -> Flags:
    """Whether frequencies (f,) [Hz] may lie on the pole of an undamped mode."""
    pole = motions.pole
    with np.errstate(invalid="ignore"):
        poles = np.unique(pole.imag[np.abs(pole.real) <= UNDAMPED * np.abs(pole)])
    omega = 2.0 * math.pi * frequency
    if not poles.size:
        return np.zeros(len(omega), dtype=bool)
    place = np.searchsorted(poles, omega)
    distances = [np.abs(poles[np.clip(place + k, 0, len(poles) - 1)] - omega) for k in (-1, 0)]
    return np.asarray(np.minimum(*distances) <= UNDAMPED * omega)
