"""Files of identifications: what comes of one, and a sentence for each fault."""

from __future__ import annotations

import csv
import json
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn import AxialCurve, NoLoad, Numbers, Phase, Predicted, StopReached, Unknown, identify
from rotordyn.case.case import Case
from rotordyn.cli import main
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.study.identification.criterion import FitCriterion
from rotordyn.study.identification.deliver import deliver
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.unknown import sought
from tests.rotordyn.page.conftest import array, held
from tests.rotordyn.study.axial_twin import (
    FRONT,
    SPRINGS,
    STUDIES,
    curve,
)


@pytest.fixture(scope="module")
def case() -> Case:
    return rotordyn.load("mfw2310_identification")


def _study(folder: Path, **changes: str) -> Path:
    text = (STUDIES / "mfw2310_twin.yaml").read_text(encoding="utf-8")
    shutil.copy(STUDIES.parent / "mfw2310_identification.yaml", folder)
    shutil.copytree(STUDIES / "data", folder / "data", dirs_exist_ok=True)
    text = text.replace("../mfw2310_identification.yaml", "mfw2310_identification.yaml")
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    path = folder / "twin.yaml"
    path.write_text(text, encoding="utf-8")
    return path


SMALL = """title: Two values of a synthetic machine
case: mfw2310_identification.yaml
unknowns:
  spindle.sleeves.front.stop_travel: {from: 20 um, to: 100 um, start: 60 um, name: stop}
  spindle.sleeves.front.friction: {from: 0 N, to: 200 N, prior: 70 N, deviation: 30 N}
measurements:
  shaft: {kind: axial curve, file: data/twin_shaft.csv, points: 8, deviation: 0.4 um, tare: 1 um}
  rest:
    kind: no load
    of: rear
    speeds: [16000 rpm]
    displacements: [-48.8 um]
    deviation: 1 um
criterion: 1 um
"""


SHOWN = SimpleNamespace(unit="µm", factor=1.0, series=("",) * 4, name="curve")
P18 = "0.00012"  # exp(−9)
STOP = "spindle.sleeves.front.stop_travel: {from: 20 um, to: 100 um, start: 60 um"
SUN = "{kind: numbers, of: 'preload: sun', deviation: 9 N, speeds: [9 rpm], values: [1 N]}"
NUMBERS = f"  n: {SUN}\n  rest:\n"
HYPOTHESIS = "hypotheses: {{conditions.kinematics: [{}]}}"


