"""Random rotors:  python -m benchmarks.random_rotors [--count N] [--only SORT …] [--first SEED]

*stepped*: one to eight sections of 0.2 to 500 diameters, discs, masses, two to four springs, up to
five times the first critical speed; the lowest six frequencies of both whirls, against the exact
shaft. *conical*: the same with cones, against the exact shaft of more and more cylinders,
extrapolated.
Counted are missing or spurious modes, errors beyond the requested accuracy, and reported errors
within a factor of three of the true ones.

On damped anisotropic supports, against all eigenvalues of the assembled matrices:
*dense*, one to sixty sections, of the same elements; *tapered*, *jointed* and *coaxial*
(cones, joints, a further rotor at another speed), of much finer ones; a coaxial rotor for which
these have too few digits is compared with its exact shafts. Results are kept in
``benchmarks/results.json``.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.kept import keep
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.refinement import RESPONSES
from rotordyn.scene.scene import Scene
from tests.oracles.cylinders import NO_SEATS, cone_frequencies, of_cylinders
from tests.oracles.dense_rotor.unreduced import dense_poles
from tests.oracles.exact_shaft.coaxial import coaxial_poles
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.stepped_rotors import coaxial, conical, jointed, stepped_rotor

KNOWN = 1e-8  # relative: errors below that are not compared with what is reported
DIGITS = 3e-7  # relative: error of dense matrices of shafts of 500 diameters, or less
ACCURACIES = (1e-4, 1e-6)
SECTIONS = {"dense": 60, "tapered": 12, "jointed": 12, "coaxial": 5}
FINE = 1e-5  # requested accuracy in comparisons with dense matrices
FINER = 1e-8  # accuracy of the elements of dense matrices used as reference
OTHERS = (0.1 * FINER, 10.0 * FINER)  # of others, which show how many digits those have
SWINGING = 1e-3  # of |pole|: those with less are nearly overdamped and not compared
MATCHED = 1e-3  # relative: a pole farther from all computed ones is missing
EXACT = ("stepped", "conical")
DENSE = ("dense", "tapered", "jointed", "coaxial")
KEPT = {sort: f"{sort}_rotors" for sort in (*EXACT, *DENSE)} | {"stepped": "random_rotors"}
Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Rng = np.random.Generator
Pairs = list[tuple[float, float, float]]  # errors, as reported, and from where on comparable


def survey(sort: str, seeds: Sequence[int]) -> list[dict[str, Any]]:
    """Results of rotors of a kind at every accuracy."""
    found = [against_exact(seed, sort) for seed in seeds]
    every = []
    for k, accuracy in enumerate(ACCURACIES):
        pairs = [pair for own in found for pair in own[k][1]]
        every.append(
            {
                "accuracy": accuracy,
                "rotors": len(seeds),
                "frequencies": len(pairs),
                "missing": sum(own[k][0] for own in found),
                "seeds": [seed for seed, own in zip(seeds, found, strict=True) if own[k][0]],
                **_judged(pairs, accuracy),
            }
        )
    return every


def _judged(pairs: Pairs, accuracy: float) -> dict[str, Any]:
    """True and reported errors compared."""
    ratios = np.array([reported / error for error, reported, known in pairs if error > known])
    apart = np.abs(np.log(np.maximum(ratios, 1e-300)))
    return {
        "beyond": sum(error > accuracy for error, _, _ in pairs),
        "worst": max((error for error, _, _ in pairs), default=0.0),
        "judged": len(ratios),
        "within_3": int((apart < math.log(3.0)).sum()),
        "too_small": int((ratios < 0.1).sum()),
        "half": float(np.median(ratios)) if len(ratios) else 1.0,
    }


def against_exact(seed: int, sort: str = "stepped") -> list[tuple[int, Pairs]]:
    """For one rotor at every accuracy: missing or spurious modes, and (true, reported) error of
    every frequency."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    if sort == "conical":
        spindle = conical(rng, spindle)
    still = whirl_frequencies(exact_rotor(of_cylinders(spindle, 4), 0.0, NO_SEATS), 6)
    spin = rng.uniform(0.0, 5.0) * still[0]
    highest = min(1.02 * still[5] / (2.0 * math.pi), 9.9e5)
    results = []
    for accuracy in ACCURACIES:
        scene = Scene(spindle, Conditions(accuracy=accuracy), np.array([spin]), highest)
        results.append(campbell.solve(scene, CampbellSpec(highest, shapes=False)))
    exact = exact_rotor(of_cylinders(spindle, 64), spin, NO_SEATS)
    missing = [0 for _ in results]
    pairs: list[Pairs] = [[] for _ in results]
    for direction in (-1, 1):
        edge = direction * 2.0 * math.pi * highest
        truth: Array | None = None
        for k, found in enumerate(results):
            own = [n for n, whirl in enumerate(found.whirl[0]) if whirl == direction]
            own = [n for n in own if found.frequency[0, n] <= highest]
            own.sort(key=lambda n: float(found.frequency[0, n]))
            # next to the edge of the band a mode is on either side of it, within the accuracy
            near = (edge * (1.0 + side * ACCURACIES[k]) for side in (-1.0, 1.0))
            least, count = (modes_below(exact, each) for each in near)
            missing[k] += max(len(own) - count, least - len(own), 0)
            if not own or len(own) != count:
                continue
            ours = 2.0 * math.pi * found.frequency[0, own]
            truth = _truth(sort, spindle, spin, ours, direction) if truth is None else truth
            error = np.abs(ours / truth - 1.0)
            reported = found.frequency_error[0, own]
            pairs[k] += zip(error.tolist(), reported.tolist(), [KNOWN] * len(own), strict=True)
    return list(zip(missing, pairs, strict=True))


