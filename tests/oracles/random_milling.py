"""Random machines and cuts, and both limits of each.

    python -m tests.oracles.random_milling 200

prints a line for every one whose limits by harmonics and by collocation differ, and the largest
difference.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.stability_lobes import Limit, limit_depth
from tests.oracles.milling_floquet import Machine, Milling


def random_milling(seed: int) -> Milling:
    """A machine of one to three modes with a cut."""
    rng = np.random.default_rng([21, seed])
    modes = []
    for k in range(int(rng.integers(1, 4))):
        angle = rng.uniform(0.0, math.pi) if rng.random() < 0.3 else 0.5 * math.pi * (k % 2)
        hertz, ratio = rng.uniform(200.0, 2000.0), np.exp(rng.uniform(np.log(0.008), np.log(0.08)))
        stiffness = np.exp(rng.uniform(np.log(2e6), np.log(5e7)))
        modes.append((hertz, ratio, stiffness, (math.cos(angle), math.sin(angle))))
    kt, share = rng.uniform(5e8, 2.5e9), rng.uniform(0.1, 0.6)
    teeth, radial = int(rng.integers(1, 5)), rng.uniform(0.04, 1.0)
    how = ("up", "down", "slot")[int(rng.integers(3))]
    entry, exit_ = 0.0, math.pi
    if how == "up":
        exit_ = math.acos(1.0 - 2.0 * radial)
    elif how == "down":
        entry = math.acos(2.0 * radial - 1.0)
    waves = np.exp(rng.uniform(np.log(0.4), np.log(8.0)))
    speed = 2.0 * math.pi * modes[0][0] / waves / teeth
    return Milling(Machine(tuple(modes)), teeth, kt, share * kt, entry, exit_, speed)


def harmonic(cut: Milling) -> Limit:
    """The limit by harmonics."""
    return limit_depth(
        cut.machine.receptance, cut.teeth, cut.kt, cut.kn, cut.entry, cut.exit, cut.speed
    )


def differences(seeds: range) -> Iterator[tuple[int, Milling, Limit, float, str]]:
    """Limit by harmonics, relative difference of that by collocation, and kind there."""
    for seed in seeds:
        cut = random_milling(seed)
        found = harmonic(cut)
        depth = found.depth if math.isfinite(found.depth) else 1.0
        limit, kind = cut.limit(0.02 * depth, 1.1 * depth, 120)
        yield seed, cut, found, limit / found.depth - 1.0 if math.isfinite(limit) else limit, kind


def main(count: int) -> None:
    """Print what differs."""
    largest = 0.0
    for seed, cut, found, difference, kind in differences(range(count)):
        largest = max(largest, abs(difference))
        if abs(difference) > 1e-3 or kind != found.kind:
            sys.stdout.write(f"{seed}: {found} against {difference:+.2e} {kind}, {cut}\n")
    sys.stdout.write(f"{count} machines: largest difference {largest:.2e}\n")


if __name__ == "__main__":
    main(int(sys.argv[1]))
