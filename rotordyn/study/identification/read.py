"""Read files of identifications and check them against their case; report every fault."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from rotordyn import units
from rotordyn.case.case import Case
from rotordyn.case.expand import opened
from rotordyn.case.faults import Faults
from rotordyn.case.forms import reading_of
from rotordyn.case.identification import (
    KINDS,
    IdentificationFile,
    PhaseEntry,
    PredictedEntry,
    UnknownEntry,
)
from rotordyn.case.node import Node
from rotordyn.case.paths import found_at
from rotordyn.case.reading import Reading
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.quantity import suggestion
from rotordyn.study.identification.kinds import MADE
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.models import Phase
from rotordyn.study.identification.prediction import Predicted
from rotordyn.study.identification.solve import Asked, asked
from rotordyn.study.identification.unknown import Unknown, sought
from rotordyn.study.read import case_of, value_at
from rotordyn.units import parse


def read_identification(path: str | Path) -> Asked:
    """Read the identification in a YAML file.

    Raises
    ------
    InvalidInput : faults of the file, each with its line; or those of its case
    """
    file = Path(path).expanduser()
    root, reader = opened(file)
    reading = reading_of(reader)
    unread = dict.fromkeys(("unknowns", "measurements", "hypotheses", "phases", "predict"), Any)
    given = reading.fields(IdentificationFile, root, annotations=unread)
    reader.faults.require_none(root.file)
    case = case_of(given["case"], root)
    case = replace(case, name=file.stem, title=given["title"] or case.title)
    parts: dict[str, Any] = {
        "unknowns": _each(reading, root, "unknowns", case, _unknown),
        "measurements": [*_each(reading, root, "measurements", file.parent, _measured).values()],
        "hypotheses": _each(reading, root, "hypotheses", case, _values),
        "phases": _each(reading, root, "phases", case, _phase),
        "predict": _predicted(reading, root),
    }
    reader.faults.require_none(root.file)
    settings = {key: given[key] for key in ("profiles", "criterion", "minimise", "starts", "seed")}
    try:
        return asked(case, **parts, **settings)
    except InvalidInput as refusal:
        faults = Faults()
        place = _place(root, parts, str(refusal))
        faults.at(root.at(*place), _bare(str(refusal), place))
        raise InvalidInput(faults.reported) from None


def _bare(why: str, place: tuple[str, ...]) -> str:
    """Remove the keys with which a sentence begins."""
    names = [f"{word}{key}: " for key in place for word in ("", "measurement ", "phase ")]
    return why.removeprefix(next((name for name in names if why.startswith(name)), ""))


def _place(root: Node, parts: dict[str, Any], why: str) -> tuple[str, ...]:
    """Keys of the entry that a sentence names."""
    for each in parts["measurements"]:
        if why.startswith(f"measurement {each.data.name}:"):
            return "measurements", each.data.name
    for key in ("unknowns", "hypotheses"):
        for path in parts[key]:
            if why.startswith(f"{path}:"):
                return key, path
    for name in parts["phases"]:
        if why.startswith(f"phase {name}:"):
            return "phases", name
    if any(why.startswith(f"'{each.of}':") for each in parts["predict"]):
        return ("predict",)
    word = why.partition(":")[0]
    return (word,) if root.child(word) else ()


def _each(reading: Reading, root: Node, key: str, beside: Any, make: Any) -> dict[str, Any]:
    """Build the entries of a mapping of the file by ``make``; faults are collected."""
    node = root.child(key)
    if node is None:
        return {}
    if not isinstance(node.value, dict):
        reading.wrong_shape(dict, node, "a mapping (name: …)")
        return {}
    entries = {}
    for name, child in node.value.items():
        faults_before = reading.faults.count
        entry = make(reading, beside, str(name), child)
        if reading.faults.count == faults_before:
            entries[str(name)] = entry
    return entries


def _unknown(reading: Reading, case: Case, path: str, node: Node) -> Any:
    if not isinstance(node.value, dict):
        return reading.wrong_shape(UnknownEntry, node, "two ends: {from: …, to: …}")
    unread = dict.fromkeys(("start_of_range", "to", "prior", "deviation", "start"), Any)
    faults_before = reading.faults.count
    given = reading.fields(UnknownEntry, node, annotations=unread)
    values = {
        key: value_at(reading, case, path, child)
        for key in ("from", "to", "prior", "start")
        if (child := node.child(key)) is not None
    }
    deviation = node.child("deviation")
    quantity = next((quantity_of(declared) for _, declared in found_at(case, path)), None)
    if deviation is not None and quantity is not None:
        try:
            kind = units.DIFFERENCE.get(quantity.kind, quantity.kind)
            values["deviation"] = parse(deviation.value, kind)
        except InvalidInput as refusal:
            reading.faults.at(deviation, str(refusal))
    elif deviation is not None:
        values["deviation"] = deviation.plain()
    if reading.faults.count > faults_before or any(
        values.get(key) is None for key in ("from", "to")
    ):
        return None
    ends = [(values.pop(key), node.child(key)) for key in ("from", "to")]
    # keep the text: its unit is used in summary, tables and figures
    low, high = (n.value if n is not None and isinstance(n.value, str) else v for v, n in ends)
    unknown = Unknown(low, high, **values, also=tuple(given["also"]), name=given["name"] or "")
    try:
        sought(case, {path: unknown})
    except InvalidInput as refusal:
        reading.faults.at_key(node, str(refusal).removeprefix(f"{path}: "))
    return unknown


def _measured(reading: Reading, folder: Path, name: str, node: Node) -> Measurement | None:
    kind = node.child("kind") if isinstance(node.value, dict) else None
    if kind is None or not isinstance(kind.value, str) or kind.value not in KINDS:
        word = "" if kind is None else kind.raw or units.shown(kind.plain())
        reason = f"unknown kind '{word}'" if word else "missing key: kind"
        allowed = f"{reason}; allowed: {', '.join(KINDS)}{suggestion(word, KINDS)}"
        reading.faults.at(node.at("kind"), allowed)
        return None
    faults_before = reading.faults.count
    given = reading.fields(KINDS[kind.value], node)
    if reading.faults.count > faults_before:
        return None
    try:
        made = MADE[kind.value](name, given, folder)
        assert made.data is not None
        return made
    except InvalidInput as refusal:
        reading.faults.at(node, str(refusal).removeprefix(f"measurement {name}: "))
        return None


def _values(reading: Reading, case: Case, path: str, node: Node) -> Any:
    if not isinstance(node.value, list) or not node.value:
        return reading.wrong_shape(list, node, "a list of at least one value")
    return [value_at(reading, case, path, item) for item in node.value]


def _phase(reading: Reading, case: Case, name: str, node: Node) -> Phase | None:
    if not isinstance(node.value, dict):
        reading.wrong_shape(PhaseEntry, node, "a mapping: {unknowns: […], values: {path: value}}")
        return None
    given = reading.fields(PhaseEntry, node, annotations={"values": Any})
    held, unknowns = node.child("values"), given["unknowns"]
    if held is not None and not isinstance(held.value, dict):
        reading.wrong_shape(dict, held, "a mapping (path: value)")
    values = {
        path: value_at(reading, case, path, child) for path, child in node.entries("values").items()
    }
    return Phase(None if unknowns is None else tuple(unknowns), values)


def _predicted(reading: Reading, root: Node) -> tuple[Predicted, ...]:
    node = root.child("predict")
    if node is not None and not isinstance(node.value, list):
        reading.wrong_shape(list, node, "a list of numbers: [{of: …}]")
    predictions = []
    for item in root.listed("predict"):
        if not isinstance(item.value, dict):
            reading.wrong_shape(PredictedEntry, item, "a mapping: {of: …}")
            continue
        faults_before = reading.faults.count
        given = reading.fields(PredictedEntry, item)
        if reading.faults.count == faults_before:
            predictions.append(Predicted(**given))
    return tuple(predictions)
