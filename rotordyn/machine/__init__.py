"""What the machine is: frozen descriptions in SI units, no matrices, no files."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn.machine.ball_guide import BallGuide
    from rotordyn.machine.bearing_set import BearingSet, SetPreload
    from rotordyn.machine.damping import RayleighDamping
    from rotordyn.machine.drawbar import Drawbar
    from rotordyn.machine.fits import Fits
    from rotordyn.machine.growth import (
        ComputedShortening,
        InterferenceFit,
        PrescribedShortening,
        QuadraticInSpeed,
        RingGrowth,
    )
    from rotordyn.machine.housing import ReducedHousing, RigidHousing
    from rotordyn.machine.joint import Joint
    from rotordyn.machine.lumped import Disc, PointMass
    from rotordyn.machine.misalignment import Misalignment
    from rotordyn.machine.reference import Reference
    from rotordyn.machine.rotor import Rotor
    from rotordyn.machine.seat import BearingSeat
    from rotordyn.machine.shaft import Section, Shaft
    from rotordyn.machine.sleeve import Sleeve, Spring
    from rotordyn.machine.spindle import Spindle
    from rotordyn.machine.squeeze_film import SqueezeFilmDamper
    from rotordyn.machine.support import LinearSupport
    from rotordyn.machine.temperatures import BearingTemperatures, Temperatures
    from rotordyn.machine.tool import Tool

_MODULE_OF = {
    "BallGuide": "ball_guide",
    "BearingSeat": "seat",
    "BearingSet": "bearing_set",
    "BearingTemperatures": "temperatures",
    "ComputedShortening": "growth",
    "Disc": "lumped",
    "Drawbar": "drawbar",
    "Fits": "fits",
    "InterferenceFit": "growth",
    "Joint": "joint",
    "LinearSupport": "support",
    "Misalignment": "misalignment",
    "PointMass": "lumped",
    "PrescribedShortening": "growth",
    "QuadraticInSpeed": "growth",
    "RayleighDamping": "damping",
    "ReducedHousing": "housing",
    "Reference": "reference",
    "RigidHousing": "housing",
    "RingGrowth": "growth",
    "Rotor": "rotor",
    "Section": "shaft",
    "SetPreload": "bearing_set",
    "Shaft": "shaft",
    "Sleeve": "sleeve",
    "Spindle": "spindle",
    "Spring": "sleeve",
    "SqueezeFilmDamper": "squeeze_film",
    "Temperatures": "temperatures",
    "Tool": "tool",
}
__all__ = [
    "BallGuide",
    "BearingSeat",
    "BearingSet",
    "BearingTemperatures",
    "ComputedShortening",
    "Disc",
    "Drawbar",
    "Fits",
    "InterferenceFit",
    "Joint",
    "LinearSupport",
    "Misalignment",
    "PointMass",
    "PrescribedShortening",
    "QuadraticInSpeed",
    "RayleighDamping",
    "ReducedHousing",
    "Reference",
    "RigidHousing",
    "RingGrowth",
    "Rotor",
    "Section",
    "SetPreload",
    "Shaft",
    "Sleeve",
    "Spindle",
    "Spring",
    "SqueezeFilmDamper",
    "Temperatures",
    "Tool",
]


def __getattr__(name: str) -> Any:
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_MODULE_OF[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
