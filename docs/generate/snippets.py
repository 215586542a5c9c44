"""Runs the commands and the code of a page in order, in one folder, as a reader would.

- A block ``yaml FILE`` is written to that file; ``yaml +FILE`` is appended to it, ``csv`` likewise.
- Each line of a block ``sh`` is a ``rotordyn`` command; it exits with 0, or with N where the line
  ends in ``# exit code N``. Of a script of the repository only the existence is checked.
- A block ``python`` is run; all blocks of a page share their names.

The output of a block is the generated part that follows it, if there is one.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from docs.generate.marked import rewrite
from docs.generate.pictures import keep_file
from docs.generate.places import DOCS, README, ROOT

_PARTS = re.compile(
    r"^```(?P<language>\w+)(?: (?P<file>\S+))?\n(?P<code>.*?)^```$"
    r"|<!-- begin (?P<part>[\w-]+) -->.*?<!-- end (?P=part) -->",
    re.S | re.M,
)
DRAW = ("run", "sweep", "optimise", "identify")  # commands that draw
# Figures of the pages: name under docs/figures -> page that runs it, file of the run.
PICTURES = {
    f"grinder_{name}.png": ("tutorial/first_run.md", f"out/grinder/{name}.png")
    for name in ("machine", "campbell", "preload")
}


class Block(NamedTuple):
    """A block of code: its language, the file it is written to if any, and the generated part
    that shows its output, if any."""

    language: str
    file: str
    code: str
    output: str


def snippet_pages() -> list[Path]:
    """Pages whose blocks are run."""
    folders = ("tutorial", "howto", "reference")
    return [README, *(path for name in folders for path in sorted((DOCS / name).glob("*.md")))]


def blocks(page: str) -> Iterator[Block]:
    """Blocks of a page's text outside its generated parts."""
    found = list(_PARTS.finditer(page))
    for k, match in enumerate(found):
        if match["part"] is None:
            after = found[k + 1] if k + 1 < len(found) else None
            output = after["part"] or "" if after is not None else ""
            yield Block(match["language"], match["file"] or "", match["code"], output)


def run_page(page: Path, folder: Path, *, draw: bool = True) -> dict[str, str]:
    """Output of the blocks of a page, by name of the generated part.

    ``folder``: where they run; ``draw``: commands draw their figures.

    Raises
    ------
    RuntimeError : a command exits with another code than the page says
    """
    printed, names = {}, {"__name__": "__main__"}
    with contextlib.chdir(folder):
        for block in blocks(page.read_text(encoding="utf-8")):
            text = _run(block, names, draw=draw)
            if block.output:
                printed[block.output] = f"```text\n{text.rstrip()}\n```"
    return printed


def _run(block: Block, names: dict[str, Any], *, draw: bool) -> str:
    if block.language in {"yaml", "csv"} and block.file:
        mode = "a" if block.file.startswith("+") else "w"
        with Path(block.file.lstrip("+")).open(mode, encoding="utf-8") as file:
            file.write(block.code)
    elif block.language == "python":
        screen = io.StringIO()
        with contextlib.redirect_stdout(screen):
            exec(compile(block.code, "page", "exec"), names)
        return screen.getvalue()
    elif block.language == "sh":
        return "".join(_command(line, draw=draw) for line in block.code.splitlines())
    else:
        raise RuntimeError(f"a block of unknown kind: {block.language} {block.file}")
    return ""


def _command(line: str, *, draw: bool) -> str:
    """Output of a command, errors included."""
    from rotordyn.cli import main

    words = shlex.split(line, comments=True)
    if not words or words[0].startswith("scripts/"):
        if words and not os.access(ROOT / words[0], os.X_OK):
            raise RuntimeError(f"no such script: {words[0]}")
        return ""
    if words[0] != "rotordyn":
        raise RuntimeError(f"no command of rotordyn: {line}")
    target = words.index(">") if ">" in words else len(words)
    argv = words[1:target]
    if argv[0] in DRAW and "--no-figures" not in argv and not draw:
        argv.append("--no-figures")
    screen = io.StringIO()
    with contextlib.redirect_stdout(screen), contextlib.redirect_stderr(screen):
        code = main(argv)
    expected = re.search(r"# exit code (\d+)", line)
    if code != (int(expected[1]) if expected else 0):
        raise RuntimeError(f"{line}: exit code {code}\n{screen.getvalue()}")
    if target < len(words):
        Path(words[target + 1]).write_text(screen.getvalue(), encoding="utf-8")
        return ""
    return screen.getvalue()


def write_snippets(folder: Path) -> None:
    """Run all pages below ``folder``, write their output, and keep the figures that they show."""
    for page in snippet_pages():
        place = folder / page.stem
        place.mkdir()
        shown = {n: path for n, (own, path) in PICTURES.items() if DOCS / own == page}
        rewrite(page, run_page(page, place, draw=bool(shown)))
        for name, path in shown.items():
            keep_file(place / path, Path(name).stem)
