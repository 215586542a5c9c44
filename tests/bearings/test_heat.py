"""Friction and heat: closed forms, independent quadrature, limits, a catalogue's example."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from bearings import (
    STEEL,
    DeepGrooveBallBearing,
    InvalidBearing,
    Lubricant,
    ThrustBallBearing,
    heat,
)
from bearings.arrays import Array
from bearings.film import film
from bearings.geometry import geometry
from bearings.heat.ellipse import Contacts, mean_speed
from bearings.heat.skf import FASTEST, inlet_shear, rolling_moment, sliding_moment, starvation
from bearings.ring.motion import ball_motion, contact_motion
from tests.oracles.known_bearings import HYPOTHESES, ISO_DEEP_GROOVE, RPM, VEX70
from tests.oracles.known_grooves import QJ218, R24_14, deep_groove, drawn_6210, four_point

OIL = Lubricant(32e-6, 5.4e-6)
LOAD = np.array([610.0, 0, 0, 0, 0])


def one(**given: float) -> Contacts:
    """A contact of the size of a spindle bearing's, changed."""
    usual = dict(a=1e-3, b=0.2e-3, radius=5e-3, roll=5000.0, spin=500.0, slide=np.nan, creep=0.0)
    return Contacts(*(np.array([float(value)]) for value in (usual | given).values()))


@pytest.mark.parametrize("creep", [0.0, 0.4, 0.85])
@pytest.mark.parametrize("slide", [0.05, -0.3])
def test_a_given_slide_leaves_the_drift_across_it_to_the_creep(slide: float, creep: float) -> None:
    """A ball that slides by a velocity c without rolling or spin is pushed aside by μ Q F where
    sin of its way is F: v = F c/√(1 − F²), |v| = c/√(1 − F²)."""
    found = mean_speed(one(slide=slide, creep=creep, spin=0.0, roll=0.0))
    assert found == pytest.approx(abs(slide) / math.sqrt(1.0 - creep**2), rel=1e-3)


def test_spin_alone_is_closed() -> None:
    """Without rolling ∫ μ p |ωs| r dA = 3/8 μ Q a E(1 − b²/a²) |ωs|."""
    state = VEX70.equilibrium(load=LOAD, speed=10_000 * RPM)
    g = state.operation.geometry
    contact = one(a=1e-3, b=1e-3 / g.inner.ellipticity, roll=0.0)
    exact = 0.375 * 1e-3 * g.inner.second_integral * 500.0
    assert mean_speed(contact) == pytest.approx(exact, rel=5e-3)


@pytest.mark.few(3)
@pytest.mark.parametrize(
    "given",
    [
        {},
        {"spin": 30.0},
        {"spin": 10.0},
        {"spin": 0.3, "b": 0.05e-3},
        {"spin": 0.0},
        {"creep": 0.3},
        {"spin": 2.0, "creep": 0.7},
        {"radius": -5e-3},
    ],
)
def test_sliding_is_the_least_of_its_functional(given: dict[str, float]) -> None:
    """Against a fine Cartesian grid and a minimum sought without derivatives."""
    c = one(**given)
    a, b = float(c.a[0]), float(c.b[0])
    line = (np.arange(400) + 0.5) / 200.0 - 1.0
    x, y = np.meshgrid(line, line)
    pressure = np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))
    pressure /= pressure.sum()
    across = float(c.spin[0]) * b * y
    around = float(c.roll[0]) * (a * x) ** 2 / (2 * float(c.radius[0])) - float(c.spin[0]) * a * x

    def mean(v: float, along: float) -> float:
        return float((pressure * np.hypot(across + v, around + along)).sum())

    def cost(p: np.ndarray) -> float:
        return mean(p[0], p[1]) - float(c.creep[0]) * p[0]

    start = np.array([0.1 * float(c.creep[0]), -0.1 * math.copysign(1.0, float(c.radius[0]))])
    best = minimize(cost, start, method="Nelder-Mead", options={"xatol": 1e-5, "fatol": 1e-7}).x
    assert mean_speed(c) == pytest.approx(mean(*best), rel=0.025)


