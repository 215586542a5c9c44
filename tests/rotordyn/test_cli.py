"""The command line: exit codes, what it prints where, what it leaves behind."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import rotordyn
from rotordyn.cli import main
from tests.oracles.spindles import CASES, ROOT

BEARING = """\
title: one bearing
bearing: vex70
speeds: [{speeds}]
analyses:
  bearing:
    loads: [500 N]
"""
SPINDLE = """\
title: preload lost at speed
spindle: mfw2310
tool: mfw2310_exciter
override:
  shortening.shift.d: 300 um
  shortening.shift.e: 300 um
conditions: {{kinematics: outer}}
speeds: [{speeds}]
analyses: {{preload: {{}}, {more}}}
"""
CAMPBELL = "campbell: {max_frequency: 3000 Hz}"
Write = Callable[..., Path]


@pytest.fixture
def lost(tmp_path: Path) -> Write:
    """A spindle whose rear preload is lost at 24 000 rpm."""

    def write(speeds: str, more: str = CAMPBELL) -> Path:
        path = tmp_path / "lost.yaml"
        path.write_text(SPINDLE.format(speeds=speeds, more=more), encoding="utf-8")
        return path

    return write


@pytest.fixture
def bearing(tmp_path: Path) -> Path:
    path = tmp_path / "one.yaml"
    path.write_text(BEARING.format(speeds="0 rpm, 15000 rpm"), encoding="utf-8")
    return path


def run(*argv: object) -> int:
    return main(["run", *map(str, argv)])


def test_done(bearing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(bearing, "-o", tmp_path / "out") == 0
    out, err = capsys.readouterr()
    assert f"results in {tmp_path / 'out'}" in out
    assert err == ""
    assert (tmp_path / "out" / "run.json").exists()


def test_quiet_prints_nothing(
    bearing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(bearing, "-o", tmp_path / "out", "--quiet") == 0
    assert capsys.readouterr() == ("", "")


def test_what_would_steer_a_terminal_is_printed_as_spaces(
    bearing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Colours, deleted lines, writing from right to left, invisible marks in a title; µ stays."""
    text = bearing.read_text(encoding="utf-8")
    title = 'title: "µ \\e[31mred \\u202eleft \\x9bK \\u200bend"'
    bearing.write_text(text.replace("title: one bearing", title), encoding="utf-8")
    assert run(bearing, "--out", tmp_path / "out", "--no-figures") == 0
    printed = capsys.readouterr().out
    assert printed.startswith("one: µ  [31mred  left  K  end\n")
    assert printed.replace("\n", "").isprintable()


