"""Records of the analyses: complete, apart, and open to packages outside."""

from __future__ import annotations

import sys
import tomllib
import warnings
from dataclasses import fields, replace
from importlib import import_module
from pathlib import Path

import pytest

import rotordyn
from rotordyn import analyses
from rotordyn.analyses import registry
from rotordyn.analyses.contract import Code
from rotordyn.case.schema import json_schema
from rotordyn.cli import main
from rotordyn.errors import InvalidInput
from rotordyn.job import deliver

ROOT = Path(__file__).resolve().parents[3]
OUTSIDE = Path(__file__).with_name("outside")
METADATA = "Metadata-Version: 2.1\nName: torn-package\nVersion: 1.0\n"
ENTRY = "[rotordyn.analyses]\ntorn = torn_module:ANALYSIS\n"
TORN = {
    "raise RuntimeError('boom')": "RuntimeError: boom",
    "raise SystemExit(3)": "SystemExit: 3",
    "": "AttributeError",
    "ANALYSIS = 3": "torn_module:ANALYSIS is not an Analysis named torn",
    "from rotordyn.analyses.campbell import ANALYSIS": "is not an Analysis named torn",
    "import no_such_module": "No module named 'no_such_module'",
    None: "No module named 'torn_module'",
}


@pytest.fixture
def outside(monkeypatch: pytest.MonkeyPatch):
    """A distribution beside this file with an analysis of its own."""
    monkeypatch.syspath_prepend(OUTSIDE)
    forget_those_outside()
    yield import_module("nose_sag")
    forget_those_outside()


@pytest.fixture
def offered(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    """Writes a distribution with an entry point to a module of that text, or to none."""

    def offer(text: str | None) -> None:
        folder = tmp_path / "site"
        (folder / "torn-1.0.dist-info").mkdir(parents=True)
        words = {"METADATA": METADATA, "entry_points.txt": ENTRY}
        for name, content in words.items():
            (folder / "torn-1.0.dist-info" / name).write_text(content)
        if text is not None:
            (folder / "torn_module.py").write_text(text)
        monkeypatch.syspath_prepend(folder)
        forget_those_outside()

    yield offer
    sys.modules.pop("torn_module", None)
    forget_those_outside()


def forget_those_outside() -> None:
    for each in (registry._external, registry.names, registry.analysis):
        each.cache_clear()


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


def test_the_heading_of_a_comparison_names_no_point_that_the_case_may_not_have() -> None:
    """The point of a sag may be that of a tool."""
    assert registry.analysis("static_sag").heading == "sag and runout"


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


@pytest.mark.parametrize(("text", "why"), TORN.items(), ids=str)
def test_what_a_package_outside_offers_may_be_torn(
    text: str | None, why: str, offered, tmp_path: Path
) -> None:
    """A run that does not ask for it has its results; one that does names the package."""
    offered(text)
    file = tmp_path / "case.yaml"
    file.write_text("spindle: lalanne_ferraris\nspeeds: [0 rpm]\nanalyses: {campbell: }\n")
    case = rotordyn.load(file)
    with pytest.warns(RuntimeWarning, match="torn of the package torn-package cannot") as warned:
        found = deliver(case, tmp_path / "out", figures=False)
    assert len(warned) == 1
    assert why in str(warned[0].message)
    assert rotordyn.open(found.folder)
    assert "torn" not in registry.names()
    file.write_text("spindle: lalanne_ferraris\nspeeds: [0 rpm]\nanalyses: {torn: }\n")
    with pytest.raises(InvalidInput, match="package torn-package cannot be loaded") as caught:
        rotordyn.load(file)
    assert why in str(caught.value)


def test_a_torn_package_outside_is_one_line_of_the_command_line(
    offered, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    offered("raise RuntimeError('boom')")
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        assert main(["schema"]) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("warning: the analysis torn of the package torn-package cannot be")
