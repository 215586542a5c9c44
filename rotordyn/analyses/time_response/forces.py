"""Forces over time: values at instants, and means over short intervals."""

from __future__ import annotations

import math

import numpy as np

from rotordyn.analyses.time_response.spec import ForceOverTime, TimeResponseSpec
from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.across import with_stations


def marked(spindle: Spindle, spec: TimeResponseSpec) -> Spindle:
    """Return the spindle with a named point at every place of a force, unbalance or result."""
    return with_stations(spindle, spec.places)


def values(force: ForceOverTime, time: Array) -> Array:
    """Return a force [N] at instants ``time`` [s], of the same shape."""
    if force.times:
        return np.interp(time, force.times, force.forces, left=0.0, right=0.0)
    assert force.force is not None, "a force without a table has a size"
    since = time - force.start
    is_active = (since >= 0.0) & (time <= force.end)
    if force.frequency is not None:
        shape = np.sin(2.0 * math.pi * force.frequency * since + force.phase)
    elif force.pulse is not None:
        within = since if force.period is None else np.mod(since, force.period)
        shape = np.where(within <= force.pulse, np.sin(math.pi * within / force.pulse), 0.0)
    else:
        shape = np.ones_like(since)
    return np.where(is_active, force.force * shape, 0.0)


def impulse(force: ForceOverTime, time: Array) -> Array:
    """Return the integral of a force from 0 to ``time`` [N·s], of the same shape."""
    if force.times:
        return _table_impulse(np.array(force.times), np.array(force.forces), time)
    assert force.force is not None, "a force without a table has a size"
    elapsed = np.clip(time, force.start, force.end) - force.start
    if force.frequency is not None:
        omega = 2.0 * math.pi * force.frequency
        shape = (math.cos(force.phase) - np.cos(omega * elapsed + force.phase)) / omega
    elif force.pulse is not None:
        pulses = np.zeros_like(elapsed) if force.period is None else elapsed // force.period
        since_pulse = elapsed if force.period is None else elapsed - pulses * force.period
        phase = math.pi * np.minimum(since_pulse, force.pulse) / force.pulse
        shape = force.pulse / math.pi * (2.0 * pulses + 1.0 - np.cos(phase))
    else:
        shape = elapsed
    return np.asarray(force.force * shape)


def _table_impulse(times: Array, forces: Array, time: Array) -> Array:
    """Return the integral of a force linear between the points of a table, to ``time``."""
    areas = 0.5 * (forces[1:] + forces[:-1]) * np.diff(times)
    total, slope = np.concatenate([[0.0], np.cumsum(areas)]), np.diff(forces) / np.diff(times)
    at = np.clip(time, times[0], times[-1])
    k = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(slope) - 1)
    since = at - times[k]
    return np.asarray(total[k] + forces[k] * since + 0.5 * slope[k] * since**2)


def mean_inputs(spec: TimeResponseSpec, speed: Array, edges: Array) -> Array:
    """Return mean forces at every port of ``spec`` (s, ports, t) [N] between successive ``edges``
    (t + 1,) [s]; ``speed`` (s, unbalances) [rad/s]: of the rotors of the unbalances."""
    width, middle = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    place = {port: k for k, port in enumerate(spec.ports)}
    inputs = np.zeros((len(speed), len(place), len(width)))
    for force in spec.forces:
        inputs[:, place[force.at, force.direction]] += np.diff(impulse(force, edges)) / width
    for unbalance, omega in zip(spec.unbalances, speed.T, strict=True):
        angle, turned = omega[:, None] * middle + unbalance.angle, omega[:, None] * width
        size = unbalance.unbalance * omega[:, None] ** 2 * np.sinc(0.5 * turned / math.pi)
        inputs[:, place[unbalance.at, "y"]] += size * np.cos(angle)
        inputs[:, place[unbalance.at, "z"]] += size * np.sin(angle)
    return inputs
