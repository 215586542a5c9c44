"""Sliding sleeves: one DOF along the axis on a flexible spring, two across it in a flexible bore.

A sleeve without mass has a fictitious one that puts it on its spring far above the highest
frequency required (``Fineness.weightless``).

Theory: docs/theory/supports.md#sleeves.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from bearings.geometry import geometry
from rotordyn.arrays import Indices
from rotordyn.equation.dofs import Dofs
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.term import AtState, Link, LinkMatrices, Part, State
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle

CLOSED = 1e6  # stiffness of a closed stop over that of the bearings on its sleeve
SOFT = 3e-3  # of the stiffness of its bearings: least stiffness that gives a fictitious mass
PRESSED = 1e-3  # of the free distance of their grooves: the deflection assumed for it


class Sleeves:
    """DOF of all sleeves: ``dofs`` by name of the sleeve and direction; they serve spindles that
    differ in the springs of these alone."""

    def __init__(self, dofs: Dofs, spindle: Spindle, fine: Fineness) -> None:
        self.fine, self.dofs = fine, dict[tuple[str, str], int]()
        for sleeve in spindle.sleeves:
            for direction, stiffness in springs(sleeve):
                if math.isfinite(stiffness):
                    self.dofs[sleeve.name, direction] = dofs.add(
                        f"sleeve {sleeve.name}", [direction]
                    ).item()

    def under(self, spindle: Spindle, seat: str) -> dict[str, int]:
        """Return the DOF of the sleeve that carries a bearing, by direction."""
        sleeve = spindle.sleeve_of(seat)
        if sleeve is None:
            return {}
        return {
            direction: number
            for (name, direction), number in self.dofs.items()
            if name == sleeve.name
        }

    def parts(self, spindle: Spindle) -> Iterator[Part]:
        """Yield mass, and the spring across the axis."""
        for sleeve in spindle.sleeves:
            for direction, stiffness in springs(sleeve):
                if (sleeve.name, direction) in self.dofs:
                    rows = _one(self.dofs[sleeve.name, direction])
                    least = SOFT * _stiffness_of_bearings(spindle, sleeve)
                    mass = sleeve.mass or max(stiffness, least) / self.fine.weightless**2
                    yield Part("mass", rows, rows, np.full((1, 1, 1), mass))
                    if direction != "x":
                        yield Part("stiffness", rows, rows, np.full((1, 1, 1), stiffness))

    def links(self, spindle: Spindle) -> Iterator[Link]:
        """Yield the spring along the axis, and the stop where the sleeve is at it."""
        for place, sleeve in enumerate(spindle.sleeves):
            if (sleeve.name, "x") in self.dofs:
                carried = [k for k, s in enumerate(spindle.seats) if s.name in sleeve.bearings]
                yield Link(
                    f"sleeve {sleeve.name}",
                    _one(self.dofs[sleeve.name, "x"])[0],
                    np.ones((1, 1)),
                    _spring_and_stop(sleeve, place, carried),
                )


def _stiffness_of_bearings(spindle: Spindle, sleeve: Sleeve) -> float:
    """Return the approximate stiffness [N/m] of all bearings on a sleeve."""
    on_it = (seat for seat in spindle.seats if seat.name in sleeve.bearings)
    geometries = (geometry(seat.bearing.grooves) for seat in on_it)
    return sum(
        g.balls * g.series_stiffness * math.sqrt(PRESSED * g.free_distance) for g in geometries
    )


def springs(sleeve: Sleeve) -> tuple[tuple[str, float], ...]:
    """Return directions and their stiffness [N/m], infinite where it cannot move."""
    radial = sleeve.radially
    return ("x", sleeve.spring.stiffness), ("y", radial), ("z", radial)


def _spring_and_stop(sleeve: Sleeve, place: int, carried: list[int]) -> AtState:
    def matrices(state: State) -> LinkMatrices:
        bearings = state.tangents[:, carried, 0, 0].sum(axis=1)
        stop = CLOSED * bearings * state.stops[:, place]
        stiffness = sleeve.spring.stiffness + stop
        return LinkMatrices(stiffness[:, None, None], np.zeros((1, 1, 1)))

    return matrices


def _one(number: int) -> Indices:
    return np.array([[number]])
