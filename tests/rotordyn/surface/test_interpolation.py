"""Between its nodes an element moves as the beam does that it represents."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.dofs import DIRECTIONS
from rotordyn.surface.interpolation import between_nodes

LENGTH, FORCE, BENDING, SHEAR = 0.7, 300.0, 4e4, 2e6
Y, Z, THX, THY, THZ = (DIRECTIONS.index(name) for name in ("y", "z", "thx", "thy", "thz"))


def cantilever(x: np.ndarray) -> np.ndarray:
    """Timoshenko's solution under forces at the end, F along y and 2i F along z; (len(x), 6)."""
    deflection = FORCE * (x**2 * (3.0 * LENGTH - x) / (6.0 * BENDING) + x / SHEAR)
    tilt = FORCE * x * (2.0 * LENGTH - x) / (2.0 * BENDING)
    motion = np.zeros((len(x), 6), complex)
    motion[:, Y], motion[:, THZ] = deflection, tilt
    motion[:, Z], motion[:, THY] = 2j * deflection, -2j * tilt
    motion[:, 0], motion[:, THX] = 3e-5 * x, 2e-3j * x
    return motion


@pytest.mark.parametrize("nodes", [2, 3, 6])
def test_static_deflection_is_exact_everywhere(nodes: int) -> None:
    node = LENGTH * np.linspace(0.0, 1.0, nodes) ** 1.3
    phi = 12.0 * BENDING / (SHEAR * np.diff(node) ** 2)
    x = np.linspace(0.0, LENGTH, 41)
    found = between_nodes(node, cantilever(node), phi, x)
    assert found == pytest.approx(cantilever(x), rel=1e-12, abs=1e-15)


def test_without_the_shear_parameter_it_is_not() -> None:
    node, x = np.linspace(0.0, LENGTH, 2), np.linspace(0.0, LENGTH, 41)
    found = between_nodes(node, cantilever(node), np.zeros(1), x)
    assert np.abs(found - cantilever(x)).max() > 0.02 * np.abs(cantilever(x)).max()


def test_beyond_the_ends_it_moves_as_the_end() -> None:
    node = np.array([0.0, 0.1, 0.3])
    motion = np.arange(18.0).reshape(3, 6).astype(complex)
    found = between_nodes(node, motion, np.ones(2), np.array([-1.0, 0.1, 5.0]))
    assert found == pytest.approx(motion)
