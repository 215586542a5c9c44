"""Contact ellipses against shoulders and groove middles."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import bearings
from bearings import DeepGrooveBallBearing, InvalidBearing
from bearings.geometry import geometry
from bearings.ring.truncation import share_outside
from tests.oracles.known_bearings import DEGREE, RPM, VEX70
from tests.oracles.known_grooves import (
    QJ218,
    R24_14,
    STEEL_PARTS,
    angular_contact,
    deep_groove,
    drawn_6210,
    four_point,
)

WITH_SHOULDERS = replace(
    four_point(QJ218), inner_shoulder_diameter=114e-3, outer_shoulder_diameter=136e-3
)
UNIT_THRUST = np.eye(5)[0]


def test_half_axes_of_a_published_contact() -> None:
    """Lacroix (2014), p 60: f 0.52, D 8 mm, 500 N, pitch 50–60 mm: a 1.05 mm, b 0.12 mm."""
    for pitch in (50e-3, 60e-3):
        b = DeepGrooveBallBearing(
            8e-3, pitch, 8, inner_conformity=0.52, contact_angle=0.0, **STEEL_PARTS
        )
        race = geometry(b.grooves).inner
        a, minor = (axis * np.cbrt(500.0) for axis in (race.semi_axis_major, race.semi_axis_minor))
        assert a * 1e3 == pytest.approx(1.05, abs=0.02)
        assert minor * 1e3 == pytest.approx(0.12, abs=0.005)


def test_pressure_is_the_load_over_the_ellipse() -> None:
    """p = 3 Q/(2 π a b) at every contact that bears load."""
    s = four_point(R24_14).equilibrium(load=[20e3, 12e3, 0, 0, 0], speed=1500 * RPM)
    t = bearings.truncation(s)
    loaded = s.contact_load > 0.0
    assert 0 < loaded.sum() < loaded.size
    area = math.pi * t.major[loaded] * t.minor[loaded]
    assert s.contact_pressure[loaded] == pytest.approx(1.5 * s.contact_load[loaded] / area)
    assert (t.major[~loaded] == 0.0).all()
    assert np.isnan(t.upper_end[~loaded]).all()


@pytest.mark.parametrize(
    ("ends", "bounds", "share"),
    [
        ((0.2, 0.6), (0.1, 0.7), 0.0),
        ((0.2, 0.6), (0.1, 0.5), 0.25),
        ((0.2, 0.6), (0.3, 0.5), 0.5),
        ((0.2, 0.6), (0.3, math.nan), 0.25),
        ((0.2, 0.6), (math.nan, 0.1), 1.0),
        ((math.nan, math.nan), (0.3, 0.5), 0.0),
        ((0.4, 0.4), (0.0, 0.1), 0.0),
    ],
)
def test_share_outside(
    ends: tuple[float, float], bounds: tuple[float, float], share: float
) -> None:
    values = [np.array(each) for each in (*ends, *bounds)]
    assert share_outside(*values) == pytest.approx(share)


def test_shoulder_angle_of_a_drawing() -> None:
    """Of the inner ring of the QJ 218, 114 mm: 59.6° (Lacroix 2014)."""
    assert WITH_SHOULDERS.grooves.shoulder_angles[0] / DEGREE == pytest.approx(59.6, abs=0.05)


def test_ellipse_of_qj218_passes_the_inner_shoulder_at_77_kn() -> None:
    """Rigid rings at rest; at 100 kN the share lost is the part of the arc beyond 59.6°."""

    def margin(thrust: float) -> float:
        s = WITH_SHOULDERS.equilibrium(load=thrust * UNIT_THRUST)
        return float(bearings.truncation(s).shoulder_margin[0, 0])

    assert brentq(margin, 60e3, 90e3) == pytest.approx(77e3, rel=5e-3)
    s = WITH_SHOULDERS.equilibrium(load=np.outer([70e3, 100e3], UNIT_THRUST))
    t = bearings.truncation(s)
    assert (t.lost[0] == 0.0).all()
    half = t.major[1, 0, 0] / (0.5167 * 22.225e-3)
    assert t.lost[1, 0, 0] == pytest.approx(
        (s.contact_angle[1, 0, 0] + half - t.shoulder_angle[0]) / (2.0 * half)
    )
    assert (t.lost[1, :, 3] == 0.0).all()
    light, heavy = bearings.condition(s).tolist()
    assert not light
    assert heavy == (
        "contact ellipse passes the shoulder of the inner ring (balls 0–14), 5.6 % of its length "
        "lost"
    )
    unknown = four_point(QJ218).equilibrium(load=100e3 * UNIT_THRUST)
    assert not str(bearings.condition(unknown))
    assert np.isnan(bearings.truncation(unknown).shoulder_margin).all()


def test_top_of_the_ellipse_of_r24_14_under_thrust_and_radial_load() -> None:
    """20 kN and 2 kN, no moment, rigid rings: 58° on the inner ring, by an independent code."""
    s = four_point(R24_14).equilibrium(
        load=[20e3, 2e3, 0, 0, 0], speed=1500 * RPM, kinematics="outer"
    )
    top = np.nanmax(bearings.truncation(s).upper_end[:, 0])
    assert top / DEGREE == pytest.approx(58.0, abs=0.5)


def test_ellipse_over_the_middle_of_a_groove_with_two_arcs() -> None:
    """Pressed radially, a thin shim's arches hold the ball so near the middle that arcs end."""
    thin = replace(four_point(R24_14, axial_play=0.0), inner_shim=20e-6, outer_shim=20e-6)
    s = thin.equilibrium(displacement=[0.0, 60e-6, 0.0, 0.0, 0.0])
    t = bearings.truncation(s)
    middle = math.asin(20e-6 / (2 * 0.5195 * 20.638e-3))
    assert t.middle_angle[0] == pytest.approx(middle, rel=1e-12)
    assert (t.middle_margin[0] < 0.0).all()
    lower, upper = t.lower_end[0, :2], t.upper_end[0, :2]
    assert t.beyond_middle[0, :2] == pytest.approx((middle - lower) / (upper - lower))


