"""Errors of followed modes: their poles against the nearest ones of a finer model.

Rounding of a frequency, with supports far stiffer than the shaft, is no less of an error: the sum
of both is reported. No finer model helps against it.

Theory: docs/theory/refinement.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Flags
from rotordyn.modes.branches import Branch
from rotordyn.modes.overdamped import OVERDAMPED
from rotordyn.numerics.follow import matched
from rotordyn.numerics.modes import oscillates
from rotordyn.results.display import RPM
from rotordyn.scene.formulation import ROTATING
from rotordyn.scene.refinement import RESPONSES, few_rows, solve_accurately
from rotordyn.scene.scene import Scene

Modes = tuple[list[Branch], tuple[str, ...]]
SAME = 0.1  # of a pole: a mode without one as close in the finer model vanishes there
ROUNDING = 1e-12  # least error reported
CHANCE = 3.0  # a change larger than expected rounding by more is not due to rounding


class ModeErrors(NamedTuple):
    """Change by the finer model (usable, modes): ``frequency``, relative, and ``damping`` of the
    ratio; ``rounding`` (usable, modes): of both by rounding; ``unconverged``: modes it has more
    or fewer of, or errors above the accuracy, as a sentence, or ""."""

    frequency: Array
    damping: Array
    rounding: Array
    unconverged: str


def mode_errors(
    scene: Scene, highest: float, modes: Callable[[Scene], Modes]
) -> tuple[Scene, Modes, ModeErrors]:
    """Return the modes of a model that is fine enough, and their errors, judged up to the
    ``highest`` angular frequency [rad/s]."""

    def solve(model: Scene) -> tuple[Modes, ModeErrors]:
        computed = modes(model)
        if model.rigid or not model.checks.wanted:
            unknown = np.full((len(model.usable), len(computed[0])), 0.0 if model.rigid else np.nan)
            return computed, ModeErrors(unknown, unknown, unknown, "")
        return computed, _compared(model, highest, computed[0])

    def error(solution: tuple[Modes, ModeErrors]) -> float:
        (branches, _), errors = solution
        judged = _judged(scene, branches, highest)
        return RESPONSES * (math.inf if errors.unconverged else _worst(errors, judged))

    scene, (computed, errors) = solve_accurately(scene, solve, error)
    judged = scene.conditions.element_length is None and scene.checks.wanted
    unconverged = _unconverged(scene, highest, computed[0], errors) if judged else ""
    frequency, damping = (
        np.maximum(change + errors.rounding, ROUNDING) if not scene.rigid else change
        for change in (errors.frequency, errors.damping)
    )
    return scene, computed, ModeErrors(frequency, damping, errors.rounding, unconverged)


def _unconverged(scene: Scene, highest: float, branches: list[Branch], errors: ModeErrors) -> str:
    """Return how the model misses the accuracy required, as a sentence, or ""."""
    accuracy, judged = scene.conditions.accuracy, _judged(scene, branches, highest)
    most = _worst(errors, judged)
    rounded = _largest(errors.rounding, judged)
    reasons = [errors.unconverged] if errors.unconverged else []
    if not reasons and most > accuracy and most > CHANCE * rounded:
        reasons.append(f"frequencies change by up to {most:.0e} as the model is refined")
    if rounded > accuracy:
        reasons.append(
            f"rounding errors change frequencies by up to {rounded:.0e}, because supports are far "
            "stiffer than the shaft: make them rigid"
        )
    slow = _largest(errors.frequency, _judged(scene, branches, highest, overdamped=True))
    if slow > accuracy:
        much = f"up to {slow:.0e}" if slow < SAME else f"more than {SAME:.0e}"
        reasons.append(
            f"poles of overdamped modes change by {much} of their size as the model is refined"
        )
    return "; ".join(reasons)


def _worst(errors: ModeErrors, judged: Flags) -> float:
    """Return the largest error of a frequency, or of a damping ratio in that measure."""
    kinds = errors.frequency, errors.damping / RESPONSES
    return max(_largest(kind, judged) for kind in kinds)


def _largest(errors: Array, judged: Flags) -> float:
    """Return the largest of errors (usable, modes) that are ``judged``."""
    return float(np.nanmax(errors[judged], initial=0.0))


def _judged(
    scene: Scene, branches: list[Branch], highest: float, *, overdamped: bool = False
) -> Flags:
    """Return the speeds at which shown modes oscillate within the band, or hardly do
    (usable, modes); those that hardly do at most speeds are not shown."""
    judged = np.zeros((len(scene.usable), len(branches)), dtype=bool)
    spin = _spin(scene)
    for k, branch in enumerate(branches):
        with np.errstate(invalid="ignore"):
            ratio = -branch.pole.real / np.abs(branch.pole)
            chosen = (ratio > OVERDAMPED) == overdamped
            frequency = np.minimum(np.abs(branch.pole.imag), branch.frequency_in_frame(spin))
        judged[:, k] = (frequency <= highest) & chosen & (not branch.overdamped)
    return judged


def _compared(scene: Scene, highest: float, branches: list[Branch]) -> ModeErrors:
    """Compare poles of followed modes with the nearest ones of the finer model."""
    finer, few = scene.refined, few_rows(scene)
    rows = np.unique([*few, *(b.first_row for b in branches if (b.column[few] < 0).all())])
    errors = np.full((3, len(rows), len(branches)), np.nan)
    unconverged = ""
    spin = _spin(scene)
    for subsystem in sorted({branch.subsystem for branch in branches}):
        motions = finer.system_at(subsystem, rows)
        separate = all(b.side for b in branches if b.subsystem == subsystem)
        for (index, row), side in product(enumerate(rows), (-1.0, 1.0) if separate else (0.0,)):
            chosen = [
                k for k, b in enumerate(branches) if (b.subsystem, b.side) == (subsystem, side)
            ]
            chosen = [k for k in chosen if branches[k].column[row] >= 0]
            pole = motions.pole[index]
            of_side = (motions.whirl[index] == side) | (not separate)
            finer_poles = pole[oscillates(pole) & ~motions.at_rest[index] & of_side]
            poles = np.array([branches[k].pole[row] for k in chosen], dtype=complex)
            nearness = -np.abs(poles[:, None] - finer_poles) / np.abs(poles)[:, None]
            partner = matched(nearness, -SAME)
            paired, extra = partner >= 0, np.delete(finer_poles, partner[partner >= 0])
            change = _change(poles, np.append(finer_poles, np.nan)[partner])
            errors[:2, index, chosen] = np.where(paired, change, SAME)
            column = [branches[k].column[row] for k in chosen]
            errors[2, index, chosen] = scene.system(subsystem).rounding[row, column]
            for what, unpaired in (("vanish", poles[~paired]), ("appear", extra)):
                in_frame = np.abs(unpaired.imag - side * spin[row])
                judged = np.minimum(unpaired.imag, in_frame) < (1.0 - SAME) * highest
                judged &= -unpaired.real <= OVERDAMPED * np.abs(unpaired)
                if judged.any():
                    unconverged = _sentence(scene, row, what, in_frame[judged][0])
    at = scene.speed[scene.usable] ** 2  # the gyroscopic part of an error is proportional to it
    interpolated = np.full((3, len(at), len(branches)), np.nan)
    for k, branch in enumerate(branches):
        paired = np.isfinite(errors[0, :, k])
        for kind in range(3):
            interpolated[kind, :, k] = np.interp(at, at[rows[paired]], errors[kind, paired, k])
        interpolated[:, branch.column < 0, k] = np.nan
    frequency, damping, rounding = interpolated
    return ModeErrors(frequency, damping, rounding, unconverged)


def _change(here: Complex, there: Complex) -> Array:
    """Return relative change of frequencies and change of damping ratios (2, k)."""
    size = np.abs(here)
    return np.abs([(here.imag - there.imag) / size, here.real / size - there.real / np.abs(there)])


def _spin(scene: Scene) -> Array:
    """Return the speed (usable,) of the frame in which modes are shown [rad/s]."""
    rotating = scene.conditions.formulation == ROTATING
    return np.asarray(scene.speed[scene.usable] * rotating)


def _sentence(scene: Scene, row: int, what: str, omega: float) -> str:
    hertz = omega / (2.0 * math.pi)
    rpm = scene.speed[scene.usable[row]] * RPM.factor
    return f"modes {what} as the model is refined, one of {hertz:.6g} Hz at {rpm:.6g} rpm"
