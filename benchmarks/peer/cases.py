"""The works of the comparison as cases of ours."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from bearings.materials import Material
from benchmarks.peer import machine
from rotordyn.analysis.specs import (
    DIRECT,
    REDUCED,
    CampbellSpec,
    Conditions,
    FrfSpec,
    Port,
    Spec,
)
from rotordyn.case.case import Case
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport

CAMPBELL, RESPONSE, ALL, MAP = "campbell", "one response", "all responses", "map of one response"
WORKS = (CAMPBELL, RESPONSE, ALL, MAP)


class Setting(NamedTuple):
    """A way of ours to do a work."""

    conditions: Conditions
    method: str = REDUCED


BEST = Setting(Conditions(accuracy=1e-4))
FINE = Setting(Conditions(accuracy=1e-8))
SAME = Setting(Conditions(element_length=1.0001 * machine.ELEMENT))  # the peer's elements
EXACT = Setting(Conditions(shaft="exact", accuracy=1e-8))  # axial motion, torsion: elements
DIRECTLY, SAME_DIRECTLY = (Setting(own.conditions, DIRECT) for own in (BEST, SAME))
SETTINGS = {
    "accuracy 1e-4": BEST,
    "accuracy 1e-8": FINE,
    "60 standard elements": SAME,
    "accuracy 1e-4, direct": DIRECTLY,
    "60 standard elements, direct": SAME_DIRECTLY,
}
# Fine where equality with a dense solve is looked for, and with a node at every output only the
# peer's elements.
ASKED = {
    CAMPBELL: (BEST, SAME),
    RESPONSE: (BEST, FINE, SAME, DIRECTLY, SAME_DIRECTLY),
    ALL: (SAME, SAME_DIRECTLY),
    MAP: (BEST, FINE, SAME, DIRECTLY, SAME_DIRECTLY),
}
INPUT = Port("input", "y")


def settings(work: str) -> dict[str, Setting]:
    """Ways of ours to do a work, by name."""
    return {name: own for name, own in SETTINGS.items() if own in ASKED[work]}


def case(
    work: str,
    kind: str,
    setting: Setting = BEST,
    speeds: tuple[float, ...] | None = None,
    frequencies: tuple[float, ...] = machine.FREQUENCIES,
) -> Case:
    """One of the works on bearings of a ``kind``; its own speeds [rad/s] if none are given."""
    own: tuple[float, ...] = {CAMPBELL: machine.SPEEDS, MAP: machine.MAP_SPEEDS}.get(
        work, (machine.SPEED,)
    )
    name, asked = _question(work, frequencies, setting.method)
    built = spindle(kind, every_node=work == ALL)
    return Case("peer", work, speeds or own, {name: asked}, setting.conditions, built)


def _question(work: str, frequencies: tuple[float, ...], method: str) -> tuple[str, Spec]:
    if work == CAMPBELL:
        return "campbell", CampbellSpec(machine.BAND, shapes=False)
    nodes = range(machine.NODES) if work == ALL else ()
    every = tuple((Port(f"node {k}", name), INPUT) for k in nodes for name in machine.MOTIONS)
    return "frf", FrfSpec(frequencies, every or ((INPUT, INPUT),), method=method)


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
