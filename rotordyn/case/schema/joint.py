"""A joint between two parts of the shaft: springs and dampers that turn with it."""

from __future__ import annotations

import math

from rotordyn.case.schema.base import Entry
from rotordyn.case.schema.values import (
    Damping,
    Name,
    Rigidity,
    Station,
    TiltDamping,
    TiltRigidity,
)


class JointDampingEntry(Entry):
    """Dampers of a joint, in directions that have a stiffness."""

    radial: Damping = 0.0
    tilt: TiltDamping = 0.0
    axial: Damping = 0.0
    torsion: TiltDamping = 0.0


class JointEntry(Entry):
    """A joint between two parts of the shaft, by its springs; all that is not given is rigid."""

    name: Name
    x: Station
    radial: Rigidity = math.inf
    tilt: TiltRigidity = math.inf
    axial: Rigidity = math.inf
    torsion: TiltRigidity = math.inf
    damping: JointDampingEntry = JointDampingEntry()
