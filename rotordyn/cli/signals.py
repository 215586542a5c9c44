"""Signals that stop a command: all of them end it as Ctrl-C does."""

from __future__ import annotations

import _thread
import signal
import sys
import threading

from rotordyn.allowance import ASKED

LATER = 0.05  # s, delay of a second attempt after a swallowed Ctrl-C


def heed_signals() -> None:
    """Install handlers for an orderly stop; Windows has no SIGHUP, and nohup ignores it."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _stopped)
    if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
        signal.signal(signal.SIGINT, _stopped)
    ASKED.clear()
    sys.unraisablehook = _heeded


def interruption(error: BaseException | None) -> KeyboardInterrupt | None:
    """The KeyboardInterrupt behind ``error``, even if a library has wrapped or replaced it, as
    NumPy does when it compares types; None if there is none."""
    if isinstance(error, Exception) and ASKED.is_set():
        return KeyboardInterrupt()
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return error
        error = error.__cause__ or error.__context__
    return None


def _stopped(*_: object) -> None:
    """Raise KeyboardInterrupt, so that no incomplete files remain."""
    ASKED.set()
    raise KeyboardInterrupt


def _heeded(lost: sys.UnraisableHookArgs) -> None:
    """Stop again a little later if Ctrl-C arrived in a finaliser, such as those of a compiler,
    where Python ignores it."""
    if not issubclass(lost.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(lost)
        return
    again = threading.Timer(LATER, _stop_main_thread)
    again.daemon = True
    again.start()


def _stop_main_thread() -> None:
    """Stop the main thread by a signal, which also wakes it; Windows lacks signals for threads."""
    if sys.platform == "win32":
        _thread.interrupt_main(signal.SIGTERM)
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)
