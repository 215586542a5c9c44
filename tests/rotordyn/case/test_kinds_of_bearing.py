"""Bearings of every kind in files: their keys are the fields of their classes."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

import rotordyn
from bearings import AngularContactBallBearing, DeepGrooveBallBearing, FourPointBallBearing
from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from bearings.kinds import KINDS, kind_class
from bearings.measure import Measure
from rotordyn import units
from rotordyn.case.keys import extra, keys_of
from rotordyn.case.schema import json_schema
from rotordyn.machine.spindle import Spindle
from rotordyn.measures import limits
from rotordyn.quantity import Quantity, Whole

COMMON = {"ball_diameter": "10.3 mm", "pitch_diameter": "77.5 mm", "balls": 13}
GIVEN = {
    "angular_contact": {"contact_angle": "25 deg"},
    "deep_groove": {"radial_clearance": "15 um"},
    "four_point": {"contact_angle": "35 deg", "inner_shim": "0.1 mm"},
}
BUILT = {
    "angular_contact": AngularContactBallBearing(
        0.0103, 0.0775, 13, contact_angle=math.radians(25.0)
    ),
    "deep_groove": DeepGrooveBallBearing(0.0103, 0.0775, 13, radial_clearance=15e-6),
    "four_point": FourPointBallBearing(
        0.0103, 0.0775, 13, contact_angle=math.radians(35.0), inner_shim=1e-4
    ),
}


def model(folder: Path, **keys: Any) -> Any:
    path = folder / "own.yaml"
    path.write_text(yaml.safe_dump({"name": "own", **keys}), encoding="utf-8")
    return rotordyn.model("bearings", path)


@pytest.mark.parametrize("kind", GIVEN)
def test_a_file_makes_what_python_makes(kind: str, tmp_path: Path) -> None:
    """Materials omitted are those of the class, too."""
    assert model(tmp_path, kind=kind, **COMMON, **GIVEN[kind]) == BUILT[kind]


def test_a_file_without_kind_is_an_angular_contact_bearing(tmp_path: Path) -> None:
    found = model(tmp_path, **COMMON, contact_angle="25 deg")
    assert found == BUILT["angular_contact"]


@pytest.mark.parametrize("kind", KINDS)
def test_keys_of_a_kind_are_the_fields_of_its_class(kind: str) -> None:
    fields, common = keys_of(kind_class(kind)), {field.keys for field in extra(BallBearing)}
    own = {field.keys[0] for field in fields if field.keys not in common}
    assert own == set(kind_class(kind).measures())
    assert all(field.meaning for field in fields)
    described = json_schema("bearing")["$defs"][KINDS[kind]]["properties"]
    assert set(described) == {field.keys[0] for field in fields}
    assert described["kind"]["enum"] == [kind]


MEASURES = {
    f"{kind}.{name}": measure
    for kind in KINDS
    for name, measure in kind_class(kind).measures().items()
    if measure.quantity != "material"
}


@pytest.mark.parametrize("name", MEASURES)
def test_bounds_of_a_file_are_those_of_the_class(name: str) -> None:
    """What is written at a bound is taken by both, or by neither where the bound is open."""
    measure = MEASURES[name]
    within = limits(measure)
    if isinstance(within, Whole):
        assert (within.at_least, within.at_most) == (measure.low, measure.high)
        return
    assert isinstance(within, Quantity)
    for bound in (within.at_least or within.above, within.at_most):
        value = units.parse(bound, within.kind)
        assert within.holds(value) == (measure.refusal(name, value) == "")
        assert within.holds(value) == (bound != within.above)


def test_a_bound_that_is_infinite_is_none() -> None:
    assert limits(Measure("number", "any")).allowed == ""


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"kind": "ball"}, "unknown kind of bearing: given 'ball'; allowed: angular_contact, "),
        ({"kind": 3}, "unknown kind of bearing: given '3'"),
        ({"axial_play": "20 um"}, "unknown key: given 'axial_play'; allowed: .*radial_clearance"),
        ({"contact_angle": "12 deg"}, "impossible bearing: give exactly one"),
        ({"radial_clearance": "1.9 mm"}, "radial_clearance: impossible bearing"),
        ({"balls": 60}, "balls: impossible bearing: 60 balls .* overlap"),
        ({"inner_shoulder_diameter": "67 mm"}, "inner_shoulder_diameter: impossible bearing"),
        ({"outer_shoulder_diameter": "77 mm"}, "outer_shoulder_diameter: .*allowed inside 77.5"),
        ({"bore_diameter": "70 mm"}, "no ring left"),
    ],
)
def test_a_fault_is_one_sentence(change: dict[str, Any], said: str, tmp_path: Path) -> None:
    keys = {"kind": "deep_groove", **COMMON, "radial_clearance": "15 um", **change}
    with pytest.raises(rotordyn.InvalidInput, match=said) as refused:
        model(tmp_path, **keys)
    assert len(refused.value.faults) == 1


def test_shoulders_between_groove_bottom_and_pitch_circle_are_taken(tmp_path: Path) -> None:
    shoulders = {"inner_shoulder_diameter": "71 mm", "outer_shoulder_diameter": "84 mm"}
    keys = {"kind": "deep_groove", **COMMON, "radial_clearance": "15 um", **shoulders}
    grooves = {"inner_shoulder_diameter": 71e-3, "outer_shoulder_diameter": 84e-3}
    assert model(tmp_path, **keys) == replace(BUILT["deep_groove"], **grooves)


def test_an_override_may_change_the_kind(tmp_path: Path) -> None:
    text = (
        "bearing: '6012'\n"
        "override: {kind: angular_contact, contact_angle: 15 deg}\n"
        "speeds: [0 rpm]\nanalyses: {bearing: {loads: [100 N]}}\n"
    )
    (tmp_path / "case.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(rotordyn.InvalidInput, match="unknown key: given 'radial_clearance'"):
        rotordyn.load(tmp_path / "case.yaml")
    text = text.replace("kind: angular_contact, contact_angle: 15 deg", "radial_clearance: 20 um")
    (tmp_path / "case.yaml").write_text(text, encoding="utf-8")
    found = rotordyn.load(tmp_path / "case.yaml").bearing
    assert isinstance(found, DeepGrooveBallBearing)
    assert found.radial_clearance == pytest.approx(20e-6)


def overridden(folder: Path, override: str) -> Any:
    path = folder / "case.yaml"
    path.write_text(
        f"bearing: '6012'\noverride: {{{override}}}\n"
        "speeds: [0 rpm]\nanalyses: {bearing: {loads: [100 N]}}\n",
        encoding="utf-8",
    )
    return rotordyn.load(path).bearing


@pytest.mark.parametrize(
    ("override", "place"),
    [
        ("contact_angle: 15 deg", "override.contact_angle"),
        ("kind: angular_contact, contact_angle: 15 deg", "override.kind"),
    ],
)
def test_a_fault_that_an_override_makes_is_put_right_there(
    override: str, place: str, tmp_path: Path
) -> None:
    """At the line of the user, not in the model of the library; with the way out, which works."""
    with pytest.raises(rotordyn.InvalidInput, match="add radial_clearance: null") as refused:
        overridden(tmp_path, override)
    (fault,) = refused.value.faults
    assert (Path(fault.file).name, fault.line, fault.path) == ("case.yaml", 2, place)
    found = overridden(tmp_path, f"{override}, radial_clearance: null")
    assert found.contact_angle == pytest.approx(math.radians(15.0))


def test_a_key_of_another_kind_asks_for_the_kind(tmp_path: Path) -> None:
    with pytest.raises(rotordyn.InvalidInput, match="is 'kind: deep_groove' missing"):
        model(tmp_path, **COMMON, radial_clearance="15 um")
    with pytest.raises(rotordyn.InvalidInput) as refused:
        model(tmp_path, kind="angular_contact", **COMMON, radial_clearance="15 um")
    assert "missing?" not in str(refused.value)


def rear(name: str = "rear") -> tuple[Spindle, Any]:
    spindle = rotordyn.load("spindle_deep_groove_rear").spindle
    assert spindle is not None
    return spindle, next(seat for seat in spindle.seats if seat.name == name)


def test_a_seat_takes_its_law_and_the_rest_from_the_conditions() -> None:
    case = rotordyn.load("spindle_deep_groove_rear")
    law = rear()[1].law(case.conditions.law)
    assert (law.kinematics, law.moment_sharing, law.friction) == ("outer", "equal", None)
    assert rear("a")[1].law(case.conditions.law) == case.conditions.law
    limited = rotordyn.vary(rear()[1], {"friction": 0.07}).law(case.conditions.law)
    assert limited.friction == 0.07


def test_values_of_a_bearing_vary_with_their_units() -> None:
    path = "spindle.bearings.rear.model.radial_clearance"
    varied = rotordyn.load("spindle_deep_groove_rear").vary({path: "25 um"})
    assert varied.spindle is not None
    assert varied.spindle.seats[2].bearing.radial_clearance == pytest.approx(25e-6)  # type: ignore[attr-defined]


def test_a_kind_with_thrust_both_ways_needs_none_but_on_a_sleeve(tmp_path: Path) -> None:
    assert rear()[1].thrust == 1
    text = (
        "spindle: deep_groove_rear\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n"
        "override: {sleeves.front.bearings: [a, b, rear]}\n"
    )
    (tmp_path / "case.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(rotordyn.InvalidInput, match=r"thrust: .*the spring of its sleeve pushes"):
        rotordyn.load(tmp_path / "case.yaml")


def test_python_says_the_same() -> None:
    from rotordyn.machine.seat import BearingSeat

    assert BearingSeat("r", BUILT["deep_groove"], 0.1).thrust == 1
    assert BearingSeat("r", BUILT["deep_groove"], 0.1, -1).thrust == -1
    with pytest.raises(
        rotordyn.InvalidInput,
        match="thrust: missing key: kind angular_contact takes thrust one way only",
    ):
        BearingSeat("r", BUILT["angular_contact"], 0.1)
    with pytest.raises(rotordyn.InvalidInput, match="kinematics: not one of its choices"):
        BearingSeat("r", BUILT["deep_groove"], 0.1, kinematics="outr")
    with pytest.raises(InvalidBearing, match="exactly one"):
        DeepGrooveBallBearing(0.0103, 0.0775, 13)
