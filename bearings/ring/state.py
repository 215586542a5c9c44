"""A solved bearing: its data, and what follows from them by a formula; nothing here solves."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import check_name
from bearings.errors import InvalidBearing
from bearings.ring.contact_motion import control, spin_to_roll
from bearings.ring.data import StateData
from bearings.ring.outer_ring import outer_ring_load

Array = NDArray[np.float64]


class BearingState(StateData):
    """Physical state of a bearing, or of a batch of states with leading shape (…).

    Its arrays: ``bearings.ring.data.StateData``.
    """

    def stiffness(self, method: str = "complete") -> Array:
        """Tangent K = ∂load/∂displacement, shape (…, 5, 5) [N/m, N/rad, N·m/rad].

        ``"complete"`` contains the variation of Fc and Mg; it is not symmetric at speed.
        ``"frozen"`` keeps Fc and Mg as they are (Cao & Altintas 2004). A third method,
        ``"difference"``, solves the bearing anew: ``bearings.stiffness``.

        Raises
        ------
        InvalidBearing : an unknown method
        """
        if method == "complete":
            return self.complete_stiffness
        if method == "difference":
            raise InvalidBearing(
                "differences solve anew: use bearings.stiffness(state, 'difference')"
            )
        check_name("stiffness method", method, ("complete", "frozen"))
        from bearings.ring.frozen import frozen_stiffness  # the balance of balls, rarely needed

        return frozen_stiffness(self)

    @property
    def contacts(self) -> NDArray[np.int_]:
        """How many contacts of each ball bear load (…, balls)."""
        return np.asarray((self.contact_load > 0.0).sum(axis=-1))

    @cached_property
    def outer_ring_load(self) -> Array:
        """(Fx, Fy, Fz, My, Mz) that the balls put on the outer ring (…, 5) [N, N·m].

        Fx is that of ``load``; Fy and Fz are greater by the centrifugal forces. The moments are
        about the centre of the circle of *outer* groove middles, to which the axial place of the
        inner ones adds lever arms.
        """
        return outer_ring_load(self)

    @cached_property
    def control(self) -> NDArray[np.str_]:
        """The race that controls each ball after Jones' criterion (…, balls).

        ``"inner"``, ``"outer"``, ``"neither"``, or ``""`` for a ball that the inner race does not
        load, or that has more than two contacts.
        """
        return control(self)

    @property
    def control_agrees(self) -> NDArray[np.bool_]:
        """False where the kinematics assumes control by a race that does not have it (…, balls).

        Only "outer" and "inner" assume such a thing, and only of balls with one loaded contact a
        race.
        """
        named = self.cause.law.kinematics in ("inner", "outer")
        return (self.control == self.cause.law.kinematics) | (self.control == "") | (not named)

    @property
    def inner_spin_to_roll(self) -> Array:
        """Spin over rolling of each ball on the inner race (…, balls); 0 where it is not held."""
        return self._spin_to_roll[0]

    @property
    def outer_spin_to_roll(self) -> Array:
        """Spin over rolling of each ball on the outer race (…, balls); 0 where it is not held."""
        return self._spin_to_roll[1]

    @cached_property
    def _spin_to_roll(self) -> tuple[Array, Array]:
        return spin_to_roll(self)
