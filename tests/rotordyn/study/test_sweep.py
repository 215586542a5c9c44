"""Studies solved: equal to single runs, complete after any interruption, honest about failures."""

from __future__ import annotations

import gc
import json
import math
import os
import signal
import struct
import subprocess
import sys
import time
import tracemalloc
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn import Goal, Span, optimise, sweep
from rotordyn.analyses import FrfSpec, Port, Unbalance, UnbalanceSpec
from rotordyn.analyses.registry import analysis
from rotordyn.case.case import Case
from rotordyn.case.library import models_root
from rotordyn.cli import main
from rotordyn.errors import InvalidInput, RotordynError
from rotordyn.job import restricted
from rotordyn.scene.checks import Checks
from rotordyn.scene.refinement import solve_accurately
from rotordyn.study import deliver, neighbours, point, processes, solve, workers
from rotordyn.study.journal import Journal
from rotordyn.study.optimum.summary import summary as trials_in_words
from rotordyn.study.point import Outcome
from rotordyn.study.read import read_study
from rotordyn.study.solve import study_of
from rotordyn.study.summary import summary
from rotordyn.whole import locked

SPRING = "spindle.sleeves.rear.spring.preload"
BALLS = "spindle.bearings.*.model.balls"
ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def case() -> Case:
    whole = rotordyn.load("grinding_spindle")
    return rotordyn.vary(whole, {"speeds": (0.0, 400.0 * math.pi)})


SPRINGS = {SPRING: Span(800.0, 1600.0, 16)}


@pytest.fixture(scope="module")
def alone(case: Case) -> Any:
    """``SPRINGS`` solved by one process that nobody kills."""
    return sweep(case, SPRINGS, analyses=["preload"], workers=1)


def _study(case: Case, **how: Any) -> Any:
    asked = {SPRING: ["800 N", 1200.0], "conditions.kinematics": ["outer", "hybrid"]}
    return sweep(case, asked, analyses=["preload", "campbell"], **how)


@pytest.fixture(scope="module")
def whole(case: Case) -> Any:
    """``_study`` solved by one process that nobody stops."""
    return _study(case, workers=1)


def same(one: Any, other: Any) -> None:
    """Twelve digits: a process that solves many points takes the compiled solver of bearings."""
    assert set(one.variables) == set(other.variables)
    for name, values in one.variables.items():
        if values.dtype.kind == "f":
            np.testing.assert_allclose(values, other[name], rtol=1e-12, atol=1e-15)
        else:
            assert (values.values == other[name].values).all()


def test_a_point_is_a_single_run(case: Case) -> None:
    """To twelve digits: some points are rows of one batch."""
    found = _study(case, workers=1, results=["campbell"])
    case = restricted(case, ("preload", "campbell"))
    assert found.sizes[SPRING] == found.sizes["conditions.kinematics"] == 2
    assert found[SPRING].values.tolist() == [800.0, 1200.0]
    assert found[SPRING].attrs["units"] == "N"
    for spring in (800.0, 1200.0):
        for law in ("outer", "hybrid"):
            changes = {SPRING: spring, "conditions.kinematics": law}
            alone = rotordyn.run(rotordyn.vary(case, changes))
            here = found.sel(changes)
            numbers = analysis("campbell").numbers(alone.parts[""].results["campbell"], case)
            for number in numbers:
                name = f"campbell: {number.heading.removesuffix(f' [{number.unit}]')}"
                assert float(here[name]) == pytest.approx(number.value, rel=1e-12, nan_ok=True)
            whole, single = here["campbell: frequency"].values, alone["campbell"]["frequency"]
            np.testing.assert_allclose(whole, single.values, rtol=1e-12)


def test_results_are_kept_whole_where_points_have_other_critical_speeds(case: Case) -> None:
    """A mode that several orders excite is listed several times, the first of each in line."""
    asked = [(0.0, 200.0 * math.pi), (0.0, 400.0 * math.pi)]
    alone = restricted(case, ("campbell",)).vary({"analyses.campbell.engine_orders": (3, 4, 8)})
    found = sweep(alone, {"speeds": asked}, results=["campbell"], workers=1)
    every = [*found["campbell: critical"].values]
    lengths = set()
    for k, speeds in enumerate(asked):
        expected = rotordyn.run(alone.vary({"speeds": speeds}))["campbell"]
        orders = [*expected["critical"].values]
        lengths.add(len(orders))
        seen = {order: iter(np.flatnonzero(np.array(every) == order)) for order in orders}
        places = [next(seen[order]) for order in orders]
        speed = found["campbell: critical_speed"].isel(speeds=k).values
        np.testing.assert_allclose(speed[places], expected["critical_speed"], rtol=1e-9)
        assert np.isnan(np.delete(speed, places)).all()
    assert len(lengths) == 2
    assert len(set(every)) < len(every)


