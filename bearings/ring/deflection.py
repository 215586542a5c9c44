"""Deflection of the rings of a solved bearing under its balls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.geometry import geometry
from bearings.ring.assembly import full_assembly
from bearings.ring.groove_shifts import groove_shifts
from bearings.ring.problem import Problem
from bearings.ring.state import BearingState


@dataclass(frozen=True, eq=False, slots=True)
class RingDeflection:
    """Deflection of rings; zero for rigid ones, NaN where there is no state.

    By contact, in the order of the bearing's ``contact_names``: ``shift`` (…, balls, contacts, 2)
    [m] of the groove centre, axial and radial; ``normal`` (…, balls, contacts) [m]: deflection of
    the raceway along the normal of the contact, in addition to Hertz's law. ``inner``, ``outer``
    (…, balls): the largest over the contacts of each ring.
    """

    shift: Array
    normal: Array
    split: int

    @property
    def inner(self) -> Array:
        """Deflection of the inner raceway at every ball (…, balls) [m]."""
        return np.asarray(self.normal[..., : self.split].max(axis=-1))

    @property
    def outer(self) -> Array:
        """Deflection of the outer raceway at every ball (…, balls) [m]."""
        return np.asarray(self.normal[..., self.split :].max(axis=-1))


@checked
def ring_deflection(state: BearingState) -> RingDeflection:
    """Compute the deflection of both rings of a state at every ball."""
    operation = state.operation
    g = geometry(operation.grooves)
    exists = state.outcome.reshape(-1) == ""
    shift = np.full((exists.size, g.balls, len(g.sides), 2), np.nan)
    normal = np.full(shift.shape[:3], np.nan)
    shift[exists], normal[exists] = 0.0, 0.0
    if operation.grooves.rings is not None:
        problem = Problem.of(operation, full_assembly)
        d, x = state.displacement.reshape(-1, 5), state.ball_centre
        x = x.reshape(len(x), exists.size, -1)
        for rows, part in problem.parts(exists):
            of_grooves = groove_shifts(part, d[rows], x[:, rows])
            way, shifts = (values[:, :, g.groove_of] for values in of_grooves)
            length = np.sqrt((way * way).sum(axis=-1))
            along = (way * shifts).sum(axis=-1)
            shift[rows] = shifts
            normal[rows] = along / np.where(length > 0.0, length, 1.0)
    shape = state.outcome.shape
    return RingDeflection(
        shift.reshape(*shape, *shift.shape[1:]),
        normal.reshape(*shape, *normal.shape[1:]),
        g.races[0].stop,
    )
