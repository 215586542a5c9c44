"""How rings and shaft deform with speed, as the designer states it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class QuadraticInSpeed:
    """A displacement that grows with the square of speed: ``value`` [m] at ``speed`` [rad/s]."""

    value: float
    speed: float


@dataclass(frozen=True, slots=True)
class InterferenceFit:
    """The centrifugal part is computed from shaft section and inner ring (physics: rings).

    ``bore_diameter`` [m] of the inner ring; ``interference`` [m], on the radius, at rest.
    """

    bore_diameter: float
    interference: float


@dataclass(frozen=True, slots=True)
class RingGrowth:
    """Radial growth of the inner groove centre against the outer one.

    ``static`` [m] acts at every speed; ``centrifugal`` adds to it with speed.
    """

    static: float = 0.0
    centrifugal: QuadraticInSpeed | InterferenceFit | None = None


@dataclass(frozen=True, slots=True)
class PrescribedShortening:
    """Axial shift of each named bearing seat [m] at ``speed`` [rad/s], growing with speed²."""

    speed: float
    shift: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ComputedShortening:
    """Axial shift of every seat from the sections (Poisson contraction), zero at ``reference``."""

    reference: float
