"""What surrounds a run and fails: streams, disks, folders, styles, missing packages, a kill.

Never a traceback, nothing half-written, one sentence.
"""

from __future__ import annotations

import errno
import io
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

import rotordyn
from rotordyn.cli import main
from rotordyn.errors import InvalidInput
from tests.oracles.spindles import ROOT

CASE = """\
title: one bearing, µ
bearing: vex70
speeds: [0 rpm, 15000 rpm]
analyses:
  bearing:
    loads: [500 N]
"""
FRF = """\
spindle: lalanne_ferraris
speeds: [0 rpm, 9000 rpm]
analyses:
  campbell: {max_frequency: 62 Hz, shapes_3d: {files: [vtu, glb]}}
  frf:
    frequencies: {from: 5 Hz, to: 60 Hz, step: 5 Hz}
    pairs: [{response: disc_1.y, excitation: disc_1.y}]
"""
BLOCKED = """\
import sys
class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {names!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Blocked())
"""
FULL = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))\n"
FULL_FOR_FIGURES = """\
import resource, sys
from rotordyn.figures import draw
def full(*given, draw_one=draw.draw_one):
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
    return draw_one(*given)
draw.draw_one = full
"""
RUN = "from rotordyn.cli import main; sys.exit(main(sys.argv[1:]))"
posix = pytest.mark.skipif(os.name != "posix", reason="Windows has none of this")


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("case") / "one.yaml"
    path.write_text(CASE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def whole(case: Path) -> Path:
    """A results folder of ``case`` that no test changes."""
    target = case.parent / "whole"
    assert main(["run", str(case), "-o", str(target), "--quiet"]) == 0
    return target


def program(
    *argv: object, code: str = "", cwd: Path = ROOT, **environment: str
) -> subprocess.CompletedProcess[bytes]:
    start = ["-c", code + RUN if code else "import sys; " + RUN]
    return subprocess.run(
        [sys.executable, *start, *map(str, argv)],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        capture_output=True,
        check=False,
    )


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252"])
def test_streams_without_our_symbols_get_plain_words(
    case: Path, tmp_path: Path, encoding: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(out, encoding=encoding))
    argv = ["run", str(case), "-o", str(tmp_path / "out"), "--no-figures", "--explain"]
    assert main(argv) == 0
    text = out.getvalue().decode(encoding)
    assert "0 -> 15000 rpm" in text
    assert "[N/um]" in text if encoding == "ascii" else "[N/µm]" in text
    assert main(["models"]) == 0
    with pytest.raises(SystemExit) as ended:
        main(["run", "--help"])
    assert ended.value.code == 0


@posix
def test_the_locale_c_without_utf8() -> None:
    done = program("models", LC_ALL="C", PYTHONUTF8="0", PYTHONCOERCECLOCALE="0")
    assert (done.returncode, done.stderr) == (0, b"")
    assert rb"No\xebl" in done.stdout


@posix
@pytest.mark.parametrize("stream", [1, 2])
def test_closed_streams(stream: int) -> None:
    code = f"import os, sys; os.close({stream}); os.execv(sys.executable, [sys.executable, '-m', "
    code += "'rotordyn', *sys.argv[1:]])\n"
    done = program("check", "no_such_case", code=code)
    assert done.returncode == 2
    assert b"Traceback" not in done.stdout + done.stderr
    assert done.stdout == b""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="the system has no full device")
@pytest.mark.parametrize("argv", [["--help"], ["cases"]])
def test_full_standard_output_is_a_sentence(argv: list[str]) -> None:
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "rotordyn", *argv],
            cwd=ROOT, stdout=full, stderr=subprocess.PIPE, text=True, check=False,
        )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr == "standard output cannot be written: No space left on device\n"


