"""Answers of an exact rotor to harmonic forces, many frequencies at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.oracles.exact_shaft.banded import solve
from tests.oracles.exact_shaft.rotor import ExactRotor
from tests.oracles.exact_shaft.shooting import Shooting

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def receptance(
    rotor: ExactRotor, omega: Array, stations: Array, forces: list[tuple[float, Complex]]
) -> Complex:
    """Displacements (forces, frequencies, stations, 2·planes) in SI, in circular parts.

    ``omega`` (k,) [rad/s], in one plane also negative; ``stations`` (s,) [m]; each of ``forces``:
    the station of a node and the force and moment (2·planes,) there, in circular parts. One
    factorisation a frequency serves all of them.
    """
    fine = rotor.up_to(float(np.abs(omega).max()))
    equations, parts = Shooting.of(fine), 2 * fine.planes
    right = np.zeros((equations.size, len(forces)), dtype=complex)
    for column, (x, force) in enumerate(forces):
        whole = np.pad(force, (0, fine.width - parts))
        right[:, column] = equations.load(fine.node_of(x), whole)
    answer = np.empty((len(forces), len(omega), len(stations), parts), dtype=complex)
    for own in equations.batches(len(omega)):
        found = solve(equations.matrix(omega[own]), right)
        for column in range(len(forces)):
            shape = equations.displacement(found[..., column], omega[own], stations)
            answer[column, own] = shape[..., :parts]
    return answer
