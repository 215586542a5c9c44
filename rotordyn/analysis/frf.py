"""Receptance between points at independent speed and frequency."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.formulation import ROTATING
from rotordyn.analysis.results import FrfResult, TurningFrfResult
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import FrfSpec, Port

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
LATERAL = ("y", "z", "thy", "thz")


def answer(scene: Scene, spec: FrfSpec) -> FrfResult:
    """H (speeds, pairs, frequencies): response per unit force or moment, bearing speed included."""
    frequency = np.array(spec.frequencies)
    values = np.zeros((len(scene.usable), len(spec.pairs), len(frequency)), dtype=complex)
    lateral = [k for k, pair in enumerate(spec.pairs) if all(p.direction in LATERAL for p in pair)]
    if lateral:
        values[:, lateral] = _lateral(scene, [spec.pairs[k] for k in lateral], frequency)
    for direction in ("x", "thx"):
        along = [
            k for k, pair in enumerate(spec.pairs) if all(p.direction == direction for p in pair)
        ]
        if along:
            values[:, along] = _rod(scene, [spec.pairs[k] for k in along], direction, frequency)
    ends = scene.speed[scene.usable[[0, -1]]]
    slices = {int(np.abs(scene.speed - wanted).argmin()) for wanted in spec.slices or ends}
    kind = TurningFrfResult if scene.conditions.formulation == ROTATING else FrfResult
    return kind(
        speed=scene.speed,
        frequency=frequency,
        pair=tuple(f"{response} / {excitation}" for response, excitation in spec.pairs),
        outcome=scene.outcome,
        receptance=scene.scattered(values),
        is_slice=np.isin(np.arange(len(scene.speed)), sorted(slices)),
    )


def _lateral(scene: Scene, pairs: list[tuple[Port, Port]], frequency: Array) -> Complex:
    """Receptance of lateral pairs (speeds, pairs, frequencies).

    In the complex form a force in one plane turns both ways: with H± the answers at ±ω,
    yy and zz are (H₊ + conj H₋)/2, zy is −i (H₊ − conj H₋)/2 and yz its opposite.
    """
    system = scene.bending
    rows = [[system.row(_node(scene, p), p.direction) for p in pair] for pair in pairs]
    response, excitation = np.array(rows).swapaxes(0, 1)
    omega = 2.0 * math.pi * frequency
    if not system.isotropic:
        return scene.bending_modes.receptance(omega, response, excitation)
    m = system.rotor.size
    folded = [r[:, :m] + r[:, m:] for r in (response, excitation)]
    both = scene.bending_modes.receptance(np.concatenate([omega, -omega]), *folded)
    plus, minus = both[..., : len(omega)], both[..., len(omega) :].conj()
    turn = np.array([_quarter_turns(*pair) for pair in pairs])[:, None]
    same, across = 0.5 * (plus + minus), -0.5j * (plus - minus)
    planar = (system.stiffness.imag == 0.0).all(axis=(1, 2))
    planar &= (system.damping.imag == 0.0).all(axis=(1, 2))
    across[planar] = 0.0  # nothing couples the planes: not even rounding
    return np.where(turn == 0, same, turn * across)


def _quarter_turns(response: Port, excitation: Port) -> int:
    """0 within a plane, +1 from plane y to plane z, −1 back."""
    plane = {"y": 0, "thz": 0, "z": 1, "thy": 1}
    return plane[response.direction] - plane[excitation.direction]


def _rod(scene: Scene, pairs: list[tuple[Port, Port]], direction: str, frequency: Array) -> Complex:
    """Receptance along or about the axis (speeds, pairs, frequencies)."""
    axial = direction == "x"
    system = scene.axial if axial else scene.torsion
    found = scene.axial_modes if axial else scene.torsion_modes
    rows = [[system.row(_node(scene, p)) for p in pair] for pair in pairs]
    response, excitation = np.array(rows).swapaxes(0, 1)
    values = found.receptance(2.0 * math.pi * frequency, response, excitation)
    return np.broadcast_to(values, (len(scene.usable), *values.shape[1:]))


def _node(scene: Scene, port: Port) -> int:
    return scene.mesh.node_of(scene.spindle.points[port.point])
