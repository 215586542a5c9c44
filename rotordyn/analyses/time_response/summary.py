"""Lines of text of the response over time: largest displacements, loads and pressures."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.time_response.result import MILLISECOND, TimeResponseResult
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.results.balls import pressed
from rotordyn.results.described import Described
from rotordyn.results.display import GIGAPASCAL, MICROMETRE, RPM, number, rounded_up
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, graded
from rotordyn.results.text import unbroken

CLOSES, OPENS = ": with a stop_stiffness they close", ": with a stop_stiffness stops open"
GIVES = 1.005  # times the force that holds a sleeve: less is printed as 1
UNSURE = 0.1  # of the force of a stop: largest error without a warning
LESS = 0.95  # of the largest displacement: below it, that of the last quarter is printed


def summary(result: TimeResponseResult) -> Iterator[str]:
    """Yield lines for the first and the last speed with a motion."""
    rows = np.flatnonzero(np.isfinite(result.ended))
    for row in dict.fromkeys([*rows[:1].tolist(), *rows[-1:].tolist()]):
        displacements = [
            unbroken(
                f"{name} {result.largest[row, k] * MICROMETRE.factor:.4g} µm at "
                f"{result.largest_time[row, k] * MILLISECOND.factor:.5g} ms"
                f"{_with_linear(result, row, k)}{_last_quarter(result, row, k)}"
            )
            for k, name in enumerate(result.point)
        ]
        loads = [
            unbroken(
                f"{name} {result.peak_load[row, k]:.4g} N, "
                f"{result.peak_pressure[row, k] * GIGAPASCAL.factor:.3g} GPa"
            )
            for k, name in enumerate(result.bearing)
        ]
        yield f"over time  {_rpm(result, row)}, largest displacement: {', '.join(displacements)}"
        if loads:
            yield f"           largest load and contact pressure: {', '.join(loads)}"
        stops = [
            unbroken(f"{name} {force:.4g} N" if force > 0.0 else f"{name} stays open")
            for name, force in zip(result.sleeve, result.stop_force[row], strict=True)
            if np.isfinite(force)
        ]
        if stops:
            yield f"           largest force of the end stop: {', '.join(stops)}"


def _with_linear(result: TimeResponseResult, row: int, point: int) -> str:
    """Return the text of the largest displacement with linear bearings; "" without bearings."""
    largest = result.linear_largest[row, point] * MICROMETRE.factor
    return f" (linear bearings {largest:.4g} µm)" if result.bearing else ""


def _last_quarter(result: TimeResponseResult, row: int, point: int) -> str:
    """Return the text of the last quarter, if forces act there and its displacement is less."""
    late, largest = result.late_largest[row, point], result.largest[row, point]
    forced = np.abs(result.applied[3 * (len(result.time) // 4) :]).max(initial=0.0) > 0.0
    if not ((forced or result.unbalances) and late < LESS * largest):
        return ""
    return f", in the last quarter {late * MICROMETRE.factor:.4g} µm"


def numbers(result: TimeResponseResult, _: Described) -> Iterator[Number]:
    """Yield the largest displacement of each point over speed, and the largest bearing load."""
    for k, name in enumerate(result.point):
        largest = result.largest[:, k] * MICROMETRE.factor
        yield from each_speed(result, name, MICROMETRE.unit, largest, digits=2)
    if result.bearing:
        yield from each_speed(result, "bearing load", "N", result.peak_load.max(axis=1), digits=0)
    for k, name in enumerate(result.sleeve):
        if np.isfinite(result.stop_force[:, k]).any():
            yield from each_speed(result, f"stop of {name}", "N", result.stop_force[:, k], digits=0)


def accuracy(result: TimeResponseResult) -> list[str]:
    """Return the line of the largest estimated error of the motion."""
    if not np.isfinite(result.ended).any():
        return []
    worst = float(result.error.max(initial=0.0))
    if worst >= 1.0:
        return ["response over time not converged"]
    return [f"response over time within {rounded_up(worst)} of its largest value"]


def warnings(result: TimeResponseResult) -> Iterator[str]:
    """Yield warnings of an early end, violated hypotheses, and insufficient accuracy."""
    for row, why in enumerate(result.ending):
        if why:
            early = (
                f"time_response: at {_rpm(result, row)} the motion is computed up to "
                f"{result.ended[row] * MILLISECOND.factor:.5g} ms, after which {why}: lower the "
                "forces, or check the supports of the machine and its stability"
            )
            yield graded(Severity.NO_STATE, early)
    yield from _sleeves(result)
    for k, name in enumerate(result.bearing):
        peak = np.nan_to_num(result.peak_pressure[:, k], posinf=np.inf)
        if peak.max() > HIGHEST_PRESSURE:
            overloaded = (
                f"time_response: contacts of bearing {name} are overloaded at "
                f"{_rpm(result, int(peak.argmax()))} (pressures above "
                f"{HIGHEST_PRESSURE * GIGAPASCAL.factor:g} GPa), where results are not valid: "
                "lower the forces"
            )
            yield graded(Severity.INVALID, overloaded)
        elif sentence := pressed(f"time_response, bearing {name}", result.speed, peak):
            yield sentence
        unloaded = np.nan_to_num(result.unloaded_time[:, k])
        row = int(unloaded.argmax())
        if unloaded[row] > 0.0:
            lost = (
                f"time_response: all balls of bearing {name} lose contact with its inner race at "
                f"{_rpm(result, row)}, for {unloaded[row] * MILLISECOND.factor:.3g} ms in total: "
                "raise the preload, or lower the forces"
            )
            yield graded(Severity.LOAD, lost)
    worst = float(result.error.max(initial=0.0))
    if worst > result.error_asked:
        point = result.point[int(result.error.argmax())]
        inaccurate = (
            f"time_response: the motion of {point} is less accurate than asked for: an estimated "
            f"error of {rounded_up(worst)} of its largest value remains after refinement"
            if worst < 1.0
            else f"time_response: the motion of {point} does not converge: the last halving of the "
            "steps still changed it by more than its largest value; raise max_frequency, which "
            "shortens them"
        )
        yield graded(Severity.INVALID, inaccurate)


def _sleeves(result: TimeResponseResult) -> Iterator[str]:
    """Yield warnings of stops that would close or open, and friction that would slip."""
    for k, name in enumerate(result.sleeve):
        stays = np.isnan(result.stop_force[:, k])
        rubs = bool(result.friction_limit[k] > 0.0)
        gap = np.where(stays, np.nan_to_num(result.stop_gap[:, k]), 0.0)
        holding = np.nan_to_num(result.holding[:, k])
        row = int(gap.argmin())
        if gap[row] < 0.0:
            yield (
                f"time_response: sleeve {name} would move {-gap[row] * MICROMETRE.factor:.3g} µm "
                f"beyond its end stop at {_rpm(result, row)}; stops do not change in the "
                f"response, which is valid only up to there{'' if rubs else CLOSES}"
            )
        error = np.nan_to_num(result.stop_error[:, k])
        worst = int(error.argmax())
        if error[worst] > UNSURE:
            yield (
                f"time_response: the largest force of the stop of sleeve {name} has an error of "
                f"{100.0 * error[worst]:.0f} % at {_rpm(result, worst)}: its impacts are "
                "shorter than the time steps resolve; raise max_frequency, or use a softer stop"
            )
        row = int(holding.argmax())
        if holding[row] > GIVES:
            yield (
                f"time_response: the force on sleeve {name} reaches {holding[row]:.3g} times that "
                f"of {'dry friction' if rubs else 'its stop'}, which holds it, at "
                f"{_rpm(result, row)}; it stays fixed in the response, which is valid only up to "
                f"there{'' if rubs else OPENS}"
            )


def _rpm(result: TimeResponseResult, row: int) -> str:
    return f"{number(float(result.speed[row]) * RPM.factor, 0)} rpm"
