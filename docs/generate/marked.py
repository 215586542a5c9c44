"""Generated parts of a page, each between two markers of the same name."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

_PART = "<!-- begin {name} -->\n{text}\n<!-- end {name} -->"
_ANY = re.compile(r"<!-- begin ([\w-]+) -->\n(.*?)\n?<!-- end \1 -->", re.S)


def parts(page: str) -> dict[str, str]:
    """The generated parts of a page's text, by name."""
    return {match[1]: match[2] for match in _ANY.finditer(page)}


def rewrite(path: Path, fresh: dict[str, str]) -> None:
    """Replace parts of the page at ``path`` by ``fresh`` texts; the rest stays as it is.

    Raises
    ------
    KeyError : the page has no such part
    """
    page = path.read_text(encoding="utf-8")
    missing = fresh.keys() - parts(page).keys()
    if missing:
        raise KeyError(f"{path.name} has no part {', '.join(sorted(missing))}")

    def renewed(match: re.Match[str]) -> str:
        name = match[1]
        return _PART.format(name=name, text=fresh[name]) if name in fresh else match[0]

    path.write_text(_ANY.sub(renewed, page), encoding="utf-8")


def table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """A Markdown table; a column whose head ends in ``:`` is set flush right."""
    names = [name.rstrip(":") for name in head]
    rule = ["---:" if name.endswith(":") else "---" for name in head]
    lines = [names, rule, *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
