"""Identification: twins found again, what data cannot tell said, bad input refused at once."""

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
from rotordyn import AxialCurve, NoLoad, Numbers, Phase, Predicted, StopMet, Unknown, identify
from rotordyn.case.case import Case
from rotordyn.cli import main
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.study.identification import search as searching
from rotordyn.study.identification.along_axis import RPM
from rotordyn.study.identification.certainty import certainty
from rotordyn.study.identification.criterion import Criterion
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.solve import identified
from rotordyn.study.identification.trial import Known, Trial
from rotordyn.study.identification.unknown import sought
from rotordyn.study.identification.weighing import Weighing
from tests.rotordyn.page.conftest import array, held

Array = np.ndarray[Any, np.dtype[np.float64]]
STUDIES = Path(__file__).parents[3] / "cases" / "identification"
FRONT, REAR = "spindle.sleeves.front.", "spindle.sleeves.rear."
SPRINGS = {
    FRONT + "spring.preload": Unknown("100 N", "1050 N", start="500 N", name="P1"),
    REAR + "spring.preload": Unknown("150 N", "1100 N", start="600 N", name="P2"),
    FRONT + "stop_travel": Unknown("20 um", "100 um", start="60 um", name="stop"),
    FRONT + "friction": Unknown("0 N", "200 N", start="60 N", name="friction"),
}
TRUE = np.array([574.0, 528.0, 52.2e-6, 80.9])
SPEEDS = (4000.0 * RPM, 20000.0 * RPM)
KNOWN = Known()  # tables of bearings, the same in all twins


@pytest.fixture(scope="module")
def case() -> Case:
    return rotordyn.load("mfw2310_identification")


def curve(of: str, displacement: Array | None = None, points: int = 9, **given: Any) -> AxialCurve:
    """Both branches at two speeds."""
    force = np.linspace(-1700.0, 1800.0, points)
    along = np.tile(np.concatenate([force[::-1], force]), 2)
    branch = tuple(np.tile(np.repeat(("falling", "rising"), points), 2).tolist())
    speed = np.repeat(SPEEDS, 2 * points)
    values = 0.0 * along if displacement is None else displacement
    usual: dict[str, Any] = dict(name=of, of=of, deviation=0.4e-6, tare=1e-6)
    return AxialCurve(**usual | given, speed=speed, branch=branch, force=along, displacement=values)


