"""Everything hostile:  python -m tests.hostile [--all] [--files] [--mutants N] … [NAME …]

``--files``: every hostile file, checked and run, and the grid of odd values and sizes, checked;
``--mutants N``: so many of every shipped file, checked, and ``--runs``: those that pass, run;
``--machines N``: so many extreme machines, run, from number ``--first`` on; ``--calls N``: so many
calls of the Python API; ``--kills N``: so many kills of a run; ``--interrupts N``: Ctrl-C in so
many runs of every analysis, and four times as many signals while figures are drawn; names of files:
these alone. ``--all``: 10 000 mutants, a thousand machines, every call and 200 kills. A line for
each that is not as it must be; the exit code is 1 if there is any.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.hostile import calls, interrupts, kills, machines
from tests.hostile.files import FILES
from tests.hostile.grid import grid
from tests.hostile.judged import SECONDS, Verdict, command, judged, loaded
from tests.hostile.mutants import files, written
from tests.hostile.numbers import words_of_nan

Trial = tuple[str, Verdict]
FINE = Verdict(0, "", 0.0, 0.0)
RUN = 10.0  # s of a run, which may take 5 s by estimate


def of_files(names: list[str]) -> Iterator[Trial]:
    """Hostile files, checked and run."""
    for name in names:
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            FILES[name](folder)
            case = folder / "case.yaml"
            yield f"check {name}", judged(command("check", case))
            yield f"run {name}", _run(case)


def of_grid() -> Iterator[Trial]:
    """Odd values, sizes and headers, checked."""
    for name, write in grid().items():
        with tempfile.TemporaryDirectory() as place:
            write(Path(place))
            yield f"check {name}", judged(command("check", Path(place) / "case.yaml"))


def of_mutants(count: int, runs: bool) -> Iterator[Trial]:
    """Mutants of every shipped file, checked; those that pass are run as well if requested."""
    for path in files():
        for number in range(count):
            with tempfile.TemporaryDirectory() as place:
                name, case = f"{path.parent.name}/{path.name} {number}", Path(place) / "case.yaml"
                case = written(path, number, Path(place))
                found = judged(command("check", case))
                yield name, found
                if runs and found.code == 0:
                    yield f"run {name}", _run(case)


def of_machines(count: int, first: int = 0) -> Iterator[Trial]:
    """Extreme machines from the number ``first`` on, run."""
    for number in range(first, first + count):
        with tempfile.TemporaryDirectory() as place:
            yield f"machine {number}", _run(machines.written(number, Path(place)))


def _run(case: Path) -> Verdict:
    out = case.parent / "out"
    words = ("-o", out, "--no-figures", "--quiet", "--longest", SECONDS)
    return judged(command("run", case, *words, then=lambda: words_of_nan(out)), RUN)


def of_calls(count: int) -> Iterator[Trial]:
    """Calls of the Python API."""
    every = calls.calls()
    chosen = every if count >= len(every) else calls.sample(count)
    found = {each.call: each.fault for each in calls.of(chosen)}
    for call in chosen:
        fault = found.get(call, "")
        yield " ".join(call), Verdict(1 if fault else 0, fault, 0.0, 0.0)


def of_kills(count: int) -> Iterator[Trial]:
    """Kills of a run."""
    with tempfile.TemporaryDirectory() as place:
        found = kills.kills(Path(place), count) if count else []
    for number in range(count):
        yield "kill", Verdict(1, found[number], 0.0, 0.0) if number < len(found) else FINE


def of_interrupts(count: int) -> Iterator[Trial]:
    """Ctrl-C in long runs of every analysis, and while figures are drawn."""
    with tempfile.TemporaryDirectory() as place:
        for name, waited, after, code in interrupts.interrupts(Path(place), count):
            said = f"Ctrl-C after {waited:.1f} s: exit code {code}, {after:.1f} s later"
            fine = code in (None, 130) and after <= interrupts.MOST
            yield f"interrupt {name}", FINE if fine else Verdict(1, said, after, 0.0)
        for wrong in interrupts.drawn(Path(place), 4 * count):
            yield "interrupt figures", Verdict(1, wrong, 0.0, 0.0) if wrong else FINE


def main() -> int:
    """Try them, and print what is wrong."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    for word in ("all", "files", "runs"):
        parser.add_argument(f"--{word}", action="store_true")
    for word in ("mutants", "machines", "calls", "kills", "interrupts"):
        parser.add_argument(f"--{word}", type=int, default=0, metavar="N")
    parser.add_argument("--first", type=int, default=0, metavar="N", help="number of a machine")
    parser.add_argument("names", nargs="*")
    asked = parser.parse_args()
    if asked.all:
        asked.files, asked.mutants, asked.machines, asked.calls = True, 77, 1000, 10**9
        asked.kills, asked.interrupts = 200, 5
    loaded()
    tried = wrong = 0
    names = [*FILES] if asked.files else asked.names
    for trials in (
        of_files(names),
        of_grid() if asked.files else iter(()),
        of_mutants(asked.mutants, asked.runs),
        of_machines(asked.machines, asked.first),
        of_calls(asked.calls) if asked.calls else iter(()),
        of_kills(asked.kills),
        of_interrupts(asked.interrupts),
    ):
        for name, found in trials:
            tried += 1
            if found.faults:
                wrong += 1
                said = found.said.strip().splitlines() or [""]
                print(f"{name}: {', '.join(found.faults)} | {said[-1][:200]}", flush=True)  # noqa: T201
        print(f"{tried} trials, {wrong} with a fault", flush=True)  # noqa: T201
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
