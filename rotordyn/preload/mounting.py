"""From the free set to the mounted one: ring offset, force, and what fits add to both.

The axial displacement of a bearing counts from where it carries nothing, static growth included;
growth Δu0 closes the contact angle, cos α' = cos α + Δu0/BD, which takes up BD (sin α − sin α') of
the play of the free bearing. Rings brought together by an offset thus press by the offset and what
growth takes up on both sides.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotordyn.errors import InvalidInput
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.growth import static_growth

LIGHTEST, HEAVIEST = 1e-3, 1e7  # N, between which a preload is sought
LONGEST = 1e-3  # m


def mounted_preload(spindle: Spindle, sleeve: Sleeve) -> float:
    """Force of a sleeve's spring at rest, as mounted [N].

    Raises
    ------
    InvalidInput : the set has play as mounted, or nothing stands against it
    """
    spring = sleeve.spring
    if spring.offset is None and not spring.free:
        return spring.preload
    offset = spring.offset
    if offset is None:
        offset = class_offset(spindle, sleeve, spring.preload)
    both = sides(spindle, sleeve)
    total = offset + sum(side.gained for side in both)

    def over(force: float) -> float:
        return sum(side.approach(force) for side in both) - total

    if over(LIGHTEST) >= 0.0:
        raise InvalidInput(
            f"sleeve {sleeve.name}: an offset of {offset * 1e6:.3g} µm leaves play in its bearings "
            f"as mounted ({total * 1e6:.3g} µm with what the fits take up): give a larger one"
        )
    light = LIGHTEST
    while (excess := over(10.0 * light)) < 0.0 and light < HEAVIEST:
        light *= 10.0
    if not excess >= 0.0:
        raise InvalidInput(
            f"sleeve {sleeve.name}: an offset of {offset * 1e6:.3g} µm presses its bearings beyond "
            f"what they bear ({total * 1e6:.3g} µm with what the fits take up): give a smaller one"
        )
    from scipy.optimize import brentq

    return float(brentq(over, light, 10.0 * light, xtol=1e-12, rtol=1e-14))


def ring_offset(spindle: Spindle, sleeve: Sleeve, force: float) -> float:
    """Axial offset of the free rings that presses with ``force`` [N] as mounted [m]."""
    return sum(side.approach(force) - side.gained for side in sides(spindle, sleeve))


def class_offset(spindle: Spindle, sleeve: Sleeve, force: float) -> float:
    """Axial offset of the free rings of a pair, one bearing on each side, under ``force`` [N] [m].

    A maker grinds it on every bearing of a class: sets of more bearings have the same.
    """
    load = [[force, 0.0, 0.0, 0.0, 0.0]]
    pair = [side.seats[0].bearing for side in sides(spindle, sleeve)]
    return sum(float(b.equilibrium(load=load, compiled=False).displacement[0, 0]) for b in pair)


@dataclass(frozen=True, eq=False)
class Side:
    """Bearings that press one way."""

    spindle: Spindle
    seats: Sequence[BearingSeat]

    @cached_property
    def growths(self) -> list[float]:
        """Static growth of each [m]."""
        return [static_growth(self.spindle, seat) for seat in self.seats]

    @property
    def gained(self) -> float:
        """Mean play that growth takes up [m]."""
        return float(np.mean([_gain(*each) for each in zip(self.seats, self.growths, strict=True)]))

    def approach(self, force: float) -> float:
        """Axial displacement of the mounted bearings under ``force`` altogether, the mean of what
        they gained being its zero [m]."""
        first, each = (
            self.spindle.mounted(self.seats[0]),
            [*zip(self.seats, self.growths, strict=True)],
        )
        if len({(self.spindle.mounted(seat), growth) for seat, growth in each}) == 1:
            own = [[force / len(each), 0.0, 0.0, 0.0, 0.0]]
            state = first.equilibrium(load=own, static_growth=self.growths[0], compiled=False)
            return float(state.displacement[0, 0])
        gained = self.gained

        def load(d: float) -> float:
            total = 0.0
            for seat, growth in each:
                own = d + _gain(seat, growth) - gained
                state = self.spindle.mounted(seat).equilibrium(
                    displacement=[[own, 0.0, 0.0, 0.0, 0.0]], static_growth=growth, compiled=False
                )
                total += float(state.load[0, 0])
            return total

        from scipy.optimize import brentq

        return float(brentq(lambda d: load(d) - force, -LONGEST, LONGEST, xtol=1e-15))


def sides(spindle: Spindle, sleeve: Sleeve) -> tuple[Side, Side]:
    """Bearings on the sleeve, and those in the housing that they press against.

    Raises
    ------
    InvalidInput : there is none of the latter
    """
    own = [seat for seat in spindle.seats if seat.name in sleeve.bearings]
    carried = {name for each in spindle.sleeves for name in each.bearings}
    facing = [s for s in spindle.seats if s.name not in carried and s.thrust != own[0].thrust]
    if not facing:
        raise InvalidInput(
            f"sleeve {sleeve.name}: nothing in the housing takes the thrust of its bearings: a "
            "preload by offset or by class needs bearings that face them"
        )
    return Side(spindle, own), Side(spindle, facing)


def _gain(seat: BearingSeat, growth: float) -> float:
    bearing = seat.bearing
    free, angle = bearing.free_distance, bearing.free_angle
    if bearing.both_ways:
        return 0.0
    return free * (math.sin(angle) - math.sin(math.acos(math.cos(angle) + growth / free)))