def test_default_folder_is_named_after_the_case(
    bearing: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(bearing, "--quiet") == 0
    assert (tmp_path / "out" / "one" / "results.nc").exists()


def test_bad_input_is_2_and_every_fault_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(BEARING.format(speeds="0 rpm, 15000 Hz").replace("vex70", "vex7"))
    for command in ("run", "check"):
        assert main([command, str(path)]) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert len([line for line in err.splitlines() if line.startswith(f"{path}:")]) == 2


@pytest.mark.parametrize("name", ["no_such_case.yaml", "."])
def test_missing_file_or_folder_is_2(name: str, tmp_path: Path) -> None:
    assert run(tmp_path / name, "-o", tmp_path / "out") == 2
    assert not (tmp_path / "out").exists()


def test_unknown_analysis_is_2(
    bearing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(bearing, "-o", tmp_path / "out", "--only", "campbell") == 2
    assert "bearing" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_only_solves_and_draws_only_that(lost: Write, tmp_path: Path) -> None:
    assert run(lost("0 rpm, 6000 rpm"), "-o", tmp_path / "out", "--only", "preload", "--quiet") == 0
    names = {p.name for p in (tmp_path / "out").iterdir()}
    assert "preload.csv" in names
    assert not {"campbell.csv", "campbell.png"} & names
    record = json.loads((tmp_path / "out" / "run.json").read_text(encoding="utf-8"))
    assert "campbell" in record["skipped"]


def test_foreign_folder_is_2(
    bearing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "precious.txt").write_text("mine")
    assert run(bearing, "-o", tmp_path / "out") == 2
    assert "not empty" in capsys.readouterr().err
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["precious.txt"]


def test_folder_that_cannot_be_made_is_2(
    bearing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    assert run(bearing, "-o", tmp_path / "file" / "out") == 2
    assert "file" in capsys.readouterr().err


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_folder_that_cannot_be_written_is_2(bearing: Path, tmp_path: Path) -> None:
    (tmp_path / "locked").mkdir(mode=0o500)
    assert run(bearing, "-o", tmp_path / "locked" / "out") == 2


def test_one_speed_lost_is_0_and_named(
    lost: Write, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(lost("0 rpm, 12000 rpm, 24000 rpm"), "-o", tmp_path / "out", "--quiet") == 0
    err = capsys.readouterr().err
    assert "bearing d, e is unloaded at 24000 rpm" in err
    assert (tmp_path / "out" / "campbell.csv").exists()


def test_one_speed_lost_is_3_when_strict(lost: Write, tmp_path: Path) -> None:
    case = lost("0 rpm, 12000 rpm, 24000 rpm")
    how = ("-o", tmp_path / "out", "--quiet", "--strict", "--no-figures")
    assert run(case, *how) == 3
    assert run(lost("0 rpm, 6000 rpm"), *how) == 0


@pytest.mark.parametrize("more", [CAMPBELL, ""], ids=["campbell", "preload alone"])
def test_no_speed_solved_is_3_and_nothing_is_written(
    more: str, lost: Write, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(lost("24000 rpm", more), "-o", tmp_path / "out") == 3
    assert "unloaded at 24000 rpm" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_bug_is_not_hidden(bearing: Path, tmp_path: Path, monkeypatch: Any) -> None:
    """Nothing but errors raised on purpose is turned into a message: a bug ends with 1."""

    def broken(*_: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("rotordyn.job.solved.solve", broken)
    with pytest.raises(ZeroDivisionError):
        run(bearing, "-o", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_interrupted(bearing: Path, tmp_path: Path, monkeypatch: Any) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("rotordyn.job.solved.solve", stopped)
    assert run(bearing, "-o", tmp_path / "out") == 130
    assert list(tmp_path.glob("out*")) == []


def test_check_says_what_the_case_asks(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(CASES / "mfw2310.yaml")]) == 0
    out = capsys.readouterr().out
    assert "fine (49 speeds; preload, campbell, frf, stiffness)" in out


def test_check_warns_of_what_the_description_alone_makes_unlikely(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: mfw2310\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n"
        "override: {shaft.sections.nose.length: 18 m}\n"
    )
    assert main(["check", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("WARNING: section ") for line in lines[:-1])
    assert f"{path}: fine, with {len(lines) - 1} warning" in lines[-1]


def test_check_warns_of_thrust_that_nothing_opposes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "case.yaml"
    text = "spindle: mfw2310\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n"
    path.write_text(f'{text}override: {{"bearings.*.thrust": +x}}\n')
    assert main(["check", str(path)]) == 0
    assert "WARNING: all bearings carry thrust towards +x only" in capsys.readouterr().out


def test_lobes_of_a_machine_without_any_damping_are_refused_at_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: mfw2310\nspeeds: [9000 rpm]\noverride: {damping: {}}\nanalyses:\n"
        "  stability_lobes: {point: nose, teeth: 2, diameter: 20 mm, tangential: 700 MPa,\n"
        "    radial: 100 MPa}\n"
    )
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err
    assert "case.yaml:5:" in said
    assert "the machine is undamped, so that no cut is stable: give damping.rotor" in said


def test_shipped_case_is_found_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["check", "vex70"]) == 0
    assert run("vex70", "--quiet") == 0
    assert (tmp_path / "out" / "vex70" / "results.nc").exists()
    assert main(["check", "vex7O"]) == 2
    assert "did you mean vex70?" in capsys.readouterr().err


def test_models_are_listed_with_their_sources(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["models"]) == 0
    lines = capsys.readouterr().out.splitlines()
    heads = [line.split() for line in lines if not line.startswith(" ")]
    assert [(h[0], h[1]) for h in heads] == [(m.kind, m.name) for m in rotordyn.models()]
    assert len(lines) == 2 * len(heads)
    assert main(["models", "tools"]) == 0
    assert capsys.readouterr().out.count("\n") == 2 * len(rotordyn.models("tools"))
    assert main(["models", "tool"]) == 2
    assert "did you mean tools?" in capsys.readouterr().err


def test_cases_are_listed_with_their_titles(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cases"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[1] for line in lines] == [c.name for c in rotordyn.cases()]
    assert all(case.title in line for case, line in zip(rotordyn.cases(), lines, strict=True))


def test_schema_is_printed_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "rotordyn case"
    assert main(["schema", "tool"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "rotordyn tool"
    assert main(["schema", "cases"]) == 2
    assert "did you mean case?" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("argv", "code", "said"),
    [
        (["--version"], 0, f"rotordyn {rotordyn.__version__}"),
        (["--help"], 0, "exit codes"),
        (["run", "--help"], 0, "--strict"),
        ([], 2, "COMMAND"),
        (["solve"], 2, "invalid choice"),
    ],
)
def test_module_from_the_shell(argv: list[str], code: int, said: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "rotordyn", *argv],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == code
    assert said in " ".join((done.stdout + done.stderr).split())


def test_a_reader_that_leaves_early_is_no_error() -> None:
    """As ``rotordyn schema | head -1``: no traceback."""
    writer = subprocess.Popen(
        [sys.executable, "-m", "rotordyn", "schema"],
        cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    assert writer.stdout is not None
    assert writer.stderr is not None
    writer.stdout.close()
    assert writer.stderr.read() == b""
    writer.stderr.close()
    assert writer.wait() == 0


def test_exit_code_reaches_the_shell(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "rotordyn", "check", str(tmp_path / "none.yaml")],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "none.yaml" in done.stderr


@pytest.mark.long
def test_the_main_job_from_the_shell_imports_no_kernels_and_no_3d(tmp_path: Path) -> None:
    code = (
        "import sys; from rotordyn.cli import main\n"
        f"code = main(['run', 'cases/mfw2310.yaml', '-o', {str(tmp_path / 'out')!r}, '--quiet'])\n"
        "names = {m.partition('.')[0] for m in sys.modules} | set(sys.modules)\n"
        "print(code, *sorted(names & {'numba', 'pyvista', 'vtk', 'vtkmodules', 'meshio',"
        " 'matplotlib.pyplot', 'pandas.plotting', 'scipy.signal', 'scipy.stats'}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["0"]
    assert (tmp_path / "out" / "results.nc").exists()
