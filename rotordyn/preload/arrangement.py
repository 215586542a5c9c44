"""Axial arrangement of a spindle: rigid bodies, bearings between them, springs and stops."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from bearings.ball.law import STANDARD, Law
from bearings.ball.laws import Laws, laws_of
from bearings.bearing import BallBearing
from rotordyn.arrays import Array, Indices
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.growth import ring_growth, static_growth, thermal_shift
from rotordyn.preload.mounting import mounted_preloads, spring_direction
from rotordyn.preload.on_films import Films
from rotordyn.preload.shortening import seat_shifts, support_shift, thermal_shifts

HOUSING = -1  # in place of a body that carries an outer ring
SHAFT = 0  # index among the bodies


@dataclass(frozen=True, eq=False, slots=True)
class AxialBearing:
    """A bearing, or several identical ones in the same state, between the shaft and a body.

    ``seats``: indices of the seats of a tandem set; ``model``: the bearing mounted there; ``law``:
    assumptions on its balls, one for all speeds or one for each; ``thrust``: direction, ±1;
    ``outer``: index of the body that carries the outer ring; ``static_growth`` and ``growth`` of
    the rings, ``shortening`` of the shaft there (speeds,) [m], including the apparent growth and
    shift due to films and warm balls.
    """

    seats: tuple[int, ...]
    model: BallBearing
    law: Law | Laws
    thrust: int
    outer: int
    static_growth: Array
    growth: Array
    shortening: Array


@dataclass(frozen=True, eq=False, slots=True)
class Push:
    """Spring and stop of the sleeve ``body``: ``direction`` ±1 in which the spring pushes it with
    its ``preload`` [N] at rest, ``stiffness`` [N/m], infinite for a rigid preload; ``travel``
    against the spring up to the stop [m], infinite without a stop."""

    body: int
    direction: int
    preload: float
    stiffness: float
    travel: float


@dataclass(frozen=True, eq=False, slots=True)
class Arrangement:
    """Bodies (shaft first, then sleeves), bearings and springs; ``force`` [N] on the shaft.

    ``support_shift`` (speeds,): shift of the shaft where supports hold it along the axis [m].
    Of several machines ``side_by_side`` the ``pushes`` are those of the first, of which only the
    directions hold for all.
    """

    bodies: tuple[str, ...]
    bearings: tuple[AxialBearing, ...]
    pushes: tuple[Push, ...]
    speed: Array
    force: float
    support_shift: Array

    @property
    def bearing_of_seat(self) -> list[int]:
        """Index among ``bearings`` of the bearing at each seat (seats,)."""
        owner = {seat: k for k, bearing in enumerate(self.bearings) for seat in bearing.seats}
        return [owner[seat] for seat in sorted(owner)]

    @property
    def structure(self) -> tuple[Any, ...]:
        """Properties that machines solved ``side_by_side`` must have in common."""
        bearings = [
            (b.seats, b.model, b.thrust, b.outer, b.law.friction, b.law.dynamics)
            for b in self.bearings
        ]
        pushes = [(push.direction, rigid(push)) for push in self.pushes]
        return (self.bodies, self.force, *bearings, *pushes)

    @property
    def direction(self) -> Array:
        """Direction in which the spring of each body pushes, ±1; 0 for the shaft (bodies,)."""
        return np.array([0.0, *(push.direction for push in self.pushes)])

    def at(self, index: Indices) -> Arrangement:
        """Return the arrangement at the speeds ``index``."""
        bearings = tuple(
            replace(
                bearing,
                law=bearing.law.take(index),
                static_growth=bearing.static_growth[index],
                growth=bearing.growth[index],
                shortening=bearing.shortening[index],
            )
            for bearing in self.bearings
        )
        shift = self.support_shift[index]
        return replace(self, bearings=bearings, speed=self.speed[index], support_shift=shift)


def arrangement(
    spindle: Spindle,
    speed: Array,
    force: float = 0.0,
    law: Law = STANDARD,
    temperatures: Temperatures | None = None,
    films: Films | None = None,
) -> Arrangement:
    """Return the axial arrangement of ``spindle``, rings and shaft deformed by every ``speed``
    [rad/s] and by ``temperatures``, balls on ``films``.

    ``force`` [N] acts on the shaft; ``law``: assumptions on balls where a seat has none of its own.
    Seats with identical bearings and deformations at these speeds share a bearing.
    """
    sleeves = {sleeve.name: k + 1 for k, sleeve in enumerate(spindle.sleeves)}
    shifts = seat_shifts(spindle, speed)
    if temperatures is not None:
        shifts = shifts + thermal_shifts(spindle, speed, temperatures)
    zero = np.zeros_like(shifts)
    film_growth, film_shift = (zero, zero) if films is None else films.at(speed)
    bearings: list[AxialBearing] = []
    for k, seat in enumerate(spindle.seats):
        sleeve = spindle.sleeve_of(seat.name)
        ball_shift = thermal_shift(seat, speed, temperatures)
        bearing = AxialBearing(
            seats=(k,),
            model=spindle.mounted(seat),
            law=seat.law(law),
            thrust=seat.thrust,
            outer=HOUSING if sleeve is None else sleeves[sleeve.name],
            static_growth=np.full(len(speed), static_growth(spindle, seat)),
            growth=ring_growth(spindle, seat, speed, temperatures) + film_growth[:, k],
            shortening=shifts[:, k] + seat.thrust * (film_shift[:, k] + ball_shift),
        )
        same = next((i for i, other in enumerate(bearings) if _alike(other, bearing)), None)
        if same is None:
            bearings.append(bearing)
        else:
            bearings[same] = replace(bearings[same], seats=bearings[same].seats + bearing.seats)
    return Arrangement(
        bodies=("shaft", *sleeves),
        bearings=tuple(bearings),
        pushes=_pushes(spindle),
        speed=speed,
        force=force,
        support_shift=support_shift(spindle, speed, temperatures),
    )


def _alike(a: AxialBearing, b: AxialBearing) -> bool:
    """True if two bearings must carry the same load at every speed."""
    same = (a.model, a.law, a.thrust, a.outer) == (b.model, b.law, b.thrust, b.outer)
    return same and all(
        np.array_equal(getattr(a, name), getattr(b, name))
        for name in ("static_growth", "growth", "shortening")
    )


def _pushes(spindle: Spindle) -> tuple[Push, ...]:
    preloads = zip(spindle.sleeves, mounted_preloads(spindle), strict=True)
    return tuple(
        Push(
            k,
            spring_direction(spindle, sleeve),
            preload,
            sleeve.spring.stiffness,
            sleeve.stop_travel,
        )
        for k, (sleeve, preload) in enumerate(preloads, start=SHAFT + 1)
    )


def rigid(push: Push) -> bool:
    """True if the sleeve is locked in its position at rest."""
    return math.isinf(push.stiffness)


def has_stop(push: Push) -> bool:
    """True if a stop ends the travel of the sleeve."""
    return math.isfinite(push.travel) and not rigid(push)


def as_mounted(joined: Arrangement) -> Arrangement:
    """Return the arrangement at rest without external force, the condition of stated preloads."""
    bearings = tuple(
        replace(
            b,
            law=b.law.take([0]),
            static_growth=b.static_growth[:1],
            growth=b.static_growth[:1],
            shortening=np.zeros(1),
        )
        for b in joined.bearings
    )
    zero = np.zeros(1)
    return replace(joined, bearings=bearings, speed=zero, force=0.0, support_shift=zero)


def apart(joined: Arrangement) -> Arrangement:
    """Return the arrangement with one bearing per seat, in the order of the seats."""
    separate = [replace(b, seats=(seat,)) for b in joined.bearings for seat in b.seats]
    return replace(joined, bearings=tuple(sorted(separate, key=lambda bearing: bearing.seats)))


def side_by_side(machines: Sequence[Arrangement]) -> Arrangement:
    """Join machines of one ``structure`` into one arrangement, their speeds in sequence."""
    first, count = machines[0], [len(m.speed) for m in machines]
    if len(machines) == 1:
        return first
    assert all(m.structure == first.structure for m in machines), "machines of different structure"
    bearings = []
    for k, bearing in enumerate(first.bearings):
        copies = [m.bearings[k] for m in machines]
        bearings.append(
            replace(
                bearing,
                law=laws_of([b.law for b in copies], count),
                static_growth=np.concatenate([b.static_growth for b in copies]),
                growth=np.concatenate([b.growth for b in copies]),
                shortening=np.concatenate([b.shortening for b in copies]),
            )
        )
    speed = np.concatenate([m.speed for m in machines])
    shift = np.concatenate([m.support_shift for m in machines])
    return replace(first, bearings=tuple(bearings), speed=speed, support_shift=shift)
