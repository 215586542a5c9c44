"""Modes of a flexible workpiece at the cut, such as a thin wall."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import Angle, Frequency, Quantity

WallDamping = Annotated[float, Quantity("ratio", above="0 %", at_most="50 %")]
WallStiffness = Annotated[float, Quantity("stiffness", above="1 N/m", at_most="1e6 MN/m")]


@dataclass(frozen=True, slots=True)
class WorkpieceMode(Description):
    """A mode of the workpiece, as measured by a hammer test at the cut."""

    frequency: Annotated[Frequency, "natural frequency"]
    damping: Annotated[WallDamping, "damping ratio"]
    stiffness: Annotated[WallStiffness, "modal stiffness at the cut, in the direction of the mode"]
    direction: Annotated[
        Angle, "direction of its motion, from the feed towards the normal, which is that of a wall"
    ] = 0.5 * math.pi
