"""What is uncertain of a case where values near the ends of their ranges are."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

import rotordyn
from rotordyn.case import asked as asked_module
from rotordyn.case.asked import Asked, asked_of
from rotordyn.case.case import Case
from rotordyn.case.tolerance import Tolerance, tolerance
from rotordyn.case.uncertain import Uncertain
from rotordyn.case.usual import ASSUMED, Usual
from rotordyn.errors import InvalidInput

ANGLE = "spindle.bearings.*.model.contact_angle"
CONFORMITY = "spindle.bearings.*.model.inner_conformity"
TRAVEL = "spindle.sleeves.rear.stop_travel"


def _case(**changes: object) -> Case:
    paths = {path.replace("__", "."): value for path, value in changes.items()}
    return rotordyn.vary(
        rotordyn.load("grinding_spindle"), {f"spindle.{p}": v for p, v in paths.items()}
    )


def _of(asked: Asked, path: str) -> Tolerance:
    return next(each for each in asked.tolerances if each.path == path)


def test_what_is_usual_ends_where_values_are_allowed_and_says_so() -> None:
    """One bearing of 58°, which may have up to 60°: all go so far of the way."""
    asked = asked_of(_case(bearings__a__model__contact_angle="58 deg"))
    low, high = (_of(asked, ANGLE).at(share) for share in (0.0, 1.0))
    steep, flat = (f"spindle.bearings.{name}.model.contact_angle" for name in "ab")
    assert math.degrees(low[steep]) == pytest.approx(56.0)
    assert high[steep] == math.radians(60.0)
    assert math.degrees(high[flat]) == pytest.approx(27.0)  # of 25° + 3°
    assert _of(asked, ANGLE).nominal == pytest.approx(0.5)
    (said,) = asked.narrowed
    assert said.startswith(f"{ANGLE} +3/-2 deg exceeds the allowed range: taken from 56 to 60 deg")


def test_a_bound_that_is_not_allowed_itself_is_not_met() -> None:
    """Grooves of half a ball diameter are none."""
    asked = asked_of(_case(bearings__a__model__inner_conformity=0.505))
    low = _of(asked, CONFORMITY).at(0.0)["spindle.bearings.a.model.inner_conformity"]
    assert low == pytest.approx(0.5005)
    assert len(asked.narrowed) == 1


def test_travel_of_a_stop_ends_at_zero() -> None:
    asked = asked_of(_case(sleeves__rear__stop_travel="4 um"))
    ends = [_of(asked, TRAVEL).at(share)[TRAVEL] for share in (0.0, 1.0)]
    assert ends == [0.0, pytest.approx(9e-6)]
    assert asked.narrowed == (f"{TRAVEL} ± 5 um exceeds the allowed range: taken from 0 to 9 um",)


def test_what_is_usual_and_cannot_be_at_all_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whole numbers and words have no end in between."""
    many = Usual("spindle.bearings.*.model.balls", "± 100", ASSUMED)
    monkeypatch.setattr(asked_module, "usual_of", lambda case: [many])
    asked = asked_of(_case())
    assert asked.tolerances == ()
    assert len(asked.narrowed) == 1
    assert asked.narrowed[0].startswith("spindle.bearings.*.model.balls ± 100 is omitted: ")


def test_a_sum_that_meets_a_bound_is_allowed() -> None:
    """57° + 3° is 60° but for rounding."""
    case = _case(**{"bearings__*__model__contact_angle": "57 deg"})
    high = tolerance(case, ANGLE, "+3/-2 deg").at(1.0)
    assert set(high.values()) == {math.radians(60.0)}
    assert asked_of(case).narrowed == ()


def test_what_leaves_the_range_is_reported_in_the_unit_of_the_range() -> None:
    case = _case(**{"bearings__*__model__contact_angle": "58 deg"})
    with pytest.raises(InvalidInput) as refused:
        tolerance(case, ANGLE, "± 3 deg")
    assert "given 61 deg; allowed: from 0 deg up to 60 deg" in str(refused.value)
    assert "did you mean" not in str(refused.value)


