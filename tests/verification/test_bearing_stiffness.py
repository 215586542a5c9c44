"""The complete tangent against differences of the bearing's own load, and its symmetry."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from bearings import AngularContactBallBearing, NoEquilibrium
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, RPM, SHARINGS, VEX70

TOLERANCE = 1e-6
bounded = settings(max_examples=60, deadline=None, derandomize=True, database=None)


def scale(bearing: AngularContactBallBearing) -> np.ndarray:
    """Tilts count by the travel they give at dm/2, moments by the force."""
    return np.array([1.0, 1.0, 1.0, 2 / bearing.pitch_diameter, 2 / bearing.pitch_diameter])


def fault(bearing: AngularContactBallBearing, found: np.ndarray, expected: np.ndarray) -> float:
    """max |ΔK| / max |K|, moments and tilts scaled by dm/2."""
    weight = np.outer(scale(bearing), scale(bearing))
    return float(np.abs((found - expected) * weight).max() / np.abs(expected * weight).max())


def differences(
    bearing: AngularContactBallBearing, displacement: np.ndarray, speed: float, **how: object
) -> np.ndarray:
    """∂f/∂d by five-point differences of ``equilibrium(displacement=…)``, one batched call."""
    step = 1e-8 * np.diag(scale(bearing))
    points = displacement + np.array([1.0, -1.0, 2.0, -2.0])[:, None, None] * step
    load = bearing.equilibrium(displacement=points, speed=speed, **how).load
    slope = (8.0 * (load[0] - load[1]) - (load[2] - load[3])) / (12.0 * np.diag(step)[:, None])
    return slope.T


@bounded
@given(
    thrust=st.floats(300.0, 6000.0),
    radial=st.floats(0.0, 0.5),
    azimuth=st.floats(0.0, 6.28),
    moments=st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0)),
    rpm=st.floats(0.0, 30000.0),
    kinematics=st.sampled_from(HYPOTHESES),
    sharing=st.sampled_from(SHARINGS),
    growth=st.floats(0.0, 15e-6),
)
@example(250.0, 0.0, 0.0, (0.0, 0.0), 30000.0, "hybrid", "equal", 0.0)
@example(2000.0, 0.0, 0.0, (0.0, 0.0), 30000.0, "inner", "hybrid", 0.0)
@example(1200.0, 0.4, 1.0, (0.0, 4.0), 24000.0, "geometric", "outer", 1e-5)
@example(1200.0, 0.9, 1.0, (2.0, 0.0), 24000.0, "outer", "inner", 1e-5)
def test_complete_stiffness_equals_differences(
    thrust: float,
    radial: float,
    azimuth: float,
    moments: tuple[float, float],
    rpm: float,
    kinematics: str,
    sharing: str,
    growth: float,
) -> None:
    side = radial * thrust
    load = [thrust, side * np.cos(azimuth), side * np.sin(azimuth), *moments]
    how = dict(kinematics=kinematics, moment_sharing=sharing, static_growth=growth / 2)
    how["growth"] = growth
    try:
        s = VEX70.equilibrium(load=load, speed=rpm * RPM, **how)
    except NoEquilibrium:
        assume(False)
    contact = s.inner_load[s.status == "loaded"]
    assume(contact.min(initial=np.inf) > 1.0)  # beside a kink differences prove nothing
    jumps = kinematics in ("inner", "geometric")  # their loaded branch ends before Qi = 0
    assume(not (jumps and (s.status == "lost contact").any()))
    back = VEX70.equilibrium(displacement=s.displacement, speed=rpm * RPM, **how)
    # with these two a light ball may be loaded or lost at the same displacement: compare like
    assume(not (jumps and (back.status != s.status).any()))
    k = s.stiffness("complete")
    assert fault(VEX70, differences(VEX70, s.displacement, rpm * RPM, **how), k) < TOLERANCE


@pytest.mark.parametrize("kinematics", HYPOTHESES)
@pytest.mark.parametrize("rpm", [0.0, 9000.0])
def test_complete_stiffness_of_a_steel_bearing(kinematics: str, rpm: float) -> None:
    load = [17800.0, 3000.0, -2000.0, 60.0, 25.0]
    s = HARRIS_218.equilibrium(load=load, speed=rpm * RPM, kinematics=kinematics)
    expected = differences(HARRIS_218, s.displacement, rpm * RPM, kinematics=kinematics)
    assert fault(HARRIS_218, expected, s.stiffness("complete")) < TOLERANCE


@pytest.mark.few(2)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_complete_stiffness_of_the_oracle(kinematics: str) -> None:
    load, speed = [1500.0, 200.0, 100.0, 1.0, -2.0], 20000.0 * RPM
    oracle = BallBearingOracle(VEX70, kinematics=kinematics)
    state = oracle.from_load(load, speed, steps=15)
    ours = VEX70.equilibrium(load=load, speed=speed, kinematics=kinematics).stiffness("complete")
    assert fault(VEX70, ours, oracle.stiffness(state, speed)) < 1e-5


@pytest.mark.parametrize(
    "load",
    [[500.0, 0, 0, 0, 0], [1000.0, 300.0, -150.0, 2.0, 5.0], [800.0, 900.0, 100.0, 0.0, 0.0]],
)
@pytest.mark.parametrize("bearing", [VEX70, HARRIS_218], ids=["VEX70", "218"])
def test_symmetric_at_rest(bearing: AngularContactBallBearing, load: list[float]) -> None:
    k = bearing.equilibrium(load=load).stiffness("complete")
    assert fault(bearing, k.T, k) < 1e-10
    assert np.linalg.eigvalsh(0.5 * (k + k.T)).min() > 0.0


@pytest.mark.parametrize(
    ("thrust", "rpm", "least", "most"),
    [(2000.0, 15000.0, 5e-4, 2e-2), (551.0, 24000.0, 2e-2, 0.2), (250.0, 30000.0, 0.1, 0.4)],
)
def test_not_symmetric_at_speed(thrust: float, rpm: float, least: float, most: float) -> None:
    """K[y, θz] against K[z, θy], and against K[θz, y]: the moment of Fc and Mg does work."""
    k = VEX70.equilibrium(load=[thrust, 0, 0, 0, 0], speed=rpm * RPM).stiffness("complete")
    assert least < abs(k[1, 4] / k[4, 1] - 1.0) < most
    assert k[1, 4] == pytest.approx(-k[2, 3], rel=1e-9)
    assert k[4, 1] == pytest.approx(-k[3, 2], rel=1e-9)
    assert k[1, 4] < 0.0 < k[2, 3]
