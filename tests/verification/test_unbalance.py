"""Response to unbalance against closed forms, other formulations, equilibrium and symmetry."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rotordyn
from bearings import Material
from rotordyn.analyses import (
    BalanceGrade,
    CampbellSpec,
    Conditions,
    EccentricSpan,
    FrfSpec,
    Port,
    Unbalance,
    UnbalanceSpec,
)
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.frf.result import FrfResult
from rotordyn.analyses.solving import solve_spindle
from rotordyn.analyses.unbalance import growth
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.orbit import orbit
from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.analyses.unbalance.summary import summary as unbalance_lines
from rotordyn.analyses.unbalance.summary import warnings as unbalance_warnings
from rotordyn.errors import NoSolution
from rotordyn.machine import LinearSupport, PointMass, RigidHousing, Section, Shaft, Spindle
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL, OUTER
from tests.oracles.idealised import times
from tests.oracles.spindles import RPM, mfw2310, undamped

STEEL = Material("steel", 210e9, 0.3, 7850.0)
U = 2e-4
RIGID = Conditions(rotor="rigid")
K, C, M = 4e6, 300.0, 25.0


def block(yy: float, zz: float, yz: float = 0.0, zy: float = 0.0) -> dict[tuple[str, str], float]:
    return {("y", "y"): yy, ("z", "z"): zz, ("y", "z"): yz, ("z", "y"): zy}


def on_two(
    stiffness: dict[tuple[str, str], float],
    damping: dict[tuple[str, str], float],
    material: Material = STEEL,
    mass: float = M,
    **changes: Any,
) -> Spindle:
    """A shaft of 1 m with a point mass amidships, half of the given support at either end."""
    ends = tuple(
        LinearSupport(
            name,
            x,
            {pair: k / 2.0 for pair, k in stiffness.items()},
            {pair: c / 2.0 for pair, c in damping.items()},
        )
        for name, x in (("left", 0.0), ("right", 1.0))
    )
    shaft = Shaft(0.0, (Section(1.0, 0.03, 0.0, material),), 0.9)
    own = {"masses": (PointMass("disc", 0.5, mass),), "points": {"disc": 0.5, "end": 1.0}}
    return Spindle("rotor", shaft, supports=ends, **{**own, **changes})


def half(table: dict[tuple[str, str], tuple[float, ...]]) -> dict[tuple[str, str], Any]:
    """Of tables for one of two supports."""
    return {pair: tuple(0.5 * each for each in values) for pair, values in table.items()}


def solved(
    spindle: Spindle,
    speeds: Sequence[float],
    *unbalances: Unbalance,
    conditions: Conditions | None = None,
    points: tuple[str, ...] = ("disc",),
    **asked: Any,
) -> UnbalanceResult:
    spec = UnbalanceSpec(points=points, unbalances=unbalances, **asked)
    own, at = conditions or Conditions(), tuple(map(float, speeds))
    found = solve_spindle(spindle, own, at, {"unbalance": spec}, lambda name: None)
    result = found.results["unbalance"]
    assert isinstance(result, UnbalanceResult)
    return result


def test_jeffcott_rotor_through_resonance() -> None:
    """r = U Ω²/(k − m Ω² + iΩc): a rigid body on springs; it lags by 90° where k = m Ω²."""
    spindle = on_two(block(K, K), block(C, C))
    mass = rotor_inertia(spindle).mass
    critical = math.sqrt(K / mass)
    speed = np.sort(np.append(np.linspace(0.0, 3.0 * critical, 60), critical))
    result = solved(spindle, speed, Unbalance("disc", U, math.radians(40.0)), conditions=RIGID)
    closed = U * speed**2 / (K - mass * speed**2 + 1j * speed * C)
    scale = np.abs(closed).max()
    turned = closed * np.exp(1j * math.radians(40.0))
    np.testing.assert_allclose(result.displacement[:, 0, 0], turned, rtol=1e-9, atol=1e-13 * scale)
    np.testing.assert_allclose(result.displacement[:, 0, 1], -1j * turned, rtol=1e-9)
    np.testing.assert_allclose(result.amplitude[:, 0, 0], np.abs(closed), rtol=1e-9)
    np.testing.assert_allclose(result.minor_axis, result.major_axis, rtol=1e-9)
    row = int(np.flatnonzero(speed == critical)[0])
    assert result.phase[row, 0, 0] == pytest.approx(math.radians(40.0 - 90.0), abs=1e-9)
    assert result.phase[-1, 0, 0] == pytest.approx(math.radians(40.0 - 180.0), abs=0.02)
    assert result.critical_speed[0] == pytest.approx(critical, rel=1e-3)


def test_jeffcott_rotor_on_a_light_shaft() -> None:
    """The shaft as a spring: 1/k = L³/48EI + L/4κGA + 1/k of the supports, and the disc above it
    turns about its centre of mass."""
    light = times(STEEL, density=1.0 / STEEL.density)
    spindle = on_two(block(1e11, 1e11), block(0.0, 0.0), light, mass=5.0)
    inertia, ring = math.pi / 64 * 0.03**4, math.pi / 4 * 0.03**2
    give = 1.0 / (48 * 210e9 * inertia) + 1.0 / (4 * 0.9 * STEEL.young_modulus / 2.6 * ring) + 1e-11
    natural = math.sqrt(1.0 / give / 5.0)
    speed = natural * np.array([0.3, 0.8, 1.3, 6.0])
    result = solved(spindle, speed, Unbalance("disc", U))
    closed = U / 5.0 * speed**2 / (natural**2 - speed**2)
    np.testing.assert_allclose(result.displacement[:, 0, 0].real, closed, rtol=2e-3)
    assert result.displacement[-1, 0, 0].real == pytest.approx(-U / 5.0, rel=0.05)


def test_supports_that_differ() -> None:
    """A rigid body on a full 2×2 support: backward whirl between the two critical speeds."""
    stiffness, damping = block(K, 2.0 * K, 0.1 * K, 0.1 * K), block(C, 2.0 * C)
    spindle = on_two(stiffness, damping)
    mass = rotor_inertia(spindle).mass
    low, high = np.sqrt(np.linalg.eigvalsh([[K, 0.1 * K], [0.1 * K, 2.0 * K]]) / mass)
    speed = np.linspace(0.3 * low, 1.5 * high, 40)
    result = solved(spindle, speed, Unbalance("disc", U), conditions=RIGID)
    matrix = np.array([[K, 0.1 * K], [0.1 * K, 2.0 * K]])
    for row, w in enumerate(speed):
        dynamic = matrix + 1j * w * np.diag([C, 2.0 * C]) - w**2 * mass * np.eye(2)
        closed = np.linalg.solve(dynamic, U * w**2 * np.array([1.0, -1j]))
        np.testing.assert_allclose(result.displacement[row, 0], closed, rtol=1e-9)
        push = -(matrix + 1j * w * np.diag([C, 2.0 * C])) @ closed / 2.0
        np.testing.assert_allclose(result.force[row], [push, push], rtol=1e-9)
    backward = result.minor_axis[:, 0] < 0.0
    between = (low * 1.02 < speed) & (speed < high * 0.98)
    assert backward[between].all()
    assert not backward[(speed < 0.95 * low) | (speed > 1.05 * high)].any()
    np.testing.assert_allclose(result.critical_speed, [low, high], rtol=1e-3)
    ends = solved(spindle, speed[[0, -1]].tolist(), Unbalance("disc", U), conditions=RIGID)
    assert not (ends.minor_axis < 0.0).any()
    told = unbalance_lines(ends)[-1].replace("\u00a0", " ")
    assert told.startswith("           whirl backward: disc from about ")
    rpm = np.array([float(word) for word in told.split() if word.isdigit()])
    np.testing.assert_allclose(rpm * RPM, speed[backward][[0, -1]], atol=np.diff(speed)[0])


@pytest.mark.parametrize(("ratio", "told"), [(1.5, ""), (-1.5, "whirl opposite to the spindle: ")])
def test_a_rotor_that_turns_against_the_spindle_moves_as_it_turns(ratio: float, told: str) -> None:
    """Far below resonances its points follow its unbalance, which is not called backward."""
    machine = replace(COAXIAL, rotors=(replace(OUTER, speed_ratio=ratio),))
    acting = Unbalance("outer.d2", U)
    speeds = (100.0 * RPM, 300.0 * RPM)
    found = solved(machine, speeds, acting, points=("outer.d2",))
    y, z = found.displacement[0, 0]
    follows = np.array([1.0, -1j if ratio > 0.0 else 1j])  # z = ∓i y: along with e^(iωt), against
    assert np.abs(np.array([y, z]) - follows * y).max() < 0.5 * abs(y)
    lines = [line for line in unbalance_lines(found) if "whirl" in line]
    assert len(lines) == bool(told)
    assert all(line.startswith(f"           {told}outer.d2") for line in lines)


def test_whirl_that_is_backward_at_every_speed_begins_at_rest() -> None:
    """Isotropic supports, all orbits turned the other way: those of a rotor that turns against the
    spindle. At rest there is no orbit, so that its sense is undefined."""
    spindle = on_two(block(K, K), block(C, C))
    found = solved(spindle, np.linspace(0.0, 800.0, 5).tolist(), Unbalance("disc", U))
    assert not any("backward" in line for line in unbalance_lines(found))
    turned = replace(found, fine_minor_axis=-found.fine_minor_axis)
    (told,) = (line for line in unbalance_lines(turned) if "backward" in line)
    assert "disc from about 0 to 7639 rpm" in told.replace("\u00a0", " ")


def test_orbit_is_what_a_drawn_ellipse_shows() -> None:
    rng = np.random.default_rng(3)
    y, z = (rng.normal(size=50) + 1j * rng.normal(size=50) for _ in range(2))
    ellipse = orbit(y, z)
    turn = np.exp(2j * math.pi * np.arange(4000) / 4000.0)
    path = (y[:, None] * turn).real + 1j * (z[:, None] * turn).real
    far = np.abs(path)
    np.testing.assert_allclose(far.max(axis=1), ellipse.major, rtol=1e-6)
    np.testing.assert_allclose(far.min(axis=1), np.abs(ellipse.minor), rtol=1e-2, atol=1e-3)
    area = 0.5 * (path.conj() * np.roll(path, -1, axis=1)).imag.sum(axis=1)
    np.testing.assert_allclose(area, math.pi * ellipse.major * ellipse.minor, rtol=1e-5)
    at = path[np.arange(50), far.argmax(axis=1)]
    np.testing.assert_allclose(
        (at**2 / np.abs(at) ** 2), np.exp(2j * ellipse.inclination), atol=0.05
    )


@pytest.mark.filterwarnings("error")
def test_orbit_of_motion_that_has_grown_beyond_squares() -> None:
    """The same ellipse, larger, down to a circle and a point."""
    rng = np.random.default_rng(3)
    y, z = (rng.normal(size=50) + 1j * rng.normal(size=50) for _ in range(2))
    y[:2], z[:2] = (1.0, 0.0), (-1j, 0.0)
    one, large = orbit(y, z), orbit(1e250 * y, 1e250 * z)
    np.testing.assert_allclose(large.major, 1e250 * one.major, rtol=1e-14)
    np.testing.assert_allclose(large.inclination, one.inclination, rtol=1e-12)
    assert (one.inclination[:2] == 0.0).all()


@pytest.fixture(scope="module")
def spindle() -> Spindle:
    return undamped(mfw2310())


SPEEDS = tuple(n * RPM for n in (0.0, 6000.0, 15000.0, 24000.0))
SPREAD = (Unbalance("Oc2", 1e-6), Unbalance(0.3, 3e-6, 2.0), Unbalance("O2", 5e-6, -1.0))


@pytest.mark.long
def test_superposition(spindle: Spindle) -> None:
    points = ("Oc2", "O3")
    asked: Any = {"points": points}
    whole = solved(spindle, SPEEDS, *SPREAD, **asked)
    parts = [solved(spindle, SPEEDS, each, **asked) for each in SPREAD]
    for name in ("displacement", "force"):
        total = sum(getattr(part, name) for part in parts)
        size = np.abs(getattr(whole, name)).max()
        # each alone has its own nodes and basis, which agree within the accuracy
        np.testing.assert_allclose(getattr(whole, name), total, rtol=0, atol=2e-4 * size)
    double = solved(
        spindle, SPEEDS, *(replace(u, unbalance=2 * u.unbalance) for u in SPREAD), **asked
    )
    np.testing.assert_allclose(double.force, 2.0 * whole.force, rtol=1e-9)


def test_receptances_at_the_frequency_of_rotation(spindle: Spindle) -> None:
    """y = Σ U Ω² (H_yy − i H_yz) e^(iα) by the FRF of elements."""
    named = replace(spindle, points={**spindle.points, "inside": 0.3})
    points = ("Oc2", "O3")
    result = solved(named, SPEEDS, *SPREAD, points=points)
    for row, speed in enumerate(SPEEDS[1:], start=1):
        pairs = [
            (Port(p, "y"), Port(str(u.at if isinstance(u.at, str) else "inside"), way))
            for p in points
            for u in SPREAD
            for way in ("y", "z")
        ]
        spec = FrfSpec((speed / (2 * math.pi),), tuple(pairs))
        found = solve_spindle(named, Conditions(), (speed,), {"frf": spec}, lambda name: None)
        frf = found.results["frf"]
        assert isinstance(frf, FrfResult)
        h = frf.receptance[0, :, 0].reshape(len(points), len(SPREAD), 2)
        force = np.array([u.unbalance * speed**2 * np.exp(1j * u.angle) for u in SPREAD])
        wanted = (h @ np.array([1.0, -1j])) @ force
        size = np.abs(wanted).max()
        np.testing.assert_allclose(result.displacement[row, :, 0], wanted, atol=2e-4 * size)


def test_formulations_agree(spindle: Spindle) -> None:
    """Rotating frame, both planes apart, and axial motion in the same system: one response."""
    points = ("Oc2", "O3")
    plain = solved(spindle, SPEEDS, *SPREAD, points=points)
    turning = solved(
        spindle, SPEEDS, *SPREAD, points=points, conditions=Conditions(formulation="rotating")
    )
    uneven = LinearSupport("touch", 0.3, {("y", "y"): 1e-3})
    planes = solved(replace(spindle, supports=(uneven,)), SPEEDS, *SPREAD, points=points)
    link = LinearSupport("link", 0.3, {("x", "x"): 1e-3, ("x", "y"): 1e-4, ("y", "x"): 1e-4})
    static = Conditions(bearings="static")
    held = solved(spindle, SPEEDS, *SPREAD, points=points, conditions=static)
    coupled = solved(
        replace(spindle, supports=(link,)), SPEEDS, *SPREAD, points=points, conditions=static
    )
    for other, own in ((turning, plain), (planes, plain), (coupled, held)):
        size = np.abs(own.displacement).max()
        np.testing.assert_allclose(other.displacement, own.displacement, atol=1e-6 * size)
        push = np.abs(own.force).max()
        count = own.force.shape[1]
        np.testing.assert_allclose(other.force[:, :count], own.force, atol=1e-6 * push)


def test_forces_and_inertia_are_in_balance() -> None:
    """A rigid rotor, unbalance off its middle: forces of the supports, centrifugal, m Ω² r."""
    spindle = on_two(block(K, 1.5 * K), block(C, C))
    speed = np.array([150.0, 420.0])
    result = solved(spindle, speed, Unbalance(0.8, U), conditions=RIGID, points=("disc", "end"))
    mass = rotor_inertia(spindle).mass
    acting = U * speed[:, None] ** 2 * np.array([1.0, -1j])
    inertia = mass * speed[:, None] ** 2 * result.displacement[:, 0]
    np.testing.assert_allclose(result.force.sum(axis=1), -(acting + inertia), rtol=1e-8)


def test_rigid_supports_carry_what_acts_on_a_slow_rotor() -> None:
    """Against the centrifugal force and its moment; inertia of what bends adds (Ω/ω)² or less."""
    places = {"left": 0.0, "right": 1.0}
    ends = tuple(LinearSupport(name, x, {}, rigid=("y", "z")) for name, x in places.items())
    spindle = replace(on_two(block(K, K), block(C, C)), supports=ends)
    speed = np.array([0.1, 0.2])
    result = solved(spindle, speed, Unbalance(0.8, U))
    acting = U * speed[:, None] ** 2 * np.array([1.0, -1j])
    shares = np.array([0.2, 0.8])[:, None]
    np.testing.assert_allclose(result.force, -shares * acting[:, None], rtol=1e-5)


def test_eccentric_span_of_a_rigid_rotor() -> None:
    """The same as its mass times the eccentricity at its middle."""
    spindle = on_two(block(K, K), block(C, C))
    span = EccentricSpan(0.2, 0.8, 5e-6, 0.7)
    mass = 0.6 * math.pi / 4 * 0.03**2 * STEEL.density
    speed = np.array([100.0, 390.0, 800.0])
    spread = solved(spindle, speed, spans=(span,), conditions=RIGID)
    point = solved(spindle, speed, Unbalance(0.5, 5e-6 * mass, 0.7), conditions=RIGID)
    np.testing.assert_allclose(spread.displacement, point.displacement, rtol=1e-9)
    assert spread.unbalance_size[0] == pytest.approx(5e-6 * mass)
    assert spread.unbalance_station[0] == pytest.approx(0.5)


def test_point_unbalances_approach_a_span_with_the_square_of_their_distance() -> None:
    spindle = on_two(block(K, K), block(C, C))
    speed = np.array([700.0])
    line = math.pi / 4 * 0.03**2 * STEEL.density * 5e-6
    fine = Conditions(accuracy=1e-8)
    spread = solved(spindle, speed, spans=(EccentricSpan(0.0, 0.5, 5e-6),), conditions=fine)
    left = []
    for count in (3, 6, 12):
        at = 0.5 * (np.arange(count) + 0.5) / count
        each = [Unbalance(float(x), line * 0.5 / count) for x in at]
        points = solved(spindle, speed, *each, conditions=fine)
        left.append(abs(points.displacement[0, 0, 0] / spread.displacement[0, 0, 0] - 1.0))
    rates = np.log2(np.array(left[:-1]) / left[1:])
    np.testing.assert_allclose(rates, 2.0, atol=0.1)


@pytest.mark.parametrize("phase", ["static", "couple"])
def test_balance_grade(phase: str) -> None:
    """U = G m/Ω at the speed of service, shared by levers; the same as two unbalances by hand."""
    spindle = on_two(block(K, K), block(C, C))
    mass = rotor_inertia(spindle).mass
    grade = BalanceGrade(6.3e-3, 1000.0, (0.2, 0.7), phase, 0.5)
    speed = np.array([200.0, 600.0])
    found = solved(spindle, speed, grade=grade, points=("end",))
    whole = 6.3e-3 * mass / 1000.0
    sign = 0.0 if phase == "static" else math.pi
    hand = solved(
        spindle,
        speed,
        Unbalance(0.2, 0.4 * whole, 0.5),
        Unbalance(0.7, 0.6 * whole, 0.5 + sign),
        points=("end",),
    )
    np.testing.assert_allclose(found.displacement, hand.displacement, rtol=1e-9)
    np.testing.assert_allclose(found.unbalance_size, [0.4 * whole, 0.6 * whole])
    assert (found.grade_speed, hand.grade_speed) == (1000.0, 0.0)


def test_an_unstable_machine_is_given_its_steady_solution() -> None:
    """Follower stiffness k_yz = −k_zy pumps forward whirl once q > c ω: k − iq for k in r."""
    q = 0.3 * C * math.sqrt(K / M)
    for share, unstable in ((1.0, False), (10.0, True)):
        spindle = on_two(block(K, K, share * q, -share * q), block(C, C))
        found = solved(spindle, [100.0, 200.0], Unbalance("disc", U), conditions=RIGID)
        mass, speed = rotor_inertia(spindle).mass, found.speed
        whirl = speed**2 * U / (K - 1j * share * q + 1j * speed * C - mass * speed**2)
        np.testing.assert_allclose(found.displacement[:, 0, 0], whirl, rtol=1e-6)
        assert (found.unstable == unstable).all()
        assert set(found.outcome) == {""}


@pytest.mark.parametrize(("ratio", "told"), [(3e-7, True), (1e-4, False)])
def test_a_peak_that_hardly_anything_damps_is_named(ratio: float, told: bool) -> None:
    """A rigid body on springs with c = 2 ζ √(K m)."""
    mass = rotor_inertia(on_two(block(K, K), block(C, C))).mass
    damping = 2.0 * ratio * math.sqrt(K * mass)
    spindle = on_two(block(K, K), block(damping, damping))
    asked: dict[str, Any] = {"conditions": RIGID, "points": ("disc", "end")}
    found = solved(spindle, [0.0, 600.0], Unbalance("disc", U), **asked)
    said = unbalance_warnings(found)
    assert len(said) == told
    rpm = math.sqrt(K / mass) / RPM
    start = f"unbalance: the highest peak of disc (and of 1 more points), at {rpm:.0f} rpm, is set"
    for sentence in said:
        assert sentence.startswith(f"{start} by bending ")
        assert "has a damping ratio of 3e-07 only, so that its height is meaningless" in sentence


def test_lines_between_the_samples_of_either_axis_follow_its_antiresonance() -> None:
    """Of planes that are unlike: either dips where the orbit does not."""
    spindle = on_two(block(K, 2.0 * K), block(5.0 * C, 5.0 * C))
    asked: dict[str, Any] = {"points": ("end",)}
    found = solved(spindle, [100.0, 2500.0], Unbalance("end", U), **asked)
    speeds = np.linspace(100.0, 2500.0, 2001)
    exact = solved(spindle, speeds.tolist(), Unbalance("end", U), **asked).displacement[:, 0]
    for axis in range(2):
        level = np.log(np.abs(found.fine_displacement[:, 0, axis]))
        drawn = np.interp(speeds, found.fine_speed, level)
        assert np.abs(drawn - np.log(np.abs(exact[:, axis]))).max() < 0.2


def test_peaks_of_other_speeds_growth_and_no_limit_are_not_called_lightly_damped() -> None:
    """An infinite peak has a sentence of its own."""
    mass = rotor_inertia(on_two(block(K, K), block(C, C))).mass
    damping = 6e-7 * math.sqrt(K * mass)
    found, endless = (
        solved(on_two(block(K, K), block(c, c)), [0.0, 600.0], Unbalance("disc", U))
        for c in (damping, 0.0)
    )
    assert np.isinf(endless.peak_amplitude).any()
    grown = replace(found, critical_damping=np.full_like(found.critical_damping, -1e-3))
    beside = replace(found, critical_speed=1.01 * found.critical_speed)
    for each, told in ((found, True), (grown, False), (beside, False), (endless, False)):
        said = unbalance_warnings(each)
        assert any("its height is meaningless" in sentence for sentence in said) == told


def test_a_run_ends_where_no_machine_moves() -> None:
    """Follower stiffness q = 6 c ω Ω / 1440 lets motion grow from 240 rad/s on: a slow run passes
    0.1 m before it ends, a short one does not."""
    rigid = on_two(block(K, K), block(C, C))
    limit = C * math.sqrt(K / rotor_inertia(rigid).mass)
    table = {("y", "z"): (0.0, 6.0 * limit), ("z", "y"): (0.0, -6.0 * limit)}
    ends = [
        replace(each, stiffness={**each.stiffness, **half(table)}, speeds=(0.0, 1440.0))
        for each in rigid.supports
    ]
    spindle = replace(rigid, supports=tuple(ends))
    asked: dict[str, Any] = {"conditions": RIGID, "run_up": (0.5, 100.0)}
    found = solved(spindle, [0.0, 1440.0], Unbalance("disc", U), **asked)
    assert found.run_outcome[0] == ""
    assert np.nanmax(found.run_amplitude[0]) < 0.1
    told = r"the motion is unstable and exceeds 100 mm, from (\d+) rpm on"
    said = re.fullmatch(told, found.run_outcome[1])
    assert said
    mass, acceleration = rotor_inertia(rigid).mass, 1440.0 / 100.0

    def slope(t: float, x: Any) -> list[complex]:
        spin = acceleration * t
        force = U * (spin**2 - 1j * acceleration) * np.exp(0.5j * spin * t)
        swirl = 6j * limit * spin / 1440.0
        return [x[1], (force - C * x[1] - (K - swirl) * x[0]) / mass]

    def wide(_: float, x: Any) -> float:
        return float(abs(x[0])) - 0.1

    wide.terminal = True  # type: ignore[attr-defined]
    span, still = (0.0, 100.0), np.zeros(2, dtype=complex)
    path = solve_ivp(slope, span, still, "DOP853", events=wide, rtol=1e-8, atol=1e-12)
    assert float(said[1]) * RPM == pytest.approx(acceleration * path.t[-1], rel=2e-3)
    assert np.isnan(found.run_amplitude[1]).all()
    (sentence,) = (each for each in unbalance_warnings(found) if "no solution" in each)
    begin = "unbalance: the run up in 100 s has no solution: the motion is unstable"
    assert sentence.startswith(begin)


@pytest.mark.parametrize(("damping", "begin"), [(C, 190.0), (0.0, 100.0)])
def test_where_growth_begins_is_solved_for_between_two_speeds(damping: float, begin: float) -> None:
    """Follower stiffness that is 0 up to 100 rad/s and 10 c ω at 1000: it is c ω at 190. Without
    damping any makes motion grow."""
    rigid = on_two(block(K, K), block(damping, damping))
    natural = math.sqrt(K / rotor_inertia(rigid).mass)
    at, limit = (0.0, 100.0, 1000.0), C * natural
    table = {("y", "z"): (0.0, 0.0, 10.0 * limit), ("z", "y"): (0.0, 0.0, -10.0 * limit)}
    ends = [
        replace(each, stiffness={**each.stiffness, **half(table)}, speeds=at)
        for each in rigid.supports
    ]
    spindle = replace(rigid, supports=tuple(ends))
    found = solved(spindle, [0.0, 1000.0], Unbalance("disc", U), conditions=RIGID)
    assert found.unstable_from == pytest.approx([begin], rel=1e-4)
    assert found.unstable_to == pytest.approx([1000.0])


def test_runs_tell_of_unstable_speeds_between_those_of_the_case() -> None:
    """Follower stiffness that rises from 0 at 100 rad/s to 3 c ω at 250 and falls to 0 at 400."""
    rigid = on_two(block(K, K), block(C, C))
    mass = rotor_inertia(rigid).mass
    natural = math.sqrt(K / mass)
    q = 1.5 * C * natural * np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    table = {("y", "z"): tuple(q.tolist()), ("z", "y"): tuple((-q).tolist())}
    at, ends = (0.0, 100.0, 250.0, 400.0, 500.0), []
    for support in rigid.supports:
        ends.append(replace(support, stiffness={**support.stiffness, **table}, speeds=at))
    spindle = replace(rigid, supports=tuple(ends))
    asked: dict[str, Any] = {"conditions": RIGID, "run_up": (1.0,)}
    found = solved(spindle, [0.0, 500.0], Unbalance("disc", U), **asked)
    assert not found.unstable.any()
    assert found.unstable_from == pytest.approx([150.0], abs=0.5)
    assert found.unstable_to == pytest.approx([350.0], abs=0.5)
    assert found.unstable_pole.real == pytest.approx([C / mass], rel=0.1)
    assert found.unstable_pole.imag == pytest.approx([natural], rel=0.01)
    ends = [f"{each[0] / RPM:.0f}" for each in (found.unstable_from, found.unstable_to)]
    told = unbalance_warnings(replace(found, run_error=np.array([0.5])))
    assert "without those at which the machine is unstable" in told[0]
    grows = f"vibrates at {natural / (2.0 * math.pi):.3g}"
    assert f"is unstable: from about {ends[0]} to {ends[1]} rpm it {grows}" in told[1]
    calm = solved(rigid, [0.0, 500.0], Unbalance("disc", U), **asked)
    assert not calm.unstable_from.size
    assert not unbalance_warnings(calm)


@pytest.mark.parametrize("damped", [1.0, 1e-2])
@pytest.mark.parametrize("count", [2, 5])
def test_no_peak_between_the_speeds_of_the_case_is_missed(damped: float, count: int) -> None:
    """A mass on springs: |r| = U Ω² / |K − M Ω² + i C Ω|, highest at Ω² = ω² / (1 − 2 ζ²)."""
    spindle = on_two(block(K, K), block(damped * C, damped * C))
    mass = rotor_inertia(spindle).mass
    critical, half = math.sqrt(K / mass), damped * C / (2.0 * math.sqrt(K * mass))
    speeds = np.linspace(0.21, 2.3, count) * critical
    result = solved(spindle, speeds.tolist(), Unbalance("disc", U), conditions=RIGID)
    top = critical / math.sqrt(1.0 - 2.0 * half**2)
    largest = U / (2.0 * mass * half * math.sqrt(1.0 - half**2))
    assert np.nanmax(result.fine_major_axis) == pytest.approx(largest, rel=1e-3)
    assert result.peak_amplitude[0] == pytest.approx([largest], rel=1e-3)
    assert result.peak_speed[0] == pytest.approx([top], rel=1e-3 + half)
    np.testing.assert_array_equal(result.speed, speeds)
    spin = result.fine_speed
    exact = spin**2 * U / np.abs(K - mass * spin**2 + 1j * damped * C * spin)
    np.testing.assert_allclose(result.fine_major_axis[:, 0], exact, rtol=1e-6)
    text = " ".join(unbalance_lines(result))
    assert f"{largest * 1e6:.3g}"[:3] in text


@pytest.mark.parametrize("half", [0.02, 0.1, 0.2])
def test_a_round_orbit_has_one_peak_at_its_place(half: float) -> None:
    """|y| and |z| of the major half axis have the same peak, at Ω² = ω² / (1 − 2 ζ²), however flat
    it is."""
    mass = rotor_inertia(on_two(block(K, K), block(0.0, 0.0))).mass
    critical, damper = math.sqrt(K / mass), 2.0 * half * math.sqrt(K * mass)
    spindle = on_two(block(K, K), block(damper, damper))
    for count in (2, 5, 400):
        speeds = (np.linspace(0.21, 2.3, count) * critical).tolist()
        result = solved(spindle, speeds, Unbalance("disc", U), conditions=RIGID)
        top = critical / math.sqrt(1.0 - 2.0 * half**2)
        assert result.peak_speed[0] == pytest.approx([top], rel=1e-4)


def test_rest_is_no_steady_response() -> None:
    """Without damping, at rest and at the critical speed: nothing acts at rest."""
    spindle = on_two(block(K, K), block(0.0, 0.0))
    critical = math.sqrt(K / rotor_inertia(spindle).mass)
    with pytest.raises(
        NoSolution, match="steady response to unbalance: an undamped critical speed"
    ):
        solved(spindle, [0.0, critical], Unbalance("disc", U), conditions=RIGID)


def test_critical_speed_without_damping() -> None:
    """Only there is no response, and the outcome says why."""
    spindle = on_two(block(K, K), block(0.0, 0.0))
    critical = math.sqrt(K / rotor_inertia(spindle).mass)
    result = solved(spindle, [0.9 * critical, critical], Unbalance("disc", U), conditions=RIGID)
    assert result.outcome[0] == ""
    assert "undamped" in result.outcome[1]
    assert np.isfinite(result.displacement[0]).all()
    assert np.isnan(result.displacement[1]).all()


def test_orbits_and_forces_have_no_limit_there_and_curves_break() -> None:
    """Beside it y and the force of both supports are those of a mass on springs."""
    spindle = on_two(block(K, K), block(0.0, 0.0))
    mass = rotor_inertia(spindle).mass
    critical = math.sqrt(K / mass)
    speeds = [0.8 * critical, 1.1 * critical]
    result = solved(spindle, speeds, Unbalance("disc", U), conditions=RIGID)
    assert np.isinf(result.peak_amplitude).all()
    assert result.force_unbounded == pytest.approx([critical, critical])
    text = " ".join(unbalance_lines(result)).replace("\u00a0", " ")
    rpm = critical * 30.0 / math.pi
    assert text.count(f"unbounded at {rpm:.0f} rpm, undamped") == 3
    size, force = result.fine_major_axis[:, 0], result.fine_force_amplitude
    broken = np.isnan(size)
    assert broken.any()
    assert (np.abs(result.fine_speed[broken] / critical - 1.0) < 1e-4).all()
    assert (np.isnan(force) == broken[:, None]).all()
    spin = result.fine_speed[~broken]
    exact = spin**2 * U / np.abs(K - mass * spin**2)
    np.testing.assert_allclose(size[~broken], exact, rtol=1e-6)
    np.testing.assert_allclose(force[~broken], 0.5 * K * exact[:, None] * [1, 1], rtol=1e-6)
    damped = solved(on_two(block(K, K), block(C, C)), speeds, Unbalance("disc", U))
    assert np.isnan(damped.force_unbounded).all()


def test_nothing_moves_at_rest() -> None:
    result = solved(on_two(block(K, K), block(C, C)), [0.0, 100.0], Unbalance("disc", U))
    assert not result.displacement[0].any()
    assert not result.force[0].any()


def test_a_point_that_symmetry_holds_at_rest_has_no_error() -> None:
    """Beside a couple of two unbalances the middle moves by rounding alone."""
    spindle = on_two(block(K, K), block(C, C))
    couple = Unbalance(0.2, U), Unbalance(0.8, U, math.pi)
    places = {"ahead": 0.2, "disc": 0.5}
    spindle = replace(spindle, points=places)
    result = solved(spindle, [100.0, 300.0], *couple, points=tuple(places), run_up=(1.0,))
    middle, moved = result.fine_major_axis[:, 1].max(), result.fine_major_axis[:, 0].max()
    assert middle < 1e-8 * moved
    assert result.error.max() < 1e-5
    assert result.run_error.max() < 1e-3


@pytest.mark.few(2)
@pytest.mark.parametrize("element", [0.25, 0.1, 0.05])
@pytest.mark.parametrize("ratio", [1.0, 1.5])
def test_estimated_error_is_the_true_one(element: float, ratio: float) -> None:
    """Standard elements against fine ones, in the complex form and in both planes."""
    spindle = on_two(block(K, ratio * K), block(C, C))
    speed = np.linspace(300.0, 1500.0, 30)
    coarse = solved(
        spindle, speed, Unbalance(0.2, U), conditions=Conditions(element_length=element)
    )
    fine = solved(spindle, speed, Unbalance(0.2, U), conditions=Conditions(accuracy=1e-7))
    off = np.abs(coarse.displacement - fine.displacement).max() / np.abs(fine.displacement).max()
    assert off / 3.0 < coarse.error[0] < 3.0 * off


@pytest.mark.parametrize("rotor", ["rigid", "flexible"])
def test_pedestals_in_closed_form(rotor: str) -> None:
    """A rotor that moves in parallel on equal pedestals: the force of a support is that of its
    spring and damper over the difference of two motions, m and M in a row for each direction."""
    own, ground, c0 = 10.0, 0.8 * K, 120.0
    pedestals = tuple(
        RigidHousing(f"under {name}", (name,), x, own, block(ground, 2 * ground), block(c0, 0.0))
        for name, x in (("left", 0.0), ("right", 1.0))
    )
    stiff = times(STEEL, young_modulus=1e7)
    spindle = on_two(block(K, K), block(C, C), stiff, housings=pedestals)
    mass = rotor_inertia(spindle).mass
    speed = np.linspace(10.0, 2.5 * math.sqrt(K / mass), 30)
    result = solved(
        spindle, speed, Unbalance("disc", U), conditions=Conditions(rotor=rotor, accuracy=1e-6)
    )
    for plane, (held, damped) in enumerate(((ground, c0), (2 * ground, 0.0))):
        for row, spin in enumerate(speed):
            spring = K / 2 + 0.5j * spin * C
            below = held + 1j * spin * damped - own * spin**2
            matrix = [[spring - mass / 2 * spin**2, -spring], [-spring, spring + below]]
            moved, under = np.linalg.solve(matrix, [U / 2 * spin**2 * (1, -1j)[plane], 0.0])
            met = result.displacement[row, 0, plane], *result.force[row, :, plane]
            closed = moved, *[-spring * (moved - under)] * 2
            np.testing.assert_allclose(met, closed, rtol=1e-9 if rotor == "rigid" else 2e-5)


@pytest.mark.long
@pytest.mark.parametrize("along", [False, True], ids=["apart", "coupled"])
def test_critical_speeds_are_those_of_the_campbell_diagram_without_its_other_work(
    along: bool,
) -> None:
    """By name, speed and damping ratio; subsystems without bending are not solved."""
    spindle = rotordyn.load("friswell_unbalance").variants["even"].spindle
    assert spindle is not None
    if along:
        ties = {("x", "x"): 1e5, ("x", "y"): 2e3, ("y", "x"): 2e3}
        spindle = replace(spindle, supports=(*spindle.supports, LinearSupport("tie", 0.3, ties)))
    top, band, places = 4000.0 * RPM, 200.0, tuple(spindle.places.values())
    whole = Scene(spindle, Conditions(), np.array([0.0, 0.5 * top, top]), band, places)
    found = unbalance.solve(whole, UnbalanceSpec(("left_disc",), (Unbalance("left_disc", U),)))
    touched = set().union(*(own.linear.kinds for own in whole.systems.values()))
    assert touched == ({"bending", "axial"} if along else {"bending"})
    other = Scene(spindle, Conditions(), whole.speed, band, places)
    spec = CampbellSpec(1.2 * top / (2.0 * math.pi), shapes=False)
    modes = campbell.solve(other, spec)
    own = modes.critical_excited
    assert own.sum() >= 2
    assert found.critical == tuple(np.array(modes.critical)[own])
    np.testing.assert_allclose(found.critical_speed, modes.critical_speed[own], rtol=1e-9)
    np.testing.assert_allclose(
        found.critical_damping, modes.critical_damping[own], rtol=1e-6, atol=1e-12
    )


@pytest.mark.parametrize("pole", [-1.0 + 100.0j, 1.0 + 100.0j])
def test_ends_of_growth_that_rounding_alone_tells_apart_are_those_known(monkeypatch, pole):
    """Solved again, both speeds decay, or both grow."""
    monkeypatch.setattr(growth, "slowest_pole", lambda scene, spec: np.array([pole]))
    anywhere = SimpleNamespace(at=lambda speed: SimpleNamespace(outcome=("",)))
    assert growth._edge(anywhere, None, 100.0, 200.0) == 200.0
