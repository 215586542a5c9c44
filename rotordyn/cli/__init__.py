"""The command line: parse, call, print, exit code. Everything else is imported when needed."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from bearings.errors import BearingError
from rotordyn.cli.arguments import parser
from rotordyn.cli.signals import interruption
from rotordyn.cli.streams import complain, say, speak_plainly, warned_plainly
from rotordyn.errors import RotordynError, exit_code, not_installed


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    speak_plainly()
    try:
        arguments = _parsed(argv)
        with warned_plainly():
            code: int = arguments.command(arguments)
    except (RotordynError, BearingError) as error:
        complain(error)
        return exit_code(error)
    except ModuleNotFoundError as error:
        why = not_installed(error.name)
        if why is None:
            raise
        complain(why)
        return 2
    except MemoryError:
        complain("out of memory: use fewer speeds, steps or points, or give it more memory")
        return 2
    except BaseException as error:
        stop = interruption(error)
        if stop is None:
            raise
        complain(str(stop) or "interrupted; nothing was written")
        return exit_code(stop)
    return code


def _parsed(argv: Sequence[str] | None) -> argparse.Namespace:
    try:
        return parser().parse_args(argv)
    except SystemExit:  # help, a version or a complaint has been printed
        say("", end="")
        raise
