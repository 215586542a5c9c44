"""What the gallery shows is run, and kept as long as nothing has changed that it depends on.

Processes that ask for the same run at once wait for the one that came first.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import version
from pathlib import Path

from docs.generate.places import ROOT

COMPUTES = ("rotordyn", "bearings")
LIBRARIES = ("numpy", "scipy", "matplotlib")
# Runs an example without a screen, then keeps the figures that it has left open.
EXAMPLE = """
import runpy, sys, warnings
import matplotlib
matplotlib.use("Agg")
warnings.filterwarnings("ignore", "FigureCanvasAgg is non-interactive")
del sys.argv[0]  # as if the example were called by its name alone
runpy.run_path(sys.argv[0], run_name="__main__")
import matplotlib.pyplot as plt
for number in plt.get_fignums():
    plt.figure(number).savefig(f"figure_{number}.png", dpi=150)
"""


def case_run(case: Path, digest: str, runs: Path) -> Path:
    """Results folder of a case file whose content, models included, has ``digest``.

    Any warning fails the run.
    """
    folder = runs / case.stem

    def run() -> None:
        _python("-W", "error", "-m", "rotordyn", "run", str(case), "-o", str(folder), "--quiet")

    return _kept(folder, _hash([digest.encode()]), run)


def example_run(script: Path, runs: Path) -> Path:
    """Folder in which a script of ``docs/examples`` has run; what it printed is ``printed.txt``.

    ``cases`` and ``models`` stand in that folder as they do at the root of the repository.
    """
    folder = runs / "examples" / script.stem

    def run() -> None:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name in ("cases", "models"):
            (folder / name).symlink_to(ROOT / name)
        printed = _python("-c", EXAMPLE, str(script), cwd=folder)
        (folder / "printed.txt").write_text(printed, encoding="utf-8")

    inputs = [p.read_bytes() for name in ("cases", "models") for p in _files(ROOT / name, "*.yaml")]
    return _kept(folder, _hash([script.read_bytes(), *inputs]), run)


def _kept(folder: Path, key: str, run: Callable[[], None]) -> Path:
    """``folder``, made by ``run`` unless it was made under the same ``key``."""
    note = folder.with_name(f"{folder.name}.key")
    with locked(folder):
        if folder.is_dir() and note.exists() and note.read_text(encoding="utf-8") == key:
            return folder
        note.unlink(missing_ok=True)
        run()
        note.write_text(key, encoding="utf-8")
    return folder


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Nobody else is in here for the same ``folder``, which need not exist yet."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    with folder.with_name(f"{folder.name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _hash(inputs: Iterable[bytes]) -> str:
    total = hashlib.sha256(_program().encode())
    for content in inputs:
        total.update(hashlib.sha256(content).digest())
    return total.hexdigest()


@cache
def _program() -> str:
    """Hash of all code that computes, this file included, and the versions it stands on."""
    total = hashlib.sha256(" ".join(map(version, LIBRARIES)).encode())
    sources = (path for name in COMPUTES for path in _files(ROOT / name, "*.py"))
    for path in (*sources, Path(__file__)):
        total.update(hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()


def _files(folder: Path, pattern: str) -> list[Path]:
    return sorted(folder.rglob(pattern))


def _python(*argv: str, cwd: Path = ROOT) -> str:
    """What an interpreter prints that finds the packages of the repository; it must succeed."""
    env = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, *argv], cwd=cwd, env=env, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(f"{' '.join(argv)}\n{done.stdout}{done.stderr}")
    return done.stdout
