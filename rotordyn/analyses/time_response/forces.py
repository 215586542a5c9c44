"""Forces that act over time: their sizes at given instants, and the motions that they push."""

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


def sizes(force: ForceOverTime, time: Array) -> Array:
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


def applied(spec: TimeResponseSpec, speed: Array, time: Array) -> Array:
    """All inputs at speeds of the rotors out of balance (s, unbalances) [rad/s] and instants (t,).

    Shape (s, inputs, t) [N]: every force, then of every unbalance its forces along y and z.
    """
    steady = [np.broadcast_to(sizes(each, time), (len(speed), len(time))) for each in spec.forces]
    for each, omega in zip(spec.unbalances, speed.T, strict=True):
        angle, size = omega[:, None] * time + each.angle, each.unbalance * omega[:, None] ** 2
        steady += [size * np.cos(angle), size * np.sin(angle)]
    return np.stack(steady, axis=1)
