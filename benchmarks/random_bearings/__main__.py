"""Random bearings, extreme ones included:  python -m benchmarks.random_bearings

``--balls N`` single balls, ``--bearings N`` bearing states, ``--paths N`` refused and as many
solved balls (a third as many bearings) followed by pseudo-arclength, ``--endings N`` refusals
whose speed is compared with a scan, ``--starts N`` states solved from other starts, ``--sweeps N``.
The results of each part are written into ``benchmarks/results.json`` when it is done; ``--only``
names the parts.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from benchmarks.kept import keep
from benchmarks.random_bearings.balls import survey_balls
from benchmarks.random_bearings.endings import survey_endings
from benchmarks.random_bearings.paths import survey_ball_paths, survey_ring_paths
from benchmarks.random_bearings.rings import FRICTION, survey_friction, survey_rings
from benchmarks.random_bearings.starts import survey_starts, survey_sweeps

PARTS = (
    "balls",
    "bearings",
    "ball_paths",
    "bearing_paths",
    "endings",
    "starts",
    "sweeps",
    "friction",
    "friction_sweeps",
)


def main() -> None:
    """Survey and keep the results."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.random_bearings",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    sizes = {"balls": 1_000_000, "bearings": 100_000, "paths": 300, "starts": 2000, "sweeps": 200}
    sizes["endings"] = 60
    for name, size in sizes.items():
        parser.add_argument(f"--{name}", type=int, default=size)
    parser.add_argument("--only", nargs="+", choices=PARTS, metavar="PART")
    asked = parser.parse_args()
    parts: dict[str, Callable[[], dict[str, Any]]] = {
        "balls": lambda: survey_balls(asked.balls),
        "bearings": lambda: survey_rings(asked.bearings),
        "ball_paths": lambda: survey_ball_paths(asked.paths, asked.paths),
        "bearing_paths": lambda: survey_ring_paths(asked.paths // 3, asked.paths // 3),
        "endings": lambda: survey_endings(asked.endings),
        "starts": lambda: survey_starts(asked.starts),
        "sweeps": lambda: survey_sweeps(asked.sweeps),
        "friction": lambda: survey_friction(asked.bearings // 5),
        "friction_sweeps": lambda: survey_sweeps(asked.sweeps, FRICTION),
    }
    for name in asked.only or parts:
        keep("random_bearings", **{name: parts[name]()})


if __name__ == "__main__":
    main()
