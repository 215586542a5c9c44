"""Preload of a mounted set from the free one: ring offset, force, and the effect of fits on both.

The axial displacement of a bearing is zero where it just carries no load, static growth included;
growth Δu0 changes the contact angle, cos α' = cos α + Δu0/BD, which reduces the play of the free
bearing by BD (sin α − sin α'). Rings brought together by an offset are thus compressed by the
offset and by what growth takes up on both sides.
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

LIGHTEST = 1e-3  # N: a set with less preload has play
HEAVIEST = 1e7  # N: more than any bearing carries
LONGEST = 1e-3  # m
EXACT = 1e-20  # m


def mounted_preloads(spindle: Spindle) -> list[float]:
    """Return the spring force of every sleeve at rest, as mounted [N].

    Offsets locate sleeves relative to the housing. The shaft lies where their forces and those of
    all other springs balance.

    Raises
    ------
    InvalidInput : a set has play as mounted, or nothing opposes it
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

    directions = [spring_direction(spindle, sleeve) for sleeve in spindle.sleeves]
    by_offset = {k: sides(spindle, spindle.sleeves[k])[0] for k in offsets}
    housing = Side(spindle, _in_housing(spindle))
    spring_force = sum(
        w * f for k, (w, f) in enumerate(zip(directions, forces, strict=True)) if k not in by_offset
    )

    def residual(x: float) -> float:
        """Return the force that the shaft at ``x`` lacks for equilibrium [N]."""
        pushes = (side.push(x - directions[k] * offsets[k]) for k, side in by_offset.items())
        return housing.push(x) + sum(pushes) - spring_force

    if not residual(-LONGEST) <= 0.0 <= residual(LONGEST):
        raise InvalidInput(
            f"sleeves {', '.join(sleeve.name for sleeve in spindle.sleeves)}: together they "
            "overload the bearings: lower their preloads"
        )
    shaft = float(brentq(residual, -LONGEST, LONGEST, xtol=EXACT))
    for k, side in by_offset.items():
        x = shaft - directions[k] * offsets[k]
        forces[k] = -directions[k] * side.push(x)
        overloaded = side.overloaded(x) or housing.overloaded(shaft)
        _require_pressed(spindle, spindle.sleeves[k], offsets[k], forces[k], overloaded=overloaded)
    return forces


def _require_pressed(
    spindle: Spindle, sleeve: Sleeve, offset: float, force: float, *, overloaded: bool
) -> None:
    """Raise InvalidInput unless ``force`` [N] by an ``offset`` [m] is positive and not too high."""
    if force > LIGHTEST and not overloaded:
        return
    total = offset + sum(side.gained for side in sides(spindle, sleeve))
    what, remedy = "leaves clearance in its bearings as mounted", "a larger one"
    if overloaded:
        what, remedy = "overloads its bearings", "a smaller one"
        remedy += ", or lower the preloads of the other sleeves" * (len(spindle.sleeves) > 1)
    raise InvalidInput(
        f"sleeve {sleeve.name}: an offset of {offset * 1e6:.3g} µm {what} "
        f"({total * 1e6:.3g} µm with the expansion by the fits): give {remedy}"
    )


def ring_offset(spindle: Spindle, sleeve: Sleeve, force: float) -> float:
    """Return the axial offset of the free rings that presses with ``force`` [N] as mounted,
    together with all other sleeves [m].

    Raises
    ------
    InvalidInput : no bearing in the housing opposes it
    """
    on_sleeve, facing = sides(spindle, sleeve)
    direction, opposing = spring_direction(spindle, sleeve), force
    if len(spindle.sleeves) > 1:
        preloads = zip(spindle.sleeves, mounted_preloads(spindle), strict=True)
        opposing += direction * sum(
            spring_direction(spindle, s) * f for s, f in preloads if s != sleeve
        )
    if opposing < 0.0:  # the others push harder, against bearings of the same thrust
        same_thrust = Side(spindle, _in_housing(spindle, -direction))
        return on_sleeve.approach(force, -direction) - same_thrust.approach(-opposing, -direction)
    return on_sleeve.approach(force, -direction) + facing.approach(opposing, direction)


def class_offset(spindle: Spindle, sleeve: Sleeve, force: float) -> float:
    """Return the axial offset of the free rings of a pair, one bearing on each side, under
    ``force`` [N] [m].

    The maker grinds it on every bearing of a class: sets of more bearings have the same.
    """
    load = [[force, 0.0, 0.0, 0.0, 0.0]]
    pair = [side.seats[0].bearing for side in sides(spindle, sleeve)]
    return sum(float(b.equilibrium(load=load, compiled=False).displacement[0, 0]) for b in pair)


