"""The preload state of the MFW 2310 against its equations solved the other way round."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from bearings.ball.law import Law
from rotordyn.preload.together import dynamic_preload
from tests.oracles.axial_arrangement import Arrangement2310, Found
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.spindles import RPM, mfw2310, with_sleeve

SEATS = mfw2310().seats
BEARINGS = {1: SEATS[0].bearing, 2: SEATS[2].bearing, 3: SEATS[3].bearing}
OPEN = with_sleeve(mfw2310(), "front", stop_travel=math.inf)


def by_load(kinematics: str, position: int, load: float, speed: float, growth: float) -> float:
    """Deflection of our bearing under a load."""
    state = BEARINGS[position].equilibrium(
        load=[load, 0, 0, 0, 0],
        speed=speed,
        static_growth=43.2e-6,
        growth=growth,
        kinematics=kinematics,
    )
    return float(state.displacement[0])


@cache
def by_oracle(position: int, load: float, speed: float, growth: float) -> float:
    """Deflection of the independent bearing, followed from rest."""
    oracle = BallBearingOracle(
        BEARINGS[position], kinematics="outer", static_growth=43.2e-6, growth=growth
    )
    return float(oracle.from_load([load, 0, 0, 0, 0], speed, steps=12, free="x").displacement[0])


def compared(expected: Found, rpm: float, kinematics: str, force: float, *, closed: bool) -> None:
    spindle = mfw2310() if closed else OPEN
    found = dynamic_preload(spindle, np.array([rpm * RPM]), Law(kinematics, "equal"), force)
    assert found.usable.all()
    assert found.net.response.load[0] == pytest.approx(expected.load, rel=1e-7)
    assert found.shift[0] == pytest.approx(expected.shift, rel=1e-7, abs=1e-13)
    assert -found.stop_force[0, 0] == pytest.approx(expected.stop, rel=1e-6, abs=1e-5)
    assert bool(found.net.held[0, 1]) == closed


@pytest.mark.parametrize("kinematics", ["outer", "hybrid"])
@pytest.mark.parametrize(
    ("rpm", "force", "closed"),
    [
        (0, 0.0, False),
        (0, 300.0, False),
        (9000, 0.0, False),
        (18000, -200.0, False),
        (24000, 0.0, False),
        (24000, 0.0, True),
        (23000, 250.0, True),
    ],
)
def test_equations_of_the_thesis(kinematics: str, rpm: float, force: float, closed: bool) -> None:
    def deflection(*asked: float) -> float:
        return by_load(kinematics, *asked)  # type: ignore[arg-type]

    expected = Arrangement2310(deflection).solve(rpm * RPM, force, closed=closed)
    compared(expected, rpm, kinematics, force, closed=closed)


@pytest.mark.few(1)
@pytest.mark.parametrize(("rpm", "closed"), [(0, False), (15000, False), (24000, True)])
def test_with_an_independent_bearing_too(rpm: float, closed: bool) -> None:
    """Nothing of the product on the other side: network, ball balance and contacts."""
    expected = Arrangement2310(by_oracle).solve(rpm * RPM, closed=closed)
    compared(expected, rpm, "outer", 0.0, closed=closed)
