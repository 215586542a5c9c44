"""Commands that compute nothing: check, new, cases, models, schema."""

from __future__ import annotations

import argparse
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import rotordyn
from rotordyn.cli.streams import say

if TYPE_CHECKING:
    from rotordyn.case.library import Shipped


def check(arguments: argparse.Namespace) -> int:
    """Read a case and print its analyses, and warnings about what is rarely intended."""
    from rotordyn.case.doubts import doubts

    case = rotordyn.load(arguments.case)
    questions = ", ".join(case.analyses)
    compared = f"; {_counted(len(case.variants), 'variant')}" if case.variants else ""
    speeds = _counted(len(case.speeds), "speed")
    sentences = [*doubts(case)]
    for sentence in sentences:
        say(f"WARNING: {sentence}")
    result = f"fine, with {_counted(len(sentences), 'warning')}" if sentences else "fine"
    say(f"{arguments.case}: {result} ({speeds}; {questions}{compared})")
    return 0


def _counted(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"


def new(arguments: argparse.Namespace) -> int:
    """Write starter files."""
    from rotordyn.case.starter import write_starter

    case, spindle = write_starter(arguments.name, Path())
    say(f"wrote {case} and {spindle}; next: rotordyn check {case}, rotordyn run {case}")
    return 0


def cases(_: argparse.Namespace) -> int:
    """List the cases that come with rotordyn."""
    _list(rotordyn.cases())
    return 0


def models(arguments: argparse.Namespace) -> int:
    """List the models of the library."""
    _list(rotordyn.models(arguments.kind))
    return 0


def _list(shipped: Sequence[Shipped]) -> None:
    """Print a line with kind, name and title of each, and its first source below."""
    columns = [max(len(part) for part in row) for row in zip(*map(_called, shipped), strict=True)]
    for item in shipped:
        kind, name = (f"{text:{n}}" for text, n in zip(_called(item), columns, strict=True))
        say(f"{kind}  {name}  {item.title}")
        for source in item.sources[:1]:
            say(" " * (sum(columns) + 4) + textwrap.shorten(source, 96, placeholder=" …"))


def _called(item: Shipped) -> tuple[str, str]:
    return item.kind, item.name


def schema(arguments: argparse.Namespace) -> int:
    """Print the schema of a kind of file."""
    import json

    from rotordyn.case.schema import json_schema

    say(json.dumps(json_schema(arguments.file), indent=2))
    return 0
