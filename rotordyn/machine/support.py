"""What holds the shaft: bearing seats, sliding sleeves, linear supports."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from bearings.angular_contact import AngularContactBallBearing
from rotordyn.machine.growth import RingGrowth


@dataclass(frozen=True, slots=True)
class BearingSeat:
    """An angular-contact bearing at station ``x`` [m].

    ``thrust`` is +1 where pushing the shaft towards +x loads the balls, −1 where −x does.
    ``radial_damping`` and ``axial_damping`` [N·s/m] act between its rings; tilt is not damped.
    """

    name: str
    bearing: AngularContactBallBearing
    x: float
    thrust: int
    growth: RingGrowth = field(default_factory=RingGrowth)
    radial_damping: float = 0.0
    axial_damping: float = 0.0
    model: str = ""


@dataclass(frozen=True, slots=True)
class Spring:
    """Preload spring: ``preload`` [N] at rest, ``stiffness`` [N/m]; infinite = rigid preload."""

    preload: float
    stiffness: float = math.inf


@dataclass(frozen=True, slots=True)
class Sleeve:
    """A sliding sleeve that carries the outer rings of ``bearings`` and is pushed by ``spring``.

    The spring pushes the way that loads the bearings. ``stop_travel`` [m]: how far the sleeve can
    move against its spring from its place at rest before it meets the end stop; infinite = no stop.
    ``mass`` [kg] and ``radial_stiffness`` [N/m] (infinite = held rigidly by the housing bore).
    """

    name: str
    bearings: tuple[str, ...]
    spring: Spring
    stop_travel: float = math.inf
    mass: float = 0.0
    radial_stiffness: float = math.inf


@dataclass(frozen=True, slots=True)
class LinearSupport:
    """Constant stiffness and damping to ground at station ``x``.

    ``stiffness`` [N/m, N/rad …] and ``damping`` map a pair of node freedoms, such as
    ``("y", "y")`` or ``("y", "thz")``, to the entry of the 6×6 matrix; freedoms are
    x, y, z, thx, thy, thz. Entries not named are zero; nothing is symmetrised.
    """

    name: str
    x: float
    stiffness: Mapping[tuple[str, str], float]
    damping: Mapping[tuple[str, str], float] = field(default_factory=dict)
