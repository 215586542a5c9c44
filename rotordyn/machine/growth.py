"""How rings and shaft deform with speed, as the designer states it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rotordyn.description import Description
from rotordyn.quantity import Diameter, Growth, Interference, Name, Station, TopSpeed


@dataclass(frozen=True, slots=True)
class QuadraticInSpeed(Description):
    """A displacement that grows with the square of speed: ``value`` [m] at ``speed`` [rad/s]."""

    value: Growth
    speed: TopSpeed


@dataclass(frozen=True, slots=True)
class InterferenceFit(Description):
    """The centrifugal part is computed from shaft section and inner ring (theory: rings).

    ``bore_diameter`` [m] of the inner ring; ``interference`` [m], on the radius, at rest.
    """

    bore_diameter: Diameter
    interference: Interference


@dataclass(frozen=True, slots=True)
class RingGrowth(Description):
    """Radial growth of the inner groove centre against the outer one.

    ``static`` [m] acts at every speed; ``centrifugal`` adds to it with speed.
    """

    static: Growth = 0.0
    centrifugal: QuadraticInSpeed | InterferenceFit | None = None


@dataclass(frozen=True, slots=True)
class PrescribedShortening(Description):
    """Axial shift of each named bearing seat [m] at ``speed`` [rad/s], growing with speed²."""

    speed: TopSpeed
    shift: Mapping[Name, Growth] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ComputedShortening(Description):
    """Axial shift of every seat from the sections (Poisson contraction), zero at ``reference``."""

    reference: Station
