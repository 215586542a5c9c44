"""A command run in a process of its own, and what must not happen there."""

from __future__ import annotations

import io
import os
import pickle
import resource
import signal
import sys
import traceback
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

SECONDS, MEGABYTES = 5.0, 500.0
BUSY = 3.0 * SECONDS  # for the share in CI, whose machine may be slow; the whole keeps to the limit
LINES, COLUMNS = 32, 1000  # of what is said of a fault
CODES = (0, 2, 3)


@dataclass(frozen=True)
class Verdict:
    """Exit ``code`` (−1: killed), what was said on standard error, processor time, and memory that
    it took beside what the process had before."""

    code: int
    said: str
    seconds: float
    megabytes: float
    most: float = SECONDS

    @property
    def faults(self) -> list[str]:
        """What must not be; empty where all is well."""
        lines = self.said.splitlines()
        found = {
            f"exit code {self.code}": self.code not in CODES,
            "a traceback": "Traceback" in self.said,
            "a warning of a library": "Warning:" in self.said,
            f"{self.seconds:.1f} s": self.seconds > self.most,
            f"{self.megabytes:.0f} MB": self.megabytes > MEGABYTES,
            f"{len(lines)} lines": len(lines) > LINES,
            f"a line of {max(map(len, lines), default=0)} characters": any(
                len(line) > COLUMNS for line in lines
            ),
            "no word": self.code != 0 and not self.said.strip(),
        }
        return [fault for fault, present in found.items() if present]


def judged(work: Callable[[], int], allowed: float = SECONDS) -> Verdict:
    """``work``, which returns an exit code, done in a fork of this process.

    It is killed after four times the ``allowed`` seconds of processor time, and gets no more memory
    than four times what is allowed.
    """
    out, report = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(out)
        _work(work, report, 4.0 * allowed)
    os.close(report)
    with os.fdopen(out, "rb") as pipe:
        raw = pipe.read()
    _, status, used = os.wait4(process, 0)
    seconds = used.ru_utime + used.ru_stime
    if os.WIFSIGNALED(status) or not raw:
        return Verdict(-1, f"killed by signal {os.WTERMSIG(status)}", seconds, 0.0, allowed)
    code, said, megabytes = pickle.loads(raw)
    return Verdict(code, said, seconds, megabytes, allowed)


def _work(work: Callable[[], int], report: int, most: float) -> None:
    said = io.StringIO()
    before = _megabytes()
    room = int((before + 4.0 * MEGABYTES) * 1e6) + 2_000_000_000
    resource.setrlimit(resource.RLIMIT_AS, (room, room))
    resource.setrlimit(resource.RLIMIT_CPU, (int(most), int(most) + 2))
    signal.signal(signal.SIGXCPU, signal.SIG_DFL)
    sys.stdout, sys.stderr = io.StringIO(), said
    warnings.resetwarnings()
    warnings.simplefilter("always")
    try:
        code = work()
    except BaseException:  # noqa: BLE001 - whatever comes out is the finding
        traceback.print_exc(file=said)
        code = 1
    answer = pickle.dumps((code, said.getvalue()[:100_000], _megabytes() - before))
    with os.fdopen(report, "wb") as pipe:
        pipe.write(answer)
    os._exit(0)


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def command(*words: object, then: Callable[[], str] = str) -> Callable[[], int]:
    """``rotordyn`` with these words, as something to judge; ``then``: what is wrong with what it
    left, in a word."""

    def work() -> int:
        from rotordyn.cli import main

        code = main([str(word) for word in words])
        if why := then():
            print(why, file=sys.stderr)  # noqa: T201
            return 1
        return code

    return work


def loaded() -> None:
    """Import what runs need, once for all forks; their time and memory are then their own."""
    from tempfile import TemporaryDirectory

    from rotordyn.cli import main

    with TemporaryDirectory() as folder:
        main(["run", "grinding_spindle", "--no-figures", "--quiet", "-o", str(Path(folder) / "o")])
