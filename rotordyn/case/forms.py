"""Readers of values with a notation of their own: models by name, matrices, references.

Each function reads a node as its annotation says; ``FORMS`` maps annotations to functions.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

from bearings.bearing import BallBearing
from bearings.materials import Material
from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import MeasuredResponse, Pair, Port
from rotordyn.analyses.measured_spindle import MeasuredSpindle
from rotordyn.analyses.registry import Unusable, analysis, names
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.case import expand
from rotordyn.case.bearings import bearing, seat
from rotordyn.case.case import ByName
from rotordyn.case.document import MAX_DEPTH
from rotordyn.case.expand import Reader
from rotordyn.case.faults import Faults
from rotordyn.case.keys import PortPair
from rotordyn.case.leaf import is_unknown, leaf, limit_of, unknown
from rotordyn.case.machines import read_spindle
from rotordyn.case.matrices import matrix
from rotordyn.case.node import UNKNOWN, Node, Shared, set_paths
from rotordyn.case.ranges import sweep
from rotordyn.case.reading import Reading, unknown_key
from rotordyn.case.uncertain import AS_USUAL, Uncertain, Worded
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput, TooManyFaults
from rotordyn.field import Refused, accept
from rotordyn.machine.housing import ReducedHousing
from rotordyn.machine.matrix import Matrix
from rotordyn.machine.reference import Reference, values_of
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool
from rotordyn.quantity import Quantity, Sweep
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import HYPOTHESES, Conditions
from rotordyn.scene.spec import Spec

SAME_SPEED = 1e-3  # allowed relative difference of the speeds in a record and in the case


def material(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a material."""
    named = reading.files.named(Material, node)
    values = {"": math.nan} if named is None else reading.fields(Material, named)
    return unknown(Material) if any(map(is_unknown, values.values())) else Material(**values)


