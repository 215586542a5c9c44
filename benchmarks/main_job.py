#!/usr/bin/env python3
"""What the main job costs:  python benchmarks/main_job.py [--runs N] [--install]

Writes ``benchmarks/results.json``, and from it ``docs/benchmarks.md``. The processes are measured
first: a child's memory is counted from that of this process on, which is small until then.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
if str(ROOT) not in sys.path:
    sys.path.insert(0, str(ROOT))

from benchmarks.processes import Cost, cost, python, tree_memory, typical, typical_first  # noqa: E402

CASE = "cases/mfw2310.yaml"
RESULTS = ROOT / "benchmarks" / "results.json"
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
    """Measure everything and write it down; an installation measured earlier is kept."""
    with tempfile.TemporaryDirectory() as made:
        processes, memory = _processes(Path(made), runs)
        stages = _stages(Path(made), runs)
    from benchmarks.bearing import measure_bearing
    from benchmarks.rotor import cutoffs, element_lengths, measure_frf

    found = {
        "machine": _machine(),
        "solve": stages.pop(SOLVE),
        "memory": memory,
        "processes": processes,
        "stages": stages,
        "bearing": measure_bearing(),
        "frf": measure_frf(),
        "element_length": element_lengths(),
        "cutoff": cutoffs(),
        "install": _installation(anew=install),
    }
    RESULTS.write_text(json.dumps(_rounded(found), indent=1, ensure_ascii=False) + "\n")


def _processes(folder: Path, runs: int) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """Every process as a user starts it, and the memory of the run with its helpers."""
    run = python("-m", "rotordyn", "run", CASE, "--quiet", "-o", str(folder / "out"))
    found = [
        _named("run, the first ever", typical_first(run, min(runs, 5)), min(runs, 5)),
        _named("run", typical(run, runs), runs),
        _named("the same from Python, no files and no figures", _of(("-c", LIBRARY), runs), runs),
    ]
    found += [_named(name, _of(what, 2 * runs), 2 * runs) for name, what in SHORT.items()]
    return found, {"tree": tree_memory(run)}


def _of(arguments: tuple[str, ...], runs: int) -> Cost:
    return typical(python(*arguments), runs)


def _named(name: str, found: Cost, runs: int) -> dict[str, Any]:
    return {
        "name": name,
        "wall": found.wall,
        "cpu": found.cpu,
        "memory": found.memory,
        "runs": runs,
    }


def _stages(folder: Path, runs: int) -> dict[str, float]:
    """Median seconds of every stage, as the run's own record states them."""
    records: list[dict[str, float]] = []
    for _ in range(runs):
        cost(python("-m", "rotordyn", "run", CASE, "--quiet", "-o", str(folder / "out")))
        records.append(json.loads((folder / "out" / "run.json").read_text())["stages"])
    return {name: median(record[name] for record in records) for name in records[0]}


def _machine() -> dict[str, Any]:
    import platform
    from importlib.metadata import version

    libraries = ("numpy", "scipy", "pydantic", "xarray", "matplotlib")
    count = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {
        "processors": count,
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "libraries": {name: version(name) for name in libraries},
    }


def _installation(*, anew: bool) -> dict[str, Any] | None:
    if anew:
        from benchmarks.installation import measure_installation

        return measure_installation()
    if not RESULTS.exists():
        return None
    known: dict[str, Any] | None = json.loads(RESULTS.read_text()).get("install")
    return known


def _rounded(value: Any) -> Any:
    """Numbers with four digits that count."""
    if isinstance(value, dict):
        return {key: _rounded(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [_rounded(inner) for inner in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value


def main() -> int:
    """Measure as the command line says, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=7, help="runs of which the median is taken")
    parser.add_argument("--install", action="store_true", help="measure the installation anew")
    arguments = parser.parse_args()
    measure(arguments.runs, install=arguments.install)
    from docs.generate.pages import write_benchmarks

    write_benchmarks()
    return 0


if __name__ == "__main__":
    sys.exit(main())
