"""Lines of text of the response to unbalance: unbalances, largest amplitudes, forces, whirl."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.unbalance.result import RUNAWAY, UnbalanceResult
from rotordyn.arrays import Array
from rotordyn.numerics.crossing import above_zero
from rotordyn.results.described import Described
from rotordyn.results.display import GRAM_MILLIMETRE, MICROMETRE, RPM, number, rounded_up
from rotordyn.results.headline import Number
from rotordyn.results.severity import Severity, graded
from rotordyn.results.text import unbroken
from rotordyn.scene.lightly_damped import LIGHT, lightly_damped
from rotordyn.scene.linearity import tangent_warnings
from rotordyn.scene.stability import how_it_grows

SAME = 1e-6  # of a speed: tolerance of equal speeds
BESIDE = 1e-4  # of a speed: a peak nearer to a critical speed is the peak of that one
WIDER = 1.2  # times the orbit that a film is computed for: wider ones are reported
MOST = 0.99  # of the clearance: a larger orbit touches
FLAT = 0.2  # of the clearance: up to there damping changes by 6 %
ENOUGH = 0.01  # of the peak of a run: smaller errors are less than the uncertainty of damping
STRAIGHT = 1e-6  # of the major half axis: a smaller backward half axis is rounding


def summary(result: UnbalanceResult) -> list[str]:
    """Return lines of unbalances, largest half axes, zero to peak, and forces over speed."""
    acting = [
        unbroken(f"{name} {size * GRAM_MILLIMETRE.factor:.4g} g·mm at {x * 1e3:.1f} mm")
        + (unbroken(f" to {np.degrees(angle):.4g}°") if abs(angle) > 0.0 else "")
        for name, size, x, angle in zip(
            result.unbalance,
            result.unbalance_size,
            result.unbalance_station,
            result.unbalance_angle,
            strict=True,
        )
    ]
    orbits = [unbroken(f"{name} {word}") for name, word in _amplitudes(result).items()]
    forces = [
        unbroken(
            f"{name} {_endless(at)}"
            if np.isfinite(at)
            else f"{name} {_peak(values, '.4g')} N{_at_speed(result, values)}"
        )
        if np.isfinite(values).any()
        else f"{name} not determined"  # a rigid rotor on redundant rigid supports
        for name, values, at in zip(
            result.support,
            result.fine_force_amplitude.T,
            result.force_unbounded.tolist(),
            strict=True,
        )
    ]
    turns = "" if result.speed_ratio == 1.0 else f" on {result.rotor}, at its speed"
    return [
        f"unbalance  {', '.join(acting)}{turns}{_grade(result)}",
        f"           largest half axis of the orbit, zero to peak: {', '.join(orbits)}",
        f"           largest force, zero to peak: {', '.join(forces)}",
        *_backward(result),
        *_runs(result),
    ]


def _grade(result: UnbalanceResult) -> str:
    """Return text if a balance grade is for another speed than the highest of the case."""
    top = float(result.speed[-1])
    if result.grade_speed == 0.0 or abs(result.grade_speed - top) <= SAME * top:
        return ""
    beyond = (
        "above all speeds of the case" if result.grade_speed > top else "a coarser grade above it"
    )
    return f"; the grade is for {result.grade_speed * RPM.factor:.0f} rpm, {beyond}"


def numbers(result: UnbalanceResult, _: Described) -> Iterator[Number]:
    """Yield for each point the largest half axis of the orbit, and its speed."""
    for place, (name, values) in enumerate(
        zip(result.point, result.fine_major_axis.T, strict=True)
    ):
        endless = result.peak_speed[place, np.isinf(result.peak_amplitude[place])]
        at = endless[0] if endless.size else result.fine_speed[int(np.nanargmax(values))]
        size = np.inf if endless.size else float(np.nanmax(values)) * MICROMETRE.factor
        yield Number(name, MICROMETRE.unit, size, digits=2)
        yield Number(f"{name} at", RPM.unit, float(at) * RPM.factor, digits=0)
    for run, sizes in zip(result.run, result.run_peak, strict=True):
        for name, size in zip(result.point, sizes.tolist(), strict=True):
            yield Number(f"{name} {run}", MICROMETRE.unit, size * MICROMETRE.factor, digits=2)


def _amplitudes(result: UnbalanceResult) -> dict[str, str]:
    """Return by point the text of the largest half axis and its speed."""
    return {
        name: _unbounded(result, place)
        or f"{_peak(values * MICROMETRE.factor, '.4g')} µm{_at_speed(result, values)}"
        for place, (name, values) in enumerate(
            zip(result.point, result.fine_major_axis.T, strict=True)
        )
    }


def _unbounded(result: UnbalanceResult, place: int) -> str:
    """Return text of the speed of an unbounded amplitude of a point, or ""."""
    at = result.peak_speed[place, np.isinf(result.peak_amplitude[place])]
    return _endless(float(at[0])) if at.size else ""


def _endless(speed: float) -> str:
    return f"unbounded at {speed * RPM.factor:.0f} rpm, undamped"


def _peak(values: Array, form: str) -> str:
    return format(float(np.nanmax(values)), form)


def _at_speed(result: UnbalanceResult, values: Array) -> str:
    return f" at {result.fine_speed[int(np.nanargmax(values))] * RPM.factor:.0f} rpm"


def _backward(result: UnbalanceResult) -> list[str]:
    """Return the line of speeds with orbits against the spindle; the rotor itself may turn so."""
    at_rest = result.fine_major_axis == 0.0  # which has the sense of whirl of the next speed
    excess = -result.fine_minor_axis / np.where(at_rest, np.nan, result.fine_major_axis) - STRAIGHT
    excess[0] = np.where(at_rest[0], excess[min(1, len(excess) - 1)], excess[0])
    words = []
    for name, values in zip(result.point, excess.T, strict=True):
        ranges = [_from_to(*ends) for ends in above_zero(result.fine_speed, values)]
        words += [unbroken(f"{name} {' and '.join(ranges)}")] if ranges else []
    sense = "backward" if result.speed_ratio > 0.0 else "opposite to the spindle"
    return [f"           whirl {sense}: {', '.join(words)}"] if words else []


def _runs(result: UnbalanceResult) -> list[str]:
    """Return lines of the largest half axes of orbits and the largest forces on runs."""
    lines = list[str]()
    for k, name in enumerate(result.run):
        orbits = zip(
            result.point,
            result.run_peak[k] * MICROMETRE.factor,
            result.run_peak_speed[k],
            strict=True,
        )
        forces = zip(
            result.support, result.run_force_peak[k], result.run_force_peak_speed[k], strict=True
        )
        words = [
            ", ".join(
                unbroken(f"{part} {size:.4g} {unit} at {speed * RPM.factor:.0f} rpm")
                for part, size, speed in values
                if np.isfinite(size)
            )
            for values, unit in ((orbits, MICROMETRE.unit), (forces, "N"))
        ]
        text = "; ".join(filter(None, words)) or "no solution"
        lines.append(f"{'' if lines else 'run':<10} {name}: {text}")
    return lines


def accuracy(result: UnbalanceResult) -> list[str]:
    """Return lines of the largest estimated errors of the motion."""
    worst = float(result.error.max(initial=0.0))
    lines = [f"response to unbalance within {rounded_up(worst)} of its peak"]
    steady = np.nanmax(result.fine_major_axis, initial=0.0)
    grows = (result.run_peak > RUNAWAY * steady).any(axis=1)
    errors = result.run_error[np.isfinite(result.run_error) & ~grows]
    if errors.size:
        lines.append(f"runs within {rounded_up(float(errors.max()))} of their peaks")
    return lines


def warnings(result: UnbalanceResult) -> list[str]:
    """Return warnings of loads beyond tangents, films, light damping, runs and errors."""
    curves = result.support, result.fine_speed, result.fine_departure
    sentences = [*tangent_warnings("unbalance", *curves)]
    sentences += _films(result)
    sentences += _lightly_damped(result)
    sentences += _run_warnings(result)
    worst = float(result.error.max(initial=0.0))  # NaN without a finer model
    if worst > result.error_asked:
        point = result.point[int(result.error.argmax())]
        why = (
            f"unbalance: the motion of {point} is less accurate than asked for: an estimated error "
            f"of {rounded_up(worst)} of its peak remains after refinement"
        )
        sentences.append(graded(Severity.INVALID, why))
    return sentences


def _run_warnings(result: UnbalanceResult) -> Iterator[str]:
    """Yield warnings of runs without a solution, beyond tangents, inaccurate, or unstable."""
    for name, why in zip(result.run, result.run_outcome, strict=True):
        if why:
            lost = f"unbalance: the run {name} has no solution: {why}; leave it out"
            yield graded(Severity.NO_STATE, lost)
    for name, speed, departures in zip(
        result.run, result.run_force_peak_speed, result.run_departure, strict=True
    ):
        at = speed[~np.isnan(departures)]
        if at.size:
            where = f"on the run {name}, {_from_to(at.min(), at.max())}"
            what = f"unbalance: at the largest forces of bearings {where}"
            yield from tangent_warnings(what, result.support, None, departures[None])
    ranges = zip(result.unstable_from, result.unstable_to, result.unstable_pole, strict=True)
    highest = result.model_frequency
    grows = [f"{_from_to(*ends)} it {how_it_grows(pole, highest)}" for *ends, pole in ranges]
    for name, error in zip(result.run, result.run_error, strict=True):
        if error > ENOUGH:
            clear = ", without those at which the machine is unstable, where errors grow, too"
            yield (
                f"unbalance: the run {name} has an estimated error of {rounded_up(error)} of its "
                f"peak: take a shorter time, or a shorter range of speeds{clear if grows else ''}"
            )
    if result.run and grows:
        yield (
            "unbalance: the runs pass speeds at which the machine is unstable: "
            f"{'; '.join(grows)}. The unstable motion is part of them, and a run that begins there "
            "begins in a steady motion that the machine does not reach"
        )


def _from_to(first: float, last: float) -> str:
    """
    >>> _from_to(100.0, 200.0), _from_to(100.0, 100.0)
    ('from about 955 to 1910 rpm', 'at about 955 rpm')
    """
    ends = [number(speed * RPM.factor, 0) for speed in (first, last)]
    is_range = ends[0] != ends[1]
    return f"from about {ends[0]} to {ends[1]} rpm" if is_range else f"at about {ends[0]} rpm"


def _lightly_damped(result: UnbalanceResult) -> Iterator[str]:
    """Yield a warning of points with the highest peak at a lightly damped critical speed."""
    light = [
        (point, k)
        for point, k in zip(result.point, _highest_critical(result), strict=True)
        if k is not None and abs(result.critical_damping[k]) < LIGHT
    ]
    for point, k in light[:1]:
        others = f" (and of {len(light) - 1} more points)" if len(light) > 1 else ""
        peak = f"unbalance: the highest peak of {point}{others}, at "
        peak += f"{number(float(result.critical_speed[k]) * RPM.factor, 0)} rpm,"
        yield lightly_damped(peak, result.critical[k], float(result.critical_damping[k]))


def _highest_critical(result: UnbalanceResult) -> Iterator[int | None]:
    """Yield for each point the index of the critical speed at its highest peak, or None: there is
    no such speed, no peak, or an infinite one."""
    for speed, height in zip(result.peak_speed, result.peak_amplitude, strict=True):
        if not np.isfinite(height).any() or np.isinf(height).any():
            yield None
            continue
        distance = np.abs(result.critical_speed / speed[int(np.nanargmax(height))] - 1.0)
        is_near = distance.size and distance.min() <= BESIDE
        yield int(distance.argmin()) if is_near else None


def _films(result: UnbalanceResult) -> Iterator[str]:
    """Yield warnings of squeeze films whose largest orbit is not that of their coefficients."""
    for k, name in enumerate(result.support):
        orbit, ratio = np.nan_to_num(result.film_orbit[:, k], posinf=np.inf), result.film_ratio[k]
        row = int(orbit.argmax())
        wide, narrow = max(WIDER * ratio, FLAT), ratio / WIDER if ratio > FLAT else 0.0
        if not np.isfinite(ratio) or narrow <= orbit[row] <= wide:
            continue
        where = f"{number(float(result.fine_speed[row]) * RPM.factor, 0)} rpm"
        remedy = (
            "no film allows such an orbit"
            if orbit[row] > MOST
            else "find the eccentricity_ratio that agrees with the orbit, from "
            f"{100.0 * orbit[row]:.0f} % to {100.0 * ratio:.0f} %"
            if orbit[row] < ratio
            else f"try eccentricity_ratio: {100.0 * orbit[row]:.0f} %"
        )
        yield (
            f"unbalance: the largest orbit in squeeze film {name} is {100.0 * orbit[row]:.0f} % of "
            f"its clearance, at {where}, but the film is computed for {100.0 * ratio:.0f} %: "
            f"{remedy}"
        )
