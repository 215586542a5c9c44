"""Pair the modes fitted to measured responses with those of a machine, speed by speed.

The pairs minimise the sum of |ln(frequency ratio)|/``FAR`` + 1 − MAC over all modes of a speed
(H. Kuhn's assignment), the MAC being that of the residues of the measured responses; a measured
mode without a partner costs ``ALONE``. Responses in two planes contain the direction of whirl in
the phases of the residues, so that forward modes pair with forward ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.results.display import RPM
from rotordyn.study.identification.measurement import Beside
from rotordyn.study.identification.trial import Trial

if TYPE_CHECKING:
    from rotordyn.study.identification.responses import Responses

FAR = 0.2  # ln of the frequency ratio that costs as much as a MAC of 0
ALONE = 1.5  # cost of a mode without a partner, that of a pair of MAC 1 with 35 % in frequency
SWINGS = 1e-3  # Im λ over |λ| above which a pole oscillates
APART = 0.5  # |ln(frequency ratio)| above which two modes are never paired
SURE = 0.02  # relative deviation of the frequency above which a fitted pole is not a mode
DAMPED = 0.3  # damping ratio above which a fitted pole is not a mode
WIDTHS = 4.0  # half-widths of peaks within which a mode is hidden by another
SEEN = 5.0  # peak over noise from which a computed mode should have been measured
FELT = 1.0  # peak over noise from which a hidden mode affects the measured one
MOST = 4  # outliers that are named
NOISIER = 1.2  # scatter about the fitted modes over the stated noise that is remarked
HEAD = (
    "speed [rpm]",
    "measured [Hz]",
    "deviation [Hz]",
    "damping [%]",
    "deviation [%]",
    "machine [Hz]",
    "its damping [%]",
    "MAC",
)


@dataclass(frozen=True, slots=True)
class Mode:
    """Paired modes at a ``speed`` [rad/s]: ``measured`` frequency [Hz] and ``damping`` ratio with
    their standard deviations, ``computed`` ones, and ``mac`` of the residues; NaN where a partner
    is missing. ``joined``: several computed modes lie where this one was measured."""

    speed: float
    measured: float
    deviation: float
    damping: float
    damping_deviation: float
    computed: float
    computed_damping: float
    mac: float
    joined: bool = False


def paired_modes(of: Responses, trial: Trial) -> list[Mode]:
    """All measured modes within the band, and computed ones that should have been measured."""
    return [mode for speed in of.speed for mode in _at(of, trial, speed)]


def _remarks(of: Responses, modes: list[Mode]) -> Iterator[str]:
    """Yield sentences on unpaired or joined modes, and on scatter beyond the stated noise."""
    for mode in modes:
        at = f"at {mode.speed * RPM.factor:.0f} rpm"
        if np.isnan(mode.computed):
            yield f"{at} a mode is measured at {mode.measured:.1f} Hz that the machine lacks"
        elif np.isnan(mode.measured):
            yield f"{at} the machine has a mode at {mode.computed:.1f} Hz that is not measured"
    several = [
        f"{mode.measured:.1f} Hz ({mode.speed * RPM.factor:.0f} rpm)"
        for mode in modes
        if mode.joined
    ]
    if several:
        yield (
            "several modes of the machine lie where one is measured, whose deviations are too "
            f"small: {', '.join(several)}"
        )
    for speed, fit in of.modes.items():
        if len(fit.outliers):
            hertz = np.array(of.of_speed(speed)[0].frequency)[fit.outliers]
            more = f" and {len(hertz) - MOST} more" if len(hertz) > MOST else ""
            yield (
                f"at {speed * RPM.factor:.0f} rpm isolated lines belong to no mode: "
                f"{', '.join(f'{each:.6g}' for each in hertz[:MOST])} Hz{more}; they are not "
                "compared: measure them again"
            )
        if fit.misfit > NOISIER:
            yield (
                f"at {speed * RPM.factor:.0f} rpm responses scatter {fit.misfit:.2g} times as much "
                f"as stated about the {len(fit.best.fit.pole)} modes fitted to them"
            )


def beside(of: Responses, trial: Trial) -> Beside:
    """Table of the paired modes, and remarks on them."""
    modes = paired_modes(of, trial)
    rows = [
        (
            f"{each.speed * RPM.factor:.0f}",
            _written(each.measured, 2),
            _written(each.deviation, 2),
            _written(100.0 * each.damping, 3),
            _written(100.0 * each.damping_deviation, 3),
            _written(each.computed, 2),
            _written(100.0 * each.computed_damping, 3),
            _written(each.mac, 3),
        )
        for each in modes
    ]
    return Beside(f"{of.word}_modes", HEAD, tuple(rows), tuple(_remarks(of, modes)))


def _written(value: float, digits: int) -> str:
    return "" if np.isnan(value) else f"{value:.{digits}f}"


def _at(of: Responses, trial: Trial, speed: float) -> Iterator[Mode]:
    pole, residue = _computed(of, trial, speed)
    fit = of.modes[speed].best
    omega = 2.0 * np.pi * np.array(of.of_speed(speed)[0].frequency)
    size = np.abs(fit.fit.pole)
    relative = fit.deviation / size[:, None]
    mode = (
        (fit.fit.pole.imag >= omega[0])
        & (fit.fit.pole.imag <= omega[-1])
        & (relative[:, 1] < SURE)
        & (-fit.fit.pole.real < DAMPED * size)
    )
    known, shape = fit.fit.pole[mode], fit.fit.residue[mode]
    pole, residue, width = _merged(pole, residue, known)
    mac = _mac(shape, residue)
    distance = np.abs(np.log(np.abs(known)[:, None] / np.abs(pole)))
    rows, columns = assigned(distance / FAR + 1.0 - mac, distance, ALONE)
    partner = dict(zip(rows, columns, strict=True))
    inside = (omega[0] < pole.imag) & (pole.imag < omega[-1])
    unpaired = [j for j in np.flatnonzero(inside).tolist() if j not in columns]
    height = {j: _height(of, speed, complex(pole[j]), residue[j]) for j in unpaired}
    # how far off a pole fitted to two like ones may be
    offset = width**2 / (4.0 * np.abs(pole.real))
    reach = WIDTHS * np.add.outer(np.abs(known.real), np.abs(pole.real))
    near = np.abs(np.subtract.outer(known, pole)) < reach
    for k in np.argsort(known.imag).tolist():
        j = partner.get(k)
        yield Mode(
            speed,
            float(np.abs(known[k])) / (2.0 * np.pi),
            float(fit.deviation[mode][k, 1]) / (2.0 * np.pi),
            float(-known[k].real / np.abs(known[k])),
            float(relative[mode][k, 0]),
            *(_said(complex(pole[j]), mac[k, j]) if j is not None else (np.nan, np.nan, np.nan)),
            joined=any(near[k, i] and height[i] > FELT for i in unpaired)
            or (j is not None and bool(offset[j] > fit.deviation[mode][k, 1])),
        )
    for j in unpaired:
        if not near[:, j].any() and height[j] > SEEN:
            none = (np.nan,) * 4
            yield Mode(speed, *none, *_said(complex(pole[j]), np.nan))


def _said(pole: complex, mac: float) -> tuple[float, float, float]:
    return abs(pole) / (2.0 * np.pi), -pole.real / abs(pole), float(mac)


def _computed(of: Responses, trial: Trial, speed: float) -> tuple[Complex, Complex]:
    """Oscillating poles (k,) of the machine and their residues (k, pairs) in the responses."""
    scene = of.scene(trial)
    at = np.array([of.speed.index(speed)])
    responses = of.of_speed(speed)
    poles, residues = [], []
    owners = [of.owners(scene, response) for response in responses]
    for k in sorted({a for a, b in owners if a == b}):
        motions: FreeMotions = scene.system(k).at(at)
        rows = np.zeros((2, len(responses), motions.linear.size))
        for index, (response, owner) in enumerate(zip(responses, owners, strict=True)):
            if owner == (k, k):
                rows[:, index] = of.rows(scene, k, response)
        poles.append(motions.pole[0])
        residues.append(((rows[0] @ motions.vector[0]) * (motions.left[0] @ rows[1].T).T).T)
    pole, residue = np.concatenate(poles), np.concatenate(residues)
    oscillates = np.isfinite(pole) & (pole.imag > SWINGS * np.abs(pole))
    return pole[oscillates], residue[oscillates]


def _merged(pole: Complex, residue: Complex, known: Complex) -> tuple[Complex, Complex, Array]:
    """Drop poles that appear in no response, and merge poles closer than their widths, weighted by
    their residues, unless several are ``known`` there by the measurement. Also returns the distance
    of the merged ones (k,)."""
    size = np.abs(residue).sum(axis=1)
    order = np.argsort(pole.imag)
    kept: list[tuple[complex, Complex, float, float]] = []
    for k in order[size[order] > 1e-9 * size.max(initial=0.0)]:
        near = np.abs(known - pole[k]) < abs(pole[k].real) + np.abs(known.real)
        if kept and near.sum() < 2 and abs(kept[-1][0] - pole[k]) < abs(pole[k].real):
            before, shape, weight, width = kept.pop()
            share = size[k] / (size[k] + weight)
            mean = (1.0 - share) * before + share * pole[k]
            width += abs(before - pole[k])
            kept.append((complex(mean), shape + residue[k], weight + size[k], width))
        else:
            kept.append((complex(pole[k]), residue[k], float(size[k]), 0.0))
    if not kept:
        empty = np.zeros(0, dtype=complex)
        return empty, np.zeros((0, residue.shape[1]), dtype=complex), np.zeros(0)
    poles, shapes, _, widths = zip(*kept, strict=True)
    return np.array(poles), np.array(shapes), np.array(widths)


def _mac(one: Complex, other: Complex) -> Array:
    across = np.abs(one.conj() @ other.T) ** 2
    sizes = [(np.abs(each) ** 2).sum(axis=1) for each in (one, other)]
    return np.asarray(across / np.maximum(np.outer(*sizes), 1e-300))


def assigned(cost: Array, apart: Array, alone: float = 1e3) -> tuple[list[int], list[int]]:
    """Assign rows to columns with the least total cost; return indices of the pairs.

    Pairs farther ``apart`` than ``APART`` are excluded; a row without a partner costs ``alone``."""
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(
        np.hstack([np.where(apart > APART, 1e3, cost), np.full((len(cost), len(cost)), alone)])
    )
    valid = columns < cost.shape[1]
    rows, columns = rows[valid], columns[valid]
    valid = apart[rows, columns] <= APART
    return rows[valid].tolist(), columns[valid].tolist()


def _height(of: Responses, speed: float, pole: complex, residue: Complex) -> float:
    """Largest peak of a mode in any response, over the standard deviation of the noise."""
    omega = 2.0 * np.pi * np.array(of.of_speed(speed)[0].frequency)
    near = int(np.abs(omega - pole.imag).argmin())
    height = np.abs(residue / (1j * omega[near] - pole))
    return float((height / of.deviation_at(speed, near)).max())
