"""One rolling bearing: ball loads, displacements and stiffness at speed.

SI units throughout (m, N, rad, rad/s, Pa). Nothing heavy is imported before it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from bearings.kinds import KINDS

if TYPE_CHECKING:
    from bearings.ball.law import Law
    from bearings.bearing import BallBearing
    from bearings.errors import BearingError, InvalidBearing, NoEquilibrium
    from bearings.follower import Followed, Follower
    from bearings.kinds import *  # noqa: F403 - adding a kind touches that folder alone
    from bearings.materials import SILICON_NITRIDE, STEEL, Material
    from bearings.ring.condition import condition
    from bearings.ring.state import BearingState
    from bearings.ring.tangents import stiffness
    from bearings.ring.truncation import Truncation, truncation

_HOME = {
    "BallBearing": "bearings.bearing",
    "BearingError": "bearings.errors",
    "BearingState": "bearings.ring.state",
    "condition": "bearings.ring.condition",
    "stiffness": "bearings.ring.tangents",
    "Followed": "bearings.follower",
    "Follower": "bearings.follower",
    "InvalidBearing": "bearings.errors",
    "Law": "bearings.ball.law",
    "Material": "bearings.materials",
    "NoEquilibrium": "bearings.errors",
    "SILICON_NITRIDE": "bearings.materials",
    "STEEL": "bearings.materials",
    "Truncation": "bearings.ring.truncation",
    "truncation": "bearings.ring.truncation",
    **{name: f"bearings.kinds.{kind}" for kind, name in KINDS.items()},
}
__all__ = [  # noqa: PLE0604 - the kinds are listed once, in their folder
    "SILICON_NITRIDE",
    "STEEL",
    "BallBearing",
    "BearingError",
    "BearingState",
    "Followed",
    "Follower",
    "InvalidBearing",
    "Law",
    "Material",
    "NoEquilibrium",
    "Truncation",
    "condition",
    "stiffness",
    "truncation",
    *KINDS.values(),
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'bearings' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
