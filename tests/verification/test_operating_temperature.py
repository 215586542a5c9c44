"""From assembly to speed: fits, rotation and temperature, by Lamé's equations solved again, closed
forms, and what must not change."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from bearings import AngularContactBallBearing, Material
from bearings.materials import STEEL
from rotordyn.analyses import PreloadSpec, ThermalPreloadSpec
from rotordyn.analyses.preload.solve import solve as preload_answer
from rotordyn.analyses.preload.summary import summary as preload_summary
from rotordyn.analyses.thermal_preload.figures import figures, headline_curves
from rotordyn.analyses.thermal_preload.solve import solve as solve_thermal_preload
from rotordyn.analyses.thermal_preload.summary import numbers, summary, warnings
from rotordyn.errors import InvalidInput
from rotordyn.machine import BearingTemperatures, Fits, RingGrowth, Temperatures
from rotordyn.machine.growth import InterferenceFit, QuadraticInSpeed
from rotordyn.machine.history import HistoryStep
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.growth import (
    inner_fit,
    outer_fit,
    released_fits,
    ring_growth,
    static_growth,
)
from rotordyn.preload.ring_stress import ring_stress
from rotordyn.preload.shortening import thermal_shifts
from rotordyn.results.described import Shown
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import RPM, conditions, mfw2310

Array = NDArray[np.float64]
CERAMIC = Material("Si3N4", 315e9, 0.26, 3190.0, 3.2e-6)
IRON = Material("cast iron", 110e9, 0.26, 7200.0, 10.5e-6)
BORE, OUTSIDE = 0.070, 0.110
FITS = Fits(shaft="k5", housing="K6", bore_diameter=BORE, outside_diameter=OUTSIDE)


def bearing(balls: Material = STEEL) -> AngularContactBallBearing:
    return AngularContactBallBearing(
        9.525e-3, 90e-3, 24, contact_angle=math.radians(25.0), ball_material=balls
    )


def spindle(
    fits: Fits | None = FITS, balls: Material = STEEL, stiffness: float = math.inf, **seat: Any
) -> Spindle:
    """Two bearings back to back, 200 mm apart, the rear one in a sleeve."""
    seats = (
        BearingSeat("front", bearing(balls), 0.05, thrust=1, fits=fits, **seat),
        BearingSeat("rear", bearing(balls), 0.25, thrust=-1, fits=fits, **seat),
    )
    sleeve = Sleeve("rear", ("rear",), Spring(500.0, stiffness))
    shaft = Shaft(0.0, (Section(0.3, BORE, 0.030, STEEL),))
    return Spindle("pair", shaft, seats=seats, sleeves=(sleeve,))


def scene(machine: Spindle, rpm: list[float], temperatures: Temperatures | None = None) -> Scene:
    return Scene(machine, Conditions(temperatures=temperatures), np.array(rpm) * RPM)


# --- growth of rings ---------------------------------------------------------------------------


def lame(
    bodies: list[tuple[float, float, Material, float]], depth: float, omega: float, at: float
) -> float:
    """u at radius ``at`` of two bodies (ri, ro, material, rise) pressed by ``depth`` on the radius,
    by the equations of equilibrium of every body, boundary and continuity conditions at once."""
    equations, right = np.zeros((4, 4)), np.zeros(4)

    def stress(body: int, r: float) -> tuple[Array, float]:
        """σr as coefficients of (A, B) of the body, and what rotation and heat add."""
        _, _, m, rise = bodies[body]
        e, nu = m.young_modulus, m.poisson_ratio
        c = -m.density * omega**2 * (1 - nu**2) / (8 * e)
        own = np.zeros(4)
        own[2 * body : 2 * body + 2] = e / (1 - nu**2) * np.array([1 + nu, -(1 - nu) / r**2])
        rotation = e / (1 - nu**2) * (3 + nu) * c * r**2
        heat = -e / (1 - nu) * m.thermal_expansion * rise
        return own, rotation + heat

    def moved(body: int, r: float) -> tuple[Array, float]:
        m = bodies[body][2]
        own = np.zeros(4)
        own[2 * body : 2 * body + 2] = r, 1 / r
        c = -m.density * omega**2 * (1 - m.poisson_ratio**2) / (8 * m.young_modulus)
        return own, c * r**3

    inner, fit, outer = bodies[0][0], bodies[0][1], bodies[1][1]
    rows = [
        stress(0, inner),
        stress(1, outer),
        tuple(a - b for a, b in zip(stress(0, fit), stress(1, fit), strict=True)),
        tuple(a - b for a, b in zip(moved(1, fit), moved(0, fit), strict=True)),
    ]
    wanted = [0.0, 0.0, 0.0, depth]
    for k, ((own, given), value) in enumerate(zip(rows, wanted, strict=True)):
        equations[k], right[k] = own, value - given
    scale = np.abs(equations).max(axis=1)
    columns = np.array([1.0, fit**2, 1.0, fit**2])
    found = columns * np.linalg.solve(equations / scale[:, None] * columns, right / scale)
    body = 0 if at < fit else 1
    own, given = moved(body, at)
    return float(own @ found + given)


@pytest.mark.parametrize("rpm", [0.0, 15000.0])
def test_growth_is_that_of_lames_rings_and_the_rotating_disc(rpm: float) -> None:
    """Both rings, both seats of other materials, temperatures of all five: to rounding."""
    fits = replace(FITS, taken="most", housing_diameter=0.16, housing_material=IRON)
    machine = spindle(fits, CERAMIC)
    seat = machine.seats[0]
    warm = Temperatures(
        shaft=41.0, housing=27.0, inner_rings=44.0, outer_rings=35.0, balls=52.0, reference=20.0
    )
    found = ring_growth(machine, seat, np.array([rpm * RPM]), warm)[0]
    own = seat.bearing
    race, outer_race = own.inner_raceway_radius, own.outer_raceway_radius
    depth = fits.depth("inner"), fits.depth("outer")
    assert depth[1] > 0.0, "the outer ring is pressed in"
    shaft = [(0.015, BORE / 2, STEEL, 21.0), (BORE / 2, race, STEEL, 24.0)]
    housing = [(outer_race, OUTSIDE / 2, STEEL, 15.0), (OUTSIDE / 2, 0.08, IRON, 7.0)]
    inner = lame(shaft, depth[0], rpm * RPM, race)
    outer = lame(housing, depth[1], 0.0, outer_race)
    balls = 3.2e-6 * 9.525e-3 * math.cos(math.radians(25.0)) * 32.0
    assert found == pytest.approx(inner - outer + balls, rel=1e-12, abs=1e-12 * abs(inner))


def test_fits_are_those_of_the_tables() -> None:
    """k5 on a bore of P4, K6 around an outside of P4: deviations by hand [µm]."""
    assert FITS.inner.least == pytest.approx(2e-6)
    assert FITS.inner.most == pytest.approx((15 + 7) * 1e-6)
    assert FITS.outer.most == pytest.approx(18e-6)
    assert FITS.outer.least == pytest.approx((-8 - 4) * 1e-6)
    assert replace(FITS, smoothing=3e-6).depth("inner") == pytest.approx((12e-6 - 3e-6) / 2)
    fit = inner_fit(spindle().seats[0])
    assert fit is not None
    assert fit.interference == pytest.approx(6e-6)
    fit = outer_fit(spindle().seats[0])
    assert fit is not None
    assert fit.interference == pytest.approx(1.5e-6)


def test_each_seat_has_its_own_fit_and_mounted_growth() -> None:
    machine = spindle()
    tight = replace(machine.seats[1], fits=replace(FITS, taken="most"))
    both = [static_growth(machine, seat) for seat in (machine.seats[0], tight)]
    assert both[1] > both[0] > 0.0
    loose = replace(FITS, housing="H6")
    assert static_growth(machine, replace(tight, fits=loose)) < static_growth(machine, tight)


@pytest.mark.parametrize("taken", ["mean", "least", "most"])
def test_a_steel_bearing_heated_uniformly_keeps_its_angle(taken: str) -> None:
    machine = spindle(replace(FITS, taken=taken))
    seat, speed = machine.seats[0], np.array([0.0, 12000 * RPM])
    warm = Temperatures(shaft=70.0, housing=70.0)
    change = ring_growth(machine, seat, speed, warm) - ring_growth(machine, seat, speed)
    assert np.abs(change).max() < 1e-18
    cold, hot = (scene(machine, [0.0, 12000.0], t).preload for t in (None, warm))
    angles = [s.seat_states()[0][0].inner_angle[:, 0, 0] for s in (cold, hot)]
    assert angles[1] == pytest.approx(angles[0], rel=1e-12)
    assert hot.seat_load() == pytest.approx(cold.seat_load(), rel=1e-9)


def test_ceramic_balls_do_not_keep_it() -> None:
    """Rings that expand by 50 K around balls that do not: less growth by α D cos α 50 K."""
    machine = spindle(balls=CERAMIC)
    warm = Temperatures(shaft=70.0, housing=70.0)
    change = ring_growth(machine, machine.seats[0], np.zeros(1), warm) - static_growth(
        machine, machine.seats[0]
    )
    known = (3.2e-6 - 11.5e-6) * 9.525e-3 * math.cos(math.radians(25.0)) * 50.0
    assert change[0] == pytest.approx(known, rel=1e-12)


def test_a_given_growth_takes_the_temperature_of_free_rings() -> None:
    machine = spindle(None, growth=RingGrowth(static=3e-6))
    warm = Temperatures(shaft=30.0, housing=20.0, balls=20.0)
    found = ring_growth(machine, machine.seats[0], np.zeros(1), warm)[0]
    race = machine.seats[0].bearing.inner_raceway_radius
    assert found == pytest.approx(3e-6 + 11.5e-6 * 10.0 * race, rel=1e-12)


@pytest.mark.parametrize(
    "growth",
    [
        RingGrowth(static=3e-6),
        RingGrowth(static=3e-6, centrifugal=QuadraticInSpeed(5e-6, 12000 * RPM)),
        RingGrowth(static=3e-6, centrifugal="computed", fit=InterferenceFit(BORE, 5e-6)),
    ],
)
def test_growth_at_a_speed_has_the_temperatures_of_that_speed(growth: RingGrowth) -> None:
    """As if these were the same at all speeds."""
    machine, top = spindle(None, growth=growth), np.array([6000.0, 12000.0]) * RPM
    ends = {"shaft": (20.0, 60.0), "housing": (20.0, 30.0)}
    table = Temperatures(**ends, speeds=(0.0, 12000 * RPM))
    seat = machine.seats[0]
    over = ring_growth(machine, seat, top, table)
    for k, (shaft, housing) in enumerate([(40.0, 25.0), (60.0, 30.0)]):
        same = Temperatures(shaft=shaft, housing=housing)
        assert over[k] == pytest.approx(
            ring_growth(machine, seat, top[k : k + 1], same)[0], rel=1e-12
        )
    cold = ring_growth(machine, seat, top)
    assert (over > cold + 2e-6).all()


def test_a_ring_that_lets_go_grows_alone_and_is_named() -> None:
    """Past the speed of release the shaft does not help: growth is that of the ring alone, less
    what the fit took."""
    fits = replace(FITS, taken="least")
    machine = spindle(fits)
    seat = machine.seats[0]
    (first, _) = released_fits(machine, np.array([40000 * RPM]))
    assert (first.bearing, first.ring) == ("front", "inner")
    own, top = seat.bearing, np.array([1.05, 1.1]) * first.speed
    race, nu = own.inner_raceway_radius, 0.3
    a, b = BORE / 2, race
    factor = STEEL.density * top**2 / STEEL.young_modulus * b / 4
    alone = factor * ((1 - nu) * b**2 + (3 + nu) * a**2)
    still = ring_growth(machine, seat, np.zeros(1))[0] - _inner_growth(machine, 0.0)
    assert ring_growth(machine, seat, top) - still == pytest.approx(alone, rel=1e-10)
    found = scene(machine, [0.0, first.speed / RPM * 1.1])
    assert any("rings loosen" in word and "without the shaft" in word for word in found.warnings)


def test_an_inner_ring_that_yields_is_named() -> None:
    """Fits by their classes on a hot shaft: hoop stress and pressure by Lamé's equations, of shaft
    and ring of one material, rise with the temperature between them."""
    machine, rest = spindle(), np.zeros(1)
    stressed = [
        ring_stress(machine, rest, Temperatures(shaft=20.0 + rise, inner_rings=20.0))[0, 0]
        for rise in (0.0, 100.0)
    ]
    race, radius = bearing().inner_raceway_radius, BORE / 2
    wall = (radius**2 + race**2) / (race**2 - radius**2)
    hole = machine.shaft.diameters_at(0.05)[1] / 2
    share = (race**2 - radius**2) * (radius**2 - hole**2) / (race**2 - hole**2) / radius**2
    pressure = 0.5 * STEEL.young_modulus * 11.5e-6 * 100.0 * share
    assert np.diff(stressed)[0] == pytest.approx(pressure * (wall + 1.0), rel=1e-9)
    deep = (1.6e9 / np.diff(stressed)[0]) * 11.5e-6 * 100.0 * radius
    tight = RingGrowth(static=0.0, centrifugal="computed", fit=InterferenceFit(BORE, deep))
    own = scene(spindle(None, growth=tight), [0.0])
    assert any("rings yield under their fits, up to 1600 MPa" in word for word in own.warnings)


def _inner_growth(machine: Spindle, speed: float) -> float:
    from rotordyn.preload.growth import inner_ring

    seat = machine.seats[0]
    ((_, state),) = inner_ring(machine, seat, np.array([speed]))
    return float(state.radial_growth(seat.bearing.inner_raceway_radius)[0])


def test_a_warm_ring_lets_go_earlier_and_a_cold_housing_grips() -> None:
    machine = spindle()
    speeds = np.linspace(0.0, 40000 * RPM, 9)
    plain = released_fits(machine, speeds)[0].speed
    warm = released_fits(machine, speeds, Temperatures(shaft=20.0, inner_rings=23.0))[0].speed
    assert warm < plain
    loose = released_fits(machine, np.zeros(1), Temperatures(housing=60.0, outer_rings=20.0))
    assert [each.ring for each in loose] == ["outer", "outer"]
    assert [each.held for each in loose] == [0.0, 0.0]


def test_a_ring_that_warms_up_with_speed_lets_go_between_two_of_the_case() -> None:
    """The ring is tight at rest, and loose at speed at any rate where it is 60 K warmer."""
    machine = spindle()
    warming = Temperatures(shaft=20.0, inner_rings=(20.0, 80.0), speeds=(0.0, 9000 * RPM))

    def said(*rpm: float) -> list[str]:
        own = scene(machine, list(rpm), warming)
        return [
            word.partition("loosen ")[2].partition(",")[0]
            for word in own.warnings
            if "rings loosen" in word
        ]

    assert said(0.0) == []
    assert said(0.0, 100.0, 9000.0) == ["between 100 and 9000 rpm"]
    assert said(9000.0) == ["by 9000 rpm"]


# --- along the axis ------------------------------------------------------------------------------


def test_ten_kelvin_move_the_rear_of_the_flagship_by_forty_micrometres() -> None:
    """Noël 2013: about 40 µm between front and rear; α L ΔT, and the springs that follow."""
    machine, speed = mfw2310(), np.zeros(1)
    warm = Temperatures(shaft=30.0, inner_rings=20.0, outer_rings=20.0, balls=20.0)
    shift = thermal_shifts(machine, speed, warm)[0]
    x = np.array([seat.x for seat in machine.seats])
    assert shift - shift[0] == pytest.approx(11.5e-6 * 10.0 * (x - x[0]), rel=1e-12)
    assert shift[3:].mean() - shift[:2].mean() == pytest.approx(40e-6, rel=0.03)
    cold, hot = (Scene(machine, conditions(temperatures=t), speed).preload for t in (None, warm))
    moved = hot.shift - cold.shift
    assert moved[0, 2] - moved[0, 0] == pytest.approx(40e-6, rel=0.05), "rear sleeve and shaft"


def test_a_housing_as_warm_as_the_shaft_shifts_nothing() -> None:
    machine = mfw2310()
    warm = Temperatures(shaft=55.0, housing=55.0)
    assert np.abs(thermal_shifts(machine, np.zeros(1), warm)).max() < 1e-19
    light = replace(warm, housing_expansion=23e-6)
    rear = thermal_shifts(machine, np.zeros(1), light)[0, -1]
    start = machine.seats[0].x
    assert rear == pytest.approx((11.5e-6 - 23e-6) * 35.0 * (machine.seats[-1].x - start))


def test_mounted_hot_and_running_preload() -> None:
    """Mounted: as stated, at 20 °C; hot: at rest; running: at speed. A spring hides the shift."""
    warm = Temperatures(shaft=28.0, housing=20.0, inner_rings=28.0, outer_rings=22.0, balls=28.0)
    result = preload_answer(scene(spindle(), [0.0, 12000.0], warm), PreloadSpec())
    assert result.mounted_load == pytest.approx([500.0, 500.0], rel=1e-9)
    assert abs(result.axial_load[0, 0] - 500.0) > 20.0
    assert result.axial_load[1, 0] > result.axial_load[0, 0]
    assert "mounted\u00a0500" in preload_summary(result)[0]
    soft = preload_answer(scene(spindle(stiffness=1e3), [0.0], warm), PreloadSpec())
    assert soft.axial_load[0, 0] == pytest.approx(500.0, rel=1e-3)


def test_rigid_preload_by_closed_form() -> None:
    """Both bearings of a rigid pair keep the sum of their axial displacements, less what the shaft
    gains on the housing, and what balls that swell press the rings apart: solved by hand from the
    law of one bearing."""
    from scipy.optimize import brentq

    machine = spindle()
    warm = Temperatures(shaft=26.0, inner_rings=26.0, balls=29.0)
    own, seat = bearing(), machine.seats[0]
    static, grown = static_growth(machine, seat), ring_growth(machine, seat, np.zeros(1), warm)[0]
    start = own.equilibrium(load=[500.0, 0, 0, 0, 0], static_growth=static).displacement[0]
    lost = 11.5e-6 * 6.0 * 0.2
    apart = 11.5e-6 * 9.525e-3 * (9.0 - 0.5 * 6.0) * math.sin(math.radians(25.0))
    each = start - lost / 2.0 + apart

    def load(d: float) -> float:
        state = own.equilibrium(displacement=[d, 0, 0, 0, 0], static_growth=static, growth=grown)
        return float(state.load[0])

    found = scene(machine, [0.0], warm).preload
    assert found.seat_load()[0] == pytest.approx([load(each)] * 2, rel=1e-8)
    assert brentq(lambda d: load(d) - found.seat_load()[0, 0], 0, 1e-4) == pytest.approx(each)


def test_a_steel_spindle_that_is_as_warm_all_over_keeps_its_rigid_preload() -> None:
    """Balls of another material do not: they leave play along the axis, too, at any angle."""
    warm = Temperatures(shaft=60.0, housing=60.0)
    for balls, keeps in ((STEEL, True), (CERAMIC, False)):
        cold, hot = (scene(spindle(None, balls), [0.0], t).preload for t in (None, warm))
        same = hot.seat_load() == pytest.approx(cold.seat_load(), rel=1e-9)
        assert same == keeps
    assert "preload lost" in hot.outcome[0]


def test_a_difference_without_a_state_says_why() -> None:
    found = scene(spindle(), [0.0, 8000.0], Temperatures(shaft=25.0, housing=22.0))
    result = solve_thermal_preload(found, ThermalPreloadSpec(differences=(0.0, 150.0, 200.0)))
    lost = np.isnan(result.axial_load).any(axis=-1)
    assert lost.tolist() == (result.state != "").tolist() == [[False, True, True]] * 2
    assert all("preload lost" in word for word in result.state[lost])
    assert sum("no state at +150 K and 1 more: " in line for line in summary(result)) == 2
    (told,) = warnings(result)
    assert told.startswith("thermal_preload: at +150 K (and in 3 more states) bearing ")
    assert "preload lost" in told
    found_at = {each.words: each.value for each in numbers(result, None)}  # type: ignore[arg-type]
    assert found_at["difference without a state at 0 rpm"] == 150.0
    assert found_at["load at 0 rpm"] == np.nanmax(result.axial_load[0])


def test_temperatures_over_speed_and_of_one_bearing() -> None:
    table = Temperatures(
        shaft=(20.0, 40.0),
        speeds=(0.0, 12000 * RPM),
        bearings={"rear": BearingTemperatures(inner_ring=50.0)},
    )
    speed = np.array([0.0, 6000 * RPM, 12000 * RPM])
    assert table.rises("front", speed).inner == pytest.approx([0.0, 10.0, 20.0])
    assert table.rises("front", speed).balls == pytest.approx([0.0, 5.0, 10.0])
    assert table.rises("rear", speed).inner == pytest.approx([30.0] * 3)
    machine = spindle()
    at_top = scene(machine, [12000.0], table).preload.seat_load()
    over = scene(machine, [0.0, 6000.0, 12000.0], table).preload.seat_load()
    assert over[-1] == pytest.approx(at_top[0], rel=1e-9)


def test_preload_over_temperature_difference() -> None:
    """Each difference is the state of a case of its own; the difference 0 is that of the case."""
    base = Temperatures(shaft=25.0, housing=22.0)
    found = scene(spindle(), [0.0, 8000.0], base)
    result = solve_thermal_preload(found, ThermalPreloadSpec(differences=(-4.0, 0.0, 4.0)))
    assert result.axial_load[:, 1] == pytest.approx(found.preload.seat_load(), rel=1e-12)
    other = Temperatures(shaft=29.0, housing=22.0)
    direct = scene(spindle(), [0.0, 8000.0], other).preload
    assert result.axial_load[:, 2] == pytest.approx(direct.seat_load(), rel=1e-12)
    assert result.growth[:, 2] == pytest.approx(direct.seat_growth(), rel=1e-12)
    assert len(summary(result)) == 2
    assert [*warnings(result)] == []
    largest, _, *lost = (each.value for each in numbers(result, None))  # type: ignore[arg-type]
    assert largest == result.axial_load[0].max()
    assert np.isnan(lost).all()
    assert [name for name, _ in figures(None, result, {})] == ["thermal_preload"]  # type: ignore[arg-type]
    curves = list(headline_curves(None, Shown("", result, (), spindle())))
    assert len(curves) == 4


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "build"),
    [
        ("no temperature is given", Temperatures),
        ("needs one value for each of speeds", lambda: Temperatures(shaft=(20.0, 30.0))),
        ("no class is given", Fits),
        ("the fit k5 needs it", lambda: Fits(shaft="k5")),
        ("not a class of a shaft", lambda: Fits(shaft="K5", bore_diameter=0.07)),
        ("unknown tolerance class 'q5'", lambda: Fits(shaft="q5", bore_diameter=0.07)),
        ("leaves no housing", lambda: replace(FITS, housing_diameter=0.1)),
        (
            "fits contradict a given growth",
            lambda: replace(spindle().seats[0], growth=RingGrowth(static=1e-6)),
        ),
        (
            "leaves no ring beside the balls",
            lambda: replace(spindle().seats[0], fits=replace(FITS, bore_diameter=0.082)),
        ),
    ],
)
def test_bad_input_is_one_sentence(words: str, build: Any) -> None:
    with pytest.raises(InvalidInput, match=words):
        build()


def test_bad_input_against_the_machine() -> None:
    from rotordyn.scene.agreement import last_setting_faults, setting_faults
    from rotordyn.scene.spec import Setting

    machine = spindle()
    cases = {
        "unknown bearing": Temperatures(bearings={"c": BearingTemperatures(balls=30.0)}),
        "does not reach 9000 rpm": Temperatures(shaft=(20.0, 30.0), speeds=(0.0, 8000 * RPM)),
    }
    for words, warm in cases.items():
        setting = Setting(machine, Conditions(temperatures=warm), (0.0, 9000 * RPM))
        assert any(words in sentence for _, sentence in setting_faults(setting)), words
    running = Temperatures(shaft=(20.0, 30.0), speeds=(3000 * RPM, 9000 * RPM))
    for how, said in (
        ("static", "does not reach 0 rpm, at which bearings are solved"),
        ("dynamic", ""),
    ):
        conditions = Conditions(temperatures=running, bearings=how)
        words = [word for _, word in setting_faults(Setting(machine, conditions, (6000 * RPM,)))]
        assert any(said in word for word in words) == bool(said)
    rubbing = spindle(stiffness=5e7)
    rubbing = replace(rubbing, sleeves=(replace(rubbing.sleeves[0], friction=50.0),))
    passing = Conditions(
        temperatures=replace(running, speeds=(0.0, 9000 * RPM)),
        bearings="static",
        history=(HistoryStep(speed=9500 * RPM), HistoryStep(run_up=True)),
    )
    words = [word for _, word in setting_faults(Setting(rubbing, passing, (6000 * RPM,)))]
    assert any("9500 rpm, which the history of its friction passes" in word for word in words)
    wide = replace(FITS, shaft="p5", taken="most")
    shallow = replace(bearing(), contact_angle=math.radians(10.0))
    seats = tuple(replace(s, bearing=shallow, fits=wide) for s in machine.seats)
    setting = Setting(replace(machine, seats=seats), Conditions(), (0.0,))
    assert any("contact angle to 0" in sentence for _, sentence in last_setting_faults(setting))