def test_a_groove_slips_about_its_ball_by_the_mean_of_both_curvatures() -> None:
    """Without spin v = ωr (x² − k² a²)/2R (Heathcote 1921): 1/R is the mean of 2/D and 1/(f D), and
    k = 0.3473, at which the friction of the lines within balances that beyond."""
    bearing = deep_groove(drawn_6210())
    state = bearing.equilibrium(load=[0, 5000.0, 0, 0, 0], speed=3000 * RPM)
    motion, g = contact_motion(state), state.operation.geometry
    power, load = heat.sliding(state, 0.05).power, state.contact_load
    ball = int(load[:, 0].argmax())
    x = np.linspace(0.0, 1.0, 100_001)
    share = float(np.trapezoid(1.5 * (1.0 - x**2) * np.abs(x**2 - 0.3473**2), x))
    d = bearing.ball_diameter
    for k, (race, f) in enumerate(
        ((g.inner, bearing.inner_conformity), (g.outer, bearing.outer_conformity))
    ):
        curvature = 0.5 * (2.0 / d + 1.0 / (f * d))
        q, roll = load[ball, k], abs(motion.roll[ball, k]) * 3000 * RPM
        assert abs(motion.spin[ball, k]) < 1e-9 * abs(motion.roll[ball, k])
        slip = roll * float(race.semi_axis_major * np.cbrt(q)) ** 2 * curvature / 2.0 * share
        assert power[ball, k] == pytest.approx(0.05 * q * slip, rel=0.03)


def test_sliding_power_exceeds_that_of_spin() -> None:
    state = VEX70.equilibrium(load=LOAD, speed=np.array([0.0, 5e3, 10e3]) * RPM)
    found = heat.sliding(state, 0.05)
    assert (found.power[0] == 0.0).all()
    assert (found.power[1:] > found.spin_power[1:]).all()
    assert found.power[1, 0] == pytest.approx(found.power[1, 7])
    twice = heat.sliding(VEX70.equilibrium(load=LOAD, speed=5e3 * RPM), 0.1)
    assert twice.spin_power == pytest.approx(2.0 * found.spin_power[1])


def test_balls_alone_are_those_of_the_ring() -> None:
    """An axial state is solved for one ball; the same with every ball on its own."""
    thrust = VEX70.equilibrium(load=LOAD, speed=8000 * RPM)
    nearly = VEX70.equilibrium(load=LOAD + np.array([0, 1e-6, 0, 0, 0]), speed=8000 * RPM)
    assert heat.sliding(thrust, 0.05).power == pytest.approx(
        heat.sliding(nearly, 0.05).power, rel=1e-6
    )


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_contacts_roll_as_the_state_says(kinematics: str) -> None:
    """Spin over rolling against the state's, no sliding at the middle of a contact, and the true
    surface speeds of ball and race alike."""
    state = VEX70.equilibrium(load=[400, 300, 0, 0, 0], speed=9000 * RPM, kinematics=kinematics)
    motion = contact_motion(state)
    for k, ratio in enumerate((state.inner_spin_to_roll, state.outer_spin_to_roll)):
        found = motion.spin[:, k] / motion.roll[:, k]
        assert found == pytest.approx(ratio, rel=1e-9, abs=1e-12)
    ball = ball_motion(state)
    beta = ball.attitude
    surface = ball.rotation * np.cos(state.outer_angle - beta) * 0.5 * VEX70.ball_diameter
    race = ball.orbit * 0.5 * (90e-3 + 9.525e-3 * np.cos(state.outer_angle))
    assert surface == pytest.approx(race, rel=1e-9)
    assert motion.entrainment[:, 1] == pytest.approx(race, rel=1e-9)


def test_third_contacts_slide() -> None:
    state = four_point(R24_14).equilibrium(load=[20e3, 12e3, 0, 0, 0], speed=1500 * RPM)
    found, slides = heat.sliding(state, 0.05), np.abs(contact_motion(state).slide)
    loaded = state.contact_load > 0.0
    assert ((found.power > 0.0) == loaded).all()
    three = loaded.sum(axis=-1) == 3
    assert three.any()
    assert slides[three][loaded[three]].max() * 1500 * RPM > 0.05
    pair = four_point(QJ218).equilibrium(load=5 * LOAD, speed=1000 * RPM)
    two = pair.contact_load[0] > 0.0
    assert two.sum() == 2
    assert np.abs(contact_motion(pair).slide[0][two]).max() < 1e-12


MIRROR = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])  # x to −x: of loads and displacements
OTHER_ARCS = [1, 0, 3, 2]


