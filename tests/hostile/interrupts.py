"""Ctrl-C at random moments of long runs of each analysis: how much work follows it.

The runs are forks of this process. Judged is the processor time after the signal, which a busy
machine does not change.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROTOR = "title: long\nspindle: {spindle}\nspeeds: {speeds}\nanalyses:\n  {analysis}\n"
BEARING = "title: long\nbearing: {bearing}\nspeeds: {speeds}\nanalyses:\n  {analysis}\n"
TICK = os.sysconf("SC_CLK_TCK")
MOST = 1.0  # s that may follow
BEYOND = 30.0  # s of processor time after which a run is killed


def _rotor(analysis: str, speeds: str, spindle: str = "grinding_spindle") -> str:
    return ROTOR.format(spindle=spindle, speeds=speeds, analysis=analysis)


def _bearing(analysis: str) -> str:
    speeds = "{from: 100 rpm, to: 20000 rpm, count: 1000}"
    return BEARING.format(bearing="vex70", speeds=speeds, analysis=analysis)


LOADS = ", ".join(f"{10 * k} N" for k in range(10, 200))
MANY = "{from: 0 rpm, to: 12000 rpm, count: 4000}"
CASES = {
    "campbell": _rotor("campbell: {max_frequency: 8 kHz}", MANY),
    "frf": _rotor(
        "frf: {frequencies: {from: 1 Hz, to: 4000 Hz, count: 20000}, pairs: "
        "[{response: nose.y, excitation: nose.y}, {response: nose.x, excitation: nose.x}]}",
        "{from: 0 rpm, to: 12000 rpm, count: 400}",
    ),
    "preload": _rotor("preload: {}", "{from: 0 rpm, to: 12000 rpm, count: 50000}"),
    "stiffness": _rotor("stiffness: {point: nose, max_force: 3 kN, steps: 200}", MANY),
    "bearing_loads": _rotor("bearing_loads: {loss_steps: 200}", MANY)
    + "conditions: {loads: [{at: nose, Fy: 3 kN}]}\n",
    "unbalance": _rotor(
        "unbalance: {points: [nose], unbalances: [{at: nose, unbalance: 1 g mm}]}", MANY
    ),
    "section_forces": _rotor("section_forces: {loads: [{at: nose, Fy: 1 kN}]}", MANY),
    "time_response": _rotor(
        "time_response: {duration: 100 ms, max_frequency: 8 kHz, points: [nose], forces: "
        "[{at: nose, direction: y, force: 1 kN}]}",
        "{from: 0 rpm, to: 12000 rpm, count: 20}",
    ),
    "matrices": _rotor("matrices: {max_frequency: 4 kHz, ports: [nose.y, nose.x]}", MANY),
    "static_sag": _rotor("static_sag: {point: nose}", MANY),
    "life": _rotor("life: {}", MANY),
    "thermal_preload": _rotor(
        "thermal_preload: {differences: {from: -10 K, to: 10 K, count: 2000}}", MANY
    ),
    "warm_up": _rotor("warm_up: {duration: 10 h, inner: 1 J/K, outer: 1 J/K}", MANY)
    + "conditions: {heat_flow: {inner_shaft: 3 W/K, outer_housing: 6 W/K, shaft: 30 degC, housing: "
    "25 degC, oil: 30 degC, lubricant: {viscosity_40: 32 mm^2/s, viscosity_100: 5.4 mm^2/s, "
    "temperature: 50 degC}}}\n",
    "axial_cycle": _rotor("axial_cycle: {highest: 2 kN, lowest: -2 kN, steps: 400}", MANY),
    "stability_lobes": _rotor(
        "stability_lobes: {point: nose, teeth: 4, diameter: 40 mm, tangential: 600 MPa, radial: "
        "200 MPa, milling: down, immersion: 0.3, max_frequency: 4000 Hz}",
        MANY,
    ),
    "bearing": _bearing(f"bearing: {{loads: [{LOADS}]}}"),
    "bearing radial": _bearing(f"bearing: {{radial_loads: [{LOADS}], axial_load: 1 kN}}"),
    "control": _bearing("control: {max_load: 5 kN}"),
}
DRAWN = _rotor("preload: {}\n  campbell: {}", "[0 rpm, 9000 rpm]")


class Stopped(NamedTuple):
    """``waited`` processor time before Ctrl-C and ``after`` it [s], exit code; None of a run that
    had ended before."""

    name: str
    waited: float
    after: float
    code: int | None


def stopped(name: str, folder: Path, waited: float, *words: str) -> Stopped:
    """A run that is sent Ctrl-C after so much processor time."""
    case = folder / "case.yaml"
    case.write_text(CASES[name], encoding="utf-8")
    process = _started(["run", str(case), "-o", str(folder / "out"), "--quiet", "--yes", *words])
    while (before := _spent(process)) < waited and _alive(process):
        time.sleep(0.01)
    os.kill(process, signal.SIGINT)
    while _alive(process):
        if _spent(process) - before > BEYOND:
            os.kill(process, signal.SIGKILL)
        time.sleep(0.01)
    _, status, used = os.wait4(process, 0)
    code = os.waitstatus_to_exitcode(status)
    after = used.ru_utime + used.ru_stime - before
    return Stopped(name, before, after, code if before >= waited else None)


def interrupts(folder: Path, count: int, seed: int = 0) -> Iterator[Stopped]:
    """Every analysis, stopped so many times."""
    chance = random.Random(seed)
    for name in CASES:
        for _ in range(count):
            yield stopped(name, folder, 0.2 + 3.0 * chance.random(), "--no-figures")


def drawn(folder: Path, count: int, seed: int = 0) -> Iterator[str]:
    """What is wrong after each of ``count`` signals while figures are drawn and the page is
    written, empty where nothing is; to the process alone or to its workers too."""
    chance, case, target = random.Random(seed), folder / "case.yaml", folder / "out"
    case.write_text(DRAWN, encoding="utf-8")
    words = ["run", str(case), "-o", str(target), "--quiet", "--report"]
    begin = time.perf_counter()
    os.waitpid(_started(words), 0)
    whole, held = time.perf_counter() - begin, _files(target)
    for _ in range(count):
        process = _started(words)
        while _alive(process) and not any(folder.glob(".out.*")):
            time.sleep(0.002)
        time.sleep(chance.uniform(0.0, whole))
        if not _alive(process):
            os.waitpid(process, 0)
            held = _files(target)
            yield ""
            continue
        send = chance.choice((os.kill, os.killpg))
        send(process, chance.choice((signal.SIGINT, signal.SIGTERM)))
        code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
        left = {each.name for each in folder.iterdir()} - {"case.yaml", "out"}
        changed = _files(target) != held
        held = _files(target)
        wrong = {f"exit code {code}": code not in (0, 130), f"left over: {left}": bool(left)}
        wrong |= {"other results": changed and code != 0, "a worker goes on": _group(process)}
        yield ", ".join(word for word, so in wrong.items() if so)


def _files(folder: Path) -> dict[Path, int]:
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*")}


def _group(leader: int) -> bool:
    """Whether a process of the group still runs."""
    try:
        os.killpg(leader, 0)
    except ProcessLookupError:
        return False
    return True


def _started(words: list[str]) -> int:
    process = os.fork()
    if process == 0:
        os.setsid()
        signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
        code = 1
        try:  # nothing of this process may be left by its copy
            from rotordyn.cli import main

            sys.stdout = open(os.devnull, "w")  # noqa: SIM115 - until the process ends
            code = main(words)
        except BaseException:  # noqa: BLE001 - whatever it is
            traceback.print_exc()
        finally:
            os._exit(code)
    return process


def _alive(process: int) -> bool:
    return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"


def _spent(process: int) -> float:
    """Processor time so far [s]."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICK
