"""Housings: each is one of its two forms, carries what there is, and suits the questions."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.case.checks.names import unique
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.housing import HousingEntry
from rotordyn.case.schema.matrix import entries
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.machine.held import housing_faults
from rotordyn.machine.housing import carried_faults, place_faults, rigid_faults
from rotordyn.machine.support import TABLED
from rotordyn.scene.on_housings import directions_on_housings, obstacles_on_housings

_OF_RIGID = ("x", "mass", "stiffness")


@dataclass(frozen=True, slots=True)
class _Rigid:
    mass: float
    polar_inertia: float
    diametral_inertia: float
    stiffness: dict[tuple[str, str], float]
    damping: dict[tuple[str, str], float]


def housings(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    """All checks of the housings of a spindle file."""
    unique([housing.name for housing in entry.housings], root, ("housings",), faults)
    for index, housing in enumerate(entry.housings):
        way = ("housings", index)
        for sentence in carried_faults(tuple(housing.carries)):
            faults.at(root, (*way, "carries"), sentence)
        if root.at(*way).child("model") is None:
            _rigid(housing, root, way, faults)
        else:
            _reduced(housing, root, way, faults)
    parts = entry.bearings, entry.sleeves, entry.supports, entry.rotors
    for place, sentence in housing_faults(entry.housings, *parts):
        if not sentence.startswith("two housings"):
            faults.at(root, ("housings", place, "carries"), sentence)


def _rigid(entry: HousingEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    missing = [key for key in _OF_RIGID if root.at(*way).child(key) is None]
    for key in missing:
        faults.missing(root, (*way, key), "missing key: it must be given, or model")
    if missing:
        return
    matrices = entries(entry.stiffness), entries(entry.damping)
    for key, matrix in zip(("stiffness", "damping"), matrices, strict=True):
        if any(isinstance(value, tuple) for value in matrix.values()):
            faults.at(root, (*way, key), "a housing does not follow the speed: one value is needed")
    own = _Rigid(entry.mass or 0.0, entry.polar_inertia, entry.diametral_inertia, *matrices)
    for key, sentence in rigid_faults(own):
        faults.at(root, (*way, key), sentence)


def _reduced(entry: HousingEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    for key in (*_OF_RIGID, "damping", "polar_inertia", "diametral_inertia"):
        if root.at(*way).child(key) is not None:
            faults.at_key(root, (*way, key), "given beside model: a housing is one of both")
    if entry.model is not None:
        for sentence in place_faults(entry.model.places, tuple(entry.carries)):
            faults.at(root, (*way, "model"), sentence)


def on_housings(entry: CaseEntry, spindle: SpindleEntry, root: Node, faults: Faults) -> None:
    """The questions and conditions of a case take housings."""
    if not spindle.housings:
        return
    asked = entry.analyses.model_fields_set
    for way, sentence in obstacles_on_housings(entry.conditions.formulation, asked):
        faults.at_key(root, way, sentence)
    named = {
        freedom
        for housing in spindle.housings
        for freedom in _directions(housing)
        if freedom not in TABLED
    }
    loaded = entry.conditions.axial_force != 0.0 or entry.conditions.gravity != "none"
    for sentence in directions_on_housings(named, bool(spindle.bearings), loaded):
        faults.at_key(root, ("spindle",), sentence)


def _directions(entry: HousingEntry) -> set[str]:
    if entry.model is not None:
        return {place.rpartition(".")[2] for place in entry.model.places}
    return {freedom for pair in entries(entry.stiffness) for freedom in pair}
