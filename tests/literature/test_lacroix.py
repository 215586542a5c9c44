"""Four-point bearings of Lacroix' thesis (INSA Lyon, 2014), rigid rings.

Tables 4.10–4.12 print three loads of the bearing R_24^14 (table 4.9) "at 1000 rpm". The figures
belong to 1500 rpm, which is INFERRED: in the printed loads Q_ol − Q_ir is 9 to 11 N, which is
Fc cos α, so that Fc is 14.3 ± 1 N; 1000 rpm makes 6.4 N and 1500 rpm makes 14.4 N, and with 1500
rpm all figures of both thrust cases agree. A factor of 2.25 in Fc would look the same. Case 4 of
the thesis does not fit its load by any reading and is no test.

Speeds at which a third contact appears and the loads of section "rating" are those of an
independent code, with the rounding of its table.
"""

from __future__ import annotations

import math
from dataclasses import fields, replace

import numpy as np
import pytest

import rotordyn
from bearings import FourPointBallBearing, InvalidBearing
from bearings.ring.state import BearingState
from tests.oracles.four_point import Drawing, GrooveOracle
from tests.oracles.known_bearings import DEGREE, RPM
from tests.oracles.known_grooves import QJ218, QJ218_THINNED, R20_10, R24_14, four_point

SPEED = 1500.0 * RPM
HOW = dict(kinematics="outer", moment_sharing="equal", dynamics="resultant")
MICRO = 1e6


def case(load: list[float]) -> BearingState:
    return four_point(R24_14).equilibrium(load=load, speed=SPEED, **HOW)


@pytest.mark.parametrize(
    ("thrust", "travel", "inner", "outer"),
    [
        (20e3, 250.0, (42.2, 1486.0), (41.8, 1497.0)),  # case 1, R
        (100e3, 304.0, (45.3, 7030.0), (45.2, 7040.0)),  # case 2, R
    ],
)
def test_thrust(
    thrust: float, travel: float, inner: tuple[float, float], outer: tuple[float, float]
) -> None:
    """Table 4.10, p 86: δx [µm], then angle [°] and load [N] of ir and ol, alike at all balls."""
    s = case([thrust, 0.0, 0.0, 0.0, 0.0])
    assert s.displacement[0] * MICRO == pytest.approx(travel, abs=0.6)
    assert (s.contacts == 2).all()
    for index, (angle, load) in ((0, inner), (3, outer)):
        assert s.contact_angle[:, index] / DEGREE == pytest.approx(angle, abs=0.06)
        assert s.contact_load[:, index] == pytest.approx(load, abs=1.5)


def test_thrust_and_radial_load() -> None:
    """Case 3, tables 4.11 and 4.12: 20 kN and 12 kN, free tilt; balls 0 and 10 at 0° and 180°."""
    s = case([20e3, 12e3, 0.0, 0.0, 0.0])
    assert s.displacement[0] * MICRO == pytest.approx(228.0, abs=0.8)
    assert s.displacement[1] * MICRO == pytest.approx(136.0, abs=0.8)
    angle = s.contact_angle[[0, 10], 0] / DEGREE
    assert angle == pytest.approx([22.4, 57.7], abs=0.06)


@pytest.mark.parametrize(
    ("drawing", "thrust", "rpm"),
    [
        (QJ218, 5e3, 3200.0),
        (QJ218, 20e3, 8060.0),
        (QJ218, 50e3, 14930.0),
        (R24_14, 5e3, 7000.0),
        (R24_14, 20e3, 13470.0),
    ],
)
def test_third_contact_under_thrust(drawing: Drawing, thrust: float, rpm: float) -> None:
    """Two contacts a ball 1 % below the speed, a third, on the outer ring, 1 % above it."""
    s = four_point(drawing).equilibrium(
        load=[thrust, 0.0, 0.0, 0.0, 0.0],
        speed=rpm * RPM * np.array([0.99, 1.01]),
        dynamics="frozen",
    )
    assert (s.contacts[0] == 2).all()
    assert (s.contacts[1] == 3).all()
    assert (s.contact_load[1] > 0.0).all(axis=0).tolist() == [True, False, True, True]


def test_plays_of_r20_10() -> None:
    """Table 2.1 and p 35: αf 27.67°, Ep 200 µm, Jd 80 µm (from f and g: 201.5, 80.3)."""
    assert R20_10.axial_play * MICRO == pytest.approx(200.0, abs=1.6)
    assert 2.0 * radial_play_of_a_ball(R20_10) * MICRO == pytest.approx(80.0, abs=0.4)


