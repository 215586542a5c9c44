"""Films: a computed case of Hamrock's, exponents, limits; viscosity over temperature."""

from __future__ import annotations

import numpy as np
import pytest

from bearings import DeepGrooveBallBearing, InvalidBearing, Lubricant, Material, film, heat
from bearings.geometry import geometry
from tests.oracles.known_bearings import RPM, VEX70
from tests.oracles.known_grooves import R24_14, four_point

OIL = Lubricant(32e-6, 5.4e-6)
STEEL_200 = Material("steel of Hamrock's example", 200e9, 0.3, 7800.0)
HAMROCK = DeepGrooveBallBearing(
    12.7e-3,
    64.9985e-3,
    9,
    inner_conformity=0.52,
    outer_conformity=0.52,
    ball_material=STEEL_200,
    ring_material=STEEL_200,
    radial_clearance=0.0,
)


def test_ball_bearing_of_hamrock() -> None:
    """Q 4944 N, u 6.252 m/s, η 0.04 Pa·s, α_p 2.3e-8: an independent code's thicknesses [µm]."""
    g, modulus = geometry(HAMROCK.grooves), 2.0 / STEEL_200.contact_compliance / 2.0
    found = []
    for race, side in ((g.inner, 1.0), (g.outer, -1.0)):
        radius = 6.35e-3 * (1.0 - side * 12.7 / 64.9985)
        least, central = film.hamrock_dowson(
            4944.0, 6.252, radius, modulus, race.ellipticity, 0.04, 2.3e-8
        )
        found += [1e6 * float(least), 1e6 * float(central)]
    assert found == pytest.approx([0.553, 0.690, 0.661, 0.828], rel=1e-3)


def test_films_of_a_state_are_those_of_its_contacts() -> None:
    """Entrainment by hand, ω (1 − ωm/ω) (dm/2) (1 − (D/dm) cos αi) on the inner race."""
    speed = 8000 * RPM
    state = VEX70.equilibrium(load=[600, 200, 0, 0, 0], speed=speed)
    found = film.film(state, OIL, 60.0, heating=False)
    g = state.operation.geometry
    orbit = np.sqrt(state.centrifugal_force / g.orbital_factor)
    cosine = np.cos(state.contact_angle[:, 0])
    u = (speed - orbit) * 0.045 * (1.0 - g.size_ratio * cosine)
    modulus = 2.0 / (
        VEX70.ball_material.contact_compliance + VEX70.ring_material.contact_compliance
    )
    least, central = film.hamrock_dowson(
        state.contact_load[:, 0],
        u,
        0.5 * 9.525e-3 * (1.0 - g.size_ratio * cosine),
        modulus,
        g.inner.ellipticity,
        float(OIL.dynamic(60.0)),
        OIL.pressure_viscosity,
    )
    assert found.least[:, 0] == pytest.approx(least, rel=1e-9)
    assert found.central[:, 0] == pytest.approx(central, rel=1e-9)
    assert (found.central > found.least).all()


def test_temperatures_are_one_for_all_states_or_one_each() -> None:
    one = VEX70.equilibrium(load=[600.0, 0, 0, 0, 0], speed=1e4 * RPM)
    two = VEX70.equilibrium(load=[600.0, 0, 0, 0, 0], speed=np.array([1e4, 2e4]) * RPM)
    for of in (film.film, heat.losses):
        with pytest.raises(
            InvalidBearing, match=r"temperature of shape .2,. does not fit a single"
        ):
            of(one, OIL, [40.0, 60.0])
        with pytest.raises(InvalidBearing, match=r"temperature of shape .3,. does not fit a batch"):
            of(two, OIL, [40.0, 50.0, 60.0])
    each = film.film(two, OIL, [40.0, 60.0]).least
    for k, celsius in enumerate((40.0, 60.0)):
        assert (each[k] == film.film(two, OIL, celsius).least[k]).all()


def test_stiffness_is_the_slope_of_the_load_by_the_thickness() -> None:
    args = (1.0, 5e-3, 2e11, 5.0, 0.03, 2e-8)
    q = 200.0 * np.array([1 - 1e-5, 1 + 1e-5])
    low, high = film.hamrock_dowson(q, *args)[1]
    assert -(q[1] - q[0]) / (high - low) == pytest.approx(200.0 / (0.067 * low), rel=1e-4)


def test_heating_and_starvation_thin_films() -> None:
    state = VEX70.equilibrium(load=[600, 0, 0, 0, 0], speed=np.array([1.0, 1e4, 2e4]) * RPM)
    cool = film.film(state, OIL, 60.0, heating=False)
    warm, half = film.film(state, OIL, 60.0), film.film(state, OIL, 60.0, starvation=0.5)
    assert warm.heating[0] == pytest.approx(1.0, abs=1e-3)
    assert (np.diff(warm.heating[:, 0, 0]) < 0.0).all()
    assert (warm.least <= cool.least).all()
    assert half.least == pytest.approx(0.5 * warm.least)
    assert warm.ratio(30e-9, 40e-9) == pytest.approx(warm.least / 50e-9)
    assert warm.growth.shape == (3, 25)


