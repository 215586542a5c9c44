"""The command line: parse, call, print, exit code. Everything else is imported when needed."""

from __future__ import annotations

import _thread
import argparse
import io
import math
import os
import signal
import sys
import textwrap
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rotordyn
from bearings.errors import BearingError
from rotordyn.errors import InvalidInput, RotordynError, exit_code, not_installed
from rotordyn.plain import HANDLER, register

if TYPE_CHECKING:
    from rotordyn.case.shipped import Shipped

LATER = 0.05  # s after which what swallowed Ctrl-C has ended
CASE = "case file (YAML), or the name of a case that comes with rotordyn"
FILE = "case (default), spindle, tool, bearing, material, study, optimum or identification"
EXIT_CODES = """exit codes: 0 done; 2 bad input or too costly; 3 no speed of the case has a
physical solution (with --strict: one has not); 1 a bug of rotordyn"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    _speak_plainly()
    try:
        arguments = _parsed(argv)
        code: int = arguments.command(arguments)
    except (RotordynError, BearingError) as error:
        _complain(error)
        return exit_code(error)
    except ModuleNotFoundError as error:
        why = not_installed(error.name)
        if why is None:
            raise
        _complain(why)
        return 2
    except BaseException as error:
        if not _interrupted(error):
            raise
        _complain("interrupted; nothing was written")
        return 130
    return code


def _parsed(argv: Sequence[str] | None) -> argparse.Namespace:
    try:
        return _parser().parse_args(argv)
    except SystemExit:  # help, a version or a complaint has been printed
        _say("", end="")
        raise


def _speak_plainly() -> None:
    """Let streams that lack a symbol, such as µ in ASCII, print a plain word for it."""
    register()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=HANDLER)


def _say(text: object, end: str = "\n") -> None:
    """Print ``text`` at once; a reader who has closed the pipe, such as ``| head``, is no error.

    Raises
    ------
    InvalidInput : standard output takes nothing, such as a file on a full disk
    """
    if sys.stdout is None:  # closed before we began
        return
    try:
        print(text, end=end, flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            raise InvalidInput(f"standard output cannot be written: {error.strerror}") from error


def _complain(sentence: object) -> None:
    """Print ``sentence`` as an error, if anybody can still read it."""
    if sys.stderr is not None:
        with suppress(OSError):
            print(sentence, file=sys.stderr, flush=True)


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
    _add_run(commands)
    sweep = commands.add_parser(
        "sweep", help="solve a case at many points of what is varied in it", epilog=EXIT_CODES
    )
    sweep.add_argument("study", metavar="STUDY", help="study file (YAML)")
    sweep.add_argument("-o", "--output", metavar="DIR", help="its folder (out/<study name>)")
    sweep.add_argument("--workers", type=int, metavar="N", help="processes (one a processor)")
    sweep.add_argument(
        "--cluster", metavar="ADDRESS", help="of a dask scheduler whose workers solve instead"
    )
    sweep.add_argument("--yes", action="store_true", help="even if it takes more than an hour")
    sweep.add_argument("--no-figures", action="store_true", help="write numbers alone")
    sweep.add_argument("--quiet", action="store_true", help="print nothing but errors")
    sweep.set_defaults(command=_sweep)
    best = commands.add_parser(
        "optimise", help="find the best of what may be varied in a case", epilog=EXIT_CODES
    )
    best.add_argument("optimum", metavar="OPTIMUM", help="file of goals and limits (YAML)")
    best.add_argument("-o", "--output", metavar="DIR", help="its folder (out/<file name>)")
    best.add_argument("--workers", type=int, metavar="N", help="processes (one a processor)")
    best.add_argument("--no-figures", action="store_true", help="write numbers alone")
    best.add_argument("--quiet", action="store_true", help="print nothing but errors")
    best.set_defaults(command=_optimise)
    found = commands.add_parser(
        "identify", help="find the numbers of a case that show what was measured", epilog=EXIT_CODES
    )
    found.add_argument("study", metavar="STUDY", help="file of unknowns and measurements (YAML)")
    found.add_argument("-o", "--output", metavar="DIR", help="its folder (out/<file name>)")
    found.add_argument("--workers", type=int, metavar="N", help="processes (one a processor)")
    found.add_argument("--no-figures", action="store_true", help="write numbers alone")
    found.add_argument(
        "--report", action="store_true", help="also write report.html, a page to hand on"
    )
    found.add_argument("--quiet", action="store_true", help="print nothing but errors")
    found.set_defaults(command=_identify)
    report = commands.add_parser("report", help="write a results folder as one HTML page")
    report.add_argument(
        "folder", metavar="DIR", help="results folder of run, sweep, optimise or identify"
    )
    report.add_argument("-o", "--output", metavar="FILE", help="the page (DIR/report.html)")
    report.set_defaults(command=_report)
    check = commands.add_parser("check", help="read and validate a case, compute nothing")
    check.add_argument("case", metavar="CASE", help=CASE)
    check.set_defaults(command=_check)
    new = commands.add_parser("new", help="write a commented case and spindle file to start from")
    new.add_argument("name", metavar="NAME", help="writes NAME.yaml and NAME_spindle.yaml here")
    new.set_defaults(command=_new)
    cases = commands.add_parser("cases", help="list the cases that come with rotordyn")
    cases.set_defaults(command=_cases)
    models = commands.add_parser("models", help="list the models of the library, with sources")
    models.add_argument("kind", metavar="KIND", nargs="?", help="bearings, materials, spindles …")
    models.set_defaults(command=_models)
    schema = commands.add_parser("schema", help="print the JSON Schema of a file, for editors")
    schema.add_argument("file", metavar="FILE", nargs="?", default="case", help=FILE)
    schema.set_defaults(command=_schema)
    return parser


def _add_run(commands: Any) -> None:
    run = commands.add_parser("run", help="solve a case and write its results", epilog=EXIT_CODES)
    run.add_argument("case", metavar="CASE", help=CASE)
    run.add_argument("-o", "--output", metavar="DIR", help="results folder (out/<case name>)")
    run.add_argument("--only", metavar="NAME,…", help="only these analyses of the case")
    run.add_argument("--variant", metavar="NAME", help="only this variant of a case that compares")
    run.add_argument("--no-figures", action="store_true", help="write numbers and tables alone")
    run.add_argument(
        "--format", metavar="NAME,…", help="of figures: png (300 dpi, as without this), pdf, svg"
    )
    run.add_argument(
        "--explain", action="store_true", help="also print what was solved, spared and skipped, why"
    )
    run.add_argument(
        "--interval",
        action="store_true",
        help="also the range of every result over what is uncertain of the case",
    )
    run.add_argument(
        "--report", action="store_true", help="also write report.html, a page to hand on"
    )
    run.add_argument(
        "--longest", type=float, metavar="S", help="seconds that it may take by estimate (600)"
    )
    run.add_argument("--yes", action="store_true", help="however long and large it is")
    run.add_argument("--quiet", action="store_true", help="print nothing but errors")
    run.add_argument(
        "--strict", action="store_true", help="exit with 3 if any speed has no physical solution"
    )
    run.set_defaults(command=_run)


def _check(arguments: argparse.Namespace) -> int:
    case = rotordyn.load(arguments.case)
    questions = ", ".join(case.analyses)
    compared = f"; {_counted(len(case.variants), 'variant')}" if case.variants else ""
    speeds = _counted(len(case.speeds), "speed")
    _say(f"{arguments.case}: fine ({speeds}; {questions}{compared})")
    return 0


def _counted(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"


def _new(arguments: argparse.Namespace) -> int:
    from rotordyn.case.starter import write_starter

    case, spindle = write_starter(arguments.name, Path())
    print(f"wrote {case} and {spindle}; next: rotordyn check {case}, rotordyn run {case}")
    return 0


def _cases(_: argparse.Namespace) -> int:
    _list(rotordyn.cases())
    return 0


def _models(arguments: argparse.Namespace) -> int:
    _list(rotordyn.models(arguments.kind))
    return 0


def _list(shipped: Sequence[Shipped]) -> None:
    """A line each: kind, name, title; below it the first source."""
    columns = [max(len(part) for part in row) for row in zip(*map(_called, shipped), strict=True)]
    for item in shipped:
        kind, name = (f"{text:{n}}" for text, n in zip(_called(item), columns, strict=True))
        _say(f"{kind}  {name}  {item.title}")
        for source in item.sources[:1]:
            _say(" " * (sum(columns) + 4) + textwrap.shorten(source, 96, placeholder=" …"))


def _called(item: Shipped) -> tuple[str, str]:
    return item.kind, item.name


def _schema(arguments: argparse.Namespace) -> int:
    import json

    from rotordyn.case.schema import json_schema

    _say(json.dumps(json_schema(arguments.file), indent=2))
    return 0


def _stopped(*_: object) -> None:
    """Leave the way Ctrl-C does, so that nothing half-written stays."""
    raise KeyboardInterrupt


def _heed_signals() -> None:
    """Stop in good order when asked to; Windows has no SIGHUP, and nohup ignores it."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _stopped)
    sys.unraisablehook = _heeded


