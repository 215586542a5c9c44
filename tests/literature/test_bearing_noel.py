"""The VEX 70 hybrid bearing of Noël's thesis (2013).

Expected values are independent recomputations of the published ones; the published value stands
beside each. Tolerance: the print accuracy of the recomputation, at most 0.5 %. λ = (1, 1), no
growth and blocked tilts unless said. What hangs on the sign of the gyroscopic moment is in
test_gyroscopic_sign.py.
"""

from __future__ import annotations

import numpy as np
import pytest

from bearings.ring.state import BearingState
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.known_bearings import RPM, VEX70, VEX70_IDENTIFIED

FAST = 30000.0 * RPM


def thrust(
    force: float, speed: float, *, kinematics: str = "hybrid", sharing: str = "equal"
) -> BearingState:
    return VEX70.equilibrium(
        load=[force, 0, 0, 0, 0], speed=speed, kinematics=kinematics, moment_sharing=sharing
    )


def diagonal(state: BearingState) -> tuple[float, float]:
    k = state.stiffness("complete") / 1e6
    return float(k[0, 0]), float(k[1, 1])


def test_mass_and_inertia_of_the_ball() -> None:
    """1.44 g and 1.31e-8 kg m² are met by D and ρ."""
    oracle = BallBearingOracle(VEX70)
    assert oracle.mass == pytest.approx(1.44e-3, abs=6e-6)
    assert oracle.inertia == pytest.approx(1.31e-8, abs=6e-11)


def test_at_rest_under_1000_newton() -> None:
    """Published 140 and 301 N/µm."""
    assert diagonal(thrust(1000.0, 0.0)) == pytest.approx((139.2, 299.1), abs=0.06)


def test_at_rest_under_1220_newton() -> None:
    """Published 149.4 to 150.2 N/µm (from the losses of Fig. 2.22)."""
    assert diagonal(thrust(1220.0, 0.0))[0] == pytest.approx(149.7, abs=0.06)


@pytest.mark.parametrize(
    ("sharing", "inner_load", "centrifugal"), [("equal", 15.1, 151.7), ("hybrid", 18.0, 152.2)]
)
def test_lightly_loaded_ball(sharing: str, inner_load: float, centrifugal: float) -> None:
    """250 N at 30 000 rpm; published 17.6 and 153 N."""
    s = thrust(250.0, FAST, sharing=sharing)
    assert s.inner_load == pytest.approx(inner_load, abs=0.06)
    assert s.centrifugal_force == pytest.approx(centrifugal, abs=0.06)


@pytest.mark.parametrize(
    ("kinematics", "grip"),
    [("outer", 0.07), ("hybrid", 0.10), ("geometric", 0.15), ("inner", 0.26)],
)
def test_grip_needed_at_the_inner_race(kinematics: str, grip: float) -> None:
    """μ ≥ λ Mg/(D Q) at 1220 N and 30 000 rpm."""
    s = thrust(1220.0, FAST, kinematics=kinematics)
    needed = s.gyroscopic_moment / (VEX70.ball_diameter * s.inner_load)
    assert needed == pytest.approx(grip, abs=0.006)
    assert s.inner_required_friction == pytest.approx(needed, rel=1e-12)


def test_matrices_4_7_and_4_8() -> None:
    """Kxx, Kyy, Kyθz at 551 N and Kyy at 1000 N, with the identified parameters, at rest.

    Published 27.0, 86.0, −1.44: Kyy and Kyθz are π times that, Kxx misses by 12 %. Published Kyy
    of (4.8) 338 N/µm.
    """
    s = VEX70_IDENTIFIED.equilibrium(
        load=[[551.0, 0, 0, 0, 0], [1000.0, 0, 0, 0, 0]], static_growth=43.2e-6
    )
    k = s.stiffness("complete") / 1e6
    assert (k[0, 0, 0], k[0, 1, 1]) == pytest.approx((74.8, 269.8), abs=0.06)
    assert k[0, 1, 4] == pytest.approx(-4.53, abs=0.006)
    assert k[1, 1, 1] == pytest.approx(326.9, abs=0.06)
    assert k[0, 1, 1] / np.pi == pytest.approx(86.0, rel=5e-3)
    assert k[0, 1, 4] / np.pi == pytest.approx(-1.44, rel=5e-3)
