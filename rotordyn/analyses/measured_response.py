"""Measured responses of a machine between two of its points, for analyses (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from rotordyn.description import Description, Faults, ascending
from rotordyn.machine.matrix import Dof
from rotordyn.quantity import HIDDEN, Choice, Frequency, Key, Name, PointName, Speed

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

QUANTITIES = ("receptance", "mobility", "inertance")
NO_RESPONSE = "no response: given zero at every frequency; allowed: at least one other value"


@dataclass(frozen=True, slots=True)
class Port(Description):
    """A point of the machine (of a further rotor: ``rotor.point``) and one of its directions."""

    point: PointName
    direction: Dof

    def __str__(self) -> str:
        return f"{self.point}.{self.direction}"


@dataclass(frozen=True, slots=True)
class Pair:
    """Marks a response and what excites it, a ``PortPair`` in files."""


@dataclass(frozen=True, slots=True)
class MeasuredResponse(Description):
    """A measured response, from UFF type 58 or a CSV table."""

    name: Annotated[Name, Key(default=""), "in figures and summary; by default its number"]
    response: Annotated[Port, "point and direction of the motion, as of a pair of the case"]
    excitation: Annotated[Port, "point and direction of the force, as of a pair of the case"]
    frequency: Annotated[tuple[Frequency, ...], HIDDEN]
    real: Annotated[tuple[float, ...], HIDDEN]
    imaginary: Annotated[tuple[float, ...], HIDDEN]
    speed: Annotated[
        Speed, "at which it was measured; by default that in its record, if any, else at rest"
    ] = 0.0
    quantity: Annotated[str, Choice(QUANTITIES), HIDDEN] = QUANTITIES[0]
    coherence: Annotated[tuple[float, ...], HIDDEN] = ()

    @property
    def pair(self) -> str:
        """As in results."""
        return f"{self.response} / {self.excitation}"

    def _faults(self) -> Faults:
        counts = [len(self.frequency), len(self.real), len(self.imaginary)]
        if len(set(counts)) > 1 or counts[0] < 2:
            yield (
                ("file",),
                "frequency, real and imaginary: at least two values, as many in each: given "
                f"{', '.join(map(str, counts))}",
            )
        for _, sentence in ascending("frequency", self.frequency):
            yield ("file",), f"frequency: {sentence}"
        if not any((*self.real, *self.imaginary)):
            yield ("file",), NO_RESPONSE


def as_quantity(one: MeasuredResponse, quantity: str) -> NDArray[np.complex128]:
    """A measured response as another quantity, by the powers of iω between them."""
    import numpy as np

    power = QUANTITIES.index(quantity) - QUANTITIES.index(one.quantity)
    turn = 2j * math.pi * np.array(one.frequency)
    return np.asarray((np.array(one.real) + 1j * np.array(one.imaginary)) * turn**power)
