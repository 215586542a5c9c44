"""Docstrings of the project converted to the markup that autodoc expects.

Plain text with ``literals``; sections underlined by hyphens (``Parameters``, ``Raises`` …) whose
lines read ``name : what it is``, continued where indented.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

_LITERAL = re.compile(r"(``.+?``)")
_MARKUP = re.compile(r"([*|_`\\])")
_ENTRY = re.compile(r"(\S.*?) : (.*)")


def setup(app: Any) -> dict[str, bool]:
    """Make autodoc pass every docstring to this module."""
    app.connect("autodoc-process-docstring", _process)
    app.connect("autodoc-process-signature", _signature)
    _print_aliases_by_name()
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _print_aliases_by_name() -> None:
    """Sphinx prints an alias inside another type, as in ``tuple[Array, Array]``, by its repr."""
    from sphinx.util.inspect import TypeAliasForwardRef

    TypeAliasForwardRef.__repr__ = lambda alias: alias.name


def _process(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    lines[:] = list(marked_up(lines))


def _signature(
    app: Any, what: str, name: str, obj: Any, options: Any, signature: str | None, returns: str
) -> tuple[str | None, str]:
    """Defaults that a dataclass creates are no valid Python where autodoc prints them."""
    return (signature or "").replace("<factory>", "...") or None, returns


def marked_up(lines: list[str]) -> Iterator[str]:
    """reStructuredText that reads as the plain text of ``lines`` does."""
    inside = False
    for k, line in enumerate(lines):
        below = lines[k + 1] if k + 1 < len(lines) else ""
        if line and re.fullmatch("-{3,}", below):
            inside = True
            yield from ("", f".. rubric:: {line}", "")
        elif re.fullmatch("-{3,}", line):
            continue
        elif inside and (entry := _ENTRY.fullmatch(line)):
            yield from (f"``{entry[1]}``", f"    {plain(entry[2])}")
        else:
            yield plain(line)


def plain(text: str) -> str:
    """``text`` with everything but literals protected from being read as markup."""
    parts = _LITERAL.split(text)
    return "".join(p if k % 2 else _MARKUP.sub(r"\\\1", p) for k, p in enumerate(parts))
