"""Models and cases are found from a checkout, an editable install, a wheel, a source archive.

Each is installed into an environment of its own that borrows the libraries of this one, without a
network; commands run in a foreign folder.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.test_packaging import build, unpack

ROOT = Path(__file__).resolve().parents[1]
SMALL = "title: small\nbearing: vex70\nspeeds: [0 rpm]\nanalyses: {bearing: {loads: [500 N]}}\n"


@dataclass(frozen=True)
class Place:
    """An interpreter that finds rotordyn, and where its models must come from."""

    python: Path
    models: Path
    path: str = ""

    def run(self, folder: Path, *argv: str) -> str:
        """What ``python argv`` prints in ``folder``; it must succeed."""
        env = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "PIP"))}
        env |= {"PYTHONPATH": self.path} if self.path else {}
        done = subprocess.run(
            [self.python, *argv], cwd=folder, env=env, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


def environment(folder: Path) -> Path:
    """A new interpreter that sees the libraries of this one, but not what is installed editable."""
    venv.create(folder, symlinks=os.name != "nt")
    (site,) = folder.rglob("site-packages")
    borrowed = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    (site / "borrowed.pth").write_text("\n".join(sorted(borrowed)))
    return folder / ("Scripts" if os.name == "nt" else "bin") / "python"


def install(python: Path, *what: str) -> None:
    """Install with the pip of this environment, from what is on this machine."""
    offline = ("--no-deps", "--no-index", "--no-build-isolation", "--ignore-installed", "--quiet")
    command = [sys.executable, "-m", "pip", "--isolated", "--python", str(python), "install"]
    done = subprocess.run(
        [*command, *offline, "--disable-pip-version-check", *what],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr


def installed(kind: str, folder: Path) -> Place:
    """rotordyn installed as ``kind`` below ``folder``."""
    python = environment(folder / "env")
    (site,) = (folder / "env").rglob("site-packages")
    if kind == "editable":
        tree = unpack(build(ROOT, "sdist", folder / "sdist"), folder / "tree")
        install(python, "--editable", str(tree))
        assert not (site / "rotordyn").exists(), "a copy that would grow old"
        return Place(python, tree / "models")
    install(python, str(build(ROOT, kind, folder / kind)))
    return Place(python, site / "rotordyn" / "_data" / "models")


WAYS = ("checkout", "editable", "wheel", pytest.param("sdist", marks=pytest.mark.long))


@pytest.fixture(scope="module", params=WAYS)
def place(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Place:
    if request.param == "checkout":
        return Place(Path(sys.executable), ROOT / "models", path=str(ROOT))
    return installed(request.param, tmp_path_factory.mktemp(request.param))


def test_models_and_cases_are_found_from_a_foreign_folder(place: Place, tmp_path: Path) -> None:
    code = "from rotordyn.case.library import models_root as f; print(f())"
    assert Path(place.run(tmp_path, "-c", code).strip()) == place.models
    listed = place.run(tmp_path, "-m", "rotordyn", "models")
    assert "mfw2310_exciter" in listed
    assert "doctoral thesis" in listed
    checked = place.run(tmp_path, "-m", "rotordyn", "check", "mfw2310")
    assert checked.startswith("mfw2310: fine")
    (tmp_path / "small.yaml").write_text(SMALL)
    place.run(tmp_path, "-m", "rotordyn", "run", "small.yaml", "--quiet")
    assert (tmp_path / "out" / "small" / "results.nc").exists()


@pytest.mark.parametrize("place", ["editable"], indirect=True, scope="module")
def test_editable_install_reads_the_models_of_its_tree(place: Place, tmp_path: Path) -> None:
    steel = place.models / "materials" / "steel_rotor.yaml"
    shutil.copy(steel, steel.with_name("steel_of_mine.yaml"))
    assert "steel_of_mine" in place.run(tmp_path, "-m", "rotordyn", "models", "materials")
