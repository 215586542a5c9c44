"""The bearing measured and its states: VEX 70, 25 balls, hybrid kinematics, 24 000 rpm."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from unittest import mock

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.processes import ROOT

Array = NDArray[np.float64]
SPEED = 24000.0 * math.pi / 30.0
VEX70 = rotordyn.load(ROOT / "cases" / "vex70.yaml").bearing
assert VEX70 is not None
LOAD = np.array([1200.0, 0.0, 900.0, 5.0, 0.0])  # Noël (2013), 3.3.1


@contextmanager
def solver(*, compiled: bool) -> Iterator[None]:
    """Every solution within the context, nested ones included, is compiled or is not."""
    with mock.patch("bearings.ring.request.pays", return_value=compiled):
        yield


@dataclass(frozen=True, slots=True)
class States:
    """Loads and the displacements under them (s, 5) and speeds (s,)."""

    load: Array
    displacement: Array
    speed: Array

    @classmethod
    def of_loads(cls, load: Array, speed: Array) -> States:
        """Those with a solution."""
        with solver(compiled=False):
            found = VEX70.equilibrium(load=load, speed=speed)
        kept = found.outcome == ""
        return cls(load[kept], found.displacement[kept], speed[kept])


def random_states(count: int) -> States:
    """Thrust 800 to 4000 N, radial load to a quarter of it, tilting moments to 5 N·m."""
    draw = np.random.default_rng(70)
    thrust = draw.uniform(800.0, 4000.0, count)
    side = draw.uniform(-0.25, 0.25, (count, 2)) * thrust[:, None]
    load = np.column_stack([thrust, side, draw.uniform(-5.0, 5.0, (count, 2))])
    return States.of_loads(load, np.full(count, SPEED))


def sweep_states(count: int) -> States:
    """A radial load of 500 N that turns once while thrust and speed rise by half and a fifth."""
    t = np.linspace(0.0, 1.0, count)
    turned = 500.0 * np.array([np.cos(2.0 * math.pi * t), np.sin(2.0 * math.pi * t)])
    load = np.column_stack([1200.0 * (1.0 + 0.5 * t), *turned, 5.0 * t, 0.0 * t])
    return States.of_loads(load, SPEED / 1.2 * (1.0 + 0.2 * t))
