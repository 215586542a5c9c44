"""Calls of public functions and classes with one argument that makes no sense.

Every public class and function is tried with what works, one argument of it replaced by every value
that makes no sense. What may come of it: a result, or an error of ours in a sentence.
"""

from __future__ import annotations

import os
import pickle
import random
import resource
import signal
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from tests.hostile.nonsense import NONSENSE, nonsense
from tests.hostile.subjects import subjects

LONGEST, SECONDS = 1500, 5.0  # characters of a message; of one call


class Call(NamedTuple):
    """A subject with one argument replaced."""

    subject: str
    argument: str
    value: str


def calls() -> list[Call]:
    """Every call."""
    return [
        Call(name, argument, value)
        for name, subject in subjects().items()
        for argument in subject.arguments
        for value in NONSENSE
    ]


class Found(NamedTuple):
    """What is wrong with a call."""

    call: Call
    fault: str


def tried(call: Call) -> str:
    """What is wrong with it; empty where it answers or refuses as it must."""
    from bearings.errors import BearingError
    from rotordyn.errors import RotordynError

    subject = subjects()[call.subject]
    given = {**subject.arguments, call.argument: nonsense(call.value)}
    with warnings.catch_warnings(record=True) as leaked:
        warnings.simplefilter("always")
        try:
            subject.call(**given)
        except (RotordynError, BearingError) as error:
            said = str(error)
            if len(said) > LONGEST or said.count("\n") > 3:
                return f"a message of {len(said)} characters, {said[:80]!r}"
            if not said.strip():
                return "no word"
        except Exception as error:  # noqa: BLE001 - whatever comes out is the finding
            return _crash(error)
    return f"warning: {leaked[0].message!s:.80}" if leaked else ""


def _crash(error: BaseException) -> str:
    import traceback

    last = traceback.extract_tb(error.__traceback__)[-1]
    own = [f for f in traceback.extract_tb(error.__traceback__) if "hostile" not in f.filename]
    near = [f for f in own if "/rotordyn/" in f.filename or "/bearings/" in f.filename]
    at = near[-1] if near else last
    return f"{type(error).__name__} at {Path(at.filename).name}:{at.lineno}: {error!s:.80}"


class _TooLong(BaseException):
    pass


def _alarm(*_: object) -> None:
    raise _TooLong


def of(batch: list[Call]) -> Iterator[Found]:
    """What is wrong with the calls of a batch, tried one after the other in a fork; a call that
    ends the process or takes long is named."""
    rest = batch
    while rest:
        done, found, ended = _forked(rest)
        yield from found
        if ended:
            yield Found(rest[done], ended)
            done += 1
        rest = rest[done:]


def _forked(batch: list[Call]) -> tuple[int, list[Found], str]:
    out, into = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(out)
        room = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 + 6_000_000_000
        resource.setrlimit(resource.RLIMIT_AS, (room, room))
        devnull = os.open(os.devnull, os.O_WRONLY)
        os.dup2(devnull, 1)
        os.dup2(devnull, 2)
        signal.signal(signal.SIGALRM, _alarm)
        with os.fdopen(into, "wb") as pipe:
            for call in batch:
                signal.setitimer(signal.ITIMER_REAL, 4 * SECONDS, 1.0)
                try:
                    fault = tried(call)
                except _TooLong:
                    fault = f"more than {4 * SECONDS:g} s"
                except BaseException as error:  # noqa: BLE001
                    fault = _crash(error)
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                pipe.write(pickle.dumps(fault))
                pipe.flush()
        os._exit(0)
    os.close(into)
    found: list[Found] = []
    done = 0
    with os.fdopen(out, "rb") as pipe:
        while True:
            try:
                fault = pickle.load(pipe)
            except EOFError:
                break
            if fault:
                found.append(Found(batch[done], fault))
            done += 1
    _, status, _ = os.wait4(process, 0)
    ended = "" if done == len(batch) else f"the process ended, status {status}"
    return done, found, ended


def sample(count: int, seed: int = 0) -> list[Call]:
    """So many of all calls."""
    every = calls()
    return random.Random(seed).sample(every, min(count, len(every)))