@pytest.mark.parametrize("rpm", [1000.0, 6000.0])
@pytest.mark.parametrize("load", [[5e3, 0, 0, 0, 0], [2e3, 3e3, 1e3, 20.0, -30.0]])
def test_a_mirrored_load_heats_the_other_arcs_alike(load: list[float], rpm: float) -> None:
    """Power, spin and films of every contact of a four-point bearing, and its moment."""
    loads = np.array(load) * np.array([np.ones(5), MIRROR])
    state = four_point(QJ218).equilibrium(load=loads, speed=rpm * RPM, kinematics="outer")
    slid, films = heat.sliding(state, 0.05), film(state, OIL, 60.0)
    lost = heat.losses(state, OIL, 60.0)
    for each in (slid.power, slid.spin_power, films.central, films.least):
        largest = each.max()
        assert each[1][:, OTHER_ARCS] == pytest.approx(each[0], rel=1e-6, abs=1e-6 * largest)
    assert lost.moment[1] == pytest.approx(lost.moment[0], rel=1e-6)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_third_contact_loses_what_it_slides(way: float) -> None:
    """Mean of |v| under Hertz' pressure on a fine grid: the slide in the middle by hand, roll over
    the curved surface, and spin; without a gyroscopic moment nothing drifts across."""
    bearing, rpm = four_point(QJ218), 6000.0
    state = bearing.equilibrium(
        load=[way * 5e3, 0, 0, 0, 0], speed=rpm * RPM, kinematics="outer", dynamics="frozen"
    )
    third = 2 if way > 0.0 else 3
    q = float(state.contact_load[0, third])
    assert q > 10.0
    ball, angle = ball_motion(state), -way * float(state.contact_angle[0, third])
    orbit, turn, beta = ball.orbit[0], ball.rotation[0], ball.attitude[0]
    d, pitch, f = bearing.ball_diameter, bearing.pitch_diameter, bearing.outer_conformity
    roll = turn * math.cos(angle - beta) - orbit * math.cos(angle)
    spin = turn * math.sin(angle - beta) - orbit * math.sin(angle)
    slide = 0.5 * turn * d * math.cos(angle - beta) - 0.5 * orbit * (pitch + d * math.cos(angle))
    race = state.operation.geometry.outer
    a, b = (float(axis * np.cbrt(q)) for axis in (race.semi_axis_major, race.semi_axis_minor))
    line = (np.arange(400) + 0.5) / 200.0 - 1.0
    x, y = np.meshgrid(line, line)
    pressure = np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))
    curve = 0.5 * (a * x) ** 2 * (2.0 * f + 1.0) / (2.0 * f * d)
    speed = np.hypot(spin * b * y, slide - spin * a * x - roll * curve) * rpm * RPM
    known = 0.05 * q * float((pressure * speed).sum() / pressure.sum())
    assert heat.sliding(state, 0.05).power[0, third] == pytest.approx(known, rel=1e-3)


