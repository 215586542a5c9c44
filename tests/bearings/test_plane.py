"""Rows and blocks of the plane against NumPy's arrays, of every length."""

from __future__ import annotations

import numpy as np
import pytest

from bearings.ball import plane

DRAW = np.random.default_rng(2)


@pytest.mark.parametrize("length", [2, 3, 4])
def test_rows(length: int) -> None:
    a, b = (tuple(row) for row in DRAW.normal(size=(2, length)))
    assert plane.plus(a, b) == pytest.approx(np.add(a, b), rel=1e-14)
    expected = 2.0 * np.array(a) - 3.0 * np.array(b)
    assert plane.combined(2.0, a, -3.0, b) == pytest.approx(expected, rel=1e-13)


def test_blocks() -> None:
    block = DRAW.normal(size=(2, 2))
    rows = tuple(tuple(row) for row in block)
    assert plane.determinant(rows) == pytest.approx(np.linalg.det(block), rel=1e-12)
    assert np.array(plane.inverse(rows)) == pytest.approx(np.linalg.inv(block), rel=1e-12)
    assert np.array(plane.inverse(((1.0, 2.0), (2.0, 4.0)))).tolist() == [[0.0, 0.0], [0.0, 0.0]]


def test_values_with_derivatives() -> None:
    """Sum, difference and product of f and g by differences of both."""
    at, step = DRAW.normal(size=4), 1e-6
    one, two = DRAW.normal(size=(2, 4))

    def polar(w: np.ndarray, x: np.ndarray) -> plane.Polar:
        return plane.Polar(float(np.sin(w @ x)), tuple(np.cos(w @ x) * w))

    for way in (plane.times, plane.more_by, plane.less_by):
        told = way(polar(one, at), polar(two, at)).by
        for k, unit in enumerate(np.eye(4)):
            ends = [
                way(polar(one, at + h * unit), polar(two, at + h * unit)).value
                for h in (step, -step)
            ]
            assert told[k] == pytest.approx((ends[0] - ends[1]) / (2.0 * step), abs=1e-8)
