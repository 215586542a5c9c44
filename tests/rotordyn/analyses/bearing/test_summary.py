"""A single bearing in words: contacts, and ellipses that pass the ends of their grooves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.bearing.solve import solve
from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.bearing.summary import cut_off, numbers, summary, warnings
from rotordyn.analyses.bearing.tables import LAYOUTS
from rotordyn.report.tables import tidy_columns
from rotordyn.report.warnings import result_warnings
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.lubrication import Lubrication
from tests.oracles.known_bearings import RPM, VEX70
from tests.oracles.known_grooves import QJ218, R24_14, four_point
from tests.rotordyn.analyses.bearing.test_bearing_map import FLOW, OIL
from tests.rotordyn.figures import samples

OUTER = Conditions(kinematics="outer")
SHOULDERS = dict(inner_shoulder_diameter=114e-3, outer_shoulder_diameter=136e-3)


def test_ellipse_past_the_inner_shoulder() -> None:
    """Rigid rings at rest: from 77 kN, 5.6 % at 100 kN."""
    bearing = replace(four_point(QJ218), **SHOULDERS)
    found = solve(bearing, OUTER, np.zeros(1), BearingMapSpec((70e3, 80e3, 100e3)))
    (sentence,) = cut_off(found)
    assert sentence == (
        "contact ellipse passes the shoulder of the inner ring, first under 80000 N at 0 rpm, up "
        "to 5.6 % of its length outside the groove"
    )
    assert result_warnings({"bearing": found}) == [sentence]
    unknown = solve(four_point(QJ218), OUTER, np.zeros(1), BearingMapSpec((100e3,)))
    assert cut_off(unknown) == []


def test_an_ellipse_wholly_past_its_shoulder() -> None:
    bearing = replace(four_point(QJ218), **SHOULDERS)
    spec, speed = BearingMapSpec((1e3,), static_growth=-300e-6), np.array([6000.0]) * RPM
    found = solve(bearing, Conditions(), speed, spec)
    assert cut_off(found)[0].endswith("up to 100 % of its length outside the groove")


def test_contacts_without_a_state_have_no_line() -> None:
    """200 N hold the balls of a QJ 218 up to some 4500 rpm."""
    speed = np.array([1000.0, 5000.0, 6000.0]) * RPM
    inner, spec = Conditions(kinematics="inner"), BearingMapSpec((200.0,))
    found = solve(four_point(QJ218), inner, speed, spec)
    assert [word == "" for word in found.outcome[:, 0]] == [True, False, False]
    assert not any(line.startswith("contacts") for line in summary(found))


@pytest.mark.parametrize(("load", "rpm", "said"), [(5e3, 6e3, True), (5e4, 6e3, False)])
def test_heat_of_balls_with_a_third_contact_is_an_estimate(
    load: float, rpm: float, *, said: bool
) -> None:
    """Up to nine times too much (docs/theory/four_point.md)."""
    spec = BearingMapSpec((load,), lubricant=Lubrication(32e-6, 5.4e-6, 50.0))
    found = solve(four_point(QJ218), OUTER, np.array([0.0, rpm]) * RPM, spec)
    (line,) = (each for each in summary(found) if "heat" in each)
    assert ("estimated from resultants where balls have more than two contacts" in line) == said
    assert (found.contacts[1, 0].max() > 2) == said


def test_the_rating_of_a_pair_is_questioned() -> None:
    """A pair has 2^0.7 times the rating of one bearing (ISO 281)."""
    spec = BearingMapSpec((5e3,))
    one = solve(four_point(QJ218), OUTER, np.array([100.0]), spec)
    assert one.dynamic_rating == one.groove_rating
    pair = replace(spec, dynamic_rating=2.0**0.7 * one.groove_rating)
    found = solve(four_point(QJ218), OUTER, np.array([100.0]), pair)
    assert found.revolutions == pytest.approx(2.0**2.1 * one.revolutions)
    (sentence,) = result_warnings({"bearing": found})
    assert "is 1.62 times that of the grooves; give that of one bearing, of one row" in sentence
    assert "as has a four-point bearing in catalogues, which count two rows" in sentence


def test_most_loaded_ball_in_words() -> None:
    """Case 3 of Lacroix (2014), rigid: 22.4° at 0°, a third contact."""
    spec = BearingMapSpec(radial_loads=(0.0, 12e3), axial_load=20e3)
    found = solve(four_point(R24_14), OUTER, np.array([1500.0]) * RPM, spec)
    lines = summary(found)
    assert lines[0].endswith("tilts blocked, at 1500 rpm")
    assert "0 N radial: axial" in lines[1]
    names = {each.words for each in numbers(found, None)}  # type: ignore[arg-type]
    assert "12000 N radial, stiffness axial at 1500 rpm" in names
    assert lines[-1].split(": ", 1)[1].startswith("ball 0 at 0°: ir 4712 N at 22.4°, or 510 N at")
    assert lines[-1].endswith("2 to 3 contacts per ball")


def test_two_contacts_need_no_words() -> None:
    assert not any(line.startswith("contacts") for line in summary(samples.bearing(3)))


@pytest.mark.parametrize(
    ("name", "rows", "column", "value"),
    [
        ("bearing_balls", 40, "loaded contacts", "2"),
        ("bearing_contacts", 160, "contact load [N]", None),
        ("bearing_grooves", 4, "angle of the shoulder [deg]", ""),
    ],
)
def test_tables(name: str, rows: int, column: str, value: str | None) -> None:
    spec = BearingMapSpec(moments=(0.0, 300.0), axial_load=20e3)
    found = solve(four_point(R24_14), OUTER, np.zeros(1), spec)
    (layout,) = (each for each in LAYOUTS if each.name == name)
    columns = dict(tidy_columns(found, layout))
    assert len(columns[column]) == rows
    if value is not None:
        assert str(columns[column][0]) == value
    if "load" in layout.rows:
        assert columns["moment [N·m]"][-1] == "300"


def test_life_beyond_its_validity_is_reported_as_of_a_spindle() -> None:
    """P above C/2 and S0 below 2, of VEX70 from some 15 kN on."""
    loads = (300.0, 12e3, 16e3, 20e3)
    found = solve(VEX70, Conditions(), np.array([100.0, 200.0]), BearingMapSpec(loads))
    assert (found.equivalent_load > 0.5 * found.dynamic_rating).any(axis=0).tolist() == [
        *(False, False, True, True)
    ]
    low, high = (word for word in result_warnings({"bearing": found}) if "than computed" in word)
    assert low == (
        f"under 16000 N and more: static safety {found.static_safety.min():.2g} is below 2 from "
        "955 rpm on, and life is shorter than computed; lower the load or take a larger bearing"
    )
    assert high == (
        "under 16000 N and more: equivalent load above half the dynamic rating from 955 rpm on: "
        "life is shorter than computed; lower the load"
    )
    light = solve(VEX70, Conditions(), np.array([100.0]), BearingMapSpec(loads[:2]))
    assert not any("than computed" in word for word in result_warnings({"bearing": light}))


def test_what_has_a_state_up_to_a_lower_speed_says_so() -> None:
    """Between rigid rings it warms until there is no balance: the load as mounted is another one at
    work, and values are those up to the last speed with a state."""
    spec = BearingMapSpec((300.0,), heat_flow=FLOW, lubricant=OIL)
    found = solve(VEX70, Conditions(), np.array([0.0, 8e3, 16e3, 24e3]) * RPM, spec)
    lines = [line for line in summary(found) if "300 N" in line]
    stiffness, life, warm = lines
    assert "300 N as mounted, at 0 → 16000 rpm: axial" in stiffness
    assert "none" not in stiffness
    assert "300 N as mounted, at 0 → 16000 rpm: L10r" in life
    assert "300 N as mounted: at 16000 rpm balls" in warm
    (hot,) = (word for word in result_warnings({"bearing": found}) if "no thermal balance" in word)
    assert "under 300 N as mounted: cool" in hot
    held = replace(spec, heat_flow=replace(FLOW, mounting="spring"))
    soft = summary(solve(VEX70, Conditions(), np.array([0.0, 8e3]) * RPM, held))
    assert any("300 N: axial" in line for line in soft)


@pytest.mark.parametrize("films", [False, True])
def test_an_oil_too_thick_for_the_formula_of_inlet_heating_is_reported(films: bool) -> None:
    """VG 460 at 40 °C: 13.2 (p/E′) L^0.42 is beyond 1 at 30 000 rpm, where the film was 0."""
    thick = replace(OIL, viscosity_40=460e-6, viscosity_100=30e-6, temperature=40.0)
    spec = BearingMapSpec((600.0,), lubricant=thick, films=films)
    found = solve(VEX70, Conditions(), np.array([0.0, 2e4, 3e4]) * RPM, spec)
    assert (found.film[:, 0] > 0.0).tolist() == [False, True, False]
    (said,) = (words for words in result_warnings({"bearing": found}) if "films" in words)
    assert "films are taken as 0 from 30000 rpm on, where the oil is too viscous for" in said


def test_numbers_of_a_load_have_one_name_however_it_is_held() -> None:
    spec = BearingMapSpec((300.0,), heat_flow=FLOW, lubricant=OIL)
    soft = replace(spec, heat_flow=replace(FLOW, mounting="spring"))
    speed = np.array([0.0, 8e3]) * RPM
    rigid, sprung = (solve(VEX70, Conditions(), speed, each) for each in (spec, soft))
    assert any("as mounted" in line for line in summary(rigid))
    one, other = ({each.words for each in numbers(found, None)} for found in (rigid, sprung))  # type: ignore[arg-type]
    assert one == other


def test_required_friction_and_the_open_side_are_reported_once_for_all_loads() -> None:
    """Light balls that roll at speed; a radial load without an axial one to keep the side."""
    speed = np.array([0.0, 10000.0]) * RPM
    found = solve(VEX70, Conditions(), speed, BearingMapSpec((20.0, 50.0, 2000.0)))
    (friction,) = (word for word in warnings(found) if "gyroscopic slip" in word)
    assert friction.startswith("under 20 N and more: the balls roll")
    assert f"above {found.required_friction.max():.2g}, more" in friction
    assert friction.endswith(
        "from 10000 rpm on; raise the preload, or set friction to compute the slip"
    )
    assert found.required_friction[1, 0] > 0.1 > found.required_friction[1, 2]
    limited = solve(VEX70, replace(OUTER, friction=0.02), speed, BearingMapSpec((20.0, 2000.0)))
    (slip,) = (word for word in warnings(limited) if "slip" in word)
    assert slip.startswith("under 20 N: the balls slip on ")
    assert slip.endswith("(friction as given): raise the preload, or lower the speed")

    aside = solve(VEX70, OUTER, speed[:1], BearingMapSpec(radial_loads=(100.0, 1000.0)))
    assert (aside.open_side[0] > 0).all()
    (side,) = (word for word in warnings(aside) if "shoulder" in word)
    assert not any("-0.0°" in line for line in summary(aside))  # of rounding
    assert side.startswith("under 100 N radial and more: balls bear where the rings have no")
    kept = BearingMapSpec(radial_loads=(100.0, 1000.0), axial_load=1000.0)
    assert not any("shoulder" in word for word in warnings(solve(VEX70, OUTER, speed[:1], kept)))


def test_slip_is_that_of_any_driven_ball() -> None:
    """Under a radial load the balls beside the heaviest one slip first."""
    spec = BearingMapSpec(radial_loads=(1000.0,), axial_load=2000.0)
    speed = np.array([20000.0]) * RPM
    conditions = Conditions(friction=0.02)
    found = solve(VEX70, conditions, speed, spec)
    state = VEX70.equilibrium(
        load=[2000.0, 1000.0, 0, 0, 0], speed=speed[0], kinematics="hybrid", friction=0.02
    )
    assert state.slipping[int(found.loaded_ball[0, 0])] == ""
    driven = state.inner_load >= 0.05 * state.inner_load.max()
    assert set(state.slipping[driven]) == {"", "inner"}
    assert found.slipping[0, 0] == "inner"