@pytest.mark.parametrize("sampling", ["grid", "list"])
def test_results_with_a_dimension_called_point_are_kept_whole(sampling: str) -> None:
    """As of a response to unbalance, also at points whose error is not estimated."""
    case = rotordyn.load("friswell_unbalance").vary({"variants": {}, "speeds": (0.0, 50.0, 100.0)})
    width = "spindle.discs.left disc.width"
    found = sweep(
        case, {width: [0.07, 0.075, 0.08]}, sampling=sampling, results=["unbalance"], workers=1
    )
    assert (found["sentence"] == "").all()
    for k, value in enumerate(found[width].values):
        alone = rotordyn.run(case.vary({width: float(value)}))["unbalance"]
        here = found["unbalance: major_axis"].isel({width if sampling == "grid" else "point": k})
        assert here.dims == ("unbalance: speed", "unbalance: point")
        assert found["unbalance: point"].values.tolist() == alone["point"].values.tolist()
        np.testing.assert_allclose(here, alone["major_axis"], rtol=1e-5)


def test_analyses_without_headline_numbers_are_solved_and_kept(case: Case, tmp_path: Path) -> None:
    """Such as responses of which none is measured; also where the study goes on."""
    study = study_of(case, {SPRING: ["800 N", "1 kN"]}, analyses=["frf"], results=["frf"])
    for _ in range(2):
        left = deliver.deliver(study, tmp_path / "s", workers=1, draw=False)
        assert left.points == left.solved == 2
        assert "2 points, 2 with a solution" in left.summary
        found, outcomes = solve.solved(study, 1, folder=tmp_path / "s")
        assert all(each.solved and not each.numbers for each in outcomes.values())
        assert np.isfinite(found["frf: receptance"]).all()


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("small", "most", "checked"),
    [
        (0.5, 3, [0, 3]),
        (1e-9, 3, [0, 1, 2, 3, 4]),
        ("twice", 9, [0, 4]),
        ("a little", 9, [0, 2, 4]),
    ],
)
def test_some_points_are_checked_and_all_where_errors_are_large(
    case: Case, monkeypatch: pytest.MonkeyPatch, small: float | str, most: int, checked: list[int]
) -> None:
    """And numbers are those of single runs. An error of twice or a little below the share that
    represents two machines: it represents four or for two."""
    asked = {SPRING: Span(800.0, 1600.0, 5)}
    study = study_of(case, asked, analyses=["preload", "campbell"])
    packed = workers.pack(study)
    point._unpacked.cache_clear()
    (first,) = point.solve_points(packed, (4,))
    assert first.error is not None
    shares = {"twice": 2.02 * first.error, "a little": 1.3 * first.error}
    monkeypatch.setattr(neighbours, "SMALL", shares[small] if isinstance(small, str) else small)
    monkeypatch.setattr(neighbours, "PER_CHECK", 2)
    monkeypatch.setattr(neighbours, "MOST", most)
    point._unpacked.cache_clear()
    found = point.solve_points(packed, range(5))
    assert [each.number for each in found if each.error is not None] == checked
    assert all(0.0 < each.error < 1.0 for each in found if each.error is not None)
    alone = {name: value for name, (value, _) in first.numbers.items()}
    here = {name: value for name, (value, _) in found[4].numbers.items()}
    assert here == pytest.approx(alone, rel=1e-12, nan_ok=True)
    said = summary(study, {each.number: each for each in found})
    assert f"errors by refinement, at {len(checked)} points: at most" in said


def test_warnings_are_counted_by_points(case: Case) -> None:
    """A point may have several of one kind."""
    study = study_of(case, {SPRING: [800.0, 1200.0]}, analyses=["preload"])
    both = ("bearing a: 1 GPa is much", "bearing a: 2 GPa is much")
    found = {k: Outcome(k, {"sum": (1.0, "N")}, warnings=both) for k in range(2)}
    assert "WARNING (2 points, such as): bearing a: 1 GPa is much" in summary(study, found)
    found[1] = Outcome(1, {"sum": (1.0, "N")})
    assert "WARNING (1 point, such as): bearing a: 1 GPa is much" in summary(study, found)


def test_several_processes_give_the_same(case: Case, whole: Any) -> None:
    same(whole, _study(case, workers=2))


def test_what_cannot_be_solved_is_nan_beside_its_sentence(case: Case) -> None:
    found = sweep(case, {BALLS: [20, 60]}, analyses=["preload"], workers=1)
    words = found["sentence"].values.tolist()
    assert words[0] == ""
    assert words[1].endswith("60 balls of 9.525 mm overlap on a pitch circle of 90 mm")
    numbers = [name for name in found.data_vars if name.startswith("preload: sum")]
    assert numbers
    for name in numbers:
        assert np.isfinite(found[name].values).tolist() == [True, False]