def _heeded(lost: sys.UnraisableHookArgs) -> None:
    """Stop once more, a little later, where Ctrl-C came within a finaliser, such as those of a
    compiler, which Python leaves out."""
    if not issubclass(lost.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(lost)
        return
    again = threading.Timer(LATER, _stop_main_thread)
    again.daemon = True
    again.start()


def _stop_main_thread() -> None:
    """By a signal, which wakes it where it waits; Windows has none for threads."""
    if sys.platform == "win32":
        _thread.interrupt_main(signal.SIGTERM)
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)


def _run(arguments: argparse.Namespace) -> int:
    from rotordyn.job import deliver, one_variant, restricted
    from rotordyn.study.run import run

    _heed_signals()
    case = rotordyn.load(arguments.case)
    if arguments.variant is not None:
        case = one_variant(case, arguments.variant)
    if arguments.only is not None:
        case = restricted(case, tuple(name.strip() for name in arguments.only.split(",")))
    formats = _formats(arguments.format)
    target = Path("out") / case.name if arguments.output is None else Path(arguments.output)
    steps = max(len(case.variants), 1) * len(case.analyses) + 1
    with _bar("reading", steps, quiet=arguments.quiet) as update:

        def progress(name: str) -> None:  # speeds: how far the analysis before them is
            update(description=name, advance=0 if name.endswith(" speeds") else 1)

        with _limited(arguments):
            delivery = deliver(
                case,
                target,
                progress,
                figures=not arguments.no_figures,
                formats=formats,
                report=arguments.report,
                solve=partial(run, interval=arguments.interval),
            )
    if not arguments.quiet:
        _say(delivery.summary)
        _say(f"results in {delivery.folder}")
    if delivery.moved:
        _complain(
            f"{target} cannot be replaced (is a file of it open in another program?): "
            f"the results are in {delivery.folder}"
        )
    if arguments.explain:
        _say(delivery.plan)
    if delivery.unsolved:
        _complain(f"not solved: {delivery.unsolved[0]}")
    if delivery.stop is not None:
        return exit_code(delivery.stop)
    return 3 if delivery.unsolved and arguments.strict else 0


