"""The kinds of ball bearing, each a file of its own; nothing outside this folder names one.

``KINDS`` maps the name of a kind in files to its class. A new kind is a new file here and
its line below (the contract it fulfils: ``bearings.bearing``).
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
    """Return the class of a kind by its name in ``KINDS``; raises KeyError for another name."""
    name = KINDS[kind]
    cls: type[BallBearing] = getattr(importlib.import_module(f"bearings.kinds.{kind}"), name)
    return cls


def kind_of(bearing: BallBearing) -> str:
    """Return the name of the kind of a bearing in ``KINDS``."""
    names = [base.__name__ for base in type(bearing).__mro__]
    return next(kind for kind, class_name in KINDS.items() if class_name in names)
