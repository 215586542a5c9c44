"""States under several hypotheses of the balls, solved together, against each solved alone."""

from __future__ import annotations

import numpy as np
import pytest

from bearings.ball.law import Law
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.ahead import solve_ahead
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.scene.stage import Memo
from rotordyn.scene.statics import Statics
from tests.oracles.spindles import RPM, mfw2310

LAWS = (Law("outer", "equal"), Law("inner", "equal"), Law("hybrid", "equal"))
SPEED = np.array([0.0, 12000.0, 24000.0]) * RPM


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kinematics)
def test_each_is_as_alone(law: Law) -> None:
    spindle, memo = mfw2310(), Memo()
    alone = dynamic_preload(spindle, SPEED, law)
    every = [Conditions(kinematics=each.kinematics) for each in LAWS]
    solve_ahead([Statics(spindle, each, SPEED, memo) for each in every], memo)
    scene = Scene(spindle, Conditions(kinematics=law.kinematics), SPEED, memo=memo)
    together = scene.preload
    assert [state.law for state in together.place.among.states] == [*LAWS]
    assert together.law == law
    assert together.outcome == alone.outcome
    assert together.seat_load() == pytest.approx(alone.seat_load(), rel=1e-9)
    assert together.net.position == pytest.approx(alone.net.position, abs=1e-13)
    assert scene.stop_speeds == pytest.approx(alone.stop_speeds(), rel=1e-9, nan_ok=True)
