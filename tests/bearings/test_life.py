"""Lives and ratings by closed forms, limits and symmetry."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from bearings import InvalidBearing, ThrustBallBearing, life
from bearings.grooves import Grooves
from bearings.ring.motion import ball_motion
from tests.oracles.known_bearings import HYPOTHESES, RPM, VEX70
from tests.oracles.known_grooves import QJ218, R24_14, four_point

THRUST = np.array([1.0, 0.0, 0.0, 0.0, 0.0])


def test_rating_is_the_life_under_itself() -> None:
    """A radial load that loads every ball alike on its nominal angle, by hand."""
    qi, qo = life.ball_ratings(VEX70)
    state = VEX70.equilibrium(load=0.1 * THRUST)
    q = 0.1 / (25 * math.sin(float(state.inner_angle[0])))
    millions = ((q / qi) ** (10 / 3) + (q / qo) ** (10 / 3)) ** -0.9
    assert life.reference_life(state) == pytest.approx(1e6 * millions, rel=1e-4)


def test_batch_is_its_states() -> None:
    loads, speeds = np.outer([200.0, 800.0], THRUST), np.array([0.0, 9000.0, 18000.0]) * RPM
    batch = VEX70.equilibrium(load=loads[:, None] + [0, 30.0, 0, 0, 0], speed=speeds)
    one = VEX70.equilibrium(load=loads[1] + [0, 30.0, 0, 0, 0], speed=speeds[2])
    found, alone = life.life_of(batch), life.life_of(one)
    assert found.revolutions.shape == found.limiting.shape == (2, 3)
    assert found.revolutions[1, 2] == pytest.approx(alone.revolutions, rel=1e-9)
    assert life.static_safety(batch).shape == (2, 3)
    for many, few in zip(life.frequencies(batch), life.frequencies(one), strict=True):
        assert many[1, 2] == pytest.approx(float(few), rel=1e-9, abs=1e-12)


def test_life_of_nothing_is_infinite() -> None:
    state = four_point(R24_14).equilibrium(load=np.zeros(5))
    found = life.life_of(state)
    assert np.isinf(found.revolutions)
    assert found.limiting == ""
    assert np.isinf(life.static_safety(state))
    assert np.isnan(life.frequencies(state).cage)


def test_load_that_turns_with_the_inner_ring() -> None:
    """The ring at rest against the load has the exponent 10/3 of the two: it fails sooner."""
    state = VEX70.equilibrium(load=[300, 600, 0, 0, 0])
    still, turning, both = (
        life.life_of(state, rotating=which) for which in ("inner", "outer", "both")
    )
    inner, outer = still.race_load, turning.race_load
    assert inner[0] < outer[0]
    assert inner[1] > outer[1]
    assert both.race_load == pytest.approx([inner[0], outer[1]])


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_four_point_bearing_under_thrust_uses_two_of_four_raceways(sign: float) -> None:
    b = four_point(QJ218)
    found = life.life_of(b.equilibrium(load=sign * 5e3 * THRUST))
    names = np.array(b.contact_names)
    assert set(names[found.race_load > 0.0]) == ({"ir", "ol"} if sign > 0.0 else {"il", "or"})
    assert found.limiting in names[found.race_load > 0.0]
    assert np.isinf(found.race_life[found.race_load == 0.0]).all()
    mirrored = life.reference_life(b.equilibrium(load=-sign * 5e3 * THRUST))
    assert found.revolutions == pytest.approx(float(mirrored), rel=1e-9)


def test_three_contacts_fail_sooner_than_the_worst_one() -> None:
    found = life.life_of(four_point(R24_14).equilibrium(load=[20e3, 12e3, 0, 0, 0]))
    assert (found.race_load > 0.0).sum() == 3
    assert found.revolutions < found.race_life.min()


def test_frequencies_add_up_and_do_not_depend_on_the_hypothesis_at_equal_angles() -> None:
    for kinematics in HYPOTHESES:
        state = VEX70.equilibrium(load=300 * THRUST, kinematics=kinematics)
        found = life.frequencies(state)
        angle = float(state.inner_angle[0])
        nominal = life.nominal_frequencies(VEX70, angle)
        assert found.outer + found.inner == pytest.approx(25.0, abs=1e-12)
        assert found[:3] == pytest.approx(tuple(map(float, nominal[:3])), rel=1e-9)
        assert found.ball == pytest.approx(float(nominal.ball), rel=5e-3)
    assert life.frequencies(VEX70.equilibrium(load=[300, 300, 0, 0, 0])).spread > 1e-4


def test_orbit_is_what_the_centrifugal_force_has() -> None:
    """Fc = ½ m dm ωm², balls by the load that drives them."""
    speed = 20_000 * RPM
    state = VEX70.equilibrium(load=[500, 100, 0, 0, 0], speed=speed)
    g = state.operation.geometry
    orbit = np.sqrt(state.centrifugal_force / (g.orbital_factor * speed**2))
    assert life.frequencies(state).cage == pytest.approx(
        np.average(orbit, weights=state.inner_load), rel=1e-9
    )


@pytest.mark.parametrize(("kappa", "factor"), [(0.2, 0.1883505), (0.7, 1.127238), (2.0, 4.201611)])
def test_factor_of_iso_281(kappa: float, factor: float) -> None:
    """Equations of a_ISO of radial ball bearings, as remembered, by hand at eC Cu/P = 0.1."""
    assert life.life_factor(kappa, 0.5, 1000.0, 5000.0) == pytest.approx(factor, rel=1e-4)


def test_lives_of_races_make_up_that_of_the_bearing() -> None:
    """Probabilities of survival multiply: L^−e is the sum of those of the races, e = 10/9."""
    state = VEX70.equilibrium(load=[[610.0, 200.0, 0, 0, 0], [200.0, 0, 0, 0, 0]], speed=300.0)
    found = life.life_of(state, 23_000.0)
    together = (found.race_life ** (-10.0 / 9.0)).sum(axis=-1) ** (-9.0 / 10.0)
    assert found.revolutions == pytest.approx(together, rel=1e-12)


def test_modification_is_continuous_and_bounded() -> None:
    limit, load = 1000.0, 5000.0
    for kappa in (0.4, 1.0):
        below, above = life.life_factor([kappa * (1 - 1e-9), kappa * (1 + 1e-9)], 0.5, limit, load)
        assert below == pytest.approx(float(above), rel=2e-3)
    assert life.life_factor(9.0, 0.5, limit, load) == life.life_factor(4.0, 0.5, limit, load)
    assert life.life_factor(2.0, 1.0, limit, limit / 100) == 50.0
    assert life.life_factor(2.0, 0.0, limit, load) == pytest.approx(0.1)
    assert np.isnan(life.life_factor(0.09, 0.5, limit, load))
    rising = life.life_factor(np.geomspace(0.1, 4.0, 60), 0.3, limit, load)
    assert (np.diff(rising) > 0.0).all()


def test_reference_viscosity_has_no_step_at_1000_rpm() -> None:
    low, high = life.reference_viscosity(np.array([999.999, 1000.001]) * RPM, 0.1)
    assert low == pytest.approx(float(high), rel=0.03)
    assert high == pytest.approx(4500e-6 / math.sqrt(1000 * 100), rel=1e-4)
    assert life.viscosity_ratio(68e-6, 0.0, 0.1) == 0.0


def test_spectra_and_sets() -> None:
    assert life.mean_life([1, 1], [2e6, 2e6]) == pytest.approx(2e6)
    assert life.mean_life([0.9, 0.1], [1e9, 1e6]) == pytest.approx(1 / (0.9e-9 + 0.1e-6))
    assert life.mean_life([1.0, 0.0], [np.inf, 1.0]) == np.inf
    rows = np.array([[1e6, 3e6], [2e6, 2e6]])
    for share in (1.0, 7.0, [1.0, 1.0], [[2.0, 2.0], [5.0, 5.0]], [[3.0], [4.0]]):
        found = life.mean_life(share, rows, axis=1)
        assert found == pytest.approx([1.5e6, 2e6])  # of equal shares, whatever their size
    assert life.mean_life([[0.25, 0.75], [1.0, 0.0]], rows, axis=1) == pytest.approx([2e6, 2e6])
    assert life.mean_life([0.25, 0.75], rows) == pytest.approx(
        [1.6e6, 1 / (0.25 / 3e6 + 0.75 / 2e6)]
    )
    with pytest.raises(InvalidBearing, match="shares"):
        life.mean_life([[1.0, 1.0], [0.0, 0.0]], rows, axis=1)
    assert life.set_life([1e6, 1e6]) == pytest.approx(1e6 * 2**-0.9)
    assert life.set_life([1e6, np.inf]) == pytest.approx(1e6)


def test_fatigue_limit_of_large_bearings() -> None:
    assert life.fatigue_load_limit(22e3, 0.09) == pytest.approx(1000.0)
    assert life.fatigue_load_limit(22e3, 0.4) == pytest.approx(500.0)


def test_tables_of_factors() -> None:
    assert life.reliability_factor(0.99) == 0.25
    assert [life.temperature_factor(t) for t in (20, 175, 300)] == pytest.approx([1, 0.865, 0.22])


def test_open_grooves_lose_rating() -> None:
    """fi 0.56 and fo 0.54 leave 0.68 of the rating of closed grooves."""
    closed = replace(VEX70, inner_conformity=0.52, outer_conformity=0.52)
    ratio = life.dynamic_rating(VEX70) / life.dynamic_rating(closed)
    assert ratio == pytest.approx(0.68, abs=0.01)


def test_static_rating_is_the_load_that_dents() -> None:
    """5/(z cos α) of C0 on one ball gives 4200 MPa on the worse race."""
    c0 = life.static_rating(VEX70)
    ball = 5 * c0 / (25 * math.cos(VEX70.contact_angle))
    g = VEX70.equilibrium(load=THRUST).operation.geometry
    worse = max(race.peak_pressure(np.array(ball)) for race in (g.inner, g.outer))
    assert worse == pytest.approx(4.2e9)
    assert life.static_rating(VEX70, 2.1e9) == pytest.approx(c0 / 8)


@pytest.mark.parametrize(
    ("call", "word"),
    [
        (lambda: life.reference_life(VEX70.equilibrium(load=THRUST), -1.0), "dynamic_rating"),
        (lambda: life.life_of(VEX70.equilibrium(load=THRUST), rotating="cage"), "rotating"),
        (lambda: life.reliability_factor(0.93), "a1 is tabulated"),
        (lambda: life.temperature_factor(400.0), "300 °C"),
        (lambda: life.life_factor(1.0, 2.0, 1.0, 1.0), "contamination"),
        (lambda: life.mean_life([-1.0, 2.0], [1.0, 1.0]), "shares"),
        (lambda: life.static_rating(VEX70, 0.0), "pressure"),
        (lambda: life.dynamic_load(1.0, 1.0, 0.3), "no factors X and Y"),
        (lambda: life.dynamic_load(1.0, 1.0, math.radians(15.0)), "15° needs axial_over_static"),
        (lambda: life.equivalent_static(1.0, 1.0, 1.3), "no factor Y0"),
        (lambda: life.pair_rating(1.0, 0), "rows"),
        (lambda: life.basic_life(-1.0, 1.0), "rating must not be negative"),
        (lambda: life.mean_life([1.0, 1.0], [-1.0, 2.0]), "lives must not be negative"),
    ],
)
def test_bad_input_gets_a_sentence(call: object, word: str) -> None:
    with pytest.raises(InvalidBearing, match=word):
        call()  # type: ignore[operator]


def test_rating_of_scaled_grooves() -> None:
    """ISO 281: as D^1.8 of balls up to 25.4 mm, as D^1.4 above, the same there to its digits;
    ISO 76: as D^2, the pressure being given."""

    def scaled(ball: float) -> Grooves:
        own = VEX70.grooves
        size = ball / own.ball_diameter
        return replace(
            own,
            ball_diameter=ball,
            pitch_diameter=own.pitch_diameter * size,
            radial_gap=own.radial_gap * size,
        )

    def power(of: Callable[[Grooves], float], ball: float, larger: float) -> float:
        return math.log(of(scaled(larger)) / of(scaled(ball))) / math.log(larger / ball)

    assert power(life.dynamic_rating, 5e-3, 25e-3) == pytest.approx(1.8, rel=1e-9)
    assert power(life.dynamic_rating, 26e-3, 60e-3) == pytest.approx(1.4, rel=1e-9)
    at = [life.dynamic_rating(scaled(25.4e-3 * (1.0 + e))) for e in (-1e-9, 1e-9)]
    assert at[1] == pytest.approx(at[0], rel=1e-4)
    assert power(life.static_rating, 5e-3, 60e-3) == pytest.approx(2.0, rel=1e-9)


def test_spread_of_the_balls_is_of_those_that_the_inner_race_drives() -> None:
    """Highest less lowest speed around the axis, none of balls that are all alike."""
    even = VEX70.equilibrium(load=500.0 * THRUST, speed=12_000 * RPM)
    assert life.frequencies(even).spread == pytest.approx(0.0, abs=1e-12)
    load = np.array([300.0, 2500.0, 0.0, 0.0, 0.0])
    state = VEX70.equilibrium(load=load, speed=12_000 * RPM, kinematics="outer")
    load = np.asarray(state.inner_load)
    driven, orbit = load > 0.05 * load.max(), ball_motion(state).orbit
    assert 0 < driven.sum() < (load > 0.0).sum() < len(load)
    assert (state.driven == driven).all()
    found = life.frequencies(state)
    assert found.spread == pytest.approx(float(np.ptp(orbit[driven])))
    assert found.spread > 1e-4  # among those that are driven
    pressed = load > 0.0
    assert found.cage == pytest.approx(np.average(orbit[pressed], weights=load[pressed]))


@pytest.mark.parametrize(("one", "other"), [(0.52, 0.54), (0.515, 0.58)])
def test_races_of_a_thrust_bearing_can_change_places(one: float, other: float) -> None:
    """At 90° both are alike but for their conformity: C^(−10/3) is the sum over both races."""

    def factor(inner: float, outer: float) -> float:
        bearing = ThrustBallBearing(
            9.525e-3, 60e-3, 14, inner_conformity=inner, outer_conformity=outer
        )
        return life.geometry_factor(bearing)

    assert factor(one, other) == pytest.approx(factor(other, one), rel=1e-12)
    both = 0.5 * (factor(one, one) ** (-10 / 3) + factor(other, other) ** (-10 / 3))
    assert factor(one, other) == pytest.approx(both**-0.3, rel=1e-12)
