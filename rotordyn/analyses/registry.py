"""The analyses by name: those built in are folders beside this file, others are entry points.

A record is imported when its name is asked for; packages outside are looked up only for a name that
is not built in, or where all names are listed. What they offer may fail in any way.
"""

from __future__ import annotations

import warnings
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


class Unusable(InvalidInput):
    """An external package offers an analysis that cannot be loaded."""


@cache
def analysis(name: str) -> Analysis:
    """The analysis of a name.

    Raises
    ------
    InvalidInput : there is none
    Unusable : what an external package offers under that name is no analysis
    """
    if name in built_in():
        record: Analysis = import_module(f"{PACKAGE}.{name}").ANALYSIS
        return record
    if name in _external():
        return _loaded(_external()[name])
    allowed = names()
    hint = suggestion(name, allowed)
    raise InvalidInput(f"unknown analysis: {name}; allowed: {', '.join(allowed)}{hint}")


@cache
def names() -> tuple[str, ...]:
    """All analyses, by their place; warns of external ones that cannot be used, and omits them."""
    usable = []
    for name in _external():
        try:
            analysis(name)
        except Unusable as error:
            warnings.warn(str(error), RuntimeWarning, stacklevel=2)
        else:
            usable.append(name)
    return tuple(in_order(built_in(), usable))


def in_order(*among: Iterable[str]) -> list[str]:
    """Names of analyses without repetition, by their place."""
    return sorted({name for group in among for name in group}, key=place)


def place(name: str) -> tuple[int, str]:
    """Sort key of an analysis: its place, then its name."""
    return analysis(name).place, name


@cache
def built_in() -> tuple[str, ...]:
    """Names of the analyses that are folders here."""
    path = import_module(PACKAGE).__path__
    return tuple(sorted(module.name for module in iter_modules(path) if module.ispkg))


@cache
def _external() -> dict[str, EntryPoint]:
    from importlib.metadata import entry_points

    return {e.name: e for e in entry_points(group=GROUP) if e.name not in built_in()}


def _loaded(entry: EntryPoint) -> Analysis:
    package = entry.dist.name if entry.dist else entry.module
    try:
        record = entry.load()
    except (Exception, SystemExit) as error:  # noqa: BLE001 - code of others
        why = f"{type(error).__name__}: {error}"
    else:
        if isinstance(record, Analysis) and record.name == entry.name:
            return record
        why = f"{entry.value} is not an Analysis named {entry.name}"
    raise Unusable(
        f"the analysis {entry.name} of the package {package} cannot be loaded ({why}): "
        "repair or uninstall that package"
    )