def test_deep_groove_under_either_thrust() -> None:
    """Both shoulders are alike: thrust either way loses the same share; no groove has a middle."""
    b = replace(deep_groove(drawn_6210()), inner_shoulder_diameter=59.5e-3)
    s = b.equilibrium(load=np.outer([8e3, -8e3], UNIT_THRUST))
    t = bearings.truncation(s)
    assert s.contact_angle[0] == pytest.approx(-s.contact_angle[1], rel=1e-9)
    assert t.lost[0] == pytest.approx(t.lost[1], rel=1e-9)
    assert (t.lost[:, :, 0] > 0.0).all()
    assert (t.lost[:, :, 1] == 0.0).all()
    assert np.isnan(t.middle_angle).all()
    reach = b.grooves.centre_radii[0] - 29.75e-3
    assert math.cos(t.shoulder_angle[0]) == pytest.approx(reach / (0.515 * 12.7e-3))


def test_angular_contact_has_its_shoulder_on_the_loaded_side() -> None:
    """The margin of the VEX 70 shrinks with thrust; the open side loses nothing."""
    b = replace(VEX70, outer_shoulder_diameter=96e-3)
    s = b.equilibrium(load=np.outer([500.0, 4000.0], UNIT_THRUST))
    margin = bearings.truncation(s).shoulder_margin[:, 0, 1]
    assert margin[0] > margin[1]
    aside = replace(angular_contact(drawn_6210()), inner_shoulder_diameter=58.4e-3)
    s = aside.equilibrium(displacement=[0.0, 40e-6, 0.0, 0.0, 0.005])
    t = bearings.truncation(s)
    open_side = t.lower_end[:, 0] < -t.shoulder_angle[0]
    assert open_side.any()
    assert (t.lost[open_side, 0] == 0.0).all()
    assert (t.lost[5, 0] > 0.0) == (t.upper_end[5, 0] > t.shoulder_angle[0])


@pytest.mark.parametrize(
    "wrong",
    [
        {"inner_shoulder_diameter": 102e-3},
        {"inner_shoulder_diameter": 126e-3},
        {"outer_shoulder_diameter": 124e-3},
        {"outer_shoulder_diameter": 148e-3},
    ],
)
def test_a_shoulder_lies_between_groove_bottom_and_pitch_circle(wrong: dict[str, float]) -> None:
    """QJ218: bottoms at 102.6 and 147.5 mm, balls on 125 mm."""
    with pytest.raises(InvalidBearing, match="between the bottom of the groove and the pitch"):
        replace(four_point(QJ218), **wrong)
