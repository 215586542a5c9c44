"""Dry friction in the state that all analyses take: against networks that another code solved,
Coulomb's law checked with forces and positions, locked sleeves, and the independence of steps."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bearings import AngularContactBallBearing
from bearings.ball.law import Law
from rotordyn.allowance import within
from rotordyn.analyses import AxialCycleSpec, LifeSpec, LoadStep, PreloadSpec, StiffnessSpec
from rotordyn.analyses.axial_cycle.solve import solve as axial_cycle
from rotordyn.analyses.life.solve import solve as life_answer
from rotordyn.analyses.preload.solve import solve as preload_answer
from rotordyn.analyses.preload.summary import summary
from rotordyn.analyses.stiffness.solve import solve as stiffness_answer
from rotordyn.errors import InvalidInput, NoSolution, TooCostly
from rotordyn.machine.history import HistoryStep, Past
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import BearingTemperatures, Temperatures
from rotordyn.preload import axial_tables as axial_tables_module
from rotordyn.preload.arrangement import arrangement
from rotordyn.preload.axial_tables import _Request, axial_tables, solved
from rotordyn.preload.friction import Rubbing, operating_state
from rotordyn.preload.history import Moment, history, moments, most_moments
from rotordyn.preload.passed_speeds import SPACING, passed_speeds
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.known_grooves import deep_groove, drawn_6210
from tests.oracles.spindles import RPM, case, mfw2310, scene, system_of, with_sleeve

LAW = Law("outer", "equal")
FRICTION = 80.9  # N, Noël 2013, Tab. 3.7
FILE = Path(__file__).parents[1] / "rotordyn" / "state" / "network_cases.json"
KNOWN = {case["name"]: case for case in json.loads(FILE.read_text(encoding="utf-8"))["cases"]}
FRONT = 1  # body
REST = np.zeros(1)


def rubbing(limit: float = FRICTION) -> Spindle:
    return with_sleeve(mfw2310(), "front", friction=limit)


def forces(*values: float) -> tuple[HistoryStep, ...]:
    return tuple(HistoryStep(axial_force=value) for value in values)


def test_a_history_of_forces_with_real_bearings() -> None:
    case = KNOWN["mfw2310_rest_friction"]
    force = [step["force"]["shaft"] for step in case["path"]]
    for k, known in enumerate(case["answers"]):
        past = Past(forces(*force[:k]))
        state = operating_state(rubbing(), REST, LAW, force[k], past=past)
        assert state.shift[0] == pytest.approx(list(known["x"].values()), abs=0.02e-6, rel=0.0)
        assert state.net.response.load[0] == pytest.approx(known["load"], rel=1e-3)
        assert state.friction_force[0, 0] + state.stop_force[0, 0] == pytest.approx(
            known["friction"][0] + known["stop"][0], rel=1e-3
        )


def test_a_history_without_a_state_names_its_speed(monkeypatch: pytest.MonkeyPatch) -> None:
    speed = np.array([0.0, 16000.0]) * RPM
    whole = history(dynamic_preload(rubbing(), speed, LAW), 0.0)
    found = list(whole.run_up())

    class Ended:
        network = whole.network

        def run_up(self) -> list[Any]:
            return [found[0], "a spring ends"]

    monkeypatch.setattr("rotordyn.preload.history.history", lambda state, reach: Ended())
    words = operating_state(rubbing(), speed, LAW).outcome
    assert words == ("", "the history leads to no state at 16000 rpm: a spring ends")


def test_without_friction_the_history_leaves_nothing() -> None:
    speed = np.array([0.0, 16000.0]) * RPM
    plain = dynamic_preload(mfw2310(), speed, LAW, -200.0)
    same = operating_state(mfw2310(), speed, LAW, -200.0, past=Past(forces(-1000.0)))
    assert (same.net.position == plain.net.position).all()
    faint = operating_state(rubbing(1e-6), speed, LAW, -200.0, past=Past(forces(-1000.0)))
    assert faint.seat_load() == pytest.approx(plain.seat_load(), rel=1e-8)


def test_running_down_leaves_the_sleeve_behind() -> None:
    """It was pushed forwards at full speed and lags: friction pulls forwards on the way up and
    backwards on the way down, and at rest the limit of it is left in the bearings."""
    speed = np.array([0.0, 8000.0, 16000.0]) * RPM
    up = operating_state(rubbing(), speed, LAW)
    down = operating_state(rubbing(), speed, LAW, past=Past((HistoryStep(speed=16000.0 * RPM),)))
    assert up.friction_force[1:, 0] == pytest.approx([FRICTION, FRICTION], rel=1e-6)
    assert down.friction_force[:2, 0] == pytest.approx([-FRICTION, -FRICTION], rel=1e-6)
    assert down.shift[2] == pytest.approx(up.shift[2], abs=1e-12)
    pressed = down.seat_load()[0, 2] - up.seat_load()[0, 2]
    spring = -6.2e6 * down.shift[0, FRONT]
    assert pressed == pytest.approx(spring - FRICTION, rel=1e-6)


def _lateral(force: float, limit: float = FRICTION, rpm: float = 0.0) -> PreloadState:
    load = PointLoad(at="nose_face", Fy=force)
    return scene(rubbing(limit), [rpm], loads=(load,)).preload


@pytest.mark.parametrize("rpm", [0.0, 12000.0])
def test_coulomb_under_loads_across_the_axis(rpm: float) -> None:
    """Forces on the sleeve balance, friction is within its limit, and at it where it slid."""
    before = scene(rubbing(), [rpm]).preload
    slid = []
    for force in (200.0, 1500.0, 3000.0):
        state = _lateral(force, rpm=rpm)
        assert state.outcome == ("",)
        friction, way = state.friction_force[0, 0], state.shift[0, FRONT] - before.shift[0, FRONT]
        pulled = 574.0 - 6.2e6 * state.shift[0, FRONT] - state.seat_load()[0, 2]
        assert friction + pulled == pytest.approx(0.0, abs=1e-4)
        assert abs(friction) <= FRICTION * (1.0 + 1e-9)
        if abs(way) > 1e-12:
            assert friction == pytest.approx(-math.copysign(FRICTION, way), rel=1e-9)
        slid.append(abs(way) > 1e-12)
    assert slid[-1], "the highest load makes the sleeve slide"
    assert rpm > 0.0 or not slid[0], "at rest the lowest one does not"


def test_a_sleeve_that_friction_never_lets_go_is_a_locked_one() -> None:
    held = with_sleeve(mfw2310(), "front", friction=1e6)
    spring = replace(mfw2310().sleeves[0].spring, stiffness=math.inf)
    locked = with_sleeve(mfw2310(), "front", spring=spring)
    spec = StiffnessSpec(point="Oc2", max_force=1000.0, steps=4, variants=("nonlinear",))
    one, other = (stiffness_answer(scene(each, [0.0]), spec) for each in (held, locked))
    assert one.deflection == pytest.approx(other.deflection, rel=1e-7)
    found = [system_of(scene(each, [0.0]), "axial").pole[0] for each in (held, locked)]
    first = [np.sort(np.abs(poles[np.isfinite(poles)]))[:2] for poles in found]
    assert first[0] == pytest.approx(first[1], rel=1e-5)


def test_the_curve_of_a_sleeve_that_slides_does_not_follow_the_steps() -> None:
    curves = [_curve(steps) for steps in (6, 24)]
    assert curves[0][1:] == pytest.approx(curves[1][4::4], rel=1e-7)
    smooth = _curve(6, limit=0.0)
    assert curves[0][-1] < 0.999 * smooth[-1], "friction makes it stiffer"


def test_a_sleeve_that_slides_back_rubs_from_where_it_turns() -> None:
    """The force of the curve takes a static one away, then passes it."""
    pull = (PointLoad(at="Oc2", Fy=-2500.0),)
    curves = [_curve(steps, most=5000.0, loads=pull) for steps in (4, 16)]
    assert curves[0][1:] == pytest.approx(curves[1][4::4], rel=1e-7)


def _curve(
    steps: int, limit: float = FRICTION, most: float = 3000.0, **conditions: Any
) -> np.ndarray[Any, Any]:
    spec = StiffnessSpec(point="Oc2", max_force=most, steps=steps, variants=("nonlinear",))
    result = stiffness_answer(scene(rubbing(limit), [0.0], **conditions), spec)
    return np.asarray(result.deflection[0, 0])


def test_vibrations_find_the_sleeve_standing() -> None:
    """Axial stiffness of the equation of motion, the shaft rigid: bearing c acts against the
    housing where friction holds its sleeve, in series with the spring else."""
    expected, stiffness = [], []
    for limit in (FRICTION, 0.0):
        found = scene(
            rubbing(limit), [0.0], rotor="rigid", axial_force=-815.0, history=forces(1600.0)
        )
        each = found.tangents[0, :, 0, 0]
        rear = 1.0 / (1.0 / (each[3] + each[4]) + 1.0 / 5.49e6)
        front = each[2] if limit else 1.0 / (1.0 / each[2] + 1.0 / 6.2e6)
        expected.append(each[0] + each[1] + front + rear)
        (k,) = found.with_motions(("axial",))
        linear = found.linear(k)
        row = linear.row("spindle", 0.0, "x")
        stiffness.append(1.0 / float(row @ np.linalg.solve(linear.stiffness[0], row)))
        assert not found.stopped.any()
    assert stiffness == pytest.approx(expected, rel=1e-5)
    assert stiffness == pytest.approx([180e6, 120e6], rel=0.09), "Noël 2013, Fig. 3.28"


def test_lines_say_where_friction_is() -> None:
    found = scene(rubbing(), [0.0, 12000.0])
    lines = summary(preload_answer(found, PreloadSpec()))
    assert any(line.startswith("friction   front") and "0.0 → 80.9" in line for line in lines)
    (note,) = found.notes
    assert note.startswith("dry friction holds sleeve front: the state is the one after a run-up")
    assert note.endswith("along the axis")
    fast = scene(rubbing(), [0.0, 24000.0])
    assert fast.preload.usable.all()
    (stopped,) = fast.notes
    assert stopped.endswith("only the sum of stop and friction force is determined")
    plain = scene(mfw2310(), [0.0])
    assert not plain.notes
    assert not any("friction " in line for line in summary(preload_answer(plain, PreloadSpec())))


def test_a_history_without_friction_is_warned_of() -> None:
    found = scene(mfw2310(), [0.0], history=forces(100.0))
    assert any(said.startswith("history: no sleeve has friction") for said in found.warnings)


def test_the_stop_is_met_where_the_path_meets_it() -> None:
    found = scene(rubbing(), [0.0, 20000.0, 24000.0])
    speed = float(found.stop_speeds[0])
    near = np.array([1.0 - 1e-8, 1.0 + 1e-8]) * speed
    held = Scene(found.spindle, found.conditions, near).preload.net.held[:, FRONT]
    assert held.tolist() == [False, True]
    smooth = float(scene(mfw2310(), [0.0, 20000.0, 24000.0]).stop_speeds[0])
    assert smooth < speed, "friction resists on the way"


@pytest.mark.few(1)
@pytest.mark.parametrize("limit", [150.0, 400.0])
def test_friction_holds_a_sleeve_at_its_stop_until_it_slides_away(limit: float) -> None:
    """Back from full speed the stop carries nothing soon, yet the sleeve remains there: where it
    leaves does not depend on the speeds of the case, and friction is at its limit there."""
    speed = []
    for steps in (6, 12):
        found = scene(
            rubbing(limit),
            np.linspace(0.0, 24000.0, steps + 1).tolist(),
            history=(HistoryStep(speed=24000.0 * RPM),),
        )
        speed.append(float(found.stop_speeds[0]))
        stopped = found.preload.stopped[:, 0]
        assert stopped.tolist() == (found.speed > speed[-1]).tolist()
        carries_nothing = stopped & (found.preload.stop_force[:, 0] < 1e-3)
        assert carries_nothing.any()
    assert speed[1] == pytest.approx(speed[0], rel=1e-8)
    near = np.array([1.0 - 1e-7, 1.0 + 1e-7]) * speed[0]
    before, after = Scene(found.spindle, found.conditions, near).preload.friction_force[:, 0]
    assert before == pytest.approx(-limit, rel=1e-12)
    assert -limit < after < -limit * (1.0 - 1e-5)


@pytest.mark.long
def test_friction_that_takes_over_from_a_stop_is_no_stop_speed() -> None:
    """On the way back neither the stop nor friction is at a limit of its own for a moment."""
    spindle = with_sleeve(mfw2310(), "front", friction=4.8, stop_travel=30.4e-6)
    found = scene(spindle, [12000.0, 21300.0], history=(HistoryStep(speed=24000.0 * RPM),))
    near = np.array([1.0 - 1e-7, 1.0 + 1e-7]) * float(found.stop_speeds[0])
    stopped = Scene(found.spindle, found.conditions, near).preload.stopped
    assert stopped[:, 0].tolist() == [False, True]


# --- order of the path ---------------------------------------------------------------------------


def test_by_default_temperatures_come_first_and_forces_last() -> None:
    before, _, through, after = moments(Past(weight=50.0), [0.0, 10.0], 250.0)
    assert before == [Moment(0.0, False, 50.0), Moment(0.0, True, 50.0)]
    assert through == [Moment(0.0, True, 50.0), Moment(10.0, True, 50.0)]
    assert [path[1:] for path in after] == [[Moment(s, True, 250.0)] for s in (0.0, 10.0)]


def test_a_history_in_its_order() -> None:
    steps = (
        HistoryStep(speed=25.0),
        HistoryStep(axial_force=-100.0),
        HistoryStep(run_up=True),
        HistoryStep(axial_force=0.0),
    )
    before, _, through, after = moments(Past(steps), [10.0, 20.0, 30.0], 5.0)
    assert [at.speed for at in before] == [25.0, 25.0]
    assert before[-1] == Moment(25.0, False, -100.0)
    assert [at.force for at in through] == [-100.0] * 3
    assert [at.force for at in after[1]] == [-100.0, 0.0, 0.0, 5.0]
    assert [at.warm for at in after[1]] == [False, False, True, True]


def test_ways_lead_through_speeds_of_their_own_up_and_down() -> None:
    """Whatever the speeds of the case, to each of which a branch leads."""
    ways = [HistoryStep(speed=speed) for speed in (25.0, 15.0)]
    steps, speeds, between = (*ways, HistoryStep(run_up=True)), [4.0, 20.0, 31.0], [5.0, 10.0, 20.0]
    before, passed, through, after = moments(Past(steps), speeds, 0.0, [*between, 30.0])
    assert [at.speed for at in before] == [5.0, 10.0, 20.0, 25.0, 20.0, 15.0]
    assert [[at.speed for at in way] for way in passed] == [[10.0, 5.0], [], [20.0, 30.0]]
    assert [at.speed for at in through] == speeds
    count = len(before) + sum(map(len, passed)) + len(through) + 2 * len(after)
    assert count <= most_moments(Past(steps), len(speeds), [*between, 30.0]) <= count + 1


def grinding(limit: float) -> Spindle:
    return with_sleeve(case("grinding_spindle").spindle, "rear", friction=limit)


TOP = 12000.0 * RPM
STRAIGHT = Temperatures(shaft=(20.0, 45.0), housing=(20.0, 30.0), speeds=(0.0, TOP))
PEAK = Temperatures(
    shaft=(20.0, 50.0, 35.0), housing=(20.0, 30.0, 30.0), speeds=(0.0, 0.5 * TOP, TOP)
)


@pytest.mark.parametrize(
    ("limit", "expected"),
    [(60.0, (575.7, 733.5)), (200.0, (623.4, 806.2)), (400.0, (693.0, 912.2))],
)
def test_a_run_up_turns_where_temperatures_and_growth_do(
    limit: float, expected: tuple[float, float]
) -> None:
    """Growth goes with Ω², heat with Ω: the sleeve slides one way at first, then the other. Against
    loads of a and b by 17 steps of speed, each balanced alone."""
    law = case("grinding_spindle").conditions.law
    state = operating_state(grinding(limit), np.array([TOP]), law, 0.0, STRAIGHT)
    assert state.friction_force[0, 0] == pytest.approx(limit)
    assert state.seat_load()[0, :2] == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize(("warm", "limit"), [(STRAIGHT, 200.0), (PEAK, 60.0)])
def test_a_state_with_friction_does_not_hang_on_the_other_speeds_listed(
    warm: Temperatures, limit: float
) -> None:
    """Whether the sleeve sticks there or slides."""
    law, found = case("grinding_spindle").conditions.law, []
    for speeds in ([0.75 * TOP], [0.1 * TOP, 0.4 * TOP, 0.75 * TOP, TOP]):
        state = operating_state(grinding(limit), np.array(speeds), law, 0.0, warm)
        row = speeds.index(0.75 * TOP)
        found.append([*state.friction_force[row], *state.seat_load()[row]])
    assert found[0] == pytest.approx(found[1], rel=1e-9)


@pytest.mark.parametrize(("shaft", "housing"), [(25.0, 45.0), (45.0, 30.0), (30.0, 45.0)])
def test_a_sleeve_sticks_through_a_change_of_temperature_that_friction_bears(
    shaft: float, housing: float
) -> None:
    """Its friction is then that of a sleeve that cannot slide. A limit a little above the largest
    on the way, as at four temperatures on it, changes nothing."""
    law = case("grinding_spindle").conditions.law

    def friction(limit: float, share: float = 1.0) -> float:
        warm = Temperatures(*(20.0 + share * (at - 20.0) for at in (shaft, housing)))
        state = operating_state(grinding(limit), REST, law, 0.0, warm)
        return float(state.friction_force[0, 0])

    stuck = [friction(5000.0, share) for share in (0.25, 0.5, 0.75, 1.0)]
    limit = 1.1 * max(map(abs, stuck)) + 5.0
    assert friction(limit) == pytest.approx(stuck[-1], abs=1e-3)


def test_changes_of_temperature_have_parts() -> None:
    steps = HistoryStep(warm=True), HistoryStep(run_up=True), HistoryStep(warm=False)
    before, _, _, after = moments(Past(steps), [10.0], 0.0, (), 4)
    assert [at.warm for at in before] == [0.25, 0.5, 0.75, 1.0]
    assert [at.warm for at in after[0]] == [1.0, 0.75, 0.5, 0.25, 0.0, 0.25, 0.5, 0.75, 1.0]
    assert len(before) + 1 + len(after[0]) <= most_moments(Past(steps), 1, (), 4)


def test_a_step_of_a_spectrum_has_the_life_of_its_speed() -> None:
    machine, conditions = grinding(400.0), Conditions(temperatures=STRAIGHT)
    speed = np.array([0.25, 0.5, 0.75, 1.0]) * TOP
    found = life_answer(
        Scene(machine, conditions, speed), LifeSpec(spectrum=(LoadStep(share=1.0, speed=TOP),))
    )
    assert found.spectrum_life == pytest.approx(found.life[-1], rel=1e-9)


def test_ways_at_constant_temperatures_are_straight() -> None:
    """All goes with Ω² then: no more tables of bearings are needed."""
    assert not passed_speeds(grinding(60.0), TOP, None).size
    assert not passed_speeds(grinding(60.0), TOP, Temperatures(shaft=40.0)).size
    passed = passed_speeds(grinding(60.0), TOP, PEAK)
    assert 0.5 * TOP in passed
    largest = max(seat.bearing.pitch_diameter for seat in grinding(60.0).seats)
    assert np.diff(passed, prepend=0.0).max() * largest == pytest.approx(SPACING)


def test_bearings_that_do_not_stay_alike_are_followed_apart() -> None:
    """The inner ring of d is hot at 10 000 rpm alone, which the history passes: where that is a
    speed of the case, both bearings of the tandem are distinguished anyway."""
    ring = BearingTemperatures((20.0, 80.0, 20.0), (20.0,) * 3, (20.0,) * 3)
    speeds = (0.0, 10000.0 * RPM, 20000.0 * RPM)
    warm = Temperatures(shaft=20.0, speeds=speeds, bearings={"d": ring})
    machine = with_sleeve(
        with_sleeve(mfw2310(shortening=None), "front", friction=200.0), "rear", friction=200.0
    )
    steps = HistoryStep(warm=True), HistoryStep(speed=speeds[1]), HistoryStep(run_up=True)
    alone, both = (
        operating_state(machine, np.array(at), LAW, 0.0, warm, Past(steps))
        for at in (speeds[2:], speeds[1:])
    )
    assert len(alone.network.arrangement.bearings) == 3
    assert alone.seat_load()[-1] == pytest.approx(both.seat_load()[-1], rel=1e-6)
    assert abs(both.friction_force[-1, 1]) < 100.0


def test_a_history_longer_than_allowed_is_refused_before_it_begins(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    speed = np.linspace(0.0, 12000.0, 50) * RPM
    past = Past((*forces(*range(1000)), HistoryStep(run_up=True), *forces(*range(3000))))
    with within(60.0), pytest.raises(TooCostly, match=r"151150 steps.* take about 304 s"):
        operating_state(rubbing(), speed, LAW, past=past)
    many = AxialCycleSpec(steps=1000)
    with within(3.0), pytest.raises(TooCostly, match=r"axial_cycle: 2003 steps take about 4"):
        axial_cycle(scene(mfw2310(), [0.0]), many)
    monkeypatch.setattr("rotordyn.preload.history.require_history", lambda *_: None)
    with within(0.0), pytest.raises(TooCostly, match="history: broken off"):
        operating_state(rubbing(), REST, LAW)


def test_friction_slides_sticks_and_turns() -> None:
    """One sleeve of 10 N at four places: within the limit, beyond it, sliding on, sliding back."""
    place, rows = np.zeros((4, 1)), np.ones((4, 1), dtype=bool)
    stuck = np.array([[True], [True], [False], [False]])
    force = np.array([[0.0], [0.0], [-10.0], [-10.0]])
    here = Rubbing(np.array([10.0]), stuck, place, force, place)
    position = np.array([[0.0], [0.0], [2e-6], [-2e-6]])
    after = here.after(np.array([[9.0], [12.0], [10.0], [10.0]]), position, ~rows, ~rows)
    assert after.stuck.ravel().tolist() == [True, False, False, True]
    assert after.force.ravel()[1:3].tolist() == [-10.0, -10.0]
    assert after.place[3, 0] == 0.0
    left = here.after(np.zeros((4, 1)), position, rows, ~rows)
    assert left.stuck.all(), "a sleeve that leaves its stop sticks there"
    assert left.place == pytest.approx(position)


def test_a_warm_spindle_may_run_up_cold() -> None:
    """A shaft that gets longer by heat pushes the sleeve back, a run-up draws it forwards: what is
    last leaves its friction."""
    warm = Temperatures(shaft=40.0, housing=20.0, inner_rings=20.0, outer_rings=20.0)
    speed = np.array([12000.0]) * RPM
    first, last = (
        operating_state(rubbing(), speed, LAW, 0.0, warm, Past(steps))
        for steps in ((), (HistoryStep(run_up=True),))
    )
    same = (HistoryStep(warm=True), HistoryStep(run_up=True))
    again = operating_state(rubbing(), speed, LAW, 0.0, warm, Past(same))
    assert (again.net.position == first.net.position).all()
    assert np.abs(first.friction_force - last.friction_force).max() > 1.0


@pytest.mark.parametrize(
    ("words", "build"),
    [
        ("one thing: given nothing", HistoryStep),
        ("one thing: given warm and axial_force", lambda: HistoryStep(warm=True, axial_force=1.0)),
        ("axial_force.*nan", lambda: HistoryStep(axial_force=math.nan)),
        (
            r"history\.2.speed: after the run-up",
            lambda: scene(
                mfw2310(), [0.0], history=(HistoryStep(run_up=True), HistoryStep(speed=1.0))
            ),
        ),
        (
            r"history\.2.run_up: a history runs up once",
            lambda: scene(mfw2310(), [0.0], history=(HistoryStep(run_up=True),) * 2),
        ),
    ],
)
def test_histories_that_make_no_sense(words: str, build: Any) -> None:
    with pytest.raises(InvalidInput, match=words):
        build()


@pytest.mark.parametrize("d", [3e-8, 2e-7, 1.7e-6, 1.3e-5])
def test_the_table_of_a_bearing_for_both_ways_is_odd(d: float) -> None:
    """And is its law, to 0.1 mN where there is next to no load."""
    model = deep_groove(drawn_6210(0.0))
    law = solved([_Request(model, LAW, (0.0, 0.0), 0.0, 50e-6)])[0].law
    exact = float(model.equilibrium(displacement=[d, 0, 0, 0, 0]).load[0])
    assert law(d)[0] == pytest.approx(exact, rel=2e-3, abs=1e-4)
    assert law(-d)[0] == pytest.approx(-law(d)[0], rel=1e-9)
    assert law(-d)[1] == pytest.approx(law(d)[1], rel=1e-6)


def test_a_table_for_both_ways_goes_on_beyond_both_ends() -> None:
    law = solved([_Request(deep_groove(drawn_6210(0.0)), LAW, (0.0, 0.0), 0.0, 50e-6)])[0].law
    for d in (60e-6, 500e-6):
        assert law(-d)[0] == pytest.approx(-law(d)[0], rel=1e-6)


@pytest.mark.parametrize("growth", [0.0, 3e-6])
def test_no_points_of_a_table_nearly_coincide(growth: float) -> None:
    """Rounding of the loads of such a pair would make its slope between."""
    model = AngularContactBallBearing(8e-3, 60e-3, 16, contact_angle=math.radians(18))
    law = solved([_Request(model, LAW, (growth, growth), 0.0, 50e-6)])[0].law
    slope = np.array([law(d)[1] for d in law.breakpoints])
    between = np.array([law((a + b) / 2.0)[1] for a, b in pairwise(law.breakpoints)])
    assert between == pytest.approx((slope[1:] + slope[:-1]) / 2.0, abs=0.02 * slope.max())


def test_tables_solved_together_are_those_of_each(monkeypatch: pytest.MonkeyPatch) -> None:
    """More of them than are kept, and than one batch holds."""
    model = AngularContactBallBearing(8e-3, 60e-3, 16, contact_angle=math.radians(18))
    asked = [_Request(model, LAW, (0.0, 1e-7 * k), 150.0 * k, 4e-5 + 1e-6 * k) for k in range(10)]
    monkeypatch.setattr(axial_tables_module, "TABLES", 4)
    monkeypatch.setattr(axial_tables_module, "_kept", {})
    together = solved(asked)
    assert [*axial_tables_module._kept] == asked[-4:]
    axial_tables_module._kept.clear()
    for one, found in zip(asked, together, strict=True):
        (alone,) = solved([one])
        assert found.law.breakpoints == pytest.approx(alone.law.breakpoints, rel=1e-12)
        for d in (0.3 * one.high, 0.9 * one.high):
            assert found.law(d) == pytest.approx(alone.law(d), rel=1e-9)


def test_tables_reach_far_above_the_loads_that_are_known() -> None:
    """What growth and stops press on bearings is known later."""
    one = arrangement(mfw2310(), REST, 0.0, LAW).bearings[0]
    d = 0.2 * one.model.free_distance
    growth = {"static_growth": one.static_growth[0], "growth": one.growth[0]}
    exact = one.model.equilibrium(displacement=[d, 0, 0, 0, 0], **growth, **asdict(one.law))
    (law,) = axial_tables([one], [0.0], 100.0)
    assert law(d)[0] == pytest.approx(float(exact.load[0]), rel=1e-6)


def test_rings_at_all_speeds_of_a_history_are_solved_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As mounted and warm, and give at each speed what they do at that speed alone."""
    speed, made = np.linspace(0.0, 16000.0, 9) * RPM, []

    def counted(*given: Any) -> Any:
        made.append(given)
        return arrangement(*given)

    monkeypatch.setattr("rotordyn.preload.history.arrangement", counted)
    state = dynamic_preload(rubbing(), speed, LAW, temperatures=Temperatures(shaft=40.0))
    found = history(state, 0.0)
    assert len(made) <= 3
    for row in (3, 8):
        alone = arrangement(rubbing(), speed[row : row + 1], 0.0, LAW, state.temperatures)
        shift = [each.shortening[0] for each in alone.bearings]
        of_seat = dict(zip(found.of_seat, alone.bearing_of_seat, strict=True))
        assert [found.through[row].shift[k] for k in of_seat] == [
            shift[j] for j in of_seat.values()
        ]


def test_loads_at_rest_are_those_without_friction() -> None:
    """As stated preloads are meant: at several speeds, with a force from outside."""
    speed = np.array([0.0, 12000.0, 24000.0]) * RPM
    rubs, slides = (operating_state(s, speed, LAW, 200.0) for s in (rubbing(), mfw2310()))
    assert rubs.network.friction.any()
    assert rubs.rest_loads() == pytest.approx(slides.rest_loads(), rel=1e-9)
    held = scene(rubbing(), speed, axial_force=200.0)
    found = stiffness_answer(held, StiffnessSpec("Oc2", 100.0, variants=("constant_preload",)))
    assert np.isfinite(found.tangent).all()


def test_a_bearing_without_any_state_is_named() -> None:
    """So fast that its balls stay away from the inner ring wherever it is pressed."""
    model = AngularContactBallBearing(8e-3, 60e-3, 16, contact_angle=math.radians(18))
    with pytest.raises(
        NoSolution, match=r"no axial equilibrium at any deflection; lower the speed"
    ):
        solved([_Request(model, LAW, (0.0, 0.0), 4e5, 1e-9)])
