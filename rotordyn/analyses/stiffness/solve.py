"""Quasi-static radial stiffness of a point, for each way of modelling the bearings.

The load lies in plane y, so shaft and bearings move in (x, y, θz) only, unless static loads of the
case act besides. Tilts and the axial arrangement are free to follow.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stiffness.radial_curve import RadialCurve, Words, radial_curve
from rotordyn.analyses.stiffness.result import SHORT_STOP, StiffnessResult
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.arrays import Array, Indices
from rotordyn.description import unchecked
from rotordyn.equation.statics import PLANE, Across, StaticRotor, loaded_rotor, plane_rotor
from rotordyn.preload.arrangement import SHAFT
from rotordyn.preload.balance import Balance
from rotordyn.preload.friction import with_friction
from rotordyn.preload.outcome import LEAST_LOAD
from rotordyn.preload.state import PreloadState
from rotordyn.results.display import RPM
from rotordyn.scene.across import across
from rotordyn.scene.scene import Scene

UNIT = np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])  # [N] along y
REACHED = 1e-12  # m
ASIDE = 2e-3  # rad/s from a speed at which a stop is met: it is open below, closed above
FALLS = (
    "the negative stiffness of a support exceeds the stiffness of bearings and other supports: "
    "lower it, or support the shaft more stiffly"
)


@dataclass(frozen=True, eq=False, slots=True)
class Variant:
    """One way of modelling the bearings at the usable speeds.

    ``deflection`` (usable, loads), ``tangent`` at no load and ``outcome`` (usable,).
    """

    deflection: Array
    tangent: Array
    outcome: NDArray[np.str_]


Variants = dict[str, Variant | RadialCurve]


def solve(scene: Scene, spec: StiffnessSpec) -> StiffnessResult:
    """Deflection curves, tangent at no load and secant at full load (speeds, variants, …)."""
    force = np.linspace(0.0, spec.max_force, spec.steps + 1)
    variants, nonlinear = _variants(scene, spec, force)
    deflection = np.stack([variant.deflection for variant in variants.values()], axis=1)
    tangent = _tangents(scene, variants)
    deflection[scene.statically_unstable] = np.nan
    seats = scene.spindle.seats
    force_lost, ball = np.full((2, len(scene.usable), len(seats)), np.nan)
    loads = np.full((len(scene.usable), len(force), len(seats), 3), np.nan)
    if nonlinear is not None:
        loads = nonlinear.bearings
        force_lost = nonlinear.unloading
        ball = np.where(np.isfinite(force_lost), nonlinear.unloaded, np.nan)
    # balls of a bearing at thrust −x count against the azimuth of the spindle
    per_ball = np.array([2.0 * math.pi * seat.thrust / seat.bearing.balls for seat in seats])
    stop_speed, stop_tangent = _at_stops(scene, spec, len(variants))
    return StiffnessResult(
        speed=scene.speed,
        variant=tuple(variants),
        force=force,
        bearing=tuple(seat.name for seat in seats),
        stop_speed=stop_speed,
        outcome=_outcome(scene, variants),
        deflection=scene.scattered(deflection),
        tangent=scene.scattered(tangent),
        stop_tangent=stop_tangent,
        secant=scene.scattered(_secant(force, deflection)),
        axial_load=scene.scattered(loads[..., 0]),
        radial_load=scene.scattered(loads[..., 1]),
        ball_load=scene.scattered(loads[..., 2]),
        unloading_force=scene.scattered(force_lost),
        unloaded_ball=scene.scattered(ball + 1.0),
        unloaded_azimuth=scene.scattered(np.mod(ball * per_ball, 2.0 * math.pi)),
    )


def _tangents(scene: Scene, variants: Variants) -> Array:
    """Tangents at no load (usable, variants), NaN where the machine is statically unstable."""
    tangent = np.stack([variant.tangent for variant in variants.values()], axis=1)
    tangent[scene.statically_unstable] = np.nan
    return tangent


def _at_stops(scene: Scene, spec: StiffnessSpec, count: int) -> tuple[Array, Array]:
    """Speeds on both sides of those at which a sleeve meets its stop, within those of the case, and
    the tangents there (speeds, variants); NaN for other stops, which are met elsewhere."""
    closing = scene.stop_speeds[np.isfinite(scene.stop_speeds)]
    sides = np.unique(np.concatenate([closing - ASIDE, closing + ASIDE]))
    first, last = scene.speed[scene.usable[[0, -1]]]
    sides = sides[(sides > first + ASIDE) & (sides < last - ASIDE)]  # between the speeds
    if not sides.size:
        return sides, np.zeros((0, count))
    there, tangent = scene.at(sides), np.full((sides.size, count), np.nan)
    if spec.variants:
        with unchecked():  # it may be without load steps
            alone = replace(spec, second_stop={})
        variants, _ = _variants(there, alone, np.zeros(1))
        tangent[:, : len(variants)] = there.scattered(_tangents(there, variants))
    return sides, tangent


def _variants(
    scene: Scene, spec: StiffnessSpec, force: Array
) -> tuple[Variants, RadialCurve | None]:
    """Solve all variants; the full bearing model where one of them needs it."""
    rotor = _rotor(scene, spec)
    variants: Variants = {}
    rows, outcome = scene.bearing_row[scene.usable], np.where(scene.statically_unstable, FALLS, "")
    curves = partial(_nonlinear, scene.preload, rotor, rows, force, outcome)
    nonlinear = None
    if "nonlinear" in spec.variants or spec.second_stop:
        nonlinear = scene.timed("stiffness: nonlinear", curves)
    for name in spec.variants:
        if name == "nonlinear" and nonlinear is not None:
            variants[name] = nonlinear
        else:
            work = partial(_linear, scene, spec, rotor, name, force)
            variants[name] = scene.timed(f"stiffness: {name}", work)
    if nonlinear is not None and spec.second_stop:
        short = partial(_short_stop, scene, spec, force, nonlinear)
        variants[SHORT_STOP] = scene.timed(f"stiffness: {SHORT_STOP}", short)
    return variants, nonlinear


def _secant(force: Array, deflection: Array) -> Array:
    """Secant stiffness at full load (usable, variants) [N/m]; NaN without load steps."""
    if len(force) == 1:
        return np.full(deflection.shape[:-1], np.nan)
    return np.asarray(force[-1] / deflection[..., -1])


def _rotor(
    scene: Scene,
    spec: StiffnessSpec,
    seat_load: Array | None = None,
    speed: Array | None = None,
) -> StaticRotor:
    """Rotor under the axial forces of the preload states, or ``seat_load`` (states, seats) [N]."""
    force = scene.bending_force(seat_load)
    speeds = scene.state_speed if speed is None else speed
    states = max(len(speeds), 0 if force is None else len(force))
    speeds = np.broadcast_to(speeds, states)
    if force is not None:
        force = np.broadcast_to(force, (states, force.shape[1]))
    place = scene.spindle.place(spec.point)
    if scene.loaded:
        unit = Across(((place, UNIT),), (0.0, 0.0))
        acting = across(scene.spindle, scene.conditions)
        return loaded_rotor(scene.rotor, speeds, unit, force, acting)
    return plane_rotor(scene.rotor, speeds, place, force)


def _outcome(scene: Scene, variants: Variants) -> tuple[str, ...]:
    """Per speed: why the machine, or else the first variant that fails, has no solution."""
    outcome = list(scene.outcome)
    for place, row in enumerate(scene.usable):
        if scene.statically_unstable[place]:
            outcome[row] = FALLS
        rpm = scene.speed[row] * RPM.factor
        for name, variant in variants.items():
            if variant.outcome[place] and not outcome[row]:
                outcome[row] = f"{name} at {rpm:.0f} rpm: {variant.outcome[place]}"
    return tuple(outcome)


def _nonlinear(
    state: PreloadState, rotor: StaticRotor, rows: Indices, force: Array, outcome: Words
) -> RadialCurve:
    """The full bearing model at every load, at rows without an ``outcome``; equal rows are solved
    once."""
    distinct, first, place = np.unique(rows, return_index=True, return_inverse=True)
    problem = Balance.at(state, rotor, distinct)
    unloaded = problem.first_point(state, distinct)
    return radial_curve(problem, unloaded, force, outcome[first]).at(place)


def _short_stop(scene: Scene, spec: StiffnessSpec, force: Array, nonlinear: RadialCurve) -> Variant:
    """The nonlinear variant with other stop travels, solved only at speeds at which they matter:
    with all of them, mfw2310 takes 1.08 times as long."""
    rows = scene.bearing_row[scene.usable]
    deflection, tangent = nonlinear.deflection.copy(), nonlinear.tangent.copy()
    outcome = nonlinear.outcome.astype(object)
    affected = _where_travels_matter(scene, spec, nonlinear)
    if affected.size:
        state = with_friction(scene.preload.with_travels(spec.second_stop, rows[affected]))
        speeds = scene.state_speed[rows[affected]]
        rotor = _rotor(scene, spec, state.seat_load(), speeds)
        outcomes = np.where(scene.statically_unstable[affected], FALLS, "")
        curve = _nonlinear(state, rotor, np.arange(affected.size), force, outcomes)
        outcomes = np.array(state.outcome, dtype=object)
        buckled = scene.buckled(state.seat_load(), state.seat_stiffness(), speeds)
        outcomes = np.where(outcomes == "", np.array(buckled, dtype=object), outcomes)
        solved = outcomes == ""
        deflection[affected] = np.where(solved[:, None], curve.deflection, np.nan)
        tangent[affected] = np.where(solved, curve.tangent, np.nan)
        outcome[affected] = np.where(solved, curve.outcome, outcomes)
    return Variant(deflection, tangent, outcome.astype(str))


def _where_travels_matter(scene: Scene, spec: StiffnessSpec, nonlinear: RadialCurve) -> Indices:
    """Usable speeds at which a sleeve reaches the nearer of its two stops, or the curve ends."""
    matters = np.zeros(len(nonlinear.outcome), dtype=bool)
    for body, sleeve in enumerate(scene.spindle.sleeves, start=SHAFT + 1):
        travel = spec.second_stop.get(sleeve.name, sleeve.stop_travel)
        if travel != sleeve.stop_travel:
            nearer = min(travel, sleeve.stop_travel)
            matters |= ~(nonlinear.reach[:, body] < nearer - REACHED) | (nonlinear.outcome != "")
    return np.flatnonzero(matters)


def _linear(
    scene: Scene, spec: StiffnessSpec, rotor: StaticRotor, name: str, force: Array
) -> Variant:
    """A variant with constant bearing tangents."""
    rows = scene.bearing_row[scene.usable]
    outcome = np.full(len(scene.preload.speed), "", dtype=object)
    if name == "constant_preload":
        rest = scene.preload.rest_loads()
        stiffness, outcome = _constant_preload(scene, rest)
        load = rest[None, scene.preload.network.arrangement.bearing_of_seat]
        rotor = _rotor(scene, spec, load)
        load = np.repeat(load, len(outcome), axis=0)
        buckled = scene.buckled(load, stiffness, scene.state_speed)
        outcome = np.where(outcome == "", np.array(buckled, dtype=object), outcome)
    else:
        stiffness = scene.tangents
    block = _plane_blocks(scene, stiffness[rows])
    if name == "diagonal":
        block = block * np.eye(2)
    flexibility = _flexibility(rotor.at(rows), block)
    return Variant(flexibility[:, None] * force, 1.0 / flexibility, outcome[rows].astype(str))


def _constant_preload(scene: Scene, rest: Array) -> tuple[Array, NDArray[np.object_]]:
    """Bearing tangents at speed under the axial loads that the bearings carry at ``rest``, and an
    outcome per bearing speed."""
    from bearings.ring.tangents import stiffness as tangent_of

    state, bearings = scene.preload, scene.preload.network.arrangement.bearings
    blocks = np.empty((len(state.speed), len(scene.spindle.seats), 5, 5))
    outcome = np.full(len(state.speed), "", dtype=object)
    names = [", ".join(scene.spindle.seats[seat].name for seat in b.seats) for b in bearings]
    carried = np.where(state.network.both_ways, np.abs(rest), rest)
    carries = carried > LEAST_LOAD * float(np.nanmax(np.abs(rest), initial=0.0))
    for k in np.flatnonzero(~carries):
        blocks[:, list(bearings[k].seats)] = np.nan
        outcome[outcome == ""] = (
            f"bearing {names[k]} carries no load at rest: raise the preload or lower the axial "
            "force"
        )
    carrying = [int(k) for k in np.flatnonzero(carries)]
    for batch in state.under_rest_loads(carrying):
        tangents = tangent_of(batch.state, scene.conditions.tangent)
        for column, place in enumerate(batch.places):
            k = carrying[place]
            blocks[:, list(bearings[k].seats)] = tangents[:, column, None]
            failed = (batch.state.outcome[:, column] != "") & (outcome == "")
            outcome[failed] = (
                f"bearing {names[k]} has no equilibrium under its load at rest: raise the preload "
                "or lower the speed"
            )
    return blocks, outcome


def _plane_blocks(scene: Scene, stiffness: Array) -> Array:
    """Blocks (…, seats, 2, 2) over (y, θz) of the spindle from tangents in bearing frames."""
    thrust = np.array([float(seat.thrust) for seat in scene.spindle.seats])
    sign = np.stack([np.ones_like(thrust), thrust], axis=1)  # z is opposite at thrust −x
    block = stiffness[..., PLANE[1:], :][..., PLANE[1:]]
    return block * sign[:, :, None] * sign[:, None, :]


def _flexibility(rotor: StaticRotor, block: Array) -> Array:
    """Deflection of the point per unit force (speeds,) [m/N]."""
    bearings = np.einsum("kip,skij,kjq->spq", rotor.seats, block, rotor.seats, optimize=True)
    load = np.broadcast_to(rotor.point[:, None], (len(block), len(rotor.point), 1))
    displacement = np.linalg.solve(rotor.stiffness + bearings, load)
    return np.asarray((rotor.point @ displacement)[:, 0])
