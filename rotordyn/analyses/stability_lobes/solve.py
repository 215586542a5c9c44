"""Solver of stability lobes: stable depth of cut, with the receptance at every speed."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from rotordyn.analyses.on_measured import OnMeasured
from rotordyn.analyses.stability_lobes.bands import band
from rotordyn.analyses.stability_lobes.converged import ALLOWED, converged
from rotordyn.analyses.stability_lobes.flips import flips
from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.measured_tip import MeasuredTip
from rotordyn.analyses.stability_lobes.modal import of_workpiece
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.planned_cut import planned_cut
from rotordyn.analyses.stability_lobes.pockets import pockets
from rotordyn.analyses.stability_lobes.result import StabilityLobesResult
from rotordyn.analyses.stability_lobes.spec import NONE, StabilityLobesSpec
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.equation.fineness import FINER
from rotordyn.errors import InvalidInput
from rotordyn.scene.scene import Scene

Rows = Indices


def solve(scene: Scene, spec: StabilityLobesSpec) -> StabilityLobesResult:
    """Return limits at every speed, with the machine in its state there, and with that at rest.

    Raises
    ------
    InvalidInput : a mode without damping; no mode within the frequencies
    NoSolution : the machine has no solution at any of the speeds
    """
    spec = replace(spec, diameter=spec.across(scene.spindle))
    speeds = np.array(spec.speeds) if spec.speeds else scene.speed[scene.speed > 0.0]
    running = scene.at(speeds) if spec.speeds else scene
    rows = np.flatnonzero(running.speed[running.usable] > 0.0)
    if not rows.size:
        raise InvalidInput("stability_lobes: no speed above 0 has a solution")
    usable = running.speed[running.usable[rows]]
    outcomes = dict(zip(running.speed.tolist(), running.outcome, strict=True))
    operations = [Operation(spec, *pair) for pair in spec.pairs]

    def limits_of(one: Scene, rows: Rows) -> Limits:
        return Limits(_tip(one, spec), rows, one.speed[one.usable[rows]], scene.clock.progress)

    modelled = partial(_modelled, spec)
    running, limits, by_operation, error = converged(running, modelled, limits_of, operations)
    nominal = by_operation[0]
    limits_of_band = band(limits, operations, by_operation, spec.interval)
    tip_at_rest = _tip(running.at(np.zeros(1)), spec)
    at_rest = Limits(tip_at_rest, np.zeros_like(rows), usable, scene.clock.progress).of(
        operations[0]
    )
    even = np.full(len(usable), np.nan)
    if spec.uneven:
        even = _depths(limits.of(replace(operations[0], spec=replace(spec, pitch=()))))
    measured, measured_to, doubt = _on_measured(scene, spec, operations[0], usable, at_rest)
    doubling = flips(limits, operations[0])

    place = np.searchsorted(speeds, usable)
    depth = _spread(place, len(speeds), _depths(nominal))
    chatter = _spread(place, len(speeds), _frequencies(nominal))
    waves = chatter * operations[0].delays(speeds).max(axis=1)
    removal = operations[0].removal(speeds, depth)
    loss = np.full(len(speeds), NONE, dtype=object)
    loss[place] = [limit.kind for limit in nominal]
    poles = np.column_stack([limits.tip.poles, limits.tip.growing])
    nearest = [_nearest(poles[r], o.frequency) for r, o in zip(rows, nominal, strict=True)]
    modes = _spread(place, len(speeds), np.array(nearest))
    deepest = pockets(speeds, depth)
    by_motor = np.full(len(speeds), np.nan)
    if (motor := scene.spindle.motor) is not None:
        needed = operations[0].torque()
        available = np.array([motor.torque_at(speed) for speed in speeds.tolist()])
        by_motor[:] = available / needed if needed > 0.0 else math.inf
    of_file = () if spec.workpiece is None else spec.pairs
    coefficients = np.reshape(np.array(of_file, dtype=float), (len(of_file), 2))
    return StabilityLobesResult(
        speed=scene.speed,
        outcome=scene.outcome,
        cutting_speed=speeds,
        cutting_outcome=tuple(outcomes[speed] for speed in speeds.tolist()),
        depth=depth,
        chatter=chatter,
        loss=tuple(loss.tolist()),
        mode_frequency=modes[:, 0],
        mode_damping=modes[:, 1],
        flip_depth=_spread(place, len(speeds), doubling.depth),
        flip_speed=_spread(place, len(speeds), doubling.speed),
        removal=removal,
        motor="" if motor is None else motor.words,
        motor_depth=by_motor,
        motor_removal=operations[0].removal(speeds, np.minimum(depth, by_motor)),
        at_rest=_spread(place, len(speeds), _depths(at_rest)),
        even=_spread(place, len(speeds), even),
        waves=waves,
        measured=_spread(place, len(speeds), _depths(measured)),
        measured_chatter=_spread(place, len(speeds), _frequencies(measured)),
        measured_to=measured_to,
        measured_doubt=doubt,
        least=_spread(place, len(speeds), limits_of_band[0]),
        most=_spread(place, len(speeds), limits_of_band[1]),
        workpiece_mode=np.arange(1, len(spec.workpiece_modes) + 1),
        workpiece_frequency=of_workpiece(spec.workpiece_modes).pole.imag / (2.0 * math.pi),
        workpiece="" if spec.workpiece is None else spec.workpiece.name,
        source=np.arange(1, len(of_file) + 1),
        tangential=coefficients[:, 0],
        radial=coefficients[:, 1],
        pocket=np.arange(1, len(deepest.place) + 1),
        pocket_speed=speeds[deepest.place],
        pocket_depth=depth[deepest.place],
        pocket_removal=removal[deepest.place],
        pocket_from=deepest.low,
        pocket_to=deepest.high,
        **planned_cut(limits, operations[0], _depths(nominal), speeds, place),
        modelled=_modelled(spec, running),
        error=error,
        error_asked=ALLOWED,
    )


def _tip(scene: Scene, spec: StabilityLobesSpec) -> Tip:
    workpiece = of_workpiece(spec.workpiece_modes)
    return Tip(scene, spec.point, _feed(spec), _modelled(spec, scene), workpiece)


def _modelled(spec: StabilityLobesSpec, scene: Scene) -> float:
    """Return the frequency up to which modes of the machine take part [Hz]."""
    return float(spec.max_frequency * FINER**scene.finer)


def _feed(spec: StabilityLobesSpec) -> float:
    return spec.turning.direction if spec.turning else spec.feed


def _on_measured(
    scene: Scene,
    spec: StabilityLobesSpec,
    operation: Operation,
    speed: Array,
    at_rest: list[Limit],
) -> tuple[list[Limit], float, str]:
    """Return limits of the tool on the measured spindle, its last frequency [Hz], and what makes
    its tip doubtful; NaN without a measurement."""
    if spec.measured_spindle is None:
        return [Limit(math.nan, math.nan, NONE)] * len(speed), math.nan, ""
    machine = OnMeasured(spec.measured_spindle, scene.spindle)
    rows = np.zeros(len(speed), dtype=np.intp)
    tip = MeasuredTip(machine, _feed(spec), of_workpiece(spec.workpiece_modes))
    doubts = ((plane, machine.doubt(plane)) for plane in machine.fits)
    doubt = "; ".join(f"in {plane} {sentence}" for plane, sentence in doubts if sentence)
    try:
        limits = Limits(tip, rows, speed, scene.clock.progress).of(operation)
    except InvalidInput as error:
        if not doubt:
            raise
        raise InvalidInput(f"{error}; {doubt}") from None
    last = float(machine.omega[-1]) / (2.0 * math.pi)
    return [*map(partial(_bounded, last), limits, at_rest)], last, doubt


def _bounded(last: float, measured: Limit, at_rest: Limit) -> Limit:
    """Return the limit on the measured spindle, or the lower one of the machine as computed where
    that chatters above the ``last`` measured frequency [Hz]: only the model has modes there."""
    beyond = at_rest.frequency > last and at_rest.depth < measured.depth
    return at_rest if beyond else measured


def _depths(limits: list[Limit]) -> Array:
    return np.array([limit.depth for limit in limits])


def _frequencies(limits: list[Limit]) -> Array:
    return np.array([limit.frequency for limit in limits])


def _spread(place: Rows, count: int, values: Array) -> Array:
    """Spread values at usable speeds over all speeds, NaN elsewhere."""
    spread = np.full((count, *values.shape[1:]), np.nan)
    spread[place] = values
    return spread


def _nearest(pole: Complex, hertz: float) -> tuple[float, float]:
    """Return frequency [Hz] and damping ratio of the mode nearest to a chatter frequency."""
    finite = pole[np.isfinite(pole) & (pole != 0.0)]
    if not math.isfinite(hertz) or not finite.size:
        return math.nan, math.nan
    nearest = finite[np.abs(finite.imag - 2.0 * math.pi * hertz).argmin()]
    return float(nearest.imag) / (2.0 * math.pi), float(-nearest.real / abs(nearest))
