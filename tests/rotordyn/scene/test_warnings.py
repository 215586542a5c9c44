"""What is said of bearings at work, whatever the case asks for, and of results that fall short."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.frf import summary as frf
from rotordyn.analyses.stiffness import solve as stiffness
from rotordyn.analyses.stiffness import summary as stiffness_summary
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.unbalance import summary as unbalance
from rotordyn.case.model import model
from rotordyn.machine.seat import BearingSeat
from rotordyn.results.balls import friction_warning, pressed, slipping, softened
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from rotordyn.scene.warnings import _unloaded_balls, bearing_warnings
from tests.oracles.spindles import RPM, conditions, mfw2310
from tests.rotordyn.figures import samples

SPEEDS = np.array([0.0, 12000.0, 24000.0]) * RPM
POINT = next(iter(mfw2310().points))


def test_pressure_slip_and_required_friction_are_named_from_their_first_speed() -> None:
    peak = np.array([1e9, 4.5e9, 4.4e9])
    assert pressed("bearing a", SPEEDS, peak).startswith("bearing a: contact pressure 4.50 GPa")
    assert "from 12000 rpm on" in pressed("bearing a", SPEEDS, peak)
    assert "the inner race from 24000 rpm" in slipping("a", SPEEDS, np.array(["", "", "inner"]))
    assert "above 0.3, more than the 0.1" in friction_warning(
        "a", SPEEDS, np.array([0.0, 0.05, 0.3])
    )
    assert not pressed("a", SPEEDS, np.full(3, np.nan))
    assert not slipping("a", SPEEDS, np.full(3, ""))
    assert not friction_warning("a", SPEEDS, np.array([0.0, np.nan, 0.0999]))


def test_warnings_of_balls_say_at_which_speeds() -> None:
    """Friction that is needed at speeds in the middle is not needed from there on."""
    speeds = np.array([0.0, 6000.0, 7500.0, 9000.0, 10500.0]) * RPM
    required = np.array([np.nan, 0.11, 0.13, 0.09, 0.07])
    slips, factor = np.where(required > 0.12, "inner", ""), np.where(required > 0.1, 0.9, 1.0)
    assert "at 2 of 5 speeds, first at 6000 rpm; raise" in friction_warning("a", speeds, required)
    assert "contacts from 6000 rpm on; raise" in friction_warning("a", speeds[:3], required[:3])
    assert "the inner race at 7500 rpm (friction" in slipping("a", speeds, slips)
    assert "150 °C at 2 of 5 speeds, first at 6000 rpm:" in softened(factor[:, None], speeds)
    one_of_two = np.stack([factor, np.ones(5)], axis=1)
    assert softened(one_of_two, speeds) == softened(factor[:, None], speeds)
    assert "at 2 of 5 speeds, first at 6000 rpm:" in pressed("a", speeds, 4e10 * required)


def test_bearings_are_judged_wherever_they_were_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """No analysis of the preload state is requested."""
    little = Scene(mfw2310(), conditions(friction=0.01), SPEEDS)
    assert little.preload.usable.all()
    assert any("the balls slip" in sentence for sentence in bearing_warnings(little))
    held = Scene(mfw2310(), conditions(), SPEEDS)
    assert held.preload.usable.all()
    assert not list(bearing_warnings(held))
    monkeypatch.setattr("rotordyn.results.balls.OILED", 0.03)  # they need 0.037 to 0.05
    assert any(
        "a, b, c, d, e: the balls roll without gyroscopic slip only if friction is above 0.05,"
        in sentence
        for sentence in bearing_warnings(held)
    )


def test_balls_on_the_side_without_a_shoulder_are_reported() -> None:
    """A ring moved against its thrust in its seat, at the second of two speeds."""
    seat = mfw2310().seats[0]
    travel = 2.0 * seat.bearing.grooves.free_distance
    displaced = np.array([[[1e-6, 0, 0, 0, 0]], [[1e-6 - travel, 0, 0, 0, 0]]])
    balls = seat.bearing.equilibrium(displacement=displaced)
    assert (balls.status == "open side").all(axis=-1).tolist() == [[False], [True]]
    state = SimpleNamespace(
        speed=SPEEDS[:2],
        usable=np.array([True, True]),
        seat_states=lambda: [(balls, 0)],
        lateral=None,
        force=0.0,
        small_shims=list,
    )
    scene = SimpleNamespace(preload=state, spindle=SimpleNamespace(seats=[seat]))
    (said,) = (one for one in bearing_warnings(scene) if "shoulder" in one)
    assert said.startswith(
        f"bearing {seat.name}: balls bear where the rings have no shoulder from 12000 rpm on: raise"
    )
    state.usable[1] = False
    assert not [one for one in bearing_warnings(scene) if "shoulder" in one]


def test_a_bearing_that_a_radial_force_unloads_is_named() -> None:
    """The same force is far from unloading the machine as it is built."""
    built = Scene(mfw2310(), conditions(), np.array([0.0]))
    found = stiffness.solve(built, StiffnessSpec(POINT, 100.0, variants=("nonlinear",)))
    assert not stiffness_summary.warnings(found)
    assert np.isnan(found.unloading_force).all()
    force, ball, azimuth = np.full((3, *found.unloading_force.shape), np.nan)
    force[0, 1], ball[0, 1], azimuth[0, 1] = 50.0, 7.0, 0.5 * np.pi
    lost = replace(found, unloading_force=force, unloaded_ball=ball, unloaded_azimuth=azimuth)
    (said,) = stiffness_summary.warnings(lost)
    assert said.startswith(
        f"bearing {found.bearing[1]}: its ball 7, at 90° from y towards z, loses contact under a "
        "radial force of 50 N at 0 rpm"
    )


def test_half_the_preload_unloads_at_less_force() -> None:
    """Balls are pressed by the preload alone, so less of it is taken away by less force."""
    machine, first = mfw2310(), []
    for share in (0.5, 0.25):
        sleeves = tuple(
            replace(each, spring=replace(each.spring, preload=share * each.spring.preload))
            for each in machine.sleeves
        )
        scene = Scene(replace(machine, sleeves=sleeves), conditions(), np.array([0.0]))
        found = stiffness.solve(scene, StiffnessSpec(POINT, 3e3, 60, variants=("nonlinear",)))
        assert stiffness_summary.warnings(found)
        first.append(np.nanmin(found.unloading_force))
        coarse = stiffness.solve(scene, StiffnessSpec(POINT, 3e3, 1, variants=("nonlinear",)))
        assert coarse.unloading_force == pytest.approx(found.unloading_force, rel=1e-3, nan_ok=True)
        assert (coarse.unloaded_ball == found.unloaded_ball)[~np.isnan(found.unloading_force)].all()
    assert first[1] < 0.75 * first[0]


def test_accuracy_not_reached_is_a_warning() -> None:
    for module, result in ((frf, samples.frf()), (unbalance, samples.unbalance())):
        assert not [one for one in module.warnings(result) if "less accurate" in one]
        worse = replace(result, error_asked=1e-9)
        (said,) = (one for one in module.warnings(worse) if "less accurate" in one)
        assert "remains after refinement" in said


@pytest.mark.parametrize(("times", "said"), [(1.0, False), (8.0, True)])
def test_preloads_beyond_all_classes_are_reported(times: float, said: bool) -> None:
    machine = mfw2310()
    sleeves = tuple(
        replace(each, spring=replace(each.spring, preload=times * each.spring.preload))
        for each in machine.sleeves
    )
    found = Scene(replace(machine, sleeves=sleeves), conditions(), np.array([0.0]))
    assert found.outcome == ("",)
    told = [one for one in found.warnings if "preloaded to less than 2 GPa" in one]
    assert bool(told) == said


def test_a_bearing_within_its_play_is_reported() -> None:
    spindle = rotordyn.load("spindle_deep_groove_rear").spindle
    deep, angular = spindle.seats[-1], spindle.seats[0]
    assert (deep.bearing.both_ways, angular.bearing.both_ways) == (True, False)
    load = np.array([[5.0, 0.0, 2.0], [0.0, 0.0, 0.0]])
    speed, usable = np.array([0.0, 300.0]), np.array([True, True])
    (said,) = _unloaded_balls(speed, usable, [(deep, load)])
    assert "within the clearance at 2865 rpm" in said
    assert not [*_unloaded_balls(speed[:1], usable[:1], [(deep, load[:1])])]
    three, usable = np.array([0.0, 100.0, 300.0]), np.full(3, fill_value=True)
    for first_ball, when in (
        ([0.0, 0.0, 0.0], "the clearance from 0 rpm on:"),
        ([5.0, 0.0, 0.0], "the clearance from 955 rpm on:"),
        ([0.0, 5.0, 0.0], "the clearance at 2 of 3 speeds, first at 0 rpm:"),
    ):
        (said,) = _unloaded_balls(three, usable, [(deep, np.outer(first_ball, np.ones(3)))])
        assert when in said
    (some,) = _unloaded_balls(speed[:1], usable[:1], [(angular, load[:1])])
    assert "1 of its 3 balls carry nothing" in some
    (both,) = _unloaded_balls(
        speed, usable[:2], [(angular, load), (spindle.seats[1], np.array([[5.0, 0.0, 0.0]] * 2))]
    )
    names = f"bearings {angular.name}, {spindle.seats[1].name}"
    assert both.startswith(f"{names}: under the static loads 2 of 3 balls of ")
    assert "carry nothing from 0 rpm on" in both


def test_bearings_of_one_kind_of_warning_share_a_sentence() -> None:
    """With the largest value, at the speeds of all of them; grave ones are not pushed out."""
    fast = SPEEDS[-1] * 1.5
    machine = rotordyn.load("grinding_spindle_fits").variants["cold"].spindle
    assert machine is not None
    sleeves = tuple(
        replace(each, spring=replace(each.spring, preload=60.0, stiffness=8e6))
        for each in machine.sleeves
    )
    speeds = np.array([0.0, 0.5, 1.0]) * fast
    scene = Scene(replace(machine, sleeves=sleeves), Conditions(), speeds)
    assert scene.preload.usable.all()
    said = scene.warnings
    for words in ("n·dm 3.2 million", "inner rings loosen at", "the balls roll without"):
        (sentence,) = (one for one in said if words in one)
        assert sentence.startswith("bearings a, b, c, d: ")
    peaks = [
        np.fmax(balls.inner_required_friction, balls.outer_required_friction)[:, column].max()
        for balls, column in scene.preload.seat_states()
    ]
    assert f"only if friction is above {max(peaks):.2g}, more" in "".join(said)


def test_balls_with_a_third_contact_are_noted() -> None:
    """The QJ 218 has it under 500 N at 3000 rpm, and not under 50 kN."""
    for force, noted in ((500.0, True), (50e3, False)):
        seat = BearingSeat("front", model("bearings", "qj218"), 0.05)
        machine = mfw2310(seats=(seat,), sleeves=(), arrangement=None, shortening=None)
        speed = np.array([0.0, 3000.0, 6000.0]) * RPM
        scene = Scene(machine, conditions(axial_force=force), speed)
        assert scene.preload.usable.all()
        said = [each for each in scene.notes if "more than two contacts" in each]
        assert bool(said) == noted
        if noted:
            assert "balls of bearing front have more than two contacts from 3000 rpm on" in said[0]


def test_balls_at_rest_have_no_motion_to_be_noted() -> None:
    """Under 3 kN across the axis they have four contacts at rest, too."""
    seats = (
        BearingSeat("front", model("bearings", "qj218"), 0.05),
        BearingSeat("rear", model("bearings", "6012"), 0.35),
    )
    machine = mfw2310(seats=seats, sleeves=(), arrangement=None, shortening=None)
    given = conditions(axial_force=500.0, loads=(PointLoad(0.05, Fy=3e3),))
    for speeds, when in (([0.0], ""), ([0.0, 100.0], "contacts at 100 rpm,")):
        scene = Scene(machine, given, np.array(speeds) * RPM)
        front, column = scene.preload.seat_states()[0]
        assert (front.contacts[:, column].max(axis=1) == 4).all()
        said = [each for each in scene.notes if "more than two contacts" in each]
        assert len(said) == bool(when)
        assert all(when in each for each in said)
