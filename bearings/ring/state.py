"""A solved bearing: everything one may ask of its state."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law, check_name
from bearings.grooves import Grooves
from bearings.ring.question import Question

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class Cause:
    """Grooves, assumptions and question that a state belongs to."""

    grooves: Grooves
    law: Law
    question: Question

    def solved(self, question: Question) -> BearingState:
        """States of another question under the same assumptions."""
        from bearings.ring.request import solved

        return solved(Cause(self.grooves, self.law, question))


@dataclass(frozen=True, eq=False)
class BearingState:
    """Physical state of a bearing, or of a batch of states with leading shape (…).

    ``load`` (…, 5) [N, N·m], ``displacement`` (…, 5) [m, rad], ``speed`` (…) [rad/s] without its
    sign. ``residual`` (…): largest imbalance of a ball over the largest ball load, or of the ring
    over its load. Ball values (…, balls): ``inner_load``, ``outer_load`` [N]; ``inner_angle``,
    ``outer_angle`` [rad]; ``inner_pressure``, ``outer_pressure`` [Pa]; ``centrifugal_force`` [N],
    ``gyroscopic_moment`` [N·m]; ``inner_grip``, ``outer_grip``: friction coefficient that each race
    needs to carry its share of the gyroscopic moment; ``status``: ``"loaded"``, ``"open side"``
    (loaded against the side without a shoulder), ``"lost contact"`` (rides the outer race),
    ``"unloaded"`` (at rest).
    ``outcome`` (…): ``""`` where the state exists; where it does not, all numbers are NaN.
    ``ball_centre`` (2, …, balls): a start for neighbouring states; ``cause``: what was asked.
    """

    cause: Cause

    load: Array
    displacement: Array
    speed: Array
    residual: Array
    complete_stiffness: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    inner_pressure: Array
    outer_pressure: Array
    centrifugal_force: Array
    gyroscopic_moment: Array
    inner_grip: Array
    outer_grip: Array
    status: NDArray[np.str_]
    outcome: NDArray[np.str_]
    ball_centre: Array

    def stiffness(self, method: str = "complete") -> Array:
        """Tangent K = ∂load/∂displacement, shape (…, 5, 5) [N/m, N/rad, N·m/rad].

        ``"complete"`` contains the variation of Fc and Mg; it is not symmetric at speed.
        ``"frozen"`` keeps Fc and Mg as they are (Cao & Altintas 2004); ``"difference"`` takes
        central differences of the whole solve.

        Raises
        ------
        InvalidBearing : an unknown method
        """
        if method == "complete":
            return self.complete_stiffness
        from bearings.ring.tangents import TANGENTS

        check_name("stiffness method", method, ("complete", *TANGENTS))
        return TANGENTS[method](self)

    @cached_property
    def condition(self) -> NDArray[np.str_]:
        """What there is to say about each state (…), ``""`` where all balls carry as they should.

        ``"unloaded"``, ``"lost contact (balls 3–5)"``, ``"overloaded (pressure 4.6 GPa)"`` beyond
        the 4.2 GPa of ISO 76, ``"beyond the groove (balls 2)"`` past 90°,
        ``"slips on the inner race (balls 0–4)"``; where there is no state ``"no contact angle"``,
        ``"no equilibrium: stiffness vanishes above … rpm at this load"`` or ``"no equilibrium:
        balls 2–4 are thrown off a race above … rpm at this load"``: the first speed without a
        state, spinning up from rest, searched for now (``bearings.ring.spin_up``); ``"(states
        again from … to … rpm)"`` where some were met above it. Balls count from 0.
        """
        from bearings.ring.condition import conditions

        return conditions(self)

    @cached_property
    def slipping(self) -> NDArray[np.str_]:
        """Which race of each ball slips under the given friction (…, balls): ``""`` for none."""
        friction = self.cause.law.friction
        most = math.inf if friction is None else friction * (1.0 - 1e-9)
        inner, outer = self.inner_grip >= most, self.outer_grip >= most
        return np.select([inner & outer, inner, outer], ["both", "inner", "outer"], "")

    @cached_property
    def outer_ring_load(self) -> Array:
        """(Fx, Fy, Fz, My, Mz) that the balls put on the outer ring (…, 5) [N, N·m].

        Fx is that of ``load``; Fy and Fz are greater by the centrifugal forces. The moments are
        about the centre of the circle of *outer* groove centres, which lies BD sin α0 + δx behind
        that of the inner ones to which those of ``load`` refer.
        """
        from bearings.ring.outer_ring import outer_ring_load

        return outer_ring_load(self)

    @cached_property
    def control(self) -> NDArray[np.str_]:
        """The race that controls each ball after Jones' criterion (…, balls).

        ``"inner"``, ``"outer"``, ``"neither"``, or ``""`` for a ball that carries nothing.
        """
        from bearings.ring.contact_motion import control

        return control(self)

    @property
    def control_agrees(self) -> NDArray[np.bool_]:
        """False where the kinematics assumes control by a race that does not have it (…, balls).

        Only "outer" and "inner" assume such a thing, and only of balls that carry load.
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
        from bearings.ring.contact_motion import spin_to_roll

        return spin_to_roll(self)
