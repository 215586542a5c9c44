"""Everything hostile:  python -m tests.hostile [--files] [--mutants N] [NAME …]

``--files``: every hostile file, checked and run; ``--mutants N``: so many of every shipped file,
checked; names of files: these alone. A line for each that is not as it must be.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.hostile.files import FILES
from tests.hostile.judged import Verdict, command, judged, loaded
from tests.hostile.mutants import files, written

Trial = tuple[str, Verdict]


def of_files(names: list[str]) -> Iterator[Trial]:
    """Hostile files, checked and run."""
    for name in names:
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            FILES[name](folder)
            case = folder / "case.yaml"
            yield f"check {name}", judged(command("check", case))
            how = ("-o", folder / "out", "--no-figures")
            yield f"run {name}", judged(command("run", case, *how))


def of_mutants(count: int) -> Iterator[Trial]:
    """Mutants of every shipped file, checked."""
    for path in files():
        for number in range(count):
            with tempfile.TemporaryDirectory() as place:
                found = judged(command("check", written(path, number, Path(place))))
                yield f"{path.parent.name}/{path.name} {number}", found


def main() -> None:
    """Try them, and print what is wrong."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--files", action="store_true")
    parser.add_argument("--mutants", type=int, default=0)
    parser.add_argument("names", nargs="*")
    asked = parser.parse_args()
    loaded()
    tried = wrong = 0
    names = [*FILES] if asked.files else asked.names
    for trials in (of_files(names), of_mutants(asked.mutants)):
        for name, found in trials:
            tried += 1
            if found.faults:
                wrong += 1
                said = found.said.strip().splitlines() or [""]
                print(f"{name}: {', '.join(found.faults)} | {said[-1][:200]}", flush=True)  # noqa: T201
    print(f"{tried} trials, {wrong} with a fault")  # noqa: T201


if __name__ == "__main__":
    main()
