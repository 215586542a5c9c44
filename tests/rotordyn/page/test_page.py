"""What the page of a run or a study says, and folders of which there is none."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from html import unescape
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn import cli
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.results.display import RPM
from tests.rotordyn.page.conftest import array, evil, held

CASES = (
    "grinding_spindle_life",
    "friswell_unbalance",
    "vex70",
    "mfw2310_tangents",
    "preload_concepts",
)


def words(text: str) -> str:
    """What is read on a page."""
    body = text.partition("<main>")[2].partition("</main>")[0]
    return unescape(" ".join(re.sub(r"<[^>]+>", " ", body).split()))


def test_the_page_opens_with_the_verdict_and_tells_all(evil_folder: Path) -> None:
    text = (evil_folder / "report.html").read_text(encoding="utf-8")
    results = rotordyn.open(evil_folder)
    headings = re.findall(r"<h2[^>]*>(.*?)</h2>", text)
    assert headings[:4] == ["Verdict", "Machine", "Inputs", "Bearings"]
    assert headings[-1] == "Accuracy and origin"
    read = words(text)
    for sentence in (*results.warnings, *results.notes):
        assert " ".join(sentence.split()) in read
    assert f"{len(results.warnings) or 'No'} warning" in text
    assert results.case.digest in read
    assert rotordyn.__version__ in read
    for file, (title, *_) in results.case.sources.items():
        assert file in read
        assert title in read


def test_a_title_is_text(evil_folder: Path) -> None:
    text = (evil_folder / "report.html").read_text(encoding="utf-8")
    assert "<script>document.title" not in text
    assert "<img" not in text
    assert "&lt;script&gt;document.title" in text


def test_responses_are_those_of_the_result(flagship: Path) -> None:
    """Every peak is among the points of its curve, with its height, and so is the grid."""
    content, numbers = held(flagship.read_text(encoding="utf-8"))
    chart = next(c for c in content.values() if len(c["controls"]) == 2 and c["kind"] == "chart")
    x, y = (array(chart["traces"][0]["moving"][key], numbers) for key in ("x", "y"))
    frf = rotordyn.open(flagship.parent)["frf"]
    assert [len(each["options"]) for each in chart["controls"]] == list(x.shape[:2])
    for pair, speed in ((0, 0), (1, 20), (2, 48)):
        peaks = frf["peak_frequency"].values[speed, pair]
        sizes = np.abs(frf["peak_value"].values[speed, pair]) * 1e6
        for hertz, size in zip(peaks[np.isfinite(peaks)], sizes[np.isfinite(peaks)], strict=True):
            at = int(np.nanargmin(np.abs(x[pair, speed] - hertz)))
            assert x[pair, speed, at] == pytest.approx(hertz, rel=1e-6)
            assert y[pair, speed, at] == pytest.approx(size, rel=1e-4)
        grid = frf["frequency"].values
        known = np.isfinite(x[pair, speed])
        ours = np.interp(x[pair, speed, known], grid, np.abs(frf["receptance"].values[speed, pair]))
        assert y[pair, speed, known] == pytest.approx(ours * 1e6, rel=0.02)


def test_the_campbell_diagram_and_its_criticals_are_those_of_the_result(flagship: Path) -> None:
    content, numbers = held(flagship.read_text(encoding="utf-8"))
    campbell = rotordyn.open(flagship.parent)["campbell"]
    traces = {t.get("name"): t for c in content.values() for t in c.get("traces", ())}
    mode = traces["bending 1 forward"]
    k = list(campbell["mode"].values).index("bending 1 forward")
    drawn = array(mode["x"], numbers), array(mode["y"], numbers)
    ours = campbell["speed_rpm"].values, campbell["frequency"].values[:, k]
    for found, wanted in zip(drawn, ours, strict=True):
        assert found[np.isfinite(drawn[1])] == pytest.approx(wanted, rel=1e-6)


def test_bearings_stand_in_one_table(evil_folder: Path) -> None:
    text = (evil_folder / "report.html").read_text(encoding="utf-8")
    section = text.split(">Bearings</h2>")[1].split("</section>")[0]
    assert section.count("<table>") == 1
    for head in ("model", "axial load [N]", "peak pressure [GPa]", "n·dm [mm/min]"):
        assert head in section
    result = rotordyn.open(evil_folder)["preload"]
    ends = " → ".join(f"{result['axial_load'].values[k, 0]:.0f}" for k in (0, -1))
    assert ends in section


@pytest.mark.parametrize("name", CASES)
def test_every_kind_of_case_has_a_page(name: str, tmp_path: Path) -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    case = rotordyn.load(name)
    speeds = case.speeds[:: max(1, len(case.speeds) // 4)]
    with unchecked():
        case = replace(case, speeds=speeds)
        few = {n: replace(each, speeds=speeds) for n, each in case.variants.items()}
    results = rotordyn.run(replace(case, variants=few))
    text = results.report(tmp_path / "page.html").read_text(encoding="utf-8")
    read = words(text)
    for part in results.parts.values():
        assert not case.variants or part.case.title in read
    assert "<h2" in text
    assert ("Variants" in read) == bool(case.variants)
    if name == "grinding_spindle_life":
        assert "life L10r [h]" in read
        assert "heat [W]" in read


def test_known_values_stand_beside_computed_ones(flagship: Path) -> None:
    read = words(flagship.read_text(encoding="utf-8"))
    case = rotordyn.open(flagship.parent).case
    assert case.known[0].remark in read
    assert case.known[0].source in read


def test_an_analysis_without_a_page_of_its_own_has_a_section(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    from rotordyn.analyses import registry

    outside = Path(__file__).parents[1] / "analyses" / "outside"
    monkeypatch.syspath_prepend(outside)
    registry._outside.cache_clear()
    spec = import_module("nose_sag").NoseSagSpec()
    case = replace(rotordyn.load("lalanne_ferraris"), analyses={"nose_sag": spec})
    page = rotordyn.run(case).report(tmp_path / "page.html")
    registry._outside.cache_clear()
    registry.analysis.cache_clear()
    content, numbers = held(page.read_text(encoding="utf-8"))
    read = words(page.read_text(encoding="utf-8"))
    assert "Nose sag" in read
    assert "mass of the rotor [kg]" in read
    (drawn,) = (c for c in content.values() if "weight" in str(c["layout"]["yaxis"]["title"]))
    assert array(drawn["traces"][0]["x"], numbers) == pytest.approx(
        np.array(case.speeds) * RPM.factor, rel=1e-6
    )


def test_a_report_costs_a_run_little(evil_folder: Path, tmp_path: Path) -> None:
    """Time of the processor, once the code is loaded; the largest part compresses plotly.js."""
    results = rotordyn.run(rotordyn.load("mfw2310"))
    results.report(tmp_path / "first.html")
    begin = time.process_time()
    page = results.report(tmp_path / "page.html")
    assert time.process_time() - begin < 0.6
    assert page.stat().st_size < 8e6


def test_a_study_has_a_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    study = tmp_path / "<b>study.yaml"
    study.write_text(
        "title: <b>Two</b> models\ncase: grinding_spindle\n"
        "vary:\n  spindle.bearings.*.model: [vex70, s6014e]\n"
        "  spindle.sleeves.rear.spring.preload: [600 N, 900 N, 1200 N]\nanalyses: [preload]\n"
    )
    folder = tmp_path / "out"
    assert cli.main(["sweep", str(study), "-o", str(folder), "--no-figures", "--workers", "1"]) == 0
    assert cli.main(["report", str(folder)]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == str(folder / "report.html")
    text = (folder / "report.html").read_text(encoding="utf-8")
    assert "&lt;b&gt;Two&lt;/b&gt; models" in text
    assert "6 points" in text
    content, numbers = held(text)
    trade = next(c for c in content.values() if len(c["controls"]) == 2)
    names = [unescape(word) for word in trade["controls"][0]["options"]]
    values = array(trade["traces"][0]["moving"]["x"]["values"], numbers)
    rows = (folder / "points.csv").read_text(encoding="utf-8-sig").splitlines()[1:]
    at = names.index("spindle.sleeves.rear.spring.preload [kN]")
    assert values[at] == pytest.approx(np.array([0.6, 0.9, 1.2] * 2))
    number = names.index("preload: sum at 0 rpm [N]")
    assert values[number][0] == pytest.approx(float(rows[0].split(",")[3]), rel=1e-6)
    (folder / "points.csv").unlink()
    assert cli.main(["report", str(folder)]) == 2
    assert "a study that is not complete" in capsys.readouterr().err


def test_the_command_writes_the_page_beside_the_results(
    evil_folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "handed_on.html"
    assert cli.main(["report", str(evil_folder), "-o", str(page)]) == 0
    assert capsys.readouterr().out == f"{page}\n"
    assert "report.html" in json.loads((evil_folder / "run.json").read_text())["files"]


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (shutil.rmtree, "is no results folder"),
        (lambda f: (f / "run.json").unlink(), "is no results folder"),
        (lambda f: (f / "results.nc").unlink(), "is not complete"),
        (lambda f: (f / "case.json").unlink(), "is not complete"),
        (lambda f: (f / "results.nc").write_bytes(b"half"), "is not complete"),
        (lambda f: (f / "run.json").write_text('{"rotordyn_results": 1}'), "run the case again"),
        (lambda f: (f / "case.json").write_text('{"is": "Case"'), "cannot be read"),
    ],
)
def test_other_folders_are_refused_in_one_sentence(
    evil_folder: Path, tmp_path: Path, spoil, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "copy"
    shutil.copytree(evil_folder, folder)
    (folder / "report.html").unlink()
    spoil(folder)
    assert cli.main(["report", str(folder)]) == 2
    told = capsys.readouterr()
    assert said in told.err
    assert told.err.count("\n") == 1
    assert not told.out
    assert not (folder / "report.html").exists()


def test_a_page_that_cannot_be_written_is_refused(evil_folder: Path, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="cannot be written"):
        rotordyn.write_report(evil_folder, tmp_path / "no" / "page.html")


def test_without_plotly_nothing_is_solved(tmp_path: Path) -> None:
    hide = "import sys; sys.modules['plotly'] = None; from rotordyn.cli import main; "
    run = f"sys.exit(main(['run', 'vex70', '--report', '-o', {str(tmp_path / 'out')!r}]))"
    done = subprocess.run(
        [sys.executable, "-c", hide + run], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert done.stderr == "the package plotly is not installed: python -m pip install plotly\n"
    assert not (tmp_path / "out").exists()


def test_the_title_of_the_small_case_would_run() -> None:
    assert "<script>" in evil().title  # or the tests above prove nothing
