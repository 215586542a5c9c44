"""Random axial networks and paths:
python -m benchmarks.random_networks [--count N] [--restart SEED]

Shaft, sleeves and housing on bearings of any law, with springs, stops and dry friction, followed
through random forces and shifts. The results are: networks without a solution, and those beyond a
limit; for all others the largest unbalanced force, penetration of a stop and friction beyond its
limit, checked independently, and the largest change of a position if every step is divided in
three. They are kept with the first seed in ``benchmarks/results.json`` after every block of
networks; a further run continues where the last one ended.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from time import process_time
from typing import Any

import numpy as np

from benchmarks.kept import RESULTS, keep
from rotordyn.errors import RotordynError
from rotordyn.state import follow
from tests.oracles.random_networks import difference, random_network, worst

PARTS = 3
BLOCK = 50  # networks
SUMS = ("networks", "unsolved", "beyond", "steps", "events", "seconds")
LIMITS = {"residual": 1e-8, "penetration": 1e-12, "cone": 1e-8, "change": 1e-6}  # N, m, N, 1


def survey(seeds: Sequence[int]) -> dict[str, Any]:
    """Results of the networks of these seeds."""
    found = dict.fromkeys(LIMITS, 0.0)
    steps = events = 0
    seconds = 0.0
    none: list[int] = []
    beyond: list[int] = []
    for seed in seeds:
        network = random_network(np.random.default_rng(seed))
        start = process_time()
        try:
            solutions = follow(network)
            seconds += process_time() - start
            change = difference(network, solutions, PARTS)
        except RotordynError:
            none.append(seed)
            continue
        steps += len(solutions)
        events += sum(len(solution["events"]) for solution in solutions)
        here = {**worst(network, solutions), "change": change}
        if any(here[key] > limit for key, limit in LIMITS.items()):
            beyond.append(seed)
        found = {key: max(value, here[key]) for key, value in found.items()}
    return {
        "first": min(seeds),
        "networks": len(seeds),
        "unsolved": none,
        "beyond": beyond,
        "steps": steps,
        "events": events,
        **found,
        "seconds": seconds,
    }


def together(found: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    """Results of two surveys together."""
    return {
        key: value if not found else _both(key, found[key], value) for key, value in more.items()
    }


def _both(key: str, one: Any, other: Any) -> Any:
    if key in SUMS:
        return one + other
    return min(one, other) if key == "first" else max(one, other)


def main() -> None:
    """Survey as the command line says, and keep the results."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.random_networks",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=int, default=10_000, help="of networks")
    parser.add_argument("--restart", type=int, metavar="SEED", help="begin again, with this one")
    asked = parser.parse_args()
    kept = json.loads(RESULTS.read_text(encoding="utf-8")).get("random_networks", {})
    found: dict[str, Any] = kept if asked.restart is None else {}
    begin = found.get("first", 0) if asked.restart is None else asked.restart
    for first in range(begin + found.get("networks", 0), begin + asked.count, BLOCK):
        block = survey(range(first, min(first + BLOCK, begin + asked.count)))
        found = together(found, block)
        keep(random_networks=found)


if __name__ == "__main__":
    main()
