"""What random networks came to (``python -m benchmarks.random_networks``) as a table."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table


def random_networks(found: dict[str, Any]) -> str:
    """Counts, and the largest of what may not be, over all networks and steps."""
    lengths = {"penetration of a stop [m]": "penetration"}
    forces = {"unbalanced force [N]": "residual", "friction beyond its limit [N]": "cone"}
    change = {"change of a position, over the largest one, with every step in three": "change"}
    rows = [
        ("networks", f"{found['networks']}"),
        ("without an answer", _named(found["unanswered"])),
        ("beyond a limit of the survey", _named(found["beyond"])),
        ("steps, events between", f"{found['steps']}, {found['events']}"),
        *((what, f"{found[key]:.0e}") for what, key in (forces | lengths | change).items()),
    ]
    return table(("random networks", "found, or the largest:"), rows)


def _named(seeds: list[int]) -> str:
    return f"{len(seeds)}" + (f" ({', '.join(map(str, seeds))})" if seeds else "")
