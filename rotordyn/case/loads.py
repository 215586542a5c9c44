"""Loads against the machine they act on: places that exist, loads that something carries.

Each fault comes with its way from the question on, so that files and Python say the same.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.station import SLACK
from rotordyn.machine.support import SPINDLE
from rotordyn.quantity import suggestion
from rotordyn.scene.conditions import Conditions
from rotordyn.units import format_quantity

Way = tuple[str | int, ...]
Fault = tuple[Way, str]


class Asked(Protocol):
    """The question, as an entry of a file or as a Spec."""

    @property
    def loads(self) -> Sequence[Any]: ...
    @property
    def line_loads(self) -> Sequence[Any]: ...
    @property
    def unbalances(self) -> Sequence[Any]: ...
    @property
    def gravity(self) -> str: ...
    @property
    def twist_limits(self) -> Sequence[Any]: ...


class AskedUnbalance(Protocol):
    """The question ``unbalance``, as an entry of a file or as a Spec."""

    @property
    def points(self) -> Sequence[str]: ...
    @property
    def unbalances(self) -> Sequence[Any]: ...
    @property
    def spans(self) -> Sequence[Any]: ...
    @property
    def grade(self) -> Any: ...


def misplaced(
    asked: Asked,
    points: Mapping[str, float],
    reach: tuple[float, float],
    along: str,
    *,
    otherwise: bool = False,
) -> Iterator[Fault]:
    """Unknown points, stations off the shaft, spans without length, weight given twice,
    nothing that acts.

    ``reach``: first and last station of the shaft [m]; ``along``: the gravity of the conditions;
    ``otherwise``: the shaft is loaded besides, by preload, drawbar or an axial force.
    """
    weighed = any(word != "none" for word in (asked.gravity, along))
    if not (asked.loads or asked.line_loads or asked.unbalances or weighed or otherwise):
        yield (), "nothing acts: allowed: at least one of loads, line_loads, unbalances, gravity"
    for key in ("loads", "unbalances"):
        for index, load in enumerate(getattr(asked, key)):
            yield from _place(load.at, points, reach, (key, index, "at"))
    for key in ("line_loads", "twist_limits"):
        for index, span in enumerate(getattr(asked, key)):
            yield from _span(span, points, reach, (key, index))
    if asked.gravity not in ("", "none") and along not in ("", "none"):
        yield (
            ("gravity",),
            f"the weight is given twice: given '{asked.gravity}' beside '{along}' of the "
            "conditions; allowed: one of both",
        )


@dataclass(frozen=True, slots=True)
class Rotors:
    """Where something can be out of balance: named ``points`` (those of a further rotor as
    ``rotor.point``), first and last station of every rotor (``reach``), its ``ratio`` of speed and
    ``centre`` of gravity [m]."""

    points: Mapping[str, Place]
    reach: Mapping[str, tuple[float, float]]
    ratio: Mapping[str, float]
    centre: Mapping[str, float]

    def place(self, at: str | float) -> Place:
        """Not a number where it is unknown."""
        if isinstance(at, str):
            return self.points.get(at, Place("", math.nan))
        return Place(SPINDLE, at)


def rotors_of(spindle: Spindle) -> Rotors:
    """Of a whole machine."""
    from rotordyn.machine.inertia import rotor_inertia  # numpy, which a check seldom needs

    parts = {name: spindle.part(name) for name in spindle.ratios}
    return Rotors(
        points=spindle.places,
        reach={name: (part.shaft.start, part.shaft.end) for name, part in parts.items()},
        ratio=spindle.ratios,
        centre={name: rotor_inertia(part).centre for name, part in parts.items()},
    )


def misplaced_unbalance(asked: AskedUnbalance, rotors: Rotors) -> Iterator[Fault]:
    """Unknown points, stations off the shaft, nothing out of balance, planes of no use, rotors of
    different speeds."""
    stations = {name: place.x for name, place in rotors.points.items()}
    reach = rotors.reach[SPINDLE]
    for index, name in enumerate(asked.points):
        if name and name not in stations:
            known = ", ".join(stations) or "none, there are none here"
            yield (
                ("points", index),
                f"unknown point: given '{name}'; allowed: {known}{suggestion(name, stations)}",
            )
        elif name in asked.points[:index]:
            yield ("points", index), f"repeated: given '{name}'"
    for index, each in enumerate(asked.unbalances):
        yield from _place(each.at, stations, reach, ("unbalances", index, "at"))
    for index, span in enumerate(asked.spans):
        yield from _span(span, stations, reach, ("spans", index))
        yield from _one_rotor((span.start, span.to), rotors, ("spans", index, "to"))
    if not (asked.unbalances or asked.spans or asked.grade):
        yield (), "nothing is out of balance: allowed: at least one of unbalances, spans, grade"
    if asked.grade:
        yield from _planes(asked.grade, rotors)
    yield from _one_speed(asked, rotors)


def _one_rotor(ends: Sequence[str | float], rotors: Rotors, way: Way) -> Iterator[Fault]:
    named = [rotors.place(at).rotor for at in ends]
    if "" not in named and len(set(named)) > 1:
        yield way, f"both must be on one rotor: given {' and '.join(named)}"


def _one_speed(asked: AskedUnbalance, rotors: Rotors) -> Iterator[Fault]:
    """All that is out of balance turns, and at one speed."""
    acting: list[tuple[Way, str | float]]
    acting = [(("unbalances", k, "at"), each.at) for k, each in enumerate(asked.unbalances)]
    acting += [(("spans", k, "from"), each.start) for k, each in enumerate(asked.spans)]
    planes = asked.grade.planes if asked.grade else ()
    acting += [(("grade", "planes", k), at) for k, at in enumerate(planes)]
    first: dict[float, str] = {}
    for way, at in acting:
        rotor = rotors.place(at).rotor
        ratio = rotors.ratio.get(rotor, math.nan)
        if ratio == 0.0:
            yield way, f"rotor '{rotor}' stands still, and no unbalance acts there"
        elif not math.isnan(ratio) and ratio not in first:
            first[ratio] = rotor
            if len(first) > 1:
                others = " and ".join(f"'{name}'" for name in first.values())
                yield way, f"rotors {others} turn at different speeds: ask of one at a time"


def _planes(grade: Any, rotors: Rotors) -> Iterator[Fault]:
    """One or two places on a rotor; of two, one on either side of its centre of gravity."""
    stations = {name: place.x for name, place in rotors.points.items()}
    faults = [
        fault
        for index, at in enumerate(grade.planes)
        for fault in _place(at, stations, rotors.reach[SPINDLE], ("grade", "planes", index))
    ]
    faults += _one_rotor(grade.planes, rotors, ("grade", "planes"))
    yield from faults
    if faults or len(grade.planes) < 2:
        if len(grade.planes) == 1 and grade.phase == "couple":
            yield ("grade", "phase"), "a couple needs two planes: given one"
        return
    places = [rotors.place(at) for at in grade.planes]
    ends, centre = sorted(p.x for p in places), rotors.centre.get(places[0].rotor, math.nan)
    if ends[0] >= centre or ends[1] <= centre:
        yield (
            ("grade", "planes"),
            "the centre of gravity must lie between the two planes: it is at "
            f"{format_quantity(centre, 'mm')}; allowed: one plane on either side, or unbalances "
            "given one by one",
        )


def _place(
    at: str | float, points: Mapping[str, float], reach: tuple[float, float], way: Way
) -> Iterator[Fault]:
    if isinstance(at, str):
        if at and at not in points:
            known = ", ".join(points) or "none, there are none here"
            yield (
                way,
                f"unknown point: given '{at}'; allowed: {known}, or a station"
                + suggestion(at, points),
            )
    elif at < reach[0] - SLACK or at > reach[1] + SLACK:
        ends = " to ".join(format_quantity(end, "mm") for end in reach)
        yield way, f"load off the shaft: given '{format_quantity(at, 'mm')}'; allowed: {ends}"


def _span(
    span: Any, points: Mapping[str, float], reach: tuple[float, float], way: Way
) -> Iterator[Fault]:
    yield from _place(span.start, points, reach, (*way, "from"))
    yield from _place(span.to, points, reach, (*way, "to"))
    first, last = (
        points.get(a, math.nan) if isinstance(a, str) else a for a in (span.start, span.to)
    )
    if last <= first:
        yield (*way, "to"), "no length left: allowed: a station behind that of from"


def overheld(spindle: Spindle, conditions: Conditions) -> Iterator[str]:
    """A sentence where a rigid rotor lies on more rigid supports than can be told apart."""
    from rotordyn.equation.holding import holds_twice

    if conditions.rotor == "rigid" and holds_twice(spindle):
        yield (
            "the reactions of a rigid rotor on these rigid supports are not determined: take "
            "rotor: flexible, or give a support a stiffness"
        )


def unheld(spec: SectionForcesSpec, spindle: Spindle, conditions: Conditions) -> Iterator[Fault]:
    """Loads along motions that nothing holds; the question must have its places on the shaft."""
    from rotordyn.analyses.section_forces.static_loads import require_balance

    try:
        require_balance(spindle, spec, conditions)
    except InvalidInput as fault:
        yield ("loads",), str(fault)
