"""Axial curves as they were measured: points left out, speeds that scatter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn import AxialCurve
from rotordyn.errors import InvalidInput
from tests.rotordyn.study.axial_twin import Array, curve


def _cycle(*branches: str) -> AxialCurve:
    """An uneven cycle at two speeds in this order of branches, its points by their number."""
    whole = curve("shaft", points=12, drift=3e-6)
    half = np.arange(12)
    parts = {"falling": half, "rising": half + 12}
    rows = np.concatenate([parts[word] + 24 * k for k in range(2) for word in branches])
    bent = np.sign(whole.force) * (np.abs(whole.force) / 1800.0) ** 3
    return replace(
        whole,
        speed=whole.speed[rows],
        branch=tuple(whole.branch[k] for k in rows),
        force=whole.force[rows],
        displacement=bent[rows] * 1e-5,
    )


@pytest.mark.parametrize("branches", [("falling", "rising"), ("rising", "falling")])
def test_drift_of_points_left_is_that_of_their_time(branches: tuple[str, str]) -> None:
    whole = _cycle(*branches)
    few = whole.reduced(4)
    assert len(few.force) < len(whole.force)
    rows = [_row(whole, few, k) for k in range(len(few.force))]
    assert rows == sorted(rows)
    np.testing.assert_allclose(few.data.columns, whole.data.columns[rows], rtol=1e-15)
    drift = few.data.columns[:, 1]
    assert (drift.min(), drift.max()) == (-0.5, 0.5)


def _row(whole: AxialCurve, few: AxialCurve, k: int) -> int:
    """Where a point of the few stands in the whole."""
    same: Array = (whole.speed == few.speed[k]) & (whole.force == few.force[k])
    (row,) = np.flatnonzero(same & (np.array(whole.branch) == few.branch[k]))
    return int(row)


def test_times_are_as_many_as_points() -> None:
    with pytest.raises(InvalidInput, match="when: given 2 times; the curve has 36 points"):
        curve("shaft", when=np.array([0.0, 1.0]))
