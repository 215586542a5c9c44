"""Commands that solve one case and write its results or its page: run, report."""

from __future__ import annotations

import argparse
import math
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import rotordyn
from rotordyn.cli.signals import heed_signals
from rotordyn.cli.streams import bar, complain, say
from rotordyn.errors import InvalidInput, exit_code

if TYPE_CHECKING:
    from rotordyn.case.case import Case
    from rotordyn.job import Delivery


def run(arguments: argparse.Namespace) -> int:
    """Solve a case, write its folder, print its summary."""
    from rotordyn.job import deliver
    from rotordyn.study.run import run as solve

    heed_signals()
    case = _asked(arguments)
    formats = _formats(arguments.format)
    target = Path("out") / case.name if arguments.output is None else Path(arguments.output)
    steps = max(len(case.variants), 1) * len(case.analyses) + 1
    with bar("reading", steps, quiet=arguments.quiet) as update:

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
                solve=partial(solve, interval=arguments.interval),
            )
    return _told(arguments, target, delivery)


def _asked(arguments: argparse.Namespace) -> Case:
    """Load the case, restricted to the requested variant and analyses."""
    from rotordyn.job import one_variant, restricted

    case = rotordyn.load(arguments.case)
    if arguments.variant is not None:
        case = one_variant(case, arguments.variant)
    if arguments.only is not None:
        case = restricted(case, tuple(name.strip() for name in arguments.only.split(",")))
    return case


def _limited(arguments: argparse.Namespace) -> AbstractContextManager[None]:
    """Limits of time and memory of the run; none with --yes."""
    from rotordyn.allowance import LONGEST, within

    if arguments.yes:
        return within(math.inf, math.inf)
    seconds = LONGEST if arguments.longest is None else arguments.longest
    if not seconds > 0.0:
        raise InvalidInput(f"--longest {seconds:g}: allowed are seconds above 0")
    return within(seconds)


def _formats(words: str | None) -> tuple[str, ...]:
    """Parse the formats of figures given on the command line.

    Raises
    ------
    InvalidInput : an unknown format
    """
    from rotordyn.figures.style import FORMATS, USUAL_FORMATS

    if words is None:
        return USUAL_FORMATS
    names = tuple(dict.fromkeys(word.strip().lower().lstrip(".") for word in words.split(",")))
    for word in names:
        if word not in FORMATS:
            raise InvalidInput(f"--format {word:.200}: figures are written as {', '.join(FORMATS)}")
    return names


def _told(arguments: argparse.Namespace, target: Path, delivery: Delivery) -> int:
    """Print the outcome of a run; return its exit code."""
    from rotordyn.results.text import grouped

    if not arguments.quiet:
        from rotordyn.cli.screen import on_screen

        say(on_screen(delivery.summary, delivery.folder / "summary.txt"))
        say(f"results in {delivery.folder}")
    if delivery.moved:
        why = "cannot be replaced (is a file of it open in another program?)"
        why = "keeps its earlier results, which are complete" if delivery.kept else why
        complain(f"{target} {why}: the results are in {delivery.folder}")
    if arguments.explain:
        say(delivery.plan)
    for sentence in grouped(delivery.unsolved):
        complain(f"not solved: {sentence}")
    if delivery.stop is not None:
        return exit_code(delivery.stop)
    return 3 if delivery.unsolved and arguments.strict else 0


def report(arguments: argparse.Namespace) -> int:
    """Write the page of a results folder."""
    from rotordyn.job.pages import REPORT

    heed_signals()
    folder = Path(arguments.folder)
    path = folder / REPORT if arguments.output is None else Path(arguments.output)
    say(rotordyn.write_report(folder, path))
    return 0
