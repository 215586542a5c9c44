"""Bearings of a spindle over time from its start, with the preload meanwhile."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import rotordyn
from bearings.heat.temperature import Conductances, Surroundings, network
from rotordyn.analyses import PreloadSpec, WarmUpSpec
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.warm_up.figures import figures
from rotordyn.analyses.warm_up.figures.over_time import warming_figure
from rotordyn.analyses.warm_up.result import WarmUpResult
from rotordyn.analyses.warm_up.solve import ball_capacity, over_time
from rotordyn.analyses.warm_up.solve import solve as solve_warm_up
from rotordyn.analyses.warm_up.summary import accuracy, in_words, numbers, summary, warnings
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine import BearingTemperatures, RingGrowth, Temperatures
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.fit_pressure import fit_pressure
from rotordyn.preload.heat_balance import Flow, contact_heat, tables, with_oil
from rotordyn.preload.ring_stress import ring_stress
from rotordyn.preload.warming import Begin, _Oiled, warming
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.heat_flow import SpindleHeatFlow
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import RPM, case
from tests.verification.test_heat_balance import FLOW, NEXT_TO_NONE, OIL, grinding

Array = NDArray[np.float64]
WEAK = replace(FLOW, inner_shaft=0.3, outer_housing=0.6, balls_oil=0.2)
LENGTH = 40.0  # s
INNER, OUTER, START = 500.0, 3000.0, 20.0
LATE = {"shaft_time_constant": 180.0, "housing_time_constant": 900.0}  # s
COOLED = Flow(
    OIL.oil, Conductances(3.0, 6.0, 1.0, 1.5, 0.8), Surroundings(30.0, 25.0, 32.0), 0.05, 1.0
)


def held(*, rigid: bool) -> Spindle:
    """The grinding spindle with fits that hold at all speeds."""
    machine = grinding(rigid=rigid)
    seats = tuple(
        replace(seat, growth=replace(seat.growth, fit=replace(fit, interference=12e-6)))
        for seat in machine.seats
        if (fit := seat.growth.fit) is not None
    )
    return replace(machine, seats=seats)


def scene(*rpm: float, rigid: bool = True, flow: SpindleHeatFlow = FLOW) -> Scene:
    return Scene(held(rigid=rigid), Conditions(heat_flow=flow), np.array(rpm) * RPM)


def spec(minutes: float, **more: float) -> WarmUpSpec:
    given = {"inner": INNER, "outer": OUTER, "start": START} | more
    return WarmUpSpec(duration=60.0 * minutes, **given)  # type: ignore[arg-type]


@cache
def warmed() -> tuple[Scene, WarmUpResult]:
    here = scene(12e3)
    return here, solve_warm_up(here, spec(90.0))


@cache
def running_away() -> WarmUpResult:
    return solve_warm_up(scene(3e3, 15e3, flow=WEAK), spec(30.0))


@cache
def begun() -> WarmUpResult:
    return solve_warm_up(scene(9e3), spec(3.0))


@pytest.mark.parametrize("constants", [(None, None), (15.0, None), (30.0, 12.0)])
def test_given_heat_leads_where_the_exact_solution_does(
    constants: tuple[float | None, float | None],
) -> None:
    """Without heat of the oil the nodes are linear: a matrix exponential, heat that grows along a
    straight line and a shaft and a housing that warm in their own time included; errors fall with
    the square of the step."""
    flow = COOLED._replace(oil_factor=NEXT_TO_NONE)
    capacity = np.array([[40.0, 500.0, 3000.0], [25.0, 300.0, 900.0]])
    names = ("shaft_time_constant", "housing_time_constant")
    given_times = {n: t for n, t in zip(names, constants, strict=True) if t}
    outside_of = over_time(spec(1.0, **given_times), flow)
    pitches, speeds = np.array([0.09, 0.06]), np.array([900.0, 300.0])
    oiled = _Oiled(pitches, speeds, flow, capacity, outside_of)
    start = np.array(
        [[[20.0, 20.0, 20.0], [35.0, 25.0, 20.0]], [[60.0, 50.0, 40.0], [20.0, 30.0, 40.0]]]
    )
    contacts = np.array([[[80.0, 60.0], [10.0, 15.0]], [[30.0, 20.0], [5.0, 2.0]]])
    slope = np.array([[[0.2, -0.1], [0.0, 0.05]], [[0.1, 0.1], [-0.02, 0.0]]])
    matrix, outside = network(flow.conductances, flow.surroundings)
    exact = np.empty_like(start)
    for s, b in np.ndindex(2, 2):
        known = np.zeros((7, 7))  # (T, 1, t, what shaft and housing are off their end)
        known[:3, :3] = -matrix / capacity[b][:, None]
        for column, (inner, outer) in ((3, contacts[s, b]), (4, slope[s, b])):
            given = np.array([0.5 * (inner + outer), 0.5 * inner, 0.5 * outer])
            known[:3, column] = (given + (outside if column == 3 else 0.0)) / capacity[b]
        known[4, 3] = 1.0
        by, ends = flow.conductances, flow.surroundings
        both = ((by.inner_shaft, ends.shaft), (by.outer_housing, ends.housing))
        for k, ((conductance, end), constant) in enumerate(zip(both, constants, strict=True)):
            if constant:
                known[1 + k, 5 + k] = conductance * (START - end) / capacity[b, 1 + k]
                known[5 + k, 5 + k] = -1.0 / constant
        exact[s, b] = (expm(LENGTH * known) @ [*start[s, b], 1.0, 0.0, 1.0, 1.0])[:3]
    errors = []
    for parts in (4, 8, 16, 32):
        found, each = start, LENGTH / parts
        for k in range(parts):
            between = k * each, (k + 1) * each
            found = oiled.onward(found, contacts + k * each * slope, slope, between)
        errors.append(np.abs(found - exact).max())
    assert errors[0] < 0.02
    assert np.array(errors[:-1]) / errors[1:] == pytest.approx(4.0, rel=0.12)


def test_oil_that_thins_is_followed_however_little_the_balls_hold() -> None:
    """Balls of hardly any capacity are at once where oil, rings and balls are in balance."""
    capacity = np.array([[0.1, 500.0, 3000.0]])
    still = over_time(spec(1.0), COOLED)
    oiled = _Oiled(np.array([0.09]), np.array([1200.0]), COOLED, capacity, still)
    start, none = np.array([[[20.0, 20.0, 20.0]]]), np.zeros((1, 1, 2))
    here = oiled.onward(start, none, none, (0.0, 5.0))
    matrix, outside = network(COOLED.conductances, COOLED.surroundings)

    def gap(at: Array) -> Array:
        power = with_oil(none, at, oiled.pitches, oiled.speed, COOLED)
        return np.asarray(power[0, 0, 2] + outside[0] - matrix[0] @ at[0, 0])

    scale = matrix[0, 0] * (here[0, 0, 0] - START)
    assert here[0, 0, 0] > 40.0
    assert abs(gap(here)) < 0.02 * scale


def test_it_ends_where_heat_and_cooling_are_in_balance() -> None:
    here, result = warmed()
    given = here.heat_balance.temperatures.bearings
    for k, name in enumerate(result.bearing):
        known = given[name]
        pairs = (
            (result.ball_temperature, known.balls),
            (result.inner_temperature, known.inner_ring),
            (result.outer_temperature, known.outer_ring),
        )
        for found, there in pairs:
            assert found[:, -1, k] == pytest.approx(np.array(there), abs=0.02)
    assert result.axial_load[:, -1] == pytest.approx(result.steady_load, rel=1e-3)
    assert not any(result.outcome)
    assert not any(result.ending)


def test_what_is_produced_is_stored_or_flows_off() -> None:
    here, result = warmed()
    flow = FLOW.conductances
    ends = FLOW.surroundings
    off = (
        flow.inner_shaft * (result.inner_temperature - ends.shaft)
        + flow.outer_housing * (result.outer_temperature - ends.housing)
        + flow.balls_oil * (result.ball_temperature - ends.oil)
    )
    made, gone = (np.trapezoid(each, result.time, axis=1) for each in (result.heat, off))
    balls = [ball_capacity(seat.bearing) for seat in here.spindle.seats]
    stored = sum(
        capacity * (each[:, -1] - each[:, 0])
        for capacity, each in (
            (np.array(balls), result.ball_temperature),
            (INNER, result.inner_temperature),
            (OUTER, result.outer_temperature),
        )
    )
    assert made - gone == pytest.approx(stored, abs=3e-3 * made.max())


def test_twice_the_capacity_takes_twice_as_long() -> None:
    here, capacity = scene(9e3), np.array([[30.0, INNER, OUTER]] * 4)
    short, long = (
        warming(
            here.preload_at(here.speed),
            here.speed,
            here.spindle,
            FLOW.flow,
            Begin(np.full((4, 3), START), times * capacity),
            over_time(
                spec(1.0, shaft_time_constant=times * 90.0, housing_time_constant=times * 500.0),
                FLOW.flow,
            ),
            times * 300.0,
            8,
            lambda _: None,
        )
        for times in (1.0, 2.0)
    )
    assert long.time == pytest.approx(2.0 * short.time)
    assert long.load == pytest.approx(short.load, rel=1e-9)
    assert long.temperature == pytest.approx(short.temperature, rel=1e-9)


@pytest.mark.long
def test_a_general_integrator_finds_the_same() -> None:
    """The whole system by SciPy's, with the preload state at every one of its steps; errors of the
    coarse steps fall with their square."""
    speed, minutes = 12e3, 4.0
    here = scene(speed)
    at, flow = np.array([speed * RPM]), FLOW.flow
    seats = here.spindle.seats
    names = tuple(seat.name for seat in seats)
    pitches = np.array([seat.bearing.pitch_diameter for seat in seats])
    capacity = np.array([[ball_capacity(seat.bearing), INNER, OUTER] for seat in seats])
    solve, outside_of = here.preload_at(at), over_time(spec(minutes, **LATE), flow)

    def rate(time: float, flat: Array) -> Array:
        now = flow._replace(surroundings=outside_of(time))
        matrix, outside = network(flow.conductances, now.surroundings)
        temperature = flat.reshape(1, -1, 3)
        contacts, known = contact_heat(solve(tables(temperature, at, names, now)), flow)
        assert known.all()
        inner, outer, oil = with_oil(contacts, temperature, pitches, at, flow)[0].T
        power = np.stack([0.5 * (inner + outer) + oil, 0.5 * inner, 0.5 * outer], axis=1)
        return np.asarray(((power + outside - temperature[0] @ matrix) / capacity).ravel())

    start = np.full((len(seats), 3), START)
    exact = solve_ivp(rate, (0.0, 60.0 * minutes), start.ravel(), rtol=1e-5, atol=1e-4).y[:, -1]
    errors = []
    for steps in (20, 40):
        found = warming(
            solve,
            at,
            here.spindle,
            flow,
            Begin(start, capacity),
            outside_of,
            60.0 * minutes,
            steps,
            lambda _: None,
        )
        errors.append(np.abs(found.temperature[0, -1].ravel() - exact).max())
    assert errors[1] < 0.05
    assert errors[0] > 2.5 * errors[1]
    told = solve_warm_up(here, spec(minutes, **LATE))
    worst = np.abs(told.inner_temperature[0, -1] - exact.reshape(-1, 3)[:, 1]).max()
    assert worst < told.error + 1e-3


def test_rigid_preload_passes_through_a_peak_that_a_spring_has_not() -> None:
    _, result = warmed()
    assert (result.largest_load > 1.5 * result.steady_load).all()
    assert (result.largest_time < 300.0).all()
    (told,) = (line for line in warnings(result) if "carries" in line)
    k = int(result.largest_load[0].argmax())
    assert f"bearing {result.bearing[k]} carries {result.largest_load[0, k]:.0f} N" in told
    sprung = solve_warm_up(scene(12e3, rigid=False), spec(90.0))
    assert (sprung.largest_load < 1.15 * sprung.steady_load).all()
    assert not [*warnings(sprung)]


def test_temperatures_that_run_away_end_with_their_time() -> None:
    result = running_away()
    assert result.ending[0] == ""
    assert "temperatures run away" in result.ending[1]
    assert result.outcome == ("", "")
    last = int(np.searchsorted(result.time, result.ended[1]))
    assert 0 < last < len(result.time) - 1
    assert np.isfinite(result.axial_load[1, : last + 1]).all()
    assert np.isnan(result.axial_load[1, last + 1 :]).all()
    assert result.inner_temperature[1, last].max() <= 250.0
    assert any("at 15000 rpm temperatures run away" in line for line in warnings(result))


@cache
def without_balance() -> WarmUpResult:
    return solve_warm_up(scene(20e3, flow=WEAK), spec(30.0))


def test_a_speed_without_balance_says_so_however_short_the_time() -> None:
    """What runs away later, and is not compared with a warm spindle that does not exist."""
    runs_away = without_balance().ended[0]
    short = solve_warm_up(scene(3e3, 20e3, flow=WEAK), spec(runs_away / 60.0 / 2.0))
    assert short.ending == ("", "")
    assert np.isfinite(short.steady_load[0]).all()
    assert np.isnan(short.steady_inner_temperature[1]).all()
    (balance,) = (line for line in warnings(short) if "no thermal balance" in line)
    assert "bearings at 20000 rpm: temperatures run away" in balance
    assert f"the first {in_words(short.ended[1])} do not show it" in balance
    fallen = replace(short, axial_load=0.5 * short.axial_load)
    told = [line for line in warnings(fallen) if "times that of the warm spindle" in line]
    assert not [line for line in told if "20000 rpm" in line]
    assert without_balance().unbalanced[0]
    (told_once,) = (w for w in warnings(without_balance()) if "loosens" not in w)
    assert "at 20000 rpm temperatures run away" in told_once


def test_speeds_without_balance_need_none_beside_them_that_has_one() -> None:
    """Where `warm_up` alone is asked; other analyses need a steady state."""
    asked = {"warm_up": spec(30.0)}
    machine, given, at = held(rigid=True), Conditions(heat_flow=WEAK), (20e3 * RPM,)
    found = solve_spindle(machine, given, at, asked, lambda _: None)
    alone = found.results["warm_up"]
    assert isinstance(alone, WarmUpResult)
    assert "temperatures run away" in alone.ending[0]
    assert alone.ended == without_balance().ended
    both = asked | {"preload": PreloadSpec()}
    with pytest.raises(NoSolution, match="temperatures run away"):
        solve_spindle(machine, given, at, both, lambda _: None)


def test_a_spindle_without_preload_at_the_start_says_so() -> None:
    """A hot shaft between cold rings loosens them."""
    machine = held(rigid=True)
    seats = tuple(replace(seat, growth=RingGrowth(), fits=None) for seat in machine.seats)
    (sleeve,) = machine.sleeves
    light = replace(sleeve, spring=replace(sleeve.spring, preload=10.0))
    loose = replace(machine, seats=seats, sleeves=(light,))
    flow = replace(FLOW, shaft=90.0, housing=20.0)
    here = Scene(loose, Conditions(heat_flow=flow), np.array([1e3]) * RPM)
    result = solve_warm_up(here, spec(1.0))
    assert result.outcome == result.ending
    assert result.outcome[0].startswith("no axial state at the start, at temperatures up to 20 °C")
    assert np.isnan(result.axial_load).all()
    assert np.isnan(result.largest_time).all()
    assert not [*warnings(result), *summary(result), *figures(None, result, {})]  # type: ignore[arg-type]


def test_a_speed_without_a_start_leaves_the_figure_of_the_others() -> None:
    partly = replace(running_away(), outcome=("", "no axial state at the start"))
    assert [name for name, _ in figures(None, partly, {})] == ["warm_up"]  # type: ignore[arg-type]


def test_no_accuracy_is_claimed_where_temperatures_run_away() -> None:
    gone = solve_warm_up(scene(15e3, flow=WEAK), spec(30.0))
    assert gone.ending[0]
    assert math.isnan(gone.error)
    assert not accuracy(gone)
    some = running_away()
    assert 0.0 < some.error < 1.0
    assert "at speeds computed to the end of the run" in accuracy(some)[0]


@pytest.mark.long
def test_steps_are_halved_until_the_time_of_running_away_stays() -> None:
    """Runs of 160 and 320 steps end at 778 and 766 s, one of 40 at 879 s."""
    machine = rotordyn.load("spindle_deep_groove_rear").spindle
    assert machine is not None
    scene = Scene(machine, Conditions(heat_flow=WEAK), np.array([9e3]) * RPM)
    result = solve_warm_up(scene, spec(60.0))
    assert "run away at bearing rear" in result.ending[0]
    assert result.ended == pytest.approx(770.0, rel=0.05)


def test_steps_too_long_for_what_they_follow_are_reported() -> None:
    told = [*warnings(replace(warmed()[1], error=14.0))]
    assert any("still change temperatures by 14 K" in line for line in told)
    assert not any("still change" in line for line in warnings(warmed()[1]))


def test_a_bearing_pressed_from_either_side_has_its_largest_load() -> None:
    """The rear bearing takes thrust both ways: which way it counts as its own changes but signs."""
    machine = rotordyn.load("spindle_deep_groove_rear").spindle
    assert machine is not None
    turned = tuple(
        replace(seat, thrust=-seat.thrust) if seat.name == "rear" else seat
        for seat in machine.seats
    )
    one, other = (
        solve_warm_up(Scene(each, Conditions(heat_flow=FLOW), np.array([6e3]) * RPM), spec(60.0))
        for each in (machine, replace(machine, seats=turned))
    )
    assert other.axial_load[..., 2] == pytest.approx(-one.axial_load[..., 2], rel=1e-6)
    assert other.largest_load == pytest.approx(one.largest_load, rel=1e-6)
    assert other.largest_time == pytest.approx(one.largest_time)
    assert other.largest_load[0, 2] > 1.05 * abs(other.steady_load[0, 2])
    when = f"({other.largest_time[0, 2] / 60.0:.3g} min)"
    peak = f"-{other.largest_load[0, 2]:.0f} {when} → -{abs(other.axial_load[0, -1, 2]):.0f}"
    assert peak in summary(other)[0].replace("\N{NO-BREAK SPACE}", " ")
    picture = warming_figure(other)
    assert picture.axes[0].get_ylim()[0] < other.axial_load.min()
    dots = [line.get_xydata()[0] for line in picture.axes[0].lines if len(line.get_xydata()) == 1]
    signed = -other.largest_load[0, 2]  # in the frame of the turned bearing
    assert any(dot == pytest.approx([other.largest_time[0, 2] / 60.0, signed]) for dot in dots)


@cache
def late() -> tuple[Scene, WarmUpResult]:
    """The spindle whose shaft and housing warm in their own time."""
    here = scene(9e3)
    return here, solve_warm_up(here, spec(20.0, **LATE))


def test_loads_on_the_way_are_those_of_all_temperatures_there() -> None:
    """Shaft and housing among them, which move the bearings along the axis."""
    here, result = late()
    names = [seat.name for seat in here.spindle.seats]
    for k in (0, len(result.time) // 2, -1):
        shaft = 30.0 - 10.0 * math.exp(-result.time[k] / 180.0)
        housing = 25.0 - 5.0 * math.exp(-result.time[k] / 900.0)
        assert result.shaft_temperature[k] == pytest.approx(shaft)
        assert result.housing_temperature[k] == pytest.approx(housing)
        bearing = {
            name: BearingTemperatures(
                inner_ring=result.inner_temperature[0, k, j],
                outer_ring=result.outer_temperature[0, k, j],
                balls=result.ball_temperature[0, k, j],
            )
            for j, name in enumerate(names)
        }
        given = Temperatures(shaft=shaft, housing=housing, bearings=bearing)
        alone = Scene(here.spindle, Conditions(temperatures=given), here.speed)
        assert result.axial_load[0, k] == pytest.approx(alone.unloaded.seat_load()[0], rel=1e-8)


def loads_over_time(
    shaft: float | None = None, housing: float | None = None, flow: Flow = FLOW.flow
) -> Array:
    """Axial loads (t, bearings) over three minutes in a few steps."""
    here, capacity = scene(9e3), np.array([[30.0, INNER, OUTER]] * 4)
    late = replace(spec(1.0), shaft_time_constant=shaft, housing_time_constant=housing)
    machine = here.preload_at(here.speed), here.speed, here.spindle, flow
    begin = Begin(np.full((4, 3), START), capacity)
    return warming(*machine, begin, over_time(late, flow), 180.0, 8, lambda _: None).load[0]


def test_time_constants_of_nothing_and_of_eternity() -> None:
    """Shaft and housing have their temperatures from the start, or keep those of the start."""
    at_once, warm = loads_over_time(1e-3, 1e-3), loads_over_time()
    assert at_once[1:] == pytest.approx(warm[1:], rel=1e-2)
    assert at_once[-1] == pytest.approx(warm[-1], rel=2e-5)
    assert abs(at_once[0] / warm[0] - 1.0).min() > 0.01
    cool = FLOW.flow._replace(surroundings=Surroundings(START, START, FLOW.flow.surroundings.oil))
    assert loads_over_time(1e12, 1e12) == pytest.approx(loads_over_time(flow=cool), rel=1e-9)


def test_the_slower_the_shaft_and_the_faster_the_housing_the_higher_the_peak() -> None:
    """Of this spindle, whose preload a longer shaft relieves and a longer housing raises."""
    here = scene(9e3)
    loads = {}
    for shaft, housing in ((20.0, 20.0), (30.0, 20.0), (20.0, 30.0)):
        given = Conditions(temperatures=Temperatures(shaft=shaft, housing=housing))
        loads[shaft, housing] = Scene(here.spindle, given, here.speed).unloaded.seat_load()[0, 0]
    assert loads[30.0, 20.0] < loads[20.0, 20.0] < loads[20.0, 30.0]
    shafts = [loads_over_time(shaft, 900.0).max() for shaft in (None, 60.0, 600.0)]
    assert shafts == sorted(shafts)
    housings = [loads_over_time(180.0, housing).max() for housing in (None, 60.0, 600.0)]
    assert housings == sorted(housings, reverse=True)


def test_shaft_and_housing_are_drawn_within_their_axes() -> None:
    """Also where they are hotter than the rings."""
    _, result = late()
    hot = replace(result, shaft_temperature=result.shaft_temperature + 100.0)
    picture = warming_figure(hot)
    for row, name, values in (
        (2, "shaft", hot.shaft_temperature),
        (3, "housing", hot.housing_temperature),
    ):
        axes = picture.axes[row]
        assert [text.get_text() for text in axes.texts] == [name]
        low, high = axes.get_ylim()
        assert low < values.min()
        assert values.max() < high


def test_times_are_reported_in_units_that_suit_them() -> None:
    assert [in_words(t) for t in (3.21, 97.0, 7100.0, 9e4)] == [
        "3.21 s",
        "1.62 min",
        "118 min",
        "25 h",
    ]


def test_a_duration_too_short_says_so() -> None:
    result = begun()
    assert any("still warming up at the end" in line for line in warnings(result))


def test_temperatures_on_their_way_are_reported_where_loads_are_those_in_the_end() -> None:
    """Behind a soft spring. The rise left is that of a run of an hour and a half."""
    machine = held(rigid=False)
    (sleeve,) = machine.sleeves
    soft = replace(sleeve, spring=replace(sleeve.spring, stiffness=0.5e6))
    machine = replace(machine, sleeves=(soft,))
    here = Scene(machine, Conditions(heat_flow=FLOW), np.array([8e3]) * RPM)
    result, to_the_end = solve_warm_up(here, spec(4.0)), solve_warm_up(here, spec(90.0))
    assert result.axial_load[0, -1] == pytest.approx(result.steady_load[0], rel=0.02)
    reached, end = result.outer_temperature[0, -1], to_the_end.outer_temperature[0, -1]
    assert result.steady_outer_temperature[0] == pytest.approx(end, abs=0.05)
    assert result.steady_inner_temperature[0] == pytest.approx(
        to_the_end.inner_temperature[0, -1], abs=0.05
    )
    share = float(((end - reached) / (end - START)).max())
    assert share > 0.5
    (told,) = warnings(result)
    assert "still warming up at the end: outer ring" in told
    assert f"{reached.max():.0f} °C at 8000 rpm, {end.max():.0f} °C in balance" in told
    assert f"{100.0 * share:.0f} % of the change remaining" in told
    assert not [*warnings(to_the_end)]


def test_a_temperature_is_late_by_more_than_a_kelvin_and_on_its_way() -> None:
    """The share of the way is omitted where it ends farther from balance than it began."""
    result = begun()
    settled = replace(
        result,
        steady_load=result.axial_load[:, -1],
        steady_ball_temperature=result.ball_temperature[:, -1],
        steady_inner_temperature=result.inner_temperature[:, -1],
        steady_outer_temperature=result.outer_temperature[:, -1],
    )
    assert not [*warnings(settled)]
    outer, end = result.outer_temperature, result.outer_temperature[:, -1]
    still = np.broadcast_to(end[:, None], outer.shape)
    near = replace(settled, outer_temperature=still, steady_outer_temperature=end + 0.9)
    assert not [*warnings(near)]
    passed = replace(settled, steady_outer_temperature=outer[:, 0] + 0.1 * (end - outer[:, 0]))
    (told,) = warnings(passed)
    assert "outer ring" in told
    assert "of the change" not in told


def test_loads_across_the_axis_take_no_part() -> None:
    """The spindle warms up without them, and so it is in balance in the end."""
    alone, pushed = scene(9e3), Conditions(heat_flow=FLOW, loads=(PointLoad("nose", Fy=800.0),))
    loaded = Scene(alone.spindle, pushed, alone.speed)
    both = [solve_warm_up(each, spec(0.5)) for each in (alone, loaded)]
    assert (both[0].axial_load == both[1].axial_load).all()
    assert both[0].steady_load == pytest.approx(both[1].steady_load, rel=1e-9)


def test_a_bearing_that_carries_nothing_is_not_late() -> None:
    result = begun()
    idle = replace(result, axial_load=0.0 * result.axial_load, steady_load=0.0 * result.steady_load)
    assert not [line for line in warnings(idle) if " N " in line]


def test_balls_hold_what_their_mass_does() -> None:
    bearing = grinding().seats[0].bearing
    mass = bearing.balls * bearing.ball_material.density * math.pi * bearing.ball_diameter**3 / 6.0
    assert bearing.ball_material.density < 4000.0
    assert ball_capacity(bearing) == pytest.approx(700.0 * mass)
    steel = replace(bearing, ball_material=bearing.ring_material)
    assert ball_capacity(steel) == pytest.approx(
        460.0 * mass * bearing.ring_material.density / bearing.ball_material.density
    )


def test_it_begins_where_everything_is_cold() -> None:
    here = scene(3e3)
    result = solve_warm_up(here, replace(spec(1.0), start=None))
    assert result.inner_temperature[0, 0] == pytest.approx(29.0, abs=1.5)
    assert result.outer_temperature[0, 0] == pytest.approx(25.6, abs=1.0)
    told = "\n".join(summary(result))
    assert "at 3000 rpm, axial load [N] at the start, largest, after 1 min" in told
    assert [number.part for number in numbers(result, None)] == list("abcd")  # type: ignore[arg-type]
    assert [name for name, _ in figures(None, result, {})] == ["warm_up"]  # type: ignore[arg-type]


FAULTY = {
    "": ("analyses.warm_up", "give heat_flow in the conditions"),
    "conditions: {heat_flow: HEAT}\noverride: {sleeves.rear.friction: 100 N}\n": (
        "analyses.warm_up",
        "leave their friction out",
    ),
    "conditions: {heat_flow: HEAT}\n#inner: 0 J/K\n": ("analyses.warm_up.inner", "out of range"),
    "conditions: {heat_flow: HEAT}\n#inner: 500 J/K, shaft_time_constant: 3 min\n": (
        "analyses.warm_up.shaft_time_constant",
        "give start, too",
    ),
    "conditions: {heat_flow: HEAT}\n#inner: 500 J/K, start: 9 degC, housing_time_constant: 0 s\n": (
        "analyses.warm_up.housing_time_constant",
        "out of range",
    ),
    "conditions: {heat_flow: HEAT}\n#inner: 3 W/K\n": ("analyses.warm_up.inner", "J/K"),
}
HEAT = (
    "{inner_shaft: 3 W/K, outer_housing: 6 W/K, shaft: 30 degC, housing: 25 degC, oil: 30 degC, "
    "lubricant: {viscosity_40: 32 mm^2/s, viscosity_100: 5.4 mm^2/s, temperature: 50 degC}}"
)


@pytest.mark.parametrize("more", FAULTY)
def test_what_it_cannot_do_is_refused(tmp_path: Path, more: str) -> None:
    path, words = FAULTY[more]
    more, _, inner = more.partition("#inner: ")
    text = (
        "spindle: grinding_spindle\nspeeds: [3000 rpm]\n"
        + more.replace("HEAT", HEAT)
        + f"analyses:\n  warm_up: {{duration: 5 min, inner: {inner.strip() or '500 J/K'}, "
        "outer: 3 kJ/K}\n"
    )
    (tmp_path / "case.yaml").write_text(text)
    with pytest.raises(InvalidInput, match=words) as caught:
        rotordyn.load(tmp_path / "case.yaml")
    assert [fault.path for fault in caught.value.faults] == [path]


@pytest.mark.parametrize("name", ["grinding_spindle_warm_up", "mfw2310_warm_up"])
def test_shipped_cases_ask_for_it(name: str) -> None:
    asked = case(name).analyses["warm_up"]
    assert isinstance(asked, WarmUpSpec)
    assert asked.start == START


# --- fits ----------------------------------------------------------------------------------------

ON_SHAFT, RADIUS, PRESSED = 7e-6, 0.035, 11.5e-6  # m, m, 1/K


@cache
def loosening() -> tuple[Scene, WarmUpResult]:
    """Inner rings that run ahead of a slow shaft."""
    machine = held(rigid=False)
    seats = tuple(
        replace(seat, growth=replace(seat.growth, fit=replace(fit, interference=ON_SHAFT)))
        for seat in machine.seats
        if (fit := seat.growth.fit) is not None
    )
    here = Scene(replace(machine, seats=seats), Conditions(heat_flow=FLOW), np.array([9e3]) * RPM)
    return here, solve_warm_up(here, spec(90.0, inner=150.0, shaft_time_constant=2400.0))


def test_fits_lose_what_the_ring_grows_beyond_the_shaft() -> None:
    """Pressure is linear in the interference: of two uniformly warm bodies it is short of what one
    grows beyond the other at their common radius, α r (Ti − Ts); speed takes its part as cold."""
    here, result = loosening()
    rest, cold = (fit_pressure(here.spindle, speed)[0] for speed in (np.zeros(1), here.speed))
    ahead = result.inner_temperature - result.shaft_temperature[None, :, None]
    free = cold[:, None] - rest * PRESSED * RADIUS * ahead / ON_SHAFT
    assert result.inner_fit_pressure == pytest.approx(np.maximum(free, 0.0), rel=1e-6, abs=1.0)
    assert (result.inner_fit_pressure == 0.0).any()
    assert (warmed()[1].inner_fit_pressure > 0.0).all()
    assert np.isnan(result.outer_fit_pressure).all(), "no fit in the housing is given"


def test_a_fit_that_loosens_on_the_way_is_named_with_its_times() -> None:
    here, result = loosening()
    assert not [words for words in here.warnings if "loosens" in words], "in balance it holds"
    (sentence,) = [words for words in warnings(result) if "loosens" in words]
    loose = result.time[(result.inner_fit_pressure[0] == 0.0).any(axis=1)]
    assert f"{in_words(loose[0])} to {in_words(loose[-1])} after the start at 9000 rpm" in sentence
    assert loose[0] > 0.0
    assert loose[-1] < result.time[-1]
    assert not [words for words in warnings(warmed()[1]) if "loosens" in words]
    always = np.minimum(result.inner_fit_pressure, 1.0) * 0.0
    (sentence,) = [
        w for w in warnings(replace(result, inner_fit_pressure=always)) if "loosens" in w
    ]
    assert (
        "from 0 s after the start on at 9000 rpm (as do those of b, c, d, for no longer)"
        in sentence
    )


def test_stress_of_inner_rings_on_the_way_is_that_at_these_temperatures() -> None:
    here, result = loosening()
    k = 7
    at = {"shaft": float(result.shaft_temperature[k]), "speeds": tuple(here.speed)}
    rings = {
        name: BearingTemperatures(inner_ring=tuple(result.inner_temperature[:, k, column]))
        for column, name in enumerate(result.bearing)
    }
    stress = ring_stress(here.spindle, here.speed, Temperatures(bearings=rings, **at))
    assert result.ring_stress[:, k] == pytest.approx(stress, rel=1e-12)
    assert not [words for words in warnings(result) if "yields" in words]
    (sentence,) = [
        words
        for words in warnings(replace(result, ring_stress=1e3 * result.ring_stress))
        if "yields" in words
    ]
    assert in_words(result.time[int(result.ring_stress.max(axis=(0, 2)).argmax())]) in sentence
