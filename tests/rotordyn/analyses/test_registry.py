"""Records of the analyses: complete, apart, and open to packages outside."""

from __future__ import annotations

import tomllib
from dataclasses import fields, replace
from importlib import import_module
from pathlib import Path

import pytest

import rotordyn
from rotordyn import analyses
from rotordyn.analyses import registry
from rotordyn.analyses.contract import Code
from rotordyn.case.schema import json_schema
from rotordyn.errors import InvalidInput
from rotordyn.job import deliver

ROOT = Path(__file__).resolve().parents[3]
OUTSIDE = Path(__file__).with_name("outside")


@pytest.fixture
def outside(monkeypatch: pytest.MonkeyPatch):
    """A distribution beside this file with an analysis of its own."""
    monkeypatch.syspath_prepend(OUTSIDE)
    registry._outside.cache_clear()
    yield import_module("nose_sag")
    registry._outside.cache_clear()
    registry.analysis.cache_clear()


@pytest.mark.parametrize("name", registry.built_in())
def test_the_code_that_a_record_names_is_there(name: str) -> None:
    record = registry.analysis(name)
    named = [getattr(record, field.name) for field in fields(record)]
    codes = [code for code in named if isinstance(code, Code)]
    assert len(codes) >= 4
    for code in codes:
        module, _, function = code.path.partition(":")
        assert callable(getattr(import_module(f"{code.package}.{module}"), function))


def test_analyses_are_kept_apart() -> None:
    """The contract holds every folder, and none is among the files that all may import."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (contract,) = (
        each
        for each in contracts["tool"]["importlinter"]["contracts"]
        if each["type"] == "independence"
    )
    assert contract["modules"] == ["rotordyn.analyses.*"]
    shared = {line.rpartition(".")[2] for line in contract["ignore_imports"]}
    assert not shared & {*registry.built_in()}


def test_the_spec_of_every_analysis_has_one_door() -> None:
    for name in registry.built_in():
        spec = registry.analysis(name).spec
        assert getattr(analyses, spec.__name__) is spec
    with pytest.raises(AttributeError, match="no attribute 'NoSpec'"):
        _ = analyses.NoSpec


def test_an_unknown_analysis_is_named() -> None:
    with pytest.raises(InvalidInput, match=r"unknown analysis: campbel; .*did you mean campbell"):
        registry.analysis("campbel")


def test_a_package_outside_has_an_analysis_of_its_own(outside, tmp_path: Path) -> None:
    """Its result, its table, its figure and its line of the summary, and nothing of ours for it."""
    case = replace(rotordyn.load("lalanne_ferraris"), analyses={"nose_sag": outside.NoseSagSpec()})
    assert registry.names()[-1] == "nose_sag"
    file = tmp_path / "case.yaml"
    file.write_text("spindle: lalanne_ferraris\nspeeds: [0 rpm]\nanalyses: {nose_sag: }\n")
    assert rotordyn.load(file).analyses == case.analyses
    asked = json_schema("case")["properties"]["analyses"]["properties"]
    assert asked["nose_sag"]["description"] == "It takes nothing."
    assert rotordyn.run(case)["nose_sag"].rotor_mass.values > 0.0
    found = deliver(case, tmp_path / "out")
    assert "nose sag   a rotor of" in found.summary
    made = {path.name for path in found.folder.iterdir()}
    assert {"nose_sag.csv", "nose_sag.png", "results.nc"} <= made
