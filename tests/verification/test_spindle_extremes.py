"""Any spindle at any speed: a balanced state or a sentence, never NaN, never a stray error."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bearings.ball.law import Law
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.errors import NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.conditions import Conditions
from tests.oracles.known_bearings import HYPOTHESES
from tests.oracles.random_spindles import spindles
from tests.oracles.spindles import RPM, pairs

SPEEDS = st.lists(st.floats(0.0, 30000.0), min_size=1, max_size=4, unique=True)


def unbalanced(spindle: Spindle, state: PreloadState, row: int, force: float) -> float:
    """Largest force left over on shaft and sleeves, over the largest force, from the loads alone.

    Springs act by what the shift says; a stop only pushes, and only at its place.
    """
    bearings = state.network.arrangement.bearings
    axial = np.empty(len(spindle.seats))
    for bearing, load in zip(bearings, state.net.response.load[row], strict=True):
        axial[list(bearing.seats)] = load
    thrust = np.array([seat.thrust for seat in spindle.seats])
    faults = [force - float(thrust @ axial)]
    for k, sleeve in enumerate(spindle.sleeves):
        members = [i for i, seat in enumerate(spindle.seats) if seat.name in sleeve.bearings]
        toward = -thrust[members[0]]
        travel = -toward * state.shift[row, k + 1]
        assert travel <= sleeve.stop_travel + 1e-12
        if np.isinf(sleeve.spring.stiffness):
            assert travel == 0.0
            continue
        left = axial[members].sum() - sleeve.spring.preload - sleeve.spring.stiffness * travel
        at_stop = abs(travel - sleeve.stop_travel) < 1e-12
        faults.append(min(left, 0.0) if at_stop else left)
    return float(np.abs(faults).max() / max(axial.max(), 1.0))


@settings(max_examples=60)
@given(spindles(), SPEEDS, st.floats(-500.0, 500.0), st.sampled_from(HYPOTHESES))
def test_balanced_or_named(
    spindle: Spindle, rpm: list[float], force: float, kinematics: str
) -> None:
    speed = np.array(rpm) * RPM
    state = dynamic_preload(spindle, speed, Law(kinematics, "equal"), force)
    for row, word in enumerate(state.outcome):
        if word:
            assert f"{rpm[row]:.0f} rpm" in word
            assert "preload" in word or "has no equilibrium" in word
            continue
        assert np.isfinite(state.net.position[row]).all()
        assert np.isfinite(state.seat_stiffness()[row]).all()
        load = state.net.response.load[row]
        assert (load > 0.0).all() or (force and (load >= 0.0).all() and (load > 0.0).any())
        assert unbalanced(spindle, state, row, force) <= 1e-8


@settings(max_examples=25)
@given(spindles(), SPEEDS, st.sampled_from(["outer", "hybrid"]))
def test_deflections_are_those_of_the_loads(
    spindle: Spindle, rpm: list[float], kinematics: str
) -> None:
    """Each bearing, asked alone for the deflection under its load, answers the same."""
    state = dynamic_preload(spindle, np.array(rpm) * RPM, Law(kinematics, "equal"))
    deflection = state.network.deflection(state.net.position)
    for row in np.flatnonzero(state.usable):
        for k, bearing in enumerate(state.network.arrangement.bearings):
            alone = bearing.model.equilibrium(
                load=[state.net.response.load[row, k], 0, 0, 0, 0],
                speed=rpm[row] * RPM,
                static_growth=bearing.static_growth[row],
                growth=bearing.growth[row],
                kinematics=kinematics,
            )
            assert abs(alone.displacement[0] - deflection[row, k]) < 1e-11


@pytest.mark.long
@settings(max_examples=12)
@given(spindles(), st.floats(1000.0, 30000.0), st.floats(10.0, 1000.0))
def test_every_question_has_an_answer_or_a_reason(
    spindle: Spindle, rpm: float, force: float
) -> None:
    asked = {
        "preload": PreloadSpec(),
        "campbell": CampbellSpec(3000.0),
        "frf": FrfSpec((10.0, 500.0, 3000.0), pairs("tip.y/tip.y", "tip.z/tip.y", "tip.x/tip.x")),
        "stiffness": StiffnessSpec("tip", force, 2),
    }
    speeds = (0.0, rpm * RPM)
    answered = _answered(spindle, speeds, asked)
    if isinstance(answered, NoSolution):
        assert any(unit in str(answered) for unit in (" rpm", " N;"))
        return
    found = answered
    good = np.array([word == "" for word in found["frf"].outcome])
    assert np.isfinite(found["frf"].receptance[good]).all()
    assert np.isfinite(found["stiffness"].deflection[good]).all()
    assert np.isfinite(found["preload"].stiffness[good]).all()
    assert np.isnan(found["frf"].receptance[~good]).all()
    frequency = found["campbell"].frequency[good]
    assert ((frequency > 0.0) | np.isnan(frequency)).all()
    assert np.isfinite(frequency[0]).all()


def _answered(spindle: Spindle, speeds: tuple[float, ...], asked: Any) -> Any:
    try:
        return solve_spindle(spindle, Conditions(), speeds, asked, lambda name: None).results
    except NoSolution as error:
        return error
