"""A case that compares: what a variant changes, and where its faults are."""

from __future__ import annotations

from pathlib import Path
from textwrap import indent

import numpy as np
import pytest

import rotordyn
from rotordyn.case.library import models_root
from rotordyn.errors import InvalidInput
from rotordyn.job.solving import solve_variants
from rotordyn.machine.sleeve import Spring

CASE = """\
title: whole
spindle: mfw2310
tool: mfw2310_exciter
override:
  sleeves.front.stop_travel: 45 um
conditions:
  kinematics: outer
speeds: [0 rpm, 24000 rpm]
analyses:
  campbell: {{}}
compare:
{compare}
"""


def load(tmp_path: Path, compare: str) -> rotordyn.Case:
    path = tmp_path / "compared.yaml"
    path.write_text(CASE.format(compare=compare), encoding="utf-8")
    return rotordyn.load(path)


def test_a_variant_changes_what_bearings_of_a_spindle_in_place_share(tmp_path: Path) -> None:
    """The case itself, read before, leaves the tree of its file as it is."""
    spindle = (models_root() / "spindles" / "mfw2310.yaml").read_text(encoding="utf-8")
    place = f"spindle:\n{indent(spindle, '  ')}"
    path = tmp_path / "compared.yaml"
    changes = "  softer:\n    override: {growth.static: 5 um}\n"
    text = CASE.format(compare=changes).replace("spindle: mfw2310\n", place)
    path.write_text(text, encoding="utf-8")
    softer = rotordyn.load(path).variants["softer"].spindle
    assert softer is not None
    assert {seat.growth.static for seat in softer.seats} == {5e-6}


def test_a_variant_changes_what_bearings_of_an_override_share(tmp_path: Path) -> None:
    path = tmp_path / "compared.yaml"
    path.write_text(
        "spindle: mfw2310\n"
        "override:\n"
        "  bearings:\n"
        "  - {name: q, model: vex70, x: 100 mm, thrust: +x}\n"
        "  - {name: r, model: vex70, x: 300 mm, thrust: -x}\n"
        "  sleeves: []\n"
        "  shortening: null\n"
        "  growth.static: 1 um\n"
        "speeds: [0 rpm]\n"
        "analyses: {preload: {}}\n"
        "compare: {more: {override: {growth.static: 5 um}}}\n"
    )
    more = rotordyn.load(path).variants["more"].spindle
    assert more is not None
    assert [seat.growth.static for seat in more.seats] == [5e-6, 5e-6]


def test_a_variant_adds_overrides_and_conditions_and_replaces_machines(tmp_path: Path) -> None:
    case = load(
        tmp_path,
        "  as_it_is: {}\n"
        "  changed:\n"
        "    title: softer and rigid\n"
        "    override: {sleeves.front.spring.stiffness: 3 N/um}\n"
        "    conditions: {rotor: rigid}\n",
    )
    assert list(case.variants) == ["as_it_is", "changed"]
    first, second = case.variants.values()
    assert first.title == "as it is"
    assert (first.spindle, first.conditions) == (case.spindle, case.conditions)
    assert second.title == "softer and rigid"
    assert second.conditions.rotor == "rigid"
    assert second.conditions.kinematics == "outer"
    assert second.spindle is not None
    front = second.spindle.sleeves[0]
    assert front.spring.stiffness == pytest.approx(3e6)
    assert front.stop_travel == pytest.approx(45e-6)
    assert second.speeds == case.speeds
    assert second.analyses == case.analyses
    assert not second.variants


def test_conditions_of_a_variant_are_laid_over_those_of_the_case(tmp_path: Path) -> None:
    """Key by key at any depth; lists and values of overrides are whole."""
    text = CASE.format(
        compare="  warmer: {conditions: {temperatures: {shaft: 35 degC, bearings: {a: {inner_ring: "
        "41 degC}}}}}\n"
        "  cold: {conditions: {temperatures: null}}\n"
        "  other: {override: {sleeves.front.spring: {preload: 500 N, stiffness: rigid}}}\n"
    ).replace(
        "  kinematics: outer\n",
        "  kinematics: outer\n"
        "  temperatures: {shaft: 30 degC, housing: 31 degC, bearings: {a: {inner_ring: 38 degC, "
        "outer_ring: 32 degC}}}\n",
    )
    (tmp_path / "compared.yaml").write_text(text, encoding="utf-8")
    case = rotordyn.load(tmp_path / "compared.yaml")
    warmer, cold = (case.variants[name].conditions for name in ("warmer", "cold"))
    base = case.conditions.temperatures
    assert base is not None
    assert warmer.temperatures is not None
    assert warmer.kinematics == "outer"
    assert (warmer.temperatures.shaft, base.shaft) == (35.0, 30.0)
    assert warmer.temperatures.housing == base.housing
    assert warmer.temperatures.bearings["a"].inner_ring == 41.0
    assert warmer.temperatures.bearings["a"].outer_ring == base.bearings["a"].outer_ring
    assert cold.temperatures is None
    spindle = case.variants["other"].spindle
    assert spindle is not None
    assert spindle.sleeves[0].spring == Spring(500.0)