def _truth(sort: str, spindle: Spindle, spin: float, near: Array, direction: int) -> Array:
    """Frequencies [rad/s] of the exact shaft; for cones NaN where digits are missing."""
    if sort == "stepped":
        return whirl_frequencies(exact_rotor(spindle, spin, NO_SEATS), len(near), direction)
    found, known = cone_frequencies(spindle, spin, near, direction)
    if known.max() > KNOWN / 3.0:
        found, known = cone_frequencies(spindle, spin, found, direction, 32)
    return np.where(known < KNOWN, found, np.nan)


def dense_survey(sort: str, seeds: Sequence[int]) -> dict[str, Any]:
    """Results of anisotropic damped rotors of a kind."""
    return summed_up(list(seeds), [against_dense(seed, sort) for seed in seeds])


def summed_up(seeds: list[int], every: list[dict[str, Any]]) -> dict[str, Any]:
    """The same for known outcomes. Rotors for which the dense matrices have fewer digits than the
    requested accuracy are counted separately and not compared."""
    blurred = [one for one in every if one["digits"] > FINE]
    seeds = [k for k, one in zip(seeds, every, strict=True) if one["digits"] <= FINE]
    found = [one for one in every if one["digits"] <= FINE]
    pairs = [pair for one in found for pair in one["pairs"]]
    return {
        "rotors": len(seeds),
        "blurred": len(blurred),
        "blurred_and_warned": sum(one["unconverged"] for one in blurred),
        "most_sections": max(one["sections"] for one in found),
        "modes": sum(one["modes"] for one in found),
        "missing": sum(one["missing"] for one in found),
        "spurious": sum(one["spurious"] for one in found),
        "unconverged": sum(one["unconverged"] for one in found),
        "unstable": sum(one["unstable"] for one in found),
        "warnings": sum(one["warnings"] for one in found),
        "seeds": [k for k, one in zip(seeds, found, strict=True) if _astray(one)],
        **_judged(pairs, FINE),
        "damping": _judged([pair for one in found for pair in one["ratios"]], RESPONSES * FINE),
    }


def _astray(one: dict[str, Any]) -> bool:
    """Missing and spurious modes of a rotor."""
    return bool(one["missing"] or one["spurious"])


def _of_sort(rng: Rng, sort: str) -> Spindle:
    spindle = stepped_rotor(rng, isotropic=False, damped=True, sections=SECTIONS[sort])
    more: dict[str, Callable[[Rng, Spindle], Spindle]] = {
        "tapered": conical,
        "jointed": jointed,
        "coaxial": partial(coaxial, damped=True),
    }
    return more[sort](rng, spindle) if sort in more else spindle


def against_dense(seed: int, sort: str = "dense") -> dict[str, Any]:
    """One rotor against all eigenvalues of its assembled matrices; a coaxial one for which
    these have too few digits against its exact shafts."""
    spindle, spin, near = _drawn(seed, sort)
    highest = 2.0 * near / (2.0 * math.pi)
    every = dense_poles(spindle, spin, highest, FINE if sort == "dense" else FINER)
    edge = _edge(np.abs(every), near)
    poles = _swinging(every, edge)
    digits = [0.0] * len(poles)  # of the same elements: the error of the elements does not count
    known = [math.inf] * len(poles)
    if sort != "dense":
        digits = known = _digits(spindle, spin, highest, poles)
    if sort == "coaxial" and max(digits, default=0.0) > FINE:
        with suppress(
            NoSolution
        ):  # poles to which Newton's method does not converge remain undecided
            return against_exact_shafts(seed, every, edge)
    return _compared(spindle, spin, edge, poles, known) | {"digits": max(digits, default=0.0)}


def against_exact_shafts(
    seed: int, near: Complex | None = None, edge: float = 0.0
) -> dict[str, Any]:
    """One coaxial rotor against its exact shafts, whose poles are counted. ``near``: poles to begin
    with, ``edge`` [rad/s]: of the band; by default those of ``against_dense``."""
    spindle, spin, lowest = _drawn(seed, "coaxial")
    if near is None:
        near = dense_poles(spindle, spin, 2.0 * lowest / (2.0 * math.pi), FINER)
        edge = _edge(np.abs(near), lowest)
    every, error = coaxial_poles(spindle, spin, near, edge)
    kept = np.isin(every, _swinging(every, edge))
    known = [max(KNOWN, 10.0 * float(one)) for one in error[kept]]
    digits = {"digits": max(known, default=0.0), "exact": True}
    return _compared(spindle, spin, edge, every[kept], known) | digits


