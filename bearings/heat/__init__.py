"""Friction and heat of a bearing: order of magnitude, no constant tuned.

Sliding in the contact ellipses from the state itself, Harris' and Palmgren's moment, SKF's model
within its range; temperatures where conductances are given.
"""

from __future__ import annotations

from bearings.heat.ellipse import Sliding, sliding, spin_moment
from bearings.heat.moments import OIL_FACTORS, load_moment, viscous_moment
from bearings.heat.mounted import Mounting, ThermalState, heated, speed_limit
from bearings.heat.skf import SkfMoment, skf_moment
from bearings.heat.temperature import (
    Conductances,
    Surroundings,
    Temperatures,
    balanced,
    thermal_growth,
)
from bearings.heat.total import Losses, losses

__all__ = [
    "OIL_FACTORS",
    "Conductances",
    "Losses",
    "Mounting",
    "SkfMoment",
    "Sliding",
    "Surroundings",
    "Temperatures",
    "ThermalState",
    "balanced",
    "heated",
    "load_moment",
    "losses",
    "skf_moment",
    "sliding",
    "speed_limit",
    "spin_moment",
    "thermal_growth",
    "viscous_moment",
]
