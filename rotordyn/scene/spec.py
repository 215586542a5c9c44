"""What every spec of an analysis has in common: rules against the machine that it is applied to."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearings.bearing import BallBearing
from rotordyn.description import Description, Faults, Path, known
from rotordyn.machine.assembly import unknown
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.station import on_the_shaft
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.heat_flow import HeatFlow


@dataclass(frozen=True, slots=True)
class Setting:
    """The machine of a case, how it is modelled, and the speeds [rad/s]."""

    spindle: Spindle
    conditions: Conditions
    speeds: tuple[float, ...]

    @property
    def loaded(self) -> bool:
        """Whether static loads act across the axis on the state of the bearings."""
        return acts_across(self.spindle, self.conditions)

    @property
    def top(self) -> float:
        """The highest speed [rad/s], infinite where there is none; NaN where not all are known."""
        return max(self.speeds, default=math.inf) if all(map(known, self.speeds)) else math.nan

    def within(self, speed: float) -> bool:
        """Return whether a speed lies within those of the case, as far as these are known."""
        if not self.speeds or math.isnan(self.top):
            return True
        return not (speed < min(self.speeds) - 1e-6 or speed > self.top + 1e-6)


def acts_across(spindle: Spindle, conditions: Conditions) -> bool:
    """Return whether loads, weight or misaligned seats act across the axis on the bearings."""
    loads = [load.on_axis for load in conditions.loads]
    acting = [*conditions.pull[1:], *(value for load in loads for value in (*load[1:3], *load[4:]))]
    acting += [value for seat in spindle.seats for value in seat.misalignment.offset]
    return bool(spindle.seats) and any(value for value in acting if known(value))


class Spec(Description):
    """What a case requests of one analysis."""

    __slots__ = ()

    def faults_on(self, setting: Setting) -> Faults:
        """Return contradictions with the machine: path of keys from the spec on, and a sentence."""
        return ()

    def last_faults_on(self, setting: Setting) -> Faults:
        """Return contradictions that only a computation shows; all else must be right."""
        return ()

    def last_faults_of(self, bearing: BallBearing) -> Faults:
        """Return contradictions with a single bearing that only a computation shows."""
        return ()

    @property
    def heat_flows(self) -> tuple[HeatFlow, ...]:
        """Heat flows that the spec itself gives."""
        return ()

    @property
    def heats(self) -> bool:
        """Whether it changes the temperatures of the conditions."""
        return False


def redundant_support_faults(setting: Setting) -> Faults:
    """Yield a fault where rigid supports make a rigid rotor statically indeterminate."""
    from rotordyn.equation.restraint import has_redundant_supports

    if setting.conditions.rotor == "rigid" and has_redundant_supports(setting.spindle):
        yield (
            (),
            "the reactions of a rigid rotor on these rigid supports are statically indeterminate: "
            "take rotor: flexible, or give a support a stiffness",
        )


def placed(at: str | float, spindle: Spindle, path: Path, *, rotors: bool = False) -> Faults:
    """Yield a fault where a point is not known or a station [m] not on the shaft.

    ``rotors``: points of further rotors are allowed too.
    """
    if not isinstance(at, str):
        yield from on_the_shaft("load", at, spindle.shaft.reach, path)
        return
    points = [*(spindle.places if rotors else spindle.points)]
    for sentence in unknown("point", at, points, "or a station"):
        yield path, sentence


def turning(at: str | float, spindle: Spindle, path: Path) -> Faults:
    """Yield a fault where an unbalance is on a rotor that stands still."""
    if isinstance(at, str) and at not in spindle.places:
        return
    rotor = spindle.place(at).rotor
    if spindle.ratios[rotor] == 0.0:
        yield path, f"rotor '{rotor}' does not turn, and no unbalance acts there"


def span_faults(
    start: str | float, to: str | float, spindle: Spindle, path: Path, *, rotors: bool = False
) -> Faults:
    """Yield faults of a span: both ends must exist on one rotor, the second behind the first."""
    faults = [*placed(start, spindle, (*path, "from"), rotors=rotors)]
    faults += placed(to, spindle, (*path, "to"), rotors=rotors)
    yield from faults
    if faults or "" in (start, to):
        return
    first, last = spindle.place(start), spindle.place(to)
    if last.x <= first.x:
        yield (*path, "to"), "no length left: allowed: a station behind that of from"
    if first.rotor != last.rotor:
        rotors_given = f"given {first.rotor} and {last.rotor}"
        yield (*path, "to"), f"both must be on one rotor: {rotors_given}"
