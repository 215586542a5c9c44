"""Make measurements from the entries of a file: one function for each kind."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import Force, Quantity, Speed
from rotordyn.study.identification.along_axis import AxialCurve, AxialStiffness, NoLoad
from rotordyn.study.identification.measured_modes import Modes
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.numbers import Numbers
from rotordyn.study.identification.points import read_points
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.stop_reached import StopReached

Entry = Mapping[str, Any]
COLUMNS = {
    "speed": quantity_of(Speed),
    "branch": None,
    "force": quantity_of(Force),
    "displacement": Quantity("length", at_least="-100 mm", at_most="100 mm"),
}


def _axial_curve(name: str, given: Entry, folder: Path) -> Measurement:
    numbers, words, places = read_points(folder / given["file"], COLUMNS)
    curve = AxialCurve(
        name=name,
        branch=words["branch"],
        speed=numbers["speed"],
        force=numbers["force"],
        displacement=numbers["displacement"],
        places=places,
        **{key: given[key] for key in ("deviation", "of", "tare", "drift", "lowest", "highest")},
    )
    return curve if given["points"] is None else curve.reduced(given["points"])


def _no_load(name: str, given: Entry, _: Path) -> Measurement:
    return NoLoad(
        name=name,
        deviation=given["deviation"],
        speed=np.array(given["speeds"]),
        displacement=np.array(given["displacements"]),
        of=given["of"],
        tare=given["tare"],
    )


def _axial_stiffness(name: str, given: Entry, _: Path) -> Measurement:
    return AxialStiffness(
        name=name,
        deviation=given["deviation"],
        speed=np.array(given["speeds"]),
        stiffness=np.array(given["stiffnesses"]),
        **{key: given[key] for key in ("branch", "lowest", "highest", "near", "about")},
    )


def _stop_reached(name: str, given: Entry, _: Path) -> Measurement:
    keys = ("deviation", "sleeve", "speed", "force", "lowest", "highest")
    return StopReached(name=name, **{key: given[key] for key in keys})


def _numbers(name: str, given: Entry, _: Path) -> Measurement:
    from rotordyn.study.optimum.criterion import amount

    unit = str(given["values"][0]).strip().partition(" ")[2]
    if not unit:
        raise InvalidInput(f"values: given {shown(given['values'][0])}; needed: with their unit")
    try:
        *values, deviation = [amount(each, unit) for each in (*given["values"], given["deviation"])]
    except InvalidInput as refusal:
        raise InvalidInput(f"values and deviation have one unit: {refusal}") from None
    return Numbers(
        name=name,
        of=given["of"],
        speed=np.array(given["speeds"]),
        values=np.array(values),
        deviation=deviation,
        unit=unit,
        where=given["where"],
        nearest=given["nearest"],
    )


def _responses(name: str, given: Entry, _: Path) -> Measurement:
    return Responses(
        name=name,
        responses=tuple(given["responses"]),
        **{key: given[key] for key in ("noise", "averages", "gain")},
    )


def _modes(name: str, given: Entry, _: Path) -> Measurement:
    dampings = given["dampings"]
    return Modes(
        name=name,
        speed=np.array(given["speeds"]),
        frequency=np.array(given["frequencies"]),
        deviation=given["deviation"],
        damping=None if dampings is None else np.array(dampings),
        damping_deviation=given["damping_deviation"],
        whirl=tuple(given["whirls"] or ()),
    )


MADE: dict[str, Callable[[str, Entry, Path], Measurement]] = {
    "axial curve": _axial_curve,
    "no load": _no_load,
    "axial stiffness": _axial_stiffness,
    "stop reached": _stop_reached,
    "numbers": _numbers,
    "frequency responses": _responses,
    "modes": _modes,
}
