"""Runs of the gallery, kept as long as nothing changes that they depend on.

Processes that need the same run at the same time wait for the first of them.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import version
from pathlib import Path

import rotordyn
from docs.generate.places import ROOT
from rotordyn.case.case import Case
from rotordyn.job.delivery import write

COMPUTES = ("rotordyn", "bearings")
LIBRARIES = ("numpy", "scipy", "matplotlib")


def case_run(case: Case, runs: Path) -> Path:
    """Results folder of a case; its digest covers all files that it reads, models included.

    Any warning fails the run.
    """
    folder = runs / case.name

    def run() -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            write(rotordyn.run(case, interval=case.uncertain is not None), folder)

    return _kept(folder, _hash([case.digest.encode()]), run)


def example_run(script: Path, runs: Path) -> Path:
    """Folder in which a script of ``docs/examples`` has run as its reader runs it.

    It contains ``figure.png`` and the output, ``printed.txt``. Any warning and any text on standard
    error fail the run.
    """
    folder = runs / "examples" / script.stem

    def run() -> None:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        printed = _python("-W", "error", str(script), "figure.png", cwd=folder)
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
    """Only one process at a time holds the lock of ``folder``, which need not exist yet."""
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
    """Hash of all code that computes, this file included, and the versions of its libraries."""
    total = hashlib.sha256(" ".join(map(version, LIBRARIES)).encode())
    sources = (path for name in COMPUTES for path in _files(ROOT / name, "*.py"))
    for path in (*sources, Path(__file__)):
        total.update(hashlib.sha256(path.read_bytes()).digest())
    return total.hexdigest()


def _files(folder: Path, pattern: str) -> list[Path]:
    return sorted(folder.rglob(pattern))


def _python(*argv: str, cwd: Path) -> str:
    """Output of an interpreter that imports the packages of the repository; it must succeed."""
    env = os.environ | {"PYTHONPATH": str(ROOT), "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, *argv], cwd=cwd, env=env, capture_output=True, text=True, check=False
    )
    if done.returncode or done.stderr:
        raise RuntimeError(f"{' '.join(argv)}\n{done.stdout}{done.stderr}")
    return done.stdout
