"""Mode shapes in space as a run leaves them, with OpenGL and without."""

from __future__ import annotations

import json
import re
import signal
from dataclasses import replace
from pathlib import Path

import pytest

import rotordyn
from docs.generate.places import THEORY
from rotordyn.analyses.campbell import in_space
from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
from rotordyn.case.case import Case
from rotordyn.cli import main
from rotordyn.job import deliver
from rotordyn.view import apart
from tests.oracles.spindles import RPM

CRASH = ("-c", f"import os; os.kill(os.getpid(), {signal.SIGSEGV.value})")
FILE = """
spindle: lalanne_ferraris
speeds: [0 rpm, 9000 rpm]
analyses:
  campbell:
    max_frequency: 62 Hz
    shapes_3d:
"""


def small(**wishes: object) -> Case:
    """A rotor with few modes."""
    spec = CampbellSpec(62.0, shapes_3d=ShapesInSpaceSpec(**wishes))
    case = rotordyn.load("lalanne_ferraris")
    return replace(case, speeds=(0.0, 9000.0 * RPM), analyses={"campbell": spec})


def names(folder: Path) -> set[str]:
    return {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.long
def test_a_run_leaves_sheets_animations_and_meshes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(in_space, "FRAMES", 3)
    found = deliver(small(animation=True, files=("vtu",)), tmp_path / "out")
    made, record = names(found.folder), json.loads((found.folder / "run.json").read_text())
    assert set(record["files"]) == made
    if "shapes_3d_0rpm" in record["skipped"]:
        pytest.skip(record["skipped"]["shapes_3d_0rpm"])
    for sheet in ("shapes_3d_0rpm", "shapes_3d_9000rpm"):
        assert f"{sheet}.png" in made
        assert record["figures"][sheet] > 0.0
    inside = {name for name in made if name.startswith("shapes_3d/")}
    modes = ("bending_1_0rpm", "bending_1_9000rpm")
    assert inside == {f"shapes_3d/{mode}.{end}" for mode in modes for end in ("gif", "vtu")}
    assert record["notes"] == []


def test_without_opengl_everything_else_is_there_and_one_sentence_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(apart, "PROGRAM", CRASH)
    case = tmp_path / "small.yaml"
    case.write_text(FILE + "      files: [glb]\n", encoding="utf-8")
    assert main(["run", str(case), "-o", str(tmp_path / "out")]) == 0
    made = names(tmp_path / "out")
    assert {"results.nc", "campbell.png", "mode_shapes.png", "summary.txt"} <= made
    assert any(name.endswith(".glb") for name in made)
    assert not any(name.startswith("shapes_3d_") for name in made)
    printed = " ".join(capsys.readouterr().out.split())
    sentence = (
        "note figures shapes_3d_0rpm, shapes_3d_9000rpm omitted: this computer cannot render in 3D "
        "(OpenGL ended the process: SIGSEGV): install Mesa's EGL"
    )
    assert sentence in printed
    record = json.loads((tmp_path / "out" / "run.json").read_text())
    assert "SIGSEGV" in record["skipped"]["shapes_3d_9000rpm"]
    assert len(record["notes"]) == 1


def test_variants_have_their_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "PROGRAM", CRASH)
    case = small(files=("off",))
    both = replace(case, variants={"one": case, "other": replace(case, title="another")})
    made = names(deliver(both, tmp_path / "out").folder)
    meshes = {name for name in made if name.endswith(".off")}
    assert {name.split("/")[0] for name in meshes} == {"one", "other"}
    record = json.loads((tmp_path / "out" / "run.json").read_text())
    assert {"one/shapes_3d_0rpm", "other/shapes_3d_9000rpm"} <= set(record["skipped"])


def test_nothing_is_rendered_unasked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "PROGRAM", ("-c", "raise SystemExit(1)"))
    case = replace(small(), analyses={"campbell": CampbellSpec(62.0)})
    found = deliver(case, tmp_path / "out")
    assert json.loads((found.folder / "run.json").read_text())["notes"] == []


def test_no_mode_no_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "PROGRAM", ("-c", "raise SystemExit(1)"))
    spec = CampbellSpec(1.0, shapes_3d=ShapesInSpaceSpec(files=("stl",)))
    found = deliver(replace(small(), analyses={"campbell": spec}), tmp_path / "out")
    assert json.loads((found.folder / "run.json").read_text())["notes"] == []


@pytest.mark.long
def test_python_of_the_page_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    page = (THEORY / "shapes.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    exec(compile(code, "shapes.md", "exec"), {})
    assert re.search(r"1200, 3\)|omitted|cannot render", capsys.readouterr().out)
    assert [path.name for path in tmp_path.iterdir()] == ["first.glb"]


def test_shapes_in_space_need_shapes() -> None:
    with pytest.raises(rotordyn.InvalidInput, match="shapes_3d: needs the shapes"):
        CampbellSpec(shapes=False, shapes_3d=ShapesInSpaceSpec())
    with pytest.raises(rotordyn.InvalidInput, match=r"files\.2: repeated: given 'vtu'"):
        ShapesInSpaceSpec(files=("vtu", "vtu"))