def _drawn(seed: int, sort: str) -> tuple[Spindle, float, float]:
    """A rotor, its speed, and near which frequency its band ends [rad/s]."""
    rng = np.random.default_rng(seed)
    spindle = None
    while spindle is None:  # none longer than a station may be
        try:
            spindle = _of_sort(rng, sort)
        except InvalidInput:
            continue
    still = whirl_frequencies(exact_rotor(_plain(spindle), 0.0, NO_SEATS), 6)
    return spindle, rng.uniform(0.0, 5.0) * still[0], float(still[5])


def _swinging(poles: Complex, edge: float) -> Complex:
    """Poles below ``edge`` [rad/s] that are compared."""
    return poles[(np.abs(poles) < edge) & (poles.imag > SWINGING * np.abs(poles))]


def _compared(
    spindle: Spindle, spin: float, edge: float, poles: Complex, digits: Sequence[float]
) -> dict[str, Any]:
    """Computed poles and all true ``poles`` of the band, with the errors from which these count."""
    highest = edge / (2.0 * math.pi)
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        scene = Scene(spindle, Conditions(accuracy=FINE), np.array([spin]), highest)
        result = campbell.solve(scene, CampbellSpec(highest, shapes=False))
    bending = np.array([kind == "bending" for kind in result.kind])
    size = np.abs(result.pole[0])
    inside = bending & (size < edge) & (result.pole[0].imag > SWINGING * size)
    left = np.flatnonzero(inside).tolist()
    pairs, ratios = [], []
    for pole, known in zip(poles, digits, strict=True):
        apart = [abs(result.pole[0, k] / pole - 1.0) for k in left]
        if not apart or min(apart) > MATCHED:
            continue
        column = left.pop(int(np.argmin(apart)))
        own = complex(result.pole[0, column])
        frequency = abs(own.imag - pole.imag) / abs(pole)
        ratio = abs(own.real / abs(own) - pole.real / abs(pole))
        pairs.append((float(frequency), float(result.frequency_error[0, column]), known))
        ratios.append((float(ratio), float(result.damping_error[0, column]), known))
    return {
        "sections": len(spindle.shaft.sections),
        "modes": len(poles),
        "missing": len(poles) - len(pairs),
        "spurious": len(left),
        "pairs": pairs,
        "ratios": ratios,
        "unconverged": bool(result.unconverged),
        "unstable": int((poles.real > 1e-9 * np.abs(poles)).sum()),
        "warnings": len(heard),
    }


def _digits(spindle: Spindle, spin: float, highest: float, poles: Complex) -> list[float]:
    """Errors above which poles of dense matrices are a reference: ten times the difference
    between finer and coarser elements. Rounding changes each pole at random, and one may agree in
    more digits than are correct: so the largest difference applies to all poles of a rotor."""
    others = [dense_poles(spindle, spin, highest, accuracy) for accuracy in OTHERS]
    apart = [max(float(np.abs(each / pole - 1.0).min()) for each in others) for pole in poles]
    return [max(DIGITS, 10.0 * max(apart, default=0.0))] * len(poles)


def _plain(spindle: Spindle) -> Spindle:
    """The shaft of the same rotor alone, of cylinders, on supports as stiff in z as in y and
    without damping: its lowest modes set the band."""
    own = [s for s in spindle.supports if s.holds == "spindle"]
    supports: list[LinearSupport] = [
        replace(s, stiffness=dict.fromkeys(s.stiffness, s.stiffness["y", "y"]), damping={})
        for s in own
    ]
    plain = replace(spindle, supports=tuple(supports), rotors=(), joints=())
    return of_cylinders(plain, 4)


def _edge(size: Array, near: float) -> float:
    """A frequency [rad/s] in the widest gap of ``size`` around ``near``."""
    inside = np.sort(size[(size > 0.6 * near) & (size < 1.4 * near)])
    edges = np.concatenate([[0.6 * near], inside, [1.4 * near]])
    widest = int(np.diff(np.log(edges)).argmax())
    return min(math.sqrt(edges[widest] * edges[widest + 1]), 2.0 * math.pi * 9.9e5)


def main() -> None:
    """Survey all sorts, or some, and keep the outcome."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--only", nargs="+", choices=(*EXACT, *DENSE), default=(*EXACT, *DENSE))
    asked = parser.parse_args()
    seeds = range(asked.first, asked.first + asked.count)
    for sort in asked.only:
        found = survey(sort, seeds) if sort in EXACT else dense_survey(sort, seeds)
        keep(**{KEPT[sort]: found})


if __name__ == "__main__":
    main()
