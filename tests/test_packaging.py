"""What is shipped: both packages, the models and the cases, and nothing else.

The archives are built with the build backend of the environment: no network, nothing installed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import zipfile
from email.message import Message
from email.parser import Parser
from pathlib import Path

import pytest
import yaml

import rotordyn

ROOT = Path(__file__).resolve().parents[1]
REQUIRED = {"numpy", "scipy", "numba", "pyvista", "meshio", "matplotlib"}


def python(folder: Path, *argv: str) -> str:
    """What an interpreter prints that runs in ``folder``; it must succeed.

    The packages of ``folder``, if it has some, come before those of the environment.
    """
    command = [sys.executable, *argv]
    env = os.environ | {"PYTHONPATH": str(folder)}
    done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def build(tree: Path, target: str, into: Path) -> Path:
    """The one archive of kind ``target`` ("wheel" or "sdist") built from ``tree``."""
    python(tree, "-m", "hatchling", "build", "-t", target, "-d", str(into))
    (archive,) = into.iterdir()
    return archive


def unpack(archive: Path, folder: Path) -> Path:
    """The tree of a source archive, unpacked in ``folder``."""
    with tarfile.open(archive) as tar:
        tar.extractall(folder, filter="data")
    (tree,) = folder.iterdir()
    return tree


def contents(wheel: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def files_below(*folders: str, pattern: str = "*") -> dict[str, bytes]:
    """Path from the root -> bytes, for every file of the tree that is not a by-product."""
    found = (path for folder in folders for path in (ROOT / folder).rglob(pattern))
    kept = (path for path in found if path.is_file() and "__pycache__" not in path.parts)
    return {path.relative_to(ROOT).as_posix(): path.read_bytes() for path in kept}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return contents(build(ROOT, "wheel", tmp_path_factory.mktemp("wheel")))


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The source archive, unpacked."""
    archive = build(ROOT, "sdist", tmp_path_factory.mktemp("sdist"))
    return unpack(archive, tmp_path_factory.mktemp("unpacked"))


@pytest.fixture(scope="module")
def metadata(wheel: dict[str, bytes]) -> Message:
    (name,) = (name for name in wheel if name.endswith(".dist-info/METADATA"))
    return Parser().parsestr(wheel[name].decode())


def test_wheel_holds_every_source_file_and_both_type_markers(wheel: dict[str, bytes]) -> None:
    sources = files_below("rotordyn", "bearings", pattern="*.py")
    assert {"rotordyn/__init__.py", "bearings/__init__.py"} <= sources.keys()
    assert sources.items() <= wheel.items()
    assert {"rotordyn/py.typed", "bearings/py.typed"} <= wheel.keys()
    assert {"rotordyn/page/page.css", "rotordyn/page/page.js"} <= wheel.keys()


def test_wheel_holds_every_model_and_case_as_data(wheel: dict[str, bytes]) -> None:
    data = {f"rotordyn/_data/{name}": held for name, held in files_below("models", "cases").items()}
    assert "rotordyn/_data/cases/mfw2310.yaml" in data
    assert "rotordyn/_data/models/spindles/mfw2310.yaml" in data
    assert {n: held for n, held in wheel.items() if n.startswith("rotordyn/_data/")} == data


def test_wheel_installs_two_packages_and_nothing_beside_them(wheel: dict[str, bytes]) -> None:
    version = rotordyn.__version__
    tops = {name.partition("/")[0] for name in wheel}
    assert tops == {"rotordyn", "bearings", f"rotordyn-{version}.dist-info"}
    assert not [name for name in wheel if "tests/" in name or name.endswith(".pyc")]


def test_wheel_installs_the_command(wheel: dict[str, bytes]) -> None:
    (name,) = (name for name in wheel if name.endswith(".dist-info/entry_points.txt"))
    assert "rotordyn = rotordyn.cli:main" in wheel[name].decode()


def test_metadata_states_version_python_and_licence(metadata: Message) -> None:
    assert metadata["Name"] == "rotordyn"
    assert metadata["Version"] == rotordyn.__version__
    assert metadata["Requires-Python"] == ">=3.11"
    assert metadata["License-Expression"] == "MIT"


def test_metadata_requires_the_six_libraries_always_and_pytest_for_tests(metadata: Message) -> None:
    needs = metadata.get_all("Requires-Dist") or []
    always = {need.partition(">=")[0] for need in needs if "extra ==" not in need}
    assert always >= REQUIRED
    assert [need for need in needs if need.startswith("pytest>=") and "extra == 'test'" in need]


def test_citation_names_this_version() -> None:
    """The keys that version 1.2.0 of the Citation File Format requires, and ours."""
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert {"cff-version", "message", "title", "authors"} <= cited.keys()
    assert cited["cff-version"] == "1.2.0"
    assert cited["authors"] == [{"name": "rotordyn contributors"}]
    assert (cited["version"], cited["license"]) == (rotordyn.__version__, "MIT")


def test_changelog_tells_of_this_version() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert "## [Unreleased]" in text
    assert rotordyn.__version__ in text


def test_unpacked_wheel_checks_a_case_with_its_own_models(
    wheel: dict[str, bytes], tmp_path: Path
) -> None:
    for name, held in wheel.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(held)
    code = "from rotordyn.case.library import models_root as f; print(f())"
    where = python(tmp_path, "-c", code)
    assert Path(where.strip()) == tmp_path / "rotordyn" / "_data" / "models"
    python(tmp_path, "-m", "rotordyn", "check", "rotordyn/_data/cases/mfw2310.yaml")


def test_source_archive_builds_the_same_wheel(
    unpacked: Path, wheel: dict[str, bytes], tmp_path: Path
) -> None:
    assert contents(build(unpacked, "wheel", tmp_path)) == wheel


def test_source_archive_holds_the_checks_but_no_by_products(unpacked: Path) -> None:
    held = {path.name for path in unpacked.iterdir()}
    assert {"tests", "scripts", "docs", "models", "cases", "pyproject.toml"} <= held
    assert {"CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "README.md"} <= held
    assert not held & {".venv", "out", "dist", "build"}
