"""Warnings and notes about a machine at its speeds, one sentence each.

Nothing is solved for them: they read the description and what the analyses have solved already.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import combinations, product
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.machine.plausibility import implausible, named
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.station import SLACK
from rotordyn.preload.growth import Release, released_fits
from rotordyn.preload.ring_stress import YIELD, ring_stress
from rotordyn.results.balls import (
    friction_warning,
    no_film,
    on_open_side,
    preloaded,
    pressed,
    races,
    slipping,
)
from rotordyn.results.display import RPM, number
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import which_of
from rotordyn.scene.expansions import expansion_warnings
from rotordyn.scene.missing_shifts import missing_shifts
from rotordyn.scene.stability import instability

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

PRESSED = 1e-3  # N: a stop that friction holds a sleeve at carries less by rounding
FILMS_RULE = 0.1  # of the axial load of a bearing
HEAT_RULE, WEAK = 0.1, 10.0  # of the heat of a bearing, and what counts as little of it [W]
GUIDE_RULE = 0.1  # of the stiffness of a ball guide


def machine_warnings(scene: Scene) -> Iterator[str]:
    """Yield warnings about the description, its bearings where solved, and unstable motions."""
    top = float(scene.bearing_speed.max())
    yield from implausible(scene.spindle, top)
    yield from _released_fits(scene)
    yield from _yielding_rings(scene)
    yield from expansion_warnings(scene.spindle, scene.conditions)
    if scene.conditions.heat_flow is not None:
        yield from scene.conditions.heat_flow.guesses()
    if scene.conditions.history and not scene.spindle.rubs:
        yield (
            "history: no sleeve has friction, so that the history has no effect; give friction to "
            "a sleeve, or leave the history out"
        )
    if "preload" in scene.solved:
        yield from bearing_warnings(scene)
        yield from _films_rule(scene)
        yield from _heat_across(scene)
        yield from missing_shifts(scene)
        yield from _guides(scene)
    for support in scene.spindle.supports:
        yield from support.held_at(scene.speed)
    systems = list(scene.systems.values())
    if systems:
        yield from instability(systems, scene.speed[scene.usable])
    elif not all(scene.outcome):
        yield from _statically_unstable(scene)


@of_severity(Severity.LOAD)
def _released_fits(scene: Scene) -> Iterator[str]:
    """Warn of rings that come loose where temperatures are known."""
    speed = scene.bearing_speed[scene.has_temperatures]
    if not speed.size:
        return
    loose: dict[tuple[str, str], list[Release]] = {}
    for each in released_fits(scene.spindle, speed, scene.temperatures):
        loose.setdefault((each.ring, each.seat), []).append(each)
    for (ring, on), released in loose.items():
        names = list(dict.fromkeys(each.bearing for each in released))
        first = min(released, key=lambda each: each.speed)
        when = _when(first.held, first.speed)
        if len(names) == 1:
            yield (
                f"bearing {names[0]}: the fit of its {ring} ring loosens {when}, from where on the "
                f"ring grows without the {on}; raise its interference"
            )
            continue
        later = any(each.speed > first.speed for each in released)
        yield (
            f"{named(names)}: the fits of their {ring} rings loosen {when}"
            f"{f' ({first.bearing} first)' if later else ''}, from where on the rings grow without "
            f"the {on}; raise their interference"
        )


def _when(held: float, loose: float) -> str:
    """Say where a ring loosens, between a speed [rad/s] at which it is tight (NaN: none is known)
    and one at which it is loose."""
    first, last = (f"{speed * RPM.factor:.0f}" for speed in (held, loose))
    if math.isnan(held):
        return f"by {last} rpm"
    return f"at {last} rpm" if held == loose else f"between {first} and {last} rpm"


@of_severity(Severity.NO_STATE)
def _statically_unstable(scene: Scene) -> Iterator[str]:
    """Warn where the negative stiffness of supports exceeds the stiffness that holds the shaft."""
    speed = scene.speed[scene.usable][scene.statically_unstable]
    if speed.size:
        names = ", ".join(
            support.name for support in scene.spindle.supports if support.has_negative_stiffness
        )
        yield (
            f"the negative stiffness of support {names} exceeds the restoring stiffness of the "
            f"shaft at {speed.size} of {len(scene.usable)} speeds, first at "
            f"{number(speed[0] * RPM.factor, 0)} rpm, where the static equilibrium is unstable; "
            "reduce it, or support the shaft more stiffly"
        )


def friction_notes(scene: Scene) -> Iterator[str]:
    """Note how sleeves with dry friction are modelled."""
    names = [sleeve.name for sleeve in scene.spindle.sleeves if sleeve.friction > 0.0]
    if names and "preload" in scene.solved:
        pressed = (scene.preload.stop_force > PRESSED) & (scene.preload.rubs[1:] > 0.0)
        past = "the history of the case" if scene.conditions.history else "a run-up from rest"
        yield (
            f"dry friction holds sleeve {', '.join(names)}: the state is the one after {past}; "
            "vibrations are taken as too small to move the sleeve along the axis"
            + "; at a stop only the sum of stop and friction force is determined"
            * bool(pressed.any())
        )


def arc_notes(scene: Scene) -> Iterator[str]:
    """Note turning balls with more than two contacts: their motion is that of the resultants."""
    if "preload" not in scene.solved:
        return
    state = scene.preload
    turning = state.usable & (state.speed > 0.0)
    for seat, (balls, column) in zip(scene.spindle.seats, state.seat_states(), strict=True):
        multiple = (balls.contacts[:, column] > 2).any(axis=1)
        if (rows := np.flatnonzero(turning & multiple)).size:
            yield (
                f"balls of bearing {seat.name} have more than two contacts "
                f"{_rows_when(state.speed, rows)}, not all of which roll: their orbit, defect "
                "frequencies and heat are estimates there, from the resultants of each race"
            )


def joint_notes(spindle: Spindle, *, rigid: bool) -> Iterator[str]:
    """Note joints of a ``rigid`` shaft, and points at joints, which belong to the part in front."""
    if rigid and spindle.joints:
        names = ", ".join(joint.name for joint in spindle.joints)
        yield f"with rotor: rigid the joints of the shaft are rigid as well: {names}"
    for joint, (name, x) in product(spindle.joints, spindle.points.items()):
        if abs(x - joint.x) <= SLACK:
            yield (
                f"point {name} lies at joint {joint.name} and moves with the part in front of it: "
                "for the part behind, name a point 0.1 mm behind the joint"
            )


def ring_notes(scene: Scene) -> Iterator[str]:
    """Note by how much flexible rings deform under their balls."""
    if not any(seat.flexible_rings for seat in scene.spindle.seats):
        return
    if "preload" not in scene.solved:
        return
    from bearings.ring.deflection import ring_deflection  # finite elements, for these alone

    state, parts = scene.preload, []
    largest: dict[str, Array] = {}
    for seat, (balls, column) in zip(scene.spindle.seats, state.seat_states(), strict=True):
        if seat.flexible_rings is None:
            continue
        deflection = ring_deflection(balls.rows((slice(None), column)))
        inner, outer = (
            np.nanmax(ring[state.usable], initial=0.0) * 1e6
            for ring in (deflection.inner, deflection.outer)
        )
        bodies = seat.flexible_rings
        texts = (
            f"{inner:.2g}" if bodies.inner else "rigid",
            f"{outer:.2g}" if bodies.outer else "rigid",
        )
        parts.append(f"{seat.name} {' and '.join(texts)}")
        largest[seat.name] = np.nanmax(balls.inner_load[state.usable, column], axis=1, initial=0.0)
    yield (
        f"rings deform, {_walls(scene.spindle, largest)}; raceways deflect at most [µm], inner and "
        f"outer, bearing {', '.join(parts)}"
    )


def _walls(spindle: Spindle, largest: Mapping[str, Array]) -> str:
    """Say which bearings share walls, and by how much their ``largest`` ball loads (speeds,)
    differ, which the computation takes as equal."""
    pairs, spread = [], 0.0
    for one, other in combinations([s for s in spindle.seats if s.name in largest], 2):
        if not any(spindle.joined(one, other, which) for which in ("inner", "outer")):
            continue
        pairs.append(f"{one.name} and {other.name}")
        loads = np.stack([largest[one.name], largest[other.name]])
        peak = loads.max(axis=0)
        difference = np.ptp(loads, axis=0) / np.where(peak > 0.0, peak, 1.0)
        spread = max(spread, float(difference.max(initial=0.0)))
    if not pairs:
        return "every bearing with separate walls"
    return (
        f"those of {', '.join(pairs)} on common walls as if loaded alike (largest ball loads up to "
        f"{100.0 * spread:.0f} % apart)"
    )


@of_severity(Severity.LOAD)
def _yielding_rings(scene: Scene) -> Iterator[str]:
    """Warn of inner rings that yield under their interference fit."""
    stress = ring_stress(scene.spindle, scene.bearing_speed, scene.temperatures)
    stress = np.where(scene.has_temperatures[:, None], stress, np.nan)
    seats = [seat.name for seat in scene.spindle.seats]
    if names := [name for name, ring in zip(seats, stress.T, strict=True) if _yields(ring)]:
        row, k = np.unravel_index(int(np.nanargmax(stress)), stress.shape)
        one = len(names) == 1
        what = "its inner ring yields under its fit,"
        what = what if one else "inner rings yield under their fits, up to"
        yield (
            f"{named(names)}: {what} {stress[row, k] / 1e6:.0f} MPa after Tresca at "
            f"{scene.bearing_speed[row] * RPM.factor:.0f} rpm, allowed {YIELD / 1e6:g}; lower the "
            "interference"
        )


def _yields(stress: Array) -> bool:
    return bool(np.nanmax(stress, initial=0.0) > YIELD)


def _heat_across(scene: Scene) -> Iterator[str]:
    """Warn of the bearing whose heat loads across the axis change most, where this is more than a
    tenth: temperatures do not follow it."""
    if not scene.loaded or scene.temperatures is scene.conditions.temperatures:
        return
    heat_flow = scene.conditions.heat_flow
    assert heat_flow is not None
    from rotordyn.preload.heat_balance import spindle_heat  # heat of balls, for these alone

    without, under = (spindle_heat(s, heat_flow.flow) for s in (scene.unloaded, scene.preload))
    solved = scene.preload.usable & scene.has_temperatures
    change = np.where(solved[:, None], np.abs(under - without), 0.0)
    share = change / np.fmax(without, WEAK)
    row, k = (int(place) for place in np.unravel_index(int(share.argmax()), share.shape))
    if share[row, k] > HEAT_RULE:
        yield (
            f"bearing {scene.spindle.seats[k].name}: loads across the axis change its heat from "
            f"{without[row, k]:.0f} to {under[row, k]:.0f} W at "
            f"{scene.preload.speed[row] * RPM.factor:.0f} rpm; its temperatures by heat_flow, and "
            f"the preload at them, are those of the {without[row, k]:.0f} W: give temperatures "
            "under these loads instead"
        )


def _films_rule(scene: Scene) -> Iterator[str]:
    """Warn of bearings whose axial load oil films change by more than a tenth."""
    state = scene.unloaded if scene.conditions.films is not None else None
    if state is None or state.films is None:
        return
    films = np.hypot(state.films.growth, state.films.axial)
    turning = (state.usable & (state.films.speed > 0.0))[:, None]
    if thick := no_film(turning & (films == 0.0) & (state.seat_load() != 0.0), state.films.speed):
        yield thick
    without, load = state.films.without, state.seat_load()
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(state.usable[:, None], np.abs(load / without - 1.0), np.nan)
    highest = np.nanmax(share, axis=0, initial=0.0)
    names = [
        s.name for s, most in zip(scene.spindle.seats, highest, strict=True) if most > FILMS_RULE
    ]
    if names:
        row, k = (int(at) for at in np.unravel_index(int(np.nanargmax(share)), share.shape))
        of = (
            "its axial load"
            if len(names) == 1
            else f"their axial loads, that of {scene.spindle.seats[k].name} most,"
        )
        yield (
            f"{named(names)}: oil films change {of} from {without[row, k]:.0f} to "
            f"{load[row, k]:.0f} N at {state.speed[row] * RPM.factor:.0f} rpm; this is for "
            "fully flooded films, and starved films change it less"
        )


def _guides(scene: Scene) -> Iterator[str]:
    """Warn of ball guides under loads at which their stiffness is far from that at the centre."""
    state = scene.preload
    guides = {s: s.ball_guide.law for s in scene.spindle.sleeves if s.ball_guide is not None}
    if state.lateral is None or not guides:
        return
    from scipy.optimize import brentq

    for sleeve, law in guides.items():
        across = np.zeros((len(state.speed), 2))
        for seat, (balls, column) in zip(scene.spindle.seats, state.seat_states(), strict=True):
            if seat.name in sleeve.bearings:
                turn = HALF_TURN_ABOUT_Y[1:3] if seat.thrust < 0 else 1.0
                across += balls.load[:, column, 1:3] * turn
        force = np.where(state.usable, np.hypot(*across.T), 0.0)
        loaded = force > 0.0
        shift, mean, slope = np.zeros_like(force), *np.full((2, len(force)), law.stiffness)
        for k in np.flatnonzero(loaded):
            top = 2.0 * force[k] / law.stiffness  # the deflection is below 1.15 F/k
            args = (law, force[k])
            shift[k] = brentq(lambda x, g, f: float(g.force(x)) - f, 0.0, top, args=args)
        mean[loaded], slope[loaded] = force[loaded] / shift[loaded], law.tangent(shift[loaded])
        deviation = np.abs(np.array([mean, slope]) / law.stiffness - 1.0).max(axis=0)
        row = int(deviation.round(3).argmax())  # the first of equal ones
        if deviation[row] > GUIDE_RULE:
            yield (
                f"sleeve {sleeve.name}: its ball guide carries {force[row]:.0f} N across at "
                f"{state.speed[row] * RPM.factor:.0f} rpm, where it deflects by "
                f"{shift[row] * 1e6:.3g} µm ({mean[row] / 1e6:.4g} N/µm) and has "
                f"{slope[row] / 1e6:.4g} N/µm for vibration; the {law.stiffness / 1e6:.4g} N/µm at "
                "its centre are taken: give one of these as radial_stiffness instead"
            )


def bearing_warnings(scene: Scene) -> Iterator[str]:
    """Yield warnings of pressure, slip, required friction, open sides and small shims."""
    state = scene.preload
    speed, usable = state.speed, state.usable
    pressure, friction, slips, wrong_side = {}, {}, {}, {}
    for seat, (balls, column) in zip(scene.spindle.seats, state.seat_states(), strict=True):
        driven = balls.driven[:, column]
        pressure[seat.name], friction[seat.name] = (
            np.where(usable, np.where(counted, part[:, column], 0.0).max(axis=-1), np.nan)
            for part, counted in (
                (np.fmax(balls.inner_pressure, balls.outer_pressure), True),
                (np.fmax(balls.inner_required_friction, balls.outer_required_friction), driven),
            )
        )
        on = np.where(driven, balls.slipping[:, column], "")
        slips[seat.name] = np.where(usable[:, None], on, "")
        if any(races(slips[seat.name])):
            del friction[seat.name]
        wrong_side[seat.name] = usable & (balls.status[:, column] == "open side").any(axis=-1)
    yield from _of_several(pressed, speed, pressure)
    unpressed = {name: peak for name, peak in pressure.items() if not pressed(name, speed, peak)}
    yield from _of_several(preloaded, speed, unpressed)
    yield from _of_several(lambda what, s, each: slipping(what, s, races(each)), speed, slips)
    yield from _of_several(friction_warning, speed, friction)
    yield from _of_several(on_open_side, speed, wrong_side)
    if state.lateral is not None or state.force:
        states = zip(scene.spindle.seats, state.seat_states(), strict=True)
        loads = [(seat, balls.inner_load[:, column]) for seat, (balls, column) in states]
        yield from _unloaded_balls(speed, usable, loads)
    yield from state.small_shims()


def _of_several(
    warning: Callable[[str, Array, Any], str], speed: Array, values: Mapping[str, Any]
) -> Iterator[str]:
    """Yield one ``warning`` of all bearings whose ``values`` (speeds, …) call for it: of the
    largest value, and of the speeds at which any of them does."""
    names = [name for name, each in values.items() if warning(name, speed, each)]
    if names:
        each = [values[name] for name in names]
        text = each[0].dtype.kind == "U"
        joined = np.concatenate(each, axis=-1) if text else np.fmax.reduce(each)
        yield warning(named(names), speed, joined)


@of_severity(Severity.LOAD)
def _unloaded_balls(
    speed: Array, usable: Flags, loads: Iterable[tuple[BearingSeat, Array]]
) -> Iterator[str]:
    """Warn of balls that static loads unload: all of them, or some of a bearing that takes thrust
    in one direction. ``loads`` (speeds, balls) of each seat."""
    idle: dict[tuple[bool, bool], list[tuple[BearingSeat, Flags, Indices]]] = {}
    for seat, load in loads:
        without = usable[:, None] & (load <= 0.0)
        both_ways = seat.bearing.both_ways
        rows = np.flatnonzero(without.all(axis=1) if both_ways else without.any(axis=1))
        if rows.size:
            kind = both_ways, bool(without[rows[0]].all())
            idle.setdefault(kind, []).append((seat, without[rows[0]], rows))
    for (both_ways, every), found in idle.items():
        names = named([seat.name for seat, _, _ in found])
        when = _rows_when(speed, np.unique(np.concatenate([rows for *_, rows in found])))
        it = "it" if len(found) == 1 else "them"
        if every:
            why = f"static loads unload {it}"
            why = "no ball is loaded within the clearance" if both_ways else why
            yield (
                f"{names}: {why} {when}: no stiffness there, and modes, stiffness and responses "
                f"are those of the shaft without {it}; raise the preload, or change the loads"
            )
            continue
        seat, balls, _ = max(found, key=lambda each: float(each[1].mean()))
        angle = 360.0 * np.flatnonzero(balls) / len(balls) * seat.thrust
        of = f"its {len(balls)} balls" if len(found) == 1 else f"{len(balls)} balls of {seat.name}"
        yield (
            f"{names}: under the static loads {int(balls.sum())} of {of} carry nothing {when}, "
            f"such as that at {int(angle[0]) % 360}° from y towards z: raise the preload, or lower "
            "the loads (bearing_loads shows under which part of them)"
        )


def _rows_when(speed: Array, rows: Indices) -> str:
    """Say at which ``rows`` of the speeds [rad/s] something holds; a single one by its rpm."""
    if rows.size == 1:
        return f"at {speed[rows[0]] * RPM.factor:.0f} rpm"
    return which_of(speed, np.isin(np.arange(len(speed)), rows))
