"""Values at dotted paths: whatever a case says can be changed; a wrong path says what is there."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

import rotordyn
from bearings import STEEL
from rotordyn import Span
from rotordyn.analyses import CampbellSpec, PreloadSpec, StiffnessSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine import RingGrowth, Spring
from rotordyn.study.parameter import parameters
from tests.oracles.spindles import case, mfw2310, with_sleeve

TOP = 24000 * math.pi / 30


def changed(**paths: Any) -> Any:
    """The spindle of the flagship after changes, ``__`` for a dot."""
    made = case().vary({f"spindle.{path.replace('__', '.')}": v for path, v in paths.items()})
    assert made.spindle is not None
    return made.spindle


def test_a_field_is_what_replacing_it_by_hand_gives() -> None:
    spring = Spring(574.0, 8e6)
    by_path = changed(sleeves__front__spring__stiffness=8e6)
    assert by_path == with_sleeve(mfw2310(), "front", spring=spring)
    assert rotordyn.vary(mfw2310(), {"sleeves.front.spring": spring}) == by_path


def test_no_change_is_the_same_case() -> None:
    """What it was read from and how it came about do not tell one case from another."""
    shipped = rotordyn.load("grinding_spindle")
    assert shipped.vary({}) == shipped
    assert shipped.vary({"conditions.axial_force": 1.0}) != shipped
    back = {"conditions.axial_force": shipped.conditions.axial_force}
    assert shipped.vary({"conditions.axial_force": 1.0}).vary(back) == shipped


@pytest.mark.parametrize("one", [np.array(500.0), np.float32(500.0), xr.DataArray(500.0)])
def test_arrays_without_axes_are_their_value(one: Any) -> None:
    force = case().vary({"conditions.axial_force": one}).conditions.axial_force
    assert (type(force), force) == (float, 500.0)
    asked = replace(case(), analyses={"stiffness": StiffnessSpec("Oc2")})
    steps = asked.vary({"analyses.stiffness.steps": one.astype(int) // 5})
    assert steps.analyses["stiffness"].steps == 100
    with pytest.raises(InvalidInput, match="wrong type"):
        case().vary({"conditions.axial_force": np.array([500.0])})


def test_a_star_is_every_item_or_entry() -> None:
    made = changed(bearings__a__growth__static=1e-6, bearings__b__growth=RingGrowth(2e-6))
    assert [seat.growth.static for seat in made.seats[:3]] == [1e-6, 2e-6, 43.2e-6]
    alike = changed(bearings__b__growth__static=1e-6)
    alike = rotordyn.vary(
        alike, {"bearings.*.growth.static": 4e-6, "bearings.c.growth.static": 5e-6}
    )
    assert [seat.growth.static for seat in alike.seats] == [4e-6, 4e-6, 5e-6, 4e-6, 4e-6]


def test_entries_of_mappings_go_by_key() -> None:
    made = changed(points__Oc2=-0.05, shortening__shift__c=-1e-6)
    assert made.points == {**mfw2310().points, "Oc2": -0.05}
    assert made.shortening.shift["c"] == -1e-6
    assert set(changed(**{"shortening__shift__*": 0.0}).shortening.shift.values()) == {0.0}


def test_places_of_a_matrix_are_written_as_in_files() -> None:
    rotor = rotordyn.model("spindles", "lalanne_ferraris")
    made = rotordyn.vary(rotor, {"supports.*.stiffness.yy": 1e8, "supports.left.damping.y_thz": 3})
    assert made.supports[1].stiffness == {("y", "y"): 1e8, ("z", "z"): 50e6}
    assert made.supports[0].damping["y", "thz"] == 3.0
    with pytest.raises(rotordyn.InvalidInput, match="unknown key 'yw'"):
        rotordyn.vary(rotor, {"supports.left.stiffness.yw": 1.0})


def test_text_with_a_unit_is_read_where_the_dimension_is_known() -> None:
    made = case().vary(
        {
            "spindle.sleeves.front.stop_travel": "45 um",
            "spindle.sleeves.rear.spring.stiffness": "rigid",
            "spindle.damping.rotor": ["2 %", 0.03],
            "spindle.points.Oc2": "-50 mm",
            "spindle.shaft.shear_coefficient": "hutchinson",
            "conditions.element_length": "10 mm",
            "conditions.axial_force": "1 kN",
            "speeds": ["0 rpm", "24000 rpm"],
            "analyses.frf.slices": (),
        }
    )
    assert made.spindle is not None
    front, rear = made.spindle.sleeves
    assert (front.stop_travel, rear.spring.stiffness) == (pytest.approx(45e-6), math.inf)
    assert made.spindle.rotor_damping == (0.02, 0.03)
    assert made.spindle.points["Oc2"] == pytest.approx(-0.05)
    assert made.spindle.shaft.shear_coefficient == "hutchinson"
    assert (made.conditions.element_length, made.conditions.axial_force) == (0.01, 1000.0)
    assert made.speeds == (0.0, pytest.approx(TOP))


def test_all_changes_are_made_together() -> None:
    """Neither list of names is possible beside the other's old value."""
    names = {"spindle.bearings.c.name": "third", "spindle.sleeves.front.bearings": ("third",)}
    shift = {"spindle.shortening.shift": {"d": 0.0, "e": 0.0}}
    assert case().vary({**names, **shift}).spindle is not None
    for path, value in names.items():
        with pytest.raises(rotordyn.InvalidInput, match="unknown bearing"):
            case().vary({path: value, **shift})


