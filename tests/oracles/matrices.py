"""Support matrices: random, turned about the axis, as entries."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from rotordyn.equation.dofs import DIRECTIONS
from rotordyn.machine.support import LinearSupport

Array = NDArray[np.float64]
LENGTH = 0.1  # m, between a force and its moment


def entries(matrix: Array) -> dict[tuple[str, str], float]:
    """All 36 entries of a matrix by pair of DOF."""
    return {
        (row, column): float(matrix[i, j])
        for i, row in enumerate(DIRECTIONS)
        for j, column in enumerate(DIRECTIONS)
    }


def held(name: str, x: float, stiffness: Array, damping: Array | None = None) -> LinearSupport:
    """A support with whole 6×6 matrices."""
    return LinearSupport(name, x, entries(stiffness), {} if damping is None else entries(damping))


def definite(numbers: Array, size: float) -> Array:
    """Symmetric positive definite (6, 6) of ``size`` [N/m or N s/m] from numbers (6, 6) of −1…1."""
    root = numbers @ numbers.T + 0.2 * np.eye(6)
    scale = np.sqrt(size / np.diag(root)) * np.array([1.0, 1.0, 1.0, LENGTH, LENGTH, LENGTH])
    return np.asarray(root * np.outer(scale, scale))


@st.composite
def definites(draw: Any, smallest: float, largest: float) -> Array:
    """Random symmetric positive definite matrices with full coupling."""
    numbers = draw(st.lists(st.floats(-1.0, 1.0), min_size=36, max_size=36))
    power = draw(st.floats(np.log10(smallest), np.log10(largest)))
    return definite(np.reshape(numbers, (6, 6)), 10.0**power)


def turn_about_axis(angle: float) -> Array:
    """R (6, 6): components of a vector turned about x by ``angle`` [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    part = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    return np.kron(np.eye(2), part)
