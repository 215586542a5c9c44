"""The command line: parse, call, print, exit code. Everything else is imported when needed."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import rotordyn
from bearings.errors import BearingError
from rotordyn.errors import RotordynError, exit_code

if TYPE_CHECKING:
    from rotordyn.job import Progress

BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")  # more slow small matrices down
EXIT_CODES = """exit codes: 0 done; 2 bad input, nothing written; 3 no speed of the case has a
physical solution (with --strict: one has not); 1 a bug of rotordyn"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    arguments = _parser().parse_args(argv)
    for name in BLAS_THREADS:
        os.environ.setdefault(name, "1")
    try:
        code: int = arguments.command(arguments)
    except (RotordynError, BearingError) as error:
        print(error, file=sys.stderr)
        return exit_code(error)
    except BaseException as error:
        if not _interrupted(error):
            raise
        print("interrupted; nothing was written", file=sys.stderr)
        return 130
    return code


def _interrupted(error: BaseException | None) -> bool:
    """True where Ctrl-C is behind ``error``, even if a library has wrapped it."""
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return True
        error = error.__cause__ or error.__context__
    return False


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rotordyn",
        description="Dynamics of high-speed machining spindles.",
        epilog=EXIT_CODES,
    )
    parser.add_argument("--version", action="version", version=f"rotordyn {rotordyn.__version__}")
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")
    run = commands.add_parser("run", help="solve a case and write its results", epilog=EXIT_CODES)
    run.add_argument("case", metavar="CASE", help="case file (YAML)")
    run.add_argument("-o", "--output", metavar="DIR", help="results folder (out/<case name>)")
    run.add_argument("--only", metavar="NAME,…", help="only these analyses of the case")
    run.add_argument("--variant", metavar="NAME", help="only this variant of a case that compares")
    run.add_argument("--quiet", action="store_true", help="print nothing but errors")
    run.add_argument(
        "--strict", action="store_true", help="exit with 3 if any speed has no physical solution"
    )
    run.set_defaults(command=_run)
    check = commands.add_parser("check", help="read and validate a case, compute nothing")
    check.add_argument("case", metavar="CASE", help="case file (YAML)")
    check.set_defaults(command=_check)
    return parser


def _check(arguments: argparse.Namespace) -> int:
    case = rotordyn.load(arguments.case)
    questions = ", ".join(case.analyses)
    compared = f"; {len(case.variants)} variants" if case.variants else ""
    print(f"{arguments.case}: fine ({len(case.speeds)} speeds; {questions}{compared})")
    return 0


def _stopped(*_: object) -> None:
    """Leave the way Ctrl-C does, so that nothing half-written stays."""
    raise KeyboardInterrupt


def _run(arguments: argparse.Namespace) -> int:
    from rotordyn.job import deliver, one_variant, restricted

    signal.signal(signal.SIGTERM, _stopped)
    case = rotordyn.load(arguments.case)
    if arguments.variant is not None:
        case = one_variant(case, arguments.variant)
    if arguments.only is not None:
        case = restricted(case, tuple(name.strip() for name in arguments.only.split(",")))
    target = Path("out") / case.name if arguments.output is None else Path(arguments.output)
    steps = max(len(case.variants), 1) * len(case.analyses) + 1
    with _progress(steps, quiet=arguments.quiet) as progress:
        delivery = deliver(case, target, progress)
    if not arguments.quiet:
        print(delivery.summary)
        print(f"results in {delivery.folder}")
    if delivery.unsolved:
        print(f"not solved: {delivery.unsolved[0]}", file=sys.stderr)
        return 3 if arguments.strict else 0
    return 0


@contextmanager
def _progress(steps: int, *, quiet: bool) -> Iterator[Progress]:
    """A bar on the terminal that names what is being done; silent where nobody watches."""
    if quiet or not sys.stderr.isatty():
        yield lambda name: None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("reading", total=steps)

        def progress(name: str) -> None:
            bar.update(task, description=name)
            bar.advance(task)

        yield progress
