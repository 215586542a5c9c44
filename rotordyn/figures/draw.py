"""Draw many figures at once, shared with another process if the machine allows it."""

from __future__ import annotations

import gc
import json
import logging
import os
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Protocol

from rotordyn.figures.style import USUAL_FORMATS, finish, head, own_settings, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Figure  # noqa: PLC0414 - job names what it gives

Job = tuple[str, "Callable[[], Figure]"]
_MOST = 255
_OF_THE_BAR = "rich.live"  # its thread holds no lock that drawing needs


@dataclass(frozen=True, slots=True)
class Omitted:
    """``figures``, or files, that were not made, with the reason; ``sentences`` for the user."""

    figures: dict[str, str] = field(default_factory=dict)
    sentences: tuple[str, ...] = ()

    def __or__(self, other: Omitted) -> Omitted:
        """Return the omissions of both."""
        sentences = dict.fromkeys((*self.sentences, *other.sentences))
        return Omitted(self.figures | other.figures, tuple(sentences))


class Pictures(Protocol):
    """Pictures that another process makes while figures are drawn; ``omitted`` after ``draw``.

    It is a context, in which the process runs.
    """

    omitted: Omitted

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the figures, known before the process runs."""

    @property
    def count(self) -> int:
        """Number of pictures, known before the process runs."""

    def figure(self, name: str) -> Figure:
        """Wait for the pictures and draw one figure; InvalidInput if none can be made."""

    def draw(self, folder: Path, formats: Sequence[str]) -> dict[str, float]:
        """Wait for the pictures, write them in each of ``formats``; return seconds by figure."""

    def __enter__(self) -> Pictures: ...

    def __exit__(self, *_: object) -> None: ...


class Drawing:
    """Figures being drawn by workers. ``finish`` draws the rest and returns seconds by figure.

    It is a context, at whose end no worker draws any more.

    The list is shared through a pipe that holds one byte per figure: a free process takes one. A
    worker that fails leaves its figure to ``finish``, where the error is then raised.
    """

    def __init__(
        self,
        jobs: Sequence[Job],
        folder: Path,
        workers: int = 2,
        formats: Sequence[str] = USUAL_FORMATS,
    ) -> None:
        self._jobs, self._folder, self._formats = list(jobs), folder, tuple(formats)
        self._owner = os.getpid()
        queue, fill = os.pipe()
        self._queue = os.fdopen(queue, "rb", buffering=0)
        os.write(fill, bytes(range(min(len(self._jobs), _MOST))))
        os.close(fill)
        count = min(workers, _processors(), len(self._jobs)) - 1 if _may_fork() else 0
        load(self._formats)
        self._workers = [self._fork() for _ in range(max(count, 0))]

    def __enter__(self) -> Drawing:
        return self

    def __exit__(self, *_: object) -> None:
        """End workers that still draw, as after an interruption, whose folder is removed next."""
        for process, report in self._workers:
            with suppress(OSError):
                os.kill(process, signal.SIGKILL)
                os.waitpid(process, 0)
            report.close()
        self._queue.close()

    def finish(self) -> dict[str, float]:
        """Draw figures not yet begun, wait for the others; return seconds by figure, in order."""
        seconds = self._draw_queued()
        self._queue.close()
        while self._workers:
            process, report = self._workers[0]
            lines = report.read().decode().splitlines()
            os.waitpid(process, 0)
            self._workers.pop(0)[1].close()
            seconds |= dict(json.loads(line) for line in lines)
        for name, draw in self._jobs:
            if name not in seconds:
                seconds[name] = draw_one(name, draw, self._folder, self._formats)
        return {name: seconds[name] for name, _ in self._jobs}

    def _draw_queued(self, report: int | None = None) -> dict[str, float]:
        seconds = {}
        while taken := self._queue.read(1):
            if self._owner not in (os.getpid(), os.getppid()):
                break  # the process that started this worker is gone
            name, draw = self._jobs[taken[0]]
            seconds[name] = draw_one(name, draw, self._folder, self._formats)
            if report is not None:
                os.write(report, (json.dumps([name, seconds[name]]) + "\n").encode())
        return seconds

    def _fork(self) -> tuple[int, BinaryIO]:
        """Fork a worker; return its process and the pipe of its reports."""
        out, report = os.pipe()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            process = os.fork()
        if process:
            os.close(report)
            return process, os.fdopen(out, "rb")
        status = 1
        try:
            os.close(out)
            self._draw_queued(report)
            status = 0
        finally:
            os._exit(status)


def drawn(draw: Callable[[], Figure]) -> Figure:
    """Return a figure as in files; the caller's rcParams and backend have no effect and stay."""
    load()
    with own_settings():
        return finish(draw())


def titled(draw: Callable[[], Figure], words: str) -> Figure:
    """Return the figure that ``draw`` draws, with ``words`` at its top."""
    return head(draw(), words)


def draw_one(
    name: str,
    draw: Callable[[], Figure],
    folder: Path,
    formats: Sequence[str] = USUAL_FORMATS,
) -> float:
    """Draw and save one figure; return the seconds it took."""
    start = time.perf_counter()
    with own_settings(), warnings.catch_warnings(), _collected():
        warnings.filterwarnings("ignore", "Glyph")  # a title may hold letters that fonts lack, or $
        save(draw(), folder, name, formats)
    return time.perf_counter() - start


@contextmanager
def _collected() -> Iterator[None]:
    """Collect objects made inside at the end: a figure has many reference cycles and its pixels.

    Older objects are frozen meanwhile, so that the collector skips them. Nothing is done if a
    caller has frozen objects, since ``gc.unfreeze`` would release these too.
    """
    if gc.get_freeze_count():
        yield
        return
    gc.freeze()
    try:
        yield
    finally:
        gc.collect()
        gc.unfreeze()


def load(formats: Sequence[str] = USUAL_FORMATS) -> None:
    """Import what every process needs before forking; the font list is then built only once.

    A backend that the user names in the environment is set as matplotlib does, but a name that it
    does not know is ignored: nothing is shown. Messages of matplotlib about the settings of the
    user, which are not used, are suppressed.
    """
    first = "matplotlib" not in sys.modules
    with _without("MPLBACKEND") as backend, _silenced("matplotlib"):
        backends = [f"backends.backend_{ending}" for ending in formats if ending != "png"]
        for name in ("figure", "backends.backend_agg", "collections", *backends):
            import_module(f"matplotlib.{name}")
        if first and backend:
            with suppress(ValueError):
                sys.modules["matplotlib"].rcParams["backend"] = backend


@contextmanager
def _without(variable: str) -> Iterator[str | None]:
    value = os.environ.pop(variable, None)
    try:
        yield value
    finally:
        if value is not None:
            os.environ[variable] = value


@contextmanager
def _silenced(name: str) -> Iterator[None]:
    logger = logging.getLogger(name)
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


def _may_fork() -> bool:
    """Return whether a fork is safe: no other thread may hold a lock that the child needs."""
    others = [t for t in threading.enumerate() if t is not threading.current_thread()]
    return hasattr(os, "fork") and all(type(t).__module__ == _OF_THE_BAR for t in others)


def _processors() -> int:
    """Return the number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
