"""Forces over time: at given instants, and as means over short times."""

from __future__ import annotations

import math

import numpy as np

from rotordyn.analyses.time_response.spec import ForceOverTime, TimeResponseSpec
from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.across import with_stations


def marked(spindle: Spindle, spec: TimeResponseSpec) -> Spindle:
    """With a named point wherever something acts."""
    return with_stations(spindle, spec.places)


def values(force: ForceOverTime, time: Array) -> Array:
    """A force [N] at instants ``time`` [s], of the same shape."""
    if force.times:
        return np.interp(time, force.times, force.forces, left=0.0, right=0.0)
    assert force.force is not None, "a force without a table has a size"
    since = time - force.start
    acts = (since >= 0.0) & (time <= force.end)
    if force.frequency is not None:
        shape = np.sin(2.0 * math.pi * force.frequency * since + force.phase)
    elif force.pulse is not None:
        within = since if force.period is None else np.mod(since, force.period)
        shape = np.where(within <= force.pulse, np.sin(math.pi * within / force.pulse), 0.0)
    else:
        shape = np.ones_like(since)
    return np.where(acts, force.force * shape, 0.0)


def impulse(force: ForceOverTime, time: Array) -> Array:
    """Integral of a force from 0 to ``time`` [N·s], of the same shape."""
    if force.times:
        return _of_table(np.array(force.times), np.array(force.forces), time)
    assert force.force is not None, "a force without a table has a size"
    acted = np.clip(time, force.start, force.end) - force.start
    if force.frequency is not None:
        omega = 2.0 * math.pi * force.frequency
        shape = (math.cos(force.phase) - np.cos(omega * acted + force.phase)) / omega
    elif force.pulse is not None:
        whole = np.zeros_like(acted) if force.period is None else acted // force.period
        within = acted if force.period is None else acted - whole * force.period
        phase = math.pi * np.minimum(within, force.pulse) / force.pulse
        shape = force.pulse / math.pi * (2.0 * whole + 1.0 - np.cos(phase))
    else:
        shape = acted
    return np.asarray(force.force * shape)


def _of_table(times: Array, forces: Array, time: Array) -> Array:
    """Of straight lines between points."""
    areas = 0.5 * (forces[1:] + forces[:-1]) * np.diff(times)
    before, slope = np.concatenate([[0.0], np.cumsum(areas)]), np.diff(forces) / np.diff(times)
    at = np.clip(time, times[0], times[-1])
    k = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(slope) - 1)
    since = at - times[k]
    return np.asarray(before[k] + forces[k] * since + 0.5 * slope[k] * since**2)


def mean_inputs(spec: TimeResponseSpec, speed: Array, edges: Array) -> Array:
    """Means between successive ``edges`` (t + 1,) [s] of what acts at every port of ``spec``
    (s, ports, t) [N]; ``speed`` (s, unbalances) [rad/s]: of the rotors of the unbalances."""
    width, middle = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    place = {port: k for k, port in enumerate(spec.ports)}
    inputs = np.zeros((len(speed), len(place), len(width)))
    for force in spec.forces:
        inputs[:, place[force.at, force.direction]] += np.diff(impulse(force, edges)) / width
    for each, omega in zip(spec.unbalances, speed.T, strict=True):
        angle, turned = omega[:, None] * middle + each.angle, omega[:, None] * width
        size = each.unbalance * omega[:, None] ** 2 * np.sinc(0.5 * turned / math.pi)
        inputs[:, place[each.at, "y"]] += size * np.cos(angle)
        inputs[:, place[each.at, "z"]] += size * np.sin(angle)
    return inputs
