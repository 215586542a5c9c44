"""Processes that work side by side, from their first moment to their end."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

import pytest

from rotordyn.study.processes import Process

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")


@POSIX
@pytest.mark.parametrize("wait", [0.0, 0.02, 0.3])
def test_a_process_interrupted_as_it_loads_still_answers(
    wait: float, capfd: pytest.CaptureFixture[str]
) -> None:
    process = Process()
    pid = process._process.pid
    assert pid is not None
    time.sleep(wait)
    os.kill(pid, signal.SIGINT)
    process.begin((len, ((1, 2),)), 1)
    assert process.result() == (True, 2)
    process.end()
    assert capfd.readouterr().err == ""


@POSIX
@pytest.mark.parametrize("wait", [0.001, 0.003, 0.005, 0.01])
def test_ctrl_c_that_comes_as_a_process_begins_is_not_lost(wait: float) -> None:
    Process().end()  # what processes share is there
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    def begin() -> None:
        threading.Timer(wait, os.kill, (os.getpid(), signal.SIGINT)).start()
        Process().end()
        time.sleep(1.0)

    try:
        with pytest.raises(KeyboardInterrupt):
            begin()
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_process_begun_in_a_thread_answers() -> None:
    found: list[tuple[bool, object]] = []

    def ask() -> None:
        process = Process()
        process.begin((len, ((1, 2),)), 1)
        found.append(process.result())
        process.end()

    thread = threading.Thread(target=ask)
    thread.start()
    thread.join()
    assert found == [(True, 2)]