@pytest.mark.parametrize(
    ("force", "rpm", "orbit", "power", "of_state"),
    [
        (500.0, 6000.0, 0.4358, 101.0, (0.4626, 868.0)),
        (5e3, 6000.0, 0.4389, 638.0, (0.4343, 1066.0)),
        (20e3, 3000.0, 0.4295, 292.0, (0.4296, 365.0)),
    ],
)
def test_how_far_resultants_are_from_the_balance_of_friction(
    force: float, rpm: float, orbit: float, power: float, of_state: tuple[float, float]
) -> None:
    """Orbit and rotation of a ball that make its loss in all contacts least, without gyroscopic
    moment: the figures of docs/theory/four_point.md, beside those of the state."""
    bearing, omega = four_point(QJ218), rpm * RPM
    state = bearing.equilibrium(load=[force, 0, 0, 0, 0], speed=omega, kinematics="outer")
    d, pitch, g = bearing.ball_diameter, bearing.pitch_diameter, state.operation.geometry
    r, turn = np.meshgrid((np.arange(14) + 0.5) / 14.0, 2.0 * np.pi * (np.arange(24) + 0.5) / 24.0)
    weight = np.sqrt(1.0 - r**2) * r
    weight /= weight.sum()
    touching = []
    for k, side in enumerate((1.0, -1.0, -1.0, 1.0)):
        if (q := float(state.contact_load[0, k])) > 0.0:
            race, f = (g.inner, g.inner_conformity) if k < 2 else (g.outer, g.outer_conformity)
            a, b = (axis * np.cbrt(q) for axis in (race.semi_axis_major, race.semi_axis_minor))
            curve = (a * r * np.cos(turn)) ** 2 * (2.0 * f + 1.0) / (4.0 * f * d)
            angle = side * float(state.contact_angle[0, k])
            touching.append((k < 2, angle, q, a * r * np.cos(turn), b * r * np.sin(turn), curve))

    def lost(motion: Array) -> float:
        cage, axial, radial = motion  # rotation of the ball against the inner ring's, and outwards
        total = 0.0
        for inner, angle, q, xi, eta, curve in touching:
            sin, cos, way = math.sin(angle), math.cos(angle), -1.0 if inner else 1.0
            race = float(inner) - cage
            spin, roll = (race + axial) * sin - radial * cos, (race + axial) * cos + radial * sin
            slide = race * (0.5 * pitch + way * 0.5 * d * cos)
            slide += way * 0.5 * d * (axial * cos + radial * sin)
            speed = np.hypot(spin * eta, slide - spin * xi - way * roll * curve) * omega
            total += 0.05 * q * float((weight * speed).sum())
        return total * bearing.balls

    ball = ball_motion(state)
    beta, spins = ball.attitude[0], float(ball.rotation[0])
    here = np.array([ball.orbit[0], spins * math.cos(beta), spins * math.sin(beta)])
    starts = here, np.array([0.436, spins, 0.0])
    simplex = np.vstack([np.zeros(3), np.diag([0.02, 0.2, 0.2])])
    best = min(
        (
            minimize(
                lost,
                start,
                method="Nelder-Mead",
                options={"xatol": 1e-6, "fatol": 1e-4, "initial_simplex": start + simplex},
            )
            for start in starts
        ),
        key=lambda found: float(found.fun),
    )
    assert best.x[0] == pytest.approx(orbit, abs=1e-4)
    assert best.fun == pytest.approx(power, rel=0.01)
    assert here[0] == pytest.approx(of_state[0], abs=1e-4)
    assert heat.sliding(state, 0.05).power.sum() == pytest.approx(of_state[1], rel=0.01)


def test_losses_are_one_balance() -> None:
    state = VEX70.equilibrium(load=LOAD, speed=np.array([0.0, 6e3, 12e3]) * RPM)
    for model in ("ellipse", "palmgren"):
        lost = heat.losses(state, OIL, 50.0, model=model)
        assert lost.total == pytest.approx(lost.moment * state.speed)
        assert (lost.total[1:] > 0.0).all()
        assert lost.total[0] == 0.0
        assert (lost.spin <= lost.inner + lost.outer + 1e-12).all() or model == "palmgren"


def test_palmgren_by_hand() -> None:
    """dm 90 mm, ν 20 mm²/s, 10 000 rpm, f0 2: M0 = 2e-7 (2e5)^(2/3) 90³ N·mm."""
    by_hand = 1e-3 * 2e-7 * 2e5 ** (2 / 3) * 90**3
    assert heat.viscous_moment(90e-3, 20e-6, 10_000 * RPM, 2.0) == pytest.approx(by_hand)
    slow = heat.viscous_moment(90e-3, 20e-6, np.array([1e-6, 99.9]) * RPM, 2.0)
    assert slow == pytest.approx(1e-3 * 320e-7 * 90**3)
    assert heat.viscous_moment(90e-3, 20e-6, 0.0, 2.0) == 0.0
    state = VEX70.equilibrium(load=[1000, 0, 0, 0, 0])
    driving = 0.9 * 1000 / math.tan(math.radians(25))
    moment = 0.001 * (380 / 12_000) ** 0.33 * driving * 0.09
    assert heat.load_moment(state, 12_000.0) == pytest.approx(moment, rel=1e-6)


@pytest.mark.parametrize("share", [0.02, 0.3])
def test_load_moment_of_thrust_bearings(share: float) -> None:
    """M1 = 0.0008 (Fa/C0)^0.33 Fa dm."""
    bearing = ThrustBallBearing(9.525e-3, 60e-3, 14)
    state = bearing.equilibrium(load=[share * 2e4, 0, 0, 0, 0])
    moment = 0.0008 * share**0.33 * share * 2e4 * 60e-3
    assert heat.load_moment(state, 2e4) == pytest.approx(moment, rel=1e-6)


def test_load_moment_of_other_kinds() -> None:
    radial = ISO_DEEP_GROOVE.equilibrium(load=[0, 1000, 0, 0, 0])
    assert heat.load_moment(radial, 1e4) == pytest.approx(
        0.0005 * 0.1**0.55 * 1000 * ISO_DEEP_GROOVE.pitch_diameter, rel=1e-6
    )


