"""Loads per newton of their size, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.statics import Across


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
