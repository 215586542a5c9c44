"""Bearings of a spindle under static loads in any direction: against states without load, slopes of
the nonlinear curve, an independent dense rotor, contacts enumerated one by one, published roses."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar, root

from bearings import AngularContactBallBearing, DeepGrooveBallBearing, Material
from bearings.materials import STEEL
from bearings.ring.tangents import stiffness as tangent_of
from rotordyn.allowance import within
from rotordyn.analyses import (
    BearingLoadsSpec,
    FrfSpec,
    PointLoad,
    PreloadSpec,
    SectionForcesSpec,
    StiffnessSpec,
)
from rotordyn.analyses.bearing_loads.solve import solve
from rotordyn.analyses.bearing_loads.summary import numbers, summary, warnings
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.preload.solve import solve as preload_answer
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.stiffness.solve import solve as stiffness_answer
from rotordyn.equation.dofs import position
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.seat import turn
from rotordyn.errors import TooCostly
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.seat import BearingSeat, Misalignment
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.under_load import under_load
from rotordyn.scene.agreement import setting_faults
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.scene.spec import Setting
from rotordyn.units import STANDARD_GRAVITY
from tests.oracles.dense_rotor.assemble import rotor_matrices
from tests.oracles.spindles import RPM, case, conditions, mfw2310, scene

Array = NDArray[np.float64]
RESIDUAL = 1e-9  # of the largest force, to which a state is balanced
CERAMIC = Material("Si3N4", 315e9, 0.26, 3190.0)
RINGS = Material("rings", 206e9, 0.3, 7850.0)
VEX70 = AngularContactBallBearing(
    9.525e-3,
    90e-3,
    25,
    contact_angle=math.radians(25.0),
    inner_conformity=0.56,
    outer_conformity=0.571,
    ball_material=CERAMIC,
    ring_material=RINGS,
)
CONTACT = {"static_growth": 43.2e-6, "kinematics": "outer"}


def loaded(rpm: list[float], *loads: PointLoad, **changes: Any) -> Scene:
    return scene(mfw2310(), rpm, loads=loads, **changes)


# --- against states without load ---------------------------------------------------------------


def test_no_load_is_the_state_without_loads_and_costs_nothing() -> None:
    plain, zero = scene(mfw2310(), [0.0, 24000.0]), loaded([0.0, 24000.0], PointLoad(at="Oc2"))
    assert zero.preload is zero.unloaded
    assert zero.preload.lateral is None
    assert (zero.tangents == plain.tangents).all()


def test_a_load_that_vanishes_leaves_the_state_without_loads() -> None:
    plain = scene(mfw2310(), [0.0, 12000.0, 24000.0])
    faint = loaded([0.0, 12000.0, 24000.0], PointLoad(at="Oc2", Fy=1e-9, Fz=1e-9))
    assert faint.preload.lateral is not None
    assert faint.preload.outcome == plain.preload.outcome
    largest = np.abs(plain.tangents).max(axis=(-2, -1), keepdims=True)
    assert np.abs((faint.tangents - plain.tangents) / largest).max() < 1e-10
    assert faint.preload.seat_load() == pytest.approx(plain.preload.seat_load(), rel=1e-10)


def test_loads_across_the_axis_leave_the_mounted_ones() -> None:
    """Bearings in tandem are one without loads across the axis, and each alone under them."""
    plain, pulled = scene(mfw2310(), [0.0]), loaded([0.0], PointLoad(at="Oc2", Fy=500.0))
    assert (pulled.preload.mounted_load() == plain.preload.mounted_load()).all()
    table = preload_answer(pulled, PreloadSpec())
    assert table.mounted_load == pytest.approx([551.0, 551.0, 574.0, 264.0, 264.0], rel=1e-9)


def test_an_axial_load_is_the_axial_force() -> None:
    pushed = loaded([0.0, 24000.0], PointLoad(at="nose_face", Fx=200.0))
    same = scene(mfw2310(), [0.0, 24000.0], axial_force=200.0)
    assert (pushed.preload.seat_load() == same.preload.seat_load()).all()
    other = loaded([0.0], PointLoad(at="O3", Fx=200.0))
    x = np.array([0.0, 0.3])
    carried = same.shaft_force.at(x)[0] - other.shaft_force.at(x)[0]
    assert carried == pytest.approx([-200.0, -200.0])


# --- slopes, symmetry, equilibrium --------------------------------------------------------------


@pytest.mark.parametrize("rpm", [0.0, 16000.0])
def test_stiffness_about_the_state_is_the_slope_of_the_nonlinear_curve(rpm: float) -> None:
    """Tangent at the state of the loads, against displacements under ± 0.02 N more. The equation of
    motion at frequency 0 has a shaft that is elastic along its axis, which the state has not."""
    force, step = np.array([300.0, 500.0, 200.0]), 0.02
    port = (-0.0524,)

    def solved(push: Array) -> Scene:
        acting = PointLoad(at="Oc2", Fx=push[0], Fy=push[1], Fz=push[2])
        found = scene(mfw2310(), [rpm], ports=port, loads=(acting,))
        assert found.preload.outcome == ("",)
        return found

    here = solved(force)
    spec = StiffnessSpec(point="Oc2", max_force=1.0, steps=1, variants=("nonlinear",))
    tangent = float(stiffness_answer(here, spec).tangent[0, 0])
    slope = np.empty((2, 2))
    for column, way in enumerate((1, 2)):
        unit = np.zeros(3)
        unit[way] = step
        ends = [_deflection(solved(force + sign * unit)) for sign in (1.0, -1.0)]
        slope[:, column] = (ends[0] - ends[1]) / (2.0 * step)
    assert slope[0, 0] == pytest.approx(1.0 / tangent, rel=1e-6)
    (k,) = here.with_motions(("bending",))
    own = here.linear(k)
    rows = np.stack([own.row("spindle", -0.0524, way) for way in ("y", "z")])
    compliance = rows @ np.linalg.solve(own.stiffness[0], rows.T)
    assert slope == pytest.approx(compliance, rel=1e-3, abs=1e-7 * np.abs(slope).max())
    assert np.diag(slope) == pytest.approx(np.diag(compliance), rel=2e-5)
    assert np.abs(compliance[0, 1]) > 1e-3 * compliance[0, 0], "the state couples both directions"


def _deflection(found: Scene) -> Array:
    """At Oc2, by the coordinates of the rotor in its balance."""
    from rotordyn.equation.statics import Across, loaded_rotor

    place = found.spindle.place("Oc2")
    ends = []
    for way in ("y", "z"):
        unit = np.zeros(6)
        unit[position(way)] = 1.0
        across = Across(((place, unit),), (0.0, 0.0))
        ends.append(loaded_rotor(found.rotor, found.speed, across).point)
    lateral = found.preload.lateral
    assert lateral is not None
    return np.asarray(np.stack(ends) @ lateral[0])


@pytest.mark.parametrize("rpm", [0.0, 24000.0])
def test_bearings_carry_the_loads(rpm: float) -> None:
    """Sum of forces and of moments about the nose, weight included."""
    loads = (
        PointLoad(at="Oc2", Fx=100.0, Fy=-300.0, Fz=250.0, y=0.01, z=-0.02),
        PointLoad(at="O3", Fy=150.0, My=3.0, Mz=-5.0),
    )
    found = loaded([rpm], *loads, gravity="-z", axial_stiffening=False)
    result = solve(found, BearingLoadsSpec(loss_steps=0))
    x = np.array([seat.x for seat in found.spindle.seats])
    moved = found.preload
    load = np.stack(
        [
            state.load[0, column] * (np.array([-1, 1, -1, 1, -1]) if seat.thrust < 0 else 1.0)
            for seat, (state, column) in zip(found.spindle.seats, moved.seat_states(), strict=True)
        ]
    )
    rotor = rotor_inertia(found.spindle)
    weight = rotor.mass * STANDARD_GRAVITY
    places = [found.spindle.place(each.at).x for each in loads]
    acting = np.array([each.on_axis for each in loads])
    assert load[:, 1].sum() == pytest.approx(acting[:, 1].sum(), rel=1e-7)
    assert load[:, 2].sum() == pytest.approx(acting[:, 2].sum() - weight, rel=1e-6)
    about_z = load[:, 4].sum() + x @ load[:, 1]
    about_y = load[:, 3].sum() - x @ load[:, 2]
    # bearings hold the centres of their circles, weight its centre of gravity
    assert about_z == pytest.approx(acting[:, 5].sum() + places @ acting[:, 1], rel=1e-5)
    known = acting[:, 4].sum() - places @ acting[:, 2] + rotor.centre * weight
    assert about_y == pytest.approx(known, rel=1e-5)
    assert result.radial_load[0] == pytest.approx(np.hypot(load[:, 1], load[:, 2]))


def test_a_turned_load_turns_the_state() -> None:
    """By the angle between two balls of every bearing that a quarter turn exchanges: none of a
    smooth ring at high preload, to the ripple of 21 and 25 balls."""
    y = loaded([16000.0], PointLoad(at="Oc2", Fy=200.0))
    z = loaded([16000.0], PointLoad(at="Oc2", Fz=200.0))
    a, b = (solve(each, BearingLoadsSpec()) for each in (y, z))
    assert b.radial_load == pytest.approx(a.radial_load, rel=1e-4)
    turned = np.mod(b.load_angle - a.load_angle, 2.0 * math.pi)
    assert turned == pytest.approx(np.full((1, 5), math.pi / 2), abs=1e-3)


@pytest.mark.parametrize("rpm", [0.0, 24000.0])
def test_a_force_across_moves_a_loaded_shaft_along_its_axis(rpm: float) -> None:
    """The receptance between both ways, slowly, is the slope of the axial shift of a bearing; of a
    machine without loads there is none to ask for."""
    spindle = mfw2310()
    spindle = replace(spindle, points={**spindle.points, "a": spindle.seats[0].x})
    pair = (Port("a", "x"), Port("Oc2", "y"))
    spec = FrfSpec((0.1,), (pair,))
    base, step = PointLoad(at="Oc2", Fy=400.0), 1.0
    given = conditions(loads=(base,))
    faults = list(spec.faults_on(Setting(spindle, conditions(), (0.0, 24000.0 * RPM))))
    assert "axial motion and bending are not coupled" in faults[0][1]
    assert not list(spec.faults_on(Setting(spindle, given, (0.0, 24000.0 * RPM))))
    slow = solve_spindle(spindle, given, (rpm * RPM,), {"frf": spec}, lambda name: None)
    shift = [
        solve(scene(spindle, [rpm], loads=(base, more)), BearingLoadsSpec()).deflection[0, 0]
        for more in (PointLoad(at="Oc2", Fy=way * step) for way in (-1.0, 1.0))
    ]
    slope = (shift[1] - shift[0]) / (2.0 * step)
    assert slow.results["frf"].receptance[0, 0, 0].real == pytest.approx(slope, rel=0.01)


def test_radial_curve_goes_on_from_the_loads_of_the_case() -> None:
    """300 N as a load of the case and 200 N more is the curve of 500 N."""
    whole = scene(mfw2310(), [0.0, 16000.0], ports=(-0.0524,))
    spec = StiffnessSpec(point="Oc2", max_force=500.0, steps=5, variants=("nonlinear",))
    known = stiffness_answer(whole, spec).deflection[:, 0]
    part = loaded([0.0, 16000.0], PointLoad(at="Oc2", Fy=300.0), ports=(-0.0524,))
    more = replace(spec, max_force=200.0, steps=2)
    found = stiffness_answer(part, more).deflection[:, 0]
    assert found == pytest.approx(known[:, 3:] - known[:, 3:4], rel=1e-5, abs=1e-12)


# --- a rotor of two bearings against an independent dense solution ----------------------------

PRELOAD, DX = 400.0, 0.04
TWO = AngularContactBallBearing(
    8e-3, 60e-3, 18, contact_angle=math.radians(25.0), inner_conformity=0.53, outer_conformity=0.53
)


def two_bearings() -> Spindle:
    seats = (
        BearingSeat("front", TWO, 0.08, thrust=1),
        BearingSeat("rear", TWO, 0.28, thrust=-1),
    )
    sleeve = Sleeve("rear", ("rear",), Spring(PRELOAD, math.inf))
    shaft = Shaft(0.0, (Section(0.32, 0.045, 0.015, STEEL),))
    return Spindle("two", shaft, seats=seats, sleeves=(sleeve,), points={"tool": 0.0, "tail": 0.32})


@pytest.mark.parametrize("rpm", [0.0, 15000.0])
def test_loaded_campbell_of_two_bearings(rpm: float) -> None:
    """Balance and modes by dense matrices of standard elements, every bearing solved alone."""
    spindle = two_bearings()
    loads = (PointLoad(at="tool", Fy=250.0, Fz=-400.0), PointLoad(at="tail", Fy=300.0))
    modelled = Conditions(
        element_length=DX, kinematics="outer", loads=loads, axial_stiffening=False
    )
    found = Scene(spindle, modelled, np.array([rpm * RPM]), max_frequency=4e5)
    assert found.preload.outcome == ("",)
    mesh = build_mesh(spindle, DX)
    free = rotor_matrices(spindle, mesh)
    state, tangents = _balance(spindle, mesh, free.stiffness, loads, rpm * RPM)
    own = np.stack([s.load[0, c] for s, c in found.preload.seat_states()])
    assert own == pytest.approx(state, rel=1e-7, abs=1e-6)
    k = free.stiffness.copy()
    for seat, tangent in zip(spindle.seats, tangents, strict=True):
        at = slice(6 * mesh.node_of(seat.x), 6 * mesh.node_of(seat.x) + 6)
        k[at, at] += turn(tangent, seat.thrust)
    size = len(k)
    inverse = np.linalg.inv(free.mass)
    whole = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-inverse @ k, -inverse @ (rpm * RPM * free.gyroscopic)],
        ]
    )
    known = np.sort(np.abs(np.linalg.eigvals(whole).imag))
    known = known[known > 10.0][::2][:8]
    (system,) = (found.system(n) for n in found.with_motions(("bending",)))
    poles = np.sort(np.abs(system.pole[0].imag))
    torsion = [f for n in found.with_motions(("torsion",)) for f in found.system(n).pole[0].imag]
    poles = np.sort([*poles, *np.abs(torsion)])
    poles = poles[poles > 10.0][:8]
    assert poles == pytest.approx(known, rel=1e-8)


def _balance(
    spindle: Spindle, mesh: Any, stiffness: Array, loads: tuple[PointLoad, ...], speed: float
) -> tuple[Array, list[Array]]:
    """Loads (2, 5) and tangents of both bearings: the shaft bends, and moves along x as one."""
    lateral = [
        6 * node + position(way) for node in range(mesh.nodes) for way in ("y", "z", "thy", "thz")
    ]
    k = stiffness[np.ix_(lateral, lateral)]
    f = np.zeros(6 * mesh.nodes)
    for load in loads:
        at = 6 * mesh.node_of(spindle.place(load.at).x)
        f[at : at + 6] += load.on_axis
    push = f[lateral]
    rest = TWO.equilibrium(load=[PRELOAD, 0, 0, 0, 0]).displacement[0]
    turned = np.array([-1.0, 1.0, -1.0, 1.0, -1.0])

    def rings(u: Array) -> list[Any]:
        found = []
        for seat in spindle.seats:
            node = mesh.node_of(seat.x)
            d = np.array([u[-1], *u[4 * node : 4 * node + 4]])
            d = d * (turned if seat.thrust < 0 else 1.0)
            d[0] += rest
            found.append(TWO.equilibrium(displacement=d, speed=speed, kinematics="outer"))
        return found

    def missing(u: Array) -> Array:
        left = np.append(push - k @ u[:-1], 0.0)
        for seat, ring in zip(spindle.seats, rings(u), strict=True):
            load = ring.load * (turned if seat.thrust < 0 else 1.0)
            node = mesh.node_of(seat.x)
            left[4 * node : 4 * node + 4] -= load[1:]
            left[-1] -= load[0]
        return left

    def slope(u: Array) -> Array:
        whole = np.zeros((len(u), len(u)))
        whole[:-1, :-1] = -k
        for seat, ring in zip(spindle.seats, rings(u), strict=True):
            sign = turned if seat.thrust < 0 else np.ones(5)
            own = sign[:, None] * tangent_of(ring) * sign
            node = mesh.node_of(seat.x)
            at = [len(u) - 1, *range(4 * node, 4 * node + 4)]
            whole[np.ix_(at, at)] -= own
        return whole

    solved = root(
        missing, np.zeros(len(lateral) + 1), jac=slope, tol=1e-14, options={"xtol": 1e-14}
    )
    assert np.abs(missing(solved.x)).max() < 1e-6
    return np.stack([r.load for r in rings(solved.x)]), [tangent_of(r) for r in rings(solved.x)]


# --- bearings without thrust: contacts enumerated one by one --------------------------------------

DEEP = DeepGrooveBallBearing(10e-3, 60e-3, 8, radial_clearance=10e-6)
ROOMY = DeepGrooveBallBearing(8e-3, 50e-3, 9, radial_clearance=30e-6)


def deep_pair(misalignment: Misalignment | None = None) -> Spindle:
    """A short stiff shaft in two deep-groove bearings, loaded in their middle."""
    seats = tuple(
        BearingSeat(name, DEEP, x, misalignment=misalignment or Misalignment())
        for name, x in (("front", 0.02), ("rear", 0.08))
    )
    shaft = Shaft(0.0, (Section(0.1, 0.05, 0.0, STEEL),))
    return Spindle("deep", shaft, seats=seats, points={"middle": 0.05})


def _enumerated(load: float) -> float:
    """Displacement along a ball, [m]: least energy of all eight balls, pressed or not."""
    inner, outer = (c.stiffness for c in (DEEP.grooves and _race(DEEP, True), _race(DEEP, False)))
    k = (inner ** (-2 / 3) + outer ** (-2 / 3)) ** (-1.5)
    angle = 2.0 * np.pi * np.arange(8) / 8

    def energy(d: float) -> float:
        pressed = np.maximum(d * np.cos(angle) - 5e-6, 0.0)
        return float(0.4 * k * (pressed**2.5).sum() - load * d)

    return float(
        minimize_scalar(energy, bounds=(0.0, 2e-4), method="bounded", options={"xatol": 1e-14}).x
    )


def _race(bearing: DeepGrooveBallBearing, inner: bool) -> Any:
    from bearings.geometry import geometry

    found = geometry(bearing.grooves)
    return found.inner if inner else found.outer


@pytest.mark.parametrize("load", [0.01, 0.3, 4.0, 50.0, 400.0, 3000.0])
def test_deep_groove_bearings_without_thrust(load: float) -> None:
    """A rigid shaft pushed along y, where a ball of either bearing is: half of it on each."""
    acting = (PointLoad(at="middle", Fy=2.0 * load),)
    found = Scene(deep_pair(), Conditions(rotor="rigid", loads=acting), np.zeros(1))
    assert found.preload.outcome == ("",)
    result = solve(found, BearingLoadsSpec())
    assert result.radial_load[0] == pytest.approx([load, load], rel=1e-6)
    assert result.radial_displacement[0] == pytest.approx([_enumerated(load)] * 2, rel=1e-5)
    assert np.isnan(result.loss_share).all(), "they are not pressed all round without loads"


@pytest.mark.few(3)
@pytest.mark.parametrize("number", range(8))
def test_shafts_lie_in_bearings_within_their_play(number: int) -> None:
    """Random shafts of 1 to 190 kg in two or three such bearings, under their weight and a force of
    0.3 to 500 N: there is a balance, of all forces and of the moments about both axes."""
    chance = np.random.default_rng(number)
    length, share = chance.uniform(0.15, 1.0), 10.0 ** chance.uniform(-3.0, 3.0)
    diameter = length * 10.0 ** chance.uniform(-1.7, -0.7)
    count = int(chance.choice([2, 3]))
    x = length * (np.arange(count) + chance.uniform(0.1, 0.9, count)) / count
    kinds = [(DEEP, ROOMY)[k] for k in chance.integers(0, 2, count)]
    seats = tuple(
        BearingSeat(f"b{k}", kind, at) for k, (kind, at) in enumerate(zip(kinds, x, strict=True))
    )
    shaft = Shaft(0.0, (Section(length, diameter, 0.0, STEEL),))
    place, turn = length * chance.random(), chance.uniform(0.0, 2.0 * math.pi)
    spindle = Spindle("loose", shaft, seats=seats, points={"p": place})
    weight = rotor_inertia(spindle).mass * STANDARD_GRAVITY
    y, z = np.array([math.cos(turn), math.sin(turn)]) * min(share * weight, 500.0)
    acting = (PointLoad(at="p", Fy=y, Fz=z),)
    found = Scene(spindle, Conditions(loads=acting, gravity="-z"), np.array([0.0, 3000.0]) * RPM)
    state, size = found.preload, weight + math.hypot(y, z)
    assert state.outcome == ("", "")
    carried = np.stack([each.load[:, column] for each, column in state.seat_states()], axis=1)
    force, moment = carried[..., 1:3].sum(axis=1), carried[..., 3:].sum(axis=1)
    moment += np.stack([-carried[..., 2] @ x, carried[..., 1] @ x], axis=-1)
    assert force == pytest.approx(np.array([[y, z - weight]] * 2), abs=1e-6 * size)
    known = [-z * place + weight * length / 2.0, y * place]
    assert moment == pytest.approx(np.array([known] * 2), abs=1e-6 * size * length)


def test_superposition_fails_as_the_contacts_say() -> None:
    """Displacements by 400 N and by 800 N: less than twice, by what enumeration says."""
    ends = []
    for load in (400.0, 800.0):
        acting = (PointLoad(at="middle", Fy=2.0 * load),)
        found = Scene(deep_pair(), Conditions(rotor="rigid", loads=acting), np.zeros(1))
        ends.append(solve(found, BearingLoadsSpec()).radial_displacement[0, 0])
    known = _enumerated(800.0) / _enumerated(400.0)
    assert known < 1.7
    assert ends[1] / ends[0] == pytest.approx(known, rel=1e-5)


def test_a_bore_off_the_axis_takes_the_shaft_along() -> None:
    """Both bores off the axis by as much: loads as before, the shaft moved along."""
    moved = Misalignment(y=30e-6, z=-20e-6)
    acting = (PointLoad(at="middle", Fy=800.0),)
    plain, off = (
        Scene(each, Conditions(rotor="rigid", loads=acting), np.zeros(1))
        for each in (deep_pair(), deep_pair(moved))
    )
    a, b = (solve(each, BearingLoadsSpec(loss_steps=0)) for each in (plain, off))
    assert b.ball_inner_load == pytest.approx(a.ball_inner_load, rel=1e-6, abs=1e-6)
    assert off.preload.lateral is not None
    assert np.abs(off.preload.lateral - plain.preload.lateral).max() > 1e-6


def test_misaligned_bores_press_bearings_without_any_load() -> None:
    spindle = two_bearings()
    tilted = replace(spindle.seats[1], misalignment=Misalignment(y=20e-6, thz=1e-4))
    found = Scene(replace(spindle, seats=(spindle.seats[0], tilted)), Conditions(), np.zeros(1))
    result = solve(found, BearingLoadsSpec())
    assert result.outcome == ("",)
    radial = result.radial_load[0] * np.cos(result.load_angle[0])
    assert radial[0] == pytest.approx(-radial[1], rel=1e-6)
    assert abs(radial[0]) > 0.1


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_bore_off_the_axis_presses_its_bearing_back(way: float) -> None:
    """Its outer ring takes the shaft along, so that the shaft presses the inner ring back."""
    spindle = two_bearings()
    moved = replace(spindle.seats[1], misalignment=Misalignment(y=way * 20e-6))
    found = Scene(replace(spindle, seats=(spindle.seats[0], moved)), Conditions(), np.zeros(1))
    result = solve(found, BearingLoadsSpec())
    radial = result.radial_load[0] * np.cos(result.load_angle[0])
    assert way * radial[1] < -0.1


# --- published roses ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("thrust", "ratio", "rpm", "blocked", "free"),
    [
        (800.0, 0.62, 0.0, (136.0, 51.5), (230.0, 23.0)),
        (400.0, 1.25, 0.0, (92.7, 8.25), (222.0, 0.0)),
        (800.0, 0.62, 24000.0, (208.0, 121.0), (254.0, 133.0)),
    ],
)
def test_roses_of_the_thesis(
    thrust: float,
    ratio: float,
    rpm: float,
    blocked: tuple[float, float],
    free: tuple[float, float],
) -> None:
    """Noël 2013, Figs 4.19, 4.20, 4.22: largest and smallest ball load (of the outer race at
    speed), tilt blocked or free. The thrusts are assumed: the print gives ratios alone. The figures
    were read to three digits: 2 % of the value, and 0.2 N of the lightest ball."""
    growth = 50.5e-6 if rpm else 43.2e-6
    load = [thrust, ratio * thrust, 0.0, 0.0, 0.0]
    held = [np.nan, np.nan, np.nan, 0.0, 0.0]
    common = {"speed": rpm * RPM, "growth": growth, **CONTACT}
    states = (
        VEX70.equilibrium(load=[*load[:3], np.nan, np.nan], displacement=held, **common),
        VEX70.equilibrium(load=load, **common),
    )
    for state, known in zip(states, (blocked, free), strict=True):
        found = state.outer_load if rpm else state.inner_load
        assert found.max() == pytest.approx(known[0], rel=0.02)
        assert found.min() == pytest.approx(known[1], rel=0.02, abs=0.2)


@pytest.mark.parametrize("way", [1.0, -1.0], ids=["no ball opposite", "a ball opposite"])
def test_first_contact_loss_of_the_thesis(way: float) -> None:
    """Its Fig. 4.21: Fy/Fx = 1.62 at the thrust of its roses. It says that the ratio is the same
    at any preload: by the state it falls from 1.65 at 200 N to 1.62 at 800 N, as contact angles
    open."""
    held = [np.nan, np.nan, np.nan, 0.0, 0.0]
    first = []
    for thrust in (200.0, 800.0):
        ratio = np.linspace(1.55, 1.70, 151)
        load = np.array([[thrust, way * r * thrust, 0.0, np.nan, np.nan] for r in ratio])
        state = VEX70.equilibrium(load=load, displacement=np.tile(held, (151, 1)), **CONTACT)
        lightest = state.inner_load.min(axis=1)
        first += [ratio[np.flatnonzero(lightest == 0.0)[0]]]
    assert first[1] == pytest.approx(1.62, rel=0.01)
    assert first[0] == pytest.approx(1.652, abs=0.005)


# --- contact loss, words --------------------------------------------------------------------------


def test_contact_loss_is_named_and_is_where_the_ball_is_free() -> None:
    load = PointLoad(at="Oc2", Fy=2600.0)
    found = loaded([0.0, 12000.0], load)
    result = solve(found, BearingLoadsSpec())
    lost = np.isfinite(result.loss_share[0])
    assert lost.any()
    k = int(np.nanargmin(result.loss_share[0]))
    share = float(result.loss_share[0, k])
    for factor, free in ((0.999, False), (1.001, True)):
        near = solve(loaded([0.0], replace(load, Fy=2600.0 * share * factor)), BearingLoadsSpec())
        assert bool((near.ball_inner_load[0, k] == 0.0).any()) is free
    more = solve(loaded([0.0], replace(load, Fy=13000.0)), BearingLoadsSpec(loss_steps=3))
    assert 5.0 * more.loss_share[0, k] == pytest.approx(share, rel=2e-3), "whatever the steps"
    assert more.loss_azimuth[0, k] == result.loss_azimuth[0, k]
    words = list(warnings(result))
    assert any(w.startswith(f"bearing {result.bearing[k]}: its ball") for w in words)
    assert any("carry nothing" in w for w in found.warnings)
    assert len(summary(result)) == 5
    assert len(list(numbers(result, None))) > 0  # type: ignore[arg-type]


def test_a_speed_without_a_state_has_no_ball_load() -> None:
    """It was 0 there, and so the least of all speeds."""
    found = solve(loaded([0.0, 8000.0, 16000.0]), BearingLoadsSpec())
    lost = {
        name: np.where(np.arange(3).reshape(3, *[1] * (values.ndim - 1)) == 1, np.nan, values)
        for name in ("axial_load", "radial_load", "ball_inner_load")
        for values in (getattr(found, name),)
    }
    some = replace(found, **lost)
    assert not [line for line in summary(some) if "least" in line]
    known = {(each.part, each.speed): each.value for each in numbers(found, case())}
    for each in numbers(some, case()):
        assert each.value == pytest.approx(
            math.nan if each.inner else known[each.part, each.speed], nan_ok=True
        )


def test_a_radial_force_takes_the_ball_off_that_loads_do() -> None:
    """Two ways to the same place: rings and balls step by step, every load solved from nothing."""
    plain = scene(mfw2310(), [0.0, 12000.0])
    curve = stiffness_answer(plain, StiffnessSpec("Oc2", 2600.0, 3, variants=("nonlinear",)))
    load = loaded([0.0, 12000.0], PointLoad(at="Oc2", Fy=2600.0))
    rose = solve(load, BearingLoadsSpec())
    lost = np.isfinite(rose.loss_share)
    assert lost[0].sum() >= 2
    assert (np.isfinite(curve.unloading_force) == lost).all()
    for name, far in (("axial", rose.axial_load), ("radial", rose.radial_load)):
        own = np.array([s.thrust for s in mfw2310().seats]) if name == "axial" else 1.0
        assert getattr(curve, f"{name}_load")[:, -1] == pytest.approx(own * far, rel=1e-5, abs=0.01)
    assert curve.ball_load[:, -1] == pytest.approx(
        np.nanmax(rose.ball_inner_load, axis=2), rel=1e-5
    )
    assert curve.axial_load[:, 0] == pytest.approx(plain.preload.seat_load(), rel=1e-9)
    there = curve.unloading_force[lost]
    assert there == pytest.approx(2600.0 * rose.loss_share[lost], rel=5e-4)
    turn = curve.unloaded_azimuth[lost] - rose.loss_azimuth[lost]
    mirror = curve.unloaded_azimuth[lost] + rose.loss_azimuth[lost]
    assert np.fmin(1 - np.cos(turn), 1 - np.cos(mirror)) == pytest.approx(0.0, abs=1e-9)
    for k in np.flatnonzero(lost[0]):
        ball = int(curve.unloaded_ball[0, k]) - 1
        assert rose.ball_azimuth[k, ball] == pytest.approx(curve.unloaded_azimuth[0, k])


def test_contact_loss_is_sought_until_it_is_found() -> None:
    """In one step, ten times as far as the first ball bears."""
    pair = case("preload_concepts").variants["offset"]
    assert pair.spindle is not None
    still = Scene(pair.spindle, pair.conditions, np.zeros(1))
    one, many = (
        stiffness_answer(still, StiffnessSpec("nose", 8566.4, steps, variants=("nonlinear",)))
        for steps in (1, 23)
    )
    assert many.unloading_force[0, 0] == pytest.approx(795.5, abs=0.1)
    assert one.unloading_force == pytest.approx(many.unloading_force, rel=1e-4, nan_ok=True)
    assert (one.unloaded_ball == many.unloaded_ball)[0, 0]


def test_a_radial_curve_past_unloading_does_not_end_by_its_steps() -> None:
    """A pair pushed apart until one bearing is slack, moved by all the force at once or slowly."""
    variant = next(iter(case("preload_concepts").variants.values()))
    assert variant.spindle is not None
    found = Scene(variant.spindle, Conditions(axial_force=-2956.0), np.zeros(1))
    last = []
    for steps in (1, 2, 23):
        curve = stiffness_answer(
            found, StiffnessSpec("nose", 2000.0, steps, variants=("nonlinear",))
        )
        assert curve.outcome == ("",)
        last.append(curve.deflection[0, 0, -1])
    assert last[:2] == pytest.approx([last[2]] * 2, rel=1e-6)


def test_the_search_for_a_balance_ends_with_the_time_of_the_run() -> None:
    first = Scene(deep_pair(), Conditions(gravity="-z"), np.zeros(1))
    rotor = first.static_rotor  # all that comes before the search
    with within(0.0), pytest.raises(TooCostly, match="loads: broken off"):
        under_load(first.unloaded, *rotor)


def test_loads_beyond_the_bearings_are_named() -> None:
    found = loaded([0.0], PointLoad(at="Oc2", Fy=200000.0))
    assert "the loads of 2e+05 N on the shaft" in found.preload.outcome[0]
    assert "lower" in found.preload.outcome[0]
    assert "0 rpm" in found.preload.outcome[0]


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "changes"),
    [
        ("off the shaft", {"loads": (PointLoad(at=5.0, Fy=1.0),)}),
        ("unknown point: given 'nozzle'", {"loads": (PointLoad(at="nozzle", Fy=1.0),)}),
        (
            "bearings differ between directions",
            {"loads": (PointLoad(at="Oc2", Fy=1.0),), "formulation": "rotating"},
        ),
        ("bearings differ between directions", {"gravity": "-y", "formulation": "rotating"}),
    ],
)
def test_loads_against_the_machine(words: str, changes: dict[str, Any]) -> None:
    setting = Setting(mfw2310(), conditions(**changes), (0.0,))
    assert any(words in sentence for _, sentence in setting_faults(setting))


def test_loads_need_bearings_and_analyses_that_take_them() -> None:
    acting = conditions(loads=(PointLoad(at="Oc2", Fy=1.0),))
    support = LinearSupport("s", 0.1, {("y", "y"): 1e8, ("z", "z"): 1e8, ("x", "x"): 1e8})
    bare = mfw2310(seats=(), sleeves=(), supports=(support,), shortening=None)
    faults = setting_faults(Setting(bare, acting, (0.0,)))
    assert any("this spindle has none" in sentence for _, sentence in faults)
    setting = Setting(mfw2310(), acting, (0.0,))
    for spec in (SectionForcesSpec(), StiffnessSpec(point="Oc2")):
        sentences = [sentence for _, sentence in spec.faults_on(setting)]
        assert any("loads" in sentence for sentence in sentences)
    assert any("allowed: variants: [nonlinear], without second_stop" in s for s in sentences)
    only = StiffnessSpec(point="Oc2", variants=("nonlinear",))
    assert not [*only.faults_on(setting)]
