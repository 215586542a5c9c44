"""Measured responses of a machine between two of its points, for analyses (SI)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from rotordyn.description import Description, Faults, ascending
from rotordyn.errors import InvalidInput
from rotordyn.machine.matrix import DOFS, Dof
from rotordyn.quantity import (
    HIDDEN,
    Choice,
    Frequency,
    Key,
    Name,
    PointName,
    Speed,
    suggestion,
)
from rotordyn.results.display import response_unit
from rotordyn.units import shown

if TYPE_CHECKING:
    from rotordyn.arrays import Complex

QUANTITIES = ("receptance", "mobility", "inertance")
NO_RESPONSE = "no response: given zero at every frequency; allowed: at least one other value"
RANGE = 1e-50, 1e50  # of the largest value of a response in SI: its square does not overflow


@dataclass(frozen=True, slots=True)
class Port(Description):
    """A point of the machine (of a further rotor: ``rotor.point``) and one of its directions."""

    point: PointName
    direction: Dof

    @classmethod
    def from_text(cls, text: str) -> Port:
        """Port of a text such as ``tip.y``.

        >>> Port.from_text("outer.tip.thz")
        Port(point='outer.tip', direction='thz')
        """
        point, _, direction = text.rpartition(".")
        if not point:
            raise InvalidInput(
                f"not a place: given {shown(text)}; allowed: POINT.DIRECTION such as tip.y"
            )
        if direction not in DOFS:
            raise InvalidInput(
                f"unknown direction: given {shown(text)}; allowed: {', '.join(DOFS)}"
                f"{suggestion(direction, DOFS)}"
            )
        return cls(point, direction)

    def __str__(self) -> str:
        return f"{self.point}.{self.direction}"


@dataclass(frozen=True, slots=True)
class Pair:
    """Marker of a pair of response and excitation, a ``PortPair`` in files."""


@dataclass(frozen=True, slots=True)
class MeasuredResponse(Description):
    """A measured response, from UFF type 58 or a CSV table."""

    name: Annotated[Name, Key(default=""), "name in figures and summary; by default its number"]
    response: Annotated[Port, "point and direction of the motion, as of a pair of the case"]
    excitation: Annotated[Port, "point and direction of the force, as of a pair of the case"]
    frequency: Annotated[tuple[Frequency, ...], HIDDEN]
    real: Annotated[tuple[float, ...], HIDDEN]
    imaginary: Annotated[tuple[float, ...], HIDDEN]
    speed: Annotated[
        Speed, "speed of the measurement; by default that in its record, if any, else at rest"
    ] = 0.0
    quantity: Annotated[str, Choice(QUANTITIES), HIDDEN] = QUANTITIES[0]
    coherence: Annotated[tuple[float, ...], HIDDEN] = ()

    @property
    def pair(self) -> str:
        """Name of the pair in results."""
        return f"{self.response} / {self.excitation}"

    def _faults(self) -> Faults:
        counts = [len(self.frequency), len(self.real), len(self.imaginary)]
        if len(set(counts)) > 1 or counts[0] < 2:
            yield (
                ("file",),
                "frequency, real and imaginary: at least two values, the same number in each: "
                f"given {', '.join(map(str, counts))}",
            )
        for _, sentence in ascending("frequency", self.frequency):
            yield ("file",), f"frequency: {sentence}"
        if not any((*self.real, *self.imaginary)):
            yield ("file",), NO_RESPONSE
            return
        values = map(complex, self.real, self.imaginary)
        if why := out_of_range(self.frequency, values, response_unit(self.pair, self.quantity)):
            yield ("file",), why


def out_of_range(frequency: Sequence[float], values: Iterable[complex], unit: str) -> str:
    """Sentence on why the largest value of a response [SI, ``unit``] is too large or too small;
    empty where it is not, or not known. ``frequency`` [Hz]."""
    sizes = [math.hypot(value.real, value.imag) for value in values]
    size, (low, high) = max(sizes, default=1.0), RANGE
    if size < low or size > high:
        at = frequency[sizes.index(size)]
        return (
            f"response out of range: its largest value is {size:.3g} {unit} at {at:.6g} Hz; "
            f"allowed: {low:.0e} to {high:.0e} {unit}"
        )
    return ""


def as_quantity(one: MeasuredResponse, quantity: str) -> Complex:
    """A measured response as another quantity, by the powers of iω between them."""
    import numpy as np

    power = QUANTITIES.index(quantity) - QUANTITIES.index(one.quantity)
    turn = 2j * math.pi * np.array(one.frequency)
    return np.asarray((np.array(one.real) + 1j * np.array(one.imaginary)) * turn**power)