def test_what_is_within_another_change_holds_in_any_order() -> None:
    whole, one = "spindle.bearings.*.model", "spindle.bearings.a.model"
    models = [rotordyn.model("bearings", name) for name in ("s6014e", "vex60")]
    changes = {f"{one}.balls": 17, f"{whole}.balls": 19, one: models[0], whole: models[1]}
    found = case().vary(changes)
    assert [seat.bearing.balls for seat in found.spindle.seats][:2] == [17, 19]
    sizes = [seat.bearing.ball_diameter for seat in found.spindle.seats][:2]
    assert sizes == [each.ball_diameter for each in models]
    assert found == case().vary(dict(reversed(changes.items())))


def test_questions_can_be_changed_added_and_replaced() -> None:
    made = case().vary({"analyses.campbell.max_frequency": "2 kHz", "analyses.frf.slices": []})
    spec = made.analyses["campbell"]
    assert isinstance(spec, CampbellSpec)
    assert spec.max_frequency == 2000.0
    alone = case().vary({"analyses": {"preload": PreloadSpec()}})
    assert list(alone.vary({"analyses.campbell": CampbellSpec()}).analyses) == [
        "preload",
        "campbell",
    ]


GRINDING = """
spindle: grinding_spindle
override:
  bearings.*.model: kh6014e
  growth: {static: 0 um}
  bearings.b.fits: {shaft: js5}
speeds: [0 rpm]
analyses: {campbell: {max_frequency: 1 kHz}}
"""
END_MILL = """
spindle: mfw2310
tool: hsk63_end_mill_16
speeds: [0 rpm]
analyses: {campbell: {max_frequency: 1 kHz}}
"""
AS_IN_FILES: dict[str, tuple[str, dict[str, Any], tuple[str, str]]] = {
    "fits from nothing, of bearings without their own": (
        GRINDING,
        {"spindle.fits.shaft": "k6"},
        ("override:", "override:\n  fits.shaft: k6"),
    ),
    "those of one more": (
        GRINDING,
        {"spindle.bearings.a.fits.taken": "most", "spindle.fits.housing": "JS5"},
        ("override:", "override:\n  fits.housing: JS5\n  bearings.a.fits.taken: most"),
    ),
    "temperatures from nothing": (
        GRINDING,
        {"conditions.temperatures.shaft": 40, "conditions.temperatures.housing": "30 degC"},
        ("speeds:", "conditions: {temperatures: {shaft: 40 degC, housing: 30 degC}}\nspeeds:"),
    ),
    "damping of all bearings": (
        GRINDING,
        {"spindle.damping.bearings.radial": 600.0},
        ("override:", "override:\n  damping.bearings.radial: 600 N*s/m"),
    ),
    "another tool": (
        END_MILL,
        {"tool": "hsk63_end_mill_20", "spindle.bearings.a.growth.static": "1 um"},
        ("_16", "_20\noverride: {bearings.a.growth.static: 1 um}"),
    ),
    "a tool where there was none": (
        END_MILL.replace("tool: hsk63_end_mill_16\n", ""),
        {"tool": "hsk63_end_mill_20"},
        ("speeds:", "tool: hsk63_end_mill_20\nspeeds:"),
    ),
}


