"""A run that is ended, by a signal or by what it may take, keeps and writes what is finished."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import rotordyn
from rotordyn import allowance
from rotordyn.analyses.solving import _solved_in_turn
from rotordyn.case.case import Case
from rotordyn.cli import main
from rotordyn.errors import NoSolution, TooCostly
from rotordyn.job import solving
from rotordyn.scene.spec import Spec
from rotordyn.study.run import run
from tests.rotordyn.test_surroundings import CASE, FRF

CONTROL = f"{CASE}  control: {{max_load: 1 kN}}\n"
MANY = """\
spindle: lalanne_ferraris
speeds: {from: 0 rpm, to: 9000 rpm, count: 700}
analyses:
  frf:
    frequencies: {from: 5 Hz, to: 60 Hz, count: 70000}
    pairs: [{response: disc_1.y, excitation: disc_1.y}]
"""
VARIANTS = f"{FRF}compare: {{a: {{title: a}}, b: {{title: b}}, c: {{title: c}}, d: {{title: d}}}}\n"
UNCERTAIN = """\
spindle: grinding_spindle
speeds: [0 rpm, 8000 rpm]
analyses: {preload: {}}
uncertain: {hypotheses: {moment_sharing: all}}
"""
FIRST = {"frf": ("campbell", FRF), "control": ("bearing", CONTROL)}
OVER = "since 600 s for the whole run are over"
Patch = pytest.MonkeyPatch


def interrupted(*_: object) -> None:
    raise KeyboardInterrupt


def over(*_: object) -> None:
    """Let the time of the run be over."""
    held = allowance._allowance.get()
    assert held is not None
    allowance._allowance.set(replace(held, until=0.0))


def too_late(*_: object) -> None:
    over()
    allowance.require_time("frf", "broken off")


def ended(text: str, folder: Path, *words: str) -> int:
    path = folder / "rotor.yaml"
    path.write_text(text, encoding="utf-8")
    return main(["run", str(path), "-o", str(folder / "out"), "--quiet", *words])


@pytest.mark.parametrize("name", ["frf", "control"])
@pytest.mark.parametrize(
    ("stop", "words", "code", "why"),
    [
        (interrupted, [], 130, "interrupted"),
        (interrupted, ["--yes"], 130, "interrupted"),
        (too_late, [], 2, f"frf: broken off, {OVER}"),
    ],
    ids=["Ctrl-C", "Ctrl-C of a long run", "time"],
)
def test_a_run_that_is_ended_in_an_analysis_keeps_those_before(
    name: str,
    stop: Callable[..., None],
    words: list[str],
    code: int,
    why: str,
    tmp_path: Path,
    monkeypatch: Patch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    first, text = FIRST[name]
    monkeypatch.setattr(f"rotordyn.analyses.{name}.solve.solve", stop)
    assert ended(text, tmp_path, *words) == code
    assert f"not solved: {name} omitted: {why}" in capsys.readouterr().err
    results = rotordyn.open(tmp_path / "out")
    assert list(results) == list(results.case.analyses) == [first]
    assert any(note.startswith("figures omitted: the run was ended") for note in results.notes)
    assert not [*(tmp_path / "out").glob("*.png")]


@pytest.mark.parametrize("name", ["frf", "control"])
def test_a_run_whose_time_is_over_between_analyses_keeps_those_before(
    name: str, tmp_path: Path, monkeypatch: Patch, capsys: pytest.CaptureFixture[str]
) -> None:
    first, text = FIRST[name]
    module = __import__(f"rotordyn.analyses.{first}.solve", fromlist=["solve"])

    def slow(*given: Any, solve: Callable[..., Any] = module.solve) -> Any:
        result = solve(*given)
        over()
        return result

    monkeypatch.setattr(module, "solve", slow)
    assert ended(text, tmp_path) == 2
    assert f"{name}: not begun, {OVER}" in capsys.readouterr().err
    assert list(rotordyn.open(tmp_path / "out")) == [first]


@pytest.mark.parametrize("stop", [interrupted, too_late])
def test_nothing_is_written_where_nothing_is_finished(
    stop: Callable[..., None], tmp_path: Path, monkeypatch: Patch
) -> None:
    monkeypatch.setattr("rotordyn.analyses.campbell.solve.solve", stop)
    assert ended(FRF, tmp_path) in (2, 130)
    assert not (tmp_path / "out").exists()


def test_complete_results_are_not_replaced_by_fewer(
    tmp_path: Path, monkeypatch: Patch, capsys: pytest.CaptureFixture[str]
) -> None:
    """They stay as they are; what was finished is next to them, and gives way to all of it."""
    assert ended(FRF, tmp_path, "--no-figures") == 0
    with monkeypatch.context() as patch:
        patch.setattr("rotordyn.analyses.frf.solve.solve", interrupted)
        assert ended(FRF, tmp_path) == 130
        said = capsys.readouterr().err
        assert f"{tmp_path / 'out'} keeps its earlier results, which are complete: " in said
        assert f"the results are in {tmp_path / 'out_2'}" in said
        (tmp_path / "out").rename(tmp_path / "earlier")
        (tmp_path / "out_2").rename(tmp_path / "out")
        assert ended(FRF, tmp_path) == 130
    held = {path.name: list(rotordyn.open(path)) for path in tmp_path.iterdir() if path.is_dir()}
    assert held == {"earlier": ["campbell", "frf"], "out": ["campbell"]}
    assert ended(FRF, tmp_path, "--no-figures") == 0
    assert list(rotordyn.open(tmp_path / "out")) == ["campbell", "frf"]


@pytest.mark.parametrize(("stop", "code"), [(interrupted, 130), (too_late, 2)])
def test_variants_before_the_end_are_kept(
    stop: Callable[..., None],
    code: int,
    tmp_path: Path,
    monkeypatch: Patch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The sentence and the exit code are those of the end, not of a variant without solution."""

    def solve(case: Case, *given: Any, known: Callable[..., Any] = solving.solve) -> Any:
        if case.title == "a":
            raise NoSolution("no speed has a solution")
        return known(case, *given) if case.title == "b" else stop()

    monkeypatch.setattr(solving, "solve", solve)
    assert ended(VARIANTS, tmp_path) == code
    assert "not solved: variant c and 1 after it omitted: " in capsys.readouterr().err
    results = rotordyn.open(tmp_path / "out")
    assert list(results) == ["b/campbell", "b/frf"]
    assert "variant a: no speed has a solution" in results.unsolved