@posix
def test_working_directory_that_is_gone(
    case: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert main(["run", str(case)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "the working directory has been removed" in said


@pytest.mark.long
@posix
def test_run_without_a_home_or_a_working_directory(case: Path, tmp_path: Path) -> None:
    code = "import os, sys; os.makedirs('gone'); os.chdir('gone'); os.rmdir('../gone')\n"
    nowhere = dict.fromkeys(("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"), "/proc/nowhere")
    argv = ("run", case, "-o", tmp_path / "out", "--quiet")
    done = program(*argv, code=code, cwd=tmp_path, **nowhere)
    assert (done.returncode, done.stderr) == (0, b"")
    assert (tmp_path / "out" / "bearing.png").exists()


@pytest.mark.few(1)
@posix
@pytest.mark.parametrize(
    ("code", "option"),
    [(FULL, "--no-figures"), (FULL_FOR_FIGURES, "--quiet")],
    ids=["numbers", "figure"],
)
def test_full_disk_leaves_earlier_results(
    case: Path, whole: Path, tmp_path: Path, code: str, option: str
) -> None:
    """A limit of the size of files acts like a full disk: in the numbers, or in a figure."""
    target = tmp_path / "out"
    shutil.copytree(whole, target)
    done = program("run", case, "-o", target, option, code=code)
    assert done.returncode == 2
    sentence = f"{tmp_path} cannot be written to: File too large; give another folder with -o\n"
    assert done.stderr.decode() == sentence
    assert held(target) == held(whole)
    assert os.listdir(tmp_path) == ["out"]


@posix
def test_full_disk_while_a_folder_is_copied(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    stored = rotordyn.open(whole)
    monkeypatch.setattr(shutil, "copyfile", refuse)
    with pytest.raises(InvalidInput, match="cannot be written to: No space left on device"):
        stored.save(tmp_path / "out")
    assert os.listdir(tmp_path) == []


def held(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.long
def test_figures_do_not_follow_the_users_style(case: Path, whole: Path, tmp_path: Path) -> None:
    style = "text.usetex: True\nlines.linewidth: 9\nfont.family: no such\naxes.titlesize: 40\n"
    (tmp_path / "matplotlibrc").write_text(style + "no.such.key: 1\n", encoding="utf-8")
    argv = ("run", case, "--quiet", "-o", tmp_path / "odd")
    done = program(*argv, cwd=tmp_path, MPLBACKEND="nonsense")
    assert (done.returncode, done.stderr) == (0, b"")
    for name in ("bearing.png",):
        assert (tmp_path / "odd" / name).read_bytes() == (whole / name).read_bytes()


def test_the_backend_that_a_notebook_names_stays_its_own() -> None:
    code = "import sys; from rotordyn.figures.draw import load; load()\n"
    code += "import matplotlib; sys.exit(matplotlib.get_backend())\n"
    assert program(code=code, MPLBACKEND="svg").stderr.split() == [b"svg"]


def test_formats_of_figures_are_those_requested(
    case: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    argv = ["run", str(case), "-o", str(tmp_path / "out"), "--quiet", "--format"]
    assert main([*argv, "PDF, .svg"]) == 0
    assert {p.suffix for p in (tmp_path / "out").glob("bearing*")} >= {".pdf", ".svg"}
    assert not list((tmp_path / "out").glob("*.png"))
    assert main([*argv, "jpg"]) == 2
    assert capsys.readouterr().err == "--format jpg: figures are written as png, pdf, svg\n"


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("missing", "lost"),
    [
        (
            {"matplotlib": "figures", "h5netcdf": "", "pyuff": "frf.uff", "numba": ""},
            {"campbell.png", "frf.uff"},
        ),
        (
            {"h5py": "results.nc", "meshio": "shapes_3d/*.vtu", "xarray": ""},
            {"campbell.png", "results.nc", "shapes_3d/bending_1_0rpm.vtu"},
        ),
        (
            {"rich": "shapes_3d/*.vtu"},  # which meshio imports
            {"campbell.png", "shapes_3d/bending_1_0rpm.vtu"},
        ),
    ],
    ids=["matplotlib", "h5py", "rich"],
)
def test_packages_that_are_missing_cost_what_they_write(
    tmp_path: Path, missing: dict[str, str], lost: set[str]
) -> None:
    path, target = tmp_path / "rotor.yaml", tmp_path / "out"
    path.write_text(FRF, encoding="utf-8")
    figures = ["--no-figures"] if "matplotlib" not in missing else []
    code = BLOCKED.format(names=set(missing))
    done = program("run", path, "-o", target, *figures, code=code, PYTHONIOENCODING="utf-8")
    assert (done.returncode, done.stderr) == (0, b"")
    made = {p.relative_to(target).as_posix() for p in target.rglob("*")}
    every = {"results.nc", "frf.uff", "shapes_3d/bending_1_0rpm.vtu", "run.json", "case.json"}
    assert made >= every - lost
    assert "shapes_3d/bending_1_0rpm.glb" in made
    assert not made & lost
    notes = json.loads((target / "run.json").read_text(encoding="utf-8"))["notes"]
    remedy = "{1} omitted: the package {0} is not installed: python -m pip install {0}"
    said = {remedy.format(*each) for each in missing.items() if each[1]}
    assert {note for note in notes if "is not installed" in note} == said


def test_a_package_that_all_needs_is_named(case: Path) -> None:
    done = program("check", case, code=BLOCKED.format(names={"yaml"}))
    assert done.returncode == 2
    assert done.stderr.decode() == (
        "the package PyYAML is not installed: python -m pip install PyYAML\n"
    )


def test_bearings_without_numba_are_the_same() -> None:
    code = """
import numpy as np
from bearings import AngularContactBallBearing
bearing = AngularContactBallBearing(
    ball_diameter=9.525e-3, pitch_diameter=90e-3, balls=25, contact_angle=0.4363,
    inner_conformity=0.56, outer_conformity=0.54,
)
load = [[1000, 50, 0, 0, 0]]
given = dict(load=load, speed=2000.0)
found = [bearing.equilibrium(compiled=c, **given).displacement for c in (True, False)]
assert "numba" not in sys.modules
assert np.allclose(*found, rtol=1e-9, atol=1e-15), found
import bearings.geometry
from bearings.ring.compiled import states
states.BALL = 1e9
assert not states.pays(25, bearings.geometry.geometry(bearing.grooves))
sys.exit(0)
"""
    done = program(code=BLOCKED.format(names={"numba"}) + code)
    assert done.returncode == 0
    (said,) = (line for line in done.stderr.decode().splitlines() if "Warning" in line)
    assert "the package numba is not installed, and balls are computed some hundred times" in said
    assert said.endswith("slower: python -m pip install numba")


@pytest.mark.parametrize("pause", [0.0, 0.1])
def test_killed_runs_leave_a_whole_folder_and_no_leftovers(
    case: Path, whole: Path, tmp_path: Path, pause: float
) -> None:
    target = tmp_path / "out"
    shutil.copytree(whole, target)
    argv = ["run", str(case), "-o", str(target), "--quiet"]
    for share in (1.0, 0.3, 0.1, 0.0):  # of the pause: a quick run may have written all by then
        process = subprocess.Popen([sys.executable, "-m", "rotordyn", *argv], cwd=ROOT)
        while process.poll() is None and not any(tmp_path.glob(".out.*")):
            time.sleep(0.002)
        time.sleep(share * pause)
        process.kill()
        process.wait()
        if any(tmp_path.glob(".out.*")):
            break
    assert any(tmp_path.glob(".out.*")), "it was not killed while it wrote"
    assert held(target) == held(whole)
    assert main([*argv, "--no-figures"]) == 0
    assert os.listdir(tmp_path) == ["out"]
