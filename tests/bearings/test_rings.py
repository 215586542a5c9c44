"""Compound rotating cylinders against closed forms, a boundary-value solver and identities."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from bearings import STEEL, AngularContactBallBearing, InvalidBearing, Material
from bearings.fit.compound import AXIAL_CONDITIONS, Cylinder, compound, release_speed
from tests.oracles.idealised import idealised

SHAFT_STEEL = Material("shaft steel", 210e9, 0.3, 7850.0)
CERAMIC = Material("ceramic", 315e9, 0.26, 3190.0)
ALUMINIUM = Material("aluminium", 70e9, 0.33, 2700.0)
OMEGA = 24000.0 * 2.0 * math.pi / 60.0
SHAFT = Cylinder(0.020, 0.035, SHAFT_STEEL)
RING = Cylinder(0.035, 0.0407, STEEL)
STACK = (SHAFT, RING)
FIT = 12e-6
axials = pytest.mark.parametrize("axial", AXIAL_CONDITIONS)


def test_rotating_annulus_in_plane_stress() -> None:
    """Timoshenko & Goodier (55): u at bore and rim of a disc with a hole."""
    m, a, b = STEEL, 0.02, 0.04
    s = compound([Cylinder(a, b, m)], (), OMEGA)
    k = m.density * OMEGA**2 / (4.0 * m.young_modulus)
    nu = m.poisson_ratio
    rim = k * b * ((1 - nu) * b**2 + (3 + nu) * a**2)
    bore = k * a * ((3 + nu) * b**2 + (1 - nu) * a**2)
    assert s.radial_growth(b) == pytest.approx(rim, rel=1e-13)
    assert s.radial_growth(a) == pytest.approx(bore, rel=1e-13)
    peak = m.density * OMEGA**2 / 4.0 * ((3 + nu) * b**2 + (1 - nu) * a**2)
    assert s.hoop_stress(a) == pytest.approx(peak, rel=1e-13)


def test_rotating_solid_disc_and_the_axis() -> None:
    m, b = STEEL, 0.03
    s = compound([Cylinder(0.0, b, m)], (), OMEGA)
    nu = m.poisson_ratio
    rim = (1 - nu) * m.density * OMEGA**2 * b**3 / (4 * m.young_modulus)
    assert s.radial_growth(b) == pytest.approx(rim, rel=1e-13)
    assert s.radial_growth(0.0) == 0.0
    centre = (3 + nu) / 8 * m.density * OMEGA**2 * b**2
    assert s.hoop_stress(0.0) == pytest.approx(centre, rel=1e-13)


def test_pinhole_doubles_the_hoop_stress_of_the_solid_disc() -> None:
    solid = compound([Cylinder(0.0, 0.03, STEEL)], (), OMEGA).hoop_stress(0.0)
    pinhole = compound([Cylinder(1e-7, 0.03, STEEL)], (), OMEGA).hoop_stress(1e-7)
    assert pinhole == pytest.approx(2.0 * solid, rel=1e-9)


def test_thin_ring_stretches_like_a_hoop() -> None:
    """u → ρ ω² r³/E and σθ → ρ ω² r² of a thin ring."""
    r, t = 0.05, 1e-7
    s = compound([Cylinder(r - t, r + t, STEEL)], (), OMEGA)
    stress = STEEL.density * OMEGA**2 * r**2
    assert s.radial_growth(r) == pytest.approx(stress * r / STEEL.young_modulus, rel=1e-5)
    assert s.hoop_stress(r) == pytest.approx(stress, rel=1e-5)


def test_lame_press_fit() -> None:
    """Shigley's press-fit formula for a hollow shaft and hub of different materials."""
    shaft, hub = Cylinder(0.02, 0.035, CERAMIC), Cylinder(0.035, 0.05, ALUMINIUM)
    r2 = 0.035**2
    hub_part = (0.05**2 + r2) / (0.05**2 - r2) + ALUMINIUM.poisson_ratio
    shaft_part = (r2 + 0.02**2) / (r2 - 0.02**2) - CERAMIC.poisson_ratio
    compliance = hub_part / ALUMINIUM.young_modulus + shaft_part / CERAMIC.young_modulus
    s = compound([shaft, hub], [FIT])
    assert s.pressure == pytest.approx(FIT / (0.035 * compliance), rel=1e-13)
    assert s.holds.all()
    assert s.radial_growth(0.035) - s.radial_growth(0.035, body=0) == pytest.approx(FIT, rel=1e-12)


