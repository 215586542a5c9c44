"""What is printed, on streams that lack symbols, are full or closed; a bar on terminals."""

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
    """Let streams that lack a symbol, such as µ in ASCII, print a plain word for it."""
    register()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=HANDLER)


@contextmanager
def warned_plainly() -> Iterator[None]:
    """Warnings of Python are one sentence, without the line of the program that gave them."""
    with warnings.catch_warnings():
        warnings.showwarning = lambda message, *_, **__: complain(f"warning: {message}")
        yield


def say(text: object, end: str = "\n") -> None:
    """Print ``text`` at once; a reader who has closed the pipe, such as ``| head``, is no error.

    Raises
    ------
    InvalidInput : standard output takes nothing, such as a file on a full disk
    """
    if sys.stdout is None:  # closed before we began
        return
    try:
        print(_lines(text), end=end, flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            raise InvalidInput(f"standard output cannot be written: {error.strerror}") from error


def complain(sentence: object) -> None:
    """Print ``sentence`` as an error, if anybody can still read it."""
    if sys.stderr is not None:
        with suppress(OSError):
            print(_lines(sentence), file=sys.stderr, flush=True)


def _lines(text: object) -> str:
    """Lines without characters that move the cursor, change colours or turn the direction."""
    return "\n".join(map(printable, str(text).split("\n")))


@contextmanager
def bar(
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
    with progress.Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        yield partial(shown.update, shown.add_task(task, total=total))
