"""Values that files write in forms of their own: models by name, matrices, known values.

Each form reads a node as what its annotation says; which annotation has which form: ``FORMS``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Annotated, Any, get_args

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from bearings.materials import Material
from rotordyn import units
from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.frf.spec import FrfSpec, MeasuredResponse, Pair, Port
from rotordyn.analyses.registry import analysis, names
from rotordyn.case.case import ByName
from rotordyn.case.estimated import estimated
from rotordyn.case.expand import Reader
from rotordyn.case.faults import Faults
from rotordyn.case.keys import MOST_STEPS, Range, bearing_class, keys_of
from rotordyn.case.node import UNKNOWN, Node
from rotordyn.case.reading import Reading, exact, leaf, unknown, unknown_key
from rotordyn.case.reduced import ReducedModel
from rotordyn.case.uncertain import AS_USUAL, Uncertain, Worded
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import Refused, bare
from rotordyn.machine.housing import ReducedHousing
from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.machine.support import DOFS, BearingSeat, Matrix, entry_name
from rotordyn.quantity import Quantity, Sweep, suggestion
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.spec import Spec
from rotordyn.units import format_quantity

ENTRIES = {entry_name(row, column): (row, column) for row, column in product(DOFS, DOFS)}
WHOLE = ("dof", "matrix")
# The kind of quantity read for the unit in which a reference is kept.
KIND_OF_UNIT = {
    "N/m": "stiffness",
    "N": "force",
    "m": "length",
    "Hz": "frequency",
    "1": "ratio",
}


def material(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """A material, its name or path resolved already."""
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, "a name, a path or a mapping")
    values = reading.fields(Material, node)
    numbers = [value for value in values.values() if isinstance(value, float)]
    return unknown(Material) if any(map(math.isnan, numbers)) else Material(**values)


def seat(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """A bearing on the shaft, called by the name that its model has."""
    named = exact(node, ("model", "name"))
    model = named.value if named is not None and isinstance(named.value, str) else ""
    if exact(node, ("model", "estimate")) is not None:
        model += " (estimate)"
    return reading.description(BearingSeat, node, model=model)


def bearing(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """A bearing of any kind; None where its faults are reported."""
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, "a name, a path or a mapping")
    if node.child("estimate") is not None:
        estimate = estimated(reading, node)
        if estimate is not None:
            _rings(reading.faults, node, estimate)
        return estimate
    kind = node.child("kind")
    model = bearing_class(kind.value if kind else None)
    values = reading.fields(model, node)
    optional = {field.name for field in keys_of(model) if field.default is None}
    for name, value in values.items():
        unclear = value.young_modulus if isinstance(value, Material) else value
        if (value is None and name not in optional) or unclear != unclear:
            return None
        if isinstance(value, int) and exact(node, (name,)) is not None and value == 0:
            return None
    try:
        made = model(**values)
    except InvalidBearing as error:
        place, hint = _named(str(error), model, node)
        reading.faults.at(node, place, f"impossible bearing: {error}{hint}")
        return None
    _rings(reading.faults, node, made)
    return made


def _named(sentence: str, model: type[BallBearing], node: Node) -> tuple[tuple[str, ...], str]:
    """The key to change of those that a sentence names, and how to override one of the model.

    Keys that an override gives come first: the model of a library is not the user's to change.
    """
    kind: Any = model
    optional = {field.name for field in keys_of(kind) if field.default is None}
    words = re.findall(r"[a-z_]+", sentence)
    given = [word for word in words if word in model.measures() and node.child(word) is not None]
    written = [word for word in given if node.at(word).file != node.file]
    instead = [word for word in given if word not in written and word in optional]
    hint = ""
    if written and instead and "exactly one" in sentence:
        nulls = ", ".join(f"{word}: null" for word in dict.fromkeys(instead))
        hint = f"; the model gives {instead[0]} already: add {nulls} to the override"
    return tuple((written or given)[:1]), hint


def _rings(faults: Faults, node: Node, made: BallBearing) -> None:
    """Bore and outside leave a ring beside the balls."""
    inner, outer = 2.0 * made.inner_raceway_radius, 2.0 * made.outer_raceway_radius
    for key, side, limit in (
        ("bore_diameter", "below", inner),
        ("outside_diameter", "above", outer),
    ):
        child = node.child(key)
        try:
            value = math.nan if child is None else units.parse(child.value, "length")
        except InvalidInput:
            continue
        if value >= limit if side == "below" else value <= limit:
            faults.at(
                node,
                (key,),
                f"no ring left beside the balls: given '{node.at(key).raw}'; allowed: {side} "
                f"{format_quantity(limit, 'mm')}",
            )


def matrix(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Entries of a 6×6 matrix by pair of DOF, written one by one or whole."""
    marker = next(m for m in annotation.__metadata__ if isinstance(m, Matrix))
    nothing = dict.fromkeys(ENTRIES.values(), math.nan)
    if not isinstance(node.value, dict):
        reading.wrong_shape(annotation, node, "a mapping (key: value)")
        return nothing
    if any(key in node.value for key in WHOLE):
        return _whole(reading, marker, node) or nothing
    tabled = len(get_args(get_args(bare(annotation))[1])) > 1
    entries: dict[tuple[str, str], Any] = {}
    for key, child in node.value.items():
        if key not in ENTRIES:
            reading.faults.at_key(child, (), unknown_key(key, [*WHOLE, *ENTRIES]))
            continue
        pair = ENTRIES[key]
        one = Annotated[float, marker.quantity(*pair)]
        if child.value is None:
            continue
        if isinstance(child.value, list) and tabled:
            entries[pair] = tuple(reading.value(one, item) for item in child.value)
        elif isinstance(child.value, list):
            message = "a housing does not follow the speed: one value is needed"
            reading.faults.at(child, (), message)
        else:
            entries[pair] = reading.value(one, child)
    return entries


