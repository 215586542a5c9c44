"""Offset and tilt of the bore under an outer ring."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import Growth, SmallAngle


@dataclass(frozen=True, slots=True)
class Misalignment(Description):
    """Offset of the bore under an outer ring from the axis [m], and its tilt [rad]."""

    y: Annotated[Growth, "offset along y"] = 0.0
    z: Annotated[Growth, "offset along z"] = 0.0
    thy: Annotated[SmallAngle, "tilt about y"] = 0.0
    thz: Annotated[SmallAngle, "tilt about z"] = 0.0

    @property
    def offset(self) -> tuple[float, float, float, float]:
        """Offsets along y and z, tilts about y and z [m, rad]."""
        return self.y, self.z, self.thy, self.thz
