"""A thin disc has no inertia against tilting at twice its speed: that is no critical speed."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.synchronous import synchronous


@pytest.mark.parametrize("slope", [None, np.diag([0.0, 0.0, 1e-3])])
def test_motions_without_inertia_are_omitted(slope: np.ndarray | None) -> None:
    stiffness, polar = np.diag([4.0, 9.0, 16.0]), np.diag([0.0, 2.0, 0.0])
    spin, vectors = synchronous(stiffness, -1j * polar, 2.0, slope)
    assert spin == pytest.approx([1.0, 2.0], rel=1e-3)
    assert vectors.shape == (3, 2)
    assert not vectors[1].any()
    back, _ = synchronous(stiffness, 1j * polar, 2.0, slope)
    assert back == pytest.approx([1.0, 3.0 / np.sqrt(8.0), 2.0], rel=1e-3)
