"""The ways in which the shaft may bend, and what the exact one cannot take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Protocol

from rotordyn.analysis.formulation import SOFTENED
from rotordyn.machine.support import LinearSupport, coupled_motions

ELEMENTS = "elements"
EXACT = "exact"
SHAFT = (ELEMENTS, EXACT)


UNDAMPED = (
    "the exact shaft has no modes to damp one by one: leave damping.rotor of the spindle empty "
    "(override: {damping.rotor: []}), and damping.rayleigh out"
)

LOSSLESS = (
    "the exact shaft is counted and solved without loss factors: leave damping.loss_factor of the "
    "spindle and loss_factor of its supports out"
)


class Modelled(Protocol):
    """Conditions, as they are given or as they are read."""

    @property
    def shaft(self) -> str: ...
    @property
    def rotor(self) -> str: ...
    @property
    def formulation(self) -> str: ...


def obstacles(
    conditions: Modelled, damped: bool, loss_factor: float, supports: Sequence[LinearSupport]
) -> Iterator[str]:
    """A sentence for everything that the exact shaft, where it is asked for, cannot describe.

    ``damped``: the rotor itself is, with or without its ``loss_factor``.
    """
    if conditions.shaft != EXACT:
        return
    if damped:
        yield UNDAMPED
    if loss_factor or any(support.loss_factor for support in supports):
        yield LOSSLESS
    if conditions.rotor == "rigid":
        yield "a rigid rotor does not bend, exactly or not: take rotor: flexible"
    if conditions.formulation == SOFTENED:
        yield (
            "fixed-frame softening is a term of the elements, the exact shaft has none: take "
            "formulation: inertial or rotating"
        )
    for support in supports:
        if "bending" in coupled_motions([support]):
            yield (
                f"support '{support.name}' couples bending with another motion, and the exact "
                "shaft bends only"
            )
