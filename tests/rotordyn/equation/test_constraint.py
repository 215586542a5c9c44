"""Rigid links: what is left of the coordinates satisfies them, whatever their measure."""

from __future__ import annotations

import mpmath
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


@pytest.mark.parametrize("unit", [1e-9, 1e9])
def test_rows_hold_in_any_unit(unit: float) -> None:
    """One of them in nanometres beside others in metres, or the other way round."""
    draw = np.random.default_rng(8)
    stiffness = np.r_[np.zeros(2), 10.0 ** draw.uniform(4.0, 7.0, 6)]
    rows = draw.normal(size=(3, 8))
    known = allowed_motions(rows, stiffness)
    found = allowed_motions(np.array([1.0, unit, 1.0])[:, None] * rows, stiffness)
    assert found.shape == known.shape == (8, 5)
    assert found @ found.T == pytest.approx(known @ known.T, abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_the_slowest_motion_keeps_its_digits_beside_stiff_ones(seed: int) -> None:
    """Stiffness over twelve decades: the least of q in R q = 0, by decimal arithmetic, is that of
    the basis in plain numbers to rounding."""
    draw = np.random.default_rng(seed)
    stiffness = np.r_[0.0, 0.0, 10.0 ** draw.uniform(3.0, 15.0, 10)]
    rows = draw.normal(size=(4, 12))
    basis = allowed_motions(rows, stiffness)
    found = np.linalg.eigvalsh(basis.T @ (stiffness[:, None] * basis)).min()
    with mpmath.workdps(60):
        whole = mpmath.qr(mpmath.matrix(rows.T.tolist()))[0][:, 4:]
        exact = mpmath.eigsy(whole.T * mpmath.diag(stiffness.tolist()) * whole, eigvals_only=True)
        least = float(min(exact))
    assert found == pytest.approx(least, rel=1e-13)
