"""Deep-groove bearings: clearance, thrust both ways, radial load, speed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from bearings import DeepGrooveBallBearing, InvalidBearing
from tests.oracles.four_point import Drawing, GrooveOracle
from tests.oracles.groove_balance import balanced
from tests.oracles.known_bearings import HYPOTHESES, RPM, SHARINGS
from tests.oracles.known_grooves import (
    CLEARANCE,
    angular_contact,
    common,
    deep_groove,
    drawn_6210,
)

STEEL, HYBRID = drawn_6210(), drawn_6210(hybrid=True)
DRAWN = pytest.mark.parametrize("drawing", [STEEL, HYBRID], ids=["steel", "hybrid"])
BOTH = pytest.mark.parametrize("dynamics", ["frozen", "resultant"])


@pytest.mark.parametrize("clearance", [0.0, 5e-6, 20e-6, 60e-6])
def test_clearance_and_contact_angle_say_the_same(clearance: float) -> None:
    """cos α = 1 − Pd/(2 BD); the rings move by Pd/2 either way and by BD sin α along the axis."""
    drawing = drawn_6210(clearance)
    b = DeepGrooveBallBearing(**common(drawing), radial_clearance=clearance)
    assert b.free_angle == pytest.approx(drawing.contact_angle, abs=1e-12)
    axial = drawing.free_distance * math.sin(drawing.contact_angle)
    for travel, freedom in ((0.5 * clearance, 1), (axial, 0)):
        for way in (1.0, -1.0):
            for beyond in (-1e-8, 1e-8):
                if travel + beyond < 0.0:
                    continue
                d = way * (travel + beyond) * np.eye(5)[freedom]
                carried = b.equilibrium(displacement=d).contact_load.max() > 1e-6
                if freedom == 1 or clearance > 0.0:
                    assert carried == (beyond > 0.0)


@DRAWN
@BOTH
@pytest.mark.parametrize("rpm", [0.0, 12000.0])
def test_thrust_both_ways_is_odd(drawing: Drawing, dynamics: str, rpm: float) -> None:
    load = np.outer([300.0, 3000.0, -300.0, -3000.0], np.eye(5)[0])
    s = deep_groove(drawing).equilibrium(load=load, speed=rpm * RPM, dynamics=dynamics)
    assert (s.outcome == "").all()
    travel = s.displacement[:, 0]
    assert travel[2:] == pytest.approx(-travel[:2], rel=1e-10)
    assert s.inner_load[2:] == pytest.approx(s.inner_load[:2], rel=1e-10)
    assert s.inner_angle[2:] == pytest.approx(-s.inner_angle[:2], rel=1e-10)
    assert (s.inner_angle[:2] > 0.0).all()
    assert s.stiffness()[2:, 0, 0] == pytest.approx(s.stiffness()[:2, 0, 0], rel=1e-9)


@DRAWN
@pytest.mark.parametrize("clearance", [0.0, 20e-6, -4e-6])
def test_radial_load_at_rest(drawing: Drawing, clearance: float) -> None:
    """Q = kn (δ cos ψ − Pd/2)^1.5 on a line of centres that stays radial; sums over the ring."""
    b = DeepGrooveBallBearing(**common(drawing), radial_clearance=clearance)
    oracle = GrooveOracle(drawing_of(b, drawing))
    inner, outer = oracle.races
    kn = (inner.k ** (-2.0 / 3.0) + outer.k ** (-2.0 / 3.0)) ** -1.5
    cosine = np.cos(oracle.psi)

    def load(travel: float) -> float:
        return float(kn * np.maximum(travel * cosine - 0.5 * clearance, 0.0) ** 1.5 @ cosine)

    want = brentq(lambda travel: load(travel) - 4000.0, 0.0, 1e-3, xtol=1e-16, rtol=1e-14)
    nan = math.nan
    s = b.equilibrium(load=[nan, 4000.0, nan, nan, nan], displacement=[0.0, nan, 0.0, 0.0, 0.0])
    assert s.displacement[1] == pytest.approx(want, rel=1e-9)
    ball = kn * np.maximum(want * cosine - 0.5 * clearance, 0.0) ** 1.5
    assert s.inner_load == pytest.approx(ball, abs=1e-9 * ball.max())
    assert s.outer_load == pytest.approx(ball, abs=1e-9 * ball.max())


def drawing_of(b: DeepGrooveBallBearing, drawing: Drawing) -> Drawing:
    """The same with the angle that the stiffness of the contacts is taken at."""
    return replace(drawing, contact_angle=b.free_angle)


def test_preload_is_free_of_load_when_centred() -> None:
    b = DeepGrooveBallBearing(**common(STEEL), radial_clearance=-4e-6)
    s = b.equilibrium(displacement=np.zeros(5))
    assert (s.inner_load > 1.0).all()
    assert np.abs(s.load).max() < 1e-9 * s.inner_load.sum()
    assert np.ptp(s.inner_load) < 1e-9 * s.inner_load.max()


@pytest.mark.parametrize("sharing", SHARINGS)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_under_thrust_it_is_an_angular_contact_bearing(kinematics: str, sharing: str) -> None:
    """Of the same free angle, its zero BD sin α further; radial load and moment besides."""
    shift = STEEL.free_distance * math.sin(STEEL.contact_angle)
    load = [[3000.0, 0.0, 0.0, 0.0, 0.0], [4000.0, 800.0, -300.0, 3.0, 5.0]]
    how = dict(kinematics=kinematics, moment_sharing=sharing, speed=np.array([12e3, 8e3]) * RPM)
    ours = deep_groove(STEEL).equilibrium(load=load, **how)
    theirs = angular_contact(STEEL).equilibrium(load=load, **how)
    apart = (ours.displacement - theirs.displacement - shift * np.eye(5)[0]) * lever()
    assert np.abs(apart).max() < 1e-10 * np.abs(ours.displacement).max()
    top = theirs.outer_load.max()
    for name in ("inner_load", "outer_load", "centrifugal_force"):
        assert getattr(ours, name) == pytest.approx(getattr(theirs, name), abs=1e-10 * top)
    k = theirs.stiffness() / lever() / lever()[:, None]
    assert ours.stiffness() / lever() / lever()[:, None] == pytest.approx(
        k, abs=1e-8 * np.abs(k).max()
    )


def lever() -> np.ndarray:
    return GrooveOracle(STEEL).lever


@pytest.mark.few(2)
@DRAWN
@BOTH
def test_combined_loads_at_speed(drawing: Drawing, dynamics: str) -> None:
    """Lost and unloaded balls among them, against the joint convex formulation."""
    rng = np.random.default_rng(11)
    load = rng.uniform(-1.0, 1.0, (12, 5)) * [4e3, 5e3, 5e3, 20.0, 20.0]
    speed = rng.choice([0.0, 4e3, 12e3, 20e3], 12) * RPM
    how = dict(kinematics="outer", moment_sharing="equal")
    s = deep_groove(drawing).equilibrium(load=load, speed=speed, dynamics=dynamics, **how)
    assert (s.outcome == "").all()
    oracle = GrooveOracle(drawing, **how)
    for i in range(12):
        want = oracle.solve(load=load[i], speed=speed[i], dynamics=dynamics)
        top = want.contact_load.max()
        size = np.abs(want.displacement * oracle.lever).max()
        moved = (s.displacement[i] - want.displacement) * oracle.lever
        assert np.abs(moved).max() < 1e-7 * size
        assert s.inner_load[i] == pytest.approx(want.contact_load[:, 0], abs=1e-7 * top)
        assert s.outer_load[i] == pytest.approx(want.contact_load[:, 1], abs=1e-7 * top)
    found = balanced(oracle, s, dynamics)
    assert found.ball.max() < 1e-9
    assert found.ring.max() < 1e-9
    assert found.gap.max() < 1e-12 * drawing.ball_diameter


def test_contacts_are_one_a_race() -> None:
    s = deep_groove(STEEL).equilibrium(load=[0.0, 4000.0, 0.0, 0.0, 0.0])
    assert s.contact_load.shape == (10, 2)
    assert (s.contact_load[:, 0] == s.inner_load).all()
    assert s.contacts.max() == 2
    assert s.contacts.min() == 0


def test_the_clearance_of_these_tests() -> None:
    assert 2.0 * STEEL.free_distance * (1.0 - math.cos(STEEL.contact_angle)) == pytest.approx(
        CLEARANCE, rel=1e-9
    )


def test_the_largest_clearance_makes_45_degrees() -> None:
    most = 2.0 * STEEL.free_distance * (1.0 - math.cos(math.pi / 4.0))
    widest = DeepGrooveBallBearing(**common(STEEL), radial_clearance=most * (1.0 - 1e-9))
    assert widest.free_angle == pytest.approx(math.pi / 4.0, abs=1e-8)
    beyond = f"gives a contact angle above 45°: .* allowed up to {most * 1e6:.4g} µm"
    with pytest.raises(InvalidBearing, match=beyond):
        DeepGrooveBallBearing(**common(STEEL), radial_clearance=most * (1.0 + 1e-9))
