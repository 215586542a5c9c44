"""Forced vibration and surface of the planned cut, at every speed at which it is stable."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.operation import BOTH_WAYS, Operation
from rotordyn.analyses.stability_lobes.spec import FLIP
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.arrays import Array, Complex, Indices

SURE = 1.1  # times the planned depth: a cut stable there without edge forces must be so with them
HARMONICS = 6.0  # times the highest frequency that matters
VALUES = {
    "surface_error_least": ("least", "wall"),
    "surface_error_most": ("most", "wall"),
    "tip_deflection": ("deflection", "direction"),
    "tip_vibration": ("peak_to_peak", "direction"),
    "cutting_force": ("force", ""),
    "cutting_torque": ("torque", ""),
    "cutting_power": ("power", ""),
    "vibration_error": ("error", ""),
    "contact_departure": ("departure", ""),
}


def planned_cut(
    limits: Limits, operation: Operation, depth: Array, speed: Array, place: Indices
) -> dict[str, Any]:
    """Return fields of the result, by ``limits`` with their ``depth`` (s,), at ``place`` (s,) among
    all ``speed`` (n,); NaN where the cut is not stable, no speeds where none is planned.

    Raises
    ------
    InvalidInput : a cut so slow that it has too many harmonics
    NoSolution : forces of the vibration do not converge
    """
    spec, tip = operation.spec, limits.tip
    speed = speed if spec.cut else speed[:0]
    names: dict[str, tuple[str, ...]] = {
        "wall": spec.walls if spec.cut else (),
        "direction": ("feed", "normal") if spec.cut else (),
    }
    stable = np.zeros(len(speed), dtype=bool)
    fields = {
        name: np.full((len(speed), *([len(names[dim])] if dim else [])), np.nan)
        for name, (_, dim) in VALUES.items()
    }
    width, removal, idle = np.full(len(speed), np.nan), np.full(len(speed), np.nan), 0
    chatters = np.zeros(len(speed), dtype=bool)
    if spec.cut:
        assert isinstance(tip, Tip), "the machine as computed"
        stable[place] = depth > spec.cut.depth
        removal[stable] = operation.removal(speed, spec.cut.depth)[stable]
        if spec.cut.tangential_edge or spec.cut.radial_edge:
            kept = stable[place]
            part = replace(limits, rows=limits.rows[kept], speed=limits.speed[kept])
            sure = np.where(depth > SURE * spec.cut.depth, SURE, 1.0) * spec.cut.depth
            chatters[place[kept]] = ~part.stable(operation.pushed, sure[kept])
            both = partial(operation.pushed, share=BOTH_WAYS)
            planned = np.full(len(part.rows), spec.cut.depth)
            chatters[place[kept]] |= ~part.stable(both, planned, FLIP)
        repeats = operation.planned.repeats  # in a revolution, and so in its frequency
        idle = repeats * len(operation.planned.idle)
        sharpest = _least_damping(tip.high_poles[limits.rows], repeats * limits.speed)
        width[place] = np.where(stable[place], 2.0 * sharpest, np.nan)  # half-power bandwidth 2 ζ
        rows = zip(place.tolist(), limits.rows.tolist(), limits.speed.tolist(), strict=True)
        for at, row, omega in (values for values in rows if stable[values[0]]):
            forced = operation.forced(omega, HARMONICS * float(tip.tops[row]))
            milled = forced.solve(partial(_receptance, tip.at(row)), spec.walls)
            for name, (attribute, _) in VALUES.items():
                fields[name][at] = getattr(milled, attribute)
    return {
        "planned_depth": spec.cut.depth if spec.cut else math.nan,
        "planned_feed": spec.feed_per_tooth if spec.cut else math.nan,
        "milling_speed": speed,
        "cut_is_stable": stable,
        "resonance_width": width,
        "planned_removal": removal,
        "idle_teeth": idle,
        "edges_chatter": chatters,
        **names,
        **fields,
    }


def _least_damping(pole: Complex, speed: Array) -> Array:
    """Return the least damping ratio (s,) of the modes (s, k) that a multiple of ``speed`` (s,)
    meets up to the next speed, 0 where it meets none."""
    with np.errstate(invalid="ignore"):
        order = pole.imag / speed[:, None]
        after = pole.imag[:-1] / speed[1:, None]
        met = np.zeros(pole.shape, dtype=bool)
        met[:-1] = np.floor(order[:-1]) > np.floor(after)
        ratio = np.where(met, -pole.real / np.abs(pole), np.inf).min(axis=1)
    return np.where(np.isfinite(ratio), ratio, 0.0)


def _receptance(tip: Tip, omega: Array) -> Complex:
    """Return the receptance (f, 2, 2) of a tip at one speed, at frequencies (f,) ≥ 0."""
    return np.asarray(tip.receptance(omega[None])[0])