@pytest.mark.parametrize("loading", [0.05, 3.0])
@pytest.mark.parametrize("slip", [0.05, 0.5, 0.8])
def test_slip_heats_the_inlet_by_its_power(loading: float, slip: float) -> None:
    """Gupta's φT = (1 − 13.2 (p/E') L^0.42)/(1 + 0.213 (1 + 2.23 S^0.83) L^0.64)."""
    pressure, modulus = 1.2e9, 2.3e11

    def inverse(s: float) -> float:
        return 1.0 / float(film.inlet_heating(pressure, modulus, loading, s))

    share = (inverse(slip) - inverse(0.0)) / (inverse(1.0) - inverse(0.0))
    assert share == pytest.approx(slip**0.83)
    top = 1.0 - 13.2 * pressure / modulus * loading**0.42
    assert inverse(0.0) * top == pytest.approx(1.0 + 0.213 * loading**0.64)
    assert inverse(1.0) * top == pytest.approx(1.0 + 0.213 * 3.23 * loading**0.64)


def test_ball_on_four_contacts_grows_by_the_film_of_one_line() -> None:
    """A radial load alone presses both diagonals alike, each on the films of its two contacts."""
    state = four_point(R24_14).equilibrium(
        load=[0.0, 9e3, 0.0, 0.0, 0.0], speed=300.0, dynamics="frozen"
    )
    found = film.film(state, OIL, 60.0)
    ball = int(np.argmax(state.contacts))
    assert state.contacts[ball] == 4
    ir, il, outer_r, outer_l = found.central[ball]
    assert (ir, outer_r) == pytest.approx((il, outer_l), rel=1e-6)
    assert found.growth[ball] == pytest.approx(ir + outer_l, rel=1e-6)


def test_ball_grows_by_the_films_of_its_most_loaded_contacts() -> None:
    state = four_point(R24_14).equilibrium(load=[20e3, 12e3, 0, 0, 0], speed=50.0)
    found = film.film(state, OIL, 60.0)
    for ball in np.flatnonzero(state.contacts > 2):
        load, thick = state.contact_load[ball], found.central[ball]
        wanted = thick[np.argmax(load[:2])] + thick[2 + np.argmax(load[2:])]
        assert found.growth[ball] == wanted
    assert (state.contacts > 2).any()


def test_no_film_without_load_or_speed() -> None:
    state = four_point(R24_14).equilibrium(load=[20e3, 12e3, 0, 0, 0], speed=[0.0, 50.0])
    found = film.film(state, OIL, 40.0)
    assert found.least.shape == state.contact_load.shape
    assert (found.least[0] == 0.0).all()
    assert ((found.least[1] > 0.0) == (state.contact_load[1] > 0.0)).all()


def test_no_film_is_known_without_a_state() -> None:
    """Rings pushed a metre, beside 20 µm."""
    push = [[1.0, 0.0, 0.0, 0.0, 0.0], [2e-5, 0.0, 0.0, 0.0, 0.0]]
    state = VEX70.equilibrium(displacement=push, speed=500.0)
    found = film.film(state, OIL, 40.0)
    assert (state.outcome != "").tolist() == [True, False]
    for each in (found.least, found.central, found.growth):
        assert np.isnan(each[0]).all()
        assert (each[1] > 0.0).all()


def test_viscosity_goes_through_its_two_points() -> None:
    assert OIL.kinematic([40.0, 100.0]) == pytest.approx([32e-6, 5.4e-6])
    assert (np.diff(OIL.kinematic(np.linspace(-10.0, 150.0, 40))) < 0.0).all()
    assert OIL.dynamic(40.0) == pytest.approx(32e-6 * 870.0)
    step = np.log(OIL.kinematic(59.9) / OIL.kinematic(60.1)) / 0.2
    assert OIL.thinning(60.0) == pytest.approx(float(step), rel=1e-4)


def test_temperatures_below_those_of_any_oil_are_named() -> None:
    """The one of many that is too cold, and from which on the oil has a viscosity."""
    with pytest.raises(InvalidBearing, match=r"given -273 °C; allowed: above -[12]\d\d") as refused:
        OIL.kinematic([40.0, -273.0, 20.0])
    coldest = float(str(refused.value).split("above ")[1].split(" °C")[0])
    assert np.isfinite(OIL.kinematic(coldest + 0.01))
    with pytest.raises(InvalidBearing, match="too cold for this oil"):
        OIL.kinematic(coldest - 0.01)
    with pytest.raises(InvalidBearing, match="given nan °C"):
        OIL.kinematic(np.nan)


def test_viscosity_of_a_known_oil() -> None:
    """An ISO VG 68 oil of viscosity index 95, 8.5 mm²/s at 100 °C, has some 20 mm²/s at 70 °C."""
    assert Lubricant(68e-6, 8.5e-6).kinematic(70.0) == pytest.approx(20e-6, rel=0.05)


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ((5e-6, 32e-6), "swapped"),
        ((0.0, 5e-6), "viscosity_40 must be positive"),
        ((32e-6, float("nan")), "viscosity_100 must be a number"),
        ((1e-6, 0.4e-6), "is the unit right"),
        ((32e-6, 5e-6, 870.0, 2e-8, 0.0), "conductivity must be positive"),
    ],
)
def test_impossible_oils(values: tuple[float, ...], word: str) -> None:
    with pytest.raises(InvalidBearing, match=word):
        Lubricant(*values)


def test_starvation_is_a_share() -> None:
    with pytest.raises(InvalidBearing, match="starvation"):
        film.film(VEX70.equilibrium(load=[100, 0, 0, 0, 0]), OIL, 40.0, starvation=0.0)