def test_file_of_an_identification(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = _study(tmp_path)
    path.write_text(SMALL, encoding="utf-8")
    out = tmp_path / "out"
    assert main(["identify", str(path), "-o", str(out), "--workers", "1"]) == 0
    said = capsys.readouterr().out
    assert "sufficient" in said
    names = {each.name for each in out.iterdir()}
    assert {"best.yaml", "summary.txt", "identification.nc", "values.csv", "measured.png"} <= names
    best = rotordyn.load(out / "best.yaml")
    assert best.spindle is not None
    assert best.spindle.sleeves[0].stop_travel == pytest.approx(52.2e-6, abs=1.5e-6)
    pytest.importorskip("plotly", reason="the extra report is not installed")
    assert main(["identify", str(path), "-o", str(out), "--no-figures", "--report"]) == 0
    page = (out / "report.html").read_text(encoding="utf-8")
    assert re.findall(r"<h2[^>]*>(.*?)</h2>", page) == [
        *("Verdict", "Correlation", "Measured and computed"),
        *("The identified machine as a case", "Origin"),
    ]
    assert re.search(r'class="verdict plain" role="status">✓ sufficient: differs by', page)
    assert not re.search(r"""(src|href)=["']?(http|//)""", page.partition("<script")[0])
    content, numbers = held(page)
    charts = [*content.values()]
    assert [chart["traces"][0].get("type") for chart in charts] == ["heatmap", None, None]
    with (out / "differences.csv").open(newline="", encoding="utf-8-sig") as file:
        row = next(csv.DictReader(file))  # falling, the highest force
    drawn = array(charts[1]["traces"][1]["y"], numbers)
    assert drawn[-1] == pytest.approx(float(row["machine"]) + float(row["residual"]), rel=1e-6)
    residual = array(charts[2]["traces"][1]["y"], numbers)
    assert residual[-1] == pytest.approx(float(row["residual"]), rel=1e-6)
    (out / "models.csv").unlink()
    assert main(["report", str(out)]) == 2
    assert "an identification that is not complete" in capsys.readouterr().err


def test_a_verdict_by_chi_squared_says_its_degrees() -> None:
    """At two of them the probability of as much is exp(−χ²/2)."""
    sure: Any = SimpleNamespace(reduced=1.5, degrees=2)
    said = FitCriterion("µm").kept(0.3, sure)
    assert said.endswith(f"χ² 3 at 2 degrees of freedom, p {np.exp(-1.5):.2g}")
    sure = SimpleNamespace(reduced=9.0, degrees=2)
    one: Any = SimpleNamespace(measurements=(SimpleNamespace(data=SHOWN),))
    even: Any = SimpleNamespace(reduced=1.004, degrees=2)
    assert "in the mean, as much as the stated noise in the root" in FitCriterion("µm").kept(
        0.3, even
    )
    (why,) = FitCriterion("µm").excess(one, [np.ones(4)], sure)
    assert why == f"differs by 3 times the stated noise: χ² 18 at 2 degrees of freedom, p {P18}"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("kind: axial curve", "kind: axial", "unknown kind 'axial'"),
        ("kind: axial curve", "kind: {axial: curve}", "unknown kind 'a mapping'"),
        ("deviation: 0.4 um, tare", "deviation: 0.4 N, tare", "is not a unit of length"),
        ("deviation: 0.4 um, tare", "deviation: 0 um, tare", "a deviation is a number above 0"),
        ("deviation: 0.4 um, tare", "deviation: 400 um, tare", "noise dominates it"),
        ("data/twin_shaft.csv", "data/none.csv", "cannot be read"),
        ("of: rear", "of: middle", "no such body; allowed: shaft, front, rear"),
        ("from: 20 um, to: 100 um", "from: 100 um, to: 20 um", "a higher end, got 100 um to 20 um"),
        ("stop_travel: {from", "stop_way: {from", "unknown key: given 'stop_way'"),
        ("prior: 70 N, deviation: 30 N", "prior: 70 N", "give both or none"),
        ("prior: 70 N", "prior: 300 N", "the prior 300 N lies outside 0 N to 200 N"),
        ("start: 60 um", "also: [spindle.sleeves.rear.friction]", "holds a force, no length"),
        (STOP, "spindle.bearings.*.model.balls: {from: 10, to: 20", "holds whole numbers"),
        ("case: mfw2310_identification.yaml", "case: mfw", ":2:7: case: no such file"),
        ("  rest:\n", NUMBERS, ":8:6: measurements.n: 'preload: sun': preload has no such number"),
        ("[16000 rpm]", "[16000 rpm, 20000 rpm]", "at each speed is needed, got 1 at 2 speeds"),
        ("[16000 rpm]", "[-1 rpm]", "from 0 rpm up"),
        ("criterion: 1 um", "predict: 'stiffness: full'", ":14:10: predict: wrong shape"),
        ("criterion: 1 um", "predict: [{of: 'stifness: full'}]", ":14:10: predict: 'stifness"),
        ("criterion: 1 um", "predict: ['stiffness: full']", ":14:11: predict.1: wrong shape"),
        ("criterion: 1 um", "phases: {a: {unknowns: [P9]}}", "phases.a: no unknown 'P9'"),
        ("criterion: 1 um", "phases: {a: {values: Kp1}}", ":14:22: phases.a.values: wrong shape"),
        ("criterion: 1 um", "phases: {a: Kp1}", ":14:13: phases.a: wrong shape"),
        ("criterion: 1 um", "phases: [a]", ":14:9: phases: wrong shape"),
        ("criterion: 1 um", HYPOTHESIS.format(""), "given a list; allowed: a list of at least one"),
        ("criterion: 1 um", HYPOTHESIS.format("outer, outer"), "'outer' is given twice"),
        ("criterion: 1 um", "criterion: 1 N", "allowed: a mean difference in µm"),
        ("criterion: 1 um", "profiles: [stip]", ":14:11: profiles: no unknown 'stip'"),
        ("points: 8", "points: 1", "points"),
    ],
)
def test_faults_of_a_file(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = _study(tmp_path)
    assert old in SMALL
    path.write_text(SMALL.replace(old, new), encoding="utf-8")
    with pytest.raises(InvalidInput) as refusal:
        read_identification(path)
    assert said in str(refusal.value)


def test_a_deviation_in_another_unit_is_one_fault(tmp_path: Path) -> None:
    path = _study(tmp_path)
    path.write_text(SMALL.replace("deviation: 30 N", "deviation: 30 K"), encoding="utf-8")
    with pytest.raises(InvalidInput, match="'K' is not a unit of force") as refusal:
        read_identification(path)
    assert "\n" not in str(refusal.value)


def test_a_temperature_deviates_by_kelvin(tmp_path: Path) -> None:
    """In files and in Python."""
    known = {"from": "20 degC", "to": "80 degC", "prior": "45 degC", "deviation": "10 K"}
    shaft, path = "conditions.temperatures.shaft", tmp_path / "warm.yaml"
    measured = (
        "{kind: numbers, of: 'preload: sum', values: [1 kN], speeds: [0 rpm], deviation: 2 N}"
    )
    path.write_text(
        f"case: grinding_spindle_interval\nunknowns: {{{shaft}: {json.dumps(known)}}}\n"
        f"measurements:\n  load: {measured}\n",
        encoding="utf-8",
    )
    case = rotordyn.load("grinding_spindle_interval")
    asked = Unknown("20 degC", "80 degC", prior="45 degC", deviation="10 K")
    of_file = read_identification(path).searches.models[0].unknowns
    for (unknown,) in (of_file, sought(case, {shaft: asked})):
        assert (unknown.prior, unknown.deviation) == (45.0, 10.0)


def test_a_speed_at_which_bearings_have_no_state_is_named(tmp_path: Path) -> None:
    path = _study(tmp_path)
    path.write_text(SMALL.replace("[16000 rpm]", "[900000 rpm]"), encoding="utf-8")
    with pytest.raises(NoSolution, match=r"bearing number \d of the spindle at 900000 rpm"):
        deliver(read_identification(path), tmp_path / "out", workers=1)
    assert not (tmp_path / "out").exists()  # nothing is left half written


HEAD = "speed [rpm],branch,force [N],displacement [um]\n"


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("speed [rpm],force [N],displacement [um]\n4000,1,2\n", "lacks the column branch"),
        (HEAD.replace("[um]", "[N]") + "4000,falling,1,2\n", "is in no unit of length"),
        (HEAD.replace(" [N]", "") + "4000,falling,1,2\n", "has no unit"),
        (HEAD.replace("force", "load") + "4000,falling,1,2\n", "unknown column 'load [N]'"),
        (HEAD + "4000,falling,1\n", "points.csv:2: has 3 cells where the head has 4"),
        (HEAD + "4000,falling,1,x\n", "displacement is not a number: given 'x'"),
        (
            HEAD + "-9,falling,1,2\n",
            "points.csv:2: speed: speed out of range: given -9 rpm; allowed",
        ),
        (
            HEAD + "9,falling,1e9,2\n",
            "points.csv:2: force: force out of range: given 1e9 N; allowed",
        ),
        (HEAD + "4000,falling,1,2\n4000,falling,1,3\n", "points repeated on the falling branch"),
        (HEAD + "4000,falling,1,2\n4000,falling,2,3\n", "2 N after 1 N (points.csv:3)"),
        (HEAD + "4000,down,1,2\n", "branch 'down' (points.csv:2); allowed: falling, rising"),
        (HEAD + "4000,falling,1,2\n", "points: given 8; the longest branch has 1"),
        (HEAD, "holds no points"),
    ],
)
def test_faults_of_a_table(tmp_path: Path, table: str, said: str) -> None:
    path = _study(tmp_path)
    path.write_text(SMALL.replace("data/twin_shaft.csv", "points.csv"), encoding="utf-8")
    (tmp_path / "points.csv").write_text(table, encoding="utf-8")
    with pytest.raises(InvalidInput) as refusal:
        read_identification(path)
    assert said in str(refusal.value)


