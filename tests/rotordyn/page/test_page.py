"""What the page of a run or a study says, and folders of which there is none."""

from __future__ import annotations

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from html import unescape
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import rotordyn
from docs.site.runs import case_run
from rotordyn import cli
from rotordyn.case.uncertain import Uncertain
from rotordyn.errors import InvalidInput
from rotordyn.field import declared
from rotordyn.job.pages import intervals
from rotordyn.job.pages.asked import numbers_table
from rotordyn.job.pages.inputs import _written, input_blocks
from rotordyn.job.pages.machine import machine_blocks
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.tool import Tool
from rotordyn.page.blocks import Table, Text
from rotordyn.results.display import RPM
from rotordyn.results.headline import FAR, Curve
from rotordyn.results.interval import OVER_HYPOTHESES, OVER_TOLERANCES
from tests.few_speeds import at_few_speeds
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
    for pair, speed in ((0, 0), (1, 1), (2, 2)):
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


def test_bearings_are_in_one_table(evil_folder: Path) -> None:
    text = (evil_folder / "report.html").read_text(encoding="utf-8")
    section = text.split(">Bearings</h2>")[1].split("</section>")[0]
    assert section.count("<table>") == 1
    for head in ("model", "axial load [N]", "peak pressure [GPa]", "n·dm [mm/min]"):
        assert head in section
    result = rotordyn.open(evil_folder)["preload"]
    ends = "\u00a0→ ".join(f"{result['axial_load'].values[k, 0]:.0f}" for k in (0, -1))
    assert ends in section


@pytest.mark.few(2)
@pytest.mark.parametrize("name", CASES)
def test_every_kind_of_case_has_a_page(name: str, runs: Path, tmp_path: Path) -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    case = rotordyn.load(name)
    results = rotordyn.open(case_run(at_few_speeds(case), runs / "few"))
    text = results.report(tmp_path / "page.html").read_text(encoding="utf-8")
    read = words(text)
    for part in results.parts.values():
        assert not case.variants or part.case.title in read
    assert "<h2" in text
    assert ("Variants" in read) == bool(case.variants)
    if name == "grinding_spindle_life":
        assert "life L10r [h]" in read
        assert "heat [W]" in read


def test_the_machine_of_variants_says_whose_it_is_and_has_the_mass_of_each() -> None:
    case = rotordyn.load("grinding_spindle")
    heavy = replace(case.vary({"spindle.discs.wheel.outer_diameter": "250 mm"}), title="heavy")
    section, rotors = machine_blocks([case])
    assert section.title == "Section along the axis"
    assert [row[0] for row in rotors.rows] == ["spindle"]
    section, rotors = machine_blocks([heavy, case])
    assert section.title == "Section along the axis: heavy"
    assert rotors.head[:2] == ["variant", "mass [kg]"]
    masses = [[each.title, f"{rotor_inertia(each.spindle).mass:.4g}"] for each in (heavy, case)]
    assert [row[:2] for row in rotors.rows] == masses
    coupled = case.vary({"spindle.sleeves.rear.spring.preload": "900 N"})
    _, rotors = machine_blocks([case, coupled])
    assert rotors.head[0] == "rotor"
    assert len(rotors.rows) == 1
    said = next(iter(input_blocks([heavy, case]))).sentences[0]
    assert said.endswith("Machine and conditions are those of heavy.")


def test_speeds_of_the_cutter_are_among_the_inputs_and_head_the_limits(tmp_path: Path) -> None:
    (tmp_path / "lobes.yaml").write_text(
        "spindle: deep_groove_rear\nconditions: {kinematics: hybrid, moment_sharing: equal}\n"
        "speeds: [0 rpm, 9000 rpm]\nanalyses:\n  stability_lobes: {point: nose, teeth: 2, "
        "diameter: 40 mm, tangential: 600 MPa, radial: 200 MPa, method: zero-order, "
        "max_frequency: 2500 Hz, speeds: [7000 rpm, 8000 rpm]}\n"
    )
    case = rotordyn.load(tmp_path / "lobes.yaml")
    (asked,) = (t for t in input_blocks([case]) if t.title == "Analysis stability lobes")
    assert ("speeds", "7000 rpm, 8000 rpm") in [row[:2] for row in asked.rows]
    part = rotordyn.run(case).parts[""]
    assert numbers_table([part], "stability_lobes").head == ("", "7000 → 8000 rpm")