def test_conditions_of_a_variant_are_complete_with_those_of_the_case(tmp_path: Path) -> None:
    """``oil`` and others must be given, by the case or by the variant."""
    given = "inner_shaft: 3 W/K, outer_housing: 6 W/K, shaft: 30 degC, housing: 25 degC, lubricant:"
    given += " {viscosity_40: 32 mm^2/s, viscosity_100: 5 mm^2/s, temperature: 50 degC}"
    hot = "  hot: {conditions: {heat_flow: {shaft: 60 degC, lubricant: {temperature: 60 degC}}}}"
    text, file = CASE.format(compare=hot), tmp_path / "compared.yaml"
    whole = f"  kinematics: outer\n  heat_flow: {{oil: 28 degC, {given}}}\n"
    file.write_text(text.replace("  kinematics: outer\n", whole), encoding="utf-8")
    case = rotordyn.load(file)
    flow, of_variant = case.conditions.heat_flow, case.variants["hot"].conditions.heat_flow
    assert flow is not None
    assert of_variant is not None
    assert (flow.shaft, of_variant.shaft, of_variant.lubricant.temperature) == (30.0, 60.0, 60.0)
    assert of_variant.oil == flow.oil == 28.0
    file.write_text(text, encoding="utf-8")
    with pytest.raises(
        InvalidInput, match=r"compare\.hot\.conditions\.heat_flow\.oil: missing key"
    ):
        rotordyn.load(file)


@pytest.mark.parametrize("variant", ["5", "[conditions]", "{conditions: 5}"])
def test_a_variant_of_a_wrong_shape_is_a_fault(variant: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="wrong shape"):
        load(tmp_path, f"  odd: {variant}\n")


def test_only_references_of_the_conditions_in_force_are_compared(tmp_path: Path) -> None:
    case = load(tmp_path, "  rigid: {conditions: {rotor: rigid}}\n  flexible: {}\n")
    rigid, flexible = case.variants.values()
    known = {name: {r.values for r in v.known} for name, v in case.variants.items()}
    assert rigid.references == flexible.references
    assert (1096.0, 1512.0) in known["rigid"] - known["flexible"]
    assert (903.0, 1350.0, 1580.0, 2860.0) in known["flexible"] - known["rigid"]


@pytest.mark.parametrize(
    ("compare", "line", "words"),
    [
        ("  one:\n    conditions: {rotor: soft}\n", 13, "allowed: flexible, rigid"),
        ("  one:\n    override:\n      sleeves.middle.stop_travel: 1 um\n", 14, "front, rear"),
        ("  one:\n    speeds: [0 rpm]\n", 13, "unknown key"),
        ("  one:\n    tool: nothing\n", 13, "unknown model"),
        ("  'not a name!': {}\n", 12, "not a name"),
        ("  one:\n    override: {damping: 1 %}\n", 13, "wrong shape: given '1 %'"),
        ("  one: {}\n  two:\n    override: {shaft.start: 5 m}\n", 14, "shaft"),
    ],
)
def test_a_fault_of_a_variant_is_at_its_line(
    tmp_path: Path, compare: str, line: int, words: str
) -> None:
    with pytest.raises(InvalidInput) as caught:
        load(tmp_path, compare)
    assert any(fault.line == line and words in str(fault) for fault in caught.value.faults), str(
        caught.value
    )


def test_what_a_variant_says_comes_after_what_the_case_says(tmp_path: Path) -> None:
    """A whole spring in the variant is not changed by a part of it in the case."""
    path = tmp_path / "compared.yaml"
    own = "  sleeves.front.spring: {preload: 1 N, stiffness: 1 N/um}\n"
    part = "  sleeves.front.spring.preload: 2 N\n"
    text = CASE.format(compare="  one:\n    override:\n    " + own.replace("1 N", "9 N"))
    path.write_text(text.replace("override:\n", "override:\n" + own + part, 1), encoding="utf-8")
    case = rotordyn.load(path)
    springs = [c.spindle.sleeves[0].spring for c in (case, *case.variants.values()) if c.spindle]
    assert [spring.preload for spring in springs] == [2.0, 9.0]


