"""The stiffness of four-point bearings against differences of the load."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.oracles.four_point import Drawing
from tests.oracles.known_bearings import RPM
from tests.oracles.known_grooves import (
    QJ218,
    four_point,
    lever,
)

Array = NDArray[np.float64]
BOTH = pytest.mark.parametrize("dynamics", ["frozen", "resultant"])


def loads_at(drawing: Drawing, points: Array, speed: float, dynamics: str) -> Array:
    """Loads as forces (…, 5)."""
    flat = points.reshape(-1, 5)
    s = four_point(drawing).equilibrium(displacement=flat, speed=speed, dynamics=dynamics)
    assert (s.outcome == "").all()
    return (s.load / lever(drawing)).reshape(points.shape)


STATES = [
    ([20e3, 0.0, 0.0, 0.0, 0.0], 0.0),
    ([20e3, 8e3, 0.0, 0.0, 200.0], 10000.0),
    ([-10e3, 1e3, 4e3, 50.0, 0.0], 12000.0),
    ([0.0, 8e3, 0.0, 0.0, 0.0], 10000.0),
]


@BOTH
@pytest.mark.parametrize(("load", "rpm"), STATES)
def test_stiffness_equals_differences_of_the_load(
    load: list[float], rpm: float, dynamics: str
) -> None:
    """Five points, 10 nm apart; no contact of these states is that near to a change."""
    unit, step = lever(QJ218), 1e-8
    s = four_point(QJ218).equilibrium(load=load, speed=rpm * RPM, dynamics=dynamics)
    moves = np.array([1.0, -1.0, 2.0, -2.0])[:, None, None] * step * np.eye(5) / unit
    f = loads_at(QJ218, s.displacement + moves, rpm * RPM, dynamics)
    slope = ((8.0 * (f[0] - f[1]) - (f[2] - f[3])) / (12.0 * step)).T
    k = s.stiffness("complete") / unit / unit[:, None]
    assert k == pytest.approx(slope, abs=1e-6 * np.abs(k).max())


def third_contact(drawing: Drawing, speed: float) -> float:
    """δx [m] under pure thrust below which a third contact bears."""
    b = four_point(drawing)
    low, high = 0.5 * drawing.axial_play, 0.5 * drawing.axial_play + 150e-6
    for _ in range(12):
        grid = np.linspace(low, high, 33)
        s = b.equilibrium(displacement=np.outer(grid, np.eye(5)[0]), speed=speed, dynamics="frozen")
        last = int(np.flatnonzero((s.contacts > 2).all(axis=-1))[-1])
        low, high = grid[last], grid[last + 1]
        if high - low < 1e-14:
            break
    return float(low)


def test_stiffness_is_continuous_where_a_contact_opens() -> None:
    """One-sided differences from both sides reach K as √h, the change of a Hertz stiffness: each
    tilts some balls into the third contact and others out of it."""
    speed, unit = 12000.0 * RPM, lever(QJ218)
    at = third_contact(QJ218, speed) * np.eye(5)[0]
    s = four_point(QJ218).equilibrium(displacement=at, speed=speed, dynamics="frozen")
    k = s.stiffness("complete") / unit / unit[:, None]
    steps = np.array([1e-8, 1e-10])
    for way in (1.0, -1.0):
        moves = way * steps[:, None, None] * np.eye(5) / unit
        f = loads_at(QJ218, at + moves, speed, "frozen")
        slope = (f - s.load / unit).swapaxes(1, 2) / (way * steps[:, None, None])
        error = np.abs(slope - k).max((1, 2)) / np.abs(k).max()
        assert error[1] < 0.15 * error[0]
        assert error[1] < 1e-2
