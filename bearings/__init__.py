"""One rolling bearing: ball loads, displacements and stiffness at speed.

SI units throughout (m, N, rad, rad/s, Pa). Nothing heavy is imported before it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from bearings.kinds import KINDS

if TYPE_CHECKING:
    from bearings import film as film
    from bearings import fits as fits
    from bearings import heat as heat
    from bearings import life as life
    from bearings import on_film as on_film
    from bearings.ball.law import Law as Law
    from bearings.ball_guide import LinearBallGuide as LinearBallGuide
    from bearings.bearing import BallBearing as BallBearing
    from bearings.catalogue.estimate import EstimatedBearing as EstimatedBearing
    from bearings.catalogue.estimate import estimate as estimate
    from bearings.catalogue.printed import Catalogue as Catalogue
    from bearings.errors import BearingError as BearingError
    from bearings.errors import InvalidBearing as InvalidBearing
    from bearings.errors import NoEquilibrium as NoEquilibrium
    from bearings.flexible_rings.describe import ElasticRing as ElasticRing
    from bearings.flexible_rings.describe import FlexibleRings as FlexibleRings
    from bearings.flexible_rings.describe import Neighbour as Neighbour
    from bearings.follower import Followed as Followed
    from bearings.follower import Follower as Follower
    from bearings.kinds import *  # noqa: F403 - adding a kind touches that folder alone
    from bearings.lubricant import Lubricant as Lubricant
    from bearings.materials import SILICON_NITRIDE as SILICON_NITRIDE
    from bearings.materials import STEEL as STEEL
    from bearings.materials import Material as Material
    from bearings.ring.condition import condition as condition
    from bearings.ring.deflection import RingDeflection as RingDeflection
    from bearings.ring.deflection import ring_deflection as ring_deflection
    from bearings.ring.state import BearingState as BearingState
    from bearings.ring.tangents import stiffness as stiffness
    from bearings.ring.truncation import Truncation as Truncation
    from bearings.ring.truncation import truncation as truncation

_NAMES = {
    "ball.law": ("Law",),
    "ball_guide": ("LinearBallGuide",),
    "bearing": ("BallBearing",),
    "catalogue.estimate": ("EstimatedBearing", "estimate"),
    "catalogue.printed": ("Catalogue",),
    "errors": ("BearingError", "InvalidBearing", "NoEquilibrium"),
    "flexible_rings.describe": ("ElasticRing", "FlexibleRings", "Neighbour"),
    "follower": ("Followed", "Follower"),
    "lubricant": ("Lubricant",),
    "materials": ("SILICON_NITRIDE", "STEEL", "Material"),
    "ring.condition": ("condition",),
    "ring.deflection": ("RingDeflection", "ring_deflection"),
    "ring.state": ("BearingState",),
    "ring.tangents": ("stiffness",),
    "ring.truncation": ("Truncation", "truncation"),
    **{f"kinds.{kind}": (name,) for kind, name in KINDS.items()},
}
_MODULES = ("film", "fits", "heat", "life", "on_film")  # whole
_HOME = {name: f"bearings.{module}" for module, names in _NAMES.items() for name in names}
__all__ = sorted((*_HOME, *_MODULES))  # noqa: PLE0605 - the kinds are listed once, in their folder


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module(f"bearings.{name}")
    if name not in _HOME:
        raise AttributeError(f"module 'bearings' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return list(__all__)
