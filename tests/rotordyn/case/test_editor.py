"""The JSON Schema of files, held against an independent validator."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from rotordyn import units
from rotordyn.case.document import read_document
from rotordyn.case.faults import Faults
from rotordyn.case.schema import FILES, json_schema
from rotordyn.errors import InvalidInput
from tests.oracles.spindles import CASES, ROOT

BROKEN = ROOT / "tests" / "cases" / "broken"
# How a fault begins that lies in the form of one value or key, not in what it means elsewhere.
OF_FORM = (
    "unknown key|missing key|wrong shape|not one of its choices|not a whole number|not a name|"
    "not text|not a place|unknown direction|unit missing|unknown unit|'.*' is not a unit|"
    "unknown model"
)


def is_of_form(line: str) -> bool:
    """An ``# expect:`` line is about the form of a key of the case itself, not of an override."""
    match = re.match(rf"# expect: \d+: ([a-z]+)\S*: (?:{OF_FORM})", line)
    return match is not None and match[1] in json_schema("case")["properties"].keys() - {"override"}


@cache
def validator(file: str) -> Draft202012Validator:
    return Draft202012Validator(json_schema(file))


def held(path: Path) -> Any:
    """What a file holds; None where it is no YAML that we read."""
    faults = Faults()
    root = read_document(path, faults, {})
    return None if root is None or faults else root.plain()


def errors(file: str, path: Path) -> list[str]:
    return [error.message for error in validator(file).iter_errors(held(path))]


@pytest.mark.parametrize("file", FILES)
def test_schema_is_a_schema(file: str) -> None:
    schema = json_schema(file)
    Draft202012Validator.check_schema(schema)
    assert schema["$schema"].endswith("2020-12/schema")
    assert json.loads(json.dumps(schema, allow_nan=False)) == schema


@pytest.mark.parametrize("path", sorted(CASES.glob("*.yaml")), ids=lambda p: p.stem)
def test_every_case_is_valid(path: Path) -> None:
    assert errors("case", path) == []


def test_responses_along_engine_orders_alone_are_valid(tmp_path: Path) -> None:
    text = (CASES / "mfw1709.yaml").read_text(encoding="utf-8").partition("analyses:")[0]
    asked = "analyses:\n  frf:\n    pairs: [{response: a.y, excitation: a.y}]\n"
    path = tmp_path / "case.yaml"
    path.write_text(f"{text}{asked}    engine_orders: [1]\n")
    assert errors("case", path) == []
    path.write_text(f"{text}{asked}")
    assert errors("case", path)


@pytest.mark.parametrize("kind", ["spindle", "tool", "bearing", "material"])
def test_every_model_is_valid_as_itself_alone(kind: str) -> None:
    for path in (ROOT / "models" / f"{kind}s").glob("*.yaml"):
        assert errors(kind, path) == []
        assert errors("case", path)