def test_inputs_show_sections_pairs_and_units(tmp_path: Path) -> None:
    (tmp_path / "lathe.yaml").write_text(
        "spindle:\n  title: lathe\n  shaft:\n    start: 0 mm\n    sections:\n"
        "      - {name: cone, length: 90 mm, outer_diameter: 80 mm, rear_outer_diameter: 60 mm, "
        "inner_diameter: 30 mm, material: tool_steel}\n"
        "  supports:\n    - {name: front, x: 20 mm, stiffness: {yy: 300 N/um, zz: 300 N/um, "
        "thy_thy: 2 MN m/rad, thz_thz: 2 MN m/rad}, damping: {yy: 4 kN s/m}}\n"
        "  points: {jaws: 0 mm, tail: 90 mm}\n"
        "speeds: [0 rpm]\nanalyses:\n  frf:\n    frequencies: [10 Hz]\n    pairs:\n"
        "      - {response: jaws.z, excitation: jaws.z}\n"
        "      - {response: tail.y, excitation: jaws.thz}\n"
    )
    blocks = [*input_blocks([rotordyn.load(tmp_path / "lathe.yaml")])]
    tables = {block.title: block for block in blocks if isinstance(block, Table)}
    assert "jaws.z / jaws.z, tail.y / jaws.thz" in [row[1] for row in tables["Analysis frf"].rows]
    sections = tables["Spindle: shaft: sections"]
    head = ["", "length", "outer diameter", "inner diameter", "material", "rear outer diameter"]
    assert list(sections.head) == head
    ((name, *sizes, material, rear),) = sections.rows
    assert (name, *sizes, rear) == ("cone", "90 mm", "80 mm", "30 mm", "60 mm")
    assert "GPa" in material
    ((_, _, stiffness, damping),) = tables["Spindle: supports"].rows
    assert "yy: 300 N/um" in stiffness
    assert "N m/rad" in stiffness
    assert damping == "yy: 4 kN s/m"


def test_inputs_are_called_as_in_files(tmp_path: Path) -> None:
    """Keys and words for what is not finite, where Python has other names and numbers."""
    (tmp_path / "bar.yaml").write_text(
        "spindle:\n  shaft:\n    start: 0 mm\n    sections:\n"
        "      - {length: 400 mm, outer_diameter: 40 mm, inner_diameter: 12 mm, "
        "material: steel_rotor}\n"
        "  supports:\n    - {name: a, x: 20 mm, stiffness: {yy: 3e8 N/m, zz: 3e8 N/m}}\n"
        "    - {name: b, x: 380 mm, stiffness: {yy: 3e8 N/m, zz: 3e8 N/m}}\n"
        "  drawbar: {force: 5 kN, from: 20 mm, to: 390 mm}\n"
        "speeds: [0 rpm]\nanalyses:\n  section_forces:\n"
        "    line_loads: [{from: 50 mm, to: 90 mm, qy: 2 kN/m}]\n"
    )
    case = rotordyn.load(tmp_path / "bar.yaml")
    text, *blocks = input_blocks([case])
    assert isinstance(text, Text)
    assert text.sentences[0].startswith("1 speed, 0 rpm;")
    tables = {block.title: block for block in blocks if isinstance(block, Table)}
    rows = {row[0]: row[1] for row in tables["Spindle"].rows}
    assert rows["drawbar"] == "force 5 kN, from 20 mm, to 390 mm"
    assert list(tables["Analysis section forces: line loads"].head) == ["", "from", "to", "qy"]
    (points,) = (field for field in declared(Tool) if field.name == "points")
    assert _written({"tip": math.inf, "inner": -0.03}, points.annotation) == (
        "tip: front; inner: -30 mm"
    )


def test_known_values_are_beside_computed_ones(flagship: Path) -> None:
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
    registry._external.cache_clear()
    spec = import_module("nose_sag").NoseSagSpec()
    case = replace(rotordyn.load("lalanne_ferraris"), analyses={"nose_sag": spec})
    page = rotordyn.run(case).report(tmp_path / "page.html")
    registry._external.cache_clear()
    registry.analysis.cache_clear()
    content, numbers = held(page.read_text(encoding="utf-8"))
    read = words(page.read_text(encoding="utf-8"))
    assert "Nose sag" in read
    assert "mass of the rotor [kg]" in read
    (drawn,) = (c for c in content.values() if "weight" in str(c["layout"]["yaxis"]["title"]))
    assert array(drawn["traces"][0]["x"], numbers) == pytest.approx(
        np.array(case.speeds) * RPM.factor, rel=1e-6
    )


def test_the_page_of_the_flagship_is_small_enough_to_be_sent(flagship: Path) -> None:
    assert flagship.stat().st_size < 8e6