@pytest.mark.parametrize(("axial", "radial"), [(1500.0, 1500.0), (200.0, 1500.0)])
def test_load_moment_under_both_loads(axial: float, radial: float) -> None:
    """Deep groove: P0 = 0.6 Fr + 0.5 Fa, at least Fr; P1 = 3 Fa − 0.1 Fr, at least Fr."""
    bearing = ISO_DEEP_GROOVE
    state = bearing.equilibrium(load=[axial, radial, 0, 0, 0])
    still = max(0.6 * radial + 0.5 * axial, radial)
    driving = max(3.0 * axial - 0.1 * radial, radial)
    moment = 0.0005 * (still / 1e4) ** 0.55 * driving * bearing.pitch_diameter
    assert heat.load_moment(state, 1e4) == pytest.approx(moment, rel=1e-6)


def test_races_share_his_moment_as_they_share_the_sliding() -> None:
    state = VEX70.equilibrium(load=LOAD, speed=12e3 * RPM)
    slid, his = (heat.losses(state, OIL, 50.0, model=m) for m in ("ellipse", "palmgren"))
    assert his.inner / his.outer == pytest.approx(slid.inner / slid.outer, rel=1e-9)
    loaded = heat.load_moment(state, None) * state.speed
    assert his.inner + his.outer == pytest.approx(loaded, rel=1e-9)


def test_skf_example_of_a_catalogue() -> None:
    """Catalogue 6000, p. 104: 22208 E at 3500 rpm, ν 68 mm²/s, Grr 0.26, KZ of its row 5.5."""
    speed, nu = 3500 * RPM, 68e-6
    assert inlet_shear(speed, 60e-3, nu) == pytest.approx(0.85, rel=0.01)
    assert starvation(speed, nu, 40e-3, 80e-3, "low bath", 5.5) == pytest.approx(0.80, rel=0.02)
    assert rolling_moment(0.26, nu, speed) == pytest.approx(0.437, rel=0.01)