def radial_play_of_a_ball(b: Drawing) -> float:
    """Qr: what a centred ball pressed into both arches leaves of the radius [m]."""
    reach = -b.free_distance * math.cos(b.contact_angle)
    for f, g in ((b.inner_conformity, b.inner_shim), (b.outer_conformity, b.outer_shim)):
        reach += math.sqrt(((f - 0.5) * b.ball_diameter) ** 2 - (0.5 * g) ** 2)
    return reach


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_a_shim_ends_where_the_ball_sits_against_the_middle_of_its_groove(ring: str) -> None:
    """sin α⁰ = g/(2 ℓ): 90° at g = 2 ℓ, the distance of both arc centres from a ball that fills
    the groove."""
    usual = four_point(R24_14)
    reach = (getattr(usual, f"{ring}_conformity") - 0.5) * usual.ball_diameter
    for share, beyond in ((0.999, False), (1.001, True), (1.5, True)):
        with pytest.raises(InvalidBearing) as caught:
            replace(usual, **{f"{ring}_shim": 2.0 * share * reach})
        assert ("reaches beyond the groove" in str(caught.value)) == beyond
        assert not beyond or f"allowed below {2e3 * reach:.4g} mm" in str(caught.value)


def carries(bearing: FourPointBallBearing, displacement: list[float]) -> bool:
    load = bearing.equilibrium(displacement=displacement).contact_load
    return bool(load.max() > 1e-6)


@pytest.mark.parametrize("drawing", [QJ218, R24_14], ids=["odd", "even"])
def test_radial_play_is_the_travel_of_the_ring(drawing: Drawing) -> None:
    """Towards a ball Qr; towards the gap between two balls, across an odd number, Qr/cos(π/z)."""
    b = four_point(drawing)
    towards = radial_play_of_a_ball(drawing)
    odd = drawing.balls % 2 == 1
    away = towards / math.cos(math.pi / drawing.balls) if odd else towards
    for travel, way in ((towards, 1.0), (away, -1.0)):
        assert not carries(b, [0.0, way * (travel - 1e-9), 0.0, 0.0, 0.0])
        assert carries(b, [0.0, way * (travel + 1e-9), 0.0, 0.0, 0.0])
    again = four_point(drawing, radial_play=towards + away)
    assert again.free_angle == pytest.approx(drawing.contact_angle, rel=1e-12)


@pytest.mark.parametrize("drawing", [QJ218, R24_14])
def test_axial_play_is_the_travel_of_the_ring(drawing: Drawing) -> None:
    b = four_point(drawing, axial_play=drawing.axial_play)
    for way in (0.5, -0.5):
        assert not carries(b, [way * (drawing.axial_play - 1e-9), 0.0, 0.0, 0.0, 0.0])
        assert carries(b, [way * (drawing.axial_play + 1e-9), 0.0, 0.0, 0.0, 0.0])


def test_radial_play_of_qj218() -> None:
    """Jd 50 µm (table 5.1)."""
    qr = radial_play_of_a_ball(QJ218)
    assert qr * (1.0 + 1.0 / math.cos(math.pi / 15)) * MICRO == pytest.approx(50.0, abs=2.0)


def test_load_of_1800_mpa() -> None:
    """P 77: the inner contact of R_20^10 reaches 1.8 GPa at about 2900 N."""
    oracle = GrooveOracle(R20_10)
    load = (1.8e9 / oracle.peak[0]) ** 3
    assert load == pytest.approx(2900.0, rel=0.01)
    s = four_point(R20_10).equilibrium(load=[20 * load * math.sin(0.55), 0.0, 0.0, 0.0, 0.0])
    pressure = s.contact_pressure[0, 0]
    assert pressure == pytest.approx(1.8e9 * (s.contact_load[0, 0] / load) ** (1 / 3), rel=1e-9)


@pytest.mark.parametrize(
    ("drawing", "published", "travel"),
    [(QJ218, 140.0, 122.5), (QJ218_THINNED, 170.0, 118.0)],
)
def test_rigid_rings_are_stiffer_than_the_test_rig(
    drawing: Drawing, published: float, travel: float
) -> None:
    """P 104: travel from 1.5 to 100 kN [µm], measured with its fixture, and with rigid rings."""
    s = four_point(drawing).equilibrium(load=np.outer([1.5e3, 100e3], np.eye(5)[0]))
    found = (s.displacement[1, 0] - s.displacement[0, 0]) * MICRO
    assert found == pytest.approx(travel, abs=0.1)
    assert found < published


@pytest.mark.parametrize(
    ("name", "drawing", "shoulders"),
    [("qj218", QJ218, (114e-3, 136e-3)), ("lacroix_r24_14", R24_14, (156e-3, 161e-3))],
)
def test_models_of_the_library(name: str, drawing: Drawing, shoulders: tuple[float, float]) -> None:
    """Files say what tables 4.9 and 5.1 do; rings of R_24^14: bore and outside ± 2·14 mm."""
    model = rotordyn.model("bearings", name)
    inner, outer = shoulders
    plain = replace(model, inner_shoulder_diameter=None, outer_shoulder_diameter=None)
    assert (model.inner_shoulder_diameter, model.outer_shoulder_diameter) == (inner, outer)
    for field in fields(plain):
        known, here = getattr(four_point(drawing), field.name), getattr(plain, field.name)
        if field.name.endswith("material"):
            unprinted = {"name": "", "thermal_expansion": None}
            known, here = replace(known, **unprinted), replace(here, **unprinted)
        assert here == known or here == pytest.approx(known, rel=1e-12), field.name