def twin(
    case: Case, seed: int, asked: Mapping[str, Unknown] = SPRINGS, true: Array = TRUE
) -> Problem:
    """A problem whose measurements are those of the machine with ``true`` values, with noise."""
    rng = np.random.default_rng(seed)
    still = Problem(case, sought(case, asked), (curve("shaft"), curve("rear")), known=KNOWN)
    found = still.predicted(true)
    assert found is not None
    noisy = []
    for each, exact in zip(still.measurements, found, strict=True):
        tare = np.repeat(rng.normal(0.0, 1e-6, 2), len(exact) // 2)
        noisy.append(curve(each.data.name, exact + tare + rng.normal(0.0, 0.4e-6, len(exact))))
    return replace(still, measurements=tuple(noisy))


def test_five_twins_are_found_again(case: Case) -> None:
    """95 % intervals: all but a few of 20 hold; three misses or fewer have a chance of 98 %."""
    inside = []
    for seed in range(5):
        problem = twin(case, seed)
        fit = searching.search(problem, problem.start)
        sure = certainty(problem, fit)
        inside += [(sure.interval[:, 0] <= TRUE) & (sure.interval[:, 1] >= TRUE)]
        assert 0.5 < sure.reduced < 1.7
        assert set(sure.words) == {"identifiable"}
    assert np.sum(inside) >= 17


def test_nuisances_projected_are_nuisances_sought() -> None:
    """Against ordinary least squares with tare and drift as unknowns beside the others."""
    rng = np.random.default_rng(1)
    columns, slopes, y = rng.normal(size=(20, 2)), rng.normal(size=(20, 3)), rng.normal(size=20)
    noise, prior = rng.uniform(0.5, 2.0, 20), np.array([0.7, np.inf])
    data = Data(
        "made up", y, noise, "", 1.0, np.arange(20.0), "", ("",) * 20, columns, prior, ("a", "b")
    )
    weighing = Weighing(data)
    seeking = np.linalg.lstsq(weighing.weighed(slopes), weighing.weighed(y), rcond=None)[0]
    rows = np.concatenate([np.hstack([slopes, columns]) / noise[:, None], [[0, 0, 0, 1 / 0.7, 0]]])
    whole = np.linalg.lstsq(rows, np.append(y / noise, 0.0), rcond=None)[0]
    assert seeking == pytest.approx(whole[:3], rel=1e-12)
    assert weighing.nuisances(slopes @ seeking) == pytest.approx(whole[3:], rel=1e-10)
    sum_of_squares = np.sum((rows @ whole - np.append(y / noise, 0.0)) ** 2)
    left = weighing.weighed(y - slopes @ seeking)
    assert left @ left == pytest.approx(sum_of_squares, rel=1e-12)


def test_shaft_alone_cannot_tell_the_preloads_apart(case: Case) -> None:
    problem = twin(case, 3)
    alone = replace(problem, measurements=problem.measurements[:1])
    predicted = alone.predicted(TRUE)
    assert predicted is not None
    sure = certainty(alone, Fit(TRUE, 1.0, predicted))
    both = certainty(problem, Fit(TRUE, 1.0, problem.predicted(TRUE) or []))
    size = sure.covariance[:2, :2] * np.outer(alone.scale[:2], alone.scale[:2])
    ones, signs = np.ones(2), np.array([1.0, -1.0])
    assert ones @ size @ ones < 0.01 * (signs @ size @ signs)  # the sum, the difference
    assert both.correlation[0, 1] > sure.correlation[0, 1] < -0.98


def test_growth_and_three_shifts_are_not_told_apart() -> None:
    """Beside all others of the twin; with the shifts known, growth is."""
    asked = read_identification(STUDIES / "mfw2310_twin.yaml").searches
    path = "spindle.shortening.shift"
    shift = {"a": 0.0, "b": 0.0, "c": -0.305e-6, "d": -42.8e-6, "e": -42.8e-6}
    case = rotordyn.vary(asked.models[0].case, {path: shift})
    shifts = {
        f"{path}.a": Unknown("-20 um", "20 um", also=(f"{path}.b",), name="shift a b"),
        f"{path}.c": Unknown("-20 um", "20 um", name="shift c"),
        f"{path}.d": Unknown("-80 um", "20 um", also=(f"{path}.e",), name="shift d e"),
    }
    known = asked.models[0].unknowns
    true = np.array([574.0, 528.0, 6.2e6, 5.49e6, 52.2e-6, 80.9, 43.2e-6, 7.3e-6, 0.571])
    words = {}
    for more in ((), sought(case, shifts)):
        problem = Problem(case, (*known, *more), asked.measurements, known=KNOWN)
        values = np.append(true, [0.0, -0.305e-6, -42.8e-6][: len(more)])
        fit = Fit(values, float(problem.count), problem.predicted(values) or [])
        sure = certainty(problem, fit)
        words[len(more)] = {u.name: w for u, w in zip(problem.unknowns, sure.words, strict=True)}
    assert words[0]["Δu24"] == "identifiable"
    vague = {name for name, word in words[3].items() if word == "unidentifiable"}
    assert vague == {"Δu24", "shift a b", "shift c", "shift d e"}
    assert len(sure.directions) == 1
    assert np.abs(sure.directions[0][[7, 9, 10, 11]]).min() > 0.2
    assert np.abs(sure.directions[0][[0, 1, 2, 3, 4, 5, 6, 8]]).max() < 0.15


def test_first_model_of_the_story_is_insufficient() -> None:
    """Of the story in the thesis: 5.47 µm and three values on their bounds (D. Noël, 2013, 3.2)."""
    asked = read_identification(STUDIES / "mfw2310_phases.yaml")
    first = replace(asked.searches, models=asked.searches.models[:1], absolute=False)
    from rotordyn.study.identification.solve import identified

    found = identified(replace(asked, searches=first), workers=1)
    assert 4.0 < found.residual < 6.5
    assert not found.sufficient
    assert "allowed 1" in found.verdict[0]
    assert "the model lacks a phenomenon" in found.verdict[0]
    assert found.explained.on_bounds


def test_hypotheses_are_ranked(case: Case) -> None:
    """Without friction no machine explains a loop."""
    problem = twin(case, 1)
    asked = {path: each for path, each in SPRINGS.items() if "friction" not in path}
    found = identify(
        case,
        asked,
        problem.measurements,
        hypotheses={FRONT + "friction": [0.0, 80.9]},
        workers=1,
    )
    assert found.surviving == ["friction 80.9 N"]
    assert found.evidence[1] > 100.0
    assert "no machine" not in found.summary


def test_absolute_differences_bear_outliers(case: Case) -> None:
    """Without noise the machine is found exactly beside a few wrong points."""
    asked = {FRONT + "friction": SPRINGS[FRONT + "friction"]}
    exact = curve("shaft", tare=0.0).predicted(Trial(case, axial_speeds=SPEEDS, known=KNOWN))
    exact[22:25] += 3e-6
    measured = [curve("shaft", exact, tare=0.0)]
    off = {
        how: abs(
            identify(case, asked, measured, minimise=how, workers=1).values[FRONT + "friction"]
            - 80.9
        )
        for how in ("squares", "absolute")
    }
    assert off["squares"] > 2.0
    assert off["absolute"] < 0.1


def test_prior_joins_the_data(case: Case) -> None:
    """Inverse variances add."""
    asked = {FRONT + "friction": SPRINGS[FRONT + "friction"]}
    problem = twin(case, 2, asked, TRUE[-1:])
    free = identify(case, asked, problem.measurements, workers=1).explained.sure
    prior = {FRONT + "friction": replace(asked[FRONT + "friction"], prior="70 N", deviation="1 N")}
    held = identify(case, prior, problem.measurements, workers=1).explained.sure
    variance = (free.deviation[0] / free.birge) ** 2
    mean = (free.values[0] / variance + 70.0) / (1.0 / variance + 1.0)
    assert held.values[0] == pytest.approx(mean, abs=0.1)
    assert held.deviation[0] / held.birge == pytest.approx((1.0 / variance + 1.0) ** -0.5, rel=0.02)


def test_prediction_follows_what_was_measured(case: Case) -> None:
    """One unknown by one measured number: its prediction has the interval of the measurement."""
    plain = replace(case, analyses={"preload": case.analyses["preload"]}, speeds=(24000.0 * RPM,))
    plain = rotordyn.vary(plain, {FRONT + "stop_travel": np.inf})
    asked = {REAR + "spring.preload": Unknown("450 N", "650 N")}
    load = Numbers(
        name="load",
        of="preload: sum",
        speed=np.array([24000.0]) * RPM,
        values=np.array([2190.0]),
        deviation=20.0,
        unit="N",
    )
    found = identify(plain, asked, [load], predict=[Predicted("preload: sum")], workers=1)
    (one,), sure = found.predictions, found.explained.sure
    assert one.value == pytest.approx(2190.0, abs=0.1)
    assert 0.5 * (one.high - one.low) == pytest.approx(sure.quantile * 20.0, rel=1e-2)


def test_nearest_mode(case: Case) -> None:
    modes = Numbers(
        name="modes",
        of="campbell.frequency",
        where={"mode": "bending*"},
        speed=np.array([4000.0, 4000.0]) * RPM,
        values=np.array([900.0, 1300.0]),
        deviation=20.0,
        unit="Hz",
        nearest=True,
    )
    assert not [*modes.faults(case)]
    trial = Trial(case, tuple(modes.speeds(case)), modes.analyses(case))
    found = modes.predicted(trial)
    every = trial.results["campbell"].frequency.ravel()
    every = every[np.isfinite(every)]
    assert found == pytest.approx([every[np.abs(every - f).argmin()] for f in (900.0, 1300.0)])


def test_interrupt_keeps_the_best_and_goes_on(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = twin(case, 4)
    asked = dict(measurements=problem.measurements, workers=1, folder=tmp_path)
    solved = Problem.predicted
    count = 0

    def stops(self: Problem, values: Array) -> Any:
        nonlocal count
        count += 1
        if count == 20:
            raise KeyboardInterrupt
        return solved(self, values)

    monkeypatch.setattr(Problem, "predicted", stops)
    half = identify(case, SPRINGS, **asked)
    monkeypatch.setattr(Problem, "predicted", solved)
    assert half.stopped
    assert "stopped before the end" in half.summary
    whole = identify(case, SPRINGS, **asked)
    assert not whole.stopped
    assert whole.explained.fit.cost < half.explained.fit.cost
    counted = whole.explained.searches[0].evaluations
    again = identify(case, SPRINGS, **asked)
    assert again.explained.searches[0].evaluations == counted  # read, not searched
    assert again.explained.fit.values == pytest.approx(whole.explained.fit.values, rel=1e-12)
    journal = tmp_path / "searches.jsonl"
    head, *lines = [json.loads(line) for line in journal.read_text().splitlines()]
    failed = [line | {"values": [], "sentence": "no state"} for line in lines]
    journal.write_text("".join(json.dumps(line) + "\n" for line in [head, *failed]))
    anew = identify(case, SPRINGS, **asked)
    assert anew.explained.fit.values == pytest.approx(whole.explained.fit.values, rel=1e-6)
    with pytest.raises(InvalidInput, match="another identification"):
        identify(case, dict(list(SPRINGS.items())[:2]), **asked)


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


SMALL = """title: Two numbers of a twin
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
    assert drawn[-1] == pytest.approx(float(row["machine"]) + float(row["left"]), rel=1e-6)
    left = array(charts[2]["traces"][1]["y"], numbers)
    assert left[-1] == pytest.approx(float(row["left"]), rel=1e-6)
    (out / "models.csv").unlink()
    assert main(["report", str(out)]) == 2
    assert "an identification that is not complete" in capsys.readouterr().err


def test_a_verdict_by_chi_squared_says_its_degrees() -> None:
    """At two of them the probability of as much is exp(−χ²/2)."""
    sure: Any = SimpleNamespace(reduced=1.5, degrees=2)
    said = Criterion("µm").kept(0.3, sure)
    assert said.endswith(f"χ² 3 at 2 degrees of freedom, p {np.exp(-1.5):.2g}")
    sure = SimpleNamespace(reduced=9.0, degrees=2)
    one: Any = SimpleNamespace(measurements=(SimpleNamespace(data=SHOWN),))
    (why,) = Criterion("µm").excess(one, [np.ones(4)], sure)
    assert why == f"differs by 3 times the stated noise: χ² 18 at 2 degrees of freedom, p {P18}"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("kind: axial curve", "kind: axial", "unknown kind 'axial'"),
        ("deviation: 0.4 um, tare", "deviation: 0.4 N, tare", "is not a unit of length"),
        ("deviation: 0.4 um, tare", "deviation: 0 um, tare", "a deviation is a number above 0"),
        ("deviation: 0.4 um, tare", "deviation: 400 um, tare", "noise swamps it"),
        ("data/twin_shaft.csv", "data/none.csv", "cannot be read"),
        ("of: rear", "of: middle", "no such body; allowed: shaft, front, rear"),
        ("from: 20 um, to: 100 um", "from: 100 um, to: 20 um", "a higher end, got 100 um to 20 um"),
        ("stop_travel: {from", "stop_way: {from", "unknown key 'stop_way'"),
        ("prior: 70 N, deviation: 30 N", "prior: 70 N", "give both or none"),
        ("[16000 rpm]", "[16000 rpm, 20000 rpm]", "at each speed is needed, got 1 at 2 speeds"),
        ("[16000 rpm]", "[-1 rpm]", "from 0 rpm up"),
        ("criterion: 1 um", "predict: 'stiffness: full'", ":14:10: predict: wrong shape"),
        ("criterion: 1 um", "predict: [{of: 'stifness: full'}]", ":14:10: predict: 'stifness"),
        ("criterion: 1 um", "phases: {a: {unknowns: [P9]}}", "phases.a: phase a: no unknown 'P9'"),
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


def test_a_speed_at_which_bearings_have_no_state_is_named(tmp_path: Path) -> None:
    path = _study(tmp_path)
    path.write_text(SMALL.replace("[16000 rpm]", "[900000 rpm]"), encoding="utf-8")
    with pytest.raises(NoSolution, match=r"bearing number \d of the spindle at 900000 rpm"):
        identified(read_identification(path), workers=1)


HEAD = "speed [rpm],branch,force [N],displacement [um]\n"


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("speed [rpm],force [N],displacement [um]\n4000,1,2\n", "lacks the column branch"),
        (HEAD.replace("[um]", "[N]") + "4000,falling,1,2\n", "is in no unit of length"),
        (HEAD.replace(" [N]", "") + "4000,falling,1,2\n", "has no unit"),
        (HEAD.replace("force", "load") + "4000,falling,1,2\n", "unknown column 'load [N]'"),
        (HEAD + "4000,falling,1\n", "points.csv:2: has 3 cells where the head has 4"),
        (HEAD + "4000,falling,1,x\n", "displacement is no number: given 'x'"),
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
    with pytest.raises(InvalidInput, match="4 unknowns, but the measurements have 1 points"):
        identify(case, SPRINGS, measured)


def test_what_python_gives_is_held_against_the_case(case: Case) -> None:
    stop = StopMet(name="stop", sleeve="rear", speed=1e3, deviation=1e-6)
    one: dict[str, Unknown] = {FRONT + "friction": Unknown("0 N", "200 N")}
    refused: Sequence[tuple[Any, Any, Mapping[str, Any], str]] = (
        (one, [stop], {}, "sleeve rear has no stop"),
        (one, [], {}, "nothing was measured"),
        ({}, [curve("shaft")], {}, "nothing is unknown"),
        ({FRONT + "bearings": Unknown(0, 1)}, [curve("shaft")], {}, "wrong type"),
        (one, [curve("shaft"), curve("shaft")], {}, "two measurements are called shaft"),
        (one, [curve("shaft")], {"minimise": "cubes"}, "allowed: squares, absolute"),
        (one, [curve("shaft")], {"starts": 0}, "a whole number up to 1000"),
        (one, [curve("shaft")], {"hypotheses": {"spindle.x": [1]}}, "unknown key 'x'"),
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
