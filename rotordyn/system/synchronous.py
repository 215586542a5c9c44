"""Motion that turns with a rotor: what unbalance does, and what supports answer.

In the fixed frame a motion r = ρ e^(iΩt) of both planes is y = Re(ρ e^(iΩt)), z = Re(−iρ e^(iΩt));
in the frame that turns with the shaft it stands still.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import position
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.whirl_in_planes import FORWARD

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
System = LateralSystem | CoupledSystem
_ACROSS = [position("y"), position("z")]


def frame_of(system: System, speed: Array) -> Array:
    """Speed at which the coordinates turn (speeds,) [rad/s]."""
    return np.zeros_like(speed) if isinstance(system, CoupledSystem) else system.frame


def synchronous(system: System, speed: Array, loads: Complex) -> Complex:
    """Coordinates (speeds, n) under ``loads`` Ω² e^(iΩt); at rest nothing moves.

    ``speed`` Ω (speeds,) [rad/s]: of the rotor that is out of balance, below 0 where it turns
    against the spindle, at the speeds of the system; ``loads`` (nodes, 2) [kg·m, kg·m²]: on
    r = y + i z and on its tilt. Where the dynamic stiffness is singular the answer is not finite.
    """
    force = _on_coordinates(system, loads)
    moved = np.zeros((len(speed), len(force)), dtype=complex)
    omega = speed - frame_of(system, speed)
    for row in np.flatnonzero(speed):
        w = omega[row]
        dynamic = system.stiffness[row] + 1j * w * system.damping[row] - w**2 * np.eye(len(force))
        try:
            moved[row] = np.linalg.solve(dynamic, speed[row] ** 2 * force)
        except np.linalg.LinAlgError:
            moved[row] = complex(np.inf, np.inf)
    return moved


def displacements(system: System, moved: Complex, nodes: list[int]) -> Complex:
    """Of ``nodes`` along y and z (speeds, nodes, 2), by coordinates (speeds, n)."""
    if isinstance(system, LateralSystem) and system.isotropic:
        rows = np.array([system.rotor.row(node, "y") for node in nodes])
        return np.asarray((moved @ rows.T)[..., None] * FORWARD)
    return np.asarray(np.einsum("kin,sn->ski", system.motion[nodes][:, _ACROSS], moved))


def support_forces(system: System, speed: Array, moved: Complex) -> Complex:
    """Of bearings, then supports on the shaft along y and z (speeds, connections, 2) [N]."""
    if isinstance(system, LateralSystem):
        return _bending_forces(system, speed, moved)
    own = system.parts["bending"]
    assert isinstance(own, LateralSystem), "bending is a lateral system"
    force = _bending_forces(own, speed, moved[:, system.places["bending"]])
    at = np.einsum("kin,sn->ski", system.at_supports, moved)
    matrix = _dynamic(system.supports[0], system.supports[1], speed)
    between = np.einsum("skij,skj->ski", matrix, at)
    first = force.shape[1] - len(system.at_supports)
    force[:, first:] -= between[..., _ACROSS]
    if system.carried is not None:
        under = np.einsum("kin,sn->ski", system.carried.under, moved)
        matrix = _dynamic(system.carried.held, system.carried.damped, speed)
        force += np.einsum("skij,skj->ski", matrix, under)[..., _ACROSS]
    return force


def _on_coordinates(system: System, loads: Complex) -> Complex:
    if isinstance(system, CoupledSystem):
        force = np.zeros(system.stiffness.shape[-1], dtype=complex)
        own = system.parts["bending"]
        assert isinstance(own, LateralSystem), "bending is a lateral system"
        force[system.places["bending"]] = _on_coordinates(own, loads)
        return force
    plane = system.rotor.basis.T @ loads.ravel()
    return plane if system.isotropic else np.concatenate(list(np.outer(FORWARD, plane)))


def _bending_forces(system: LateralSystem, speed: Array, moved: Complex) -> Complex:
    m = system.rotor.size
    planes = [moved[:, k * m : (k + 1) * m] for k in range(system.planes)]
    parts = [np.einsum("cjm,sm->scj", system.rows, plane) for plane in planes]
    stretched = np.concatenate(parts, axis=-1)
    matrix = _dynamic(system.held, system.damped, speed)
    force = -np.einsum("scij,scj->sci", matrix, stretched)
    if system.isotropic:
        return np.asarray(force[..., :1] * FORWARD)
    return np.asarray(force[..., ::2])


def _dynamic(stiffness: NDArray[Any], damping: NDArray[Any], speed: Array) -> Complex:
    """K + iΩ C (speeds, connections, k, k)."""
    return np.asarray(stiffness + 1j * speed[:, None, None, None] * damping)
