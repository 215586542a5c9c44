"""Worker processes, each at the end of its own pipe.

They share neither a queue nor a lock, which a killed process could leave half written or locked:
its pipe closes with it, and so does the wait for its answer. Idle processes stay for a while, with
what they have imported and solved.
"""

from __future__ import annotations

import pickle
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from itertools import islice
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from typing import Any

from rotordyn.errors import RotordynError
from rotordyn.numerics import threads

ATTEMPTS = 3  # attempts at a call whose process was killed
IDLE = 300.0  # s that a process waits for its next call
ALONE = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
Call = tuple[Callable[..., Any], tuple[Any, ...]]


class Killed(Exception):
    """A process has ended before it answered."""


class Process:
    """A worker process and this end of its pipe."""

    def __init__(self) -> None:
        from joblib.externals.loky.backend import get_context

        context: Any = get_context("loky")  # one that does not run the user's script again
        self.pipe: Connection
        with _uninterrupted():
            self.pipe, far = context.Pipe()
            self._process = context.Process(target=_serve, args=(far,), daemon=True, env=ALONE)
            self._process.start()
            far.close()  # no copy outlives the process

    def begin(self, call: Call, count: int) -> None:
        """Send a call to the process, which is one of ``count``."""
        with suppress(OSError):  # the process was killed: ``result`` raises
            self.pipe.send_bytes(pickle.dumps((count, *call)))

    def result(self) -> tuple[bool, Any]:
        """Wait for the answer: whether the call succeeded, and what it returned or raised."""
        try:
            answer: tuple[bool, Any] = pickle.loads(self.pipe.recv_bytes())
        except (EOFError, OSError):
            self.end()
            raise Killed from None
        return answer

    def end(self) -> None:
        """Kill the process."""
        self._process.terminate()
        self._process.join()
        self.pipe.close()


_idle: list[Process] = []


def start(count: int) -> None:
    """Start ``count`` processes in advance; none if one is enough, as this one will do."""
    if count > 1:
        _idle.extend(Process() for _ in range(count - len(_idle)))


def side_by_side(count: int, calls: Iterator[Call]) -> Iterator[Any]:
    """Yield results of ``calls`` as they come from ``count`` processes; replace killed ones.

    Raises
    ------
    RotordynError : processes were killed again and again, as happens where memory runs out
    """
    working: dict[Connection, tuple[Process, Call, int]] = {}

    def begin(call: Call, attempt: int = 1) -> None:
        process = _ready()
        working[process.pipe] = process, call, attempt
        process.begin(call, count)

    try:
        for call in islice(calls, count):
            begin(call)
        while working:
            pipe: Any = wait([*working])[0]
            process, call, attempt = working.pop(pipe)
            try:
                done, answer = process.result()
            except Killed:
                if attempt == ATTEMPTS:
                    raise RotordynError(
                        f"processes were killed {ATTEMPTS} times at the same points: is "
                        "there enough memory? take fewer workers"
                    ) from None
                begin(call, attempt + 1)
                continue
            _idle.append(process)
            for following in islice(calls, 1):
                begin(following)
            if not done:
                raise answer
            yield answer
    finally:
        for process, *_ in working.values():
            process.end()


def _ready() -> Process:
    """An idle process, or a new one."""
    while _idle:
        process = _idle.pop()
        if not process.pipe.poll():  # without a call only a closed pipe is readable
            return process
        process.end()
    return Process()


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Block Ctrl-C (SIGINT) in processes started inside, from their first instruction on: this
    process ends them. A Ctrl-C that arrives meanwhile is raised here afterwards."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    pending, handler = list[int](), signal.getsignal(signal.SIGINT)
    deferred = handler is not None and threading.current_thread() is threading.main_thread()
    if deferred:  # another thread may take it, and Python would stop this one
        signal.signal(signal.SIGINT, lambda number, _: pending.append(number))
    of_loky = import_module("joblib.externals.loky.backend.resource_tracker")
    trackers: Any = resource_tracker, of_loky
    for tracker in trackers:
        tracker.ensure_running()  # as they start, they let Ctrl-C through again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # what processes begin with
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        if deferred:
            signal.signal(signal.SIGINT, handler)
        if pending:
            signal.raise_signal(signal.SIGINT)


def _serve(pipe: Connection) -> None:
    """Execute calls and send answers, until the pipe closes or no call has come for a while."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    import rotordyn.scene.scene  # loads the solvers while the first call is being prepared
    import rotordyn.study.point  # noqa: F401

    with suppress(EOFError, OSError):
        while pipe.poll(IDLE):
            pipe.send_bytes(_answer(pipe.recv_bytes()))


def _answer(packed: bytes) -> bytes:
    try:
        count, work, arguments = pickle.loads(packed)
        threads.side_by_side(count)
        return pickle.dumps((True, work(*arguments)))
    except BaseException as error:  # noqa: BLE001 - raised where it was asked for
        try:
            return pickle.dumps((False, pickle.loads(pickle.dumps(error))))
        except Exception:  # noqa: BLE001 - an error that cannot be packed
            return pickle.dumps((False, RotordynError(f"{type(error).__name__}: {error}")))