def test_a_study_goes_on_where_it_was_stopped(case: Case, whole: Any, tmp_path: Path) -> None:
    _study(case, workers=1, folder=tmp_path / "s")
    journal = tmp_path / "s" / "points.jsonl"
    lines = journal.read_bytes().splitlines(keepends=True)
    journal.write_bytes(lines[0][:9])  # cut short while it was begun
    _study(case, workers=1, folder=tmp_path / "s")
    assert [json.loads(line)["point"] for line in journal.read_bytes().splitlines()[1:]] == [
        *range(4)
    ]
    journal.write_bytes(b"".join(lines[:3]) + lines[3][:40])  # cut short while it was written
    done: list[int] = []
    again = _study(case, workers=1, folder=tmp_path / "s", progress=lambda k, _: done.append(k))
    assert done == [2, 3, 4]
    same(again, whole)
    points = [json.loads(line)["point"] for line in journal.read_text().splitlines()[1:]]
    assert sorted(points) == [0, 1, 2, 3]


def test_numbers_that_are_not_finite_are_strict_json(case: Case, tmp_path: Path) -> None:
    """And lines of before, in the words of Python, are read still."""
    study, folder = study_of(case, {SPRING: ["800 N"]}, analyses=["preload"]), tmp_path / "s"
    numbers = {"a": (math.inf, "N"), "b": (-math.inf, "N"), "c": (math.nan, "N"), "d": (0.1, "")}
    Journal(folder, study).begin()
    Journal(folder, study).add(Outcome(0, numbers, error=math.inf))
    text = (folder / "points.jsonl").read_text()
    for line in text.splitlines():
        json.loads(line, parse_constant=pytest.fail)
    before = text.replace('"NaN"', "NaN").replace('"-Inf', "-Inf").replace('inity"', "inity")
    for written in (text, before.replace('"Inf', "Inf")):
        (folder / "points.jsonl").write_text(written)
        assert repr(Journal(folder, study).begin()[0]) == repr(Outcome(0, numbers, error=math.inf))


def test_folders_of_others_are_refused(case: Case, tmp_path: Path) -> None:
    _study(case, workers=1, folder=tmp_path / "s")
    with pytest.raises(InvalidInput, match="the points of another study"):
        sweep(case, {SPRING: ["800 N"]}, analyses=["preload"], folder=tmp_path / "s")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("keep")
    with pytest.raises(InvalidInput, match="and no study"):
        _study(case, folder=tmp_path / "mine")
    (tmp_path / "odd").mkdir()
    for words in ("[1, 2]\n", "notes"):
        (tmp_path / "odd" / "points.jsonl").write_text(words)
        with pytest.raises(InvalidInput):
            _study(case, folder=tmp_path / "odd")
        assert (tmp_path / "odd" / "points.jsonl").read_text() == words
    assert os.listdir(tmp_path / "mine") == ["notes.txt"]


def test_a_folder_is_one_process_at_a_time(case: Case, tmp_path: Path) -> None:
    pytest.importorskip("fcntl", reason="this system has no locks")
    held = locked(tmp_path)
    with pytest.raises(InvalidInput, match="another process solves the points of a study there"):
        _study(case, folder=tmp_path)
    with pytest.raises(InvalidInput, match="another process solves the trials of a study there"):
        optimise(case, {SPRING: Span(1.0, 9.0)}, [Goal(lowest="preload: sum")], folder=tmp_path)
    assert held is not None
    os.close(held)
    (tmp_path / "file").touch()
    with pytest.raises(InvalidInput, match="file: cannot be written"):
        _study(case, folder=tmp_path / "file")


def test_a_point_without_its_results_is_no_point(case: Case, tmp_path: Path) -> None:
    study = study_of(case, {SPRING: ["800 N"]}, analyses=["preload"], results=["preload"])
    solved = Outcome(0, {"preload: sum": (800.0, "N")})
    journal = Journal(tmp_path / "s", study)
    assert journal.begin() == {}
    journal.add(solved)
    assert journal.begin() == {}
    (tmp_path / "s" / "points").mkdir()
    (tmp_path / "s" / "points" / "00000000.nc").write_bytes(b"half of it")
    assert journal.begin() == {0: solved}
    with pytest.raises(InvalidInput, match=r"00000000\.nc: cannot be read: remove it"):
        journal.datasets(solved)


def test_points_without_numbers_are_solved_and_kept(case: Case, tmp_path: Path) -> None:
    """A receptance without a measured one beside it has no headline number; its results are kept
    whole all the same, and read again where the study goes on."""
    nose = Port("nose", "y")
    curves = replace(case, analyses={"frf": FrfSpec((10.0, 100.0), ((nose, nose),))})
    asked = {SPRING: ["800 N", "1000 N"]}
    study = study_of(curves, asked, results=["frf"])
    for _ in range(2):
        done = deliver.deliver(study, tmp_path / "s", workers=1, draw=False)
        assert (done.points, done.solved) == (2, 2)
        assert "2 points, 2 with a solution" in done.summary
        found = sweep(curves, asked, results=["frf"], workers=1, folder=tmp_path / "s")
        still = found["frf: receptance"].isel({"frf: frequency": 0, "frf: speed": 0})
        soft, stiff = np.abs(still.values).ravel()
        assert stiff < soft


