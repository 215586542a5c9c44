"""Results of random networks (``python -m benchmarks.random_networks``) as a table."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table

LARGEST = {
    "unbalanced force [N]": "residual",
    "friction beyond its limit [N]": "cone",
    "penetration of a stop [m]": "penetration",
    "change of a position over the largest one, every step divided in three": "change",
}


def random_networks(found: dict[str, Any]) -> str:
    """Counts, and the largest violations, over all networks and steps."""
    first, last = found["first"], found["first"] + found["networks"] - 1
    rows = [
        ("networks", f"{found['networks']}"),
        ("without a solution", _named(found["unsolved"])),
        ("beyond 1e-8 N, 1e-12 m or a change of 1e-6", _named(found["beyond"])),
        ("steps, events within them", f"{found['steps']}, {found['events']}"),
        *((what, f"{found[key]:.0e}") for what, key in LARGEST.items()),
    ]
    return table(("random networks: count or largest value", f"seeds {first} to {last}:"), rows)


def _named(seeds: list[int]) -> str:
    return f"{len(seeds)}" + (f" ({', '.join(map(str, seeds))})" if seeds else "")
