"""Life and heat of the bearings of spindles: against single bearings, sentences for bad input."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from bearings import STEEL, Lubricant, film, heat, life
from rotordyn.analyses import LifeSpec, LoadStep, Lubrication
from rotordyn.analyses.life.spec import RELIABILITIES
from rotordyn.analyses.life.summary import numbers, summary, warnings
from rotordyn.case.vary import vary
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.together import dynamic_preload
from rotordyn.results.severity import Severity, severity_of
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.lubrication import SUPPLIES
from tests.hostile.numbers import unexplained
from tests.oracles.spindles import RPM, answers, case, conditions, mfw2310

OIL = Lubrication("32 mm^2/s", "5.4 mm^2/s", "55 degC")  # type: ignore[arg-type]
SPEEDS = (0, 12000, 24000)
STEPS = (
    LoadStep(share=0.6, speed=9000 * RPM),
    LoadStep(share=0.3, speed=12000 * RPM, axial_force=300.0),
    LoadStep(share=0.1, speed=6000 * RPM, radial={"a": 600.0}),
)


@cache
def flagship() -> Any:
    return answers(mfw2310(), SPEEDS, {"life": LifeSpec(OIL)})["life"]


def grinding() -> Spindle:
    found = case("grinding_spindle").spindle
    assert found is not None
    return found


def of_grinding(
    spec: LifeSpec, spindle: Spindle | None = None, rpm: tuple[int, ...] = (6000,)
) -> Any:
    own = grinding() if spindle is None else spindle
    return answers(own, rpm, {"life": spec}, kinematics="hybrid")["life"]


def test_static_rating_of_a_catalogue_scales_palmgrens_moment() -> None:
    """f1 ~ C0^−0.33 of angular-contact bearings, in the heat of the bearing that has it."""
    spec = LifeSpec(OIL, heat="palmgren")
    plain = of_grinding(spec)
    rated = of_grinding(replace(spec, static_ratings={"a": 3.0 * plain.static_rating[0]}))
    for name in ("inner_heat", "outer_heat"):
        ours, theirs = getattr(rated, name)[0], getattr(plain, name)[0]
        assert ours == pytest.approx(theirs * [3.0**-0.33, 1.0, 1.0, 1.0])


@pytest.mark.parametrize("seat", [0, 2, 4])
def test_values_of_a_single_bearing(seat: int) -> None:
    """The same bearing alone under the load and growth of its preload state, at 12 000 rpm."""
    ours, spindle = flagship(), mfw2310()
    state = dynamic_preload(spindle, np.array(SPEEDS) * RPM, conditions().law)
    bearing = spindle.seats[seat].bearing
    alone = bearing.equilibrium(
        load=[float(state.seat_load()[1, seat]), 0, 0, 0, 0],
        speed=12000 * RPM,
        static_growth=43.2e-6,
        growth=float(state.seat_growth()[1, seat]),
        kinematics="outer",
    )
    oil = Lubricant(32e-6, 5.4e-6)
    lived, lost = life.life_of(alone), heat.losses(alone, oil, 55.0)
    hours = float(lived.revolutions) / 12000 * 60
    assert ours.revolutions[1, seat] == pytest.approx(float(lived.revolutions), rel=1e-6)
    assert ours.life[1, seat] == pytest.approx(hours, rel=1e-6)
    assert ours.limiting[1, seat] == str(lived.limiting)
    assert ours.heat[1, seat] == pytest.approx(float(lost.total), rel=1e-6)
    assert ours.film[1, seat] == pytest.approx(float(film.film(alone, oil, 55.0).least.min()))
    assert ours.static_safety[1, seat] == pytest.approx(float(life.static_safety(alone)), rel=1e-6)
    assert ours.cage[1, seat] == pytest.approx(float(life.frequencies(alone).cage), rel=1e-9)
    kappa = life.viscosity_ratio(oil.kinematic(55.0), 12000 * RPM, bearing.pitch_diameter)
    assert ours.viscosity_ratio[1, seat] == pytest.approx(float(kappa))
    limit = life.fatigue_load_limit(life.static_rating(bearing), bearing.pitch_diameter)
    factor = life.life_factor(kappa, 0.5, limit, lived.equivalent_load)
    assert ours.modified_life[1, seat] == pytest.approx(float(factor) * hours, rel=1e-6)


def test_steep_bearings_have_no_modified_life() -> None:
    """ISO 281 has another a_ISO for thrust bearings, those of more than 45°."""
    spindle = grinding()
    for steep in ("a", "*"):
        one = vary(spindle, {f"bearings.{steep}.model.contact_angle": "50 deg"})
        found = of_grinding(LifeSpec(OIL), one)
        thrust = np.array([steep == "*" or name == steep for name in found.bearing])
        assert np.isnan(found.modified_life[:, thrust]).all()
        assert np.isfinite(found.modified_life[:, ~thrust]).all()
        assert np.isfinite(found.life).all()
        assert (found.viscosity_ratio > 0.1).all()
        names = ", ".join(np.array(found.bearing)[thrust])
        assert f"; of {names} none: a_ISO is not known above 45°" in "\n".join(summary(found))
        assert not list(unexplained(found))
    flat = vary(spindle, {"bearings.*.model.contact_angle": "45 deg"})
    assert "above 45°" not in "\n".join(summary(of_grinding(LifeSpec(OIL), flat)))


def test_set_and_rest() -> None:
    ours = flagship()
    assert np.isinf(ours.life[0]).all()
    assert np.isinf(ours.set_life[0])
    assert np.isnan(ours.modified_life[0]).all()
    by_hand = (ours.life[2] ** (-10 / 9)).sum() ** -0.9
    assert ours.set_life[2] == pytest.approx(by_hand)
    assert ours.set_life[2] < ours.life[2].min()
    assert (ours.heat[0] == 0.0).all()


def test_catalogue_rating_scales_life_with_its_cube() -> None:
    plain = of_grinding(LifeSpec())
    rated = of_grinding(LifeSpec(dynamic_ratings={"a": 20_000.0}))
    ratio = (20_000 / plain.groove_rating[0]) ** 3
    assert rated.life[0, 0] == pytest.approx(ratio * plain.life[0, 0])
    assert rated.life[0, 1] == plain.life[0, 1]
    assert np.isnan(plain.heat).all()
    assert np.isnan(plain.spectrum_set_life)


def test_static_rating_of_a_catalogue_scales_safety_and_fatigue_limit() -> None:
    """S0 = C0/P0 and Cu = C0/22 go with C0, a_ISO by Cu; basic lives do not know of it."""
    step, dirty = (LoadStep(share=1.0, speed=6000 * RPM),), replace(OIL, contamination=0.02)
    spec = LifeSpec(dirty, spectrum=step)
    plain = of_grinding(spec)
    rated = of_grinding(replace(spec, static_ratings={"a": 30_000.0}))
    ratio = 30_000.0 / plain.groove_static_rating[0]
    assert plain.static_rating == pytest.approx(plain.groove_static_rating)
    assert rated.static_rating[0] == 30_000.0
    for name in ("static_safety", "spectrum_safety"):
        ours, theirs = (np.atleast_2d(getattr(each, name))[0] for each in (rated, plain))
        assert ours == pytest.approx(theirs * [ratio, 1.0, 1.0, 1.0])
    assert (rated.life == plain.life).all()
    seat = grinding().seats[0]
    limit = life.fatigue_load_limit(30_000.0, seat.bearing.pitch_diameter)
    assert rated.fatigue_limit[0] == pytest.approx(limit)
    factor = life.life_factor(
        plain.viscosity_ratio[0, 0], dirty.contamination, limit, plain.equivalent_load[0, 0]
    )
    assert rated.life_factor[0, 0] == pytest.approx(float(factor))
    assert rated.life_factor[0, 0] != pytest.approx(plain.life_factor[0, 0], rel=0.01)
    assert (rated.life_factor[0, 1:] == plain.life_factor[0, 1:]).all()


def test_an_oil_too_thick_for_the_formula_of_inlet_heating_is_reported() -> None:
    thick = replace(OIL, viscosity_40=90e-3, viscosity_100=1e-3, temperature=40.0)
    ours = of_grinding(LifeSpec(thick), rpm=(0, 100, 12000))
    assert (ours.film[1] > 0.0).all()
    assert (ours.film[2] == 0.0).all()
    (said,) = (words for words in warnings(ours) if "films" in words)
    assert said.startswith("bearings a, b, c, d: films are taken as 0 from 12000 rpm on")


def test_whose_static_rating_is_used_is_said() -> None:
    plain, rated = (
        " ".join(" ".join(summary(of_grinding(LifeSpec(**given)))).split())
        for given in (
            {"dynamic_ratings": {"a": 20_000.0, "b": 20_000.0}, "static_ratings": {"b": 3e4}},
            {"dynamic_ratings": {"a": 20_000.0}, "static_ratings": {"a": 3e4}},
        )
    )
    assert "b 30000 as given (Cu 1364)" in plain
    assert "of the grooves (Cu" in plain
    assert "; a: C is given and C0 is not (static_ratings)" in plain
    assert "a 30000 as given" in rated
    assert "C0 is not" not in rated


def test_hot_ratings_shorten_lives_with_their_cube() -> None:
    """C falls to 0.73 at 200 °C, whatever it is of: the speeds of the case or a load spectrum."""
    spectrum = (LoadStep(share=1.0, speed=6000 * RPM),)
    cool, hot = (
        of_grinding(LifeSpec(replace(OIL, temperature=t), spectrum=spectrum)) for t in (50.0, 200.0)
    )
    for name in ("revolutions", "life", "set_life", "spectrum_life"):
        assert getattr(hot, name) == pytest.approx(0.73**3 * getattr(cool, name)), name
    assert (hot.spectrum_safety == cool.spectrum_safety).all()
    assert hot.spectrum_safety == pytest.approx(hot.static_safety[0])


def test_reliability_shortens_life() -> None:
    usual, safe = (of_grinding(LifeSpec(OIL, reliability=r)) for r in (0.90, 0.99))
    assert safe.modified_life == pytest.approx(0.25 * usual.modified_life)
    assert safe.life == pytest.approx(usual.life)


@pytest.mark.parametrize(
    ("step", "sentence"),
    [
        (
            LoadStep(share=1.0, speed=6000 * RPM, axial_force=-2e6),
            r"spectrum\.1 at 6000 rpm has",
        ),
        (
            LoadStep(share=1.0, speed=6000 * RPM, radial={"a": 1e6}),
            r"radial\.a: no solution .* 1e\+06 N",
        ),
    ],
)
def test_a_step_without_a_state_is_refused(step: LoadStep, sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        of_grinding(LifeSpec(spectrum=(step,)))


def test_oil_that_does_not_flow_is_refused() -> None:
    with pytest.raises(InvalidInput, match="does not flow"):
        Lubrication("32 mm^2/s", "5.4 mm^2/s", "-60 degC")  # type: ignore[arg-type]


def test_a_spectrum_at_rest_is_reported() -> None:
    found = of_grinding(LifeSpec(spectrum=(LoadStep(share=1.0, speed=0.0),)))
    assert any("spectrum" in line and "set > 1e6" in line for line in summary(found))


def test_a_spectrum_that_unloads_a_bearing_says_so() -> None:
    pulled = LoadStep(share=0.4, speed=6000 * RPM, axial_force=-3000.0)
    found = of_grinding(LifeSpec(spectrum=(pulled, LoadStep(share=0.6, speed=6000 * RPM))))
    np.testing.assert_allclose(found.spectrum_unloaded, [0.4, 0.4, 0.0, 0.0])
    (said,) = (w for w in warnings(found) if "leaves it without load for 40 % of the time" in w)
    assert severity_of(said) == Severity.LOAD
    still = of_grinding(LifeSpec(spectrum=(LoadStep(share=1.0, speed=6000 * RPM),)))
    assert not still.spectrum_unloaded.any()


def test_spectrum_is_the_mean_of_its_steps() -> None:
    """Each step alone, then 1/L = Σ share of time over L."""
    whole = of_grinding(LifeSpec(spectrum=STEPS)).spectrum_life
    alone = [
        of_grinding(LifeSpec(spectrum=(replace(step, share=1.0),))).spectrum_life for step in STEPS
    ]
    by_hand = 1.0 / sum(step.share / each for step, each in zip(STEPS, alone, strict=True))
    assert whole == pytest.approx(by_hand)
    plain = of_grinding(LifeSpec(), rpm=(9000,))
    assert alone[0] == pytest.approx(plain.life[0])
    light = of_grinding(LifeSpec(spectrum=(LoadStep(share=1.0, speed=6000 * RPM),))).spectrum_life
    assert alone[2][0] < light[0]
    assert alone[2][1] == pytest.approx(light[1])


def test_radial_load_of_a_step_by_hand() -> None:
    """600 N along y on bearing a, which keeps its axial load and does not tilt."""
    step, spindle = STEPS[2], grinding()
    found = of_grinding(LifeSpec(spectrum=(replace(step, share=1.0),))).spectrum_life[0]
    state = dynamic_preload(spindle, np.array([step.speed]), Conditions().law)
    alone = spindle.seats[0].bearing.equilibrium(
        load=[float(state.seat_load()[0, 0]), 600.0, 0.0, np.nan, np.nan],
        displacement=[np.nan, np.nan, np.nan, 0.0, 0.0],
        speed=step.speed,
        growth=float(state.seat_growth()[0, 0]),
    )
    assert found == pytest.approx(float(life.reference_life(alone)) * 60 / 6000, rel=1e-6)


def test_a_step_under_loads_across_the_axis() -> None:
    """All of the time at a speed of the case is the life there, whether the loads are those of the
    conditions or of the step; half of each adds up."""
    push = PointLoad("nose", Fy=900.0, Fx=100.0)
    half = PointLoad("nose", Fy=450.0, Fx=50.0)
    always = (LoadStep(share=1.0, speed=6000 * RPM),)

    def lives(step: LoadStep, *loads: PointLoad) -> Any:
        spec = {"life": LifeSpec(spectrum=(step,))}
        return answers(grinding(), (6000,), spec, kinematics="hybrid", loads=loads)["life"]

    known = lives(always[0], push)
    assert known.spectrum_life == pytest.approx(known.life[0], rel=1e-9)
    free = lives(always[0])
    assert known.spectrum_life[0] < 0.9 * free.spectrum_life[0]
    for found in (
        lives(replace(always[0], loads=(push,))),
        lives(replace(always[0], loads=(half,)), half),
    ):
        assert found.spectrum_life == pytest.approx(known.spectrum_life, rel=1e-6)


def test_steel_balls_press_the_outer_race_harder_at_speed() -> None:
    spindle = grinding()
    steel = replace(
        spindle,
        seats=tuple(
            replace(seat, bearing=replace(seat.bearing, ball_material=STEEL))
            for seat in spindle.seats
        ),
    )
    fast = (16000,)
    hybrid, heavy = (of_grinding(LifeSpec(OIL), own, fast) for own in (spindle, steel))
    assert heavy.set_life < hybrid.set_life
    assert set(heavy.limiting[0]) == {"o"}


def test_words() -> None:
    lines = summary(flagship())
    heads = [line.split()[0] for line in lines]
    assert heads == ["life", "modified", "heat", "safety", "defects"]
    assert "a/b" in lines[0]
    assert "order of magnitude" in lines[2]
    assert all("more friction than the lubricant provides" in w for w in warnings(flagship()))
    every = [*numbers(flagship(), None)]  # type: ignore[arg-type]
    found = [each.name for each in every if not each.inner]
    assert found == ["set L10r", "set L10r", "S0", "S0", "pressure", "pressure", "heat", "heat"]
    spectrum = of_grinding(LifeSpec(spectrum=STEPS))
    assert [line.split()[0] for line in summary(spectrum)][:2] == ["life", "spectrum"]
    found = [each.name for each in numbers(spectrum, None)]  # type: ignore[arg-type]
    assert "set L10r, spectrum" in found


@pytest.mark.parametrize(
    ("spec", "sentence"),
    [
        (LifeSpec(dynamic_ratings={"a": 37_400.0}), "give that of one bearing"),
        (LifeSpec(target=1e6 * 3600.0), "is below the target of 1000000 h"),
        (LifeSpec(replace(OIL, temperature=200.0)), "κ below 0.1 up to 100 rpm"),
        (LifeSpec(replace(OIL, temperature=200.0)), "falls to 73 % there"),
        (
            LifeSpec(spectrum=(LoadStep(share=1.0, speed=6000 * RPM, axial_force=100e3),)),
            "under the load spectrum is below 2",
        ),
    ],
)
def test_warnings(spec: LifeSpec, sentence: str) -> None:
    rpm = (100,) if spec.lubricant else (6000,)
    found = warnings(of_grinding(spec, rpm=rpm))
    assert any(sentence in words for words in found), found
    named = [words.partition(":")[0].split()[1:] for words in found]
    assert all(len(set(names)) == len(names) for names in named), "a bearing named twice"


def test_every_value_that_is_no_number_is_declared() -> None:
    still = (LoadStep(share=1.0, speed=0.0),)
    ours = of_grinding(LifeSpec(OIL, spectrum=still), rpm=(0, 6000))
    assert np.isnan(ours.modified_life[0]).all()
    assert not list(unexplained(ours))


def test_warnings_of_overloaded_bearings() -> None:
    ours = of_grinding(LifeSpec())
    changes = {
        "static_safety": (np.full((1, 4), 1.5), "static safety 1.5 is below 2 from 6000 rpm on"),
        "equivalent_load": (np.full((1, 4), 12e3), "above half the dynamic rating"),
        "shoulder_margin": (np.full((1, 4), -0.01), "passes the shoulder by 0.57°"),
    }
    for name, (values, sentence) in changes.items():
        found = warnings(replace(ours, **{name: values}))
        assert len(found) == 1
        assert found[0].startswith("bearings a, b, c, d: ")
        assert sentence in found[0]


def test_stress_of_a_fit_by_hand() -> None:
    """At rest: σθ + p at the bore of the ring, by Lamé."""
    ours, spindle = of_grinding(LifeSpec(), rpm=(0, 6000)), grinding()
    bearing = spindle.seats[0].bearing
    inside, bore, outside = 15e-3, 35e-3, bearing.inner_raceway_radius
    steel, shaft = bearing.ring_material, spindle.shaft.sections[1].material

    def wall(r1: float, r2: float) -> float:
        return (r1**2 + r2**2) / (r2**2 - r1**2)

    soft = (wall(bore, outside) + steel.poisson_ratio) / steel.young_modulus
    soft += (wall(inside, bore) - shaft.poisson_ratio) / shaft.young_modulus
    pressure = 5e-6 / (bore * soft)
    assert ours.ring_stress[0, 0] == pytest.approx(pressure * (wall(bore, outside) + 1.0), rel=1e-6)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: LifeSpec(spectrum=STEPS[:2]), r"shares add up to 90 %"),
        (lambda: LifeSpec(heat="palmgren"), "heat needs an oil"),
        (lambda: LifeSpec(reliability=0.93), "not one of its choices"),
        (lambda: Lubrication(32e-6, 68e-6, 40.0), "not below viscosity_40"),
        (lambda: Lubrication(32e-6, 5e-6, 400.0), "temperature out of range"),
    ],
)
def test_impossible_questions(make: Any, sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        make()


def test_a_radial_load_on_a_thrust_bearing_is_refused_where_it_is(tmp_path: Any) -> None:
    import rotordyn

    file = tmp_path / "case.yaml"
    file.write_text(
        "spindle: grinding_spindle\nspeeds: [100 rpm]\n"
        "override: {bearings.d.model: thrust_50x78x22}\nanalyses:\n  life:\n"
        "    spectrum: [{share: 100 %, speed: 100 rpm, radial: {d: 200 N}}]\n"
    )
    with pytest.raises(
        InvalidInput,
        match=r"6:\d+: analyses.life.spectrum.1.radial.d: .* no radial load: got 200 N",
    ):
        rotordyn.load(file)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ("dynamic_ratings: {front: 20 kN}", "unknown bearing: given 'front'; allowed: a, b, c, d"),
        ("static_ratings: {rear: 20 kN}", "unknown bearing: given 'rear'; allowed: a, b, c, d"),
        (
            "spectrum: [{share: 100 %, speed: 100 rpm, radial: {x: 1 N}}]",
            "unknown bearing: given 'x'",
        ),
        (
            "spectrum: [{share: 100 %, speed: 60000 rpm}]",
            r"spectrum.1.speed: above the speeds of the case, .* allowed: up to 100 rpm",
        ),
        (
            "spectrum: [{share: 100 %, speed: 100 rpm, loads: [{at: tip, Fy: 1 N}]}]",
            "unknown point: given 'tip'; allowed: nose",
        ),
        (
            "spectrum: [{share: 100 %, speed: 100 rpm, radial: {a: 1 N}, loads: [{at: nose, Fy: "
            "1 N}]}]",
            "radial: given beside loads across the axis",
        ),
        (
            "lubricant: {viscosity_40: 32 mm^2/s, viscosity_100: 5 mm^2/s}",
            "temperature: missing key",
        ),
        ("lubricant: {viscosity_40: 32 Pa s}", "not a unit of kinematic viscosity"),
    ],
)
def test_files_with_faults(changes: str, sentence: str, tmp_path: Any) -> None:
    import rotordyn

    file = tmp_path / "case.yaml"
    file.write_text(
        f"spindle: grinding_spindle\nspeeds: [100 rpm]\nanalyses:\n  life:\n    {changes}\n"
    )
    with pytest.raises(InvalidInput, match=re.sub(r"[\[(]", r"\\\g<0>", sentence)):
        rotordyn.load(file)


def test_static_bearings_are_refused(tmp_path: Any) -> None:
    import rotordyn

    file = tmp_path / "case.yaml"
    file.write_text(
        "spindle: grinding_spindle\nspeeds: [100 rpm]\nconditions: {bearings: static}\n"
        "analyses: {life: {}}\n"
    )
    with pytest.raises(InvalidInput, match="needs bearings at speed"):
        rotordyn.load(file)


def test_words_of_files_are_those_of_the_formulas() -> None:
    assert set(SUPPLIES) == set(heat.OIL_FACTORS)
    assert all(math.isfinite(life.reliability_factor(r)) for r in RELIABILITIES)


def test_defect_frequencies_in_the_campbell_diagram() -> None:
    """Those of bearings alike once; over the speed the orders of the life analysis."""
    from rotordyn.analyses import CampbellSpec

    spec = CampbellSpec(1500.0, bearing_frequencies=("cage", "ball"), shapes=False)
    found = answers(mfw2310(), SPEEDS, {"campbell": spec})["campbell"]
    assert found.passing[:3] == ("cage a, b", "cage c", "cage d, e")
    hertz = flagship().cage * np.array(SPEEDS)[:, None] / 60.0
    assert found.passing_frequency[:, :3] == pytest.approx(hertz[:, [0, 2, 3]])


def test_bearings_next_to_no_load_have_no_digits_of_safety() -> None:
    usual = " ".join(summary(flagship()))
    assert re.search(r"S0 from \d+\.\d+, peak pressure 1\.\d\d GPa", usual)
    safety = np.full_like(flagship().static_safety, 1.07e10)
    idle = replace(flagship(), static_safety=safety, pressure=safety * 1e-7)
    assert "S0 > 1000, peak pressure < 0.01 GPa" in " ".join(summary(idle))
