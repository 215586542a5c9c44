"""The equation of motion by its matrices."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Complex, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import response_unit

SQUARE = ("speed", "row", "column")
MODAL = "of coordinates with mass 1: those of a displacement in m are m √kg"


@dataclass(frozen=True)
class MatricesResult:
    """q̈ + C q̇ + K q = Lᵀ f, u = L q at every speed: forces f and motions u at the ports, mass 1.

    ``stiffness`` K and ``damping`` C are those of the fixed frame and need not be symmetric;
    ``damping`` includes Ω times ``gyroscopic``. ``motion`` L. ``receptance``: of every port to a
    force at itself, by these matrices, at the first and the last speed with a state.
    ``frequency_error``: relative, of the poles up to ``max_frequency``; ``receptance_error``: over
    the largest one, of receptances between the ports with a damping ratio of 5 % more.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    row: Array = coordinate("row", unit="1", label="coordinate of the row")
    column: Array = coordinate("column", unit="1", label="coordinate")
    port: Words = coordinate("port", unit="", label="port")
    shown_speed: Array = coordinate("shown_speed", unit="rad/s", label="speed")
    frequency: Array = coordinate("frequency", unit="Hz", label="frequency")
    outcome: Words = quantity("speed", unit="", label="outcome")
    stiffness: Array = quantity(*SQUARE, unit="s⁻²", label="stiffness", comment=MODAL)
    damping: Array = quantity(*SQUARE, unit="s⁻¹", label="damping", comment=MODAL)
    gyroscopic: Array = quantity(
        "row", "column", unit="1", label="gyroscopic effect per speed", comment=MODAL
    )
    motion: Array = quantity(
        "port",
        "column",
        unit="",
        label="motion of the port per unit of the coordinate [1/√kg, rad/(m √kg)]",
    )
    receptance: Complex = quantity(
        "shown_speed",
        "port",
        "frequency",
        unit="m/N, rad/N, rad/(N·m)",
        label="receptance",
        absent=(Absence("at an undamped pole", by=("shown_speed", "frequency")),),
    )
    max_frequency: float = quantity(unit="Hz", label="highest frequency asked for")
    frequency_error: float = quantity(
        unit="1",
        label="relative error of frequencies",
        absent=(Absence("where none is estimated"),),
    )
    receptance_error: float = quantity(
        unit="1", label="error of receptances", absent=(Absence("where none is estimated"),)
    )
    error_asked: float = quantity(
        unit="1",
        label="error of receptances asked for",
        infinite=(Absence("where none is asked for"),),
    )

    def unit(self, port: int) -> str:
        """SI unit of the receptance at a port."""
        return response_unit(f"{self.port[port]} / {self.port[port]}")

    def entry_units(self, name: str) -> tuple[str, ...]:
        """SI units of a field along its ports; empty for a field that has one unit."""
        return tuple(map(self.unit, range(len(self.port)))) if name == "receptance" else ()
