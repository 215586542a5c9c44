"""The same work here and in ROSS:  python -m benchmarks.peer [--python PATH] [--repeats N]

PATH: an interpreter that has the extra ``peer`` of this project; this one if none is given. Both
sides run in separate processes, first with one thread, then with two; with two the peer computes a
sample only. Written into ``benchmarks/results.json``, and from it into ``docs/benchmarks.md``.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from statistics import median
from typing import Any

import rotordyn
from benchmarks.kept import keep
from benchmarks.peer import machine
from benchmarks.processes import ROOT, cost, python

POOLS = ("OMP", "OPENBLAS", "MKL", "NUMBA")
THREADS = (1, 2)
PROCESSES = 3  # of which the median is taken
IMPORTS = {
    "import rotordyn": "import rotordyn",
    "import rotordyn, with all modules that a run needs": "from benchmarks.peer import cases, ours",
}


def threads(number: int) -> dict[str, str]:
    """Environment that limits a process to so many threads."""
    return {f"{pool}_NUM_THREADS": str(number) for pool in POOLS}


def measured(peer: str, repeats: int) -> dict[str, Any]:
    """Times of both sides by number of threads, errors, starts, versions."""
    busy = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        times = {str(number): _sides(peer, repeats, number, folder) for number in THREADS}
        first = times[str(THREADS[0])]
        return {
            "busy": busy,
            "python": platform.python_version(),
            "libraries": {
                "rotordyn": rotordyn.__version__,
                "numpy": version("numpy"),
                "scipy": version("scipy"),
            },
            "peer": {key: first["theirs"].pop(key) for key in ("python", "libraries")},
            "threads": times,
            "errors": _errors(folder / f"{THREADS[0]}" / "theirs.npz"),
            "starts": _starts(peer),
        }


def _sides(peer: str, repeats: int, number: int, folder: Path) -> dict[str, Any]:
    own = folder / str(number)
    own.mkdir()
    how = ["2"] if number == THREADS[0] else ["1", "--sample"]
    _run([peer, "-W", "ignore", "-m", "benchmarks.peer.theirs", str(own), *how], number)
    _run(python("-m", "benchmarks.peer.ours", str(own), str(repeats)), number)
    read = {name: json.loads((own / f"{name}.json").read_text()) for name in ("ours", "theirs")}
    return {"ours": read["ours"], "theirs": read["theirs"]}


def _run(command: Sequence[str], number: int) -> None:
    subprocess.run(
        command,
        cwd=ROOT,
        env=os.environ | threads(number),
        stdout=subprocess.DEVNULL,
        check=True,
    )


def _errors(results: Path) -> dict[str, Any]:
    """By kind of bearings; results of the peer are read from ``results``."""
    import numpy as np

    from benchmarks.peer.judged import judged

    found = {}
    with np.load(results) as every:
        for kind in machine.KINDS:
            own = {n.removeprefix(f"{kind}: "): every[n] for n in every if n.startswith(kind)}
            found[kind] = judged(kind, own)
    return found


def _starts(peer: str) -> dict[str, float]:
    """Seconds of processes from their start to their end, one thread."""
    one = threads(1)
    found = {
        name: median(cost(python("-c", code), one).wall for _ in range(PROCESSES))
        for name, code in IMPORTS.items()
    }
    found["import ross"] = median(
        cost([peer, "-W", "ignore", "-c", "import ross"], one).wall for _ in range(PROCESSES)
    )
    for kind in machine.KINDS:
        whole = python("-m", "benchmarks.peer.ours", "--once", "campbell", kind)
        found[f"Campbell, {kind}"] = median(cost(whole, one).wall for _ in range(PROCESSES))
    return found


def _has_peer(interpreter: str) -> bool:
    """The interpreter can import the peer."""
    tried = subprocess.run(
        [interpreter, "-W", "ignore", "-c", "import ross"],
        cwd=ROOT,
        capture_output=True,
        check=False,
    )
    return tried.returncode == 0


def main() -> int:
    """Measure, keep, and write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peer", description=__doc__)
    parser.add_argument("--python", default=sys.executable, help="interpreter that has the peer")
    parser.add_argument(
        "--repeats", type=int, default=9, help="of rotordyn, of which a median is taken"
    )
    asked = parser.parse_args()
    if not _has_peer(asked.python):
        parser.error(
            f"{asked.python} cannot import ross; install the extra there (pip install "
            "'.[peer]') or name an interpreter that has it with --python"
        )
    keep(peer=measured(asked.python, asked.repeats))
    from docs.generate.pages import write_benchmarks

    write_benchmarks()
    return 0


if __name__ == "__main__":
    sys.exit(main())
