"""Random axial networks and paths:  python -m benchmarks.random_networks [--count N] [--first SEED]

Shaft, sleeves and housing on bearings of any law, with springs, stops and dry friction, followed
through random forces and shifts. Counted are networks without an answer; of all others the largest
unbalanced force, penetration of a stop and friction beyond its limit, summed anew, and the largest
change of a position when every step is done in three. Kept in ``benchmarks/results.json``.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from time import process_time
from typing import Any

import numpy as np

from benchmarks.kept import keep
from rotordyn.errors import RotordynError
from rotordyn.state import follow
from tests.oracles.random_networks import difference, random_network, worst

PARTS = 3


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
        "first": seeds[0],
        "unanswered": none,
        "steps": steps,
        "events": events,
        **{key: found[key] for key in ("residual", "penetration", "cone")},
        "change": change,
        "seconds": seconds,
    }


def main() -> None:
    """Survey as the command line says, and keep what comes of it."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.random_networks",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=int, default=10_000, help="of networks")
    parser.add_argument("--first", type=int, default=0, metavar="SEED")
    asked = parser.parse_args()
    keep(random_networks=survey(range(asked.first, asked.first + asked.count)))


if __name__ == "__main__":
    main()
