"""The analyses by name: those built in are folders beside this file, others are entry points.

A record is imported when its name is asked for; packages outside are looked up only for a name that
is not built in, or where all names are listed.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import TYPE_CHECKING

from rotordyn.analyses.contract import Analysis
from rotordyn.errors import InvalidInput
from rotordyn.quantity import suggestion

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

PACKAGE = "rotordyn.analyses"
GROUP = "rotordyn.analyses"  # of entry points


@cache
def analysis(name: str) -> Analysis:
    """The analysis of a name.

    Raises
    ------
    InvalidInput : there is none, or a package outside offers something else under that name
    """
    if name in built_in():
        record = import_module(f"{PACKAGE}.{name}").ANALYSIS
    elif name in _outside():
        record = _outside()[name].load()
    else:
        known = names()
        hint = suggestion(name, known)
        raise InvalidInput(f"unknown analysis: {name}; allowed: {', '.join(known)}{hint}")
    if not isinstance(record, Analysis) or record.name != name:
        raise InvalidInput(f"entry point {name} of {GROUP} is not an Analysis of that name")
    return record


def names() -> tuple[str, ...]:
    """All analyses, by their place."""
    return tuple(in_order(built_in(), _outside()))


def in_order(*among: Iterable[str]) -> list[str]:
    """Names of analyses, each once, by their place."""
    return sorted({name for each in among for name in each}, key=place)


def place(name: str) -> tuple[int, str]:
    """The place of an analysis among others."""
    return analysis(name).place, name


@cache
def built_in() -> tuple[str, ...]:
    """Names of the folders."""
    path = import_module(PACKAGE).__path__
    return tuple(sorted(module.name for module in iter_modules(path) if module.ispkg))


@cache
def _outside() -> dict[str, EntryPoint]:
    from importlib.metadata import entry_points

    return {e.name: e for e in entry_points(group=GROUP) if e.name not in built_in()}
