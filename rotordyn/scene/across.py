"""Static loads of the conditions across the axis, and where they act."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from rotordyn.equation.statics import Across
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad


def with_stations(spindle: Spindle, loads: Iterable[PointLoad]) -> Spindle:
    """The spindle with a point at every station [m] where a load acts."""
    stations = {
        f"load {k}": load.at for k, load in enumerate(loads, 1) if not isinstance(load.at, str)
    }
    return replace(spindle, points={**spindle.points, **stations}) if stations else spindle


def across(spindle: Spindle, conditions: Conditions) -> Across:
    """What acts across the axis by the conditions."""
    loads = [(spindle.place(load.at), np.array(load.on_axis)) for load in conditions.loads]
    return Across(tuple(loads), conditions.pull[1:])
