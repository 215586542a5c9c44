"""Static loads of the conditions across the axis, and their places."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import count

import numpy as np

from rotordyn.equation.statics import Across
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions


def with_stations(spindle: Spindle, places: Iterable[str | float]) -> Spindle:
    """Add a named point at every station [m] among ``places`` that has none, so that nodes and
    static results are there."""
    free_names = (name for k in count(1) if (name := f"station {k}") not in spindle.points)
    unnamed = {at for at in places if not isinstance(at, str)} - set(spindle.points.values())
    points = {next(free_names): x for x in sorted(unnamed)}
    return replace(spindle, points={**spindle.points, **points}) if points else spindle


def across(spindle: Spindle, conditions: Conditions) -> Across:
    """Return the loads across the axis under the conditions."""
    loads = [(spindle.place(load.at), np.array(load.on_axis)) for load in conditions.loads]
    return Across(tuple(loads), conditions.pull[1:])