def _offset(spindle: Spindle, sleeve: Sleeve) -> float:
    offset = sleeve.spring.offset
    return class_offset(spindle, sleeve, sleeve.spring.preload) if offset is None else offset


@dataclass(frozen=True, eq=False)
class Side:
    """Bearings between the shaft and one body."""

    spindle: Spindle
    seats: Sequence[BearingSeat]

    @cached_property
    def _alike(self) -> Counter[tuple[BallBearing, int, float]]:
        """Number of bearings of each model, thrust direction and static growth [m]."""
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
        """Return the force of the shaft on the body towards +x [N] where the shaft is shifted by
        ``x`` [m] from the position at which the free rings have neither load nor play."""
        return sum(
            count * thrust * _load(_state(model, thrust * x, growth))
            for (model, thrust, growth), count in self._alike.items()
        )

    def overloaded(self, x: float) -> bool:
        """True if a contact pressure at ``x`` exceeds the range of valid results."""
        states = (_state(model, thrust * x, growth) for model, thrust, growth in self._alike)
        peak = [np.fmax(s.inner_pressure, s.outer_pressure).max() for s in states]
        return not np.max(peak) <= HIGHEST_PRESSURE  # NaN, without a state, is an overload too

    def approach(self, force: float, way: int) -> float:
        """Return the approach of the free rings [m] where the shaft pushes with ``force`` [N] in
        the direction ``way``, ±1, that loads the bearings."""
        ((model, _, growth), count), *further = self._alike.items()
        if not further:
            load = [[force / count, 0.0, 0.0, 0.0, 0.0]]
            state = model.equilibrium(load=load, static_growth=growth, compiled=False)
            return float(state.displacement[0, 0]) - _gain(model, growth)
        from scipy.optimize import brentq

        def excess(d: float) -> float:
            return way * self.push(way * d) - force

        return float(brentq(excess, -LONGEST, LONGEST, xtol=EXACT))


def sides(spindle: Spindle, sleeve: Sleeve) -> tuple[Side, Side]:
    """Return the bearings on the sleeve, and those in the housing that oppose them.

    Raises
    ------
    InvalidInput : no bearing in the housing opposes the sleeve
    """
    on_sleeve = [seat for seat in spindle.seats if seat.name in sleeve.bearings]
    facing = _in_housing(spindle, spring_direction(spindle, sleeve))
    if not facing:
        raise InvalidInput(
            f"sleeve {sleeve.name}: no bearing in the housing takes the thrust of its bearings: a "
            "preload by offset or by class needs bearings that oppose them"
        )
    return Side(spindle, on_sleeve), Side(spindle, facing)


def spring_direction(spindle: Spindle, sleeve: Sleeve) -> int:
    """Return the direction ±1 in which the spring pushes a sleeve, against its bearings' thrust."""
    return -next(seat.thrust for seat in spindle.seats if seat.name in sleeve.bearings)


def _in_housing(spindle: Spindle, direction: int = 0) -> list[BearingSeat]:
    """Return the seats in the housing that a push of the shaft in ``direction`` loads, or all."""
    return [
        seat
        for seat in spindle.seats
        if spindle.sleeve_of(seat.name) is None
        and (direction in (0, seat.thrust) or seat.bearing.both_ways)
    ]


def _state(model: BallBearing, d: float, growth: float) -> BearingState:
    """Return the state of a bearing at rest whose free rings are brought together by ``d`` [m]."""
    motion = [[d + _gain(model, growth), 0.0, 0.0, 0.0, 0.0]]
    return model.equilibrium(displacement=motion, static_growth=growth, compiled=False)


def _load(state: BearingState) -> float:
    """Return the axial load of a state [N]; ``HEAVIEST`` where the bearing is crushed."""
    load = float(state.load[0, 0])
    if not math.isfinite(load):
        load = math.copysign(HEAVIEST, state.displacement[0, 0])
    return load if state.operation.grooves.both_ways else max(load, 0.0)


def _gain(model: BallBearing, growth: float) -> float:
    """Return the play that growth takes up [m]."""
    if model.both_ways:
        return 0.0
    free, angle = model.free_distance, model.free_angle
    return free * (math.sin(angle) - math.sin(math.acos(math.cos(angle) + growth / free)))