def _limited(arguments: argparse.Namespace) -> AbstractContextManager[None]:
    """What a run may take, anything where the user says yes; ended, it keeps what is finished."""
    from rotordyn.allowance import LONGEST, within

    if arguments.yes:
        return within(math.inf, math.inf)
    seconds = LONGEST if arguments.longest is None else arguments.longest
    if not seconds > 0.0:
        raise InvalidInput(f"--longest {seconds:g}: allowed are seconds above 0")
    return within(seconds)


def _sweep(arguments: argparse.Namespace) -> int:
    from rotordyn.study.read import read_study

    _heed_signals()
    study = read_study(arguments.study)
    from rotordyn.study.deliver import deliver

    folder = Path("out") / study.case.name if arguments.output is None else Path(arguments.output)
    try:
        with _bar("points", None, quiet=arguments.quiet, timed=True) as update:
            left = deliver(
                study,
                folder,
                workers=arguments.workers,
                cluster=arguments.cluster,
                progress=lambda done, of: update(completed=done, total=of),
                yes=arguments.yes,
                draw=not arguments.no_figures,
            )
    except KeyboardInterrupt:
        _complain(f"interrupted; what is solved is kept: the same command goes on in {folder}")
        return 130
    if not arguments.quiet:
        _say(left.summary)
        _say(f"results in {left.folder}")
    return 0 if left.solved else 3


