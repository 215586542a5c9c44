"""Radial stiffness of the spindle against all DOF of the rotor and one bearing at a time."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import root

from bearings import AngularContactBallBearing
from bearings.materials import Material
from bearings.ring.iterate import Iterate
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness.solve import solve as stiffness_answer
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.stiffness.summary import summary as stiffness_summary
from rotordyn.analyses.stiffness.summary import warnings as stiffness_warnings
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.balance import Balance
from rotordyn.preload.network import Network
from tests.oracles.dense_rotor.assemble import bending_plane
from tests.oracles.full_rotor import FullRotor
from tests.oracles.spindles import RPM, TOP, answers, mfw2310, scene, with_sleeve, with_springs

SPEEDS = (0, 12000, 24000)


@cache
def stiffness(rotor: str = "flexible", *, axial: bool = True) -> Any:
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 5)}
    return answers(mfw2310(), SPEEDS, asked, rotor=rotor, axial_stiffening=axial)["stiffness"]


def curve(result: Any, variant: str) -> np.ndarray:
    return result.deflection[:, result.variant.index(variant)]


def tangent(result: Any, variant: str) -> np.ndarray:
    return result.tangent[:, result.variant.index(variant)]


def test_tangent_at_no_load_is_the_full_matrix() -> None:
    """By symmetry the axial network does not move to first order."""
    for rotor in ("flexible", "rigid"):
        full = tangent(stiffness(rotor), "full")
        assert tangent(stiffness(rotor), "nonlinear") == pytest.approx(full, rel=1e-6)


def test_full_matrix_against_all_dof() -> None:
    found = scene(mfw2310(), SPEEDS)
    for row in range(3):
        for variant, mask in (("full", 1.0), ("diagonal", np.eye(5))):
            blocks, force = found.seat_stiffness[row] * mask, found.bending_force()[row]
            whole = FullRotor(found.spindle, found.mesh, blocks, 0.0, axial_force=force)
            tip = whole.row(-0.0524, "y")
            expected = 1.0 / np.linalg.inv(whole.stiffness)[tip, tip]
            assert tangent(stiffness(), variant)[row] == pytest.approx(expected, rel=1e-7)


def test_linear_variants_are_straight_lines() -> None:
    for variant in ("full", "diagonal", "constant_preload"):
        line = stiffness().force / tangent(stiffness(), variant)[:, None]
        assert curve(stiffness(), variant) == pytest.approx(line, rel=1e-9)
        column = stiffness().variant.index(variant)
        assert stiffness().secant[:, column] == pytest.approx(tangent(stiffness(), variant))


def test_secant_is_full_load_over_deflection() -> None:
    last = curve(stiffness(), "nonlinear")[:, -1]
    assert stiffness().secant[:, 0] == pytest.approx(500.0 / last)


@pytest.mark.few(1)
@pytest.mark.parametrize(("rpm", "rigid"), [(24000, False), (12000, True)])
def test_curve_against_an_independent_equilibrium(rpm: int, rigid: bool) -> None:
    """Bodies found by MINPACK; bearings solved one at a time; the rotor by its flexibility.

    Unknowns: forces and moments of the bearings on the shaft follow from (x, y, θz) at the seats;
    the elastic shaft answers with the flexibility of its free-free stiffness about the motion of
    bearing a, all DOF kept. Loads are in the spindle's frame; the axial force in the shaft
    does not act on its bending.
    """
    spindle = mfw2310()
    expected = [_equilibrium(spindle, rpm * RPM, force, rigid) for force in (200.0, 500.0)]
    result = stiffness("rigid" if rigid else "flexible", axial=False)
    ours = curve(result, "nonlinear")[SPEEDS.index(rpm)]
    at = [int(np.abs(result.force - f).argmin()) for f in (200.0, 500.0)]
    assert ours[at] == pytest.approx(expected, rel=2e-6)


def _equilibrium(spindle: Any, speed: float, force: float, rigid: bool) -> float:
    mesh = build_mesh(spindle, None)
    nodes = [mesh.node_of(s.x) for s in spindle.seats]
    tip = mesh.node_of(-0.0524)
    reach = mesh.x
    plane = bending_plane(spindle, mesh).stiffness
    flexibility = np.zeros_like(plane)
    if not rigid:
        inner = np.arange(2, len(plane))  # first node held: the rest is the elastic shaft
        flexibility[np.ix_(inner, inner)] = np.linalg.inv(plane[np.ix_(inner, inner)])
    growth = 43.2e-6 + 7.3e-6 * (speed / TOP) ** 2
    shift = np.array([0, 0, -0.305e-6, -42.8e-6, -42.8e-6]) * (speed / TOP) ** 2
    rest = [
        float(s.bearing.equilibrium(load=[p, 0, 0, 0, 0], static_growth=43.2e-6).displacement[0])
        for s, p in zip(spindle.seats, (551, 551, 574, 264, 264), strict=True)
    ]
    sleeve = np.array([-1, -1, 0, 1, 1])
    push, spring = np.array([574.0, 528.0]), np.array([6.20e6, 5.49e6])

    def load(k: int, place: np.ndarray) -> np.ndarray:
        seat = spindle.seats[k]
        sign = np.array([seat.thrust, 1.0, seat.thrust])
        d = np.zeros(5)
        d[[0, 1, 4]] = place * sign
        d[0] += rest[k]
        state = seat.bearing.equilibrium(
            displacement=d, speed=speed, static_growth=43.2e-6, growth=growth, kinematics="outer"
        )
        return state.load[[0, 1, 4]] * sign

    def answer(unknown: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
        """(forces on bodies, shaft placement errors, deflection of the tip)."""
        x, ups = unknown[0] * 1e-6, unknown[1:3] * 1e-6
        rigid_motion = unknown[3:5] * np.array([1e-6, 1e-5])
        seats = unknown[5:].reshape(5, 2) * np.array([1e-6, 1e-5])
        loads = np.array([
            load(k, np.array([x + shift[k] - (ups[s] if s >= 0 else 0.0), *seats[k]]))
            for k, s in enumerate(sleeve)
        ])  # fmt: skip
        acting = np.zeros(len(plane))
        acting[2 * tip] += force
        for node, (_, fy, mz) in zip(nodes, loads, strict=True):
            acting[2 * node] -= fy
            acting[2 * node + 1] -= mz
        motion = flexibility @ acting
        motion[0::2] += rigid_motion[0] + rigid_motion[1] * (reach - reach[0])
        motion[1::2] += rigid_motion[1]
        balance = [
            -loads[:, 0].sum(),
            push[0] - spring[0] * ups[0] + loads[2, 0],
            push[1] - spring[1] * ups[1] + loads[3:, 0].sum(),
            acting[0::2].sum(),
            (acting[1::2] + acting[0::2] * (reach - 0.2)).sum() * 10.0,
        ]
        if held:
            balance[1] = (ups[0] + 52.2e-6) * 1e8
        wrong = (seats - motion.reshape(-1, 2)[nodes]) / np.array([1e-6, 1e-5])
        return np.array(balance) / 100.0, wrong.ravel(), float(motion[2 * tip])

    held = False
    start = np.zeros(15)
    for _ in range(2):
        found = root(lambda u: np.concatenate(answer(u)[:2]), start, tol=1e-12)
        assert np.abs(found.fun).max() < 1e-7, found.message
        if held or found.x[1] >= -52.2:
            break
        held, start = True, found.x
    return answer(found.x)[2]


def test_turning_the_force_by_180_degrees_turns_the_deflection() -> None:
    """With the shaft turned end for end the curve stays; the sign of y cannot matter."""
    ours = mfw2310()
    rule = ours.shortening
    other = replace(
        ours,
        shaft=Shaft(-ours.shaft.end, ours.shaft.sections[::-1]),
        seats=tuple(replace(s, x=-s.x, thrust=-s.thrust) for s in ours.seats),
        masses=tuple(replace(m, x=-m.x) for m in ours.masses),
        shortening=replace(rule, shift={n: -v for n, v in rule.shift.items()}),
        points={n: -x for n, x in ours.points.items()},
    )
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 5)}
    found = answers(other, SPEEDS, asked)["stiffness"]
    assert found.deflection == pytest.approx(stiffness().deflection, rel=1e-7, abs=1e-15)
    assert found.tangent == pytest.approx(stiffness().tangent, rel=1e-7)


def test_number_of_steps_does_not_matter() -> None:
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("nonlinear",))}
    found = answers(mfw2310(), SPEEDS, asked)["stiffness"].deflection[:, 0, -1]
    assert found == pytest.approx(curve(stiffness(), "nonlinear")[:, -1], rel=1e-8)


def test_slope_of_the_curve_is_the_tangent() -> None:
    asked = {"stiffness": StiffnessSpec("Oc2", 1.0, 1, ("nonlinear",))}
    found = answers(mfw2310(), SPEEDS, asked)["stiffness"]
    assert found.secant[:, 0] == pytest.approx(found.tangent[:, 0], rel=1e-5)


@pytest.mark.long
def test_pressures_met_on_the_way_to_a_state_are_not_its_own() -> None:
    """A light spindle under six times its preload, in two steps and in ten."""
    steel = Material("steel", 206e9, 0.3, 7800.0)
    bar = Shaft(0.0, (Section(0.4, 0.045, 0.015, steel),), "cowper")
    small, large = (
        AngularContactBallBearing(
            ball_diameter=0.00635, pitch_diameter=pitch, balls=balls,
            contact_angle=math.radians(angle), inner_conformity=0.54, outer_conformity=0.53,
        )
        for pitch, balls, angle in ((0.05, 19, 15.0), (0.07, 27, 20.0))
    )  # fmt: skip
    light = Spindle(
        "light",
        bar,
        seats=(BearingSeat("a", small, 0.03, -1), BearingSeat("b", large, 0.08, 1)),
        sleeves=(Sleeve("s", ("b",), Spring(50.0, 1e6)),),
        points={"tip": 0.0},
    )
    few, many = (
        answers(light, (0, 1000), {"stiffness": spec})["stiffness"]
        for spec in (StiffnessSpec("tip", 314.0, n, variants=("nonlinear",)) for n in (2, 10))
    )
    assert few.outcome == many.outcome == ("", "")
    np.testing.assert_allclose(few.deflection[:, 0, 1:], many.deflection[:, 0, 5::5], rtol=1e-7)


@pytest.mark.few(1)
@pytest.mark.parametrize("kinematics", ["hybrid", "inner"])
def test_many_steps_of_a_vanishing_force_are_a_straight_line(kinematics: str) -> None:
    """A thousandth of a newton in a hundred steps, beside preloads of hundreds."""
    asked = {"stiffness": StiffnessSpec("Oc2", 1e-3, 100, variants=("nonlinear",))}
    found = answers(mfw2310(), SPEEDS, asked, kinematics=kinematics)["stiffness"]
    straight = found.force[1:] / found.tangent[:, :1]
    np.testing.assert_allclose(found.deflection[:, 0, 1:], straight, rtol=2e-5)


def test_deflection_is_odd_in_the_load() -> None:
    """The axial network moves with the square of the load: no quadratic term in the deflection."""
    asked = {"stiffness": StiffnessSpec("Oc2", 40.0, 4, ("nonlinear",))}
    result = answers(mfw2310(), (0, 12000), asked)["stiffness"]
    excess = result.deflection[:, 0] - result.force / result.tangent[:, :1]
    assert excess[:, 4] / excess[:, 2] == pytest.approx(8.0, rel=0.05)


def test_bearings_as_at_rest_serve_every_speed() -> None:
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 5)}
    found = answers(mfw2310(), SPEEDS, asked, bearings="static")["stiffness"]
    for row in range(3):
        assert found.deflection[row] == pytest.approx(stiffness().deflection[0], rel=1e-9)


def test_second_stop_equals_a_spindle_that_has_it() -> None:
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 5, ("nonlinear",), {"front": 45e-6})}
    found = answers(mfw2310(), (0, 18000, 22000), asked)["stiffness"]
    short = with_sleeve(mfw2310(), "front", stop_travel=45e-6)
    plain = {"stiffness": StiffnessSpec("Oc2", 500.0, 5, ("nonlinear",))}
    expected = answers(short, (0, 18000, 22000), plain)["stiffness"]
    assert curve(found, "short_stop") == pytest.approx(curve(expected, "nonlinear"), rel=1e-8)
    assert tangent(found, "short_stop") == pytest.approx(tangent(expected, "nonlinear"), rel=1e-8)
    assert tangent(found, "short_stop")[2] > 1.005 * tangent(found, "nonlinear")[2]


def test_second_stop_alone_and_longer_than_the_first() -> None:
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 2, (), {"front": 80e-6})}
    found = answers(mfw2310(), (0, 24000), asked)["stiffness"]
    longer = with_sleeve(mfw2310(), "front", stop_travel=80e-6)
    plain = {"stiffness": StiffnessSpec("Oc2", 500.0, 2, ("nonlinear",))}
    expected = answers(longer, (0, 24000), plain)["stiffness"]
    assert found.variant == ("short_stop",)
    assert found.deflection == pytest.approx(expected.deflection, rel=1e-8)


def test_constant_preload_is_soft_springs_at_every_speed() -> None:
    """Springs of no stiffness hold each bearing's load at its value at rest."""
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("full", "constant_preload"))}
    found = answers(with_springs(mfw2310(), 1.0), (0, 18000), asked)["stiffness"]
    assert found.tangent[:, 1] == pytest.approx(found.tangent[:, 0], rel=1e-5)


