"""The kinds of ball bearing, each a file of its own; nothing outside this folder names one.

``KINDS`` maps the word by which a file calls a kind to its class. A new kind is a new file here and
its line below (the contract it keeps: ``bearings.bearing``).
"""

from __future__ import annotations

import importlib
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bearings.bearing import BallBearing
    from bearings.kinds.angular_contact import (
        AngularContactBallBearing as AngularContactBallBearing,
    )
    from bearings.kinds.deep_groove import DeepGrooveBallBearing as DeepGrooveBallBearing
    from bearings.kinds.four_point import FourPointBallBearing as FourPointBallBearing
    from bearings.kinds.thrust import ThrustBallBearing as ThrustBallBearing

KINDS = {
    "angular_contact": "AngularContactBallBearing",
    "deep_groove": "DeepGrooveBallBearing",
    "four_point": "FourPointBallBearing",
    "thrust": "ThrustBallBearing",
}
DEFAULT = "angular_contact"  # of a file that names no kind


@cache
def kind_class(kind: str) -> type[BallBearing]:
    """The class of a kind by its word in ``KINDS``; raises KeyError for another word."""
    name = KINDS[kind]
    kind_of: type[BallBearing] = getattr(importlib.import_module(f"bearings.kinds.{kind}"), name)
    return kind_of


def kind_of(bearing: BallBearing) -> str:
    """The word for the kind of a bearing."""
    names = [each.__name__ for each in type(bearing).__mro__]
    return next(kind for kind, called in KINDS.items() if called in names)