def _optimise(arguments: argparse.Namespace) -> int:
    from rotordyn.study.read import read_optimum

    _heed_signals()
    problem, how = read_optimum(arguments.optimum)
    from rotordyn.study.optimum.deliver import deliver

    name = problem.case.name
    folder = Path("out") / name if arguments.output is None else Path(arguments.output)
    try:
        with _bar("trials", None, quiet=arguments.quiet, timed=True) as update:
            found, text = deliver(
                problem,
                folder,
                **how,
                workers=arguments.workers,
                progress=lambda done, of: update(completed=done, total=of),
                draw=not arguments.no_figures,
            )
    except KeyboardInterrupt:
        _complain(f"interrupted; what is tried is kept: the same command goes on in {folder}")
        return 130
    if not arguments.quiet:
        _say(text)
        _say(f"results in {folder}")
    return 0 if found.best is not None else 3


def _identify(arguments: argparse.Namespace) -> int:
    from rotordyn.job.pages import REPORT
    from rotordyn.page.html import library
    from rotordyn.study.identification.deliver import deliver
    from rotordyn.study.identification.read import read_identification

    if arguments.report:
        library()
    _heed_signals()
    held = read_identification(arguments.study)
    name = held.case.name
    folder = Path("out") / name if arguments.output is None else Path(arguments.output)
    try:
        with _bar("searches", None, quiet=arguments.quiet, timed=True) as update:
            found, text = deliver(
                held,
                folder,
                workers=arguments.workers,
                progress=lambda done, of: update(completed=done, total=of),
                draw=not arguments.no_figures,
            )
        if arguments.report:
            rotordyn.write_report(folder, folder / REPORT)
    except KeyboardInterrupt:
        _complain(
            f"interrupted; searches that ended are kept: the same command goes on in {folder}"
        )
        return 130
    if not arguments.quiet:
        _say(text)
        _say(f"results in {folder}")
    if found.stopped:
        _complain(f"interrupted: the best so far; the same command goes on in {folder}")
        return 130
    return 0


def _report(arguments: argparse.Namespace) -> int:
    from rotordyn.job.pages import REPORT

    _heed_signals()
    folder = Path(arguments.folder)
    path = folder / REPORT if arguments.output is None else Path(arguments.output)
    _say(rotordyn.write_report(folder, path))
    return 0


@contextmanager
def _bar(
    task: str, total: int | None, *, quiet: bool, timed: bool = False
) -> Iterator[Callable[..., None]]:
    """A bar on the terminal, ``timed`` with the time left, moved by keywords of rich's ``update``;
    silent where nobody watches, and without rich: work goes on without its bar."""
    if quiet or sys.stderr is None or not sys.stderr.isatty():
        yield lambda **_: None
        return
    try:
        from rich import progress
        from rich.console import Console
    except ModuleNotFoundError:
        yield lambda **_: None
        return
    columns = progress.Progress.get_default_columns()
    if timed:
        columns = (
            progress.BarColumn(), progress.MofNCompleteColumn(), progress.TimeRemainingColumn()
        )  # fmt: skip
    with progress.Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        yield partial(bar.update, bar.add_task(task, total=total))


def _formats(words: str | None) -> tuple[str, ...]:
    """Formats of figures that the command line names.

    Raises
    ------
    InvalidInput : one of them is none
    """
    from rotordyn.figures.style import FORMATS, USUAL_FORMATS

    if words is None:
        return USUAL_FORMATS
    names = tuple(dict.fromkeys(word.strip().lower().lstrip(".") for word in words.split(",")))
    for word in names:
        if word not in FORMATS:
            raise InvalidInput(f"--format {word}: figures are written as {', '.join(FORMATS)}")
    return names
