"""What surrounds a run and fails: streams, disks, folders, styles, missing packages, a kill.

Never a traceback, nothing half-written, one sentence.
"""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rotordyn.cli import main
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
RUN = "from rotordyn.cli import main; sys.exit(main(sys.argv[1:]))"
posix = pytest.mark.skipif(os.name != "posix", reason="Windows has none of this")


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "one.yaml"
    path.write_text(CASE, encoding="utf-8")
    return path


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
    case: Path, tmp_path: Path, encoding: str
) -> None:
    argv = ("run", case, "-o", tmp_path / "out", "--no-figures", "--explain")
    done = program(*argv, PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, b"")
    text = done.stdout.decode(encoding)
    assert "0 -> 15000 rpm" in text
    assert "[N/um]" in text if encoding == "ascii" else "[N/µm]" in text
    assert program("run", "--help", PYTHONIOENCODING=encoding).returncode == 0
    assert program("models", PYTHONIOENCODING=encoding).returncode == 0


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
def test_working_directory_that_is_gone(case: Path, tmp_path: Path) -> None:
    code = "import os, sys; os.makedirs('gone'); os.chdir('gone'); os.rmdir('../gone')\n"
    done = program("run", case, code=code, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.decode().count("\n") == 1
    assert "the working directory has been removed" in done.stderr.decode()
    done = program("run", case, "-o", tmp_path / "out", "--quiet", code=code, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")


@posix
def test_user_without_a_home(case: Path, tmp_path: Path) -> None:
    nowhere = dict.fromkeys(("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"), "/proc/nowhere")
    done = program("run", case, "-o", tmp_path / "out", "--quiet", **nowhere)
    assert (done.returncode, done.stderr) == (0, b"")
    assert (tmp_path / "out" / "bearing.png").exists()


@posix
@pytest.mark.parametrize("size", [10_000, 50_000])
def test_full_disk_leaves_earlier_results(case: Path, tmp_path: Path, size: int) -> None:
    """A limit of the size of files acts like a full disk: in the numbers, then in a figure."""
    target = tmp_path / "out"
    assert main(["run", str(case), "-o", str(target), "--quiet", "--no-figures"]) == 0
    before = sorted(p.name for p in target.iterdir())
    code = f"import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size}))\n"
    done = program("run", case, "-o", target, code=code)
    assert done.returncode == 2
    sentence = f"{tmp_path} cannot be written to: File too large; give another folder with -o\n"
    assert done.stderr.decode() == sentence
    assert sorted(p.name for p in target.iterdir()) == before
    assert sorted(p.name for p in tmp_path.iterdir()) == ["one.yaml", "out"]


def test_figures_do_not_follow_the_users_style(case: Path, tmp_path: Path) -> None:
    style = "text.usetex: True\nlines.linewidth: 9\nfont.family: no such\naxes.titlesize: 40\n"
    (tmp_path / "matplotlibrc").write_text(style + "no.such.key: 1\n", encoding="utf-8")
    argv = ("run", case, "--quiet", "-o")
    done = program(*argv, tmp_path / "odd", cwd=tmp_path, MPLBACKEND="nonsense")
    assert (done.returncode, done.stderr) == (0, b"")
    assert program(*argv, tmp_path / "plain").returncode == 0
    for name in ("bearing.png", "bearing.svg"):
        odd, plain = (tmp_path / folder / name for folder in ("odd", "plain"))
        assert odd.read_bytes() == plain.read_bytes()


@pytest.mark.parametrize(
    ("missing", "package", "lost"),
    [
        ("matplotlib", "matplotlib", {"campbell.png"}),
        ("h5netcdf", "h5netcdf", {"results.nc"}),
        ("h5py", "h5py", {"results.nc"}),
        ("pyuff", "pyuff", {"frf.uff"}),
        ("meshio", "meshio", {"shapes_3d/bending_1_0rpm.vtu"}),
        ("rich", "rich", {"shapes_3d/bending_1_0rpm.vtu"}),  # which meshio imports
        ("numba", "", set()),
        ("xarray", "", set()),
    ],
)
def test_a_package_that_is_missing_costs_what_it_writes(
    tmp_path: Path, missing: str, package: str, lost: set[str]
) -> None:
    path, target = tmp_path / "rotor.yaml", tmp_path / "out"
    path.write_text(FRF, encoding="utf-8")
    figures = ["--no-figures"] if missing != "matplotlib" else []
    code = BLOCKED.format(names={missing})
    done = program("run", path, "-o", target, *figures, code=code, PYTHONIOENCODING="utf-8")
    assert (done.returncode, done.stderr) == (0, b"")
    made = {p.relative_to(target).as_posix() for p in target.rglob("*")}
    every = {"results.nc", "frf.uff", "shapes_3d/bending_1_0rpm.vtu", "run.json"}
    assert made >= every - lost
    assert "shapes_3d/bending_1_0rpm.glb" in made
    assert not made & lost
    notes = json.loads((target / "run.json").read_text(encoding="utf-8"))["notes"]
    said = [note for note in notes if "is not installed" in note]
    assert len(said) == len(lost)
    remedy = f"the package {package} is not installed: python -m pip install {package}"
    assert all(note.endswith(remedy) for note in said)


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
from bearings.ring.compiled import states
states.BALL = 1e9
assert not states.pays(25, (1, 1))
sys.exit(0)
"""
    done = program(code=BLOCKED.format(names={"numba"}) + code)
    assert (done.returncode, done.stderr) == (0, b"")


def test_killed_runs_leave_a_whole_folder_and_no_leftovers(case: Path, tmp_path: Path) -> None:
    target, place = tmp_path / "results" / "out", random.Random(3)
    argv = [sys.executable, "-m", "rotordyn", "run", str(case), "-o", str(target), "--quiet"]
    subprocess.run(argv, cwd=ROOT, check=True)
    whole = sorted(p.name for p in target.iterdir())
    caught = 0
    for _ in range(4):
        process = subprocess.Popen(argv, cwd=ROOT)
        while process.poll() is None and not any(target.parent.glob(".out.*")):
            time.sleep(0.002)
        time.sleep(0.3 * place.random())
        process.kill()
        process.wait()
        caught += any(target.parent.glob(".out.*"))
        assert sorted(p.name for p in target.iterdir()) == whole
        assert json.loads((target / "run.json").read_text(encoding="utf-8"))["files"] == whole
    assert caught, "no run was killed while it wrote"
    subprocess.run(argv, cwd=ROOT, check=True)
    assert os.listdir(target.parent) == ["out"]
