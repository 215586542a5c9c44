"""Further rotors: each whole in itself, held, and fit for the questions."""

from __future__ import annotations

from rotordyn.case.checks.joint import joints
from rotordyn.case.checks.names import unique
from rotordyn.case.checks.shaft import (
    Span,
    lumped_names,
    masses,
    on_shaft,
    points_on_shaft,
    sections,
    span,
    wall,
)
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.matrix import entries
from rotordyn.case.schema.rotor import RotorEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.machine.rotor import ends_faults, freedoms_held, misnamed, of_one_rotor, rotor_faults
from rotordyn.machine.support import SPINDLE, LinearSupport, acts
from rotordyn.scene.on_rotors import joined_along, obstacles_of_rotors


def rotors(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    """All checks of the further rotors of a spindle file, and of what supports join."""
    names = [rotor.name for rotor in entry.rotors]
    unique(names, root, ("rotors",), faults)
    for index, rotor in enumerate(entry.rotors):
        _alone(rotor, root.at("rotors", index), faults)
    for place, key, sentence in ends_faults(entry.supports, names):
        faults.at(root, ("supports", place, key), sentence)
    if entry.rotors:
        _without_loss(entry, root, faults)
    held = {name: _held(entry, name) for name in names}
    for place, sentence in rotor_faults(entry.rotors, held):
        if not sentence.startswith("two rotors") and names[place]:
            faults.at(root, ("rotors", place, "name"), sentence)


def _without_loss(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    given: list[tuple[tuple[object, ...], float]]
    given = [(("damping", "loss_factor"), entry.damping.loss_factor)]
    given += [(("supports", k, "loss_factor"), s.loss_factor) for k, s in enumerate(entry.supports)]
    for way, value in given:
        if value:
            faults.at(root, way, of_one_rotor(str(root.at(*way).raw)))


def reaches(entry: SpindleEntry) -> dict[str, Span]:
    """First and last station of every further rotor [m]; nothing where they are misnamed."""
    if misnamed([rotor.name for rotor in entry.rotors]):
        return {}
    return {r.name: span(r.shaft.start, r.shaft.sections) for r in entry.rotors}


def _alone(rotor: RotorEntry, root: Node, faults: Faults) -> None:
    reach = span(rotor.shaft.start, rotor.shaft.sections)
    sections(rotor.shaft.sections, root, ("shaft", "sections"), faults)
    masses(rotor.masses, root, faults)
    lumped_names(rotor.masses, rotor.discs, root, faults)
    for key, what in (("masses", "mass"), ("discs", "disc")):
        for index, item in enumerate(getattr(rotor, key)):
            on_shaft(item.x, reach, what, root, (key, index, "x"), faults)
    for index, disc in enumerate(rotor.discs):
        wall(disc, root, ("discs", index), faults)
    points_on_shaft(rotor.points, reach, root, faults)
    joints(rotor.joints, reach, (), root, faults)


def _held(entry: SpindleEntry, name: str) -> frozenset[str]:
    touching = [support for support in entry.supports if name in support.ends]
    stiff = [pair for s in touching for pair, value in entries(s.stiffness).items() if acts(value)]
    return freedoms_held(stiff, (freedom for s in touching for freedom in s.rigid))


def on_rotors(
    entry: CaseEntry,
    spindle: SpindleEntry,
    supports: list[LinearSupport],
    root: Node,
    faults: Faults,
) -> None:
    """The questions and conditions of a case take further rotors."""
    if not spindle.rotors:
        return
    for way, sentence in obstacles_of_rotors(entry.conditions, entry.analyses.model_fields_set):
        faults.at_key(root, way, sentence)
    if spindle.bearings:
        for sentence in joined_along(supports):
            faults.at_key(root, (SPINDLE,), sentence)
