"""Derivatives of fitted curves by their poles against differences."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.pole_refinement import _moving
from rotordyn.numerics.vector_fit import columns, real_unknowns


@pytest.mark.parametrize("pole", [[-3.0 + 40j, -6.0 + 55j], [-9.0 + 0j, -3.0 + 40j]])
def test_curves_move_with_their_poles_as_told(pole: list[complex]) -> None:
    """Central differences over the real and the imaginary part of each pole, over its size."""
    omega, poles = np.linspace(20.0, 80.0, 31), np.array(pole)
    wanted = real_unknowns(poles)
    rng = np.random.default_rng(4)
    known = rng.standard_normal((2, int(wanted.sum()) + 1))
    told = _moving(omega, poles, known)
    assert told.shape == (2, 31, wanted.sum())
    step = 1e-6
    for at, (place, way) in enumerate(np.argwhere(wanted)):
        curves = []
        for sign in (1.0, -1.0):
            moved = poles.copy()
            moved[place] += sign * step * abs(poles[place]) * (1.0, 1.0j)[way]
            curves.append(columns(omega, moved) @ known[:, :-1].T)
        difference = (curves[0] - curves[1]).T / (2.0 * step)
        size = np.abs(difference).max()
        assert np.abs(told[:, :, at] - difference).max() < 1e-7 * size
