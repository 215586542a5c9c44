"""Print to streams that may lack symbols, be full or closed; a progress bar on terminals."""

from __future__ import annotations

import io
import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial

from rotordyn.errors import InvalidInput, printable
from rotordyn.plain import HANDLER, register


def speak_plainly() -> None:
    """Let streams replace symbols that their encoding lacks, such as µ in ASCII."""
    register()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=HANDLER)


@contextmanager
def warned_plainly() -> Iterator[None]:
    """Print Python warnings as one sentence, without the source line."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_, **__: complain(f"warning: {message}")
        yield


def say(text: object, end: str = "\n") -> None:
    """Print ``text`` at once; a closed pipe, as of ``| head``, is no error.

    Raises
    ------
    InvalidInput : standard output cannot be written, such as a file on a full disk
    """
    if sys.stdout is None:  # closed before the start
        return
    try:
        print(_lines(text), end=end, flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            raise InvalidInput(f"standard output cannot be written: {error.strerror}") from error


def complain(sentence: object) -> None:
    """Print ``sentence`` to standard error, if that is still open."""
    if sys.stderr is not None:
        with suppress(OSError):
            print(_lines(sentence), file=sys.stderr, flush=True)


def _lines(text: object) -> str:
    """Remove control characters from each line."""
    return "\n".join(map(printable, str(text).split("\n")))


@contextmanager
def bar(
    task: str, total: int | None, *, quiet: bool, timed: bool = False
) -> Iterator[Callable[..., None]]:
    """Progress bar on the terminal, ``timed`` with the remaining time; yields rich's ``update``. No
    bar if standard error is no terminal, or without rich."""
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
    with progress.Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        yield partial(shown.update, shown.add_task(task, total=total))
