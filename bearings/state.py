"""A solved bearing: everything one may ask of its state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearings.angular_contact import AngularContactBallBearing
from bearings.question import check_name

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class Cause:
    """Bearing, hypotheses and growth (…) [m] that a state belongs to."""

    bearing: AngularContactBallBearing
    kinematics: str
    moment_sharing: str
    static_growth: Array
    growth: Array


@dataclass(frozen=True, eq=False)
class BearingState:
    """Physical state of a bearing, or of a batch of states with leading shape (…).

    ``load`` (…, 5) [N, N·m], ``displacement`` (…, 5) [m, rad], ``speed`` (…) [rad/s] without its
    sign. Ball values (…, balls): ``inner_load``, ``outer_load`` [N]; ``inner_angle``,
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
        from bearings.tangents import TANGENTS

        check_name("stiffness method", method, ("complete", *TANGENTS))
        return TANGENTS[method](self)
