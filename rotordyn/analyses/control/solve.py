"""Which race controls the balls of a single bearing, over load and speed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.bearing import BallBearing
from rotordyn.analyses.control.control_map import (
    RACES,
    ControlMap,
    control_map,
    quadratic,
    resting_weight,
)
from rotordyn.analyses.control.result import ControlResult
from rotordyn.analyses.control.spec import ControlSpec
from rotordyn.arrays import Array
from rotordyn.errors import NoSolution
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import Conditions

TERMS = ("quadratic", "linear", "constant")
LEAST_SPEEDS = 4  # from which a fit of three terms has a misfit
THOUSAND_RPM = 1000.0 / RPM.factor  # [rad/s]
BOUNDARY_WORDS = {"inner": "inner race controls above", "outer": "outer race controls up to"}


def solve(
    bearing: BallBearing, conditions: Conditions, speed: Array, spec: ControlSpec
) -> ControlResult:
    """Solve both boundaries of race control at every speed, with fits, and margins in between.

    Raises
    ------
    NoSolution : no load and speed has a physical state with two contacts a ball
    """
    computed = control_map(
        bearing,
        speed=speed,
        lowest=spec.min_load,
        highest=spec.max_load,
        radial=spec.radial,
        static_growth=spec.static_growth,
        law=conditions.law,
    )
    failed = (computed.outcome != "").all(axis=1)
    if failed.all():
        raise NoSolution(
            f"no load and speed of the case has race control: {computed.outcome[0, -1]}"
        )
    load, absence = _physical(computed)
    fits, misfits, fit_absence = _fits(speed, load)
    return ControlResult(
        speed=speed,
        load=computed.load,
        boundary=RACES,
        term=TERMS,
        outcome=tuple(
            f"{reason} at {omega * RPM.factor:.0f} rpm" if fails else ""
            for fails, reason, omega in zip(failed, computed.outcome[:, -1], speed, strict=True)
        ),
        radial=spec.radial,
        resting_weight=resting_weight(bearing),
        boundary_load=load,
        boundary_absence=absence,
        boundary_pressure=np.where(np.isfinite(load), computed.pressure, np.nan),
        changes=computed.changes,
        fit=fits,
        fit_misfit=misfits,
        fit_absence=fit_absence,
        state=computed.outcome,
        inner_margin=computed.inner_margin,
        outer_margin=computed.outer_margin,
    )


def fit_words(result: ControlResult) -> dict[str, str]:
    """Return the fits that exist as text, by race; n stands for thousands of rpm."""
    scale = THOUSAND_RPM ** np.array([2.0, 1.0, 0.0])
    return {
        race: f"{a:.4g} n² {_signed(b)} n {_signed(c)} N, n in 1000 rpm, misfit {misfit:.2g} N"
        for race, (a, b, c), misfit, absent in zip(
            result.boundary, result.fit * scale, result.fit_misfit, result.fit_absence, strict=True
        )
        if not absent
    }


def fitted(result: ControlResult, place: int) -> Array:
    """Return the loads [N] of a fit at the speeds of the result."""
    return np.asarray(np.polyval(result.fit[place], result.speed))


def _signed(value: float) -> str:
    return f"{'−' if value < 0.0 else '+'} {abs(value):.3g}"


def _physical(computed: ControlMap) -> tuple[Array, NDArray[np.str_]]:
    """Return boundaries and absences; beyond the highest contact pressure there is no boundary."""
    over = computed.pressure > HIGHEST_PRESSURE
    reason = f"boundary overloaded (peak pressure above {HIGHEST_PRESSURE / 1e9:g} GPa)"
    return np.where(over, np.nan, computed.boundary), np.where(over, reason, computed.absence)


def _fits(speed: Array, load: Array) -> tuple[Array, Array, tuple[str, ...]]:
    """Return coefficients (2, 3) over ω, misfits (2,), and why a fit does not exist."""
    fits, misfits = np.full((len(RACES), len(TERMS)), np.nan), np.full(len(RACES), np.nan)
    absence = [f"fewer than {LEAST_SPEEDS} speeds have this boundary"] * len(RACES)
    for k, values in enumerate(load):
        finite = np.isfinite(values)
        if finite.sum() >= LEAST_SPEEDS:
            fits[k], misfits[k] = quadratic(speed[finite], values[finite])
            absence[k] = ""
    return fits, misfits, tuple(absence)
