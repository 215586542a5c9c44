"""What a solved bearing is: plain arrays, and what was asked."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law
from bearings.geometry import Geometry, geometry
from bearings.grooves import Grooves
from bearings.ring.question import Question

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class Cause:
    """Grooves, assumptions and question that a state belongs to."""

    grooves: Grooves
    law: Law
    question: Question

    @property
    def geometry(self) -> Geometry:
        """What the grooves imply."""
        return geometry(self.grooves)


@dataclass(frozen=True, eq=False)
class StateData:
    """Arrays of a bearing state, or of a batch of states with leading shape (…).

    ``load`` (…, 5) [N, N·m], ``displacement`` (…, 5) [m, rad], ``speed`` (…) [rad/s] without its
    sign. ``residual`` (…): largest imbalance of a ball over the largest ball load, or of the ring
    over its load. ``complete_stiffness`` (…, 5, 5).

    By contact (…, balls, contacts), in the order of the bearing's ``contact_names``:
    ``contact_load`` [N], ``contact_angle`` [rad] (NaN without load; in a bearing of one groove a
    ring negative on the side away from thrust), ``contact_pressure`` [Pa].

    By ball (…, balls): ``inner_load``, ``outer_load`` [N]: resultants of the races;
    ``inner_angle``, ``outer_angle`` [rad]: their directions; ``inner_pressure``,
    ``outer_pressure`` [Pa]: largest of each race; ``centrifugal_force`` [N],
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
    contact_load: Array
    contact_angle: Array
    contact_pressure: Array
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

    @property
    def slipping(self) -> NDArray[np.str_]:
        """Which race of each ball slips under the given friction (…, balls): ``""`` for none."""
        friction = self.cause.law.friction
        most = math.inf if friction is None else friction * (1.0 - 1e-9)
        inner, outer = self.inner_grip >= most, self.outer_grip >= most
        return np.select([inner & outer, inner, outer], ["both", "inner", "outer"], "")
