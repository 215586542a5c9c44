"""Signals that ask a command to stop: all of them end it as Ctrl-C does."""

from __future__ import annotations

import _thread
import signal
import sys
import threading

from rotordyn.allowance import ASKED

LATER = 0.05  # s after which what swallowed Ctrl-C has ended


def heed_signals() -> None:
    """Stop in good order when asked to; Windows has no SIGHUP, and nohup ignores it."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _stopped)
    if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
        signal.signal(signal.SIGINT, _stopped)
    ASKED.clear()
    sys.unraisablehook = _heeded


def interruption(error: BaseException | None) -> KeyboardInterrupt | None:
    """The Ctrl-C behind ``error``, even if a library has wrapped it or, as NumPy does where it
    compares types, put an error of its own in its place; None where there is none."""
    if isinstance(error, Exception) and ASKED.is_set():
        return KeyboardInterrupt()
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return error
        error = error.__cause__ or error.__context__
    return None


def _stopped(*_: object) -> None:
    """Leave the way Ctrl-C does, so that nothing half-written stays."""
    ASKED.set()
    raise KeyboardInterrupt


def _heeded(lost: sys.UnraisableHookArgs) -> None:
    """Stop once more, a little later, where Ctrl-C came within a finaliser, such as those of a
    compiler, which Python leaves out."""
    if not issubclass(lost.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(lost)
        return
    again = threading.Timer(LATER, _stop_main_thread)
    again.daemon = True
    again.start()


def _stop_main_thread() -> None:
    """By a signal, which wakes it where it waits; Windows has none for threads."""
    if sys.platform == "win32":
        _thread.interrupt_main(signal.SIGTERM)
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)
