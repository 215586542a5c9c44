"""Kill -9 at random moments of a run into one folder: it always holds results that are whole.

The runs are forks of this process, with everything loaded, so that most of their time is spent
where files are made.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import time
from pathlib import Path

CASE = """title: killed
bearing: vex70
speeds: [0 rpm, 15000 rpm]
analyses:
  bearing: {loads: [500 N, 1 kN]}
"""


def kills(folder: Path, count: int, seed: int = 0) -> list[str]:
    """What is wrong after each of ``count`` kills, and after a last run that is left alone."""
    import rotordyn

    chance = random.Random(seed)
    case, target = folder / "case.yaml", folder / "out"
    case.write_text(CASE, encoding="utf-8")
    begin = time.perf_counter()
    found = [] if _ended(_started(case, target)) == 0 else ["the first run fails"]
    whole = time.perf_counter() - begin
    for number in range(count):
        process = _started(case, target)
        time.sleep(whole * chance.random())
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        try:
            results = rotordyn.open(target)
            if "bearing" not in results or not results.summary:
                found.append(f"kill {number}: results without their parts")
        except Exception as error:  # noqa: BLE001 - whatever a half-written folder leads to
            found.append(f"kill {number}: {type(error).__name__}: {error}")
    if _ended(_started(case, target)) != 0:
        found.append("the last run does not recover")
    left = sorted(path.name for path in folder.iterdir() if path.name not in ("case.yaml", "out"))
    return found + [f"left over: {name}" for name in left]


def _started(case: Path, target: Path) -> int:
    process = os.fork()
    if process == 0:
        from rotordyn.cli import main

        sys.stdout = sys.stderr = open(os.devnull, "w")  # noqa: SIM115 - until the process ends
        os._exit(main(["run", str(case), "-o", str(target), "--no-figures", "--quiet"]))
    return process


def _ended(process: int) -> int:
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
