"""Derivatives of fitted curves by their poles against differences."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.pole_refinement import _moved, _moving
from rotordyn.numerics.vector_fit import columns, real_unknowns


@pytest.mark.parametrize("pole", [[-3.0 + 40j, -6.0 + 55j], [-9.0 + 0j, -3.0 + 40j]])
def test_curves_move_with_their_poles_as_reported(pole: list[complex]) -> None:
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


def test_no_step_takes_more_than_nine_tenths_of_a_pole() -> None:
    """Neither its decay nor its frequency; smaller steps are taken as they are, in |p|."""
    pole = np.array([-3.0 + 4.0j, -0.02 + 0.0j, -0.3 + 0.4j])
    step = np.array([0.1, -0.2, 0.5, 7.0, -9.0])
    moved = _moved(pole, step)
    assert moved == pytest.approx(np.array([-2.5 + 3.0j, -0.01, -0.03 + 0.04j]))
