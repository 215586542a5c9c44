"""From the free set to the mounted one: ring offset, force, and what fits add to both.

The axial displacement of a bearing counts from where it carries nothing, static growth included;
growth Δu0 closes the contact angle, cos α' = cos α + Δu0/BD, which takes up BD (sin α − sin α') of
the play of the free bearing. Rings brought together by an offset thus press by the offset and what
growth takes up on both sides.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bearings.bearing import BallBearing
from bearings.ring.state import BearingState
from rotordyn.errors import InvalidInput
from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.growth import static_growth

LIGHTEST = 1e-3  # N: a set that is pressed by less has play
HEAVIEST = 1e7  # N: more than any bearing bears
LONGEST = 1e-3  # m
EXACT = 1e-20  # m


def mounted_preloads(spindle: Spindle) -> list[float]:
    """Force of the spring of every sleeve at rest, as mounted [N].

    Offsets say where sleeves are against the housing. The shaft is where all of them and all other
    springs balance.

    Raises
    ------
    InvalidInput : a set has play as mounted, or nothing stands against it
    """
    forces = [sleeve.spring.preload for sleeve in spindle.sleeves]
    offsets = {
        k: _offset(spindle, sleeve)
        for k, sleeve in enumerate(spindle.sleeves)
        if sleeve.spring.free or sleeve.spring.offset is not None
    }
    if not offsets:
        return forces
    from scipy.optimize import brentq

    ways = [spring_way(spindle, sleeve) for sleeve in spindle.sleeves]
    held = {k: sides(spindle, spindle.sleeves[k])[0] for k in offsets}
    housing = Side(spindle, _in_housing(spindle))
    pushed = sum(w * f for k, (w, f) in enumerate(zip(ways, forces, strict=True)) if k not in held)

    def left(x: float) -> float:
        """What the shaft at ``x`` would still have to be pushed with [N]."""
        own = (side.push(x - ways[k] * offsets[k]) for k, side in held.items())
        return housing.push(x) + sum(own) - pushed

    if not left(-LONGEST) <= 0.0 <= left(LONGEST):
        raise InvalidInput(
            f"sleeves {', '.join(sleeve.name for sleeve in spindle.sleeves)}: together they press "
            "the bearings beyond what they bear: lower their preloads"
        )
    shaft = float(brentq(left, -LONGEST, LONGEST, xtol=EXACT))
    for k, side in held.items():
        x = shaft - ways[k] * offsets[k]
        forces[k] = -ways[k] * side.push(x)
        overloaded = side.overloaded(x) or housing.overloaded(shaft)
        _require_pressed(spindle, spindle.sleeves[k], offsets[k], forces[k], overloaded=overloaded)
    return forces


def _require_pressed(
    spindle: Spindle, sleeve: Sleeve, offset: float, force: float, *, overloaded: bool
) -> None:
    """Go on only where the ``force`` [N] of an ``offset`` [m] presses, and not too hard."""
    if force > LIGHTEST and not overloaded:
        return
    total = offset + sum(side.gained for side in sides(spindle, sleeve))
    what, remedy = "leaves play in its bearings as mounted", "a larger one"
    if overloaded:
        what, remedy = "presses its bearings beyond what they bear", "a smaller one"
        remedy += ", or lower the preloads beside it" * (len(spindle.sleeves) > 1)
    raise InvalidInput(
        f"sleeve {sleeve.name}: an offset of {offset * 1e6:.3g} µm {what} "
        f"({total * 1e6:.3g} µm with what the fits take up): give {remedy}"
    )


def ring_offset(spindle: Spindle, sleeve: Sleeve, force: float) -> float:
    """Axial offset of the free rings that presses with ``force`` [N] as mounted, beside all other
    sleeves [m].

    Raises
    ------
    InvalidInput : nothing in the housing stands against it
    """
    own, facing = sides(spindle, sleeve)
    way, pushed = spring_way(spindle, sleeve), force
    if len(spindle.sleeves) > 1:
        others = zip(spindle.sleeves, mounted_preloads(spindle), strict=True)
        pushed += way * sum(spring_way(spindle, s) * f for s, f in others if s != sleeve)
    if pushed < 0.0:  # the others push harder, against bearings of the same thrust
        beside = Side(spindle, _in_housing(spindle, -way))
        return own.approach(force, -way) - beside.approach(-pushed, -way)
    return own.approach(force, -way) + facing.approach(pushed, way)


def class_offset(spindle: Spindle, sleeve: Sleeve, force: float) -> float:
    """Axial offset of the free rings of a pair, one bearing on each side, under ``force`` [N] [m].

    A maker grinds it on every bearing of a class: sets of more bearings have the same.
    """
    load = [[force, 0.0, 0.0, 0.0, 0.0]]
    pair = [side.seats[0].bearing for side in sides(spindle, sleeve)]
    return sum(float(b.equilibrium(load=load, compiled=False).displacement[0, 0]) for b in pair)


def _offset(spindle: Spindle, sleeve: Sleeve) -> float:
    given = sleeve.spring.offset
    return class_offset(spindle, sleeve, sleeve.spring.preload) if given is None else given


@dataclass(frozen=True, eq=False)
class Side:
    """Bearings between the shaft and one body."""

    spindle: Spindle
    seats: Sequence[BearingSeat]

    @cached_property
    def _alike(self) -> Counter[tuple[BallBearing, int, float]]:
        """How many there are of each model, thrust and static growth [m]."""
        return Counter(
            (self.spindle.mounted(seat), seat.thrust, static_growth(self.spindle, seat))
            for seat in self.seats
        )

    @property
    def gained(self) -> float:
        """Mean play that growth takes up [m]."""
        gains = [_gain(model, growth) for model, _, growth in self._alike.elements()]
        return float(np.mean(gains))

    def push(self, x: float) -> float:
        """Force of the shaft on the body towards +x where it stands by ``x`` [m] off the place at
        which the free rings have neither load nor play [N]."""
        return sum(
            count * thrust * _load(_state(model, thrust * x, growth))
            for (model, thrust, growth), count in self._alike.items()
        )

    def overloaded(self, x: float) -> bool:
        """Some contact is pressed there beyond what results mean anything for."""
        states = (_state(model, thrust * x, growth) for model, thrust, growth in self._alike)
        peak = [np.fmax(s.inner_pressure, s.outer_pressure).max() for s in states]
        return not np.max(peak) <= HIGHEST_PRESSURE  # nor where there is none

    def approach(self, force: float, way: int) -> float:
        """How far the free rings come together where the shaft pushes with ``force`` [N] in a
        ``way`` ±1 that loads the bearings [m]."""
        ((model, _, growth), count), *others = self._alike.items()
        if not others:
            own = [[force / count, 0.0, 0.0, 0.0, 0.0]]
            state = model.equilibrium(load=own, static_growth=growth, compiled=False)
            return float(state.displacement[0, 0]) - _gain(model, growth)
        from scipy.optimize import brentq

        def over(d: float) -> float:
            return way * self.push(way * d) - force

        return float(brentq(over, -LONGEST, LONGEST, xtol=EXACT))


def sides(spindle: Spindle, sleeve: Sleeve) -> tuple[Side, Side]:
    """Bearings on the sleeve, and those in the housing that they press against.

    Raises
    ------
    InvalidInput : there is none of the latter
    """
    own = [seat for seat in spindle.seats if seat.name in sleeve.bearings]
    facing = _in_housing(spindle, spring_way(spindle, sleeve))
    if not facing:
        raise InvalidInput(
            f"sleeve {sleeve.name}: nothing in the housing takes the thrust of its bearings: a "
            "preload by offset or by class needs bearings that face them"
        )
    return Side(spindle, own), Side(spindle, facing)


def spring_way(spindle: Spindle, sleeve: Sleeve) -> int:
    """±1: the way in which its spring pushes a sleeve, against the thrust of its bearings."""
    return -next(seat.thrust for seat in spindle.seats if seat.name in sleeve.bearings)


def _in_housing(spindle: Spindle, way: int = 0) -> list[BearingSeat]:
    """Seats in the housing: those that a push of the shaft in a ``way`` ±1 loads, or all."""
    return [
        seat
        for seat in spindle.seats
        if spindle.sleeve_of(seat.name) is None
        and (way in (0, seat.thrust) or seat.bearing.both_ways)
    ]


def _state(model: BallBearing, d: float, growth: float) -> BearingState:
    """A bearing at rest whose free rings are brought together by ``d`` [m]."""
    motion = [[d + _gain(model, growth), 0.0, 0.0, 0.0, 0.0]]
    return model.equilibrium(displacement=motion, static_growth=growth, compiled=False)


def _load(state: BearingState) -> float:
    """Its axial load [N]; ``HEAVIEST`` where it is crushed."""
    load = float(state.load[0, 0])
    if not math.isfinite(load):
        load = math.copysign(HEAVIEST, state.displacement[0, 0])
    return load if state.operation.grooves.both_ways else max(load, 0.0)


def _gain(model: BallBearing, growth: float) -> float:
    """Play that growth takes up [m]."""
    if model.both_ways:
        return 0.0
    free, angle = model.free_distance, model.free_angle
    return free * (math.sin(angle) - math.sin(math.acos(math.cos(angle) + growth / free)))
