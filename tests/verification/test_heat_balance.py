"""Bearings of a spindle at the temperatures that their heat leads to."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings.heat.temperature import HOTTEST, Conductances, Surroundings
from rotordyn.analyses import LifeSpec, Lubrication, PreloadSpec
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.machine.growth import QuadraticInSpeed, RingGrowth
from rotordyn.machine.history import HistoryStep
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.heat_balance import Flow, heat_balance
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.heat_flow import SpindleHeatFlow
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.case_files import answered
from tests.oracles.spindles import RPM, case

OIL = Lubrication(32e-6, 5.4e-6, 50.0)
FLOW = SpindleHeatFlow(3.0, 6.0, 30.0, 25.0, 30.0, balls_oil=1.0, lubricant=OIL)
NEXT_TO_NONE = 1e-12  # factor of losses in the oil
SPEED = np.array([0.0, 6e3, 12e3]) * RPM


def grinding(*, rigid: bool = False) -> Spindle:
    found = case("grinding_spindle").spindle
    assert found is not None
    if not rigid:
        return found
    sleeves = tuple(
        replace(each, spring=replace(each.spring, stiffness=np.inf)) for each in found.sleeves
    )
    return replace(found, sleeves=sleeves)


@cache
def scene(*, rigid: bool = False) -> Scene:
    return Scene(grinding(rigid=rigid), Conditions(heat_flow=FLOW), SPEED)


def lives(of: Scene) -> Any:
    from rotordyn.analyses.life.solve import solve

    return solve(of, LifeSpec(OIL))


@pytest.mark.parametrize("rule", [None, QuadraticInSpeed(4e-6, 12e3 * RPM)])
def test_a_state_does_not_hang_on_the_other_speeds_listed(rule: QuadraticInSpeed | None) -> None:
    """Where growth is given and only its thermal part follows from the temperatures."""
    machine = grinding(rigid=True)
    growth = RingGrowth(static=1e-6, centrifugal=rule)
    seats = tuple(replace(seat, growth=growth) for seat in machine.seats)
    given = replace(machine, seats=seats)
    loads = [
        Scene(given, Conditions(heat_flow=FLOW), SPEED[first:]).preload.seat_load()[-1]
        for first in (0, 1, 2)
    ]
    assert loads[1] == pytest.approx(loads[0], rel=1e-4)
    assert loads[2] == pytest.approx(loads[0], rel=1e-4)
    still = replace(given, seats=tuple(replace(seat, growth=RingGrowth()) for seat in seats))
    assert (loads[0] > 1.2 * Scene(still, Conditions(), SPEED).preload.seat_load()[-1]).all()


FOUR_POINT = """
title: four-point bearing against a spring on a deep-groove one
spindle:
  shaft: {{start: 0 mm, material: steel_rotor, sections: [
    {{length: 450 mm, outer_diameter: 60 mm, inner_diameter: 30 mm}}]}}
  bearings:
    - {{name: qj, model: qj218, x: {front} mm}}
    - {{name: rear, model: "6012", x: {rear} mm, thrust: {thrust}x}}
  sleeves: [{{name: s, bearings: [rear], spring: {{preload: 1500 N, stiffness: 2 N/um}}}}]
speeds: [1000 rpm, 3000 rpm]
conditions:
  kinematics: outer
  heat_flow:
    {{inner_shaft: 5 W/K, outer_housing: 10 W/K, balls_oil: 2 W/K,
      shaft: 30 degC, housing: 30 degC, oil: 40 degC, lubricant: {oil}}}
