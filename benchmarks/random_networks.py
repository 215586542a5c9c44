"""Random axial networks and paths:  python -m benchmarks.random_networks [--count N] [--anew]

Shaft, sleeves and housing on bearings of any law, with springs, stops and dry friction, followed
through random forces and shifts. Counted are networks without an answer; of all others the largest
unbalanced force, penetration of a stop and friction beyond its limit, summed anew, and the largest
change of a position when every step is done in three. Kept in ``benchmarks/results.json`` after
every block of networks; a further run goes on where the last one ended.
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
SUMS = ("networks", "unanswered", "steps", "events", "seconds")


def survey(seeds: Sequence[int]) -> dict[str, Any]:
    """What the networks of these seeds come to."""
    found: dict[str, float] = {}
    steps = events = 0
    change = seconds = 0.0
    none: list[int] = []
    for seed in seeds:
        network = random_network(np.random.default_rng(seed))
        began = process_time()
        try:
            answers = follow(network)
            seconds += process_time() - began
            change = max(change, difference(network, answers, PARTS))
        except RotordynError:
            none.append(seed)
            continue
        steps += len(answers)
        events += sum(len(answer["events"]) for answer in answers)
        for key, value in worst(network, answers).items():
            found[key] = max(found.get(key, 0.0), value)
    return {
        "networks": len(seeds),
        "unanswered": none,
        "steps": steps,
        "events": events,
        **{key: found[key] for key in ("residual", "penetration", "cone")},
        "change": change,
        "seconds": seconds,
    }


def together(found: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    """What two surveys come to."""
    return {
        key: value if not found else found[key] + value if key in SUMS else max(found[key], value)
        for key, value in more.items()
    }


def main() -> None:
    """Survey as the command line says, and keep what comes of it."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.random_networks",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=int, default=10_000, help="of networks")
    parser.add_argument("--anew", action="store_true", help="begin with the first one")
    asked = parser.parse_args()
    kept = json.loads(RESULTS.read_text(encoding="utf-8")).get("random_networks", {})
    found: dict[str, Any] = {} if asked.anew else kept
    for first in range(found.get("networks", 0), asked.count, BLOCK):
        block = survey(range(first, min(first + BLOCK, asked.count)))
        found = together(found, block)
        keep(random_networks=found)


if __name__ == "__main__":
    main()