def test_analyses_of_the_first_variant_are_kept(
    tmp_path: Path, monkeypatch: Patch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("rotordyn.analyses.frf.solve.solve", interrupted)
    assert ended(VARIANTS, tmp_path) == 130
    sentence = "not solved: frf of variant a, variant b and 2 after it omitted: interrupted"
    assert sentence in capsys.readouterr().err
    results = rotordyn.open(tmp_path / "out")
    assert list(results) == ["a/campbell"]
    assert results.plot("campbell")


def test_what_is_finished_before_its_interval_is_kept(tmp_path: Path) -> None:
    """Machines that are not begun any more are not taken as machines without a solution."""
    (tmp_path / "case.yaml").write_text(UNCERTAIN, encoding="utf-8")
    case = rotordyn.load(tmp_path / "case.yaml")

    def progress(name: str) -> None:
        if name.startswith("interval"):
            over()

    with allowance.within(600.0):
        results = run(case, progress, interval=True)
    assert list(results) == ["preload"]
    assert results.held_intervals == {}
    assert results.unsolved[0].startswith("interval omitted: ")
    assert isinstance(results.solution.stop, TooCostly)


def test_python_is_interrupted_as_ever(tmp_path: Path, monkeypatch: Patch) -> None:
    (tmp_path / "case.yaml").write_text(FRF, encoding="utf-8")
    monkeypatch.setattr("rotordyn.analyses.frf.solve.solve", interrupted)
    with pytest.raises(KeyboardInterrupt):
        rotordyn.run(rotordyn.load(tmp_path / "case.yaml"))


def test_what_takes_longer_than_allowed_is_refused_before_it_begins(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, target = tmp_path / "rotor.yaml", tmp_path / "out"
    path.write_text(FRF.replace("62 Hz", "1000000 Hz"), encoding="utf-8")
    argv = ["run", str(path), "-o", str(target), "--no-figures", "--quiet"]
    assert main([*argv, "--longest", "2"]) == 2
    said = capsys.readouterr().err
    assert "DOF take about" in said
    assert "allowed: 2 s for the whole run" in said
    assert not target.exists()
    assert main([*argv, "--longest", "-1"]) == 2


def test_figures_that_take_longer_than_allowed_are_omitted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path, target = tmp_path / "rotor.yaml", tmp_path / "out"
    path.write_text(FRF, encoding="utf-8")
    monkeypatch.setattr("rotordyn.allowance.PICTURE", 1e4)
    assert main(["run", str(path), "-o", str(target)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "figures omitted: 9 figures with 2 pictures in space take about 2e+04 s;" in said
    assert list(rotordyn.open(target)) == ["campbell", "frf"]
    assert not [*target.rglob("*.svg")]


def test_more_responses_than_allowed_are_refused_before_they_are_solved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, target = tmp_path / "rotor.yaml", tmp_path / "out"
    path.write_text(MANY, encoding="utf-8")
    assert main(["run", str(path), "-o", str(target), "--no-figures", "--quiet"]) == 2
    said = capsys.readouterr().err
    assert "700 speeds by 1 pairs by 70000 frequencies take about 34.3 s and 5.9 GB" in said
    assert "allow it with --yes" in said
    assert not target.exists()


FINALISER = """
import os, signal, sys, time
from rotordyn import cli
from rotordyn.cli import signals, solving

class Finalised:
    def __del__(self):
        os.kill(os.getpid(), getattr(signal, sys.argv[1]))
        time.sleep(0.01)

def run(arguments):
    signals.heed_signals()
    Finalised()
    time.sleep(5.0)
    return 0

solving.run = run
sys.exit(cli.main(["run", "case.yaml"]))
"""


SWALLOWED = """
import os, signal, sys
from rotordyn import cli
from rotordyn.cli import signals, solving

def run(arguments):
    signals.heed_signals()
    try:
        os.kill(os.getpid(), signal.SIGINT)
    except KeyboardInterrupt:
        pass
    raise TypeError("Cannot compare structured arrays")

solving.run = run
sys.exit(cli.main(["run", "case.yaml"]))
"""


@pytest.mark.skipif(os.name != "posix", reason="a process sends signals to itself")
def test_a_stop_that_a_library_turns_into_an_error_is_one() -> None:
    """Whether anything is finished by then or not."""
    words = [sys.executable, "-c", SWALLOWED]
    ran = subprocess.run(words, capture_output=True, text=True, timeout=60.0, check=False)
    assert ran.returncode == 130, ran.stderr
    assert ran.stderr.strip() == "interrupted; nothing was written"


def test_what_is_finished_when_a_library_turns_a_stop_into_an_error_is_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def solve(name: str, spec: Spec) -> Any:
        if name == "second":
            raise TypeError("Cannot compare structured arrays")
        return spec

    asked: Any = {"first": 1, "second": 2}
    monkeypatch.setattr(allowance.ASKED, "is_set", lambda: False)
    with allowance.within(), pytest.raises(TypeError):
        _solved_in_turn(asked, solve, lambda _: None)
    monkeypatch.setattr(allowance.ASKED, "is_set", lambda: True)
    with allowance.within():
        results, stop = _solved_in_turn(asked, solve, lambda _: None)
    assert list(results) == ["first"]
    assert isinstance(stop, KeyboardInterrupt)


@pytest.mark.skipif(os.name != "posix", reason="a process sends signals to itself")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_a_stop_within_a_finaliser_is_not_lost(name: str) -> None:
    begin = time.perf_counter()
    words = [sys.executable, "-c", FINALISER, name]
    ran = subprocess.run(words, capture_output=True, text=True, timeout=60.0, check=False)
    assert ran.returncode == 130, ran.stderr
    assert ran.stderr.strip() == "interrupted; nothing was written"
    assert time.perf_counter() - begin < 5.0


def test_speeds_added_to_those_of_the_case_are_reported() -> None:
    with allowance.within(600.0, 1e6), pytest.raises(TooCostly) as caught:
        allowance.require_matrices("bending system", 400, 582, 4)
    assert "582 rows at 400 speeds (4 of the case, others added between them)" in str(caught.value)
