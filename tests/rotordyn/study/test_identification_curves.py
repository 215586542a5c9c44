"""Axial curves as they were measured: points omitted, speeds that scatter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn import AxialCurve
from rotordyn.errors import InvalidInput
from rotordyn.study.identification.along_axis import RPM
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
    """Place of a point of the few in the whole."""
    same: Array = (whole.speed == few.speed[k]) & (whole.force == few.force[k])
    (row,) = np.flatnonzero(same & (np.array(whole.branch) == few.branch[k]))
    return int(row)


def test_times_are_as_many_as_points() -> None:
    with pytest.raises(InvalidInput, match="when: given 2 times; the curve has 36 points"):
        curve("shaft", when=np.array([0.0, 1.0]))


def test_measured_speeds_that_scatter_are_one() -> None:
    exact = _cycle("falling", "rising")
    scatter = np.tile([-1.0, 0.0, 1.0], len(exact.speed) // 3) * RPM
    measured = replace(exact, speed=exact.speed + scatter)
    assert measured.speed == pytest.approx(exact.speed, rel=1e-12)
    assert measured.data.column_names == exact.data.column_names
    np.testing.assert_allclose(measured.data.columns, exact.data.columns, rtol=1e-12)
    rest = replace(exact, speed=np.where(exact.speed == exact.speed[0], 0.0, 5.0 * RPM))
    assert len(set(rest.speed.tolist())) == 2


def test_speeds_neither_one_nor_several_are_refused() -> None:
    whole = curve("shaft")
    drifts = np.linspace(4000.0, 4200.0, len(whole.force)) * RPM
    with pytest.raises(InvalidInput, match="from 4000 to 4200 rpm are too far apart for one"):
        replace(whole, speed=drifts)
    twice = np.where(whole.speed == whole.speed[0], 4000.0, 4010.0) * RPM
    with pytest.raises(InvalidInput, match=r"at 4005 rpm \(4000 to 4010 rpm, taken as one\)"):
        replace(whole, speed=twice)