@pytest.mark.parametrize("axial", ["plane_stress", "clamped"])
def test_two_pressed_bodies_of_one_material_turn_as_one(axial: str) -> None:
    """What rotation adds is that of one body (which also has one axial strain)."""
    parts = (Cylinder(0.02, 0.03, STEEL), Cylinder(0.03, 0.045, STEEL))
    held, whole = compound(parts, [20e-6], 0.0, axial=axial), Cylinder(0.02, 0.045, STEEL)
    turning = compound(parts, [20e-6], 1500.0, axial=axial)
    one = compound([whole], (), 1500.0, axial=axial)
    for radius, body in ((0.02, 0), (0.03, 0), (0.03, 1), (0.045, 1)):
        change = turning.radial_growth(radius, body) - held.radial_growth(radius, body)
        assert turning.holds.all()
        assert change == pytest.approx(one.radial_growth(radius), rel=1e-11)


@axials
def test_superposition_of_rotation_and_fit(axial: str) -> None:
    """While the fit holds, pressure and growth are linear in (interference, ω²)."""
    a = compound(STACK, [FIT], 0.0, axial=axial)
    b = compound(STACK, [2 * FIT], [OMEGA, OMEGA * math.sqrt(2)], axial=axial)
    rise = b.pressure[1] - b.pressure[0]
    assert b.pressure[0] == pytest.approx(2 * a.pressure + rise, rel=1e-11)
    r = RING.outer_radius
    grown = b.radial_growth(r)
    expected = 2 * a.radial_growth(r) + (grown[1] - grown[0])
    assert grown[0] == pytest.approx(expected, rel=1e-11)


@axials
def test_reciprocity_of_rotation_and_pressure(axial: str) -> None:
    """Betti: work of one load on the other's displacement, over a body with free ends."""
    a, b, p = 0.02, 0.04, 1e7
    body = Cylinder(a, b, STEEL)
    grown = compound([body], (), OMEGA, axial=axial).radial_growth(b)
    wide = Cylinder(b, 2 * b, idealised("light and soft", 10.0, 0.0, 1e-6))
    pressed = compound([body, wide], [1e-3], 0.0, axial=axial)
    scale = p / float(pressed.pressure[0])
    r, weight = np.polynomial.legendre.leggauss(20)
    r = a + (b - a) * (r + 1) / 2
    squeeze = np.array([pressed.radial_growth(x, 0) for x in r]) * scale
    work = np.sum(weight * (b - a) / 2 * STEEL.density * OMEGA**2 * r**2 * squeeze)
    assert work == pytest.approx(-p * b * grown, rel=1e-6)


@axials
def test_against_a_boundary_value_solver(axial: str) -> None:
    """(σr, u) of every body integrated numerically, joints and axial strain as found by the fit."""
    s = compound(STACK, [FIT], 0.8 * OMEGA, axial=axial)
    strain = _axial_strain(s.pressure[0], axial)
    inside, outside = [0.0, s.pressure[0]], [s.pressure[0], 0.0]
    for body, (cylinder, p, q) in enumerate(zip(STACK, inside, outside, strict=True)):
        r, u, hoop = _solve_body(cylinder, p, q, axial, strain[body])
        ours = [s.radial_growth(x, body) for x in r]
        assert u == pytest.approx(ours, rel=1e-6)
        assert hoop == pytest.approx([s.hoop_stress(x, body) for x in r], rel=1e-6, abs=1e2)


def _axial_strain(p: float, axial: str) -> list[float]:
    """εz from zero axial force, by the virial of the in-plane stresses."""
    if axial == "plane_stress":
        return [math.nan, math.nan]
    speed = 0.8 * OMEGA
    force, stiffness = [], []
    for cylinder, (inside, outside) in zip(STACK, ((0.0, p), (p, 0.0)), strict=True):
        m, a2, b2 = cylinder.material, cylinder.inner_radius**2, cylinder.outer_radius**2
        total = 2 * (inside * a2 - outside * b2) + m.density * speed**2 * (b2**2 - a2**2) / 2
        force.append(-m.poisson_ratio * total)
        stiffness.append(m.young_modulus * (b2 - a2))
    if axial == "clamped":
        return [sum(force) / sum(stiffness)] * 2
    return [f / k for f, k in zip(force, stiffness, strict=True)]


