"""A single bearing over load and speed as text: stiffness, contacts, truncated ellipses."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.bearing.result import BearingMapResult, RadialMapResult
from rotordyn.analyses.bearing.solve import mounted_under, under
from rotordyn.arrays import Array, Flags
from rotordyn.results.balls import (
    friction_warning,
    no_film,
    of_a_pair,
    on_open_side,
    overloaded,
    pressed,
    slipping,
    softened,
    unsafe,
)
from rotordyn.results.described import Described
from rotordyn.results.display import DEGREE, RPM, STIFFNESS, percent
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import INDENT, from_to, over_speed

MOST_LOADS = 6  # in a table of variants
RINGS = {"i": "inner", "o": "outer"}


def summary(result: BearingMapResult) -> list[str]:
    """Return lines on stiffness at each load over speed, life, and contacts with the grooves."""
    lines = [*_stiffness(result), *_life(result), *_heat(result)]
    if result.ball.size > 1 or len(result.contact) > 2:
        lines += _contacts(result)
    return lines + _rings(result)


def _rings(result: BearingMapResult) -> list[str]:
    """Return a line on the largest deflections of raceways of flexible rings."""
    normal = np.nan_to_num(result.ring_deflection * 1e6).max(axis=(0, 1, 2), initial=0.0)
    if not normal.any():
        return []
    inner, outer = (
        max(value for name, value in zip(result.contact, normal, strict=True) if name[0] == letter)
        for letter in RINGS
    )
    return [
        f"rings      deform: inner raceway by {inner:.2g} µm at most, outer raceway by "
        f"{outer:.2g} µm, in addition to the contacts"
    ]


@of_severity(Severity.LOAD)
def cut_off(result: BearingMapResult) -> list[str]:
    """Return a sentence for each ring whose groove ends within a contact ellipse at some load."""
    sentences = []
    for letter, ring in RINGS.items():
        contacts = [k for k, name in enumerate(result.contact) if name.startswith(letter)]
        upper, lower = result.ellipse_upper[..., contacts], result.ellipse_lower[..., contacts]
        truncated = np.nan_to_num(result.truncated[..., contacts])
        for what, beyond in (
            ("the shoulder", np.abs(_outermost(upper, lower)) > result.shoulder_angle[contacts]),
            ("the middle of the groove", lower < result.middle_angle[contacts]),
        ):
            share = np.where(beyond, truncated, 0.0).max(axis=(2, 3))
            if not share.any():
                continue
            column = int(np.flatnonzero(share.any(axis=0))[0])
            rpm = result.speed[np.flatnonzero(share[:, column])[0]] * RPM.factor
            sentences.append(
                f"contact ellipse passes {what} of the {ring} ring, first under "
                f"{mounted_under(result, column)} at {rpm:.0f} rpm, up to "
                f"{percent(share.max())} of its length outside the groove"
            )
    return sentences


def _outermost(upper: Array, lower: Array) -> Array:
    return np.where(np.abs(lower) > np.abs(upper), lower, upper)


def _stiffness(result: BearingMapResult) -> list[str]:
    speeds = from_to(result.speed * RPM.factor, 0)
    name = "" if result.tangent[0] == "complete" else f" ({result.tangent[0]} tangent)"
    lines = [f"stiffness  [N/µm] of the bearing, tilts blocked, at {speeds} rpm{name}"]
    stiffness = result.stiffness[:, :, 0] * STIFFNESS.factor
    for k in range(len(result.load)):
        reasons = [reason for reason in result.outcome[:, k] if reason]
        if len(reasons) == len(result.speed):
            lines.append(f"{INDENT}{mounted_under(result, k)}: {reasons[0]}")
            continue
        valid = result.outcome[:, k] == ""
        axial, radial = (over_speed(stiffness[valid, k, i, i], result.speed[valid]) for i in (0, 1))
        pressure = np.nanmax(np.fmax(result.inner_pressure, result.outer_pressure)[:, k]) / 1e9
        lines.append(
            f"{INDENT}{_solved(result, k)}: axial {axial}, radial {radial}; pressure up to "
            f"{pressure:.2f} GPa"
        )
    return lines


def _solved(result: BearingMapResult, k: int) -> str:
    """Return a load as text, with the range of speeds that have a state where it is not all."""
    valid = result.outcome[:, k] == ""
    if valid[[0, -1]].all():
        return mounted_under(result, k)
    return f"{mounted_under(result, k)}, at {from_to(result.speed[valid] * RPM.factor, 0)} rpm"


def _contacts(result: BearingMapResult) -> list[str]:
    """Return lines on the most loaded ball at the first and last load, at the last speed."""
    rpm = result.speed[-1] * RPM.factor
    lines = [f"contacts   of the most loaded ball, at {rpm:.0f} rpm"]
    for k in dict.fromkeys((0, len(result.load) - 1)):
        if result.outcome[-1, k]:
            continue
        ball = int(result.loaded_ball[-1, k]) if result.ball.size > 1 else 0
        ball_text = f"ball {ball} at {result.ball[ball] * DEGREE.factor:.0f}°: "
        parts = [
            f"{name} {load:.0f} N at {angle * DEGREE.factor:z.1f}°"
            for name, load, angle in zip(
                result.contact,
                result.contact_load[-1, k, ball],
                result.contact_angle[-1, k, ball],
                strict=True,
            )
            if load > 0.0
        ]
        lines.append(
            f"{INDENT}{mounted_under(result, k)}: {ball_text if result.ball.size > 1 else ''}"
            f"{', '.join(parts)}; {_numbers(result.contacts[-1, k])} contacts per ball"
        )
    return lines if len(lines) > 1 else []


def _life(result: BearingMapResult) -> list[str]:
    """Return lines on life and heat at the first and last load and speed with a state."""
    lines: list[str] = []
    for k in dict.fromkeys((0, len(result.load) - 1)):
        valid = result.outcome[:, k] == ""
        if not valid.any():
            continue
        life = f"{from_to(result.revolutions[valid, k] * 1e-6, 0)} million revolutions"
        text = f"{_solved(result, k)}: L10r {life}, S0 {from_to(result.static_safety[valid, k])}"
        if np.isfinite(result.viscous_heat[valid, k]).any():
            heat = (result.contact_heat + result.viscous_heat)[valid, k]
            turning = valid & (result.speed > 0.0)
            caveat = "; estimated from resultants where balls have more than two contacts"
            estimated = bool((result.contacts[turning, k] > 2).any())
            text += f", heat {from_to(heat, 0)} W (order of magnitude{caveat * estimated})"
        lines.append(f"{'life       ' if not lines else INDENT}{text}")
    return lines


def _heat(result: BearingMapResult) -> list[str]:
    """Return lines on temperatures at the highest speed with a balance, and the speed limit."""
    lines: list[str] = []
    for k in dict.fromkeys((0, len(result.load) - 1)):
        balanced = np.flatnonzero(np.isfinite(result.ball_temperature[:, k]))
        if not balanced.size:
            continue
        row = balanced[-1]
        balls, inner, outer = (
            f"{getattr(result, name)[row, k]:.0f}"
            for name in ("ball_temperature", "inner_temperature", "outer_temperature")
        )
        limit = result.speed_limit[k] * RPM.factor
        limit_text = (
            f"speed limit {limit:.0f} rpm" if np.isfinite(limit) else "no speed limit up to there"
        )
        text = (
            f"{mounted_under(result, k)}: at {result.speed[row] * RPM.factor:.0f} rpm balls "
            f"{balls}, rings {inner} and {outer} °C, load {result.axial_force[row, k]:.0f} N; "
            f"{limit_text}"
        )
        lines.append(f"{'warm       ' if not lines else INDENT}{text}")
    return lines


def _numbers(counts: NDArray[np.int_]) -> str:
    low, high = int(counts.min()), int(counts.max())
    return f"{low}" if low == high else f"{low} to {high}"


def numbers(result: BearingMapResult, _: Described) -> Iterator[Number]:
    """Yield axial and radial stiffness, life, heat and speed limit by load."""
    values = result.stiffness[:, :, 0] * STIFFNESS.factor
    for k in _shown(result):
        name = under(result, k)
        title = f"{name}, stiffness" if isinstance(result, RadialMapResult) else name
        for i, way in enumerate(("axial", "radial")):
            yield from each_speed(result, title, STIFFNESS.unit, values[:, k, i, i], part=way)
        lives = result.revolutions[:, k] * 1e-6
        yield from each_speed(result, f"L10r {name}", "1e6", lives, digits=0)
        if np.isfinite(result.viscous_heat[:, k]).any():
            heat = result.contact_heat[:, k] + result.viscous_heat[:, k]
            yield from each_speed(result, f"heat {name}", "W", heat, digits=0)
        if np.isfinite(result.ball_temperature[:, k]).any():
            limit = float(result.speed_limit[k] * RPM.factor)
            yield Number(f"speed limit {name}", "rpm", limit, digits=0, absent="not reached")


def _shown(result: BearingMapResult) -> list[int]:
    """Return the loads whose numbers are printed: all of few, of many the first and the last."""
    count = len(result.load)
    return list(range(count)) if count <= MOST_LOADS else [0, count - 1]


def _turning(result: BearingMapResult) -> Flags:
    """Return where the bearing turns under load (speeds, loads)."""
    return (result.speed > 0.0)[:, None] & (result.equivalent_load > 0.0)


def _lightly_loaded(result: BearingMapResult) -> Iterator[str]:
    """Warn of friction that rolling requires, and of balls on the open side, once for all loads."""
    rolling = (result.slipping == "").all(axis=0)
    friction = np.where(rolling, result.required_friction, 0.0)
    checks: tuple[tuple[Callable[..., str], NDArray[Any]], ...] = (
        (friction_warning, friction),
        (on_open_side, result.open_side > 0),
    )
    for check, values in checks:
        loads = [k for k in range(len(result.load)) if check("", result.speed, values[:, k])]
        if loads:
            what = f"under {mounted_under(result, loads[0])}{' and more' * (len(loads) > 1)}"
            yield check(what, result.speed, np.fmax.reduce(values[:, loads], axis=1))


def _beyond_life(result: BearingMapResult) -> Iterator[str]:
    """Warn of loads beyond the range of life models, from the first such load of the list on."""
    rating = np.asarray(result.dynamic_rating)

    def low(at: slice) -> str:
        return unsafe(result.static_safety[:, at], result.speed)

    def high(at: slice) -> str:
        return overloaded(result.equivalent_load[:, at], rating, result.speed)

    count = len(result.load)
    for check in (low, high):
        first = next((k for k in range(count) if check(slice(k, k + 1))), None)
        if first is not None:
            more = " and more" * (first + 1 < count)
            yield f"under {mounted_under(result, first)}{more}: {check(slice(first, None))}"


def _overheated(result: BearingMapResult) -> Iterator[str]:
    """Warn of the lowest speed above which temperatures reach no balance."""
    if np.isfinite(result.speed_limit).any():
        k = int(np.nanargmin(result.speed_limit))
        yield (
            f"there is no thermal balance above {result.speed_limit[k] * RPM.factor:.0f} rpm "
            f"under {mounted_under(result, k)}: cool the rings better, or lower the preload or the "
            "speed"
        )


def warnings(result: BearingMapResult) -> list[str]:
    """Return warnings on pressure, slip, life, films, temperatures and truncated ellipses."""
    peak = np.fmax(result.inner_pressure, result.outer_pressure)
    loads = [f"under {mounted_under(result, k)}" for k in range(len(result.load))]
    sentences = [
        pressed(load, result.speed, values) for load, values in zip(loads, peak.T, strict=True)
    ]
    sentences += [
        slipping(load, result.speed, values)
        for load, values in zip(loads, result.slipping.T, strict=True)
    ]
    sentences += [
        of_a_pair(result.dynamic_rating, result.groove_rating),
        softened(result.rating_factor, result.speed),
        *_lightly_loaded(result),
        *_beyond_life(result),
        no_film(_turning(result) & (result.film == 0.0), result.speed),
        *_overheated(result),
    ]
    return [*(sentence for sentence in sentences if sentence), *cut_off(result)]
