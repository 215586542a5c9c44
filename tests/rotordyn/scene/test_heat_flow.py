"""Which conductances are used is said, and which of them are guesses."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import pytest

import rotordyn
from bearings.errors import InvalidBearing
from bearings.heat.temperature import Conductances, Surroundings, network
from rotordyn.errors import InvalidInput
from rotordyn.scene.heat_flow import HeatFlow

FLOW = HeatFlow(3.0, 6.0, shaft=30.0, housing=25.0, oil=30.0, balls_oil=1.5)


def test_guesses_are_those_that_are_not_given() -> None:
    (both,) = FLOW.guesses()
    assert "balls_inner and balls_outer, not given, are taken as 1 W/K, a guess" in both
    (one,) = replace(FLOW, balls_inner=1.0).guesses()
    assert "balls_outer, not given, is taken as 1 W/K" in one
    assert not [*replace(FLOW, balls_inner=1.0, balls_outer=1.0).guesses()]
    assert FLOW.conductances == Conductances(3.0, 6.0, 1.5, 1.0, 1.0)
    assert "1.5 from balls to oil, 1 and 2 from balls" in replace(FLOW, balls_outer=2.0).note


def test_a_single_bearing_of_a_material_without_an_expansion_says_so() -> None:
    case = replace(rotordyn.load("vex70_warm"), speeds=(100.0,), variants={})
    assert not [words for words in rotordyn.run(case).warnings if "thermal_expansion" in words]
    assert case.bearing is not None
    balls = replace(case.bearing.ball_material, name="unknown", thermal_expansion=None)
    other = replace(case, bearing=replace(case.bearing, ball_material=balls))
    (said,) = (words for words in rotordyn.run(other).warnings if "thermal_expansion" in words)
    assert said.startswith("balls of unknown: this material has no thermal_expansion")


@pytest.mark.parametrize("name", ["vex70_warm", "grinding_spindle_warm"])
def test_a_run_says_them(name: str) -> None:
    case = replace(rotordyn.load(name), speeds=(100.0,), variants={})
    given = rotordyn.run(case)
    assert not [words for words in given.warnings if "guess" in words]
    assert "6 from outer ring to housing" in " ".join(given.summary.split())
    spec = case.analyses.get("bearing")
    if spec is None:
        flow = replace(case.conditions.heat_flow, balls_inner=None)
        case = replace(case, conditions=replace(case.conditions, heat_flow=flow))
    else:
        flow = replace(spec.heat_flow, balls_inner=None)
        case = replace(case, analyses={"bearing": replace(spec, heat_flow=flow)})
    (said,) = (words for words in rotordyn.run(case).warnings if "guess" in words)
    assert said.startswith("heat_flow: balls_inner, not given, is taken as 1 W/K")


@pytest.mark.parametrize("given", [*product((0.0, 2.0), repeat=5)])
def test_what_lets_no_heat_leave_is_refused_before_it_is_solved(given: tuple[float, ...]) -> None:
    """Of all combinations of conductances those without a balance, and no others."""
    conductances = Conductances(*given)
    try:
        network(conductances, Surroundings(30.0, 25.0, 30.0))
    except InvalidBearing:
        with pytest.raises(InvalidInput, match="leave"):
            HeatFlow(shaft=30.0, housing=25.0, oil=30.0, **conductances._asdict())
    else:
        HeatFlow(shaft=30.0, housing=25.0, oil=30.0, **conductances._asdict())
