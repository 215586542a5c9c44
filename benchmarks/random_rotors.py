"""Random stepped rotors:  python -m benchmarks.random_rotors [--count N] [--only exact|dense]

One to eight sections of 0.2 to 500 diameters, discs, masses, two to four springs, up to five times
the first critical speed; the lowest six frequencies of both whirls, against the exact shaft.
Missing or spurious modes, errors beyond the accuracy asked for, and the reported error beside the
true one are counted. Then one to sixty sections on damped supports that tell directions apart,
against all eigenvalues of the assembled matrices. Both are kept in ``benchmarks/results.json``.
"""

from __future__ import annotations

import argparse
import math
import warnings
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.kept import keep
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.unreduced import dense_poles
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.stepped_rotors import stepped_rotor

NO_SEATS = np.zeros((0, 5, 5))
KNOWN = 1e-8  # relative: errors below that are not compared with what is told
ACCURACIES = (1e-4, 1e-6)
SECTIONS = 60
FINE = 1e-5  # accuracy of both, of the same elements
SWINGING = 1e-3  # of |pole|: slower ones hardly swing and are not compared
MATCHED = 1e-3  # relative: a pole farther from all of ours is missing
Array = NDArray[np.float64]


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
        "too_small": int((np.array(ratios) < 0.1).sum()),
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


def dense_survey(count: int) -> dict[str, Any]:
    """What ``count`` anisotropic damped rotors of up to ``SECTIONS`` sections come to."""
    found = [against_dense(seed) for seed in range(count)]
    errors = [error for one in found for error in one["errors"]]
    return {
        "rotors": count,
        "most_sections": max(one["sections"] for one in found),
        "modes": sum(one["modes"] for one in found),
        "missing": sum(one["missing"] for one in found),
        "spurious": sum(one["spurious"] for one in found),
        "unsettled": sum(one["unsettled"] for one in found),
        "unstable": sum(one["unstable"] for one in found),
        "worst": max(errors),
        "warnings": sum(one["warnings"] for one in found),
        "seeds": [k for k, one in enumerate(found) if one["missing"] or one["spurious"]],
    }


def against_dense(seed: int) -> dict[str, Any]:
    """One rotor against all eigenvalues of its assembled matrices."""
    rng = np.random.default_rng(seed)
    spindle = None
    while spindle is None:  # none longer than a station may be
        try:
            spindle = stepped_rotor(rng, isotropic=False, damped=True, sections=SECTIONS)
        except InvalidInput:
            continue
    own = exact_rotor(replace(spindle, supports=_plain(spindle.supports)), 0.0, NO_SEATS)
    still = whirl_frequencies(own, 6)
    spin = rng.uniform(0.0, 5.0) * still[0]
    every = dense_poles(spindle, spin, 2.0 * still[5] / (2.0 * math.pi), FINE)
    edge = _edge(np.abs(every), still[5])
    poles = every[(np.abs(every) < edge) & (every.imag > SWINGING * np.abs(every))]
    highest = edge / (2.0 * math.pi)
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        scene = Scene(spindle, Conditions(accuracy=FINE), np.array([spin]), highest)
        result = campbell.answer(scene, CampbellSpec(highest, shapes=False))
    bending = np.array([kind == "bending" for kind in result.kind])
    ours = result.pole[0]
    size = np.abs(ours)
    ours = ours[bending & (size < edge) & (ours.imag > SWINGING * size)]
    errors, left = [], list(ours)
    for pole in poles:
        error = [abs(own - pole) / abs(pole) for own in left]
        if error and min(error) < MATCHED:
            errors.append(float(min(error)))
            left.pop(int(np.argmin(error)))
    return {
        "sections": len(spindle.shaft.sections),
        "modes": len(poles),
        "missing": len(poles) - len(errors),
        "spurious": len(left),
        "errors": errors or [0.0],
        "unsettled": bool(result.unsettled),
        "unstable": int((poles.real > 1e-9 * np.abs(poles)).sum()),
        "warnings": len(heard),
    }


def _plain(supports: tuple[LinearSupport, ...]) -> tuple[LinearSupport, ...]:
    """The same, as stiff in z as in y and without damping."""
    return tuple(
        replace(s, stiffness=dict.fromkeys(s.stiffness, s.stiffness["y", "y"]), damping={})
        for s in supports
    )


def _edge(size: Array, near: float) -> float:
    """A frequency [rad/s] in the widest gap of ``size`` around ``near``."""
    inside = np.sort(size[(size > 0.6 * near) & (size < 1.4 * near)])
    edges = np.concatenate([[0.6 * near], inside, [1.4 * near]])
    widest = int(np.diff(np.log(edges)).argmax())
    return min(math.sqrt(edges[widest] * edges[widest + 1]), 2.0 * math.pi * 9.9e5)


def main() -> None:
    """Survey at both accuracies and keep the outcome."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--only", choices=("exact", "dense"))
    asked = parser.parse_args()
    if asked.only != "dense":
        keep(random_rotors=[survey(asked.count, accuracy) for accuracy in ACCURACIES])
    if asked.only != "exact":
        keep(dense_rotors=dense_survey(asked.count))


if __name__ == "__main__":
    main()
