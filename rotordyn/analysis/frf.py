"""Receptance, mobility or inertance between points at independent speed and frequency."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.accuracy import receptance_error
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
from rotordyn.analysis.specs import QUANTITIES, FrfSpec, Port
from rotordyn.elements.node import FREEDOMS
from rotordyn.errors import InvalidInput
from rotordyn.machine.support import MOTIONS
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.whirl_in_planes import receptance_in_planes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pairs = list[tuple[Port, Port]]
Answered = Callable[[Array], Complex]
MOST_VALUES = 100_000_000
UNDAMPED = 1e-9  # of the frequency: a pole so near to it has no damping
BESIDE = 1e-8  # of the frequency, to either side of which a response is compared with its
CLOSE = 1e-10  # likewise, where it is taken too: on a pole itself it may cancel by rounding
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
            within = _modal(scene, group, pairs)
            with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
                values[:, own] = within(frequency)
            near = _near_poles(scene, group, frequency)
            _refuse_unlimited(scene, within, near, frequency, values[:, own])
            error[own] = receptance_error(scene, min(group), pairs, frequency, power)
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
    suspects: NDArray[np.bool_],
    frequency: Array,
    values: Complex,
) -> None:
    """Raise InvalidInput where ``values`` (speeds, pairs, frequencies) have no limit: at the pole
    of a motion without damping, or so slow that a free one's overflow.

    ``suspects`` (f,): frequencies that may lie on such a pole.
    """
    lost = np.asarray(~np.isfinite(values).all(axis=1))
    if suspects.any() and not lost.any():
        near = frequency[suspects]
        around = [near * (1.0 + apart) for apart in (-BESIDE, BESIDE, -CLOSE, CLOSE)]
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            found = np.split(np.abs(within(np.concatenate(around))), len(around), axis=-1)
        size = np.fmax.reduce([np.abs(values[..., suspects]), *found[2:]])
        lost[:, suspects] = (size > HIGHER * np.maximum(*found[:2])).any(axis=1)
    if lost.any():
        row, column = np.argwhere(lost)[0]
        rpm = scene.speed[scene.usable[min(row, len(scene.usable) - 1)]] * RPM.factor
        raise InvalidInput(
            f"frf: nothing limits the response at {frequency[column]:.10g} Hz and {rpm:.6g} rpm, "
            "where a motion that nothing damps, or nothing holds, has its frequency: damp or hold "
            "it, or leave that frequency out"
        )


def _near_poles(scene: Scene, group: frozenset[str], frequency: Array) -> NDArray[np.bool_]:
    """Frequencies (f,) at undamped poles."""
    pole = scene.vibration(min(group))[1].pole
    own = np.unique(np.abs(pole.imag[np.abs(pole.real) <= UNDAMPED * np.abs(pole)]))
    omega = 2.0 * math.pi * frequency
    if not own.size:
        return np.zeros(len(omega), dtype=bool)
    place = np.searchsorted(own, omega)
    gaps = [np.abs(own[np.clip(place + k, 0, len(own) - 1)] - omega) for k in (-1, 0)]
    return np.asarray(np.minimum(*gaps) <= UNDAMPED * omega)


def _groups(scene: Scene) -> list[frozenset[str]]:
    """Motions that answer one another's forces."""
    coupled = scene.coupled_motions
    alone = [frozenset({m}) for m in ("bending", "axial", "torsion") if m not in coupled]
    return [coupled, *alone] if coupled else alone


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


def _quarter_turns(pairs: Pairs) -> NDArray[np.intp]:
    """Of pairs (pairs,): 0 within a plane, +1 from plane y to plane z, −1 back."""
    plane = {"y": 0, "thz": 0, "z": 1, "thy": 1}
    turns = [plane[response.direction] - plane[force.direction] for response, force in pairs]
    return np.array(turns, dtype=np.intp)