@pytest.mark.parametrize("what", AS_IN_FILES)
def test_paths_of_files_give_what_a_file_gives(what: str, tmp_path: Path) -> None:
    text, changes, (old, new) = AS_IN_FILES[what]
    path = tmp_path / "case.yaml"
    path.write_text(text)
    before = rotordyn.load(path)
    path.write_text(text.replace(old, new))
    wanted = rotordyn.load(path)
    made = before.vary(changes)
    assert made != before
    assert (made.spindle, made.conditions) == (wanted.spindle, wanted.conditions)
    assert (made.tool, made.analyses) == (wanted.tool, wanted.analyses)


def test_a_part_of_the_tool_and_the_tool_itself_are_one(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(END_MILL)
    before = rotordyn.load(path)
    longer = before.vary({"tool.sections.flutes.length": "50 mm"})
    assert longer.tool is not None
    assert longer.spindle is not None
    assert longer.spindle.shaft.sections[0].length == longer.tool.sections[0].length == 0.05
    assert longer.vary({"tool": before.tool}).spindle == before.spindle
    bare = before.vary({"tool": None})
    assert bare.spindle == rotordyn.model("spindles", "mfw2310")
    assert bare.vary({"tool": before.tool}).spindle == before.spindle
    assert before.vary({"spindle": bare.spindle}).tool is None
    within = before.vary({"spindle.shaft.sections.flutes.length": "50 mm"})
    assert (within, within.tool) == (longer, longer.tool)
    assert within.vary({"tool": None}) == bare
    every = before.vary({"shaft.sections.*.material": "tool_steel"})
    assert every.tool is not None
    assert all("tool steel" in section.material.name for section in every.tool.sections)


def test_bearings_and_materials_can_be_changed_too() -> None:
    made = changed(
        **{
            "bearings__*__model__inner_conformity": 0.53,
            "shaft__sections__motor__material": STEEL,
            "shaft__sections__nose__material__density": 8000.0,
        }
    )
    assert {seat.bearing.inner_conformity for seat in made.seats} == {0.53}
    assert {s.name: s.material.density for s in made.shaft.sections}["nose"] == 8000.0
    balls = "bearings__*__model__ball_material__young_modulus"
    made = changed(**{"shaft__sections__nose__material__density": "8 g/cm^3", balls: "300 GPa"})
    assert {s.name: s.material.density for s in made.shaft.sections}["nose"] == 8000.0
    assert {seat.bearing.ball_material.young_modulus for seat in made.seats} == {300e9}


def test_another_bearing_is_not_called_as_the_one_before() -> None:
    model = rotordyn.model("bearings", "vex55")
    made = changed(**{"bearings__a__model": model, "bearings__b__model__balls": 12})
    assert [seat.model for seat in made.seats[:2]] == ["", "VEX 70"]
    same = changed(**{"bearings__a__model": changed().seats[0].bearing})
    assert same.seats[0].model == "VEX 70"


def test_where_each_bearing_has_its_own_the_way_there_is_named() -> None:
    """A way that can be taken, also where the common one has more steps."""
    seats = tuple(replace(seat, own=("damping", "growth")) for seat in mfw2310().seats)
    each = replace(mfw2310(), seats=seats)
    for common, own in (
        ("damping.bearings.radial", "bearings.*.damping.radial"),
        ("growth.static", "bearings.*.growth.static"),
    ):
        with pytest.raises(InvalidInput, match="has its own value here; change") as refused:
            rotordyn.vary(each, {common: 2e-6})
        assert str(refused.value).endswith(f"change {own}")
        assert rotordyn.vary(each, {own: 2e-6}) != each


def test_what_changes_a_case_changes_its_variants() -> None:
    whole = case("mfw2310_preload_springs")
    made = whole.vary(
        {"speeds": (0.0, 100.0), "analyses.frf.slices": (), "conditions.rotor": "rigid"}
    )
    assert {v.speeds for v in made.variants.values()} == {(0.0, 100.0)}
    assert {v.conditions.rotor for v in made.variants.values()} == {"rigid"}
    stiff = "variants.stiff.spindle.sleeves.front.spring.stiffness"
    one = whole.vary({stiff: "15 N/um"})
    assert one.spindle == whole.spindle
    assert one.variants["soft"] == whole.variants["soft"]
    assert one.variants["stiff"].spindle.sleeves[0].spring.stiffness == 15e6  # type: ignore[union-attr]


def test_a_changed_case_is_another_one_and_the_old_stays() -> None:
    before = repr(case())
    same = case().vary({"conditions.rotor": "rigid"})
    assert repr(case()) == before
    assert same.digest == case().vary({"conditions.rotor": "rigid"}).digest
    assert (
        len({same.digest, case().digest, same.vary({"conditions.rotor": "flexible"}).digest}) == 3
    )
    assert same.files == case().files


def test_a_further_point_by_its_path_is_that_of_an_override(tmp_path: Path) -> None:
    """Variants are made by files alone."""
    changes: dict[str, object] = {"points.further": "100 mm", "points.nose": "5 mm"}
    text = "spindle: grinding_spindle\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n"
    (tmp_path / "plain.yaml").write_text(text)
    listed = ", ".join(f"{path}: {value}" for path, value in changes.items())
    (tmp_path / "other.yaml").write_text(f"{text}override: {{{listed}}}\n")
    plain, other = (rotordyn.load(tmp_path / f"{name}.yaml") for name in ("plain", "other"))
    varied = rotordyn.vary(plain, {f"spindle.{path}": value for path, value in changes.items()})
    assert varied.spindle == other.spindle
    assert varied.spindle is not None
    assert varied.spindle.points["further"] == pytest.approx(0.1)
    with pytest.raises(rotordyn.InvalidInput, match="unknown key 'new' in 'variants'"):
        rotordyn.vary(rotordyn.load("grinding_spindle"), {"variants.new.title": "x"})


WRONG = {
    "spindle.sleves.front": (
        1,
        "unknown key: given 'sleves'; allowed: shaft, .*did you mean sleeves",
    ),
    "sleves.front.mass": (
        1,
        "unknown key: given 'sleves'; allowed: title, speeds, analyses, conditions, spindle, "
        "bearing, references, uncertain, tool, shaft, masses, .*, fits, flexible_rings .did you",
    ),
    "spindel": (1, "unknown key: given 'spindel'; .*did you mean spindle"),
    "spindle.sleeves.frnt.mass": (1, "unknown name 'frnt' .*; allowed: front, rear .*front"),
    "spindle.points.OC2": (0.0, "unknown key 'OC2' .*did you mean Oc2"),
    "analyses.frff": (1, "unknown key 'frff' .*did you mean frf"),
    "analyses.frf": (1, "wrong shape: given '1'; allowed: a mapping"),
    "analyses.bearing.loads": ((1.0,), "does not apply to a spindle"),
    "tool.sections.nosuch.length": (0.05, "unknown name 'nosuch' in 'tool.sections'"),
    "spindle.shaft.sections.nose.material.density": ("8 g", "'g' is not a unit of density"),
    "shaft.sections.nose.material.density": (0.284, "mean 0.284 lb/in.3 = 7861.09 kg/m.3"),
    "shaft.sections.*.material.density": ("0.284 kg/m^3", "mean 0.284 lb/in.3"),
    "spindle.fits.shft": ("k5", "unknown key: given 'shft'; .*did you mean shaft"),
    "spindle.fits.shaft": ("k5", "fits contradict a given growth"),
    "conditions.temperatures.shft": (40.0, "did you mean shaft"),
    "conditions.films.temperature": (40.0, "also needs viscosity_40, viscosity_100"),
    "bearing.balls": (3, "'bearing' has no parts; give it whole"),
    "spindle.damping.bearings": (0.1, "a mapping .key: value. with radial, axial"),
    "spindle.damping": ({"bearings": {"radail": 1.0}}, "'radail'; allowed: radial, axial .did you"),
    "spindle.bearings.a.model.estimate": ({}, "give 'spindle.bearings.a.model' whole"),
    "spindle.bearings.a.model.kind": ("ball", "unknown kind of bearing"),
    "speeds.to": ("9000 rpm", "'speeds' is a list of values: give it whole"),
    "spindle.title.x": (1, "leads too far"),
    "speeds.0": (1.0, "unknown number '0' in 'speeds'; allowed: from 1 to"),
    "speeds": ((0.0, math.nan), r"speeds\.2: not a number"),
    "spindle.sleeves.front.spring": (8e6, "wrong shape: .* with preload, stiffness"),
    "spindle.sleeves.front.spring.stiffness": ("8 N", "'N' is not a unit of stiffness"),
    "spindle.sleeves.rear.spring.stiffness": ("rigd", "or rigid .did you mean rigid"),
    "spindle.sleeves.rear.spring.preload": (-1.0, "force out of range: given -1 N"),
    "spindle.bearings.a.model.contact_angle": ("70 deg", "allowed: from 0 deg up to 60 deg"),
    "spindle.bearings.a.kinematics": ("hybird", "did you mean hybrid"),
    "spindle.bearings.a.model.balls": (60, "overlap"),
    "spindle.seats.a.x": (5.0, "'seats' is called 'bearings' here, as in files"),
    "spindle.bearings.a.x": (5.0, "off the shaft"),
    "spindle.bearings.a.model": ("vex5", "unknown model: given 'vex5'; .*did you mean vex"),
    "spindle.shaft.sections.nose.material": ("steel", "unknown model: .*did you mean tool_steel"),
    "shaft.sections.nose.material": (STEEL.density, "not a model"),
    "sleeves.front.spring": ({"preload": "9 mm"}, r"spring\.preload: 'mm' is not a unit of force"),
    "sleeves.rear.spring": ({"preloda": "9 N"}, "unknown key: given 'preloda'; .*did you mean"),
    "spindle.bearings.*": (1, "wrong shape: .* with name, model, x"),
    "spindle.*": (1, "unknown key"),
    "*": (1, r"unknown key: given '\*'; allowed: title, .*, fits"),
    "conditions.rotor": ("rigidd", "did you mean rigid"),
    "conditions": (None, "wrong shape: given nothing"),
    "analyses.stiffness.point": ("Oc9", "unknown point: given 'Oc9'"),
    "": (1, "not a dotted path"),
    "spindle..name": (1, "not a dotted path"),
}


@pytest.mark.parametrize("path", WRONG)
def test_a_wrong_path_or_value_is_refused_in_one_sentence(path: str) -> None:
    value, said = WRONG[path]
    with pytest.raises(rotordyn.InvalidInput, match=said) as refused:
        case().vary({path: value})
    assert "\n" not in str(refused.value)
    assert path in str(refused.value)


@pytest.mark.parametrize(
    ("thing", "changes"),
    [
        (5, {}),
        (None, {}),
        (rotordyn.Case, {}),
        (case(), None),
        (case(), [("a", 1)]),
        (case(), {3: 1}),
    ],
)
def test_things_that_cannot_be_varied(thing: Any, changes: Any) -> None:
    with pytest.raises(rotordyn.InvalidInput, match=r"vary takes|changes map|not a dotted path"):
        rotordyn.vary(thing, changes)


words = st.sampled_from(
    ["spindle", "sleeves", "front", "spring", "*", "points", "Oc2", "speeds", "analyses", "frf"]
)
values = st.one_of(
    st.none(), st.floats(), st.text(max_size=8), st.booleans(), st.lists(st.integers(), max_size=2)
)


@settings(max_examples=200)
@given(st.lists(words | st.text(max_size=5), min_size=1, max_size=5), values)
def test_any_path_and_value_gives_a_case_or_a_sentence(steps: list[str], value: object) -> None:
    try:
        made = case().vary({".".join(steps): value})
    except rotordyn.InvalidInput:
        pass
    else:
        assert isinstance(made, rotordyn.Case)


def test_varied_cases_can_be_run() -> None:
    lean = case().vary({"speeds": np.linspace(0, TOP, 2), "analyses": {"preload": PreloadSpec()}})
    loads = [
        rotordyn.run(lean.vary({"spindle.sleeves.*.spring.preload": f}))["preload"].axial_load
        for f in ("300 N", "600 N")
    ]
    assert loads[0].sel(bearing="c")[0] == pytest.approx(300.0)
    assert (loads[1] > loads[0]).all()
    assert replace(lean, title="x").vary({}).title == "x"


@pytest.mark.parametrize(
    ("path", "meant"),
    [
        ("kinematics", "conditions.kinematics"),
        ("spindle.bearings.a.contact_angle", "model.contact_angle"),
    ],
)
def test_a_key_that_is_further_down_is_pointed_at(path, meant):
    case = rotordyn.load("mfw2310")
    with pytest.raises(InvalidInput, match=re.escape(f"did you mean {meant}?")):
        case.vary({path: 1.0})


def test_a_range_of_files_is_one_in_python_too() -> None:
    case = rotordyn.load("grinding_spindle").vary({"analyses": {"preload": None}})
    asked = {"from": "0 rpm", "to": "9000 rpm", "step": "1000 rpm"}
    assert case.vary({"speeds": asked}).speeds == pytest.approx(np.linspace(0, 300 * math.pi, 10))
    top = 300 * math.pi
    assert case.vary({"speeds": {"from": 0, "to": top, "count": 10}}).speeds[-1] == top
    with pytest.raises(InvalidInput, match=r"speeds\.step: the step does not reach the end"):
        case.vary({"speeds": {**asked, "step": "2000 rpm"}})


def test_a_material_given_for_all_sections_goes_to_those_without_their_own() -> None:
    varied = rotordyn.load("mfw2310").vary({"shaft.material": STEEL})
    named = {section.name: section.material for section in varied.spindle.shaft.sections}
    assert named["nose"] == STEEL
    assert named["motor"].name != STEEL.name
    with_tool = rotordyn.load("mfw2310_lobes")
    same = with_tool.vary({"shaft.material": STEEL})
    assert same.tool == with_tool.tool
    assert same.spindle.shaft.sections[0] == with_tool.spindle.shaft.sections[0]
    own = varied.vary({"shaft.sections.nose.material": "steel_rotor"})
    every = tuple(replace(each, own=("material",)) for each in own.spindle.shaft.sections)
    with pytest.raises(InvalidInput, match=r"change shaft\.sections\.\*\.material"):
        own.vary({"shaft.sections": every}).vary({"shaft.material": STEEL})


def test_a_path_is_given_once_with_or_without_the_machine_before_it() -> None:
    changes = {"sleeves.front.mass": 1.0, "spindle.sleeves.front.mass": 2.0}
    with pytest.raises(InvalidInput, match=r"given twice, with and without 'spindle\.' before it"):
        case().vary(changes)
    assert case().vary({"title": "x"}).title == "x"
    assert case().vary({"spindle.title": "x"}).title == case().title


def test_an_item_without_a_name_goes_by_its_place(tmp_path: Path) -> None:
    """In Python, in a study's path and in an override alike."""
    path = "spindle.damping.rotor.2"
    case = rotordyn.load("mfw2310")
    assert case.vary({path: "3 %"}).spindle.rotor_damping == (0.01, 0.03, 0.05)
    assert case.vary({"spindle.damping.rotor.*": 0.04}).spindle.rotor_damping == (0.04,) * 3
    (found,) = parameters(case, {path: Span("1 %", "5 %")})
    assert found.ends == (0.01, 0.05)
    file = tmp_path / "other.yaml"
    lines = "spindle: mfw2310\noverride: {damping.rotor.2: 3 %}\nspeeds: [0 rpm]\n"
    file.write_text(f"title: x\n{lines}analyses: {{campbell: {{max_frequency: 900 Hz}}}}\n")
    assert rotordyn.load(file).spindle.rotor_damping == (0.01, 0.03, 0.05)
    file.write_text(file.read_text().replace("rotor.2: 3 %", "rotor.*: 5 %, damping.rotor.2: 4 %"))
    assert rotordyn.load(file).spindle.rotor_damping == (0.05, 0.04, 0.05)
    with pytest.raises(InvalidInput, match=r"unknown number '4'.*from 1 to 3"):
        case.vary({"spindle.damping.rotor.4": 0.1})


def test_a_mapping_is_called_one_in_a_sentence() -> None:
    case = rotordyn.load("grinding_spindle")
    with pytest.raises(InvalidInput) as refused:
        rotordyn.vary(case, {"conditions.kinematics": {"a": 1}})
    assert "given a mapping" in str(refused.value)
    assert "Node" not in str(refused.value)


def test_values_nested_without_end_are_refused_in_one_sentence() -> None:
    nested: list[Any] = []
    for _ in range(5000):
        nested = [nested]
    for call in (
        lambda: case().vary({"speeds": nested}),
        lambda: case().vary({"title": nested}),
        lambda: case().vary(nested),  # type: ignore[arg-type]
        lambda: rotordyn.load(nested),  # type: ignore[arg-type]
        lambda: Spring(nested),  # type: ignore[arg-type]
    ):
        with pytest.raises(InvalidInput, match=r"nested (too deeply|deeper)"):
            call()