@pytest.mark.parametrize("path", sorted(BROKEN.glob("*.yaml")), ids=lambda p: p.stem)
def test_broken_case_is_rejected_where_its_form_is_wrong(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    if held(path) is not None and any(map(is_of_form, lines)):
        assert errors("case", path)


def test_many_broken_cases_are_rejected() -> None:
    rejected = {p.stem for p in BROKEN.glob("*.yaml") if held(p) is not None and errors("case", p)}
    assert {
        "unknown_key",
        "missing_key",
        "unit_wrong",
        "shapes",
        "choices",
        "two_machines",
    } <= rejected


def properties(shape: Any) -> list[tuple[str, dict[str, Any]]]:
    """Every key of every mapping in a schema, with its shape."""
    if isinstance(shape, list):
        return [found for part in shape for found in properties(part)]
    if not isinstance(shape, dict):
        return []
    own = shape.get("properties", {})
    found = list(own.items()) if isinstance(own, dict) else []
    return found + [p for part in shape.values() for p in properties(part)]


def test_every_key_has_its_meaning_and_no_default_in_bare_si() -> None:
    found = properties(json_schema("case"))
    assert len(found) > 100
    for key, shape in found:
        assert shape["description"], key
        assert not re.search(r"[`\[\]]|\]\(", shape["description"]), key
    said = dict(properties(json_schema("spindle")))
    assert said["stop_travel"]["default"] == "none"
    assert said["stop_travel"]["description"].startswith("travel against the spring")
    assert "from 0 um up to 100 mm, or none; units: m, mm, um" in said["stop_travel"]["description"]
    assert said["polar_inertia"]["default"] == "0 kg m^2"


@pytest.mark.parametrize(
    ("change", "valid"),
    [
        ({"spindle": "./mine.yaml"}, True),
        ({"spindle": "mfw2301"}, False),
        ({"spindle": None}, False),
        ({"spindle": {"shaft": {}}}, False),
        ({"speeds": ["0 rpm", "24_000 rpm"]}, False),
        ({"speeds": ["0 rpm", 24000]}, False),
        ({"speeds": ["-1 rpm"]}, False),
        ({"speeds": ["0 rpm", "2513 rad/s", "4 1/min", "5 min^-1"]}, True),
        ({"speeds": ["2513 rad s⁻¹", "2513 rad s^-1", "5 min⁻¹", "1 000 rpm"]}, True),
        ({"speeds": ["1 0000 rpm"]}, False),
        ({"conditions": {"element_length": "5 µm"}}, True),
        ({"conditions": {"element_length": "0.0 µm"}}, False),
        ({"conditions": {"element_length": "0.05 mm"}}, True),
        ({"speeds": ["0 1/min"]}, True),
        ({"conditions": {"element_length": "5 Hz"}}, False),
        ({"conditions": {"rotor": "stiff"}}, False),
        ({"analyses": {"preload": None}}, True),
        ({"analyses": {}}, False),
        ({"analyses": {"campbell": {"teeth": [0]}}}, False),
        ({"analyses": {"campbell": {"engine_orders": [0.43, 1, 2.37]}}}, True),
        ({"analyses": {"campbell": {"engine_orders": [0]}}}, False),
        ({"analyses": {"stiffness": {"point": "P", "second_stop": {"3": "1 um"}}}}, False),
        ({"analysis": {}}, False),
        ({"override": {"any.path": [1, "x"]}}, True),
        ({"conditions": {"heat_flow": {"shaft": "60 degC"}}}, False),
        ({"compare": {"hot": {"conditions": {"heat_flow": {"shaft": "60 degC"}}}}}, True),
        ({"compare": {"hot": {"conditions": {"heat_flow": {"shaft": "60 mm"}}}}}, False),
        ({"compare": {"cold": {"conditions": {"heat_flow": None, "films": None}}}}, True),
    ],
)
def test_single_changes(change: dict[str, Any], valid: bool) -> None:
    assert validator("case").is_valid({**held(CASES / "mfw2310.yaml"), **change}) == valid


def test_unknown_kind_of_file() -> None:
    with pytest.raises(InvalidInput, match=r"allowed: case, spindle, .*did you mean tool\?"):
        json_schema("tol")


@pytest.mark.few(10)
@pytest.mark.parametrize("kind", units.KINDS)
@settings(max_examples=25)
@given(data=st.data())
def test_every_unit_that_an_editor_lets_pass_is_read(kind: str, data: st.DataObject) -> None:
    text = data.draw(st.from_regex(rf"\A(?:{units.pattern(kind)})\Z"))
    if text or "" in units.KINDS[kind]:
        assert units.parse(f"2 {text}", kind) > 0.0


@pytest.mark.parametrize("kind", units.KINDS)
def test_every_unit_that_a_message_offers_passes_the_editor(kind: str) -> None:
    for unit in units.KINDS[kind]:
        assert re.fullmatch(units.pattern(kind), unit)
        assert re.fullmatch(units.pattern(kind), units.pretty_unit(unit))
        assert re.fullmatch(units.pattern(kind), units.pretty_unit(unit).replace("deg", "°"))
