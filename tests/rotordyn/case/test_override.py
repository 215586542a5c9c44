"""Single values of a model changed from the case file."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

import rotordyn
from bearings.materials import Material
from rotordyn.analyses.registry import analysis, names
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.case.case import Case
from rotordyn.case.expand import NAMED
from rotordyn.case.keys import MODELS, keys_of
from rotordyn.errors import InvalidInput
from rotordyn.field import descriptions
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

Override = Callable[..., Spindle]
CASE = """
spindle: mfw2310
override:
{override}
speeds: [0 rpm]
analyses: {{preload: {{}}}}
"""


@pytest.fixture
def overridden(tmp_path: Path) -> Override:
    def read(*lines: str) -> Spindle:
        path = tmp_path / "case.yaml"
        path.write_text(CASE.format(override="\n".join(f"  {line}" for line in lines)))
        spindle = rotordyn.load(path).spindle
        assert spindle is not None
        return spindle

    return read


def test_item_of_a_list_by_name(overridden: Override) -> None:
    spindle = overridden("sleeves.front.spring.stiffness: 8 N/um")
    assert [sleeve.spring.stiffness for sleeve in spindle.sleeves] == [8e6, 5.49e6]


def test_the_path_of_the_case_names_the_same(overridden: Override) -> None:
    """As ``vary``, studies and ``uncertain`` write it."""
    spindle = overridden("spindle.sleeves.front.spring.stiffness: 8 N/um")
    assert spindle.sleeves[0].spring.stiffness == 8e6
    with pytest.raises(InvalidInput, match=r"given twice: 'sleeves.front.mass', with and without"):
        overridden("spindle.sleeves.front.mass: 1 kg", "sleeves.front.mass: 2 kg")


def test_a_variant_names_it_either_way(tmp_path: Path) -> None:
    """What it says comes last, whichever way the case names it."""
    path = tmp_path / "case.yaml"
    text = CASE.format(override="  sleeves.front.mass: 1 kg")
    path.write_text(f"{text}compare: {{a: {{override: {{spindle.sleeves.front.mass: 2 kg}}}}}}\n")
    case = rotordyn.load(path)
    assert case.spindle.sleeves[0].mass == 1.0
    assert case.variants["a"].spindle.sleeves[0].mass == 2.0


def test_a_key_of_the_model_is_pointed_at(overridden: Override) -> None:
    with pytest.raises(InvalidInput, match=r"did you mean model\.contact_angle\?"):
        overridden("bearings.a.contact_angle: 20 deg")


def test_words_in_place_of_values(overridden: Override) -> None:
    spindle = overridden("sleeves.rear.spring.stiffness: rigid", "sleeves.front.stop_travel: none")
    assert spindle.sleeves[1].spring.stiffness == math.inf
    assert spindle.sleeves[0].stop_travel == math.inf


def test_key_that_the_file_leaves_out(overridden: Override) -> None:
    spindle = overridden("bearings.a.growth.static: 10 um", "sleeves.front.mass: 3 kg")
    assert [seat.growth.static for seat in spindle.seats] == [10e-6] + [43.2e-6] * 4
    assert spindle.sleeves[0].mass == 3.0


def test_one_bearing_after_all_of_them(overridden: Override) -> None:
    """Each has a value of its own, also where one entry wrote them all."""
    spindle = overridden("bearings.*.growth: {static: 1 um}", "bearings.a.growth.static: 10 um")
    assert [seat.growth.static for seat in spindle.seats] == [10e-6] + [1e-6] * 4


def test_bearing_model_of_one_seat(overridden: Override) -> None:
    spindle = overridden("bearings.a.model_override: {outer_conformity: 0.54, balls: 24}")
    assert [seat.bearing.balls for seat in spindle.seats] == [24, 25, 25, 25, 25]
    assert [seat.bearing.outer_conformity for seat in spindle.seats] == [0.54] + [0.571] * 4


def test_bearing_model_of_all_seats(overridden: Override) -> None:
    spindle = overridden("bearing_override.ball_material: bearing_steel")
    assert {seat.bearing.ball_material.name for seat in spindle.seats} == {"bearing steel"}


def test_key_of_a_material_that_is_named(overridden: Override) -> None:
    spindle = overridden(
        "growth: {static: 0 um}",
        "fits: {shaft: k5, housing: JS5, housing_material: steel_rotor}",
        "bearings.b.fits.housing_material.thermal_expansion: 9e-6 1/K",
    )
    found = [seat.fits.housing_material for seat in spindle.seats if seat.fits is not None]
    assert len({material.name for material in found}) == 1
    assert [m.thermal_expansion == 9e-6 for m in found] == [False, True, False, False, False]


def test_material_by_name_in_the_model_of_a_seat(overridden: Override) -> None:
    spindle = overridden(
        "bearings.*.model.ball_material: bearing_steel",
        "bearings.d.model.ball_material: silicon_nitride",
    )
    names = [seat.bearing.ball_material.name for seat in spindle.seats]
    assert names == ["bearing steel"] * 3 + ["silicon nitride", "bearing steel"]


def test_another_model(overridden: Override) -> None:
    spindle = overridden("bearings.d.model: vex70")
    assert spindle.seats[3].bearing.pitch_diameter == 0.09


def test_whole_item_replaced(overridden: Override) -> None:
    item = "{name: drawbar, x: 200 mm, mass: 1 kg}"
    spindle = overridden(f"masses.drawbar_middle: {item}")
    assert [mass.name for mass in spindle.masses][2] == "drawbar"


def test_whole_list_replaced(overridden: Override) -> None:
    assert overridden("masses: []").masses == ()


def test_single_bearing(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "bearing: vex70\noverride: {contact_angle: 15 deg}\nspeeds: [0 rpm]\n"
        "analyses: {bearing: {loads: [100 N]}}\n"
    )
    bearing = rotordyn.load(path).bearing
    assert bearing is not None
    assert bearing.contact_angle == pytest.approx(math.radians(15.0))


def test_an_alias_is_changed_in_one_place_only(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: lalanne_ferraris\noverride: {supports.left.stiffness.yy: 1 N/um}\n"
        "speeds: [0 rpm]\nanalyses: {campbell: {}}\n"
    )
    spindle = rotordyn.load(path).spindle
    assert spindle is not None
    assert [support.stiffness["y", "y"] for support in spindle.supports] == [1e6, 70e6]


SAME_PATHS = {
    "sleeves.*.spring.stiffness": "8 N/um",
    "bearings.a.growth.static": "1 um",
    "bearings.*.growth.fit.interference": "30 um",
    "bearings.*.model.outer_conformity": "0.55",
    "bearings.b.model.ball_material.density": "3200 kg/m^3",
    "bearings.c.damping.axial": "9 N s/m",
    "shaft.sections.nose.material.young_modulus": "200 GPa",
    "shaft.sections.*.material.density": "7800 kg/m^3",
    "damping.rotor": "[1 %, 2 %]",
    "shortening.shift.c": "-1 um",
    "points.O1": "50 mm",
    "bearings.*.model": "vex65",
    "bearings.a.model": "vex60",
    "sleeves.front.spring": "{preload: 9 N, stiffness: 8 N/um}",
    "shaft.material": "bearing_steel",
    "shaft.sections.nose.material": "tool_steel",
    "bearings.c.model.ball_material": "bearing_steel",
    "masses": "[{name: drawbar, x: 200 mm, mass: 1 kg}]",
}


@pytest.mark.parametrize("path", SAME_PATHS)
def test_a_path_means_in_a_file_what_it_means_in_python(path: str, overridden: Override) -> None:
    """What a model, or a value given for all, holds besides stays as it was."""
    written = SAME_PATHS[path]
    plain = overridden("title: x")
    varied = rotordyn.vary(plain, {path: yaml.safe_load(written)})
    assert overridden("title: x", f"{path}: {written}") == varied
    assert varied != plain
    wanted = overridden(f"{path}: {written}")
    for made, meant in zip(varied.seats, wanted.seats, strict=True):
        assert (made.sizes, made.preloads) == (meant.sizes, meant.preloads)


FRF = "{pairs: [{response: tip.y, excitation: tip.y}], frequencies: {from: 100 Hz, to: 900 Hz}}"
OF_A_CASE = {
    "speeds": "{from: 0 rpm, to: 9000 rpm, step: 3000 rpm}",
    "conditions.kinematics": "outer",
    "conditions.temperatures": "{shaft: 40 degC, housing: 30 degC}",
    "conditions": "{rotor: rigid}",
    "analyses.stiffness": "{point: nose_face}",
    "analyses.campbell.max_frequency": "2 kHz",
    "analyses": "{preload: , stiffness: {point: nose_face}}",
    "title": "another",
    "spindle.title": "another",
    "spindle": "grinding_spindle",
    "tool": "hsk63_end_mill_20",
    "tool.sections.flutes.length": "50 mm",
    "tool.sections.flutes.material": "tool_steel",
    "tool.sections.flutes.material.density": "8000 kg/m^3",
    "uncertain": "as usual",
    "uncertain.samples": "20",
    "spindle.sleeves.front.mass": "2 kg",
    "bearings.d.model": "vex65",
    "shaft.material": "bearing_steel",
    "tool.sections.*.material.density": "8000 kg/m^3",
    "shaft.sections.*.material.density": "8000 kg/m^3",
    "shaft.sections.flutes.length": "50 mm",
    "points.*": "1 mm",
    "references": "[]",
    "spindle.references": "[]",
    "bearing_override.contact_angle": "20 deg",
    "bearings.d.model_override": "{contact_angle: 20 deg}",
    "damping": "{rotor: [2 %], bearings: {radial: 9 N s/m}}",
    "shaft.sections.nose": "{name: nose, length: 18.6 mm, outer_diameter: 91 mm}",
}


@pytest.mark.parametrize("path", OF_A_CASE)
def test_a_path_of_the_case_is_one_of_an_override(path: str, tmp_path: Path) -> None:
    """In the case itself and in a variant, as in ``vary``."""
    machine = "spindle: mfw2310\ntool: hsk63_end_mill_16\nconditions: {friction: 0.1}\n"
    text = f"{machine}speeds: [0 rpm]\nanalyses: {{campbell: {{max_frequency: 1 kHz}}}}\n"
    uncertain = "uncertain: {tolerances: {spindle.sleeves.*.spring.preload: ± 5 %}}\n"
    file, written = tmp_path / "case.yaml", OF_A_CASE[path]
    changes = {path: yaml.safe_load(written)}
    file.write_text(text + uncertain, encoding="utf-8")
    plain = rotordyn.load(file)
    varied = rotordyn.vary(plain, changes)
    override = f"override: {{{path}: {written}}}"
    file.write_text(f"{text}{uncertain}{override}\n", encoding="utf-8")
    wanted = rotordyn.load(file)
    assert (varied, varied.tool) == (wanted, wanted.tool)
    assert (varied, varied.tool) != (plain, plain.tool)
    if path.partition(".")[0] in ("speeds", "analyses", "uncertain", "title"):
        return  # those of variants are those of the case
    file.write_text(f"{text}compare: {{a: {{{override}}}}}\n", encoding="utf-8")
    variant = rotordyn.load(file).variants["a"]
    assert (variant.spindle, variant.tool, variant.conditions) == (
        wanted.spindle,
        wanted.tool,
        wanted.conditions,
    )


def test_a_model_by_name_brings_the_sizes_of_its_rings(overridden: Override) -> None:
    """Fits and growth take them unless they say otherwise."""
    lines = ["growth: {static: 0 um}", "fits: {shaft: k5, housing: JS5}"]
    plain = overridden(*lines)
    model = "bearings.a.model"
    varied = rotordyn.vary(plain, {model: "vex65"})
    wanted = overridden(*lines, f"{model}: vex65")
    assert varied == wanted
    assert varied.seats[0].sizes == wanted.seats[0].sizes
    assert varied.seats[0].fits.bore_diameter == pytest.approx(0.065)  # type: ignore[union-attr]
    fits = {"shaft": "js5"}
    again = rotordyn.vary(plain, {"bearings.b.fits": fits})
    assert again == overridden(*lines, "bearings.b.fits: {shaft: js5}")


def test_the_order_of_overrides_does_not_matter(overridden: Override) -> None:
    """As in ``vary``: what is within something, and one item of all, come last."""
    lines = ["sleeves.front.mass: 1 kg", "sleeves.*.mass: 2 kg", "sleeves.rear.spring.preload: 9 N"]
    lines.append("sleeves.rear.spring: {preload: 8 N, stiffness: 5 N/um}")
    assert overridden(*lines) == overridden(*lines[::-1])
    part, whole = lines[2], f"spindle.{lines[3]}"  # as deep as written, though it contains the part
    assert overridden(part, whole).sleeves[1].spring.preload == 9.0


@pytest.mark.parametrize("speeds", ["[0 rpm]", "{from: 0 rpm, to: 900 rpm, step: 900 rpm}"])
def test_what_only_a_range_has_is_no_path(speeds: str, tmp_path: Path) -> None:
    file, said = tmp_path / "case.yaml", "'speeds' is a list of values: give it whole"
    text = f"spindle: mfw2310\nspeeds: {speeds}\nanalyses: {{campbell: {{max_frequency: 1 kHz}}}}\n"
    file.write_text(text)
    with pytest.raises(InvalidInput, match=said):
        rotordyn.load(file).vary({"speeds.to": "9000 rpm"})
    file.write_text(f"{text}override: {{speeds.to: 9000 rpm}}\n")
    with pytest.raises(InvalidInput, match=said) as found:
        rotordyn.load(file)
    assert len(found.value.faults) == 1


def test_one_value_of_a_range_is_no_path(tmp_path: Path) -> None:
    """A range has no items to replace; ``from`` and ``to`` of it are no path either."""
    file, speeds = tmp_path / "case.yaml", "{from: 0 rpm, to: 900 rpm, step: 900 rpm}"
    text = f"spindle: mfw2310\nspeeds: {speeds}\nanalyses: {{campbell: {{max_frequency: 1 kHz}}}}\n"
    file.write_text(f"{text}override: {{speeds.1: 9000 rpm}}\n")
    with pytest.raises(InvalidInput, match="'speeds' is a list of values: give it whole"):
        rotordyn.load(file)


TOOL = """\
{sections: [{name: bit, length: 40 mm, outer_diameter: 12 mm, material: tool_steel},
{name: holder, length: 30 mm, outer_diameter: 60 mm, material: tool_steel}], points: {tip: front},
joints: [{name: taper, x: 0 mm, tilt: 1 MN m/rad}],
masses: [{name: nut, x: -50 mm, mass: 0.1 kg}]}""".replace("\n", " ")


@pytest.mark.parametrize(
    "change",
    [
        {"joints": []},
        {"joints": [{"name": "coupling", "x": "100 mm", "tilt": "1 MN m/rad"}]},
        {"masses": [{"name": "gear", "x": "100 mm", "mass": "1 kg"}]},
        {"points": {"gauge": "20 mm"}},
        {"shaft.start": "-1 mm"},
        {"shaft.sections": [{"name": "whole", "length": "500 mm", "outer_diameter": "70 mm"}]},
        {
            "shaft": {
                "start": "-2 mm",
                "material": "tool_steel",
                "sections": [{"name": "whole", "length": "500 mm", "outer_diameter": "70 mm"}],
            },
            "shaft.sections.whole.length": "600 mm",
        },
        {"tool": "hsk63_end_mill_16", "masses": [], "points": {"gauge": "20 mm"}},
    ],
)
def test_what_is_given_whole_of_the_spindle_leaves_the_tool_in_its_nose(
    change: dict[str, Any], tmp_path: Path
) -> None:
    file, stiffness = tmp_path / "case.yaml", "stiffness: {xx: 1 N/um, yy: 1 N/um, zz: 1 N/um}"
    text = (
        "spindle:\n"
        "  shaft: {start: 0 mm, material: steel_rotor, sections: "
        "[{name: body, length: 450 mm, outer_diameter: 60 mm}]}\n"
        f"  supports: [{{name: a, x: 50 mm, {stiffness}}}, {{name: b, x: 400 mm, {stiffness}}}]\n"
        f"  points: {{nose: 0 mm}}\ntool: {TOOL}\nspeeds: [0 rpm]\n"
        "analyses: {campbell: {max_frequency: 1 kHz}}\n"
    )
    file.write_text(text)
    varied = rotordyn.load(file).vary(change)
    file.write_text(f"{text}override: {json.dumps(change)}\n")
    assert varied == rotordyn.load(file)
    assert "tip" in varied.spindle.points


def test_a_list_in_python_may_contain_the_items_of_the_tool() -> None:
    """As that of a spindle with a tool in its nose does."""
    case = rotordyn.load("mfw2310_lobes")
    assert case.vary({"shaft.sections": case.spindle.shaft.sections}).spindle == case.spindle
    assert case.vary({"shaft": case.spindle.shaft}).spindle == case.spindle


def test_nothing_for_the_tool_takes_it_out(tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    text = "spindle: mfw2310\nspeeds: [0 rpm]\nanalyses: {campbell: {max_frequency: 1 kHz}}\n"
    file.write_text(text)
    bare = rotordyn.load(file)
    file.write_text(f"{text}tool: hsk63_end_mill_16\n")
    clamped = rotordyn.load(file)
    file.write_text(f"{text}tool: hsk63_end_mill_16\noverride: {{tool: }}\n")
    assert rotordyn.load(file) == bare == clamped.vary({"tool": None}) != clamped


def test_an_unknown_first_key_is_one_fault_that_lists_all_first_keys(overridden: Override) -> None:
    plain = rotordyn.load("mfw2310")
    for key in ("*", "sleves", "sleves.front.mass"):
        with pytest.raises(InvalidInput) as found:
            overridden(f"'{key}': 1")
        (fault,) = found.value.faults
        first = key.partition(".")[0]
        assert f"unknown key: given '{first}'; allowed: title, speeds, analyses" in fault.message
        assert "tool, shaft, masses" in fault.message
        assert "flexible_rings" in fault.message
        with pytest.raises(InvalidInput, match=re.escape(fault.message)):
            plain.vary({key: 1})


@pytest.mark.parametrize("path", ["tool.sections.flutes.length", "bearing.balls"])
def test_a_path_into_what_the_case_has_not_is_refused(path: str, overridden: Override) -> None:
    part = path.partition(".")[0]
    with pytest.raises(InvalidInput, match=f"leads into the {part}, and this case has none"):
        overridden(f"{path}: 9 mm")


@pytest.mark.parametrize(
    ("balls", "interference"), [("2", "4 um"), ("250", "-4 um"), ("250", "3 mm")]
)
def test_a_faulty_ball_guide_is_reported_with_its_place(
    overridden: Override, balls: str, interference: str
) -> None:
    sizes = "ball_diameter: 4 mm, column_diameter: 0.1 m"
    guide = f"{{balls: {balls}, {sizes}, interference: {interference}}}"
    with pytest.raises(
        InvalidInput, match=r"case\.yaml:4:.*ball_guide\.(balls|interference)"
    ) as found:
        overridden(f"sleeves.rear.ball_guide: {guide}")
    assert len(found.value.faults) == 1


def test_a_faulty_estimate_is_reported_once(overridden: Override) -> None:
    model = "name: A, bore_diameter: 70 mm, outside_diameter: 110 mm, contact_angle: 25 deg"
    with pytest.raises(InvalidInput) as found:
        overridden(f"bearings.*.model: {{{model}, estimate: {{preloads: [-190 N]}}}}")
    assert [fault.path for fault in found.value.faults] == [
        "override.bearings.*.model.estimate.preloads.1"
    ]


def test_keys_of_models_end_in_the_word_by_which_a_path_opens_them() -> None:
    kinds, seen = [Case, *(analysis(name).spec for name in names())], set()
    while kinds:
        seen.add(kind := kinds.pop())
        for field in keys_of(kind):
            inner = {*descriptions(field.annotation)}
            for model in inner & {Material, Tool, Workpiece}:
                word = field.keys[-1].rpartition("_")[2] if field.keys else ""
                assert not field.keys or NAMED[word] == MODELS[model], (kind, field.keys)
            kinds += inner - seen
    assert {Spindle, Material, Workpiece, Tool} <= seen
