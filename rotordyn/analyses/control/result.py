"""Which race controls the balls of a single bearing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import coordinate, quantity


@dataclass(frozen=True)
class ControlResult:
    """Which race controls the balls of a single bearing over axial load and speed, tilts blocked.

    ``boundary``: of the inner race, the load above which it controls; of the outer race, the load
    up to which it does. ``fit``: of F = a ω² + b ω + c. A load or fit that does not exist is NaN
    beside its ``absence``, a margin beside its ``state``.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    load: Array = coordinate("load", unit="N", label="axial load")
    boundary: Words = coordinate("boundary", unit="", label="boundary of control by race")
    term: Words = coordinate("term", unit="", label="term of the fit")
    outcome: Words = quantity("speed", unit="", label="outcome")
    radial: float = quantity(unit="1", label="radial over axial load")
    resting_weight: float = quantity(
        unit="1", label="friction moment, inner over outer race, at equal ball loads"
    )
    boundary_load: Array = quantity("boundary", "speed", unit="N", label="load at the boundary")
    boundary_absence: NDArray[np.str_] = quantity(
        "boundary", "speed", unit="", label="why there is no boundary"
    )
    boundary_pressure: Array = quantity(
        "boundary", "speed", unit="Pa", label="peak pressure at the boundary"
    )
    changes: NDArray[np.int_] = quantity(
        "boundary", "speed", unit="1", label="changes of control over the loads"
    )
    fit: Array = quantity(
        "boundary", "term", unit="N/(rad/s)², N/(rad/s), N", label="quadratic fit over speed"
    )
    fit_misfit: Array = quantity("boundary", unit="N", label="largest misfit of the fit")
    fit_absence: Words = quantity("boundary", unit="", label="why there is no fit")
    state: NDArray[np.str_] = quantity("speed", "load", unit="", label="state")
    inner_margin: Array = quantity(
        "speed", "load", unit="1", label="margin of control by the inner race"
    )
    outer_margin: Array = quantity(
        "speed", "load", unit="1", label="margin of control by the outer race"
    )