def _solve_body(
    cylinder: Cylinder, inside: float, outside: float, axial: str, strain: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    m, w, unit = cylinder.material, 0.8 * OMEGA, 1e-6
    lame = m.young_modulus * m.poisson_ratio / ((1 + m.poisson_ratio) * (1 - 2 * m.poisson_ratio))
    g = m.shear_modulus

    def third(er: np.ndarray, et: np.ndarray) -> np.ndarray:
        thin = -lame * (er + et) / (lame + 2 * g)
        return thin if axial == "plane_stress" else strain + 0.0 * er

    def stresses(r: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Radial strain from (u, σr), then σθ."""
        et, sr = y[0] * unit / r, y[1] * 1e6
        if axial == "plane_stress":
            soft = lame - lame**2 / (lame + 2 * g)
            er = (sr - soft * et) / (soft + 2 * g)
        else:
            er = (sr - lame * (et + strain)) / (lame + 2 * g)
        return er, lame * (er + et + third(er, et)) + 2 * g * et

    def slope(r: np.ndarray, y: np.ndarray) -> np.ndarray:
        er, hoop = stresses(r, y)
        return np.array([er / unit, (hoop - y[1] * 1e6) / r / 1e6 - m.density * w**2 * r / 1e6])

    def ends(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.array([left[1] + inside / 1e6, right[1] + outside / 1e6])

    r = np.linspace(cylinder.inner_radius, cylinder.outer_radius, 11)
    found = solve_bvp(slope, ends, r, np.ones((2, 11)), tol=1e-9, max_nodes=20000)
    assert found.success
    y = found.sol(r)
    return r, y[0] * unit, stresses(r, y)[1]


def test_free_ends_equal_plane_stress_at_the_surfaces_only() -> None:
    """A consequence of reciprocity: the Lamé field of a free-ended tube is a plane-stress one."""
    body = Cylinder(0.02, 0.04, STEEL)
    thin, long = (compound([body], (), OMEGA, axial=a) for a in ("plane_stress", "free_ends"))
    for radius in (0.02, 0.04):
        assert long.radial_growth(radius) == pytest.approx(thin.radial_growth(radius), rel=1e-12)
    assert long.radial_growth(0.03) != pytest.approx(thin.radial_growth(0.03), rel=1e-3)


def test_generalised_plane_strain_by_hand() -> None:
    """Plane strain with E/(1−ν²), ν/(1−ν), plus −ν εz r with εz = −ν ρ ω² (ri² + ro²)/(2E)."""
    m, a, b, r = STEEL, 0.02, 0.04, 0.031
    nu = m.poisson_ratio
    strained = Material(
        "E/(1−ν²), ν/(1−ν)", m.young_modulus / (1 - nu**2), nu / (1 - nu), m.density
    )
    plane = compound([Cylinder(a, b, strained)], (), OMEGA).radial_growth(r)
    shortening = -nu * m.density * OMEGA**2 * (a**2 + b**2) / (2 * m.young_modulus)
    for axial in ("free_ends", "clamped"):
        found = compound([Cylinder(a, b, m)], (), OMEGA, axial=axial).radial_growth(r)
        assert found == pytest.approx(plane - nu * shortening * r, rel=1e-12)


@axials
def test_without_contraction_the_axial_condition_is_idle(axial: str) -> None:
    cork = Material("no contraction", 1e10, 0.0, 1000.0)
    stack = (Cylinder(0.02, 0.03, cork), Cylinder(0.03, 0.04, cork))
    found = compound(stack, [FIT], 300.0, axial=axial)
    thin = compound(stack, [FIT], 300.0)
    assert found.pressure == pytest.approx(thin.pressure, rel=1e-12)
    assert found.radial_growth(0.035) == pytest.approx(thin.radial_growth(0.035), rel=1e-12)


@axials
def test_pressure_falls_with_speed_squared_and_the_fit_lets_go(axial: str) -> None:
    release = release_speed(STACK, [FIT], axial=axial)
    assert release.shape == (1,)
    ratio = np.array([0.0, 0.5, 0.999999, 1.000001, 1.2])
    s = compound(STACK, [FIT], ratio * release[0], axial=axial)
    rest = s.pressure[0, 0]
    assert s.pressure[1, 0] == pytest.approx(0.75 * rest, rel=1e-11)
    assert s.pressure[2, 0] == pytest.approx(rest * (1 - ratio[2] ** 2), rel=1e-6)
    assert (s.pressure[3:] == 0.0).all()
    assert s.holds[:, 0].tolist() == [True, True, True, False, False]
    assert (s.gap[:3] == 0.0).all()
    assert (s.gap[3:] > 0.0).all()


@pytest.mark.parametrize("axial", ["plane_stress", "free_ends"])
def test_beyond_release_the_bodies_are_alone(axial: str) -> None:
    speed = 1.3 * float(release_speed(STACK, [FIT], axial=axial)[0])
    s = compound(STACK, [FIT], speed, axial=axial)
    for body, cylinder in enumerate(STACK):
        alone = compound([cylinder], (), speed, axial=axial)
        r = cylinder.outer_radius
        assert s.radial_growth(r, body) == pytest.approx(alone.radial_growth(r), rel=1e-13)
        assert s.hoop_stress(r, body) == pytest.approx(alone.hoop_stress(r), rel=1e-13)
    opening = s.radial_growth(0.035, 1) - s.radial_growth(0.035, 0) - FIT
    assert s.gap[0] == pytest.approx(opening, rel=1e-9)


def test_clearance_neither_presses_nor_releases_later() -> None:
    s = compound(STACK, [-5e-6], [0.0, OMEGA])
    assert (s.pressure == 0.0).all()
    assert s.gap[0, 0] == pytest.approx(5e-6, rel=1e-12)
    assert release_speed(STACK, [-5e-6]).tolist() == [0.0]


def test_clearance_that_a_heavy_shaft_closes_never_lets_go() -> None:
    heavy = Cylinder(0.02, 0.035, Material("heavy and soft", 5e10, 0.3, 15000.0))
    light = Cylinder(0.035, 0.0407, CERAMIC)
    s = compound([heavy, light], [-2e-6], [0.0, 2000.0])
    assert s.holds[:, 0].tolist() == [False, True]
    assert np.isinf(release_speed([heavy, light], [1e-6]))


def test_three_bodies_let_go_one_after_another() -> None:
    sleeve = Cylinder(0.035, 0.038, STEEL)
    bodies = (SHAFT, sleeve, Cylinder(0.038, 0.045, STEEL))
    first = release_speed(bodies, [4e-6, 15e-6])
    assert np.isfinite(first).any()
    order = np.sort(first[np.isfinite(first)])
    for speed in order:
        joint = int(np.flatnonzero(first == speed)[0])
        below, above = compound(bodies, [4e-6, 15e-6], [speed * 0.99999, speed * 1.00001]).pressure
        assert below[joint] > 0.0 == above[joint]


@axials
def test_contact_conditions_hold_over_random_stacks(axial: str) -> None:
    """p ≥ 0, gap ≥ 0, one of them zero, and the displacements say the same."""
    rng = np.random.default_rng(11)
    for _ in range(40):
        radii = np.cumsum(rng.uniform(0.004, 0.02, 5))
        kinds = rng.integers(0, 3, 4)
        materials = [(STEEL, CERAMIC, ALUMINIUM)[k] for k in kinds]
        bodies = [
            Cylinder(a, b, m, rng.uniform(-20, 60), 1e-5)
            for (a, b), m in zip(pairwise(radii), materials, strict=True)
        ]
        fit = rng.uniform(-10e-6, 30e-6, 3)
        s = compound(bodies, fit, rng.uniform(0, 5000, 6), axial=axial)
        assert (s.pressure >= 0.0).all()
        assert (s.gap >= 0.0).all()
        assert (s.pressure * s.gap == 0.0).all()
        for j in range(3):
            r = bodies[j].outer_radius
            opening = s.radial_growth(r, j + 1) - s.radial_growth(r, j) - fit[j]
            assert opening == pytest.approx(s.gap[:, j], abs=1e-15)


def test_temperature_alone() -> None:
    """Free expansion α T r, in every axial condition; a hot shaft tightens the fit."""
    for axial in AXIAL_CONDITIONS:
        s = compound([Cylinder(0.02, 0.04, STEEL, 30.0, 12e-6)], (), 0.0, axial=axial)
        assert s.radial_growth(0.03) == pytest.approx(12e-6 * 30 * 0.03, rel=1e-12)
    hot = Cylinder(0.02, 0.035, SHAFT_STEEL, 30.0, 12e-6)
    as_interference = compound(STACK, [FIT + 12e-6 * 30 * 0.035])
    assert compound([hot, RING], [FIT]).pressure == pytest.approx(
        as_interference.pressure, rel=1e-12
    )


@axials
def test_raceway_of_the_flagship_grows_by_about_six_micrometres(axial: str) -> None:
    """40 mm bore, 70 mm seat, inner ring to (dm − D cos α)/2 = 40.68 mm, 24 000 rpm."""
    bearing = AngularContactBallBearing(9.525e-3, 0.09, 25, contact_angle=math.radians(25.0))
    radius = bearing.inner_raceway_radius
    assert radius == pytest.approx(40.68e-3, abs=6e-6)
    stack = (SHAFT, Cylinder(0.035, radius, STEEL))
    growth = compound(stack, [FIT], [0.0, OMEGA / 2, OMEGA], axial=axial).radial_growth(radius)
    grown = growth - growth[0]
    assert grown[2] == pytest.approx(6.0e-6, abs=0.1e-6)
    assert grown[0] == 0.0
    assert grown[1] == pytest.approx(grown[2] / 4, rel=1e-9)


def test_shapes_follow_the_speed() -> None:
    speed = np.linspace(0.0, OMEGA, 6).reshape(2, 3)
    s = compound(STACK, [FIT], speed)
    assert s.pressure.shape == s.gap.shape == s.holds.shape == (2, 3, 1)
    assert s.radial_growth(0.04).shape == s.hoop_stress(0.04).shape == (2, 3)
    assert compound([SHAFT], (), 10.0).pressure.shape == (0,)


@pytest.mark.parametrize(
    ("bodies", "fit", "match"),
    [
        ((), (), "at least one"),
        (STACK, (), "need 1 finite"),
        (STACK, [math.nan], "need 1 finite"),
        ((SHAFT, Cylinder(0.036, 0.04, STEEL)), [FIT], "as interference"),
    ],
)
def test_impossible_stacks(bodies: tuple[Cylinder, ...], fit: object, match: str) -> None:
    with pytest.raises(InvalidBearing, match=match):
        compound(bodies, fit)


def test_impossible_questions() -> None:
    with pytest.raises(InvalidBearing, match="axial"):
        compound(STACK, [FIT], axial="plane")
    with pytest.raises(InvalidBearing, match="speed"):
        compound(STACK, [FIT], math.inf)
    with pytest.raises(InvalidBearing, match="speed must be finite numbers"):
        compound(STACK, [FIT], "fast")
    with pytest.raises(InvalidBearing, match="outside the body"):
        compound(STACK, [FIT]).radial_growth(0.03)
    with pytest.raises(InvalidBearing, match="outside the body"):
        compound(STACK, [FIT]).hoop_stress(0.05)


@pytest.mark.parametrize(
    "wrong",
    [
        dict(inner_radius=-1e-3, outer_radius=0.02),
        dict(inner_radius=0.02, outer_radius=0.02),
        dict(inner_radius=math.nan, outer_radius=0.02),
        dict(inner_radius=0.01, outer_radius=math.inf),
        dict(inner_radius=0.01, outer_radius=0.02, temperature_rise=20.0),
        dict(inner_radius=0.01, outer_radius=0.02, expansion=math.nan),
        dict(inner_radius="10 mm", outer_radius=0.02),
        dict(inner_radius=0.01, outer_radius=10**400),
    ],
)
def test_impossible_cylinders(wrong: dict[str, float]) -> None:
    with pytest.raises(InvalidBearing):
        Cylinder(material=STEEL, **wrong)


@axials
def test_fits_of_random_stacks_press_until_they_let_go(axial: str) -> None:
    """Up to the reported speed everywhere, and no more just above it; those that never let go press
    at any speed."""
    rng, met = np.random.default_rng(5), 0
    for _ in range(40):
        radii = np.cumsum(rng.uniform(0.004, 0.02, 5))
        kinds = rng.integers(0, 3, 4)
        materials = [(STEEL, CERAMIC, ALUMINIUM)[k] for k in kinds]
        bodies = [Cylinder(a, b, m) for (a, b), m in zip(pairwise(radii), materials, strict=True)]
        fit = rng.uniform(-4e-6, 30e-6, 3)
        told = release_speed(bodies, fit, axial=axial)
        for joint, speed in enumerate(told):
            last = speed if np.isfinite(speed) else 4.0 * max(told[np.isfinite(told)], default=1e4)
            if last == 0.0:
                assert compound(bodies, fit, [0.0], axial=axial).pressure[0, joint] == 0.0
                continue
            below = compound(bodies, fit, last * np.linspace(0.0, 0.9999, 9), axial=axial)
            assert (below.pressure[:, joint] > 0.0).all()
            if np.isfinite(speed):
                above = compound(bodies, fit, [speed * 1.0001], axial=axial)
                assert above.pressure[0, joint] == 0.0
                met += 1
    assert met > 40
