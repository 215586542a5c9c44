"""Who is joined to whom along the axis: rigid bodies, bearings between them, springs, stops."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bearings.angular_contact import AngularContactBallBearing
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.growth import ring_growth
from rotordyn.preload.shortening import seat_shifts

Array = NDArray[np.float64]
HOUSING = -1
SHAFT = 0


@dataclass(frozen=True, eq=False, slots=True)
class AxialBearing:
    """One bearing, or several alike side by side, between the shaft and a body.

    ``seats``: indices of the twins it stands for; ``thrust`` ±1; ``outer``: body of the outer ring;
    ``static_growth`` [m]; ``growth`` and ``shortening`` of the shaft there (speeds,) [m].
    """

    seats: tuple[int, ...]
    bearing: AngularContactBallBearing
    thrust: int
    outer: int
    static_growth: float
    growth: Array
    shortening: Array


@dataclass(frozen=True, eq=False, slots=True)
class Push:
    """Spring and stop of a sleeve: ``direction`` ±1, ``preload`` [N], ``stiffness`` [N/m]."""

    body: int
    direction: int
    preload: float
    stiffness: float
    travel: float


@dataclass(frozen=True, eq=False, slots=True)
class Arrangement:
    """Bodies (shaft first, then sleeves), joints and springs; ``force`` [N] on the shaft."""

    bodies: tuple[str, ...]
    joints: tuple[AxialBearing, ...]
    pushes: tuple[Push, ...]
    speed: Array
    force: float

    def at(self, index: NDArray[np.intp]) -> Arrangement:
        """The arrangement at some of its speeds."""
        joints = tuple(
            replace(joint, growth=joint.growth[index], shortening=joint.shortening[index])
            for joint in self.joints
        )
        return replace(self, joints=joints, speed=self.speed[index])


def arrangement(spindle: Spindle, speed: Array, force: float = 0.0) -> Arrangement:
    """The axial arrangement of ``spindle``, rings and shaft deformed by every ``speed`` [rad/s]."""
    sleeves = {sleeve.name: k + 1 for k, sleeve in enumerate(spindle.sleeves)}
    shifts = seat_shifts(spindle, speed)
    joints: list[AxialBearing] = []
    for k, seat in enumerate(spindle.seats):
        sleeve = spindle.sleeve_of(seat.name)
        joint = AxialBearing(
            seats=(k,),
            bearing=seat.bearing,
            thrust=seat.thrust,
            outer=HOUSING if sleeve is None else sleeves[sleeve.name],
            static_growth=seat.growth.static,
            growth=ring_growth(spindle, seat, speed),
            shortening=shifts[:, k],
        )
        twin = next((i for i, other in enumerate(joints) if _alike(other, joint)), None)
        if twin is None:
            joints.append(joint)
        else:
            joints[twin] = _joined(joints[twin], joint)
    return Arrangement(
        bodies=("shaft", *sleeves),
        joints=tuple(joints),
        pushes=tuple(_push(spindle, k) for k in range(len(spindle.sleeves))),
        speed=speed,
        force=force,
    )


def _alike(a: AxialBearing, b: AxialBearing) -> bool:
    """True where the two bearings must carry the same load at every speed."""
    same = (a.bearing, a.thrust, a.outer, a.static_growth)
    return same == (b.bearing, b.thrust, b.outer, b.static_growth) and bool(
        np.array_equal(a.growth, b.growth) and np.array_equal(a.shortening, b.shortening)
    )


def _joined(a: AxialBearing, b: AxialBearing) -> AxialBearing:
    return replace(a, seats=a.seats + b.seats)


def _push(spindle: Spindle, k: int) -> Push:
    """The spring pushes the outer rings the way that loads their bearings: against the thrust."""
    sleeve = spindle.sleeves[k]
    thrust = next(seat.thrust for seat in spindle.seats if seat.name in sleeve.bearings)
    spring = sleeve.spring
    return Push(k + 1, -thrust, spring.preload, spring.stiffness, sleeve.stop_travel)


def rigid(push: Push) -> bool:
    """True where the sleeve is locked in its place at rest."""
    return math.isinf(push.stiffness)


def at_rest(joined: Arrangement) -> Arrangement:
    """The arrangement standing still, without external force: what defines the preload."""
    joints = tuple(
        replace(j, growth=np.array([j.static_growth]), shortening=np.zeros(1))
        for j in joined.joints
    )
    return replace(joined, joints=joints, speed=np.zeros(1), force=0.0)
