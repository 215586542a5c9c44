"""Random stepped rotors against the exact shaft:  python -m benchmarks.random_rotors [--count N]

One to eight sections of 0.2 to 500 diameters, discs, masses, two to four springs, up to five times
the first critical speed; the lowest six frequencies of both whirls. Missing or spurious modes,
errors beyond the accuracy asked for, and what is told of the error are counted, and written into
``benchmarks/results.json``.
"""

from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from benchmarks.kept import keep
from rotordyn.analysis import campbell
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec, Conditions
from rotordyn.exact.count import modes_below, whirl_frequencies
from rotordyn.exact.rotor import exact_rotor
from tests.oracles.stepped_rotors import stepped_rotor

NO_SEATS = np.zeros((0, 5, 5))
KNOWN = 1e-8  # relative: errors below that are not compared with what is told
ACCURACIES = (1e-4, 1e-6)


def survey(count: int, accuracy: float) -> dict[str, Any]:
    """What ``count`` rotors at an ``accuracy`` come to."""
    missing, errors, ratios = 0, [], []
    for seed in range(count):
        lost, pairs = _rotor(seed, accuracy)
        missing += lost
        errors += [error for error, _ in pairs]
        ratios += [told / error for error, told in pairs if error > KNOWN]
    apart = np.abs(np.log(np.maximum(ratios, 1e-300)))
    return {
        "accuracy": accuracy,
        "rotors": count,
        "frequencies": len(errors),
        "missing": missing,
        "beyond": int((np.array(errors) > accuracy).sum()),
        "worst": float(max(errors)),
        "judged": len(ratios),
        "within_3": int((apart < math.log(3.0)).sum()),
        "half": float(np.median(ratios)),
    }


def _rotor(seed: int, accuracy: float) -> tuple[int, list[tuple[float, float]]]:
    """Modes missing or spurious, and (true, told) error of every frequency."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    still = whirl_frequencies(exact_rotor(spindle, 0.0, NO_SEATS), 6)
    spin = rng.uniform(0.0, 5.0) * still[0]
    highest = min(1.02 * still[5] / (2.0 * math.pi), 9.9e5)
    scene = Scene(spindle, Conditions(accuracy=accuracy), np.array([spin]), highest)
    found = campbell.answer(scene, CampbellSpec(highest, shapes=False))
    exact = exact_rotor(spindle, spin, NO_SEATS)
    missing, pairs = 0, []
    for direction in (-1, 1):
        own = [k for k, whirl in enumerate(found.whirl[0]) if whirl == direction]
        order = sorted(own, key=lambda k: float(found.frequency[0, k]))
        ours = 2.0 * math.pi * found.frequency[0, order]
        inside = ours <= 2.0 * math.pi * highest
        count = modes_below(exact, direction * 2.0 * math.pi * highest)
        missing += abs(int(inside.sum()) - count)
        if count and inside.sum() == count:
            truth = whirl_frequencies(exact, count, direction)
            error = np.abs(ours[inside] / truth - 1.0)
            told = found.frequency_error[0, order][inside]
            pairs += list(zip(error.tolist(), told.tolist(), strict=True))
    return missing, pairs


def main() -> None:
    """Survey at both accuracies and keep the outcome."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    count = parser.parse_args().count
    keep(random_rotors=[survey(count, accuracy) for accuracy in ACCURACIES])


if __name__ == "__main__":
    main()