analyses: {{life: {{lubricant: {oil}}}}}
"""


def test_a_mirrored_spindle_of_a_four_point_bearing_is_as_warm(tmp_path: Path) -> None:
    """x to −x: its thrust then goes through the other arcs."""
    oil = "{viscosity_40: 32 mm^2/s, viscosity_100: 5.4 mm^2/s, temperature: 50 degC}"
    plain, turned = (
        answered(FOUR_POINT.format(**places, oil=oil), tmp_path)["life"]
        for places in (
            {"front": 80, "rear": 420, "thrust": "+"},
            {"front": 370, "rear": 30, "thrust": "-"},
        )
    )
    for name in ("inner_heat", "moment", "inner_temperature", "ball_temperature", "film"):
        assert turned[name].values == pytest.approx(plain[name].values, rel=1e-5), name
    assert (plain.inner_heat[:, 0] > 3.0).all()


@pytest.mark.parametrize("rigid", [False, True])
def test_heat_of_each_bearing_leaves_through_its_conductances(rigid: bool) -> None:
    found = lives(scene(rigid=rigid))
    out = 3.0 * (found.inner_temperature - 30.0) + 6.0 * (found.outer_temperature - 25.0)
    out = out + 1.0 * (found.ball_temperature - 30.0)
    assert (found.heat[1:] > 30.0).all()
    assert out == pytest.approx(found.heat, rel=2e-3, abs=0.05)


def test_state_is_that_of_these_temperatures_given() -> None:
    """Preload at temperatures read from the balance as a case would give them."""
    balanced = scene(rigid=True)
    given = Conditions(temperatures=balanced.heat_balance.temperatures)
    same = Scene(grinding(rigid=True), given, SPEED)
    assert same.preload.seat_load() == pytest.approx(balanced.preload.seat_load(), rel=1e-12)
    cold = Scene(grinding(rigid=True), Conditions(), SPEED).preload.seat_load()
    assert (balanced.preload.seat_load()[2] > 1.2 * cold[2]).all()


def test_a_spring_holds_the_preload() -> None:
    warm, cold = scene(), Scene(grinding(), Conditions(), SPEED)
    change = warm.preload.seat_load().sum(axis=1) / cold.preload.seat_load().sum(axis=1)
    assert change == pytest.approx(1.0, abs=0.15)
    assert (lives(warm).ball_temperature[2] < lives(scene(rigid=True)).ball_temperature[2]).all()


def test_heat_that_falls_as_steeply_as_it_may_still_settles(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Heat q − s T of either contact that leaves by a ring of conductance g, T = q/(g + s) above
    what is around: turns without damping would run apart where s > g, by half where s > 3 g."""
    steep = np.array([0.0, 0.9, 3.5, 5.0])[:, None]  # of g = 1 W/K
    most = np.array([10.0, 20.0, 40.0, 54.0])[:, None]

    def contacts(at: Any, _: Flow) -> tuple[np.ndarray, np.ndarray]:
        rings = np.array(
            [[each.inner_ring, each.outer_ring] for each in at.bearings.values()]
        )  # (bearings, 2, speeds)
        rise = rings.transpose(2, 0, 1) - 30.0
        return most[..., None] - steep[..., None] * rise, np.ones(4, dtype=bool)

    monkeypatch.setattr("rotordyn.preload.heat_balance.contact_heat", contacts)
    flow = Flow(OIL.oil, Conductances(1.0, 1.0), Surroundings(30.0, 30.0, 30.0), 0.0, NEXT_TO_NONE)
    found = heat_balance(lambda t: t, np.arange(4.0) * 100.0, grinding(), flow)  # type: ignore[arg-type,return-value]
    assert found.outcome == ("",) * 4
    for each in found.temperatures.bearings.values():
        for ring in (each.inner_ring, each.outer_ring):
            assert ring == pytest.approx(30.0 + (most / (1.0 + steep))[:, 0], abs=2e-3)


def test_close_to_the_limit_there_is_a_balance() -> None:
    """159.7 and 162.3 °C by Newton's method over all temperatures at once; at 14 150 rpm none."""
    flow = replace(FLOW, inner_shaft=1.5, outer_housing=3.0, balls_oil=0.5)
    hot = Conditions(kinematics="hybrid", moment_sharing="equal", heat_flow=flow)
    limit = Scene(grinding(rigid=True), hot, np.array([14050.0, 14075.0, 14150.0]) * RPM)
    assert limit.outcome[:2] == ("", "")
    assert "temperatures run away" in limit.outcome[2]
    hottest = lives(limit).ball_temperature[:2].max(axis=1)
    assert hottest == pytest.approx([159.66, 162.29], abs=0.05)