def test_a_fault_outside_its_entry_names_the_variant(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput) as caught:
        load(tmp_path, "  fine: {}\n  short: {override: {shaft.sections.tail.length: 1 mm}}\n")
    (fault,) = caught.value.faults
    assert fault.file.endswith("mfw2310.yaml")
    assert fault.message.startswith("variant short: ")


def test_a_bearing_in_a_variant_of_a_spindle_is_a_fault_of_the_variant(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput) as caught:
        load(tmp_path, "  one: {}\n  two:\n    bearing: vex70\n")
    places = {fault.path: fault for fault in caught.value.faults}
    assert "given both" in places["compare.two.bearing"].message


@pytest.mark.parametrize("title", ["''", "' '"])
def test_a_blank_title_is_the_name(tmp_path: Path, title: str) -> None:
    case = load(tmp_path, f"  one_more: {{title: {title}}}\n  two: {{title: whole}}\n")
    assert [v.title for v in case.variants.values()] == ["one more", "whole"]


def test_faults_of_the_case_itself_are_reported_once(tmp_path: Path) -> None:
    path = tmp_path / "compared.yaml"
    text = CASE.format(compare="  one: {}\n  two: {}\n").replace("outer", "outermost")
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInput) as caught:
        rotordyn.load(path)
    assert len(caught.value.faults) == 1


TOOLS = """\
title: several tools
spindle: mfw2310
tools: {tools}
conditions: {{kinematics: outer}}
speeds: [0 rpm, 24000 rpm]
analyses:
  frf:
    frequencies: {{from: 100 Hz, to: 1000 Hz, step: 100 Hz}}
    pairs: [{{response: tip.y, excitation: tip.y}}]
"""


def test_tools_are_variants_that_share_the_bearings(tmp_path: Path) -> None:
    """Each gives what it gives alone; bearings are solved with the first of them."""
    path = tmp_path / "tools.yaml"
    path.write_text(TOOLS.format(tools="[hsk63_end_mill_16, hsk63_end_mill_20]"), encoding="utf-8")
    case = rotordyn.load(path)
    solved = solve_variants(case).machines
    assert list(solved) == ["hsk63_end_mill_16", "hsk63_end_mill_20"]
    assert ["unloaded" in answers.seconds for answers in solved.values()] == [True, False]
    for name, answers in solved.items():
        path.write_text(TOOLS.format(tools=f"[{name}]"), encoding="utf-8")
        alone = solve_variants(rotordyn.load(path)).machines[name].results["frf"]
        np.testing.assert_allclose(answers.results["frf"].response, alone.response, rtol=1e-9)


def test_tools_bear_their_titles(tmp_path: Path) -> None:
    path = tmp_path / "tools.yaml"
    flutes = "sections: [{length: 50 mm, outer_diameter: 16 mm, material: tool_steel}]"
    for name, title in (("a", "title: Short\n"), ("b", "title: Short\n"), ("c_d", "")):
        own = title + flutes + "\npoints: {tip: -50 mm}\n"
        (tmp_path / f"{name}.yaml").write_text(own, encoding="utf-8")
    path.write_text(TOOLS.format(tools="[./a.yaml, ./b.yaml, ./c_d.yaml]"), encoding="utf-8")
    titles = [variant.title for variant in rotordyn.load(path).variants.values()]
    assert titles == ["Short", "Short, b", "c d"]


@pytest.mark.parametrize(
    ("tools", "sentence"),
    [
        ("[]", "not a list of tools"),
        ("hsk63_end_mill_16", "not a list of tools"),
        ("[hsk63_end_mill_16, hsk63_end_mill_16]", "tool given twice"),
        ("[hsk63_end_mill_16, hsk63_end_mill_99]", "unknown model: given 'hsk63_end_mill_99'"),
        ("[hsk63_end_mill_16]\ntool: mfw2310_exciter", "given beside tools"),
    ],
)
def test_faults_of_tools(tmp_path: Path, tools: str, sentence: str) -> None:
    path = tmp_path / "tools.yaml"
    path.write_text(TOOLS.format(tools=tools), encoding="utf-8")
    with pytest.raises(InvalidInput, match=sentence):
        rotordyn.load(path)


def test_references_replaced_by_a_variant_leave_with_those_of_the_tool() -> None:
    """Published values are those of the spindle on ground, its tool's included."""
    whole = rotordyn.load("spindle_on_housing")
    assert len(whole.variants["wall"].references) > 20
    assert whole.variants["body"].references == whole.variants["elastic"].references == ()
