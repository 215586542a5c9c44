"""What was computed, at the speeds of what was published or measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.results import CampbellResult, PreloadResult, TurningCampbellResult
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle

Array = NDArray[np.float64]


SAME_SPEED = 5e-3  # of the highest speed: nothing is interpolated between speeds


@dataclass(frozen=True, slots=True)
class Comparison:
    """A reference, cut down to what can be compared, and our ``values`` (SI) for it."""

    reference: Reference
    values: tuple[float, ...]


def compare(
    references: Sequence[Reference], results: Mapping[str, Any], spindle: Spindle | None
) -> list[Comparison]:
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
        found.append(Comparison(known, tuple(float(values[k]) for k in kept)))
    return found


def preload_sum(result: PreloadResult, spindle: Spindle) -> Array:
    """Axial load [N] that the sleeves carry together, shape (speed,).

    Without sleeves: half the sum over all bearings, which is the load of either direction.
    """
    carried = {name for sleeve in spindle.sleeves for name in sleeve.bearings}
    if not carried:
        return np.asarray(result.axial_load.sum(axis=1) / 2.0)
    chosen = [result.bearing.index(name) for name in result.bearing if name in carried]
    return np.asarray(result.axial_load[:, chosen].sum(axis=1))


def bending_frequencies(result: CampbellResult, speed: float) -> Array:
    """Bending frequencies [Hz] at the nearest ``speed``, ascending; equal ones count once."""
    at = int(np.argmin(np.abs(result.speed - speed)))
    bending = np.array([kind == "bending" for kind in result.kind], bool)
    values = np.sort(result.frequency[at, bending])
    values = values[np.isfinite(values)]
    return values[np.diff(values, prepend=-np.inf) > 1e-4 * values]


def _computed(
    reference: Reference, results: Mapping[str, Any], spindle: Spindle | None
) -> Array | None:
    """Our value for every value of the reference, NaN outside the speeds computed."""
    speeds, subject = np.asarray(reference.speeds, float), reference.subject
    preload, stiffness = results.get("preload"), results.get("stiffness")
    match reference.quantity:
        case "radial_stiffness" if stiffness is not None:
            return _column(speeds, stiffness, "tangent", "variant", subject or "nonlinear")
        case "preload_sum" if preload is not None and spindle is not None:
            return _at(speeds, preload.speed, preload_sum(preload, spindle))
        case "sleeve_displacement" if preload is not None:
            return _column(speeds, preload, "position", "body", subject)
        case "bending_frequency" if "campbell" in results:
            return _modes(results["campbell"], speeds)
    return None


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


def _modes(result: CampbellResult, speeds: Array) -> Array:
    """Bending frequencies at the one speed of a list of modes, NaN where it was not computed.

    Known ones belong to the fixed frame: a turning one agrees with it at rest only.
    """
    turned = isinstance(result, TurningCampbellResult) and speeds[0] != 0.0
    if turned or np.abs(result.speed - speeds[0]).min() > SAME_SPEED * result.speed[-1]:
        return np.full(speeds.size, np.nan)
    found = bending_frequencies(result, float(speeds[0]))[: speeds.size]
    return np.concatenate([found, np.full(speeds.size - found.size, np.nan)])