def test_four_point_bearings_are_ground_to_their_play() -> None:
    """Whatever the radii of the grooves, by themselves and together; the angle follows."""
    case = rotordyn.load("qj218")
    asked = asked_of(case)
    paths = [f"bearing.{race}_conformity" for race in ("inner", "outer")]
    assert [each.path for each in asked.tolerances if "bearing." in each.path] == paths
    low, high = ([_of(asked, path).at(end) for path in paths] for end in (0.0, 1.0))
    angle, axial, _ = case.bearing.plays
    for changes in (*low, *high, low[0] | low[1], low[0] | high[1]):
        made = rotordyn.vary(case, changes).bearing
        assert made.plays[1] == pytest.approx(axial, abs=1e-12)
        shims = made.inner_shim + made.outer_shim
        wide = (made.inner_conformity + made.outer_conformity - 1.0) * made.ball_diameter
        assert made.plays[0] == pytest.approx(math.asin((axial + shims) / (2.0 * wide)))
        assert abs(made.plays[0] - angle) > math.radians(0.1)


def test_deep_groove_bearings_are_ground_to_their_clearance() -> None:
    """The one behind a free contact angle, whose conformities vary the angle."""
    case = rotordyn.load("spindle_deep_groove_rear")
    rear = case.spindle.seats[-1]
    clearance, angle = rear.bearing.radial_clearance, math.radians(12.0)
    at = "spindle.bearings.rear.model"
    case = rotordyn.vary(case, {f"{at}.radial_clearance": None, f"{at}.contact_angle": angle})
    bearing = case.spindle.seats[-1].bearing
    expected = 2.0 * bearing.free_distance * (1.0 - math.cos(angle))
    assert clearance != pytest.approx(expected, rel=0.05)
    asked = asked_of(case)
    assert not [each for each in asked.tolerances if each.path == f"{at}.contact_angle"]
    changed = next(e for e in asked.tolerances if "inner_conformity" in e.path).at(1.0)
    made = rotordyn.vary(case, changed).spindle.seats[-1].bearing
    assert made.inner_conformity > bearing.inner_conformity
    assert made.radial_clearance == pytest.approx(expected, rel=1e-12)
    assert made.grooves.free_angle < angle - math.radians(0.2)


@pytest.mark.parametrize("play", ["axial_play", "radial_play"])
def test_a_play_that_is_given_stays_as_it_is(play: str) -> None:
    case = rotordyn.load("qj218")
    place = 1 + ("axial_play", "radial_play").index(play)
    given = {"contact_angle": None, play: case.bearing.plays[place]}
    case = replace(case, bearing=replace(case.bearing, **given))
    asked = asked_of(case)
    changes = [each.at(1.0) for each in asked.tolerances if "bearing." in each.path]
    assert [*map(set, changes)] == [{f"bearing.{race}_conformity"} for race in ("inner", "outer")]
    made = rotordyn.vary(case, {k: v for change in changes for k, v in change.items()}).bearing
    assert made.plays[place] == pytest.approx(case.bearing.plays[place], abs=1e-12)


def test_an_angle_of_ones_own_tolerance_is_not_that_of_a_play() -> None:
    case = replace(
        rotordyn.load("qj218"),
        uncertain=Uncertain(tolerances={"bearing.contact_angle": "± 1 deg"}, as_usual=True),
    )
    asked = asked_of(case)
    changes = [each.at(1.0) for each in asked.tolerances if "bearing." in each.path]
    assert [*map(set, changes)] == [
        {f"bearing.{name}"} for name in ("contact_angle", "inner_conformity", "outer_conformity")
    ]
    whole = rotordyn.vary(case, {k: v for change in changes for k, v in change.items()})
    assert whole.bearing.contact_angle == pytest.approx(math.radians(36.0))