def test_unbalance_of_points_whose_error_is_not_known(case: Case) -> None:
    """Only some points are checked by a finer model."""
    spec = UnbalanceSpec(("nose",), (Unbalance("nose", 1e-6),))
    spinning = replace(case, analyses={"unbalance": spec})
    found = sweep(spinning, {SPRING: [800.0, 900.0, 1000.0, 1100.0]}, workers=1)
    assert found["sentence"].values.tolist() == [""] * 4
    assert found["warnings"].values.tolist() == [0] * 4


def test_a_full_disk_is_said(monkeypatch: pytest.MonkeyPatch, case: Case, tmp_path: Path) -> None:
    study = study_of(case, {SPRING: ["800 N"]}, analyses=["preload"])
    journal = Journal(tmp_path / "s", study)
    assert journal.begin() == {}
    journal.add(Outcome(0, {"preload: sum": (800.0, "N")}))
    usage = SimpleNamespace(free=1000)
    monkeypatch.setattr(deliver.shutil, "disk_usage", lambda folder: usage)
    with pytest.raises(InvalidInput, match=r"s: cannot be written: No space left"):
        deliver.deliver(study, tmp_path / "s", draw=False)
    assert os.listdir(tmp_path / "s") == ["points.jsonl"]


def test_models_are_beside_the_file_of_the_study(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine.yaml").write_text((models_root() / "bearings" / "vex70.yaml").read_text())
    vary = "vary:\n  spindle.bearings.*.model: [./mine.yaml, s6014e]\n"
    (tmp_path / "models.yaml").write_text(f"case: grinding_spindle\n{vary}")
    monkeypatch.chdir("/")
    found = read_study(tmp_path / "models.yaml").design.parameters[0]
    assert found.values[0] == rotordyn.model("bearings", "vex70")


def test_a_long_study_asks_first(
    case: Case, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """And leaves its folder to another one, unless that holds points of a study let go on."""
    monkeypatch.setattr(solve, "LONG", 1e-3)
    how: Any = {"analyses": ["preload"], "workers": 1, "folder": tmp_path / "s"}
    asked = {SPRING: Span(800.0, 1600.0, 4)}
    with pytest.raises(InvalidInput, match=r"4 points, 1 of them to solve: about .* h with 1 work"):
        sweep(case, asked, **how)
    assert not (tmp_path / "s").exists()
    assert sweep(case, asked, **how, yes=True)["sentence"].values.tolist() == [""] * 4
    (tmp_path / "s" / "points.jsonl").write_text(
        "\n".join((tmp_path / "s" / "points.jsonl").read_text().splitlines()[:3]) + "\n"
    )
    monkeypatch.setattr(solve, "LOOKED", 1)
    with pytest.raises(InvalidInput, match=r"4 points, 1 of them to solve"):
        sweep(case, asked, **how)
    assert len((tmp_path / "s" / "points.jsonl").read_text().splitlines()) == 4


def test_a_refusal_ends_what_is_still_solved(case: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    """At once, also while somebody holds on to the refusal."""
    monkeypatch.setattr(solve, "LONG", 1e-6)
    ended: list[int] = []
    end = processes.Process.end

    def noted(process: processes.Process) -> None:
        ended.append(1)
        end(process)

    monkeypatch.setattr(processes.Process, "end", noted)
    many = {SPRING: Span(800.0, 1600.0, 400)}
    with pytest.raises(InvalidInput, match="to solve") as refusal:
        sweep(case, many, analyses=["preload"], workers=2)
    assert ended, refusal


def test_a_thousand_million_points_ask_first_and_begin_at_once(case: Case) -> None:
    huge = {SPRING: Span(800.0, 1600.0, 10**6), "spindle.points.nose": Span(0.0, 0.01, 1000)}
    said = r"1000000000 points, 999999997 of them to solve: about .* (years|days) with 2 workers, "
    tracemalloc.start()
    with pytest.raises(InvalidInput, match=rf"{said}.* on disk \(.* are free\) and .* of memory"):
        sweep(case, huge, analyses=["preload"], workers=2)

    def enough(done: int, of: int) -> None:
        if done == 4:
            assert of == 10**9
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(case, huge, analyses=["preload"], workers=1, yes=True, progress=enough)
    assert tracemalloc.get_traced_memory()[1] < 5e7
    tracemalloc.stop()


def test_killed_processes_are_replaced(case: Case, alone: Any, tmp_path: Path) -> None:
    """A worker is killed while it solves: its points are solved by another, none twice."""
    killed: list[int] = []
    done: list[int] = []

    def progress(k: int, _: int) -> None:
        done.append(k)
        search = ["pgrep", "-P", str(os.getpid()), "-f", "popen_loky"]
        running = subprocess.run(search, capture_output=True, text=True, check=False)
        children = running.stdout.split()
        if k > 2 and children and not killed:
            killed.append(int(children[0]))
            os.kill(killed[0], signal.SIGKILL)

    how: Any = {"analyses": ["preload"], "folder": tmp_path / "s"}
    found = sweep(case, SPRINGS, workers=2, progress=progress, **how)
    assert killed
    assert (found["sentence"].values == "").all()
    lines = (tmp_path / "s" / "points.jsonl").read_text().splitlines()[1:]
    assert sorted(json.loads(line)["point"] for line in lines) == list(range(16))
    same(found, alone)


@pytest.mark.long
def test_too_many_killed_processes_are_no_endless_loop() -> None:
    with pytest.raises(RotordynError, match="take fewer workers"):
        list(workers.solved_here(b"", [0, 1], 2, _dies))


def _dies(packed: bytes, number: int, points: int) -> Outcome:
    os.kill(os.getpid(), signal.SIGKILL)
    return Outcome(number)


def test_a_process_killed_within_its_answer_is_noticed(tmp_path: Path) -> None:
    """Half a result is in the pipe, and the other process still works."""
    found = workers.solved_here(str(tmp_path).encode(), [0, 1, 2], 2, _dies_within)
    assert sorted(each.number for each in found) == [0, 1, 2]
    assert (tmp_path / "killed").exists()


def _dies_within(packed: bytes, number: int, points: int) -> Outcome:
    once = Path(packed.decode()) / "killed"
    if number == 0 and not once.exists():
        once.touch()
        (pipe,) = (each for each in gc.get_objects() if isinstance(each, Connection))
        os.write(pipe.fileno(), struct.pack("!i", 1000) + b"half")
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.1)
    return Outcome(number)


@pytest.mark.long
def test_an_error_of_a_process_is_raised_here() -> None:
    with pytest.raises(InvalidInput, match="point 1 is none"):
        list(workers.solved_here(b"", [0, 1], 2, _refuses))


def _refuses(packed: bytes, number: int, points: int) -> Outcome:
    raise InvalidInput(f"point {max(number, 1)} is none")


STUDY = f"""
title: springs
case: {ROOT / "cases" / "grinding_spindle.yaml"}
vary:
  {SPRING}: {{from: 800 N, to: 1600 N, points: 40}}
analyses: [preload]
"""


def _command(*words: str, cwd: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "rotordyn", *words],
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        start_new_session=True,
    )


@pytest.mark.long
def test_killed_three_times_none_is_lost_none_computed_twice(tmp_path: Path) -> None:
    (tmp_path / "springs.yaml").write_text(STUDY)
    journal = tmp_path / "out" / "springs" / "points.jsonl"
    for wanted in (3, 9, 20):
        running = _command("sweep", "springs.yaml", "--quiet", "--workers", "1", cwd=tmp_path)
        while running.poll() is None:
            if journal.exists() and journal.read_bytes().count(b"\n") > wanted:
                os.killpg(running.pid, signal.SIGKILL)
                break
            time.sleep(0.002)
        running.communicate()
    last = _command("sweep", "springs.yaml", "--workers", "1", cwd=tmp_path)
    said, complaints = last.communicate()
    assert last.returncode == 0, complaints
    assert "40 points, 40 with a solution" in said
    lines = journal.read_text().splitlines()[1:]
    assert sorted(json.loads(line)["point"] for line in lines) == list(range(40))
    found = sorted(p.name for p in journal.parent.iterdir())
    assert found == ["points.csv", "points.jsonl", "study.nc", "study_preload.png", "summary.txt"]


def test_an_interrupted_study_says_that_it_goes_on(tmp_path: Path) -> None:
    (tmp_path / "springs.yaml").write_text(STUDY.replace("points: 40", "points: 4000"))
    running = _command("sweep", "springs.yaml", "--workers", "1", "--yes", cwd=tmp_path)
    journal = tmp_path / "out" / "springs" / "points.jsonl"
    while not journal.exists() or journal.read_bytes().count(b"\n") < 3:
        assert running.poll() is None
        time.sleep(0.01)
    running.send_signal(signal.SIGTERM)
    _, complaints = running.communicate()
    assert running.returncode == 130
    assert "the same command goes on" in complaints


def test_faults_of_a_study_file_have_their_lines(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = STUDY.replace("800 N", "800 mm").replace("springs", "springs\nsampling: sobl")
    (tmp_path / "bad.yaml").write_text(text)
    assert main(["sweep", "bad.yaml"]) == 2
    said, complaints = capsys.readouterr()
    assert said == ""
    assert "bad.yaml:3:" in complaints
    assert "did you mean sobol" in complaints
    (tmp_path / "bad.yaml").write_text(STUDY.replace("800 N", "800 mm"))
    assert main(["sweep", "bad.yaml"]) == 2
    assert "'mm' is not a unit of force" in capsys.readouterr().err
    (tmp_path / "bad.yaml").write_text(STUDY.replace(", points: 40", ""))
    assert main(["sweep", "bad.yaml"]) == 2
    told = capsys.readouterr().err
    assert f"bad.yaml:5:40: vary.{SPRING}: a grid needs values" in told
    assert "give the span a count (points, in a file)" in told
    assert not (tmp_path / "out").exists()


@pytest.mark.long
def test_on_a_cluster_of_processes_even_if_one_is_lost(case: Case, alone: Any) -> None:
    from distributed import LocalCluster

    killed: list[int] = []
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:

        def progress(k: int, _: int) -> None:
            if k == 5 and not killed:
                killed.append(next(iter(cluster.workers.values())).process.process.pid)
                os.kill(killed[0], signal.SIGKILL)

        address = cluster.scheduler_address
        found = sweep(case, SPRINGS, analyses=["preload"], cluster=address, progress=progress)
    assert killed
    same(found, alone)


def test_a_scheduler_that_is_not_there(
    case: Case, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(workers, "PATIENCE", "200ms")
    how: Any = {"analyses": ["preload"], "folder": tmp_path / "s", "cluster": "tcp://127.0.0.1:9"}
    with pytest.raises(InvalidInput, match=r"no scheduler answers at 'tcp://127\.0\.0\.1:9'"):
        sweep(case, {SPRING: [800.0, 900.0]}, **how)
    assert not (tmp_path / "s").exists()


def test_processes_that_were_started_before_are_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """And no more of them than are requested; one process is none."""
    monkeypatch.setattr(processes, "_idle", [])
    processes.start(1)
    assert processes._idle == []
    processes.start(2)
    processes.start(2)
    begun = [*processes._idle]
    assert len(begun) == 2
    monkeypatch.setattr(processes, "Process", None)
    found = [*processes.side_by_side(2, iter([(math.sqrt, (4.0,)), (math.sqrt, (9.0,))]))]
    assert sorted(found) == [2.0, 3.0]
    for each in begun:
        each.end()


def test_what_an_analysis_is_asked_is_varied_too() -> None:
    """Also of those that numbers alone ask less of."""
    whole = rotordyn.load("mfw2310_radial_stiffness")
    case = rotordyn.vary(whole, {"speeds": (0.0, 2500.0)})
    forces = {"analyses.stiffness.max_force": [400.0, 500.0]}
    found = sweep(case, forces, analyses=["stiffness"], workers=1)
    assert found["sentence"].values.tolist() == ["", ""]


@pytest.mark.parametrize(
    "varied",
    [
        {"spindle.sleeves.front.spring.preload": [500.0, 600.0]},
        {"analyses.campbell.max_frequency": [900.0, 1000.0]},
    ],
)
def test_points_are_asked_for_numbers_alone(
    varied: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Shapes cost time and are no numbers; but where results are kept whole they are part of it."""
    whole = restricted(rotordyn.load("mfw2310"), ("campbell",))
    case = rotordyn.vary(whole, {"speeds": (0.0, 2500.0)})
    asked, solve = list[bool](), neighbours.Neighbours.solve

    def spied(self: neighbours.Neighbours, case: Any, **how: Any) -> Any:
        asked.append(case.analyses["campbell"].shapes)
        return solve(self, case, **how)

    monkeypatch.setattr(neighbours.Neighbours, "solve", spied)
    for results in ((), ("campbell",)):
        sweep(case, varied, results=results, workers=1)
    assert case.analyses["campbell"].shapes
    assert asked == [False, False, True, True]


@pytest.mark.long
def test_heat_that_flows_otherwise_leads_to_another_state() -> None:
    """A machine after another, and before it."""
    warm = restricted(rotordyn.load("grinding_spindle_warm"), ("preload",))
    whole = rotordyn.vary(warm, {"speeds": warm.speeds[::7]})
    asked = {"conditions.heat_flow.inner_shaft": [3.0, 1.0, 10.0]}
    found = sweep(whole, asked, workers=1)
    names = [name for name in found.data_vars if str(name).startswith("preload: ")]
    assert any(len({*found[name].values.tolist()}) == 3 for name in names)
    for k, value in enumerate(asked["conditions.heat_flow.inner_shaft"]):
        alone = sweep(whole, {"conditions.heat_flow.inner_shaft": [value]}, workers=1)
        for name in names:
            expected = float(alone[name].values[0])
            assert found[name].values[k] == pytest.approx(expected, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize(
    ("seconds", "workers", "most"), [(0.3, 1, 6), (0.3, 2, 6), (1e-4, 1, 32), (1e-4, 2, 32)]
)
def test_blocks_are_as_long_as_their_points_allow(
    case: Case, monkeypatch: pytest.MonkeyPatch, seconds: float, workers: int, most: int
) -> None:
    """Points of 0.3 s, of which two are refused at once: blocks of two seconds at most; and those
    of next to no time in blocks of the largest size."""
    blocks: list[int] = []

    def made(packed: bytes, numbers: Any, points: int = 1) -> Any:
        blocks.append(len(numbers))
        return [
            Outcome(n, sentence="no", seconds=1e-6, solved=False)
            if n in (0, 2)
            else Outcome(n, {"a": (1.0, "")}, seconds=seconds)
            for n in numbers
        ]

    def one_by_one(packed: Any, items: Any, workers: int, task: Any, total: int) -> Any:
        return (task(packed, item, total) for item in items)

    monkeypatch.setattr(solve, "solve_points", made)
    monkeypatch.setattr(solve, "solved_here", one_by_one)
    monkeypatch.setattr(solve, "start", lambda count: None)
    springs = {SPRING: Span(800.0, 1600.0, 400)}
    sweep(case, springs, analyses=["preload"], workers=workers)
    assert sum(blocks) == 400
    assert max(blocks) == most
    assert workers == 1 or blocks[-1] == 1  # the last ones are shared


@pytest.mark.parametrize("workers", [1, 2])
def test_blocks_of_refused_points_grow(
    case: Case, monkeypatch: pytest.MonkeyPatch, workers: int
) -> None:
    """How long others take is not known then, but asking for each costs more than refusing it."""
    blocks: list[int] = []

    def refused(packed: bytes, numbers: Any, points: int = 1) -> Any:
        blocks.append(len(numbers))
        return [Outcome(n, sentence="no", seconds=1e-6, solved=False) for n in numbers]

    monkeypatch.setattr(solve, "solve_points", refused)
    monkeypatch.setattr(
        solve, "solved_here", lambda packed, items, _, task, total: (task(packed, i) for i in items)
    )
    monkeypatch.setattr(solve, "start", lambda count: None)
    springs = {SPRING: Span(800.0, 1600.0, 400)}
    sweep(case, springs, analyses=["preload"], workers=workers)
    assert sum(blocks) == 400
    assert blocks[:5] == [1, 1, 1, 3, 6]
    assert max(blocks) == 32


def test_a_model_for_something_else_is_checked_again(case: Case) -> None:
    held, asked = neighbours.Neighbours(), restricted(case, ("campbell",))
    errors = []
    for accuracy in (1e-3, 1e-3, 1e-4, 1e-4):
        one = rotordyn.vary(asked, {"conditions.accuracy": accuracy})
        errors.append(held.solve(one)[1])
    assert [error is None for error in errors] == [False, True, False, True]


@pytest.mark.parametrize(("accuracy", "checked"), [(1e-6, 1), (5e-8, 4)])
def test_every_machine_of_a_tight_accuracy_is_checked(
    case: Case, monkeypatch: pytest.MonkeyPatch, accuracy: float, checked: int
) -> None:
    """A small error of the first represents others of any usual accuracy."""

    def solved(*_: Any, checks: Any, **__: Any) -> None:
        checks.worst = checks.first = 1e-3

    monkeypatch.setattr(neighbours, "solve", solved)
    held, asked = neighbours.Neighbours(), rotordyn.vary(case, {"conditions.accuracy": accuracy})
    assert sum(held.solve(asked)[1] is not None for _ in range(4)) == checked


def test_what_a_first_model_lacked_is_looked_for_in_the_next_machine(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It begins with that model; the reported error is that of the finer one."""

    def solved(*_: Any, checks: Any, **__: Any) -> None:
        checks.first, checks.worst = 5.0, 1e-3

    monkeypatch.setattr(neighbours, "solve", solved)
    held = neighbours.Neighbours()
    assert [held.solve(case)[1] for _ in range(3)] == [1e-3] * 3


@pytest.mark.parametrize(
    ("found", "first", "worst", "answers"),
    [((0.1,), 0.1, 0.1, 0), ((5.0, 0.5), 5.0, 0.5, 1), ((5.0, 2.0), 5.0, 2.0, 2)],
)
def test_the_error_is_that_of_the_model_that_answers(
    found: tuple[float, ...], first: float, worst: float, answers: int
) -> None:
    errors = dict(enumerate(found))

    def scene(number: int) -> Any:
        conditions = SimpleNamespace(accuracy=0.1, element_length=None)
        one = SimpleNamespace(checks=checks, conditions=conditions, number=number)
        one.refined = scene(number + 1) if number < 2 else None
        return one

    checks = Checks()
    _, solution = solve_accurately(scene(0), lambda one: one.number, errors.__getitem__)
    assert (checks.first, checks.worst, solution) == (first, worst, answers)


def test_the_same_study_again_begins_with_a_check(case: Case) -> None:
    study = study_of(case, {SPRING: [800.0, 1200.0]}, analyses=["campbell"])
    for _ in range(2):
        _, found = solve.solved(study, workers=1)
        assert [found[k].error is None for k in range(2)] == [False, True]


LOBES = """
spindle: mfw2310
tool: hsk63_end_mill_20
conditions: {kinematics: outer, moment_sharing: equal}
speeds: [0 rpm, 24000 rpm]
analyses:
  stability_lobes:
    {point: tip, teeth: 3, workpiece: al7075, milling: down, immersion: 25 %,
     method: zero-order, speeds: [22000 rpm]}
"""


@pytest.mark.parametrize(
    ("path", "kind", "names"),
    [
        ("analyses.stability_lobes.workpiece", "workpieces", ("al7075", "steel_1045")),
        ("spindle.bearings.*.model.ball_material", "materials", ("silicon_nitride", "tool_steel")),
        ("spindle.shaft.sections.*.material", "materials", ("steel_rotor", "tool_steel")),
    ],
)
def test_names_of_workpieces_and_materials_are_values(
    tmp_path: Path, path: str, kind: Any, names: tuple[str, str]
) -> None:
    """The second by its file, from the folder of the study."""
    (tmp_path / "lobes.yaml").write_text(LOBES)
    (tmp_path / "mine.yaml").write_text((models_root() / kind / f"{names[1]}.yaml").read_text())
    vary = f"vary:\n  {path}: [{names[0]}, ./mine.yaml]\n"
    (tmp_path / "study.yaml").write_text(f"case: lobes.yaml\n{vary}")
    found = read_study(tmp_path / "study.yaml").design.parameters[0]
    assert found.values == tuple(rotordyn.model(kind, name) for name in names)
    assert found.labels[0] == names[0]


def test_limits_of_a_study_know_all_modes_whatever_was_solved_before(tmp_path: Path) -> None:
    """The modes of a slender tool are beyond those of the one before it, which was checked."""
    (tmp_path / "lobes.yaml").write_text(LOBES)
    case, tools = rotordyn.load(tmp_path / "lobes.yaml"), ["hsk63_end_mill_20", "hsk63_end_mill_10"]
    found = sweep(case, {"tool": tools}, workers=1)
    slender = rotordyn.vary(case, {"tool": rotordyn.model("tools", tools[1])})
    alone = rotordyn.run(slender)["stability_lobes"]
    assert found["stability_lobes: least"].values[1] == pytest.approx(1e3 * alone.depth.values[0])
    assert float(alone.error) < 1e-3
    assert found["stability_lobes: least"].values[1] < found["stability_lobes: least"].values[0]


def test_what_is_kept_whole_is_beside_numbers_of_the_same_name(tmp_path: Path) -> None:
    (tmp_path / "lobes.yaml").write_text(LOBES)
    case = rotordyn.load(tmp_path / "lobes.yaml")
    spring = "spindle.sleeves.front.spring.preload"
    found = sweep(case, {spring: ["600 N"]}, results=["stability_lobes"], workers=1)
    assert found["stability_lobes: least"].dims == (spring,)
    name = "stability_lobes: least over stability_lobes: cutting_speed"
    assert found[name].dims == (spring, "stability_lobes: cutting_speed")


def test_a_study_of_several_tools_asks_which(tmp_path: Path) -> None:
    tools = "tools: [hsk63_end_mill_12, hsk63_end_mill_16]"
    (tmp_path / "lobes.yaml").write_text(LOBES.replace("tool: hsk63_end_mill_20", tools))
    case = rotordyn.load(tmp_path / "lobes.yaml")
    spring = "spindle.sleeves.front.spring.preload"
    said = r"compares 2 tools, .* vary it \(tool: \[hsk63_end_mill_12, hsk63_end_mill_16\]\)"
    with pytest.raises(InvalidInput, match=said):
        study_of(case, {spring: ["600 N"]})
    with pytest.raises(InvalidInput, match="compares 2 tools"):
        optimise(case, {spring: ["500 N", "600 N"]}, [Goal(highest="stability_lobes: least")])
    assert study_of(case, {"tool": ["hsk63_end_mill_12"]}).design.count == 1


def test_a_study_says_which_variants_it_leaves_out(case: Case) -> None:
    both = replace(case, variants={"cold": case, "warm": case})
    note = "note       the case itself is solved, without its variants cold, warm"
    values = {SPRING: ["800 N", "900 N"]}
    assert note in summary(study_of(both, values), {}).splitlines()
    assert "note" not in summary(study_of(case, values), {})
    found = optimise(both, values, [Goal(highest="preload: sum")], workers=1)
    assert note in trials_in_words(found).splitlines()


def test_numbers_without_bound_are_the_largest(case: Case) -> None:
    study = study_of(case, {SPRING: ["800 N", "900 N", "1000 N"]}, analyses=["preload"])
    rows = {k: Outcome(k, {"limit": (v, "mm")}) for k, v in enumerate((2.0, math.inf, math.nan))}
    (line,) = (row for row in summary(study, rows).splitlines() if row.startswith("limit"))
    ends = "limit [mm] 2.000 unbounded 0.8 0.9"
    assert " ".join(line.split()) == f"{ends} none at 1 of 3"
    rows[2] = replace(rows[2], solved=False)
    (line,) = (row for row in summary(study, rows).splitlines() if row.startswith("limit"))
    assert " ".join(line.split()) == ends
    alone = {k: Outcome(k, {"limit": (math.inf, "mm")}) for k in range(2)}
    assert "limit [mm]  unbounded  unbounded" in summary(study, alone)


def test_a_mapping_is_no_value_of_a_study(case: Case) -> None:
    """Tables and best.yaml name values by a word, which a mapping has not."""
    springs = [{"preload": "500 N", "stiffness": "5 N/um"}, {"preload": "600 N"}]
    with pytest.raises(InvalidInput, match=r"vary what is in it, such as .*spring\.preload"):
        sweep(case, {"sleeves.*.spring": springs})
