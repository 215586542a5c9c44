"""What is imported when: each face of the project pays only for what it uses.

Every check runs in an interpreter of its own, so that nothing another test imported can hide here.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SCIENCE = {"scipy", "numba", "matplotlib", "pyvista", "vtkmodules", "meshio", "xarray", "h5py"}
ANYTHING_BIG = SCIENCE | {"numpy", "pandas", "pydantic", "yaml"}

# Writes the names of all modules of the process to the file named first, at exit.
PROBE = """
import atexit, pathlib, sys
out = pathlib.Path(sys.argv.pop(1))
atexit.register(lambda: out.write_text("\\n".join(sorted(sys.modules))))
"""
COMMAND_LINE = "import runpy; runpy.run_module('rotordyn', run_name='__main__', alter_sys=True)"
EVERY_MODULE_OF_BEARINGS = """
import bearings, importlib, pkgutil
for module in pkgutil.walk_packages(bearings.__path__, "bearings."):
    importlib.import_module(module.name)
"""


def modules_after(code: str, folder: Path, *argv: str) -> set[str]:
    """Names of the modules loaded when ``code`` has run with ``argv``; it must succeed."""
    found = folder / "modules.txt"
    command = [sys.executable, "-c", PROBE + code, str(found), *argv]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return set(found.read_text().splitlines())


def packages(modules: Iterable[str]) -> set[str]:
    """The top-level names among ``modules``."""
    return {name.partition(".")[0] for name in modules}


@pytest.mark.parametrize("package", ["rotordyn", "bearings"])
def test_importing_a_package_imports_nothing_big(package: str, tmp_path: Path) -> None:
    loaded = packages(modules_after(f"import {package}", tmp_path))
    assert package in loaded
    assert not loaded & ANYTHING_BIG


@pytest.mark.parametrize("option", ["--help", "--version"])
def test_help_and_version_import_nothing_big(option: str, tmp_path: Path) -> None:
    loaded = modules_after(COMMAND_LINE, tmp_path, option)
    assert "rotordyn.cli" in loaded
    assert not packages(loaded) & ANYTHING_BIG


@pytest.mark.parametrize(
    "argv",
    [("check", "mfw2310"), ("check", "driveline_shaft"), ("schema",), ("models",), ("cases",)],
    ids="_".join,
)
def test_reading_needs_no_numerical_libraries(argv: tuple[str, ...], tmp_path: Path) -> None:
    loaded = modules_after(COMMAND_LINE, tmp_path, *argv)
    assert "rotordyn.case.library" in loaded
    assert not packages(loaded) & SCIENCE


def test_nouns_are_built_without_files_or_numerical_libraries(tmp_path: Path) -> None:
    """Describing a machine in Python reads no YAML and needs no schema."""
    nouns = "from rotordyn.machine import *; from rotordyn.analyses import *\n"
    code = nouns + "import rotordyn; Spring(1.0); rotordyn.Case; rotordyn.vary(Spring(1.0), {})"
    loaded = packages(modules_after(code, tmp_path))
    assert not loaded & (SCIENCE | {"yaml", "pydantic"})


def test_bearings_stands_alone(tmp_path: Path) -> None:
    loaded = modules_after(EVERY_MODULE_OF_BEARINGS, tmp_path)
    assert "bearings.kinds.angular_contact" in loaded
    assert not packages(loaded) & {"rotordyn", "yaml", "pydantic", "matplotlib", "xarray"}


def test_a_check_of_the_flagship_loads_no_numpy(tmp_path: Path) -> None:
    """Nothing is computed to check a case: half the time of a check was loading numpy once."""
    modules = modules_after(COMMAND_LINE, tmp_path, "check", "cases/mfw2310.yaml")
    assert "numpy" not in packages(modules)


@pytest.mark.parametrize("case", ["grinding_spindle_catalogue", "spindle_on_housing"])
def test_a_check_that_needs_numpy_loads_no_scipy(case: str, tmp_path: Path) -> None:
    """Of estimated bearings and of a housing from files: loading it took half of their check."""
    loaded = modules_after(COMMAND_LINE, tmp_path, "check", f"cases/{case}.yaml")
    assert "numpy" in packages(loaded)
    assert not packages(loaded) & SCIENCE


def test_linear_supports_without_figures_load_no_bearing_solver_and_nothing_that_draws(
    tmp_path: Path,
) -> None:
    out = str(tmp_path / "out")
    argv = ("run", "cases/lalanne_ferraris.yaml", "--no-figures", "--quiet", "-o", out)
    loaded = modules_after(COMMAND_LINE, tmp_path, *argv)
    assert "rotordyn.analyses.campbell.solve" in loaded
    assert "bearings.ring.equilibrium" not in loaded
    assert not packages(loaded) & {"matplotlib", "pyvista", "vtkmodules", "numba"}


def test_a_spindle_is_solved_by_numpy_alone(tmp_path: Path) -> None:
    """The linear algebra of scipy takes a tenth of a second to load, as long as a stage."""
    code = "import rotordyn; from rotordyn.job import solve; solve(rotordyn.load('mfw2310'))"
    modules = modules_after(code, tmp_path)
    assert "rotordyn.analyses.stiffness.solve" in modules
    assert "scipy.linalg" not in modules
