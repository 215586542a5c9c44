"""Rigid links: what is left of the coordinates satisfies them, whatever their measure."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.constraint import allowed_motions


@pytest.mark.parametrize("seed", range(6))
def test_allowed_motions_satisfy_their_rows(seed: int) -> None:
    """Rigid and elastic coordinates of very different stiffness, rows of which one follows from
    two others; as many motions are left as there are coordinates beyond the rank."""
    draw = np.random.default_rng(seed)
    stiffness = np.r_[np.zeros(3), 10.0 ** draw.uniform(3.0, 12.0, 6)]
    rows = draw.normal(size=(3, 9)) * np.array([[1.0], [40.0], [0.02]])
    rows[:, :3] *= np.array([1.0, 0.1, 7.0])
    rows = np.vstack([rows, rows[0] - 0.3 * rows[1]])
    found = allowed_motions(rows, stiffness)
    assert found.shape == (9, 6)
    assert found.T @ found == pytest.approx(np.eye(6), abs=1e-12)
    assert np.abs(rows @ found / np.linalg.norm(rows, axis=1)[:, None]).max() < 1e-12
