"""Commands that solve many machines in a folder, where the same command can resume: sweep,
optimise, identify."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import rotordyn
from rotordyn.cli.signals import heed_signals, interruption
from rotordyn.cli.streams import bar, complain, say

Progress = Callable[[int, int], None]


def sweep(arguments: argparse.Namespace) -> int:
    """Solve a case at many points of its parameters."""
    from rotordyn.study.read import read_study

    heed_signals()
    study = read_study(arguments.study)
    from rotordyn.study.deliver import deliver

    folder = _folder(arguments, study.case.name)
    with _resumable(arguments, folder, "points", "what is solved is kept") as progress:
        delivered = deliver(
            study,
            folder,
            workers=arguments.workers,
            cluster=arguments.cluster,
            progress=progress,
            yes=arguments.yes,
            draw=not arguments.no_figures,
        )
    _told(arguments, delivered.summary, delivered.folder)
    return 0 if delivered.solved else 3


def optimise(arguments: argparse.Namespace) -> int:
    """Find the best machine."""
    from rotordyn.study.read import read_optimum

    heed_signals()
    problem, how = read_optimum(arguments.optimum)
    from rotordyn.study.optimum.deliver import deliver

    folder = _folder(arguments, problem.case.name)
    with _resumable(arguments, folder, "trials", "what is tried is kept") as progress:
        optimum, text = deliver(
            problem,
            folder,
            **how,
            workers=arguments.workers,
            progress=progress,
            draw=not arguments.no_figures,
        )
    _told(arguments, text, folder)
    return 0 if optimum.best is not None else 3


def identify(arguments: argparse.Namespace) -> int:
    """Find the machine that reproduces measurements."""
    from rotordyn.job.pages import REPORT
    from rotordyn.page.html import library
    from rotordyn.study.identification.deliver import deliver
    from rotordyn.study.identification.read import read_identification

    if arguments.report:
        library()
    heed_signals()
    request = read_identification(arguments.study)
    folder = _folder(arguments, request.case.name)
    with _resumable(arguments, folder, "searches", "searches that ended are kept") as progress:
        identification, text = deliver(
            request,
            folder,
            workers=arguments.workers,
            progress=progress,
            draw=not arguments.no_figures,
        )
        if arguments.report:
            rotordyn.write_report(folder, folder / REPORT)
    _told(arguments, text, folder)
    if identification.stopped:
        complain(f"interrupted: the best so far; the same command goes on in {folder}")
        return 130
    return 0


def _folder(arguments: argparse.Namespace, name: str) -> Path:
    return Path("out") / name if arguments.output is None else Path(arguments.output)


@contextmanager
def _resumable(
    arguments: argparse.Namespace, folder: Path, counted: str, kept: str
) -> Iterator[Progress]:
    """Show the progress of what is ``counted``; on Ctrl-C, print what is ``kept`` in ``folder``."""
    try:
        with bar(counted, None, quiet=arguments.quiet, timed=True) as update:
            yield lambda done, of: update(completed=done, total=of)
    except BaseException as error:
        if interruption(error) is None:
            raise
        sentence = f"interrupted; {kept}: the same command goes on in {folder}"
        raise KeyboardInterrupt(sentence) from error


def _told(arguments: argparse.Namespace, text: str, folder: Path) -> None:
    if not arguments.quiet:
        say(text)
        say(f"results in {folder}")
