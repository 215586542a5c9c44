"""Loads per newton of their size, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.statics import Across, _negative


@pytest.mark.parametrize(
    ("load", "pull", "newtons"),
    [
        ([9.0, 3.0, 4.0, 9.0, 0.0, 0.5], (3.0, 4.0), 5.0 + 0.5 / 0.25 + 5.0 * 2.0),
        ([0.0, 0.0, 0.0, 0.0, -0.5, 0.0], (0.0, 0.0), 0.5 / 0.25),
    ],
)
def test_size_of_loads(load: list[float], pull: tuple[float, float], newtons: float) -> None:
    """Moments count by a length of 0.25 m, weight by a mass of 2 kg; what is along x does not."""
    given = Across((("here", np.array(load)),), pull)  # type: ignore[arg-type]
    share, size = given.per_newton(0.25, 2.0)
    assert size == pytest.approx(newtons)
    assert share.points[0][1] * size == pytest.approx(load)
    assert np.multiply(share.pull, size) == pytest.approx(pull)


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e9])
def test_falling_motions_are_counted_and_rounding_is_none(unit: float) -> None:
    """By Sylvester's law of inertia RᵀKR has as many negative values as K, in any measure; what
    nothing holds is not negative for the rounding of it."""
    draw = np.random.default_rng(4)
    turn = np.linalg.qr(draw.normal(size=(3, 5, 5)))[0] * 10.0 ** draw.uniform(-2, 2, (3, 1, 5))
    values = np.array(
        [[1.0, 2.0, 3.0, 4.0, 5.0], [-1.0, -1e-3, 0.0, 2.0, 3.0], [0.0, 0.0, 0.0, 1.0, 2.0]]
    )
    matrices = unit * np.swapaxes(turn, 1, 2) @ (values[:, :, None] * turn)
    assert _negative(matrices).tolist() == [0.0, 2.0, 0.0]
    matrices[1, 0, 0] = np.nan
    assert _negative(matrices).tolist() == [0.0, np.inf, 0.0]