def test_more_unknowns_than_points(case: Case) -> None:
    measured = [
        NoLoad(
            name="rear", of="rear", speed=np.array([1e3]), displacement=np.zeros(1), deviation=1e-6
        )
    ]
    with pytest.raises(
        InvalidInput, match=r"4 are given, more than numbers measured \(1\) and priors \(0\)"
    ):
        identify(case, SPRINGS, measured)


def test_what_python_gives_is_held_against_the_case(case: Case) -> None:
    stop = StopReached(name="stop", sleeve="rear", speed=1e3, deviation=1e-6)
    pushed = replace(stop, sleeve="front", force=900.0, lowest=-50.0, highest=50.0)
    one: dict[str, Unknown] = {FRONT + "friction": Unknown("0 N", "200 N")}
    refused: Sequence[tuple[Any, Any, Mapping[str, Any], str]] = (
        (one, [stop], {}, "sleeve rear has no stop"),
        (one, [pushed], {}, "force: given 900 N; allowed: within the cycle, -50 N to 50 N"),
        (one, [], {}, "measurements: none is given"),
        ({}, [curve("shaft")], {}, "unknowns: none is given"),
        ({FRONT + "bearings": Unknown(0, 1)}, [curve("shaft")], {}, "wrong type"),
        (one, [curve("shaft"), curve("shaft")], {}, "two measurements are called shaft"),
        (one, [curve("shaft")], {"minimise": "cubes"}, "allowed: squares, absolute"),
        (one, [curve("shaft")], {"starts": 0}, "a whole number up to 1000"),
        (one, [curve("shaft")], {"hypotheses": {"spindle.x": [1]}}, "unknown key: given 'x'"),
        (one, [curve("shaft")], {"phases": {"p": Phase(("P9",))}}, "no unknown 'P9'"),
        (one, [curve("shaft")], {"predict": [Predicted("frf: peak")]}, "an analysis of the case"),
        (one, [_numbers("frf: x")], {}, "begins with an analysis of the case"),
    )
    for unknowns, measured, given, said in refused:
        with pytest.raises(InvalidInput, match=said):
            identify(case, unknowns, _varied(measured), **given)


def _varied(measured: Sequence[Any]) -> list[Any]:
    """Curves of zeros are swamped by noise: give them a slope."""
    return [
        replace(each, displacement=each.force * 1e-8) if isinstance(each, AxialCurve) else each
        for each in measured
    ]


def _numbers(of: str) -> Numbers:
    return Numbers(
        name="n", of=of, speed=np.array([1e3]), values=np.ones(1), deviation=1.0, unit="N"
    )
