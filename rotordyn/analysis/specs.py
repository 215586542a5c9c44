"""What a case asks: one frozen Spec per analysis, and the conditions all of them share (SI)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rotordyn.analysis.formulation import INERTIAL

VARIANTS = ("nonlinear", "full", "diagonal", "constant_preload")
TANGENTS = ("complete", "frozen", "difference")
DIRECTIONS = ("x", "y", "z", "thx", "thy", "thz")


@dataclass(frozen=True, slots=True)
class Conditions:
    """How the machine is modelled.

    ``kinematics``, ``moment_sharing``: as in ``bearings``. ``tangent``: of ``TANGENTS``, the
    stiffness of the bearings of a spindle wherever they act as linear springs. ``bearings``:
    ``"dynamic"`` (speed acts on the bearings) or ``"static"`` (their state at rest serves every
    speed). ``rotor``: ``"flexible"`` or ``"rigid"``. ``axial_force`` [N] on the front end of the
    shaft (of the tool) towards +x; ``gravity``: ``""``, ``"+x"`` or ``"-x"`` for a vertical
    spindle. ``element_length`` [m]: longest element; None = chosen from the shaft.
    ``formulation``: of ``formulation.FORMULATIONS``, how bending is written.
    ``axial_stiffening``: the axial force in the shaft acts on its bending.
    """

    kinematics: str = "hybrid"
    moment_sharing: str = "equal"
    tangent: str = "complete"
    bearings: str = "dynamic"
    rotor: str = "flexible"
    axial_force: float = 0.0
    gravity: str = ""
    element_length: float | None = None
    formulation: str = INERTIAL
    axial_stiffening: bool = True


@dataclass(frozen=True, slots=True)
class PreloadSpec:
    """The dynamic preload state at every speed of the case."""


@dataclass(frozen=True, slots=True)
class CampbellSpec:
    """Damped eigenfrequencies up to ``max_frequency`` [Hz] over speed.

    ``teeth``: numbers of cutter teeth whose tooth-passing line is of interest; ``shapes``: keep the
    mode shapes at the first and the last speed.
    """

    max_frequency: float = 4000.0
    teeth: tuple[int, ...] = ()
    shapes: bool = True


@dataclass(frozen=True, slots=True)
class Port:
    """A point of the machine and one of its directions."""

    point: str
    direction: str

    def __str__(self) -> str:
        return f"{self.point}.{self.direction}"


@dataclass(frozen=True, slots=True)
class FrfSpec:
    """Receptance between ``pairs`` (response, excitation) at every speed and frequency [Hz].

    ``slices``: speeds [rad/s] at which curves are drawn and UFF58 records written (nearest speed
    of the case); none given = the lowest and the highest.
    """

    frequencies: tuple[float, ...]
    pairs: tuple[tuple[Port, Port], ...]
    slices: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class StiffnessSpec:
    """Quasi-static radial stiffness at ``point``: deflection under 0 … ``max_force`` [N].

    ``steps``: load steps; ``variants``: of ``VARIANTS``; ``second_stop``: other stop travels [m] by
    sleeve, computed as one more (nonlinear) variant when given.
    """

    point: str
    max_force: float = 500.0
    steps: int = 10
    variants: tuple[str, ...] = VARIANTS
    second_stop: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class BearingMapSpec:
    """A single bearing under axial ``loads`` [N] at every speed of the case.

    ``tangents``: of ``TANGENTS``, the stiffness matrices to compute.
    """

    loads: tuple[float, ...]
    static_growth: float = 0.0
    tangents: tuple[str, ...] = TANGENTS[:1]


Spec = PreloadSpec | CampbellSpec | FrfSpec | StiffnessSpec | BearingMapSpec
