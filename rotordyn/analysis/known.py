"""What was computed, at the speeds of what was published or measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.bearing_map import tangent_error
from rotordyn.analysis.results import (
    BearingMapResult,
    CampbellResult,
    PreloadResult,
    turning,
)
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle

Array = NDArray[np.float64]


SAME_SPEED = 5e-3  # of the highest speed: nothing is interpolated between speeds


@dataclass(frozen=True, slots=True)
class Match:
    """A reference, cut down to what can be compared, and our ``values`` (SI) for it."""

    reference: Reference
    values: tuple[float, ...]


def matches(
    references: Sequence[Reference], results: Mapping[str, Any], spindle: Spindle | None
) -> list[Match]:
    """Every reference, at the speeds for which the results hold something to put beside it."""
    found = []
    for reference in dict.fromkeys(references):
        values = _computed(reference, results, spindle)
        if values is None or not np.isfinite(values).any():
            continue
        kept = np.flatnonzero(np.isfinite(values))
        known = replace(
            reference,
            speeds=tuple(reference.speeds[k] for k in kept),
            values=tuple(reference.values[k] for k in kept),
        )
        found.append(Match(known, tuple(float(values[k]) for k in kept)))
    return found


def preload_sum(result: PreloadResult, spindle: Spindle) -> Array:
    """Axial load [N] that the sleeves carry together, shape (speed,).

    Without sleeves: half the sum over all bearings, which is the load of either direction.
    """
    carried = {name for sleeve in spindle.sleeves for name in sleeve.bearings}
    if not carried:
        return np.asarray(np.abs(result.axial_load).sum(axis=1) / 2.0)
    chosen = [result.bearing.index(name) for name in result.bearing if name in carried]
    return np.asarray(result.axial_load[:, chosen].sum(axis=1))


def bending_frequencies(result: CampbellResult, speed: float) -> Array:
    """Bending frequencies [Hz] at the nearest ``speed``, ascending; equal ones count once."""
    values = _frequencies(result, speed, "bending")
    return values[np.diff(values, prepend=-np.inf) > 1e-4 * values]


def mean_bending_frequencies(result: CampbellResult, speed: float) -> Array:
    """Of each bending mode the mean of backward and forward [Hz] at the nearest ``speed``."""
    backward, forward = (_frequencies(result, speed, "bending", whirl) for whirl in (-1.0, 1.0))
    pairs = min(backward.size, forward.size)
    return (backward[:pairs] + forward[:pairs]) / 2.0


def torsion_frequencies(result: CampbellResult, speed: float) -> Array:
    """Torsional frequencies [Hz] at the nearest ``speed``, ascending."""
    return _frequencies(result, speed, "torsion")


def _frequencies(
    result: CampbellResult, speed: float, kind: str, whirl: float | None = None
) -> Array:
    """Frequencies [Hz] of one kind, and of one whirl if given, at the nearest speed, ascending."""
    at = int(np.argmin(np.abs(result.speed - speed)))
    chosen = np.array([own == kind for own in result.kind], bool)
    if whirl is not None:
        chosen &= result.whirl[at] == whirl
    values = np.sort(result.frequency[at, chosen])
    return values[np.isfinite(values)]


def _computed(
    reference: Reference, results: Mapping[str, Any], spindle: Spindle | None
) -> Array | None:
    """Our value for every value of the reference, NaN outside the speeds computed."""
    speeds, subject = np.asarray(reference.speeds, float), reference.subject
    preload = results.get("preload")
    match reference.quantity:
        case quantity if quantity in COLUMNS and COLUMNS[quantity][0] in results:
            analysis, name, dim, usual = COLUMNS[quantity]
            return _column(speeds, results[analysis], name, dim, subject or usual)
        case "preload_sum" if preload is not None and spindle is not None:
            return _at(speeds, preload.speed, preload_sum(preload, spindle))
        case quantity if quantity in MODES and "campbell" in results:
            return _frequencies_of(results["campbell"], reference)
        case "frozen_error" if "bearing" in results:
            return _frozen(results["bearing"], speeds)
    return None


def _frequencies_of(result: CampbellResult, reference: Reference) -> Array | None:
    """Of the one mode that is the subject at each speed, or of all modes at the one speed."""
    speeds = np.asarray(reference.speeds, float)
    if turning(result) and speeds.any():
        return None  # known ones belong to the fixed frame
    if reference.subject:
        kind = reference.quantity.partition("_")[0]
        return _column(speeds, result, "frequency", "mode", f"{kind} {reference.subject}")
    if np.abs(result.speed - speeds[0]).min() > SAME_SPEED * result.speed[-1]:
        return np.full(speeds.size, np.nan)
    found = MODES[reference.quantity](result, float(speeds[0]))[: speeds.size]
    return np.concatenate([found, np.full(speeds.size - found.size, np.nan)])


def _frozen(result: BearingMapResult, speeds: Array) -> Array | None:
    """Largest error of Kxx by the frozen tangent over the loads."""
    if not {"complete", "frozen"} <= set(result.tangent):
        return None
    largest = np.fmax.reduce(np.abs(tangent_error(result, "frozen", "x")), axis=1)
    return _at(speeds, result.speed, largest)


def _column(speeds: Array, result: Any, name: str, dim: str, word: str) -> Array | None:
    words = getattr(result, dim)
    if word not in words:
        return None
    return _at(speeds, result.speed, getattr(result, name)[:, words.index(word)])


def _at(speeds: Array, known: Array, values: Array) -> Array:
    """Values at the computed speeds that are as good as those asked for, NaN for the others."""
    nearest = np.abs(known - speeds[:, None]).argmin(axis=1)
    close = np.abs(known[nearest] - speeds) <= SAME_SPEED * known[-1]
    return np.where(close, values[nearest], np.nan)


# Quantities that are columns of a result: analysis, field, dimension of the subject, usual subject.
COLUMNS = {
    "radial_stiffness": ("stiffness", "tangent", "variant", "nonlinear"),
    "sleeve_displacement": ("preload", "position", "body", ""),
    "required_diameter": ("section_forces", "required_diameter", "twist_limit", ""),
}
MODES: dict[str, Callable[[CampbellResult, float], Array]] = {
    "bending_frequency": bending_frequencies,
    "mean_bending_frequency": mean_bending_frequencies,
    "torsion_frequency": torsion_frequencies,
}
