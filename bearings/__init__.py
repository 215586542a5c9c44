"""One rolling bearing: ball loads, displacements and stiffness at speed.

SI units throughout (m, N, rad, rad/s, Pa). Nothing heavy is imported before it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bearings.angular_contact import AngularContactBallBearing
    from bearings.errors import BearingError, InvalidBearing, NoEquilibrium
    from bearings.follower import Followed, Follower
    from bearings.law import Law
    from bearings.materials import SILICON_NITRIDE, STEEL, Material

_HOME = {
    "AngularContactBallBearing": "bearings.angular_contact",
    "BearingError": "bearings.errors",
    "Followed": "bearings.follower",
    "Follower": "bearings.follower",
    "InvalidBearing": "bearings.errors",
    "Law": "bearings.law",
    "Material": "bearings.materials",
    "NoEquilibrium": "bearings.errors",
    "SILICON_NITRIDE": "bearings.materials",
    "STEEL": "bearings.materials",
}
__all__ = [
    "SILICON_NITRIDE",
    "STEEL",
    "AngularContactBallBearing",
    "BearingError",
    "Followed",
    "Follower",
    "InvalidBearing",
    "Law",
    "Material",
    "NoEquilibrium",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'bearings' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
