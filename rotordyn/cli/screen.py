"""Shorten a summary to a screen; a file has the full text."""

from __future__ import annotations

from pathlib import Path

from rotordyn.results.text import WARNING

HEIGHT = 60
MOST_WARNINGS = 6


def on_screen(text: str, file: Path) -> str:
    """At most ``HEIGHT`` lines of ``text`` and its first warnings; a note counts omitted ones and
    names the ``file``."""
    lines = text.splitlines()
    starts = [k for k, line in enumerate(lines) if line.startswith(WARNING)]
    if len(starts) > MOST_WARNINGS:
        more = f"{WARNING}{len(starts) - MOST_WARNINGS} more in {file}"
        end = next(k for k in range(starts[-1] + 1, len(lines)) if not lines[k].startswith(" "))
        lines[starts[MOST_WARNINGS] : end] = [more]
    if len(lines) > HEIGHT:
        omitted = len(lines) - HEIGHT + 1
        lines[HEIGHT - 1 :] = [f"… and {omitted} more lines in {file}"]
    return "\n".join(lines)
