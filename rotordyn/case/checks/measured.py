"""Measured responses of a case: read, and held against what the case asks."""

from __future__ import annotations

from collections.abc import Iterator

from rotordyn.analyses.frf.spec import MeasuredResponse, Port
from rotordyn.case.build.sweep import values
from rotordyn.case.expand import Reader
from rotordyn.case.measured import Record, read_record
from rotordyn.case.node import Node
from rotordyn.case.schema.analyses import FrfEntry, MeasuredEntry
from rotordyn.case.schema.case import CaseEntry
from rotordyn.errors import InvalidInput
from rotordyn.scene.formulation import ROTATING

WAY = ("analyses", "frf", "measured")


def measured(entry: CaseEntry, root: Node, reader: Reader) -> tuple[MeasuredResponse, ...]:
    """The measured responses whose files can be used; faults of the others are reported."""
    asked = entry.analyses.frf
    if asked is None or not asked.measured:
        return ()
    if entry.conditions.formulation == ROTATING:
        reader.faults.at(
            root, WAY, "measured in the fixed frame: given beside rotating; allowed: inertial"
        )
    return tuple(_responses(asked, entry, root, reader))


def _responses(
    asked: FrfEntry, entry: CaseEntry, root: Node, reader: Reader
) -> Iterator[MeasuredResponse]:
    names: set[str] = set()
    for index, one in enumerate(asked.measured):
        way = (*WAY, index)
        name = one.name or f"measured {index + 1}"
        if name in names:
            reader.faults.at(root, (*way, "name"), f"name given twice: '{name}'")
        names.add(name)
        pair, known = (one.response, one.excitation), asked.asked
        if not (one.file and all(place.point for place in pair)):
            continue
        if pair not in known:
            listed = ", ".join(f"{r} / {e}" for r, e in known)
            given = f"given '{pair[0]} / {pair[1]}'"
            reader.faults.at(root, way, f"not a pair of the case: {given}; allowed: {listed}")
            continue
        found = _read(one, root, way, reader)
        if found is None:
            continue
        try:
            yield _response(name, one, found, values(asked.frequencies or ()), values(entry.speeds))
        except InvalidInput as fault:
            reader.faults.at(root, (*way, "file"), f"{one.file}: {fault}")


def _read(one: MeasuredEntry, root: Node, way: tuple[object, ...], reader: Reader) -> Record | None:
    path = reader.folders[root.at(*way, "file").file].parent / one.file
    try:
        found = read_record(path, f"{one.response} / {one.excitation}", one.record)
    except InvalidInput as fault:
        reader.faults.at(root, (*way, "file"), f"{one.file}: {fault}")
        return None
    reader.contents[path] = path.read_bytes()
    return found


def _response(
    name: str,
    one: MeasuredEntry,
    found: Record,
    band: tuple[float, ...],
    speeds: tuple[float, ...],
) -> MeasuredResponse:
    """The description; InvalidInput where it has nothing in common with the computed band."""
    made = MeasuredResponse(
        name=name,
        response=Port(*one.response),
        excitation=Port(*one.excitation),
        speed=one.speed,
        quantity=found.quantity,
        frequency=found.frequency,
        real=tuple(value.real for value in found.values),
        imaginary=tuple(value.imag for value in found.values),
    )
    if speeds and not speeds[0] - 1e-6 <= one.speed <= speeds[-1] + 1e-6:
        raise InvalidInput("its speed is not within the speeds of the case")
    inside = [f for f in made.frequency if band and band[0] <= f <= band[-1]]
    if band and len(inside) < 2:
        raise InvalidInput(
            f"fewer than two frequencies in the band of the case: given {made.frequency[0]:g} to "
            f"{made.frequency[-1]:g} Hz; allowed: {band[0]:g} to {band[-1]:g} Hz"
        )
    return made
