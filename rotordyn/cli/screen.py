"""A summary on a screen: what stands first of a text that a file holds in full."""

from __future__ import annotations

from pathlib import Path

from rotordyn.results.text import WARNING

HEIGHT = 60
MOST_WARNINGS = 6


def on_screen(text: str, file: Path) -> str:
    """At most ``HEIGHT`` lines of ``text`` and the first of its warnings; where some are left out,
    how many, and the ``file`` that has them."""
    lines = text.splitlines()
    starts = [k for k, line in enumerate(lines) if line.startswith(WARNING)]
    if len(starts) > MOST_WARNINGS:
        more = f"{WARNING}{len(starts) - MOST_WARNINGS} more in {file}"
        end = next(k for k in range(starts[-1] + 1, len(lines)) if not lines[k].startswith(" "))
        lines[starts[MOST_WARNINGS] : end] = [more]
    if len(lines) > HEIGHT:
        left = len(lines) - HEIGHT + 1
        lines[HEIGHT - 1 :] = [f"… and {left} more lines in {file}"]
    return "\n".join(lines)
