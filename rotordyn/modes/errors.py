"""How far followed modes are off: poles beside the nearest ones of a finer model.

What rounding may do to a frequency, beside supports far stiffer than the shaft, is no less of an
error: the sum of both is reported. No finer model helps against it.

Theory: docs/theory/refinement.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Flags
from rotordyn.modes.band import Band
from rotordyn.modes.branches import Branch
from rotordyn.modes.overdamped import OVERDAMPED
from rotordyn.numerics.follow import matched
from rotordyn.numerics.modes import swings
from rotordyn.results.display import RPM
from rotordyn.scene.refinement import RESPONSES, few_rows, solve_accurately
from rotordyn.scene.scene import Scene

Modes = tuple[list[Branch], tuple[str, ...]]
SAME = 0.1  # of a pole: what has none so near in the finer model vanishes there
ROUNDING = 1e-12
CHANCE = 3.0  # changes by rounding that are that much larger than expected are none


class ModeErrors(NamedTuple):
    """Change by the finer model (usable, modes): ``frequency``, relative, and ``damping`` of the
    ratio; ``rounding`` (usable, modes): of both by rounding; ``unconverged``: modes it has more
    or fewer of, or errors above the accuracy, as a sentence, or ""."""

    frequency: Array
    damping: Array
    rounding: Array
    unconverged: str


def mode_errors(
    scene: Scene, band: Band, modes: Callable[[Scene], Modes]
) -> tuple[Scene, Modes, ModeErrors]:
    """Modes of a model that is fine enough, and how far they are off."""

    def solve(one: Scene) -> tuple[Modes, ModeErrors]:
        computed = modes(one)
        if one.rigid or not one.checks.wanted:
            none = np.full((len(one.usable), len(computed[0])), 0.0 if one.rigid else np.nan)
            return computed, ModeErrors(none, none, none, "")
        return computed, _compared(one, band, computed[0])

    def error(solution: tuple[Modes, ModeErrors]) -> float:
        (branches, _), errors = solution
        return RESPONSES * (math.inf if errors.unconverged else _worst(errors, branches, band))

    scene, (computed, errors) = solve_accurately(scene, solve, error)
    judged = scene.conditions.element_length is None and scene.checks.wanted
    unconverged = _unconverged(scene, band, computed[0], errors) if judged else ""
    frequency, damping = (
        np.maximum(each + errors.rounding, ROUNDING) if not scene.rigid else each
        for each in (errors.frequency, errors.damping)
    )
    return scene, computed, ModeErrors(frequency, damping, errors.rounding, unconverged)


def _unconverged(scene: Scene, band: Band, branches: list[Branch], errors: ModeErrors) -> str:
    """What of the accuracy asked for is not reached, as a sentence, or ""."""
    accuracy = scene.conditions.accuracy
    most = _worst(errors, branches, band)
    rounded = _largest(errors.rounding, branches, band)
    reasons = [errors.unconverged] if errors.unconverged else []
    if not reasons and most > accuracy and most > CHANCE * rounded:
        reasons.append(f"frequencies change by up to {most:.0e} as the model is refined")
    if rounded > accuracy:
        reasons.append(
            f"rounding moves frequencies by up to {rounded:.0e}, beside supports that are far "
            "stiffer than the shaft: hold them rigid"
        )
    slow = _largest(errors.frequency, branches, band, overdamped=True)
    if slow > accuracy:
        much = f"up to {slow:.0e}" if slow < SAME else f"more than {SAME:.0e}"
        reasons.append(
            f"poles of overdamped modes change by {much} of their size as the model is refined"
        )
    return "; ".join(reasons)


def _worst(errors: ModeErrors, branches: list[Branch], band: Band) -> float:
    """The largest error of a frequency, or of a damping ratio in that measure."""
    each = errors.frequency, errors.damping / RESPONSES
    return max(_largest(one, branches, band) for one in each)


def _largest(
    errors: Array, branches: list[Branch], band: Band, *, overdamped: bool = False
) -> float:
    """The largest of errors (usable, modes) within the band, of modes that swing, or where they
    hardly do; those that hardly do at most speeds are shown nowhere."""
    judged = np.array([_judged(b, band, overdamped=overdamped) for b in branches], dtype=bool)
    return float(np.nanmax(errors[judged.reshape(errors.shape[::-1]).T], initial=0.0))


def _judged(branch: Branch, band: Band, *, overdamped: bool) -> Flags:
    """Speeds (usable,) at which a mode that is shown swings within the band, or hardly does."""
    with np.errstate(invalid="ignore"):
        ratio = -branch.pole.real / np.abs(branch.pole)
        chosen = (ratio > OVERDAMPED) == overdamped
        inside = branch.frequency <= band.max_frequency
        return np.asarray(inside & chosen & (not branch.overdamped))


def _compared(scene: Scene, band: Band, branches: list[Branch]) -> ModeErrors:
    """Poles of followed modes beside the nearest ones of the finer model."""
    finer, few = scene.refined, few_rows(scene)
    rows = np.unique([*few, *(b.born for b in branches if (b.column[few] < 0).all())])
    errors = np.full((3, len(rows), len(branches)), np.nan)
    unconverged, highest = "", (1.0 - SAME) * band.highest
    for subsystem in sorted({branch.subsystem for branch in branches}):
        motions = finer.system_at(subsystem, rows)
        apart = all(b.side for b in branches if b.subsystem == subsystem)
        for (place, row), side in product(enumerate(rows), (-1.0, 1.0) if apart else (0.0,)):
            chosen = [
                k for k, b in enumerate(branches) if (b.subsystem, b.side) == (subsystem, side)
            ]
            chosen = [k for k in chosen if branches[k].column[row] >= 0]
            pole = motions.pole[place]
            mine = (motions.whirl[place] == side) | (not apart)
            there = pole[swings(pole) & ~motions.at_rest[place] & mine]
            here = np.array([branches[k].pole[row] for k in chosen], dtype=complex)
            nearness = -np.abs(here[:, None] - there) / np.abs(here)[:, None]
            partner = matched(nearness, -SAME)
            known, extra = partner >= 0, np.delete(there, partner[partner >= 0])
            change = _change(here, np.append(there, np.nan)[partner])
            errors[:2, place, chosen] = np.where(known, change, SAME)
            column = [branches[k].column[row] for k in chosen]
            errors[2, place, chosen] = scene.system(subsystem).rounding[row, column]
            for what, lost in (("vanish", here[~known]), ("appear", extra)):
                if (
                    judged := lost[(lost.imag < highest) & (-lost.real <= OVERDAMPED * abs(lost))]
                ).size:
                    unconverged = _sentence(scene, row, what, judged)
    at = scene.speed[scene.usable] ** 2  # the gyroscopic effect's share of an error follows that
    whole = np.full((3, len(at), len(branches)), np.nan)
    for k, branch in enumerate(branches):
        known = np.isfinite(errors[0, :, k])
        for kind in range(3):
            whole[kind, :, k] = np.interp(at, at[rows[known]], errors[kind, known, k])
        whole[:, branch.column < 0, k] = np.nan
    frequency, damping, rounding = whole
    return ModeErrors(frequency, damping, rounding, unconverged)


def _change(here: Complex, there: Complex) -> Array:
    """Relative change of frequencies and change of damping ratios (2, k)."""
    size = np.abs(here)
    return np.abs([(here.imag - there.imag) / size, here.real / size - there.real / np.abs(there)])


def _sentence(scene: Scene, row: int, what: str, pole: Complex) -> str:
    hertz = np.abs(pole[0].imag) / (2.0 * math.pi)
    rpm = scene.speed[scene.usable[row]] * RPM.factor
    return f"modes {what} as the model is refined, one of {hertz:.6g} Hz at {rpm:.6g} rpm"
