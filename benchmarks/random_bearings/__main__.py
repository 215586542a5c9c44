"""Random bearings far into the uncommon:  python -m benchmarks.random_bearings

``--balls N`` single balls, ``--bearings N`` bearing states, ``--paths N`` refused and as many
solved balls (a third as many bearings) followed by pseudo-arclength, ``--starts N`` states solved
from elsewhere, ``--sweeps N``. What they come to is written into ``benchmarks/results.json``.
"""

from __future__ import annotations

import argparse

from benchmarks.kept import keep
from benchmarks.random_bearings.balls import survey_balls
from benchmarks.random_bearings.paths import survey_ball_paths, survey_ring_paths
from benchmarks.random_bearings.rings import FRICTION, survey_friction, survey_rings
from benchmarks.random_bearings.starts import survey_starts, survey_sweeps


def main() -> None:
    """Survey and keep the outcome."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.random_bearings",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    sizes = {"balls": 1_000_000, "bearings": 100_000, "paths": 300, "starts": 2000, "sweeps": 200}
    for name, size in sizes.items():
        parser.add_argument(f"--{name}", type=int, default=size)
    asked = parser.parse_args()
    keep(
        random_bearings={
            "balls": survey_balls(asked.balls),
            "bearings": survey_rings(asked.bearings),
            "ball_paths": survey_ball_paths(asked.paths, asked.paths),
            "bearing_paths": survey_ring_paths(asked.paths // 3, asked.paths // 3),
            "starts": survey_starts(asked.starts),
            "sweeps": survey_sweeps(asked.sweeps),
            "friction": survey_friction(asked.bearings // 5),
            "friction_sweeps": survey_sweeps(asked.sweeps, FRICTION),
        }
    )


if __name__ == "__main__":
    main()
