"""What random networks came to (``python -m benchmarks.random_networks``) as a table."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table

LARGEST = {
    "unbalanced force [N]": "residual",
    "friction beyond its limit [N]": "cone",
    "penetration of a stop [m]": "penetration",
    "change of a position, over the largest one, with every step in three": "change",
}


def random_networks(found: dict[str, Any], before: dict[str, Any]) -> str:
    """Counts, and the largest of what may not be, over all networks and steps.

    ``before``: the same of a survey of which some or all networks were followed from end to end of
    smooth parts alone, without rates between.
    """
    first, last = found["first"], found["first"] + found["networks"] - 1
    both = found, before
    rows = [
        ("networks", *(f"{one['networks']}" for one in both)),
        ("without an answer", *(_named(one["unanswered"]) for one in both)),
        ("beyond 1e-8 N, 1e-12 m or a change of 1e-6", *(_named(one["beyond"]) for one in both)),
        ("steps, events between", *(f"{one['steps']}, {one['events']}" for one in both)),
        *((what, *(f"{one[key]:.0e}" for one in both)) for what, key in LARGEST.items()),
    ]
    heads = (
        "random networks: found, or the largest",
        f"seeds {first} to {last}:",
        f"seeds 0 to {before['networks'] - 1}, formerly:",
    )
    return table(heads, rows)


def _named(seeds: list[int]) -> str:
    return f"{len(seeds)}" + (f" ({', '.join(map(str, seeds))})" if seeds else "")