def _whole(reading: Reading, marker: Matrix, node: Node) -> dict[tuple[str, str], float]:
    both = [key for key in node.value if key in ENTRIES]
    if both:
        reading.faults.at(
            node,
            (),
            f"both ways of writing a matrix: given {', '.join(both)} beside dof and matrix; "
            "allowed: entries by name, or dof and matrix",
        )
        return {}
    for key, child in node.value.items():
        if key not in WHOLE:
            reading.faults.at_key(child, (), unknown_key(key, [*WHOLE, *ENTRIES]))
    for key in WHOLE:
        if key not in node.value:
            reading.faults.missing(node, (key,), "missing key: it must be given")
    dofs = _dofs(reading, node.child("dof"))
    rows = node.child("matrix")
    if rows is None or not dofs or not _square(reading, rows, len(dofs)):
        return {}
    entries = {}
    for (i, row), (j, column) in product(enumerate(dofs), enumerate(dofs)):
        entries[row, column] = _cell(
            reading, marker.quantity(row, column), rows.at(i, j), row, column
        )
    return entries


def _dofs(reading: Reading, node: Node | None) -> list[str]:
    if node is None or node.value is UNKNOWN:
        return []
    names = node.plain()
    listed = list(map(str, names)) if isinstance(names, list) else []
    if not listed or len(set(listed)) < len(listed) or not set(listed) <= set(DOFS):
        given = units.shown(", ".join(listed) if listed else names)
        reading.faults.at(
            node,
            (),
            f"not DOF: given {given}; allowed: different ones of {', '.join(DOFS)}",
        )
        return []
    return listed


def _square(reading: Reading, node: Node, size: int) -> bool:
    rows = node.plain() if isinstance(node.value, list) else []
    lengths = [len(row) if isinstance(row, list) else 0 for row in rows]
    if lengths == [size] * size:
        return True
    count = (
        f"{len(rows)} rows of {', '.join(map(str, lengths))}" if rows else units.shown(node.plain())
    )
    reading.faults.at(
        node, (), f"not a matrix of its DOF: given {count}; allowed: {size} rows of {size}"
    )
    return False


def _cell(reading: Reading, quantity: Quantity, node: Node, row: str, column: str) -> float:
    """An entry of a matrix; a bare 0 is the same in every unit."""
    value = node.plain()
    if isinstance(value, int | float) and not isinstance(value, bool) and value == 0:
        return 0.0
    try:
        cell: float = leaf(Annotated[float, quantity], value)
    except Refused as refusal:
        reading.faults.at(node, (), f"entry {entry_name(row, column)}: {refusal.why}")
        return math.nan
    return cell


