"""Draw many figures at once: one more process shares the list where the machine allows it."""

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
_OF_THE_BAR = "rich.live"  # whose thread locks nothing that drawing needs


@dataclass(frozen=True, slots=True)
class Omitted:
    """``figures``, or files, that were not made -> why, and the sentence the user reads of it."""

    figures: dict[str, str] = field(default_factory=dict)
    sentences: tuple[str, ...] = ()

    def __or__(self, other: Omitted) -> Omitted:
        """What either of the two lacks."""
        sentences = dict.fromkeys((*self.sentences, *other.sentences))
        return Omitted(self.figures | other.figures, tuple(sentences))


class Pictures(Protocol):
    """Pictures that another process makes while figures are drawn; ``omitted`` after ``draw``.

    A context: the process runs inside it.
    """

    omitted: Omitted

    @property
    def names(self) -> tuple[str, ...]:
        """Of the figures, known before the process runs."""

    @property
    def count(self) -> int:
        """Of pictures, likewise."""

    def figure(self, name: str) -> Figure:
        """Wait for the pictures and draw one figure; InvalidInput where none can be made."""

    def draw(self, folder: Path, formats: Sequence[str]) -> dict[str, float]:
        """Wait for them and write them in each of ``formats``; seconds by figure."""

    def __enter__(self) -> Pictures: ...

    def __exit__(self, *_: object) -> None: ...


class Drawing:
    """Figures being drawn. ``finish`` helps with the rest and returns seconds per figure.

    A context, at whose end nobody draws any more.

    The list is shared through a pipe that holds one byte per figure: whoever is free takes one. A
    worker that fails leaves its figure to ``finish``, where the error then surfaces.
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
        self._workers = [self._start() for _ in range(max(count, 0))]

    def __enter__(self) -> Drawing:
        return self

    def __exit__(self, *_: object) -> None:
        """End workers that still draw: of an interrupted run, whose folder is removed next."""
        for process, report in self._workers:
            with suppress(OSError):
                os.kill(process, signal.SIGKILL)
                os.waitpid(process, 0)
            report.close()
        self._queue.close()

    def finish(self) -> dict[str, float]:
        """Draw what nobody has begun, wait for the others; seconds by figure, in order."""
        seconds = self._work()
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

    def _work(self, report: int | None = None) -> dict[str, float]:
        seconds = {}
        while taken := self._queue.read(1):
            if self._owner not in (os.getpid(), os.getppid()):
                break  # whoever asked has been killed
            name, draw = self._jobs[taken[0]]
            seconds[name] = draw_one(name, draw, self._folder, self._formats)
            if report is not None:
                os.write(report, (json.dumps([name, seconds[name]]) + "\n").encode())
        return seconds

    def _start(self) -> tuple[int, BinaryIO]:
        """Fork a worker; returns its process and the pipe it reports to."""
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
            self._work(report)
            status = 0
        finally:
            os._exit(status)


def drawn(draw: Callable[[], Figure]) -> Figure:
    """A figure as files show it; neither the caller's rcParams nor the backend matter or change."""
    load()
    with own_settings():
        return finish(draw())


def titled(draw: Callable[[], Figure], words: str) -> Figure:
    """The figure that ``draw`` draws, with ``words`` at its top."""
    return head(draw(), words)


def draw_one(
    name: str,
    draw: Callable[[], Figure],
    folder: Path,
    formats: Sequence[str] = USUAL_FORMATS,
) -> float:
    """Draw and save one figure; returns the seconds it took."""
    start = time.perf_counter()
    with own_settings(), warnings.catch_warnings(), _freed():
        warnings.filterwarnings("ignore", "Glyph")  # a title may hold letters that fonts lack, or $
        save(draw(), folder, name, formats)
    return time.perf_counter() - start


@contextmanager
def _freed() -> Iterator[None]:
    """Free at the end what has been made inside: a figure is full of circles and holds its pixels.

    Whatever is older is frozen for the while, so that the collector need not look at it; nothing is
    done where a caller has frozen objects, which could not be told from these.
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
    does not know is not ours to judge: nothing is shown. What matplotlib has to say of the user's
    settings, which we do not use, is not heard either.
    """
    first = "matplotlib" not in sys.modules
    with _without("MPLBACKEND") as backend, _quiet("matplotlib"):
        backends = [f"backends.backend_{ending}" for ending in formats if ending != "png"]
        for name in ("figure", "backends.backend_agg", "collections", *backends):
            import_module(f"matplotlib.{name}")
        if first and backend:
            with suppress(ValueError):
                sys.modules["matplotlib"].rcParams["backend"] = backend


@contextmanager
def _without(variable: str) -> Iterator[str | None]:
    held = os.environ.pop(variable, None)
    try:
        yield held
    finally:
        if held is not None:
            os.environ[variable] = held


@contextmanager
def _quiet(name: str) -> Iterator[None]:
    logger = logging.getLogger(name)
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


def _may_fork() -> bool:
    """Whether a process forked now would not wait for ever for locks that other threads hold."""
    others = [each for each in threading.enumerate() if each is not threading.current_thread()]
    return hasattr(os, "fork") and all(type(t).__module__ == _OF_THE_BAR for t in others)


def _processors() -> int:
    """Processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
