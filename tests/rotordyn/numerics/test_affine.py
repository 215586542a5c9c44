"""Fixed points of affine functions: against a direct solution; none where there is none."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.affine import fixed_points


def test_fixed_points_are_those_of_a_direct_solution() -> None:
    rng = np.random.default_rng(5)
    matrix, still = rng.normal(size=(3, 12, 12)), rng.normal(size=(3, 12))
    still[1] = 0.0
    found, good = fixed_points(lambda x: (matrix @ x[..., None])[..., 0] + still, 12, 3)
    wanted = np.linalg.solve(np.eye(12) - matrix, still[..., None])[..., 0]
    assert good.all()
    assert found == pytest.approx(wanted, rel=1e-9, abs=1e-12)


def test_a_function_without_a_fixed_point_is_said() -> None:
    rise = np.stack([np.arange(1.0, 5.0), np.zeros(4)])
    assert fixed_points(lambda x: x + rise, 4, 2)[1].tolist() == [False, True]
    assert not fixed_points(lambda x: x * np.nan, 4, 2)[1].any()
