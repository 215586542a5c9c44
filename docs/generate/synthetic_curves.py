"""Writes the synthetic curves that studies of cases/identification read, computed for a spindle.

``twin_*``: three speeds, 25 points on both branches, noise of 0.4 µm, a tare of 1 µm at each speed.
Curve at 4000 rpm: that of the spindle as identified in the thesis, whose model agrees with the
measured one within 0.48 µm in the mean (D. Noël, doctoral thesis, 2013, table 3.7, figure 3.27).
``story_*``: the falling branch alone, with more points.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import rotordyn
from rotordyn.study.identification.along_axis import BRANCHES, RPM
from rotordyn.study.identification.trial import Trial

NOISE, TARE = 0.4e-6, 1e-6
POINTS = 25
SPEEDS = (4000.0, 16000.0, 24000.0)
CYCLE = (-1900.0, 1600.0)  # N, of the load tests, the weight of the rotor included
HEAD = "speed [rpm],branch,force [N],displacement [um]"


def rows_of(
    case: rotordyn.Case,
    body: str,
    rpm: Sequence[float],
    rng: np.random.Generator | None,
    count: int = POINTS,
    branches: Sequence[str] = BRANCHES,
) -> list[str]:
    """Lines of a table of both branches at speeds [rpm]; without an ``rng`` free of noise."""
    trial = Trial(case, axial_speeds=tuple(speed * RPM for speed in rpm))
    weight = -trial.axial.force
    force = np.linspace(*CYCLE, count) + weight
    place, lines = trial.axial.bodies.index(body), []
    for row, speed in enumerate(rpm):
        tare = 0.0 if rng is None else rng.normal(0.0, TARE)
        found = trial.axial.cycle(row, force[::-1], force)
        forces = (force[::-1], force)
        for word, shifts, along in zip(BRANCHES, found, forces, strict=True):
            if word not in branches:
                continue
            measured = shifts[:, place] + tare
            if rng is not None:
                measured = measured + rng.normal(0.0, NOISE, count)
            lines += [
                f"{speed:.0f},{word},{f:.2f},{u * 1e6:.3f}"
                for f, u in zip(along, measured, strict=True)
            ]
    return lines


def main(folder: Path) -> None:
    """Write every table into a folder."""
    case = rotordyn.load("mfw2310_identification")
    rng = np.random.default_rng(2310)
    tables = {
        "twin_shaft": rows_of(case, "shaft", SPEEDS, rng),
        "twin_rear": rows_of(case, "rear", SPEEDS, rng),
        "story_shaft": rows_of(case, "shaft", SPEEDS, rng, 60, BRANCHES[:1]),
        "mfw2310_4000rpm": rows_of(case, "shaft", SPEEDS[:1], None),
    }
    for name, lines in tables.items():
        (folder / f"{name}.csv").write_text("\n".join([HEAD, *lines]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