def test_a_study_has_a_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    study = tmp_path / "<b>study.yaml"
    study.write_text(
        "title: <b>Two</b> models\ncase: grinding_spindle\n"
        "vary:\n  spindle.bearings.*.model: [vex70, s6014e]\n"
        "  spindle.sleeves.rear.spring.preload: [600 N, 900 N, 1200 N]\nanalyses: [preload]\n"
        "results: [preload]\n"
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
    varied = text[text.index("What was varied</h2>") : text.index("Trade-off</h2>")]
    assert varied.count("<tr>") == 3
    (folder / "points.csv").unlink()
    assert cli.main(["report", str(folder)]) == 2
    assert "a study that is not complete" in capsys.readouterr().err


def test_the_page_of_a_sample_tells_what_was_varied_from_numbers(tmp_path: Path) -> None:
    """Also where a path has a blank in it."""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    study = tmp_path / "study.yaml"
    study.write_text(
        "case: friswell_unbalance\nsampling: list\nvary:\n"
        "  spindle.discs.left disc.width: [70 mm, 80 mm]\n"
        "  conditions.element_length: [0.2 m, 0.25 m]\n"
    )
    folder = tmp_path / "out"
    assert cli.main(["sweep", str(study), "-o", str(folder), "--no-figures", "--workers", "1"]) == 0
    assert cli.main(["report", str(folder)]) == 0
    text = (folder / "report.html").read_text(encoding="utf-8")
    varied = text[text.index("What was varied</h2>") : text.index("Trade-off</h2>")]
    assert varied.count("<tr>") == 3
    assert "spindle.discs.left disc.width [mm]" in varied
    assert "70, 80" in varied
    assert "unbalance" not in varied


OPTIMUM = """title: <b>Two</b> goals
case: case.yaml
vary:
  spindle.sleeves.rear.spring.preload: {from: 600 N, to: 2400 N}
goals:
  - {highest: preload.axial_load}
  - {lowest: "preload: sum"}
limits:
  - {of: "preload: sum", at_most: 1900 N}
trials: 14
"""


def test_an_optimum_has_a_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    (tmp_path / "case.yaml").write_text(
        "spindle: grinding_spindle\nspeeds: [0 rpm, 12000 rpm]\nanalyses: {preload: {}}\n"
    )
    (tmp_path / "optimum.yaml").write_text(OPTIMUM)
    folder = tmp_path / "out"
    words_of = ["optimise", str(tmp_path / "optimum.yaml"), "-o", str(folder)]
    assert cli.main([*words_of, "--no-figures", "--workers", "1"]) == 0
    assert cli.main(["report", str(folder)]) == 0
    about = json.loads((folder / "optimum.json").read_text(encoding="utf-8"))
    with (folder / "trials.csv").open(encoding="utf-8-sig") as file:
        table = list(csv.DictReader(file))
    text = (folder / "report.html").read_text(encoding="utf-8")
    assert "&lt;b&gt;Two&lt;/b&gt; goals" in text
    kept = sum(row["keeps all limits"] == "yes" for row in table)
    assert f"{len(table)} trials, {kept} of them keep all limits" in text
    assert all(word in words(text) for row in about["rows"] for word in row)
    content, numbers = held(text)
    trade = next(c for c in content.values() if len(c["controls"]) == 2)
    names = [unescape(word) for word in trade["controls"][0]["options"]]
    shown = [names[control["start"]] for control in trade["controls"]]
    assert [name[: name.index(" ")] for name in shown] == ["highest", "lowest"]
    marks = {unescape(trace["name"]): trace["moving"] for trace in trade["traces"]}
    places = {
        "keeps all limits": [k for k, r in enumerate(table) if r["keeps all limits"] == "yes"],
        "breaks a limit": [k for k, r in enumerate(table) if r["keeps all limits"] == "no"],
        "trade-off": sorted(about["front"]),
        "best": [about["best"]],
    }
    assert marks.keys() == places.keys()
    for group, rows in places.items():
        for along, name in zip("xy", shown, strict=True):
            values = array(marks[group][along]["values"], numbers)[names.index(name)]
            assert values == pytest.approx([float(table[k][name]) for k in rows], rel=1e-6)
    pairs = {k: [float(table[k][name]) for name in shown] for k in places["keeps all limits"]}
    beaten = {
        k for k, (a, b) in pairs.items() for c, d in pairs.values() if c >= a and d <= b != d
    } | {k for k, (a, b) in pairs.items() for c, d in pairs.values() if c > a and d <= b}
    assert sorted(about["front"]) == sorted(pairs.keys() - beaten)
    best = max(places["keeps all limits"], key=lambda k: float(table[k][shown[0]]))
    assert about["best"] == best
    (folder / "optimum.json").unlink()
    assert cli.main(["report", str(folder)]) == 2
    assert "an optimum that is not complete" in capsys.readouterr().err


def test_intervals_are_on_the_page(tmp_path: Path) -> None:
    """Bars of the tornado are the effects, bands the ranges of the curves."""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    spring = "spindle.sleeves.rear.spring.preload"
    uncertain = Uncertain(
        hypotheses={"conditions.kinematics": ("outer", "hybrid")}, tolerances={spring: "± 10 %"}
    )
    case = rotordyn.load("grinding_spindle")
    case = replace(
        case,
        speeds=(0.0, 400.0 * math.pi),
        analyses={"preload": case.analyses["preload"]},
        uncertain=uncertain,
    )
    results = rotordyn.run(case, interval=True)
    content, numbers = held(results.report(tmp_path / "sure.html").read_text(encoding="utf-8"))
    sure = results.interval
    (tornado,) = (c for c in content.values() if c["traces"][0].get("type") == "bar")
    for place, name in enumerate(map(unescape, tornado["controls"][0]["options"])):
        one = sure.sel(number=name)
        low, high, over = tornado["traces"]
        assert low["moving"]["y"][place][0] == "hypotheses"
        wanted = one["effect"].values
        size = np.abs(wanted).max(axis=1)
        wanted = wanted[size > 3e-3 * size.max()] if size.max() else wanted[:0]
        for trace, effect in zip((low, high), wanted.T, strict=True):
            assert trace["moving"]["x"][place][1:] == pytest.approx(effect)
        ends = one["hypotheses"].values - float(one["nominal"])
        assert over["moving"]["base"][place][0] == pytest.approx(ends[0])
        assert over["moving"]["x"][place][0] == pytest.approx(ends[1] - ends[0])
    traces = [t for c in content.values() for t in c.get("traces", ()) if t.get("fill")]
    over = {OVER_HYPOTHESES, OVER_TOLERANCES}
    bands = [trace for trace in traces if unescape(trace["name"]) in over]
    assert {unescape(band["name"]) for band in bands} == over
    drawn = [array(band["y"], numbers) for band in bands]
    for k in range(sure.sizes["curve"]):
        ends = sure["curve_tolerances"].values[sure["curve_of"].values == k]
        around = [*ends[:, 0], *ends[::-1, 1]]
        assert not np.ptp(ends, axis=1).any() or any(
            len(y) == len(around) and np.allclose(y, around, rtol=1e-6) for y in drawn
        )


def test_bands_of_depths_end_where_their_axis_does() -> None:
    """Bands far above the axis do not make it grow."""
    x, y = np.array([1.0, 2.0, 3.0, 4.0]), np.array([2.0, 9.0, np.nan, 3.0])
    curve = Curve("lobes", "depth", "mm", x, y, ceiling=10.0)
    ends = np.stack([0.9 * y, 60.0 * y], axis=1)
    sure = SimpleNamespace(
        x=x,
        curve_nominal=y,
        curve_hypotheses=np.stack([y, y], axis=1),
        curve_tolerances=ends,
        rows_of=lambda which: slice(None),
    )
    part = SimpleNamespace(case=rotordyn.load("mfw2310"))
    chart = intervals._band_chart("", part, sure, [(curve, 0)])
    low, high = chart.layout["yaxis"]["range"]
    assert low == 0.0
    assert 9.0 < high < 12.0
    band = chart.traces[0]
    assert band["name"] == OVER_TOLERANCES
    assert np.nanmax(band["y"]) == FAR * curve.ceiling


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
        (lambda f: (f / "results.nc").unlink(), "is incomplete"),
        (lambda f: (f / "case.json").unlink(), "is incomplete"),
        (lambda f: (f / "results.nc").write_bytes(b"half"), "is incomplete"),
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


@pytest.mark.parametrize("name", ["study.yaml", "report", "page.html.txt"])
def test_a_file_that_is_no_page_by_its_name_is_left_alone(
    evil_folder: Path, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / name
    file.write_text("case: mfw2310\n")
    assert cli.main(["report", str(evil_folder), "-o", str(file)]) == 2
    assert capsys.readouterr().err == f"{file}: the name of a page ends in .html or .htm\n"
    assert file.read_text() == "case: mfw2310\n"


def test_a_page_is_written_to_a_device(evil_folder: Path) -> None:
    assert rotordyn.write_report(evil_folder, os.devnull) == Path(os.devnull)


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