def test_a_speed_without_a_state_is_named_with_how_hot_it_was(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At 1500 rpm none from the first turn on, at 30 °C around; heat of none leaves that there."""

    def contacts(_: Any, __: Flow) -> tuple[np.ndarray, np.ndarray]:
        return np.zeros((2, 4, 2)), np.array([True, False])

    monkeypatch.setattr("rotordyn.preload.heat_balance.contact_heat", contacts)
    flow = Flow(OIL.oil, Conductances(1.0, 1.0), Surroundings(30.0, 30.0, 30.0), 0.0, NEXT_TO_NONE)
    speed = np.array([700.0, 1500.0]) * RPM
    why = "bearing a is unloaded at 1500 rpm (preload lost): raise the preload"
    state: Any = SimpleNamespace(outcome=("", why))
    found = heat_balance(lambda _: state, speed, grinding(), flow)
    assert found.outcome[0] == ""
    assert found.outcome[1] == f"bearings at 1500 rpm: at temperatures up to 30 °C {why}"


def test_run_away_names_bearing_and_speed() -> None:
    fast = Scene(grinding(rigid=True), Conditions(heat_flow=FLOW), np.array([6e3, 26e3]) * RPM)
    assert fast.outcome[0] == ""
    assert fast.outcome[1].startswith("bearings at 26000 rpm: temperatures run away at bearings a")
    assert "cool more" in fast.outcome[1]
    found = lives(fast)
    assert np.isfinite(found.ball_temperature[0]).all()
    assert np.isnan(found.ball_temperature[1]).all()


@pytest.mark.parametrize("key", ["shaft", "housing", "oil"])
def test_what_cools_is_no_hotter_than_bearings_may_be(key: str) -> None:
    """Beyond that they count as running away."""
    everything = dict.fromkeys(("shaft", "housing", "oil"), HOTTEST)
    hot = Scene(grinding(), Conditions(heat_flow=replace(FLOW, **everything)), SPEED)
    assert all("temperatures run away at bearings" in word for word in hot.outcome[1:])
    with pytest.raises(InvalidInput, match=f"{key}: .*allowed: from -60 degC up to 250 degC"):
        replace(FLOW, **{key: HOTTEST + 0.1})


def test_thicker_oil_and_less_cooling_are_hotter() -> None:
    def balls(**changed: Any) -> float:
        flow = replace(FLOW, **changed)
        found = Scene(grinding(), Conditions(heat_flow=flow), SPEED[1:2])
        return float(lives(found).ball_temperature[0, 0])

    usual = balls()
    assert balls(lubricant=replace(OIL, viscosity_40=100e-6, viscosity_100=11e-6)) > usual + 5.0
    assert balls(outer_housing=1.0, inner_shaft=1.0) > usual + 5.0


@pytest.mark.parametrize(
    ("conditions", "sentence"),
    [
        ("{temperatures: {shaft: 40 degC}, ", "given beside temperatures"),
        ("{bearings: static, ", "needs bearings at speed"),
    ],
)
def test_contradictions_get_a_sentence(conditions: str, sentence: str, tmp_path: Any) -> None:
    flow = (
        "heat_flow: {inner_shaft: 3 W/K, outer_housing: 6 W/K, shaft: 30 degC, housing: 25 degC, "
        "oil: 30 degC, lubricant: {viscosity_40: 32 mm^2/s, viscosity_100: 5 mm^2/s, "
        "temperature: 50 degC}}}"
    )
    file = tmp_path / "case.yaml"
    file.write_text(
        f"spindle: grinding_spindle\nspeeds: [100 rpm]\nconditions: {conditions}{flow}\n"
        "analyses: {preload: {}}\n"
    )
    with pytest.raises(InvalidInput, match=sentence):
        rotordyn.load(file)


def test_temperatures_are_shown() -> None:
    """A figure with three parts, and a line of the summary."""
    from rotordyn.analyses.life.figures import figures
    from rotordyn.analyses.life.summary import summary

    found = lives(scene())
    drawn = dict(figures(None, found, {}))["temperature"]()  # type: ignore[arg-type]
    names = [axes.get_ylabel() for axes in drawn.axes]
    assert names[0] == "temperature, balls [°C]"
    assert all(axes.lines for axes in drawn.axes)
    line = next(line for line in summary(found) if line.startswith("warm"))
    assert f"balls {found.ball_temperature[2].min():.1f}" in line


def rubbing() -> Spindle:
    found = grinding()
    sleeves = tuple(replace(each, friction=60.0) for each in found.sleeves)
    return replace(found, sleeves=sleeves)


@pytest.mark.few(1)
@pytest.mark.parametrize("history", [(), (HistoryStep(warm=True), HistoryStep(speed=9e3 * RPM))])
def test_the_way_to_a_speed_has_the_temperatures_of_its_speeds(
    history: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where friction remembers it, rest and speeds before are balanced whether a case names them or
    not."""
    monkeypatch.setattr("rotordyn.preload.passed_speeds.SPACING", 20.0)  # quicker
    found = []
    for speeds in ([6e3, 12e3], [0.0, 6e3, 9e3, 12e3]):
        steps = (*history, HistoryStep(run_up=True)) if history else ()
        conditions = Conditions(heat_flow=FLOW, history=steps)
        one = Scene(rubbing(), conditions, np.array(speeds) * RPM)
        assert not any(one.outcome)
        row = speeds.index(6e3)
        state = one.preload
        found.append((state.seat_load()[row], state.friction_force[row]))
    assert found[0][0] == pytest.approx(found[1][0], rel=1e-6)
    assert found[0][1] == pytest.approx(found[1][1], rel=1e-6)


def test_the_way_to_a_speed_is_warmed_by_the_heat_on_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Between rest and that speed, whether a case names another one there or not."""
    monkeypatch.setattr("rotordyn.preload.passed_speeds.SPACING", 10.0)  # quicker
    found = []
    flow, machine = replace(FLOW, shaft=35.0), grinding()
    sleeves = tuple(replace(each, friction=200.0) for each in machine.sleeves)
    for speeds in ([4e3], [2e3, 4e3]):
        state = Scene(
            replace(machine, sleeves=sleeves), Conditions(heat_flow=flow), np.array(speeds) * RPM
        ).preload
        assert np.abs(state.friction_force[-1]) < 190.0
        found.append([*state.friction_force[-1], *state.seat_load()[-1]])
    assert found[0] == pytest.approx(found[1], abs=0.5)


def test_a_way_beyond_the_table_of_temperatures_is_refused() -> None:
    machine, table = rubbing(), Temperatures(shaft=(30.0, 50.0), speeds=(4e3 * RPM, 12e3 * RPM))
    given = {"preload": PreloadSpec()}
    with pytest.raises(InvalidInput, match="reach 0 rpm, which the history of its friction passes"):
        Case("case", "", (5e3 * RPM,), given, Conditions(temperatures=table), machine)


@pytest.mark.parametrize("force", [200.0, 5000.0])
def test_heat_by_loads_across_the_axis_that_temperatures_do_not_follow_is_named(
    force: float,
) -> None:
    """Heat of `life` against what leaves through the conductances at the temperatures beside it."""
    loads = (PointLoad("nose", Fy=force),)
    here = Scene(grinding(rigid=True), Conditions(heat_flow=FLOW, loads=loads), SPEED[1:])
    result = lives(here)
    leaving = (
        3.0 * (result.inner_temperature - 30.0)
        + 6.0 * (result.outer_temperature - 25.0)
        + 1.0 * (result.ball_temperature - 30.0)
    )
    share = np.abs(result.heat / leaving - 1.0)
    said = [words for words in here.warnings if "loads across the axis change its heat" in words]
    assert len(said) == (share.max() > 0.1) == (force > 1000.0)
    for words in said:
        row, k = np.unravel_index(share.argmax(), share.shape)
        first, last = leaving[row, k], result.heat[row, k]
        assert words.startswith(f"bearing {result.bearing[k]}: ")
        assert f"from {first:.0f} to {last:.0f} W at {SPEED[1 + row] / RPM:.0f} rpm" in words


def test_heat_without_loads_across_the_axis_is_what_leaves() -> None:
    assert not [words for words in scene(rigid=True).warnings if "change its heat" in words]
    given = Conditions(temperatures=Temperatures(shaft=30.0), loads=(PointLoad("nose", Fy=5e3),))
    here = Scene(grinding(rigid=True), given, SPEED[1:])
    assert here.preload.usable.any()
    assert not [words for words in here.warnings if "change its heat" in words]


def test_temperatures_that_do_not_settle_say_what_helps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rotordyn.preload.heat_balance.MOST", 1)
    here = Scene(grinding(), Conditions(heat_flow=FLOW), SPEED[2:])
    (outcome,) = here.heat_balance.outcome
    assert outcome.startswith(
        "bearings at 12000 rpm: temperatures do not converge: cool more, lower"
    )


def test_a_speed_without_a_balance_makes_no_warning() -> None:
    """At 20 000 rpm temperatures run away; no ring is called loose there."""
    flow = replace(FLOW, shaft=40.0, housing=35.0)
    loads = (PointLoad(at="nose", Fy=1500.0),)
    given = Conditions(kinematics="hybrid", heat_flow=flow, loads=loads)
    here = Scene(grinding(rigid=True), given, np.array([6e3, 20e3]) * RPM)
    assert [bool(outcome) for outcome in here.outcome] == [False, True]
    assert here.preload.usable.all()
    assert not [words for words in here.warnings if "20000" in words]
