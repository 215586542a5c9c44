"""The Harris 218 angular-contact bearing at 17 800 N thrust, tilts fixed.

Reference: two independent codes that agree to print (exact Hertz, rings frozen at 40°). Harris'
own chart values (41.6°, 38.6 µm) rest on an approximate contact constant and are not met.
"""

from __future__ import annotations

import numpy as np
import pytest

from bearings.ring.state import BearingState
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.known_bearings import DEGREE, HARRIS_218, RPM

THRUST = [17800.0, 0.0, 0.0, 0.0, 0.0]


def solve(rpm: float, kinematics: str, moment_sharing: str) -> BearingState:
    return HARRIS_218.equilibrium(
        load=THRUST, speed=rpm * RPM, kinematics=kinematics, moment_sharing=moment_sharing
    )


@pytest.mark.parametrize(
    ("rpm", "travel", "inner", "outer", "inner_load", "outer_load", "axial", "radial"),
    [
        (0.0, 36.097, 41.5019, 41.5019, 1678.88, 1678.88, 765.08, 485.12),
        (10000.0, 14.916, 49.9613, 31.3299, 1453.09, 1921.67, 288.05, 171.66),
    ],
)
def test_outer_control(
    rpm: float,
    travel: float,
    inner: float,
    outer: float,
    inner_load: float,
    outer_load: float,
    axial: float,
    radial: float,
) -> None:
    s = solve(rpm, "outer", "outer")
    k = s.stiffness("complete") / 1e6
    assert s.displacement[0] * 1e6 == pytest.approx(travel, abs=6e-4)
    assert s.inner_angle / DEGREE == pytest.approx(inner, abs=6e-5)
    assert s.outer_angle / DEGREE == pytest.approx(outer, abs=6e-5)
    assert s.inner_load == pytest.approx(inner_load, abs=6e-3)
    assert s.outer_load == pytest.approx(outer_load, abs=6e-3)
    assert k[0, 0] == pytest.approx(axial, abs=6e-3)
    assert k[1, 1] == pytest.approx(radial, abs=6e-3)
    assert k[2, 2] == pytest.approx(radial, abs=6e-3)


def test_inner_control() -> None:
    s = solve(10000.0, "inner", "equal")
    assert s.inner_angle / DEGREE == pytest.approx(47.45, abs=6e-3)
    assert s.outer_angle / DEGREE == pytest.approx(34.66, abs=6e-3)
    assert s.stiffness()[0, 0] / 1e6 == pytest.approx(432.9, abs=0.06)


def test_without_gyroscopic_moment_between_the_two() -> None:
    oracle = BallBearingOracle(
        HARRIS_218, kinematics="outer", moment_sharing="outer", moment_sign=0
    )
    none = oracle.from_load(THRUST, 10000 * RPM, free="x")
    angles = np.array([none.inner_angle[0], none.outer_angle[0]]) / DEGREE
    assert angles == pytest.approx([47.78, 34.42], abs=6e-3)
    assert oracle.stiffness(none, 10000 * RPM)[0, 0] / 1e6 == pytest.approx(411.9, abs=0.06)
