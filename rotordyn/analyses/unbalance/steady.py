"""Steady motion by unbalance, in the coordinates of each subsystem that is out of balance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.unbalance.loads import node_loads
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.arrays import Array, Complex
from rotordyn.equation.constraint import along
from rotordyn.equation.dofs import position
from rotordyn.equation.free_motion import FORWARD, stiffness_with_signs
from rotordyn.equation.hysteresis import SYNCHRONOUS
from rotordyn.equation.linear import Linear
from rotordyn.equation.shaft import PLANES
from rotordyn.scene.scene import Scene

AXES = ("y", "z")


def out_of_balance(scene: Scene, spec: UnbalanceSpec) -> list[int]:
    """Return the subsystems out of balance; several of rotors without connection."""
    return sorted({scene.owner(at, "y") for at in spec.acting})


class Steady(NamedTuple):
    """Coordinates ``moved`` (speeds, n), and the residual forces ``left`` (speeds, n) that rigid
    supports carry."""

    moved: Complex
    left: Complex


def steady(scene: Scene, linear: Linear, spec: UnbalanceSpec, speed: Array) -> Steady:
    """Return the motion under rotating loads Ω² e^(iΩt), 0 at rest.

    ``speed`` Ω (speeds,) [rad/s] of the rotor that is out of balance, below 0 where it turns
    against the spindle: its motion is then that of the conjugate loads. Where the dynamic stiffness
    is singular the motion is infinite.
    """
    force = load_of(scene, linear, spec)
    stiffness, damping = stiffness_with_signs(linear, SYNCHRONOUS), linear.within(linear.damping)
    whole: NDArray[np.inexact] = linear.stiffness
    if linear.loss is not None:
        whole = whole + linear.loss.stiffness(SYNCHRONOUS)
    moved, left = np.zeros((2, len(speed), linear.size), dtype=complex)
    for row in np.flatnonzero(speed):
        w = abs(speed[row])
        dynamic = stiffness[row] + 1j * w * damping[row] - w**2 * np.eye(stiffness.shape[-1])
        load = w**2 * (force if speed[row] > 0.0 else np.conj(force))
        try:
            reduced = np.linalg.solve(dynamic, along(load, linear.basis))
        except np.linalg.LinAlgError:
            moved[row] = left[row] = complex(np.inf, np.inf)
            continue
        moved[row] = linear.basis @ reduced
        inertia = w**2 * moved[row] - 1j * w * (linear.damping[row] @ moved[row])
        left[row] = load + inertia - whole[row] @ moved[row]
    is_backward = (speed < 0.0)[:, None]
    return Steady(*(np.where(is_backward, values.conj(), values) for values in (moved, left)))


def load_of(scene: Scene, linear: Linear, spec: UnbalanceSpec) -> Complex:
    """Return the load on the coordinates (n,) per Ω² [kg·m]."""
    loads, motion = node_loads(scene.spindle, scene.mesh, spec), linear.motion
    parts = [
        direction * np.einsum("nfc,f,nf->c", motion[:, [position(n) for n in names]], signs, loads)
        for direction, (names, signs) in zip(FORWARD, PLANES.values(), strict=True)
    ]
    return np.asarray(parts[0] + parts[1])


def displacement_rows(scene: Scene, linear: Linear, spec: UnbalanceSpec) -> Array:
    """Return rows (points, 2, n): motion of the points along y and z by the coordinates."""
    places = [scene.spindle.place(name) for name in spec.points]
    return np.array([[linear.row(*place, axis) for axis in AXES] for place in places])


def displacements(scene: Scene, linear: Linear, spec: UnbalanceSpec, motion: Steady) -> Complex:
    """Return displacements of the points along y and z (speeds, points, 2)."""
    return np.einsum("pan,sn->spa", displacement_rows(scene, linear, spec), motion.moved)
