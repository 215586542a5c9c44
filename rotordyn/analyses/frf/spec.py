"""What a case asks of frequency responses, and what was measured of them (SI)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, ascending, doubled
from rotordyn.machine.support import Freedom
from rotordyn.quantity import Choice, EngineOrder, Frequency, Name, PointName, Speed

QUANTITIES = ("receptance", "mobility", "inertance")
ORDERS_TURNED = (
    "a multiple of the speed has another frequency in the turning frame: leave engine_orders out, "
    "or take formulation: inertial"
)
NO_RESPONSE = "no response: given zero at every frequency; allowed: at least one other value"


@dataclass(frozen=True, slots=True)
class Port(Description):
    """A point of the machine (of a further rotor: ``rotor.point``) and one of its directions."""

    point: PointName
    direction: Freedom

    def __str__(self) -> str:
        return f"{self.point}.{self.direction}"


@dataclass(frozen=True, slots=True)
class MeasuredResponse(Description):
    """A measured frequency response in SI: ``quantity`` over ``frequency`` [Hz], in two parts.

    ``speed`` [rad/s] at which it was measured.
    """

    name: Name
    response: Port
    excitation: Port
    frequency: tuple[Frequency, ...]
    real: tuple[float, ...]
    imaginary: tuple[float, ...]
    speed: Speed = 0.0
    quantity: Annotated[str, Choice(QUANTITIES)] = QUANTITIES[0]

    @property
    def pair(self) -> str:
        """As in results."""
        return f"{self.response} / {self.excitation}"

    def _faults(self) -> Iterator[str]:
        counts = [len(self.frequency), len(self.real), len(self.imaginary)]
        if len(set(counts)) > 1 or counts[0] < 2:
            yield (
                "frequency, real and imaginary: at least two values, as many in each: given "
                f"{', '.join(map(str, counts))}"
            )
        yield from ascending("frequency", self.frequency)
        if not any((*self.real, *self.imaginary)):
            yield NO_RESPONSE


@dataclass(frozen=True, slots=True)
class FrfSpec(Description):
    """Responses between ``pairs`` (response, excitation) at every speed and frequency [Hz].

    ``quantity``: of ``QUANTITIES``: displacement, velocity or acceleration over force. ``measured``
    is laid over what is computed.
    ``engine_orders``: multiples of the speed of every rotor, along which the responses are followed
    over speed, beside ``frequencies`` or instead of them.
    ``slices``: speeds [rad/s] at which curves are drawn and UFF58 records written (nearest speed
    of the case); none given = the lowest and the highest.
    """

    frequencies: tuple[Frequency, ...]
    pairs: tuple[tuple[Port, Port], ...]
    slices: tuple[Speed, ...] = ()
    quantity: Annotated[str, Choice(QUANTITIES)] = QUANTITIES[0]
    measured: tuple[MeasuredResponse, ...] = ()
    engine_orders: tuple[EngineOrder, ...] = ()

    def highest(self, top: float) -> float:
        """Highest frequency asked for [Hz], where the fastest rotor turns at ``top`` [rad/s]."""
        order = max(self.engine_orders, default=0.0)
        return max(*self.frequencies[-1:], order * top / (2.0 * math.pi), 0.0)

    def _faults(self) -> Iterator[str]:
        if not self.pairs:
            yield "no pairs: at least one is needed"
        if not self.frequencies and not self.engine_orders:
            yield "no frequencies: at least one is needed, or engine_orders"
        if not self.frequencies:
            yield from (
                f"{name}: needs frequencies"
                for name in ("slices", "measured")
                if getattr(self, name)
            )
        yield from ascending("engine_orders", self.engine_orders)
        yield from ascending("frequencies", self.frequencies)
        yield from ascending("slices", self.slices)
        for name in doubled(f"{response} / {excitation}" for response, excitation in self.pairs):
            yield f"pairs: repeated: given '{name}'"
        known = {f"{response} / {excitation}" for response, excitation in self.pairs}
        for one in self.measured:
            if one.pair not in known:
                yield f"measured {one.name}: not a pair of the case: given '{one.pair}'"
        for name in doubled(one.name for one in self.measured):
            yield f"measured: name given twice: '{name}'"
