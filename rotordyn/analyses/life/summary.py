"""Life and heat of bearings in a few lines of text, and warnings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from rotordyn.analyses.life.result import HOUR, LifeResult
from rotordyn.arrays import Array, Flags
from rotordyn.results.balls import (
    LEAST_SAFETY,
    no_film,
    of_a_pair,
    overloaded,
    softened,
    unsafe,
)
from rotordyn.results.described import Described
from rotordyn.results.display import DEGREE, RPM, number, percent
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, graded, of_severity, severity_of
from rotordyn.results.text import from_to, unbroken, which_of

LONG = 1e6  # h, beyond which no life is printed
SAFE = 1e3  # of S0, next to no load
LIGHT = 0.01  # GPa
LEAST_KAPPA = 0.1  # below it ISO 281 gives no modified life


def summary(result: LifeResult) -> list[str]:
    """Life, static safety, heat, film and defect frequencies, most of them of the worst bearing."""
    if all(result.outcome):
        return []
    rpm = result.speed[_last(result)] * RPM.factor
    lines = [f"life       L10r at {rpm:.0f} rpm [h] {_listed(result, result.life / HOUR, hours)}"]
    lines[0] += f"; set {hours(result.set_life[_last(result)] / HOUR)}"
    if not np.isnan(result.spectrum_life).all():
        lives = ", ".join(
            unbroken(f"{name} {hours(life / HOUR)}")
            for name, life in zip(result.bearing, result.spectrum_life, strict=True)
        )
        lines.append(
            f"spectrum   L10r [h] {lives}; set {hours(result.spectrum_set_life / HOUR)}; "
            f"S0 {safe(float(result.spectrum_safety.min()))}"
        )
    if math.isfinite(result.viscosity):
        steep = ", ".join(result.bearing[k] for k in np.flatnonzero(unmodified(result)))
        grade = f"{100.0 * result.reliability:g} %"
        lines.append(
            f"modified   life of {grade} [h] "
            f"{_listed(result, result.modified_life / HOUR, hours)}; "
            f"κ {_range(result.viscosity_ratio[_last(result)], 2)}, film "
            f"{_range(result.film[_last(result)] * 1e9, 0)} nm"
            + (f"; of {steep} none: a_ISO is not known above 45°" if steep else "")
        )
        lines.append(
            f"heat       [W] {_over_speed(result, result.heat)} (order of magnitude; contacts and "
            "oil)"
        )
    if np.isfinite(result.ball_temperature).any():
        parts = ", ".join(
            f"{part} {_range(getattr(result, f'{name}_temperature')[_last(result)], 0)}"
            for part, name in (("balls", "ball"), ("inner", "inner"), ("outer rings", "outer"))
        )
        lines.append(f"warm       at {rpm:.0f} rpm {parts} °C")
    low, pressure = np.nanmin(result.static_safety), np.nanmax(result.pressure) / 1e9
    pressed = f"{pressure:.2f}" if pressure >= LIGHT else f"< {LIGHT:g}"
    lines.append(
        f"safety     S0 {safe(float(low))}, peak pressure {pressed} GPa; {_static(result)}"
    )
    orders = [
        f"{part} {_range(getattr(result, name)[_last(result)], 3)}"
        for part, name in (
            ("cage", "cage"),
            ("outer race", "outer"),
            ("inner race", "inner"),
            ("ball", "ball"),
        )
    ]
    lines.append(f"defects    × speed at {rpm:.0f} rpm: {', '.join(map(unbroken, orders))}")
    return lines


def _static(result: LifeResult) -> str:
    """C0 and Cu of every bearing, their origin, and bearings of which C is given and C0 is not."""
    groups: dict[str, list[str]] = {}
    lacking = []
    for k, name in enumerate(result.bearing):
        used, grooves = result.static_rating[k], result.groove_static_rating[k]
        of = "of the grooves" if used == grooves else "as given"
        rating = f"{used:.0f} {of} (Cu {result.fatigue_limit[k]:.0f})"
        groups.setdefault(rating, []).append(name)
        if used == grooves and result.dynamic_rating[k] != result.groove_rating[k]:
            lacking.append(name)
    entries = ", ".join(unbroken(f"{'/'.join(names)} {rating}") for rating, names in groups.items())
    missing = (
        f"; {', '.join(lacking)}: C is given and C0 is not (static_ratings)" if lacking else ""
    )
    return f"C0 [N] {entries}{missing}"


def unmodified(result: LifeResult) -> Flags:
    """Bearings (bearings,) of which a_ISO is not known at any κ, such as thrust bearings."""
    sufficient = result.viscosity_ratio >= LEAST_KAPPA
    expected = sufficient & np.isfinite(result.equivalent_load)
    return np.asarray(expected.any(axis=0) & np.isnan(result.life_factor).all(axis=0))


def hours(value: float) -> str:
    """Hours as text, in three digits.

    >>> hours(79320.4), hours(4.2e6), hours(float("inf"))
    ('79300', '> 1e6', '> 1e6')
    """
    if math.isnan(value):
        return "none"
    return "> 1e6" if value > LONG else f"{float(f'{value:.3g}'):.0f}"


def safe(value: float) -> str:
    """The least static safety as text.

    >>> safe(2.459), safe(1.07e10), safe(float("inf"))
    ('from 2.46', '> 1000', '> 1000')
    """
    return f"> {SAFE:.0f}" if value > SAFE else f"from {number(value)}"


def _last(result: LifeResult) -> int:
    """Index of the last speed with a state."""
    return max(k for k, word in enumerate(result.outcome) if not word)


def _listed(result: LifeResult, values: Array, written: Callable[[float], str]) -> str:
    """Value of every bearing at the last speed; bearings of equal values are grouped."""
    groups: dict[str, list[str]] = {}
    for name, value in zip(result.bearing, values[_last(result)], strict=True):
        groups.setdefault(written(float(value)), []).append(name)
    return ", ".join(unbroken(f"{'/'.join(names)} {word}") for word, names in groups.items())


def _over_speed(result: LifeResult, values: Array) -> str:
    """Value of every bearing over speed; bearings of equal values are grouped."""
    groups: dict[str, list[str]] = {}
    solved = [k for k, word in enumerate(result.outcome) if not word]
    for name, column in zip(result.bearing, values.T, strict=True):
        groups.setdefault(from_to(column[solved], 0), []).append(name)
    return ", ".join(unbroken(f"{'/'.join(names)} {word}") for word, names in groups.items())


def _range(values: Array, digits: int) -> str:
    """The least and the largest value of some bearings."""
    ends = [number(float(end), digits) for end in (np.nanmin(values), np.nanmax(values))]
    return ends[0] if ends[0] == ends[1] else f"{ends[0]} to {ends[1]}"


def numbers(result: LifeResult, _: Described) -> Iterator[Number]:
    """Life of the set, static safety, pressure and heat."""
    lives = np.where(np.isfinite(result.set_life), result.set_life / HOUR, np.nan)
    yield from each_speed(result, "set L10r", "h", lives, digits=0)
    if np.isfinite(result.spectrum_set_life):
        yield Number("set L10r, spectrum", "h", result.spectrum_set_life / HOUR, digits=0)
    yield from each_speed(result, "S0", "", result.static_safety.min(axis=1))
    yield from each_speed(result, "pressure", "GPa", result.pressure.max(axis=1) / 1e9, digits=2)
    if math.isfinite(result.viscosity):
        yield from each_speed(result, "heat", "W", result.heat.sum(axis=1), digits=0)
    if np.isfinite(result.ball_temperature).any():
        hottest = result.ball_temperature.max(axis=1)
        yield from each_speed(result, "balls", "°C", hottest, digits=0)


def warnings(result: LifeResult) -> list[str]:
    """A sentence with its remedy for every value beyond a limit or the range of a formula."""
    sentences: dict[str, list[str]] = {}
    for k, name in enumerate(result.bearing):
        for sentence in _of_bearing(result, k):
            sentences.setdefault(sentence, []).append(name)
    return [
        graded(
            severity_of(sentence),
            f"bearing{'s' if len(names) > 1 else ''} {', '.join(names)}: {sentence}",
        )
        for sentence, names in sentences.items()
    ]


def _of_bearing(result: LifeResult, k: int) -> Iterator[str]:
    if doubt := of_a_pair(result.dynamic_rating[k], result.groove_rating[k]):
        yield doubt
    yield from _overloaded(result, k)
    if hot := softened(result.rating_factor[:, k], result.speed):
        yield hot
    passing = result.shoulder_margin[:, k] < 0.0
    if passing.any():
        margin = -np.nanmin(result.shoulder_margin[:, k]) * DEGREE.factor
        share = percent(np.nanmax(result.lost_load[:, k]))
        cut = (
            f"a contact ellipse passes the shoulder by {margin:.2g}° "
            f"{which_of(result.speed, passing)}, with {share} of its load; lower the load or raise "
            "the shoulder"
        )
        yield graded(Severity.LOAD, cut)
    turning = result.speed > 0.0
    thin = turning & (result.viscosity_ratio[:, k] < LEAST_KAPPA)
    if thin.any():
        last = result.speed[np.flatnonzero(thin)[-1]] * RPM.factor
        yield (
            f"viscosity ratio κ below {LEAST_KAPPA:g} up to {last:.0f} rpm, where ISO 281 defines "
            "no modified life; take an oil of higher viscosity"
        )
    loaded = turning & np.isfinite(result.equivalent_load[:, k])
    if thick := no_film(loaded & (result.film[:, k] == 0.0), result.speed):
        yield thick
    slips = result.slips[:, k]
    if slips.any():
        slip = (
            "the balls need more friction than the lubricant provides "
            f"{which_of(result.speed, slips)}: they slip, and the heat of the contacts is "
            "uncertain there; raise the preload"
        )
        yield graded(Severity.LOAD, slip)
    life = result.spectrum_life[k]
    lives = np.array([life]) if np.isfinite(life) else result.life[:, k]
    if np.isfinite(result.target) and np.nanmin(lives, initial=np.inf) < result.target:
        yield (
            f"life {hours(float(np.nanmin(lives)) / HOUR)} h is below the target of "
            f"{hours(result.target / HOUR)} h; lower load or speed, or take a larger bearing"
        )


@of_severity(Severity.LOAD)
def _overloaded(result: LifeResult, k: int) -> Iterator[str]:
    if low := unsafe(result.static_safety[:, k], result.speed):
        yield low
    if result.spectrum_unloaded[k] > 0.0:
        yield (
            f"the load spectrum leaves it without load for "
            f"{100.0 * result.spectrum_unloaded[k]:.3g} % of the time, where its balls do not roll "
            "and its life is not meaningful; raise the preload, or change the loads"
        )
    if result.spectrum_safety[k] < LEAST_SAFETY:
        yield (
            f"static safety {result.spectrum_safety[k]:.2g} under the load spectrum is below "
            f"{LEAST_SAFETY:g}; lower the load or take a larger bearing"
        )
    if high := overloaded(result.equivalent_load[:, k], result.dynamic_rating[k], result.speed):
        yield high