def reduced(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """A housing by its reduced model, which is read from its files already."""
    held = node.child("model")
    model = held.value if held is not None and isinstance(held.value, ReducedModel) else None
    rows: dict[str, Any] = dict.fromkeys(("shape", "mass", "stiffness", "damping"), ())
    places: tuple[str, ...] = ()
    if model is not None:
        rows = {name: tuple(map(tuple, getattr(model, name).tolist())) for name in rows}
        places = model.places
    if held is not None:
        held.value = UNKNOWN
    return reading.description(ReducedHousing, node, others, places=places, **rows)


def reference(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Known values, in units of their quantity; one speed serves them all."""
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, "a mapping (key: value)")
    quantity = exact(node, ("quantity",))
    unit = (
        QUANTITIES.get(quantity.value)
        if quantity is not None and isinstance(quantity.value, str)
        else None
    )
    kind = Quantity(KIND_OF_UNIT[unit]) if unit else Quantity("number")
    keys = keys_of(Reference)
    plain = {field.name: field.annotation for field in keys}
    values = reading.fields(
        Reference,
        node,
        annotations={
            "values": Annotated[
                (
                    tuple[Annotated[float, kind], ...] if unit else tuple[Any, ...],
                    *plain["values"].__metadata__,
                )
            ],
            "conditions": Any,
        },
    )
    conditions = exact(node, ("conditions",))
    values["conditions"] = {} if conditions is None else reading.given(Conditions, conditions)
    if len(values["speeds"]) == 1:
        values["speeds"] *= len(values["values"])
    return reading.made(Reference, values, node)


def sweep(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Ascending values: a list, or a range that runs upwards in whole steps."""
    if isinstance(node.value, list):
        return reading.items(annotation, node)
    if not isinstance(node.value, dict):
        allowed = "a range {from, to, step or count}, or a list"
        return reading.wrong_shape(annotation, node, allowed)
    item = get_args(bare(annotation))[0]
    limits = next(m for m in item.__metadata__ if isinstance(m, Quantity))
    zero = f"0 {units.KINDS[limits.kind][0]}"
    step = Annotated[float, Quantity(limits.kind, above=zero, at_most=limits.at_most)] | None
    taken = {"start": item, "to": item, "step": step}
    before = len(reading.faults.reported)
    swept = Range(**reading.fields(Range, node, annotations=taken))
    if len(reading.faults.reported) == before:
        for path, sentence in _range_faults(swept, units.KINDS[limits.kind][0]):
            reading.at(node, path, sentence)
    if len(reading.faults.reported) > before:
        return unknown(annotation)
    count = swept.count or round((swept.to - swept.start) / (swept.step or math.inf)) + 1
    span = swept.to - swept.start
    return (*(swept.start + span * n / (count - 1) for n in range(count - 1)), swept.to)


def _range_faults(span: Range, unit: str) -> Iterator[tuple[tuple[str, ...], str]]:
    if span.start >= span.to:
        word = "is empty" if span.start == span.to else "is reversed"
        given = "given {given:from} to {given}"
        yield ("to",), f"the range {word}: {given}; allowed: to above from"
    elif (span.step is None) == (span.count is None):
        given = "neither" if span.step is None else "both"
        yield (), f"a range needs either step or count: given {given}"
    elif span.step is not None:
        exact_steps = (span.to - span.start) / span.step
        if exact_steps >= MOST_STEPS:
            yield ("step",), f"more than {MOST_STEPS} steps: given {{given}}"
        elif (
            abs(exact_steps - round(exact_steps)) > 1e-6 * max(1.0, exact_steps)
            or exact_steps < 0.5
        ):
            ends = [span.start + n * span.step for n in (int(exact_steps), int(exact_steps) + 1)]
            low, high = (format_quantity(end, unit) for end in ends)
            yield (
                ("step",),
                "the step does not come out at the end of the range: given {given}; it would end "
                f"at {low} or {high}",
            )


def port(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """A point and a direction, as ``tip.y``."""
    text = node.value if isinstance(node.value, str) else ""
    point, _, direction = text.rpartition(".")
    why = ""
    if not point:
        given = units.shown(node.plain())
        why = f"not a place: given {given}; allowed: POINT.DIRECTION such as tip.y"
    elif direction not in DOFS:
        why = (
            f"unknown direction: given {units.shown(text)}; allowed: {', '.join(DOFS)}"
            f"{suggestion(direction, DOFS)}"
        )
    if why:
        reading.faults.at(node, (), why)
        return unknown(annotation)
    with unchecked():
        return Port(point, direction)


def pair(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """A response and an excitation."""
    ports = []
    if not isinstance(node.value, dict):
        reading.wrong_shape(annotation, node, "a mapping with response and excitation")
        return unknown(Port), unknown(Port)
    keys = ("response", "excitation")
    for key, child in node.value.items():
        if key not in keys:
            reading.faults.at_key(child, (), unknown_key(key, [*keys]))
    for key in keys:
        written = node.child(key)
        if written is None:
            reading.faults.missing(node, (key,), "missing key: it must be given")
        ports.append(unknown(Port) if written is None else reading.value(Port, written))
    return tuple(ports)


def frf(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Frequency responses, the pairs of a matrix among them."""
    matrix, pairs = exact(node, ("matrix",)), exact(node, ("pairs",))
    if matrix is not None and (pairs is None or isinstance(pairs.value, list)):
        listed = [*(pairs.value if pairs is not None else ())]
        seen = {tuple(item.at(key).raw for key in ("response", "excitation")) for item in listed}
        rows, columns = (matrix.child(key) for key in ("responses", "excitations"))
        for row, column in product(
            *(
                held.value if held and isinstance(held.value, list) else ()
                for held in (rows, columns)
            )
        ):
            if (row.raw, column.raw) not in seen:
                seen.add((row.raw, column.raw))
                listed.append(replace(matrix, value={"response": row, "excitation": column}))
        whole = pairs or matrix
        node.value["pairs"] = replace(whole, value=listed if listed else UNKNOWN)
    for index, item in enumerate(_listed(exact(node, ("measured",)))):
        if isinstance(item.value, dict):
            item.value.setdefault("name", replace(item, value=f"measured {index + 1}"))
    return reading.description(FrfSpec, node)


def _listed(node: Node | None) -> list[Node]:
    return node.value if node is not None and isinstance(node.value, list) else []


def by_name(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """Specs by the name of their analysis; one without keys may be left empty."""
    if not isinstance(node.value, dict):
        reading.wrong_shape(annotation, node, "a mapping (key: value)")
        return {"": Spec()}
    specs: dict[str, Any] = {}
    for name, child in node.value.items():
        try:
            spec = analysis(name).spec
        except InvalidInput:
            reading.faults.at_key(child, (), unknown_key(name, [*names()]))
            continue
        entry = replace(child, value={}) if child.value is None else child
        node.value[name] = entry
        specs[name] = reading.value(spec, entry)
    if node.value and not specs:
        return {"": Spec()}
    return specs


def uncertain(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
    """What is uncertain, or the words ``as usual``."""
    if node.value == AS_USUAL:
        return Uncertain(as_usual=True)
    if not isinstance(node.value, dict):
        return reading.wrong_shape(annotation, node, f"{AS_USUAL}, or a mapping (key: value)")
    return reading.description(Uncertain, node)


def measured(files: Reader) -> Any:
    """The form of a measured response, whose values stand in a file of its own."""

    def form(reading: Reading, annotation: Any, node: Node, others: tuple[type, ...]) -> Any:
        if not isinstance(node.value, dict):
            return reading.wrong_shape(annotation, node, "a mapping (key: value)")
        before = len(reading.faults.reported)
        values = reading.fields(MeasuredResponse, node)
        if len(reading.faults.reported) > before:
            return unknown(MeasuredResponse)
        name, number = node.at("file"), exact(node, ("record",))
        path = files.folders[name.file].parent / name.value
        pair = f"{values['response']} / {values['excitation']}"
        try:
            record = read_record(path, pair, number.value if number else None)
        except InvalidInput as fault:
            reading.faults.at(name, (), f"{name.value}: {fault}")
            with unchecked():
                return MeasuredResponse(**values)  # its pair is still held against the others
        files.contents[path] = path.read_bytes()
        values |= {
            "quantity": record.quantity,
            "frequency": record.frequency,
            "real": tuple(value.real for value in record.values),
            "imaginary": tuple(value.imag for value in record.values),
        }
        return reading.made(MeasuredResponse, values, node)

    return form


def reading_of(files: Reader) -> Reading:
    """What reads the files of a case."""
    return Reading(files.faults, {**FORMS, MeasuredResponse: measured(files)})


FORMS: dict[type, Any] = {
    Sweep: sweep,
    Port: port,
    Pair: pair,
    FrfSpec: frf,
    ByName: by_name,
    Material: material,
    BearingSeat: seat,
    BallBearing: bearing,
    Matrix: matrix,
    ReducedHousing: reduced,
    Reference: reference,
    Worded: uncertain,
}
