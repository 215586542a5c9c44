"""The works of the comparison as cases of rotordyn."""

from __future__ import annotations

from collections.abc import Mapping

from bearings.materials import Material
from benchmarks.peer import machine
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.contract import Spec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.case.case import Case
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions

CAMPBELL, RESPONSE, ALL, MAP = "campbell", "one response", "all responses", "map of one response"
WORKS = (CAMPBELL, RESPONSE, ALL, MAP)


BEST = Conditions(accuracy=1e-4)
FINE = Conditions(accuracy=1e-8)
SAME = Conditions(element_length=1.0001 * machine.ELEMENT)  # the peer's elements
SETTINGS = {
    "accuracy 1e-4": BEST,
    "accuracy 1e-8": FINE,
    "60 standard elements": SAME,
}
# Fine where equality with a dense solve is looked for, and with a node at every output only the
# peer's elements.
ASKED = {
    CAMPBELL: (BEST, SAME),
    RESPONSE: (BEST, FINE, SAME),
    ALL: (SAME,),
    MAP: (BEST, FINE, SAME),
}
INPUT = Port("input", "y")


def settings(work: str) -> dict[str, Conditions]:
    """Settings of rotordyn for a work, by name."""
    return {name: own for name, own in SETTINGS.items() if own in ASKED[work]}


def case(
    work: str,
    kind: str,
    setting: Conditions = BEST,
    speeds: tuple[float, ...] | None = None,
    frequencies: tuple[float, ...] = machine.FREQUENCIES,
) -> Case:
    """One of the works on bearings of a ``kind``; speeds [rad/s] of the work if none are given."""
    own: tuple[float, ...] = {CAMPBELL: machine.SPEEDS, MAP: machine.MAP_SPEEDS}.get(
        work, (machine.SPEED,)
    )
    name, asked = _question(work, frequencies)
    built = spindle(kind, every_node=work == ALL)
    return Case("peer", work, speeds or own, {name: asked}, setting, built)


def _question(work: str, frequencies: tuple[float, ...]) -> tuple[str, Spec]:
    if work == CAMPBELL:
        return "campbell", CampbellSpec(machine.BAND, shapes=False)
    return "frf", FrfSpec(frequencies, pairs(work))


def pairs(work: str) -> tuple[tuple[Port, Port], ...]:
    """Responses of a work to a force at the input."""
    nodes = range(machine.NODES) if work == ALL else ()
    every = tuple((Port(f"node {k}", name), INPUT) for k in nodes for name in machine.MOTIONS)
    return every or ((INPUT, INPUT),)


def spindle(kind: str, *, every_node: bool = False) -> Spindle:
    """The machine; ``every_node`` is a named point where all responses are asked for."""
    steel = Material("steel", *machine.STEEL)
    sections = tuple(
        Section(count * machine.ELEMENT, outer, inner, steel)
        for count, outer, inner in machine.SECTIONS
    )
    points = {"input": machine.STATIONS[machine.INPUT]}
    if every_node:
        points |= {f"node {k}": x for k, x in enumerate(machine.STATIONS)}
    return Spindle("peer", Shaft(0.0, sections), supports=_supports(kind), points=points)


def _supports(kind: str) -> tuple[LinearSupport, ...]:
    return tuple(
        LinearSupport(f"bearing {node}", machine.STATIONS[node], *map(_entries, both))
        for node, both in machine.supports(kind).items()
    )


def _entries(given: machine.Entries) -> Mapping[tuple[str, str], float]:
    return {(name[0], name[1]): value for name, value in given.items()}
