"""Limits with a closed form: lost contact, rest, equal angles, slow and fast."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from bearings import AngularContactBallBearing, NoEquilibrium, ThrustBallBearing
from bearings.ball.potential import riding_radius
from bearings.geometry import geometry
from bearings.ring import followed_stage, tolerances
from tests.oracles.ball_bearing import BallBearingOracle, rolling
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, ISO_DEEP_GROOVE, RPM, VEX70

FAST = 30000.0 * RPM


def resting_on_the_outer_race(
    oracle: BallBearingOracle, a1: float, a2: float, speed: float
) -> tuple[float, float]:
    """(Fc, reach to the inner groove centre) of a ball at the bottom of the outer groove.

    Self-consistent: Fc sets the depth, the depth the direction αi, αi the orbit (β = αo = 0).
    """
    depth = oracle.lo
    for _ in range(50):
        orbit, _, _ = rolling(math.atan2(a1, a2 - depth), 0.0, oracle.g, 0.0, "outer")
        fc = 0.5 * oracle.mass * oracle.bearing.pitch_diameter * (speed * float(orbit)) ** 2
        depth = oracle.lo + (fc / oracle.outer.k) ** (2 / 3)
    return fc, math.hypot(a1, a2 - depth)


def limit_travel(oracle: BallBearingOracle, speed: float) -> float:
    """δx at which a ball just touches both races."""
    low, high = -0.4e-3, 0.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        reach = resting_on_the_outer_race(oracle, oracle.a1 + middle, oracle.a2, speed)[1]
        low, high = (low, middle) if reach > oracle.li else (middle, high)
    return 0.5 * (low + high)


@pytest.mark.parametrize("kinematics", ["outer", "hybrid"])
@pytest.mark.parametrize("speed", [8000.0 * RPM, FAST])
def test_limit_of_lost_contact(kinematics: str, speed: float) -> None:
    """A1² + (A2 − (fo−½)D − (Fc/ko)^⅔)² ≤ ((fi−½)D)² (Noël 2.19)."""
    limit = limit_travel(BallBearingOracle(VEX70), speed)
    nudge = np.array([-1e-8, 1e-8])
    given = (limit + nudge)[:, None] * np.array([1.0, 0, 0, 0, 0])
    s = VEX70.equilibrium(displacement=given, speed=speed, kinematics=kinematics)
    assert (s.status[0] == "lost contact").all()
    assert (s.inner_load[0] == 0.0).all()
    assert (s.status[1] == "loaded").all()
    assert (s.inner_load[1] > 0.0).all()
    assert s.inner_load[1].max() < 1.0


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_lost_balls_ride_the_outer_race(kinematics: str) -> None:
    """Qi = 0, Qo = Fc, αo = 0, Mg = 0; nothing on the inner ring and no stiffness."""
    oracle = BallBearingOracle(VEX70)
    travel = limit_travel(oracle, FAST) - 5e-6
    s = VEX70.equilibrium(displacement=[travel, 0, 0, 0, 0], speed=FAST, kinematics=kinematics)
    fc, _ = resting_on_the_outer_race(oracle, oracle.a1 + travel, oracle.a2, FAST)
    assert (s.status == "lost contact").all()
    assert (s.inner_load == 0.0).all()
    assert (s.inner_pressure == 0.0).all()
    assert s.centrifugal_force == pytest.approx(fc, rel=1e-9)
    assert s.outer_load == pytest.approx(fc, rel=1e-9)
    assert s.outer_angle == pytest.approx(0.0, abs=1e-12)
    assert s.gyroscopic_moment == pytest.approx(0.0, abs=1e-15)
    assert s.load == pytest.approx(0.0, abs=1e-12)
    assert s.stiffness() == pytest.approx(0.0, abs=1e-9)


def test_orbit_of_a_lost_ball_is_not_that_of_the_free_angle() -> None:
    """(1 − γ cos α)/2 instead of the self-consistent αi would be far off at 30 000 rpm."""
    travel = limit_travel(BallBearingOracle(VEX70), FAST) - 5e-6
    s = VEX70.equilibrium(displacement=[travel, 0, 0, 0, 0], speed=FAST)
    oracle = BallBearingOracle(VEX70)
    naive = 0.5 * (1.0 - oracle.g * math.cos(VEX70.contact_angle))
    wrong = 0.5 * oracle.mass * VEX70.pitch_diameter * (FAST * naive) ** 2
    assert abs(wrong / s.centrifugal_force[0] - 1.0) > 0.05


@pytest.mark.parametrize("travel", [0.0, -20e-6])
def test_unloaded_at_rest(travel: float) -> None:
    """d = 0 is f = 0, static growth included; pulled off, too."""
    for growth in (0.0, 20e-6):
        s = VEX70.equilibrium(displacement=[travel, 0, 0, 0, 0], static_growth=growth)
        assert s.load == pytest.approx(0.0, abs=1e-9)
        assert s.inner_load == pytest.approx(0.0, abs=1e-9)
        assert s.outer_load == pytest.approx(0.0, abs=1e-9)
        assert np.isfinite(s.stiffness()).all()
    assert (s.status == "unloaded").all()


def test_zero_displacement_at_speed_carries_the_growth() -> None:
    """With Δu ≠ Δu0 the ring is loaded at d = 0: A1 is zeroed at rest, A2 carries Δu."""
    rest = VEX70.equilibrium(displacement=np.zeros(5), static_growth=5e-6, growth=12e-6)
    same = VEX70.equilibrium(displacement=np.zeros(5), static_growth=5e-6)
    assert same.load[0] == pytest.approx(0.0, abs=1e-9)
    oracle = BallBearingOracle(VEX70, static_growth=5e-6, growth=12e-6)
    assert rest.load == pytest.approx(oracle.from_displacement(np.zeros(5), 0.0).load, rel=1e-9)
    assert rest.load[0] > 1.0


@pytest.mark.parametrize("bearing", [VEX70, HARRIS_218], ids=["VEX70", "218"])
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_orbit_at_equal_angles(bearing: AngularContactBallBearing, kinematics: str) -> None:
    """ωm/ω = (1 − γ cos α)/2, whatever the hypothesis."""
    s = bearing.equilibrium(load=[2000.0, 0, 0, 0, 0], speed=1.0, kinematics=kinematics)
    oracle = BallBearingOracle(bearing)
    orbit = np.sqrt(2.0 * s.centrifugal_force / (oracle.mass * bearing.pitch_diameter))
    assert s.inner_angle == pytest.approx(s.outer_angle, abs=1e-5)
    expected = 0.5 * (1.0 - oracle.g * np.cos(s.inner_angle))
    assert orbit == pytest.approx(expected, rel=1e-6)


def test_gyroscopic_moments_of_outer_and_inner_control_at_equal_angles() -> None:
    """Their ratio is (1 + γ cos α)/(1 − γ cos α) at equal angles; geometric lies between."""
    moment, angle = {}, 0.0
    for kinematics in HYPOTHESES:
        s = VEX70.equilibrium(load=[2000.0, 0, 0, 0, 0], speed=1.0, kinematics=kinematics)
        moment[kinematics], angle = s.gyroscopic_moment[0], s.inner_angle[0]
    g = VEX70.ball_diameter / VEX70.pitch_diameter * math.cos(angle)
    ratio = moment["inner"] / moment["outer"]
    assert ratio == pytest.approx((1 + g) / (1 - g), rel=1e-5)
    assert moment["outer"] < moment["hybrid"] < moment["inner"]
    assert moment["outer"] < moment["geometric"] < moment["inner"]


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_slow_rotation_approaches_rest(kinematics: str) -> None:
    load = [1000.0, 250.0, 0.0, 1.0, 2.0]
    rest = VEX70.equilibrium(load=load)
    slow = VEX70.equilibrium(load=load, speed=1.0, kinematics=kinematics)
    assert slow.displacement == pytest.approx(rest.displacement, rel=1e-4, abs=1e-10)
    assert slow.inner_load == pytest.approx(rest.inner_load, rel=1e-4)
    assert slow.stiffness() == pytest.approx(
        rest.stiffness(), rel=1e-4, abs=1e-5 * np.abs(rest.stiffness()).max()
    )


def test_very_heavy_load_makes_speed_forgettable() -> None:
    load = [60000.0, 0, 0, 0, 0]
    rest = VEX70.equilibrium(load=load).stiffness()
    fast = VEX70.equilibrium(load=load, speed=5000.0 * RPM).stiffness()
    assert np.abs(fast - rest).max() < 1e-2 * np.abs(rest).max()


def test_pressure_from_load() -> None:
    """p = 3 Q/(2 π a b) at both races."""
    s = VEX70.equilibrium(load=[1500.0, 300.0, 0, 0, 0], speed=FAST / 2)
    oracle = BallBearingOracle(VEX70)
    for load, peak, race in (
        (s.inner_load, s.inner_pressure, oracle.inner),
        (s.outer_load, s.outer_pressure, oracle.outer),
    ):
        area = math.pi * race.a1 * race.b1 * load ** (2 / 3)
        assert peak == pytest.approx(1.5 * load / area, rel=1e-9)


def test_deep_groove_at_rest_by_hand() -> None:
    """Three loaded balls of seven: Q = kn (δ cos ψ)^1.5, F = Σ Q cos ψ."""
    oracle = BallBearingOracle(ISO_DEEP_GROOVE)
    travel = 15e-6
    psi = oracle.azimuths()
    load = oracle.kn * np.maximum(travel * np.cos(psi), 0.0) ** 1.5
    s = ISO_DEEP_GROOVE.equilibrium(displacement=[0.0, travel, 0, 0, 0])
    assert s.inner_load == pytest.approx(load, rel=1e-10, abs=1e-9)
    assert s.load[1] == pytest.approx(load @ np.cos(psi), rel=1e-10)
    # of a kind that takes thrust one way: in the middle of the groove nothing keeps the side
    assert (s.status == np.where(load > 0.0, "open side", "unloaded")).all()


@pytest.mark.parametrize("compiled", [False, True])
def test_balls_under_light_loads_tend_to_rigid_ones(compiled: bool) -> None:
    """At rest from 1 N down to 1 µN: where three balls or more fix the ring, it tends to its place
    between rigid balls with the approach of the contacts, as load^(2/3)."""
    fixed = [[1, 2, 0, 0, 0], [0, 0, 0, 0.05, 0], [1, 0, 0, 0.01, 0.01], [0.3, 1, 0.2, 0.01, 0]]
    free = [[0, 1, 0.1, 0, 0], [0, 1, 0, 0, 0]]  # a place of the ring where two balls carry
    size = 10.0 ** np.arange(0.0, -7.0, -1.0)
    s = VEX70.equilibrium(load=size[:, None, None] * np.array(fixed + free), compiled=compiled)
    assert (s.outcome == "").all()
    steps = np.abs(np.diff(s.displacement[:, :4], axis=0)).max(axis=-1)
    assert steps[:-1] / steps[1:] == pytest.approx(np.full((5, 4), 10.0 ** (2 / 3)), rel=0.02)


@pytest.mark.parametrize("force", [1e-3, 5.0, 800.0])
def test_a_ball_that_rides_the_outer_race_is_pressed_in_by_hertz(force: float) -> None:
    """Fc = K δ^1.5 beyond the place where it just touches."""
    c = geometry(VEX70.grooves)
    pressed = riding_radius(c, force) - c.outer_centre_distance
    assert c.outer.stiffness * pressed**1.5 == pytest.approx(force, rel=1e-9)


def test_a_refusal_takes_a_bounded_number_of_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """A thrust bearing under a moment: its rings move far across the axis, and steps are short."""
    calls = 0
    whole = followed_stage.corrected

    def counted(*state: Any) -> Any:
        nonlocal calls
        calls += 1
        return whole(*state)

    monkeypatch.setattr(followed_stage, "corrected", counted)
    bearing = ThrustBallBearing(ball_diameter=12.7e-3, pitch_diameter=70e-3, balls=13)
    with pytest.raises(NoEquilibrium):
        bearing.equilibrium(load=[800.0, 0.0, 0.0, 2.0, -3.0], speed=4000.0)
    assert 0 < calls <= tolerances.MOST_STRIDES
