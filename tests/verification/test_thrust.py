"""A thrust ball bearing: contacts along the axis, closed forms, balls thrown out at speed."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

import bearings
import rotordyn
from bearings import Follower, InvalidBearing, ThrustBallBearing
from bearings.geometry import geometry
from bearings.ring.motion import ball_motion, contact_motion
from rotordyn.analyses.bearing.solve import solve
from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.scene.conditions import Conditions

BEARING = ThrustBallBearing(ball_diameter=10.3e-3, pitch_diameter=64e-3, balls=16)
THRUST = np.array([5000.0, 0.0, 0.0, 0.0, 0.0])


def test_thrust_at_rest_is_hertz_on_every_ball() -> None:
    s = BEARING.equilibrium(load=THRUST)
    k = geometry(BEARING.grooves).series_stiffness
    share = 5000.0 / 16
    assert s.displacement[0] == pytest.approx((share / k) ** (2.0 / 3.0), rel=1e-9)
    assert s.contact_load == pytest.approx(share)
    assert s.contact_angle == pytest.approx(math.pi / 2.0)
    assert s.stiffness()[0, 0] == pytest.approx(1.5 * 5000.0 / s.displacement[0], rel=1e-9)


def test_tilting_stiffness_is_that_of_a_ring_of_springs() -> None:
    """Axial springs c on a circle of radius dm/2 give z c (dm/2)²/2 against tilt."""
    k = BEARING.equilibrium(load=THRUST).stiffness()
    assert k[3, 3] == pytest.approx(0.5 * k[0, 0] * 0.032**2, rel=1e-9)
    assert k[3, 3] == pytest.approx(k[4, 4])


def test_balls_are_thrown_out_between_the_grooves() -> None:
    """Fc tilts both contact lines: Qo cos αo − Qi cos αi = Fc, α from the radial direction."""
    s = BEARING.equilibrium(load=THRUST, speed=600.0, kinematics="outer", dynamics="frozen")
    force = s.outer_load * np.cos(s.outer_angle) - s.inner_load * np.cos(s.inner_angle)
    assert force == pytest.approx(s.centrifugal_force, rel=1e-9)
    assert (s.outer_angle < math.pi / 2.0).all()
    assert (s.inner_angle > math.pi / 2.0).all()


@pytest.mark.parametrize("kinematics", ["hybrid", "outer", "inner", "geometric"])
def test_tangent_at_speed(kinematics: str) -> None:
    load = THRUST + np.array([0.0, 0.0, 0.0, 20.0, -10.0])
    s = BEARING.equilibrium(load=load, speed=500.0, kinematics=kinematics)
    difference = bearings.stiffness(s, "difference")
    assert np.abs(difference - s.stiffness()).max() < 1e-6 * np.abs(difference).max()


def test_control_of_either_race_is_its_mirror_image() -> None:
    """At low speed races of 90° are alike: inner control rolls on the inner race, spins on the
    outer one and carries as much oil along, its axis is inclined as much beyond 90° as that of
    outer control is below."""
    outer, inner = (
        BEARING.equilibrium(load=THRUST, speed=1.0, kinematics=way) for way in ("outer", "inner")
    )
    by_outer, by_inner = contact_motion(outer), contact_motion(inner)
    assert by_inner.entrainment == pytest.approx(by_outer.entrainment[:, ::-1], rel=1e-6)
    assert by_inner.spin == pytest.approx(-by_outer.spin[:, ::-1], abs=1e-6)
    angles = [ball_motion(each).attitude for each in (outer, inner)]
    assert sum(angles) == pytest.approx(math.pi, abs=1e-6)
    assert angles[1] == pytest.approx(math.pi - math.atan(64.0 / 10.3), abs=1e-6)


def test_inclined_axes_beyond_90_degrees_are_results_of_the_bearing() -> None:
    spec = BearingMapSpec((THRUST[0],))
    found = solve(BEARING, Conditions(kinematics="inner"), np.array([1.0]), spec)
    expected = math.pi - math.atan(64.0 / 10.3)
    assert np.asarray(found.attitude).ravel() == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(
    ("load", "sentence"),
    [
        ([5000.0, 10.0, 0.0, 0.0, 0.0], "carries no radial load: got 10 N.*displacement"),
        ([-5.0, 0.0, 0.0, 0.0, 0.0], r"axial load towards \+x only: got -5 N"),
        ([100.0, 0.0, 0.0, 100.0, 0.0], "under 100 N of thrust .* got 100 N·m; raise the thrust"),
        ([0.0, 0.0, 0.0, 0.0, 1.0], "a moment up to 0 N·m"),
    ],
)
def test_loads_it_cannot_carry(load: list[float], sentence: str) -> None:
    with pytest.raises(InvalidBearing, match=sentence):
        BEARING.equilibrium(load=load)
    with pytest.raises(InvalidBearing, match=sentence):
        Follower(BEARING).displacement(load)


@pytest.mark.parametrize("part", [0.0, 0.3, 0.5, 1.0, 1.4])
def test_the_largest_moment(part: float) -> None:
    """Balls carry what acts within their polygon: the ring still stands just below the limit that
    is named, and the balls of one side or corner alone hold it."""
    psi = (3.0 + part) * 2.0 * math.pi / BEARING.balls
    way = np.array([0.0, 0.0, 0.0, math.sin(psi), -math.cos(psi)])
    with pytest.raises(InvalidBearing, match="moment up to") as caught:
        BEARING.equilibrium(load=np.array([5000.0, 0, 0, 0, 0]) + 1e3 * way)
    limit = float(re.findall(r"up to ([\d.]+) N·m", str(caught.value))[0])
    half, turn = math.pi / BEARING.balls, part % 1.0 * 2.0 * math.pi / BEARING.balls
    edge = 0.5 * BEARING.pitch_diameter * math.cos(half) / math.cos(turn - half)
    assert limit == pytest.approx(5000.0 * edge, rel=1e-3)
    s = BEARING.equilibrium(load=np.array([5000.0, 0, 0, 0, 0]) + 0.99 * limit * way)
    assert s.inner_load.sum() - np.sort(s.inner_load)[-2:].sum() < 0.2 * s.inner_load.sum()


def test_a_load_that_it_cannot_carry_is_named_where_it_is(tmp_path: Path) -> None:
    """Among those of a case that it can."""
    head = "title: t\nspeeds: [0 rpm]\nbearing: thrust_50x78x22\nanalyses:\n  bearing:\n"
    path = tmp_path / "case.yaml"
    for key, given, beside, sentence in (
        ("moments", "[0 N m, 170 N m]", "axial_load: 5 kN", "carries a moment up to 160"),
        ("radial_loads", "[0 N, 10 N]", "axial_load: 5 kN", "carries no radial load: got 10 N"),
        ("axial_load", "-5 kN", "moments: [0 N m]", "towards .x only: got -5000 N"),
        ("radial_load", "10 N", "loads: [5 kN]", "carries no radial load: got 10 N"),
    ):
        path.write_text(f"{head}    {beside}\n    {key}: {given}\n", encoding="utf-8")
        with pytest.raises(
            rotordyn.InvalidInput, match=rf"7:\d+: analyses.bearing.{key}: .*{sentence}"
        ):
            rotordyn.load(path)
