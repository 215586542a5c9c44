"""Whether the rotor on its supports withstands the axial force in its shaft."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.support import support_matrices, turn
from rotordyn.machine.spindle import Spindle
from rotordyn.system.condensed import CondensedRotor
from rotordyn.system.dofs import BOTH_PLANES

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
ROUNDING = 1e-12  # of a stiffness matrix with unit diagonal


def withstands(
    spindle: Spindle,
    rotor: CondensedRotor,
    unloaded: CondensedRotor,
    seat_stiffness: Array,
    speed: Array,
) -> Flags:
    """States (states,) in which the axial force takes away no stable direction.

    The symmetric part of the static stiffness of both planes must have as many negative
    eigenvalues as without axial force (``unloaded``), which is none in any machine that stands. The
    inertia of a matrix is that of the part condensed away, which ``rotor`` reports as NaN, and of
    what remains: the test is exact for the full model. ``seat_stiffness`` (states, seats, 5, 5);
    ``speed`` (states,) [rad/s]: of supports that follow it.
    """
    ours, before = (_negative(spindle, r, seat_stiffness, speed) for r in (rotor, unloaded))
    return np.asarray(ours <= before)


def _negative(
    spindle: Spindle, rotor: CondensedRotor, seat_stiffness: Array, speed: Array
) -> Array:
    """Number of negative eigenvalues (states,); infinite where the shaft alone has buckled."""
    blocks = [turn(seat_stiffness[:, k], s.thrust) for k, s in enumerate(spindle.seats)]
    blocks += [support_matrices(s, "stiffness", speed) for s in spindle.supports]
    rows = _both(np.concatenate([rotor.seats, rotor.supports]))
    held = BOTH_PLANES.take(np.stack(blocks, axis=1))
    total = np.einsum("cim,scij,cjn->smn", rows, held, rows, optimize=True)
    total = total + _both(rotor.free)
    known = np.isfinite(total).all(axis=(1, 2))
    matrix = np.where(known[:, None, None], total + np.swapaxes(total, 1, 2), 0.0)
    size = np.sqrt(np.abs(np.diagonal(matrix, axis1=1, axis2=2)))
    size = np.where(size > 0.0, size, 1.0)
    values = np.linalg.eigvalsh(matrix / size[:, :, None] / size[:, None, :])
    return np.where(known, (values < -ROUNDING).sum(axis=1), np.inf)


def _both(matrix: Array) -> Array:
    """Block diagonal of two copies."""
    zero = np.zeros_like(matrix)
    upper = np.concatenate([matrix, zero], axis=-1)
    return np.concatenate([upper, np.concatenate([zero, matrix], axis=-1)], axis=-2)
