"""How rings and shaft deform with speed, as the designer states it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description, Faults
from rotordyn.quantity import (
    Choice,
    Diameter,
    Growth,
    Interference,
    Key,
    Name,
    Station,
    TopSpeed,
)

COMPUTED = "computed"
Computed = Annotated[str, Choice((COMPUTED,))]


@dataclass(frozen=True, slots=True)
class QuadraticInSpeed(Description):
    """A displacement [m] at a speed [rad/s], growing with speed²."""

    value: Annotated[Growth, "growth at the speed `at`"]
    speed: Annotated[TopSpeed, Key("at"), "speed; the value grows with speed squared"]


@dataclass(frozen=True, slots=True)
class InterferenceFit(Description):
    """The fit of inner ring and shaft [m], from which centrifugal growth is computed."""

    bore_diameter: Annotated[
        Diameter,
        Key(missing="the model of this bearing gives no bore_diameter; give it here"),
        "bore of the inner ring; in files by default that of the bearing model",
    ]
    interference: Annotated[Interference, "radial interference at rest"]


@dataclass(frozen=True, slots=True)
class RingGrowth(Description):
    """Radial growth of the inner groove centre against the outer one [m].

    ``fit`` serves where the centrifugal growth is ``"computed"`` (theory: rings).
    """

    static: Annotated[Growth, "growth at rest, included at every speed"] = 0.0
    centrifugal: Annotated[QuadraticInSpeed | Computed | None, "growth added at speed"] = None
    fit: Annotated[
        InterferenceFit | None, "fit of ring and shaft, needed where growth is `computed`"
    ] = None

    def _faults(self) -> Faults:
        if self.centrifugal == COMPUTED and self.fit is None:
            yield (
                ("fit",),
                "missing key: a computed growth needs fit: {interference: …, on the radius}",
            )

    @property
    def fitted(self) -> InterferenceFit | None:
        """The fit from which centrifugal growth is computed; None where it is not."""
        return self.fit if self.centrifugal == COMPUTED else None


@dataclass(frozen=True, slots=True)
class PrescribedShortening(Description):
    """Axial shift of bearing seats, given at a speed."""

    speed: Annotated[
        TopSpeed,
        Key("at", missing="the speed of these shifts"),
        "speed of the given shifts, which grow with speed squared",
    ]
    shift: Annotated[Mapping[Name, Growth], Key(required=True), "bearing -> shift towards +x"] = (
        field(default_factory=dict)
    )


@dataclass(frozen=True, slots=True)
class ComputedShortening(Description):
    """Axial shift of every seat computed from the sections (Poisson contraction)."""

    reference: Annotated[
        Station, Key(missing="the station that does not shift"), "station that does not shift"
    ]
    shift: Annotated[Computed, Key(required=True), "axial shift, computed from the sections"] = (
        COMPUTED
    )