def test_sprung_sleeve_softens_and_stiff_sleeve_does_not() -> None:
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("full", "nonlinear"))}
    limit = answers(mfw2310(), (0,), asked)["stiffness"].tangent
    found = [
        answers(with_sleeve(mfw2310(), "front", radial_stiffness=k), (0,), asked)[
            "stiffness"
        ].tangent
        for k in (1e8, 1e12)
    ]
    assert (found[0] < 0.9997 * limit).all()
    assert found[1] == pytest.approx(limit, rel=1e-3)
    assert found[0][:, 0] == pytest.approx(found[0][:, 1], rel=1e-6)


def test_external_force_acts_on_the_stiffness_too() -> None:
    asked = {"preload": PreloadSpec(), "stiffness": StiffnessSpec("Oc2", 500.0, 1)}
    plain, pushed = (answers(mfw2310(), (0, 6000), asked, axial_force=f) for f in (0.0, 400.0))
    ratio = pushed["stiffness"].tangent / plain["stiffness"].tangent
    assert np.abs(ratio - 1.0).min() > 1e-3
    still = pushed["stiffness"].tangent[0]
    assert still[3] == pytest.approx(still[1], rel=1e-8), "at rest the preload is what it is"
    assert math.isfinite(pushed["preload"].axial_load.sum())


