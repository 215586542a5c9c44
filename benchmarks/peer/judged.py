"""Errors of both sides: against the exact shaft, and against dense solutions of their matrices."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.peer import machine
from benchmarks.peer.cases import (
    ALL,
    ASKED,
    CAMPBELL,
    FINE,
    RESPONSE,
    SETTINGS,
    case,
    pairs,
    spindle,
)
from benchmarks.peer.dense import Dense, of_ours, of_theirs
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.bending import exact_poles, exact_receptance

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FREEDOMS = (0, 1, 3, 4)  # of a node of the peer: ``machine.MOTIONS`` here
MATCHED = 1e-2  # relative: a mode farther from all others has no partner
RESPONSES = (RESPONSE, ALL)
SPEEDS = machine.SPEEDS[machine.JUDGED]
SAMPLE = machine.FREQUENCIES[machine.SAMPLE]


def judged(kind: str, theirs: dict[str, Array]) -> dict[str, Any]:
    """Errors of the works, by setting of rotordyn and of the ``peer``."""
    truth: dict[str, Any] = {CAMPBELL: [own[: machine.MODES] for own in exact_modes(kind)]}
    truth |= {work: exact_response(work, kind) for work in RESPONSES}
    peer, column = of_theirs(theirs, FREEDOMS), theirs["response"]
    found = {"peer": {CAMPBELL: mode_errors(theirs["pole"][machine.JUDGED], truth[CAMPBELL], peer)}}
    for work in RESPONSES:
        own = column if work == ALL else column[:, [[machine.INPUT]], :1]
        found["peer"][work] = response_errors(own.reshape(truth[work].shape), truth[work], peer)
    for name, setting in SETTINGS.items():
        found[name] = _ours(kind, setting, truth)
    return found


def _ours(kind: str, setting: Conditions, truth: dict[str, Any]) -> dict[str, Any]:
    def dense(work: str, highest: float, spin: float) -> Dense:
        accuracy = None if setting.element_length is not None else setting.accuracy
        return of_ours(spindle(kind, every_node=work == ALL), accuracy, highest, spin)

    found = {}
    if setting in ASKED[CAMPBELL]:
        modes = our_modes(kind, setting)
        own = dense(CAMPBELL, machine.BAND, machine.SPEEDS[-1])
        found[CAMPBELL] = mode_errors(modes, truth[CAMPBELL], own)
    for work in RESPONSES:
        if setting in ASKED[work]:
            own = dense(work, machine.FREQUENCIES[-1], machine.SPEED)
            response = our_response(work, kind, setting)
            found[work] = response_errors(response, truth[work], own)
    return found


def our_modes(kind: str, setting: Conditions, speeds: tuple[float, ...] = SPEEDS) -> list[Complex]:
    """Poles of all modes of the band at every speed, by frequency; the last speed is the highest
    of the work, so that the elements are those of the work."""
    found = rotordyn.run(case(CAMPBELL, kind, setting, speeds))["campbell"]
    return [_by_frequency(row) for row in _poles(found)]


def exact_modes(kind: str) -> list[Complex]:
    """Poles of the exact shaft; axial motion and torsion by elements of an accuracy of 1e-8."""
    found = rotordyn.run(case(CAMPBELL, kind, FINE, SPEEDS))["campbell"]
    others = _poles(found)[:, found["kind"].to_numpy() != "bending"]
    bending = exact_poles(_scene(CAMPBELL, kind, SPEEDS, machine.BAND), 1.1 * machine.BAND)
    bending = bending.real + 1j * np.abs(bending.imag)
    return [_by_frequency(row) for row in np.concatenate([bending, others], axis=1)]


def exact_response(work: str, kind: str) -> Complex:
    """As ``our_response``, for the exact shaft."""
    scene = _scene(work, kind, (machine.SPEED,), SAMPLE[-1])
    return _by_node(work, exact_receptance(scene, pairs(work), np.array(SAMPLE))[0].T)


def _scene(work: str, kind: str, speeds: tuple[float, ...], highest: float) -> Scene:
    return Scene(spindle(kind, every_node=work == ALL), FINE, np.array(speeds), highest)


def _poles(found: Any) -> Complex:
    frequency, ratio = found["frequency"].to_numpy(), found["damping_ratio"].to_numpy()
    return np.asarray(2.0 * math.pi * frequency * (1j - ratio / np.sqrt(1.0 - ratio**2)))


def _by_frequency(pole: Complex) -> Complex:
    known = pole[np.isfinite(pole)]
    return known[np.argsort(known.imag)]


def our_response(work: str, kind: str, setting: Conditions) -> Complex:
    """Motions of the nodes (frequencies, nodes, 4), or that of the input (frequencies, 1, 1)."""
    found = rotordyn.run(case(work, kind, setting, frequencies=SAMPLE))["frf"]
    return _by_node(work, found["receptance"].to_numpy()[0].T)


def _by_node(work: str, values: Complex) -> Complex:
    shape = (machine.NODES, len(machine.MOTIONS)) if work == ALL else (1, 1)
    return np.asarray(values.reshape(len(SAMPLE), *shape))


def mode_errors(
    found: Any, exact: list[Complex], dense: Dense, speeds: tuple[float, ...] = SPEEDS
) -> dict[str, Any]:
    """Largest relative errors of the poles, and how many modes have no partner."""
    true, discrete, missing = [], [], 0
    for spin, own, truth in zip(speeds, found, exact, strict=True):
        pairs = partners(truth, np.asarray(own))
        missing += len(truth) - len(pairs)
        true += [abs(a - b) / abs(a) for a, b in pairs]
        same = partners(dense.poles(spin), np.array([b for _, b in pairs]))
        discrete += [abs(a - b) / abs(a) for a, b in same]
    return {"true": max(true), "discrete": max(discrete), "missing": missing}


def partners(wanted: Complex, found: Complex) -> list[tuple[complex, complex]]:
    """Each of ``wanted`` with the nearest of ``found`` that is left, the closest pairs first."""
    apart = np.abs(wanted[:, None] - found) / np.abs(wanted)[:, None]
    pairs = []
    while apart.size and apart.min() < MATCHED:
        a, b = np.unravel_index(int(apart.argmin()), apart.shape)
        pairs.append((complex(wanted[a]), complex(found[b])))
        apart[a], apart[:, b] = math.inf, math.inf
    return pairs


def response_errors(found: Complex, exact: Complex, dense: Dense) -> dict[str, float]:
    """Errors over the largest response of the same unit at the same frequency."""
    omega = 2.0 * math.pi * np.array(SAMPLE)
    own = dense.response(machine.SPEED, omega, 4 * machine.INPUT)
    if found.shape[1] == 1:
        own = own[:, [machine.INPUT], :1]
    true, discrete = off(found, exact), off(found, own)
    return {
        "true": float(np.median(true)),
        "worst": float(true.max()),
        "discrete": float(discrete.max()),
    }


def off(found: Complex, wanted: Complex) -> Array:
    """Largest difference over largest value, of deflections and of tilts (frequencies, 1 or 2)."""
    halves = (slice(None, 2), slice(2, None)) if wanted.shape[2] > 1 else (slice(None),)
    ratios = [
        np.abs((found - wanted)[..., part]).max(axis=(1, 2)) / np.abs(wanted[..., part]).max((1, 2))
        for part in halves
    ]
    return np.stack(ratios, axis=1)
