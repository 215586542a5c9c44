"""Which points a study solves, and what it says of values that cannot be."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings import AngularContactBallBearing
from rotordyn import Span, sweep
from rotordyn.case.case import Case
from rotordyn.case.library import models_root
from rotordyn.errors import InvalidInput
from rotordyn.study.design import design
from rotordyn.study.read import read_study

PRELOAD = "spindle.sleeves.front.spring.preload"
TRAVEL = "spindle.sleeves.front.stop_travel"


@pytest.fixture(scope="module")
def flagship() -> Case:
    return rotordyn.load("mfw2310")


def test_a_grid_has_every_combination_the_last_path_fastest(flagship: Case) -> None:
    grid = design(flagship, {PRELOAD: ["300 N", 450.0], TRAVEL: Span("40 um", 120e-6, 3)})
    assert (grid.dims, grid.shape) == ((PRELOAD, TRAVEL), (2, 3))
    found = [tuple(grid.point(k).values()) for k in range(grid.count)]
    travels = (40e-6, 80e-6, 120e-6)
    assert found == [(given, pytest.approx(t)) for given in ("300 N", 450.0) for t in travels]
    assert grid.labels(0) == {PRELOAD: 300.0, TRAVEL: 40e-6}


def test_a_path_is_varied_once_with_or_without_the_machine_before_it(
    flagship: Case, tmp_path: Path
) -> None:
    """Before anything is solved."""
    said = "given twice, with and without 'spindle.' before it"
    short = PRELOAD.removeprefix("spindle.")
    with pytest.raises(InvalidInput, match=f"^{short}: {said}"):
        design(flagship, {PRELOAD: ["300 N", "400 N"], short: ["500 N"]})
    file = tmp_path / "twice.yaml"
    file.write_text(f"case: mfw2310\nvary:\n  {PRELOAD}: [300 N, 400 N]\n  {short}: [500 N]\n")
    with pytest.raises(InvalidInput, match=f"twice.yaml:4:3: vary.{short}: {said}"):
        read_study(file)


@pytest.mark.parametrize(("log", "numpy"), [(False, np.linspace), (True, np.geomspace)])
def test_a_span_is_what_numpy_spreads(flagship: Case, *, log: bool, numpy: Any) -> None:
    """To half a unit of the 15th digit, and what numpy rounds itself."""
    found = design(flagship, {PRELOAD: Span(123.0, 987.0, 777, log)}).parameters[0].values
    np.testing.assert_allclose([*found], numpy(123.0, 987.0, 777), rtol=5.5e-15)
    assert (found[0], found[-1], found[1:3]) == (123.0, 987.0, [*found][1:3])
    for count in (2, 5, 30, 31, 3000):
        balls = Span(10, 40, count, log)
        whole = design(flagship, {"spindle.bearings.*.model.balls": balls}).parameters[0].values
        assert [*whole] == sorted({round(each) for each in numpy(10.0, 40.0, count)})


def test_points_of_any_number_are_numbered_one_by_one(flagship: Case) -> None:
    """Of 10³⁶ points none is kept: the last one has the last value of every path."""
    many = {p: Span(300.0, 500.0, 10**12) for p in (PRELOAD, PRELOAD.replace("front", "rear"))}
    found = design(flagship, {**many, TRAVEL: Span(1e-6, 1e-4, 10**12)})
    assert found.count == 10**36
    assert [*found.point(10**36 - 1).values()] == [500.0, 500.0, 1e-4]
    assert [*found.point(10**24).values()] == [found.parameters[0].values[1], 300.0, 1e-6]
    assert [*found.point(10**12).values()][1:] == [found.parameters[1].values[1], 1e-6]


def test_values_in_step(flagship: Case) -> None:
    rows = design(flagship, {PRELOAD: [300, 400], TRAVEL: ["50 um", "60 um"]}, "list")
    assert (rows.dims, rows.shape) == (("point",), (2,))
    assert rows.labels(1) == {PRELOAD: 400.0, TRAVEL: pytest.approx(60e-6)}


def test_values_in_step_may_repeat_and_stay_numbers(flagship: Case) -> None:
    rows = design(flagship, {PRELOAD: [300, 300, 400], TRAVEL: ["50 um", "60 um", 6e-5]}, "list")
    assert [rows.labels(k)[PRELOAD] for k in range(3)] == [300.0, 300.0, 400.0]
    assert rows.parameters[1].unit == "m"


def test_numbers_beside_words_keep_their_unit(flagship: Case) -> None:
    stiffness = "spindle.sleeves.front.spring.stiffness"
    found = design(flagship, {stiffness: [math.inf, 8e6, "9000 N/mm"]}).parameters[0]
    assert found.labels == ("rigid", "8 N/um", "9 N/um")


def test_rows_of_numbers_are_as_they_were_written(flagship: Case) -> None:
    asked = [["0 rpm", "9000 rpm"], (0.0, 10.0), [f"{k} rpm" for k in range(99)]]
    found = design(flagship, {"speeds": asked}).parameters[0]
    assert found.labels[:2] == ("[0 rpm, 9000 rpm]", "[0 rad/s, 10 rad/s]")
    assert found.labels[2].startswith("[0 rpm, 1 rpm, ")
    assert found.labels[2].endswith(" ...]")


@pytest.mark.parametrize("sampling", ["latin-hypercube", "sobol"])
def test_a_sample_fills_its_spans_evenly(flagship: Case, sampling: str) -> None:
    """Each of n equal parts of every span holds one point; by ratio, of its logarithm."""
    asked = {PRELOAD: Span(100.0, 1000.0, log=True), TRAVEL: Span(0.0, 1e-4)}
    asked["conditions.kinematics"] = ["outer", "inner"]
    asked["spindle.bearings.*.model.balls"] = Span(20, 23)
    found = design(flagship, asked, sampling, 64, seed=3)
    points = [found.labels(k) for k in range(64)]
    logs = np.array([math.log10(p[PRELOAD]) - 2.0 for p in points])
    linear = np.array([p[TRAVEL] / 1e-4 for p in points])
    for share in (logs, linear):
        assert sorted(np.floor(share * 64)) == list(range(64))
    for path, values in (
        ("conditions.kinematics", ["outer", "inner"]),
        ("spindle.bearings.*.model.balls", [20, 21, 22, 23]),
    ):
        counts = [sum(p[path] == value for p in points) for value in values]
        assert counts == [64 // len(values)] * len(values)
    again, other = (design(flagship, asked, sampling, 64, seed=s) for s in (3, 4))
    assert again.labels(5) == points[5] != other.labels(5)


def test_models_by_name(flagship: Case) -> None:
    assert flagship.spindle is not None
    path = f"spindle.bearings.{flagship.spindle.seats[0].name}.model"
    grid = design(flagship, {path: ["vex70", "vex60"]})
    assert all(isinstance(v, AngularContactBallBearing) for v in grid.parameters[0].values)
    assert grid.parameters[0].labels == ("vex70", "vex60")


BAD: list[tuple[dict[str, Any], str]] = [
    ({"varied": {}}, "nothing is varied"),
    ({"varied": {"spindle.sleeves.front.spring.preloa": [1]}}, "did you mean preload"),
    ({"varied": {"conditions.temperatures.shft": [40]}}, "did you mean shaft"),
    ({"varied": {"conditions.films.temperature": [40]}}, "also needs viscosity_40"),
    ({"varied": {"tool": ["hsk63_end_mil_10"]}}, "did you mean hsk63_end_mill_10"),
    ({"varied": {PRELOAD: []}}, "the list is empty"),
    ({"varied": {PRELOAD: "300 N"}}, "a list of values or a Span is needed"),
    ({"varied": {PRELOAD: ["300 mm"]}}, "'mm' is not a unit of force"),
    ({"varied": {PRELOAD: [math.nan]}}, PRELOAD),
    ({"varied": {PRELOAD: Span("400 N", "300 N")}}, "from low to high, got 400 N to 300 N"),
    ({"varied": {TRAVEL: Span(0.0, 1e-4, 3, log=True)}}, "by ratio lies above 0"),
    ({"varied": {"conditions.kinematics": Span("a", "b")}}, "conditions.kinematics"),
    ({"varied": {PRELOAD: Span(300, 400)}}, "give the span a count"),
    ({"varied": {PRELOAD: Span(300, 400, 1)}}, "at least 2 points"),
    ({"varied": {PRELOAD: Span(300, 400, 10**16)}}, "at most 1e+15, got 1000000000000"),
    ({"varied": {PRELOAD: Span(300, 400, 10**14)}}, "closer than 15 digits resolve"),
    ({"varied": {PRELOAD: Span(300, 400, 10**8)}, "results": ["preload"]}, "kept as a file"),
    ({"varied": {PRELOAD: Span(300, 400)}, "sampling": "sobol", "samples": 2**30}, "drawn whole"),
    ({"varied": {PRELOAD: [300, "0.3 kN"]}}, "listed twice: given 300 N; allowed: once"),
    ({"varied": {3: [300]}}, "not a dotted path: given 3"),
    ({"varied": {PRELOAD: [1], TRAVEL: [1e-5, 2e-5]}, "sampling": "list"}, "as many values"),
    ({"varied": {PRELOAD: [1]}, "sampling": "sobl"}, "did you mean sobol"),
    ({"varied": {PRELOAD: [1]}, "samples": 4}, "a grid has no samples"),
    ({"varied": {PRELOAD: [1]}, "sampling": "sobol"}, "samples: missing key: sobol needs"),
    ({"varied": {PRELOAD: [1]}, "sampling": "sobol", "samples": 0}, "needs a whole number"),
    ({"varied": {PRELOAD: [1]}, "sampling": "sobol", "samples": 100}, "take 128"),
    ({"varied": {PRELOAD: [1]}, "sampling": "sobol", "samples": 8, "seed": -1}, "seed"),
    ({"varied": {PRELOAD: [300.0]}, "analyses": ["campbel"]}, "analyses: given 'campbel'; this"),
    ({"varied": {PRELOAD: [300.0]}, "results": ["modes"]}, "this study has the analyses"),
    ({"varied": {PRELOAD: [300.0]}, "workers": 0}, "workers"),
]  # fmt: skip


@pytest.mark.parametrize(("asked", "sentence"), BAD, ids=[s for _, s in BAD])
def test_what_cannot_be_is_said_before_anything_is_solved(
    flagship: Case, asked: dict[str, Any], sentence: str
) -> None:
    with pytest.raises(InvalidInput) as told:
        sweep(flagship, **asked)
    assert sentence in str(told.value)
    assert "\n" not in str(told.value)


def test_paths_of_files_are_varied_in_studies(tmp_path: Path) -> None:
    """What a file gives once for all bearings, what the case has not yet, and its tool."""
    machine = "spindle: mfw2310\noverride: {growth: {static: 0 um}, bearings.*.model: kh6014e}\n"
    asked = "speeds: [0 rpm]\nanalyses: {preload: {}}\n"
    (tmp_path / "machine.yaml").write_text(machine + asked)
    varied = """case: ./machine.yaml
vary:
  tool: [hsk63_end_mill_10, ./mine.yaml]
  spindle.fits.shaft: [k5, k6]
  conditions.temperatures.shaft: {from: 20 degC, to: 40 degC, points: 2}
"""
    (tmp_path / "study.yaml").write_text(varied)
    mine = (models_root() / "tools" / "hsk63_end_mill_20.yaml").read_text()
    (tmp_path / "mine.yaml").write_text(mine)
    study = read_study(tmp_path / "study.yaml")
    assert study.design.shape == (2, 2, 2)
    last = f"{machine[:-2]}, fits.shaft: k6}}\ntool: ./mine.yaml\n{asked}"
    last += "conditions: {temperatures: {shaft: 40 degC}}\n"
    (tmp_path / "machine.yaml").write_text(last)
    wanted = rotordyn.load(tmp_path / "machine.yaml")
    made = study.case.vary(study.design.point(7))
    assert (made.spindle, made.conditions) == (wanted.spindle, wanted.conditions)
    assert made.spindle.shaft != study.case.vary(study.design.point(0)).spindle.shaft