def test_balls_moved_with_the_shaft_or_solved_at_every_move(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The same curves where no ball is ever taken to follow: bearings solved one by one."""
    asked = {"stiffness": StiffnessSpec("Oc2", 500.0, 5, ("nonlinear",), {"front": 45e-6})}
    rpm = (0, 12000, 18000, 22000)
    together = answers(mfw2310(), rpm, asked)["stiffness"]
    monkeypatch.setattr(Iterate, "follows", lambda one, _: np.zeros(one.error.shape, dtype=bool))
    alone = answers(mfw2310(), rpm, asked)["stiffness"]
    assert together.deflection == pytest.approx(alone.deflection, rel=1e-9)
    assert together.tangent == pytest.approx(alone.tangent, rel=1e-9)


def test_a_load_takes_two_moves_of_the_balls(monkeypatch: pytest.MonkeyPatch) -> None:
    """One where the curve is expected, one Newton step; bearings by themselves at no load alone."""
    found = scene(mfw2310(), np.arange(0, 20001, 2000))  # below the speed of the stop
    assert found.preload.usable.all()
    moves, solves = [], []
    move, solve = Balance._point, Network.solve_bearings
    monkeypatch.setattr(Balance, "_point", lambda *given: (moves.append(1), move(*given))[1])
    monkeypatch.setattr(
        Network, "solve_bearings", lambda *a, **k: (solves.append(1), solve(*a, **k))[1]
    )
    spec = StiffnessSpec("Oc2", 500.0, 10, ("nonlinear",))
    assert stiffness_answer(found, spec).outcome == ("",) * 11
    assert not solves  # balls stand as the preload has them
    assert len(moves) <= 1 + 10 * 2 + 2  # no load; ten loads; stops that close


def test_kinematics_of_two_branches_are_not_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    found = scene(mfw2310(), np.array([0.0, 12000.0]), kinematics="geometric")
    assert found.preload.usable.all()
    monkeypatch.setattr(Iterate, "moved", lambda *given: pytest.fail("a ball was moved"))
    answer = stiffness_answer(found, StiffnessSpec("Oc2", 500.0, 2, ("nonlinear",)))
    assert np.isfinite(answer.deflection).all()


@pytest.mark.parametrize("share", [0.999, 1.001])
def test_a_negative_stiffness_as_large_as_the_machines_pushes_the_shaft_away(share: float) -> None:
    """Where it acts, the machine is stable as long as it has more than that."""
    least = tangent(stiffness(), "full")[1]  # at 12 000 rpm; more at rest, less at 24 000 rpm
    field = {(way, way): -share * least for way in ("y", "z")}
    spindle = mfw2310(supports=(LinearSupport("field", -0.0524, field),))
    found = scene(spindle, SPEEDS)
    falls = [False, share > 1.0, True]
    assert found.statically_unstable.tolist() == falls
    (said,) = [each for each in found.warnings if "negative stiffness of support field" in each]
    assert f"at {sum(falls)} of 3 speeds" in said
    result = stiffness_answer(found, StiffnessSpec("Oc2", 10.0, 1))
    assert ["negative stiffness" in word for word in result.outcome] == falls
    assert np.isnan(result.tangent).all(axis=1).tolist() == falls
    left = tangent(result, "full")[0]
    assert left == pytest.approx(tangent(stiffness(), "full")[0] - share * least, rel=1e-6)


def test_curves_bend_where_a_stop_is_met() -> None:
    """Between two speeds of the case: the least stiffness of the machine is there."""
    variants = ("nonlinear", "full", "constant_preload")
    spec = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, variants), "preload": PreloadSpec()}
    found = answers(mfw2310(), (0, 18000, 21000, 24000), spec)
    result, closing = found["stiffness"], found["preload"].stop_speed[0]
    assert closing / RPM == pytest.approx(20000, rel=0.03)
    assert result.stop_speed == pytest.approx([closing, closing], rel=1e-5)
    there = answers(mfw2310(), (closing / RPM,), {"stiffness": spec["stiffness"]})["stiffness"]
    assert result.stop_tangent[0] == pytest.approx(there.tangent[0], rel=1e-4)
    speed, tangent = result.curves
    assert (np.diff(speed) > 0.0).all()
    assert tangent[[0, 1, 4, 5]] == pytest.approx(result.tangent)
    assert tangent[2:4, 0].max() < 0.985 * result.tangent[:, 0].min()
    (line,) = stiffness_summary(result)
    least = f"{tangent[:, 1].min() / 1e6:.1f} at {closing / RPM:.0f} rpm"
    assert f"full {tangent[0, 1] / 1e6:.1f} → {tangent[-1, 1] / 1e6:.1f} (least {least})" in (
        line.replace("\N{NO-BREAK SPACE}", " ")
    )


def test_a_second_stop_is_drawn_straight_where_the_first_is_met() -> None:
    spec = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("full",), {"front": 45e-6})}
    found = scene(mfw2310(), (0, 18000, 24000))
    result = stiffness_answer(found, spec["stiffness"].unloaded)
    assert np.isnan(result.stop_tangent[:, 1]).all()
    speed, tangent = result.curves
    line = np.interp(speed, result.speed, result.tangent[:, 1])
    assert tangent[:, 1] == pytest.approx(line)


def test_a_sleeve_at_its_stop_from_rest_on_closes_none() -> None:
    spec = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("full",))}
    resting = with_sleeve(mfw2310(), "front", stop_travel=0.0)
    assert answers(resting, (0, 6000), spec)["stiffness"].stop_speed.size == 0


def test_a_machine_that_is_unstable_where_a_stop_closes_is_warned_of() -> None:
    """Its curve breaks there: no straight line leads across."""
    spec = {"stiffness": StiffnessSpec("Oc2", 500.0, 1, ("full",))}
    ways = {("y", "y"): -168e6, ("z", "z"): -168e6}
    machine = replace(mfw2310(), supports=(LinearSupport("pull", 0.0, ways),))
    result = answers(machine, (0, 18000, 24000), spec)["stiffness"]
    assert (result.tangent > 0.0).all()
    assert np.isnan(result.curves[1][2:4]).all()
    (said,) = stiffness_warnings(result)
    assert said.startswith("stiffness: full has no stable state at 20402 rpm, where a stop closes")
