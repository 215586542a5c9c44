"""Random states of single bearings for hypothesis."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from bearings import AngularContactBallBearing, NoEquilibrium
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, RPM, SHARINGS, VEX70
from tests.oracles.rigid_balls import RigidBalls

SCALE = st.floats(-1.0, 1.0)
AXIAL = np.array([1.0, 0.0, 0.0, 0.0, 0.0])
HIGHEST = {VEX70: 32000.0, HARRIS_218: 12000.0}  # rpm


@st.composite
def solved(draw: Any) -> RigidBalls:
    """A random state: pressed, tilted, shifted, some balls lost, at rest or at speed."""
    bearing: AngularContactBallBearing = draw(st.sampled_from([VEX70, HARRIS_218]))
    how = dict(
        kinematics=draw(st.sampled_from(HYPOTHESES)),
        moment_sharing=draw(st.sampled_from(SHARINGS)),
        static_growth=draw(st.floats(0.0, 4e-6)),
    )
    how["growth"] = how["static_growth"] + draw(st.floats(0.0, 6e-6))
    thrown = np.array([draw(SCALE) for _ in range(5)]) * [80e-6, 60e-6, 60e-6, 1e-3, 1e-3]
    speed = HIGHEST[bearing] * draw(st.one_of(st.just(0.0), st.floats(0.05, 1.0))) * RPM
    try:
        state = bearing.equilibrium(displacement=thrown + 20e-6 * AXIAL, speed=speed, **how)
    except NoEquilibrium:
        assume(False)
    return RigidBalls(BallBearingOracle(bearing, **how), state)