@pytest.mark.parametrize("pitch", [60e-3, 90e-3])
def test_boundary_lubrication_of_skf_ends_with_speed(pitch: float) -> None:
    """Catalogue 6000: φbl = 1/e^(2.6e-8 (n ν)^1.4 dm), μbl 0.15; at 1/e of it n ν is known."""
    reached = (1.0 / (2.6e-8 * pitch * 1e3)) ** (1.0 / 1.4)
    speed = np.array([0.0, 0.5, 1.0, 2.0, 20.0]) * reached / 20.0 * RPM
    friction = 1e3 * sliding_moment(1.0, 20e-6, speed, pitch, 0.05)
    share = (friction - 0.05) / (0.15 - 0.05)
    known = [1.0, math.exp(-(0.5**1.4)), 1.0 / math.e, math.exp(-(2.0**1.4)), 0.0]
    assert share == pytest.approx(known, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(("hybrid", "centrifugal"), [(False, 1.0), (True, 0.41)])
def test_skf_moment_by_hand(hybrid: bool, centrifugal: float) -> None:
    """A 7214 B, 70 × 125, at 3000 rpm and 15 mm²/s under 800 N radial and 1200 N axial, as
    catalogue 6000 has it for bearings 72 B: N, mm, rpm, mm²/s."""
    n, nu, d, big, dm, fr, fa = 3000.0, 15.0, 70.0, 125.0, 97.5, 800.0, 1200.0
    grr = 5.03e-7 * dm**1.97 * (fr + 1.90e-12 * centrifugal * dm**4 * n**2 + 1.97 * fa) ** 0.54
    thrown = fr + 1.91e-12 * centrifugal * dm**4 * n**2
    gsl = 1.30e-2 * dm**0.26 * (thrown ** (4 / 3) + 0.68 * fa ** (4 / 3))
    inlet = 1.0 / (1.0 + 1.84e-9 * (n * dm) ** 1.28 * nu**0.64)
    starved = math.exp(-6e-8 * nu * n * (d + big) * math.sqrt(4.4 / (2.0 * (big - d))))
    boundary = math.exp(-2.6e-8 * (n * nu) ** 1.4 * dm)
    found = heat.skf_moment(
        radial=np.array([-fr, fr]),
        axial=np.array([fa, -fa]),
        speed=n * RPM,
        viscosity=nu * 1e-6,
        bore=d * 1e-3,
        outside=big * 1e-3,
        supply="grease",
        hybrid=hybrid,
        ehl_friction=0.04,
    )
    sliding = 1e-3 * gsl * (boundary * 0.15 + (1.0 - boundary) * 0.04)
    assert found.rolling == pytest.approx(2 * [1e-3 * inlet * starved * grr * (n * nu) ** 0.6])
    assert found.sliding == pytest.approx(2 * [sliding])
    assert found.total == pytest.approx(found.rolling + found.sliding)


def test_skf_model_ends() -> None:
    common = dict(radial=0.0, axial=600.0, viscosity=20e-6, bore=70e-3, outside=110e-3)
    fast = FASTEST / 90 * RPM
    slow = heat.skf_moment(speed=np.array([0.0, 0.5, 0.99]) * fast, **common)
    assert slow.total[0] == 0.0
    assert (slow.total[1:] > 0.0).all()
    assert (heat.skf_moment(speed=fast, hybrid=True, **common).total < slow.total[2]).all()
    with pytest.raises(InvalidBearing, match="SKF's friction model is valid up to n·dm 8e"):
        heat.skf_moment(speed=1.01 * fast, **common)


def test_temperatures_of_constant_heat_are_a_linear_balance() -> None:
    """All heat leaves, and without heat nodes take the temperatures around."""
    c, around = heat.Conductances(2.0, 3.0, 1.0, 1.5, 2.5), heat.Surroundings(30.0, 25.0, 28.0)
    found = heat.balanced(lambda _: (20.0, 10.0, 40.0), c, around)
    out = 2.0 * (found.inner - 30) + 3.0 * (found.outer - 25) + 1.0 * (found.balls - 28)
    assert out == pytest.approx(70.0, abs=1e-3)
    assert found.outcome == ""
    even = heat.balanced(
        lambda _: (0.0, 0.0, 0.0), c, heat.Surroundings(40.0, 40.0, 40.0), shape=(2,)
    )
    for each in even[:3]:
        assert each == pytest.approx([40.0, 40.0], abs=1e-5)


def test_run_away_has_its_bound() -> None:
    """Heat that rises as 2 W/K of the balls over 1 W/K that leaves is in balance nowhere; one of
    many that runs away does not disturb the others."""
    c, around = heat.Conductances(0.0, 0.0, 1.0, 0.0, 0.0), heat.Surroundings(20.0, 20.0, 20.0)
    c = c._replace(inner_shaft=1e-9, outer_housing=1e-9, balls_inner=1e-9, balls_outer=1e-9)
    slope = np.array([0.0, 0.5, 0.9, 1.1, 2.0])

    def rising(t: np.ndarray) -> np.ndarray:
        oil = 10.0 + slope * (t[..., 0] - 20.0)
        return np.stack([0.0 * oil, 0.0 * oil, oil], axis=-1)

    found = heat.balanced(rising, c, around, slope.shape)
    assert (found.outcome[:3] == "").all()
    assert found.balls[:3] == pytest.approx(20.0 + 10.0 / (1.0 - slope[:3]), rel=1e-5)
    assert (found.outcome[3:] != "").all()
    assert "run away" in found.outcome[4]


def test_state_that_ends_is_named() -> None:
    c, around = heat.Conductances(1.0, 1.0, 1.0), heat.Surroundings(20.0, 20.0, 20.0)
    found = heat.balanced(lambda t: np.where(t > 25.0, np.nan, 100.0 + 0.0 * t), c, around)
    assert "no state at the temperatures reached" in str(found.outcome)


MOUNTING = heat.Mounting(OIL, heat.Conductances(3.0, 6.0, 1.0), heat.Surroundings(30.0, 25.0, 30.0))
FASTER = np.array([0.0, 5e3, 10e3, 24e3]) * RPM


def test_a_rigid_preload_grows_hotter_than_a_spring() -> None:
    rigid = heat.heated(VEX70, MOUNTING, speed=FASTER, preload=300.0)
    spring = heat.heated(VEX70, replace(MOUNTING, rigid=False), speed=FASTER, preload=300.0)
    assert spring.axial_load[:3] == pytest.approx(300.0)
    assert rigid.axial_load[2] > 1000.0
    assert (rigid.temperatures.inner[1:3] > spring.temperatures.inner[1:3]).all()
    assert (spring.temperatures.inner[1:3] > 30.0).all()
    assert (rigid.outcome[:3] == "").all()
    assert "run away" in rigid.outcome[3]


def test_balance_of_a_mounted_bearing_closes() -> None:
    """What leaves through the conductances is what the state at those temperatures loses."""
    found = heat.heated(VEX70, MOUNTING, speed=FASTER[:3], preload=300.0)
    t, c, around = found.temperatures, MOUNTING.conductances, MOUNTING.surroundings
    out = c.inner_shaft * (t.inner - around.shaft) + c.outer_housing * (t.outer - around.housing)
    out = out + c.balls_oil * (t.balls - around.oil)
    lost = heat.losses(found.state, OIL, t.balls)
    assert lost.total == pytest.approx(out, rel=1e-5, abs=1e-3)
    grown = heat.thermal_growth(VEX70, np.stack([t.balls, t.inner, t.outer], axis=-1))
    assert found.growth == pytest.approx(grown[0], abs=1e-11)


@pytest.mark.long
def test_speed_limit_is_where_temperatures_cease_to_settle() -> None:
    preload = np.array([100.0, 300.0, 600.0])
    limit = heat.speed_limit(VEX70, MOUNTING, preload=preload, fastest=24e3 * RPM)
    assert (np.diff(limit) < 0.0).all()
    for share, settles in ((0.99, True), (1.01, False)):
        found = heat.heated(VEX70, MOUNTING, speed=share * limit, preload=preload)
        assert ((found.outcome == "") == settles).all()
    slow = heat.speed_limit(VEX70, MOUNTING, preload=100.0, fastest=100 * RPM)
    assert slow == pytest.approx([100 * RPM])
    hot = replace(MOUNTING, surroundings=heat.Surroundings(300.0, 300.0, 300.0))
    assert heat.speed_limit(VEX70, hot, preload=100.0, fastest=100 * RPM) == [0.0]


@pytest.mark.parametrize(
    ("growth", "load"), [(2e-6, 558.0), (5e-6, 1280.0), (10e-6, 2860.0)], ids=["2", "5", "10 um"]
)
def test_growth_raises_a_rigid_preload(growth: float, load: float) -> None:
    """An independent code: 200 N on a VEX 70 of steel whose rings keep their place."""
    steel = replace(VEX70, ball_material=STEEL)
    place = steel.equilibrium(load=[200.0, 0, 0, 0, 0]).displacement
    found = steel.equilibrium(displacement=place, growth=growth)
    assert found.load[0] == pytest.approx(load, rel=2e-3)


def warmed(b: Any, temperature: Array, axial: float) -> float:
    """Axial force at rest of a ring moved by ``axial`` from the plane of the balls (or from where
    it touches), each body scaled by its own temperature about that plane and the axis."""
    d, angle, g = b.ball_diameter, b.free_angle, geometry(b.grooves)
    scale = 1.0 + b.ring_material.thermal_expansion * (temperature[1:] - 20.0)
    ball = 1.0 + b.ball_material.thermal_expansion * (temperature[0] - 20.0)
    beside = np.array([b.inner_conformity - 0.5, 0.5 - b.outer_conformity]) * d
    radius = 0.5 * b.pitch_diameter + beside * math.cos(angle)
    along = 0.0 * beside if b.both_ways else beside * math.sin(angle)
    across, apart = np.diff(radius * scale)[0], axial - np.diff(along * scale)[0]
    length = math.hypot(across, apart)
    free = d * (np.array([b.inner_conformity, b.outer_conformity]) @ scale - ball)
    pressed = max(length - free, 0.0)
    return float(b.balls * g.series_stiffness * pressed**1.5 * apart / length)


@pytest.mark.parametrize("angle", [0.1, 0.26, 0.44, 0.7, 1.0])
@pytest.mark.parametrize("rise", [(40.0, 0.0, 0.0), (33.0, 45.0, 15.0), (0.0, 20.0, -5.0)])
def test_a_rigid_preload_is_that_of_the_heated_lengths(
    angle: float, rise: tuple[float, ...]
) -> None:
    """Groove circles, groove radii, ball and the places along the axis, to first order in α T."""
    b = replace(VEX70, contact_angle=angle, ball_material=STEEL)
    temperature = 20.0 + 0.02 * np.array(rise)
    place = b.equilibrium(load=[600.0, 0, 0, 0, 0]).displacement
    growth, axial = heat.thermal_growth(b, temperature)
    moved = place + np.array([1.0, 0, 0, 0, 0]) * axial
    found = b.equilibrium(displacement=moved, growth=float(growth)).load[0] - 600.0
    assert found == pytest.approx(warmed(b, temperature, place[0]) - 600.0, rel=4e-3)


@pytest.mark.parametrize("angle", [0.1, 0.3, 0.6])
def test_warm_balls_take_the_play_of_a_deep_groove(angle: float) -> None:
    """On either side alike."""
    b = DeepGrooveBallBearing(
        ball_diameter=9.525e-3,
        pitch_diameter=90e-3,
        balls=25,
        inner_conformity=0.54,
        outer_conformity=0.53,
        contact_angle=angle,
    )
    temperature = np.array([21.0, 20.3, 20.1])
    for side in (-1.0, 1.0):
        place = b.equilibrium(load=[side * 600.0, 0, 0, 0, 0]).displacement
        growth, axial = heat.thermal_growth(b, temperature)
        found = b.equilibrium(displacement=place, growth=float(growth)).load[0] - side * 600.0
        wanted = warmed(b, temperature, float(place[0])) - side * 600.0
        assert axial == 0.0
        assert found == pytest.approx(wanted, rel=0.03)


def test_a_heated_bearing_is_where_its_ring_does() -> None:
    """A rigid preload keeps the place of its ring; under a spring it moves by the shift, too."""
    rigid, spring = (
        heat.heated(VEX70, replace(MOUNTING, rigid=held), speed=FASTER[:2], preload=300.0)
        for held in (True, False)
    )
    still = VEX70.equilibrium(load=[300.0, 0, 0, 0, 0]).displacement
    assert rigid.displacement[:, 0] == pytest.approx(still[0], abs=1e-15)
    growth, axial = heat.thermal_growth(VEX70, np.stack(spring.temperatures[:3], axis=-1))
    assert spring.axial == pytest.approx(axial, abs=1e-12)
    alone = VEX70.equilibrium(load=[300.0, 0, 0, 0, 0], speed=FASTER[1], growth=growth[1])
    place = alone.displacement[0] - axial[1]
    assert spring.displacement[1, 0] == pytest.approx(place, abs=1e-10)


def test_even_warmth_keeps_the_angle() -> None:
    """A bearing of one material at one temperature: no growth of its own."""
    warm, steel = np.full(3, 80.0), replace(VEX70, ball_material=STEEL)
    assert heat.thermal_growth(steel, warm) == pytest.approx((0.0, 0.0), abs=1e-12)
    radial, axial = heat.thermal_growth(VEX70, warm)
    assert radial < -3e-6
    assert axial == pytest.approx(radial * math.tan(VEX70.free_angle))


def skf(**changed: float) -> heat.SkfMoment:
    given = {"radial": 0.0, "axial": 300.0, "speed": 300.0, "viscosity": 2e-5, "bore": 0.07}
    return heat.skf_moment(**{**given, "outside": 0.11, **changed})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("call", "word"),
    [
        (lambda s: heat.sliding(s, 0.0), "friction of a contact"),
        (lambda s: heat.losses(s, OIL, 40.0, model="skf"), "unknown model"),
        (lambda s: heat.losses(s, OIL, 40.0, oil_factor=0.0), "oil_factor"),
        (lambda s: heat.load_moment(s, -1.0), "C0 must be positive"),
        (lambda s: starvation(1.0, 1e-6, 0.07, 0.11, "drops"), "unknown supply"),
        (lambda s: skf(viscosity=20.0), "is the unit right"),
        (lambda s: skf(bore=0.12), "bore and outside"),
        (lambda s: skf(speed=float("nan")), "speed must be finite"),
        (lambda s: skf(ehl_friction=-1e-3), "ehl_friction"),
        (lambda s: skf(ehl_friction=1.001), "ehl_friction must be from 0 to 1, got 1.001"),
        (lambda s: Lubricant(32.0, 5.4), "is the unit right"),
        (lambda s: OIL.kinematic(-300.0), "too cold"),
        (
            lambda s: heat.balanced(
                lambda _: (0, 0, 0), heat.Conductances(0.0, 0.0), heat.Surroundings(20, 20, 20)
            ),
            "heat must leave",
        ),
    ],
)
def test_bad_input_gets_a_sentence(call: object, word: str) -> None:
    with pytest.raises(InvalidBearing, match=word):
        call(VEX70.equilibrium(load=LOAD))  # type: ignore[operator]