def tool(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a tool; it is called as its file."""
    if (named := reading.files.named(Tool, node)) is None:
        return unknown(annotation)
    return reading.description(Tool, named, others, name=Path(named.file).stem)


def workpiece(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a workpiece; without a file its coefficients are unknown, and its absence is not
    reported in addition."""
    named = reading.files.named(Workpiece, node)
    faulty = replace(node, value={"coefficients": replace(node, value=UNKNOWN)})
    return reading.description(Workpiece, named or faulty)


def spindle(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a spindle without a tool."""
    tree = expand.spindle(node, {}, reading.files)
    return unknown(annotation) if tree is None else read_spindle(reading, tree, None)[0]


def conditions(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read conditions, and which hypotheses on the balls they state."""
    keys = node.value if isinstance(node.value, dict) else {}
    stated = tuple(key for key in HYPOTHESES if key in keys)
    return reading.description(Conditions, node, others, stated=stated)


def reference(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read known values, in units of their quantity; a single speed applies to all of them."""
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, "a mapping (key: value)")
    quantity = node.child("quantity")
    known = values_of("" if quantity is None else str(quantity.value))
    taken = {"values": known, "conditions": Any}
    values = reading.fields(Reference, node, annotations=taken)
    conditions = node.child("conditions")
    values["conditions"] = {} if conditions is None else reading.given(Conditions, conditions)
    if len(values["speeds"]) == 1:
        values["speeds"] *= len(values["values"])
    return reading.made(Reference, values, node)


def port(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a point and a direction, as ``tip.y``."""
    if not isinstance(node.value, str):
        return reading.wrong_shape(annotation, node, "POINT.DIRECTION such as tip.y")
    try:
        with unchecked():
            return Port.from_text(node.value)
    except InvalidInput as fault:
        reading.faults.at(node, str(fault))
        return unknown(annotation)


def pair(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a response and an excitation."""
    ports: PortPair = reading.description(PortPair, node)
    return ports.response, ports.excitation


def frf(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read the spec of frequency responses; the pairs of a matrix are added to its pairs."""
    matrix, pairs = node.child("matrix"), node.child("pairs")
    if matrix is not None and (pairs is None or isinstance(pairs.value, list)):
        listed = [*node.listed("pairs")]
        seen = {tuple(item.at(key).raw for key in ("response", "excitation")) for item in listed}
        for row, column in product(matrix.listed("responses"), matrix.listed("excitations")):
            if (row.raw, column.raw) not in seen:
                seen.add((row.raw, column.raw))
                listed.append(replace(matrix, value={"response": row, "excitation": column}))
        whole = pairs or matrix
        node.value["pairs"] = replace(whole, value=listed if listed else UNKNOWN)
    _numbered(node.listed("measured"))
    return reading.description(FrfSpec, node)


def measured_spindle(
    reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]
) -> Any:
    """Read a spindle given by measured responses."""
    _numbered(node.listed("responses"))
    return reading.description(MeasuredSpindle, node, others)


def _numbered(responses: list[Node]) -> None:
    """Name measured responses without a name by their number."""
    for index, item in enumerate(responses):
        if isinstance(item.value, dict):
            item.value.setdefault("name", replace(item, value=f"measured {index + 1}"))


def uncertain(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read uncertainties, or the words ``as usual``."""
    if node.value == AS_USUAL:
        return Uncertain(as_usual=True)
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, f"{AS_USUAL}, or a mapping (key: value)")
    return reading.description(Uncertain, node)


def reduced(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a housing with a reduced model from separate files."""
    matrices: dict[str, Any] = dict.fromkeys(
        ("places", "shape", "mass", "stiffness", "damping"), ()
    )
    if (model := node.child("model")) is not None:
        from rotordyn.case.reduced import reduced_model

        matrices |= reduced_model(model, reading)
        node = replace(node, value={**node.value, "model": replace(model, value=UNKNOWN)})
    return reading.description(ReducedHousing, node, others, **matrices)


def measured(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read a measured response, whose values are in a separate file."""
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, "a mapping (key: value)")
    before = reading.faults.count
    values = reading.fields(MeasuredResponse, node)
    if reading.faults.count > before:
        return unknown(MeasuredResponse)
    name, number = node.at("file"), node.child("record")
    path = reading.files.folders[name.file].parent / name.value
    pair = f"{values['response']} / {values['excitation']}"
    try:
        record = read_record(path, pair, number.value if number else None)
    except InvalidInput as fault:
        reading.faults.at(name, f"{name.value}: {fault}")
        with unchecked():
            return MeasuredResponse(**values)  # its pair is still checked against the others
    reading.files.contents[path] = path.read_bytes()
    if record.speed is not None:
        given = node.child("speed")
        if given is not None and abs(values["speed"] - record.speed) > SAME_SPEED * record.speed:
            reading.faults.at(
                given,
                f"{name.value} was measured at {record.speed * RPM.factor:.6g} rpm by its record: "
                f"given {given.value}; leave speed out",
            )
        values["speed"] = record.speed
    values |= {
        "quantity": record.quantity,
        "frequency": record.frequency,
        "real": tuple(value.real for value in record.values),
        "imaginary": tuple(value.imag for value in record.values),
        "coherence": record.coherence,
    }
    return reading.made(MeasuredResponse, values, node)


def by_name(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Read specs by the name of their analysis; one without keys may be empty."""
    if not isinstance(node.value, dict):
        reading.wrong_shape(annotation, node, "a mapping (key: value)")
        return {"": Spec()}
    specs: dict[str, type] = {}
    for name, child in node.value.items():
        try:
            specs[name] = analysis(name).spec
        except Unusable as error:
            reading.faults.at_key(child, str(error))
            continue
        except InvalidInput:
            reading.faults.at_key(child, unknown_key(name, [*names()]))
            continue
        if child.value is None:
            node.value[name] = replace(child, value={})
    if node.value and not specs:
        return {"": Spec()}
    return {name: reading.value(spec, node.value[name]) for name, spec in specs.items()}


def reading_of(files: Reader) -> Reading:
    """Return the reader of the files of a case."""
    return Reading(files, FORMS)


def in_python(annotation: Any, value: object) -> Any:
    """Read a value given in Python as files write it: names, mappings; raises Refused.

    Single values may also be objects and numbers in SI units.
    """
    files, node = Reader(Faults(), folders={"": Path("here")}), _written(value)
    set_paths(node)
    found = None
    with suppress(TooManyFaults):
        found = Reading(files, FORMS, _accepted).value(annotation, node)
    for fault in files.faults.reported:
        place = f".{fault.path}" if fault.path and not fault.file else ""
        raise Refused(str(fault) if fault.file else fault.message, place)
    return found


def _accepted(annotation: Any, value: object) -> Any:
    try:
        return accept(annotation, Node(value, "", 0, 0).plain())
    except Refused:
        if isinstance(limit_of(annotation), Quantity) and isinstance(value, int | float):
            raise  # a number in SI units
        return leaf(annotation, value)  # refused as in files


def _written(value: object, depth: int = 0) -> Node:
    """Node of a value given in Python."""
    if depth > MAX_DEPTH:
        raise Refused(f"nested deeper than {MAX_DEPTH} levels")
    if isinstance(value, Mapping):
        entries = {str(key): _written(each, depth + 1) for key, each in value.items()}
        return Node(entries, "", 0, 0, shared=isinstance(value, Shared))
    if isinstance(value, list | tuple):
        return Node([_written(each, depth + 1) for each in value], "", 0, 0)
    return Node(value, "", 0, 0, raw=str(value))


FORMS: dict[type, Any] = {
    Sweep: sweep,
    Port: port,
    Pair: pair,
    FrfSpec: frf,
    MeasuredSpindle: measured_spindle,
    Material: material,
    Tool: tool,
    Workpiece: workpiece,
    Spindle: spindle,
    BearingSeat: seat,
    Conditions: conditions,
    BallBearing: bearing,
    Matrix: matrix,
    Reference: reference,
    Worded: uncertain,
    ByName: by_name,
    MeasuredResponse: measured,
    ReducedHousing: reduced,
}
