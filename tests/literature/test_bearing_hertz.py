"""Hertz coefficients against the tables of Harris (ch. 6) and Cooper (1968), recomputed exactly."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearings import AngularContactBallBearing, Material
from bearings.contact.hertz import curvature_difference, dimensionless, ellipticity
from bearings.geometry import geometry
from tests.oracles.ball_bearing import hertz, race
from tests.oracles.known_bearings import HARRIS_209, HARRIS_218, VEX70

# F(rho), kappa, a*, b*, delta*
TABLE = [
    (0.1075, 1.154721, 1.07597, 0.93180, 0.99742),
    (0.3204, 1.555664, 1.26232, 0.81143, 0.97615),
    (0.4795, 1.999864, 1.45552, 0.72781, 0.94320),
    (0.5916, 2.458647, 1.64397, 0.66865, 0.90767),
    (0.6716, 2.923738, 1.82578, 0.62447, 0.87329),
    (0.7332, 3.420437, 2.01144, 0.58807, 0.83941),
    (0.7948, 4.134169, 2.26546, 0.54798, 0.79605),
    (0.83495, 4.809724, 2.49434, 0.51860, 0.76021),
    (0.87366, 5.758777, 2.80032, 0.48627, 0.71689),
    (0.90999, 7.185389, 3.23273, 0.44990, 0.66363),
    (0.912, 7.290365, 3.26344, 0.44764, 0.66016),
    (0.926, 8.141472, 3.50750, 0.43082, 0.63393),
    (0.93657, 8.971122, 3.73777, 0.41664, 0.61117),
    (0.9399, 9.278725, 3.82140, 0.41185, 0.60334),
    (0.95738, 11.473101, 4.39443, 0.38302, 0.55510),
    (0.9729, 15.088857, 5.26671, 0.34905, 0.49604),
    (0.983797, 20.470833, 6.44749, 0.31496, 0.43518),
    (0.990902, 28.654392, 8.06234, 0.28136, 0.37450),
    (0.995112, 40.929298, 10.22150, 0.24974, 0.31756),
]
HALF_DIGIT = 0.6e-5


@pytest.mark.parametrize("row", TABLE, ids=lambda row: f"F={row[0]}")
def test_table_of_dimensionless_quantities(row: tuple[float, ...]) -> None:
    difference, kappa, *expected = row
    assert ellipticity(difference) == pytest.approx(kappa, abs=0.6e-6 * max(1, kappa / 10))
    assert dimensionless(ellipticity(difference)) == pytest.approx(expected, abs=HALF_DIGIT)


@pytest.mark.parametrize("difference", [0.05, 0.5, 0.9, 0.99, 0.998])
def test_against_elliptic_integrals_by_quadrature(difference: float) -> None:
    kappa, *expected = hertz(1.0, difference)
    assert ellipticity(difference) == pytest.approx(kappa, rel=1e-9)
    assert dimensionless(kappa) == pytest.approx(expected, rel=1e-11)
    assert curvature_difference(kappa) == pytest.approx(difference, abs=1e-12)


HYBRID_210 = AngularContactBallBearing(
    ball_diameter=VEX70.ball_diameter,
    pitch_diameter=VEX70.pitch_diameter,
    balls=25,
    contact_angle=VEX70.contact_angle,
    inner_conformity=0.56,
    outer_conformity=0.54,
    ring_material=Material("steel, 210 GPa", 210e9, 0.3, 7800.0),
)
# Ki, Ko, Kn [N/m^1.5]; then a, b [mm], approach [um], pressure [MPa] at 1000 N, inner and outer
CONTACTS = {
    "209": (
        HARRIS_209,
        (3.20725e10, 3.39083e10, 1.16563e10),
        (1.54248, 0.16613, 9.90630, 1863.28),
        (1.49581, 0.20504, 9.54544, 1556.75),
    ),
    "218": (
        HARRIS_218,
        (4.07062e10, 4.23417e10, 1.46762e10),
        (1.74430, 0.21389, 8.45070, 1279.77),
        (1.70636, 0.24739, 8.23166, 1131.06),
    ),
    "hybrid": (
        HYBRID_210,
        (2.39120e10, 2.79474e10, 9.12125e9),
        (0.84789, 0.18470, 12.04821, 3048.88),
        (0.97519, 0.19012, 10.85855, 2575.23),
    ),
}


@pytest.mark.parametrize("name", CONTACTS)
def test_contacts_of_three_bearings(name: str) -> None:
    bearing, stiffness, *sides = CONTACTS[name]
    g = geometry(bearing.grooves)
    found = (g.inner.stiffness, g.outer.stiffness, g.series_stiffness)
    assert found == pytest.approx(stiffness, rel=5e-6)
    for contact, (major, minor, approach, pressure) in zip((g.inner, g.outer), sides, strict=True):
        assert contact.semi_axis_major * 10 == pytest.approx(major * 1e-3, abs=0.6e-8)
        assert contact.semi_axis_minor * 10 == pytest.approx(minor * 1e-3, abs=0.6e-8)
        closed = (1000.0 / contact.stiffness) ** (2 / 3)
        assert closed == pytest.approx(approach * 1e-6, abs=0.6e-11)
        peak = contact.peak_pressure(np.array(1000.0))
        assert peak == pytest.approx(pressure * 1e6, abs=0.6e4)


@pytest.mark.parametrize("side", [1, -1])
def test_contact_of_the_oracle_is_the_same(side: int) -> None:
    ours = geometry(VEX70.grooves).inner if side > 0 else geometry(VEX70.grooves).outer
    theirs = race(VEX70, side)
    assert ours.stiffness == pytest.approx(theirs.k, rel=1e-10)
    assert ours.semi_axis_major == pytest.approx(theirs.a1, rel=1e-10)
    assert ours.second_integral == pytest.approx(theirs.e, rel=1e-10)


def test_peak_pressure_balances_the_load() -> None:
    contact = geometry(HARRIS_218.grooves).outer
    load = np.array([1.0, 50.0, 4000.0])
    area = math.pi * contact.semi_axis_major * contact.semi_axis_minor * load ** (2 / 3)
    assert contact.peak_pressure(load) * area * 2 / 3 == pytest.approx(load, rel=1e-12)
