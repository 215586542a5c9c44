"""Values of modes over speed to compare with references."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.arrays import Array
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.results.frames import turning
from rotordyn.results.known import SAME_SPEED, column


def bending_frequencies(result: CampbellResult, speed: float) -> Array:
    """Return bending frequencies [Hz] at the nearest ``speed``, ascending; equal ones once."""
    values = _frequencies(result, speed, "bending")
    return values[np.diff(values, prepend=-np.inf) > 1e-4 * values]


def mean_bending_frequencies(result: CampbellResult, speed: float) -> Array:
    """Return the means of backward and forward bending modes [Hz] at the nearest ``speed``."""
    backward, forward = (_frequencies(result, speed, "bending", whirl) for whirl in (-1.0, 1.0))
    pairs = min(backward.size, forward.size)
    return (backward[:pairs] + forward[:pairs]) / 2.0


def torsion_frequencies(result: CampbellResult, speed: float) -> Array:
    """Return torsional frequencies [Hz] at the nearest ``speed``, ascending."""
    return _frequencies(result, speed, "torsion")


def _frequencies(
    result: CampbellResult, speed: float, kind: str, whirl: float | None = None
) -> Array:
    """Return frequencies [Hz] of one kind, of one ``whirl`` if given, ascending, at a speed."""
    row = int(np.argmin(np.abs(result.speed - speed)))
    chosen = np.array([mode_kind == kind for mode_kind in result.kind], bool)
    if whirl is not None:
        chosen &= result.whirl[row] == whirl
    values = np.sort(result.frequency[row, chosen])
    return values[np.isfinite(values)]


def known(reference: Reference, result: CampbellResult, _: Spindle | None) -> Array | None:
    """Return values of the one mode that is the subject, or of all modes at the one speed."""
    if reference.quantity not in MODES:
        return None
    speeds = np.asarray(reference.speeds, float)
    if turning(result) and speeds.any():
        return None  # known ones belong to the fixed frame
    if reference.subject:
        kind = reference.quantity.partition("_")[0]
        return column(speeds, result, "frequency", "mode", f"{kind} {reference.subject}")
    if np.abs(result.speed - speeds[0]).min() > SAME_SPEED * result.speed[-1]:
        return np.full(speeds.size, np.nan)
    computed = MODES[reference.quantity](result, float(speeds[0]))[: speeds.size]
    return np.concatenate([computed, np.full(speeds.size - computed.size, np.nan)])


MODES: dict[str, Callable[[CampbellResult, float], Array]] = {
    "bending_frequency": bending_frequencies,
    "mean_bending_frequency": mean_bending_frequencies,
    "torsion_frequency": torsion_frequencies,
}
