"""Models and cases that come with rotordyn, by name, by path, as lists and as descriptions."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

import rotordyn
from bearings import BallBearing, Material
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.case import library
from rotordyn.machine import Spindle, Tool
from tests.oracles.spindles import CASES, ROOT

KIND_OF = {
    "bearings": BallBearing,
    "materials": Material,
    "spindles": Spindle,
    "tools": Tool,
    "workpieces": Workpiece,
}


@pytest.mark.parametrize("shipped", rotordyn.models(), ids=lambda m: f"{m.kind}-{m.name}")
def test_every_model_is_a_description_with_title_and_source(shipped: Any) -> None:
    assert isinstance(rotordyn.model(shipped.kind, shipped.name), KIND_OF[shipped.kind])
    assert shipped.title
    assert shipped.sources
    assert all(source and "\n" not in source for source in shipped.sources)


def test_lists_are_those_of_the_folders() -> None:
    listed = {(model.kind, model.name) for model in rotordyn.models()}
    files = (ROOT / "models").glob("*/*.yaml")
    assert listed == {(path.parent.name, path.stem) for path in files}
    assert {m.name for m in rotordyn.models("tools")} > {"mfw2310_exciter"}
    assert {c.name for c in rotordyn.cases()} == {path.stem for path in CASES.glob("*.yaml")}
    assert all(c.title for c in rotordyn.cases())


def test_spindle_and_tool_make_the_machine_of_the_case() -> None:
    spindle = rotordyn.model("spindles", "mfw2310")
    assert (
        spindle.with_tool(rotordyn.model("tools", "mfw2310_exciter"))
        == rotordyn.load(CASES / "mfw2310.yaml").spindle
    )


def test_model_from_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (ROOT / "models/bearings/vex70.yaml").read_text(encoding="utf-8")
    (tmp_path / "own.yaml").write_text(text.replace("balls: 25", "balls: 20"), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for reference in ("own.yaml", "./own.yaml", tmp_path / "own.yaml"):
        assert rotordyn.model("bearings", reference).balls == 20


@pytest.mark.parametrize(
    ("kind", "reference", "said"),
    [
        ("spindle", "mfw2310", "unknown kind of model: 'spindle'.*did you mean spindles"),
        (None, "mfw2310", "unknown kind of model: None"),
        ("spindles", "mfw2301", "unknown model: given 'mfw2301'.*did you mean mfw2310"),
        ("spindles", None, "called by its name or path: got None"),
        ("spindles", "none.yaml", "no such file"),
        ("materials", ROOT / "models/bearings/vex60.yaml", "missing key"),
        ("bearings", ROOT / "models", "unknown model|is a directory"),
    ],
)
def test_what_is_no_model_is_refused(kind: Any, reference: Any, said: str) -> None:
    with pytest.raises(rotordyn.InvalidInput, match=said):
        rotordyn.model(kind, reference)


def test_case_by_name_unless_there_is_such_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert rotordyn.load("mfw2310") == rotordyn.load(CASES / "mfw2310.yaml")
    (tmp_path / "mfw2310").mkdir()
    assert rotordyn.load("mfw2310") == rotordyn.load(CASES / "mfw2310.yaml")
    shutil.copy(CASES / "vex70.yaml", tmp_path / "lalanne_ferraris")
    assert rotordyn.load("lalanne_ferraris").bearing is not None


@pytest.mark.parametrize("name", ["mfw231", "mfw2310 ", "MFW2310", "unheard_of", "two words"])
def test_name_of_no_case(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(rotordyn.InvalidInput, match="no case of that name") as refused:
        rotordyn.load(name)
    (fault,) = refused.value.faults
    first = ", ".join(case.name for case in rotordyn.cases()[:24])
    assert f"allowed: {first}, …, or the path of a file" in fault.message
    hint = "did you mean mfw2310?" if "mfw" in name.lower() else "rotordyn cases lists all names"
    assert hint in fault.message


def test_cases_lie_beside_the_models() -> None:
    assert library.cases_root() == CASES
