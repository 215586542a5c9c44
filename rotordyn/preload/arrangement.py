"""Who is joined to whom along the axis: rigid bodies, bearings between them, springs, stops."""

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
from rotordyn.preload.mounting import mounted_preloads, spring_way
from rotordyn.preload.on_films import Films
from rotordyn.preload.shortening import seat_shifts, support_shift, thermal_shifts

HOUSING = -1
SHAFT = 0


@dataclass(frozen=True, eq=False, slots=True)
class AxialBearing:
    """One bearing, or several alike in the same state, between the shaft and a body.

    ``seats``: indices of the bearings of a tandem set; ``model``: what is mounted there; ``law``:
    what is assumed of its balls, at every speed or at each; ``thrust`` ±1;
    ``outer``: body of the outer ring; ``static_growth``, ``growth`` and ``shortening`` of the
    shaft there (speeds,) [m], what films and warm balls seem to add included.
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
    its ``preload`` [N] at rest, ``stiffness`` [N/m], ``travel`` against the spring [m]; infinite: a
    rigid preload, no stop."""

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
        """For every seat the bearing that stands for it, index among ``bearings`` (seats,)."""
        owner = {seat: k for k, bearing in enumerate(self.bearings) for seat in bearing.seats}
        return [owner[seat] for seat in sorted(owner)]

    @property
    def structure(self) -> tuple[Any, ...]:
        """What machines that are solved ``side_by_side`` have in common."""
        bearings = [
            (b.seats, b.model, b.thrust, b.outer, b.law.friction, b.law.dynamics)
            for b in self.bearings
        ]
        pushes = [(push.direction, rigid(push)) for push in self.pushes]
        return (self.bodies, self.force, *bearings, *pushes)

    @property
    def direction(self) -> Array:
        """Way in which the spring of every body pushes, ±1; 0 of the shaft (bodies,)."""
        return np.array([0.0, *(push.direction for push in self.pushes)])

    def at(self, index: Indices) -> Arrangement:
        """The arrangement at some of its speeds."""
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
    """The axial arrangement of ``spindle``, rings and shaft deformed by every ``speed`` [rad/s] and
    by ``temperatures``, balls on ``films``.

    ``force`` [N] on the shaft; ``law``: what is assumed of balls where a seat says nothing else.
    Seats that are alike at these speeds share a bearing.
    """
    sleeves = {sleeve.name: k + 1 for k, sleeve in enumerate(spindle.sleeves)}
    shifts = seat_shifts(spindle, speed)
    if temperatures is not None:
        shifts = shifts + thermal_shifts(spindle, speed, temperatures)
    none = np.zeros_like(shifts)
    by_films, along = (none, none) if films is None else films.at(speed)
    bearings: list[AxialBearing] = []
    for k, seat in enumerate(spindle.seats):
        sleeve = spindle.sleeve_of(seat.name)
        swollen = thermal_shift(seat, speed, temperatures)
        bearing = AxialBearing(
            seats=(k,),
            model=spindle.mounted(seat),
            law=seat.law(law),
            thrust=seat.thrust,
            outer=HOUSING if sleeve is None else sleeves[sleeve.name],
            static_growth=np.full(len(speed), static_growth(spindle, seat)),
            growth=ring_growth(spindle, seat, speed, temperatures) + by_films[:, k],
            shortening=shifts[:, k] + seat.thrust * (along[:, k] + swollen),
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
    """True where the two bearings must carry the same load at every speed."""
    same = (a.model, a.law, a.thrust, a.outer) == (b.model, b.law, b.thrust, b.outer)
    return same and all(
        np.array_equal(getattr(a, name), getattr(b, name))
        for name in ("static_growth", "growth", "shortening")
    )


def _pushes(spindle: Spindle) -> tuple[Push, ...]:
    preloads = zip(spindle.sleeves, mounted_preloads(spindle), strict=True)
    return tuple(
        Push(k, spring_way(spindle, each), force, each.spring.stiffness, each.stop_travel)
        for k, (each, force) in enumerate(preloads, start=SHAFT + 1)
    )


def rigid(push: Push) -> bool:
    """True where the sleeve is locked in its place at rest."""
    return math.isinf(push.stiffness)


def has_stop(push: Push) -> bool:
    """True where a stop ends the travel of the sleeve."""
    return math.isfinite(push.travel) and not rigid(push)


def as_mounted(joined: Arrangement) -> Arrangement:
    """The arrangement at rest without external force, as the stated preloads are meant."""
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
    none = np.zeros(1)
    return replace(joined, bearings=bearings, speed=none, force=0.0, support_shift=none)


def apart(joined: Arrangement) -> Arrangement:
    """The arrangement with every bearing by itself, in the order of the seats."""
    alone = [replace(b, seats=(seat,)) for b in joined.bearings for seat in b.seats]
    return replace(joined, bearings=tuple(sorted(alone, key=lambda each: each.seats)))


def side_by_side(machines: Sequence[Arrangement]) -> Arrangement:
    """Machines of one ``structure`` as one arrangement, the speeds of one after those of the
    other."""
    first, count = machines[0], [len(each.speed) for each in machines]
    if len(machines) == 1:
        return first
    assert all(each.structure == first.structure for each in machines), "machines built otherwise"
    bearings = []
    for k, bearing in enumerate(first.bearings):
        every = [each.bearings[k] for each in machines]
        bearings.append(
            replace(
                bearing,
                law=laws_of([each.law for each in every], count),
                static_growth=np.concatenate([each.static_growth for each in every]),
                growth=np.concatenate([each.growth for each in every]),
                shortening=np.concatenate([each.shortening for each in every]),
            )
        )
    speed = np.concatenate([each.speed for each in machines])
    shift = np.concatenate([each.support_shift for each in machines])
    return replace(first, bearings=tuple(bearings), speed=speed, support_shift=shift)
