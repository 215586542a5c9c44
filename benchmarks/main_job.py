#!/usr/bin/env python3
"""Computing time and memory of the main job:  python benchmarks/main_job.py [--runs N] [--install]

Writes ``benchmarks/results.json``, and from it ``docs/benchmarks.md``. The processes are measured
first: a child's memory includes that of this process at its start, which is small until then.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
if str(ROOT) not in sys.path:
    sys.path.insert(0, str(ROOT))

from benchmarks.processes import (  # noqa: E402
    Cost,
    cost,
    first_cost,
    in_turn,
    python,
    summary,
    tree_memory,
)

CASE = "cases/mfw2310.yaml"
LIBRARY = f"import rotordyn; rotordyn.run(rotordyn.load({CASE!r}))"
SOLVE = "solve, all stages"
SHORT = {
    "check": ("-m", "rotordyn", "check", CASE),
    "--help": ("-m", "rotordyn", "--help"),
    "import rotordyn": ("-c", "import rotordyn"),
    "import bearings": ("-c", "import bearings"),
    "an empty Python": ("-c", ""),
}


def measure(runs: int = 7, *, install: bool = False) -> None:
    """Measure and write; an earlier installation and earlier surveys remain unchanged."""
    busy = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    with tempfile.TemporaryDirectory() as made:
        processes, stages, memory = _processes(Path(made) / "out", runs)
    subprocess.run(python("-m", "benchmarks.bearing"), cwd=ROOT, check=True)  # on one core
    from benchmarks.installation import measure_installation
    from benchmarks.kept import keep
    from benchmarks.precision import curves
    from benchmarks.rotor import measure_frf
    from benchmarks.sweeps import measure_sweeps

    found = {
        "machine": _machine(busy),
        "solve": stages.pop(SOLVE),
        "memory": {"tree": memory},
        "processes": processes,
        "stages": stages,
        "frf": measure_frf(),
        "precision": curves(),
        "sweeps": measure_sweeps(),
    }
    if install:
        found["install"] = measure_installation()
    keep(**found)


def _processes(
    folder: Path, runs: int
) -> tuple[list[dict[str, Any]], dict[str, float], float | None]:
    """Every process as a user starts it, stages of the run [s], its memory with its children."""
    run = python("-m", "rotordyn", "run", CASE, "--quiet", "-o", str(folder))
    records: list[dict[str, float]] = []

    def recorded() -> Cost:
        found = cost(run)
        records.append(json.loads((folder / "run.json").read_text())["stages"])
        return found

    long: dict[str, Callable[[], Cost]] = {
        "run, the first ever": partial(first_cost, run),
        "run": recorded,
        "run --no-figures": partial(cost, [*run, "--no-figures"]),
        "run from Python, no files and no figures": partial(cost, python("-c", LIBRARY)),
    }
    short: dict[str, Callable[[], Cost]] = {
        name: partial(cost, python(*what)) for name, what in SHORT.items()
    }
    found = {**in_turn(long, runs), **in_turn(short, 2 * runs)}
    stages = {name: median(r[name] for r in records[1:]) for name in records[0]}
    return [summary(*item) for item in found.items()], stages, tree_memory(run)


def _machine(busy: float | None) -> dict[str, Any]:
    import platform
    from importlib.metadata import version

    libraries = ("numpy", "scipy", "xarray", "matplotlib")
    count = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {
        "processors": count,
        "busy": busy,
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "libraries": {name: version(name) for name in libraries},
    }


def main() -> int:
    """Measure as the command line says, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=7, help="runs of which the median is taken")
    parser.add_argument("--install", action="store_true", help="measure the installation again")
    arguments = parser.parse_args()
    measure(arguments.runs, install=arguments.install)
    from docs.generate.pages import write_benchmarks

    write_benchmarks()
    return 0


if __name__ == "__main__":
    sys.exit(main())
