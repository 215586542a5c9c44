"""Read files of studies and optima and check them against their case; report every fault."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotordyn.case.case import Case
from rotordyn.case.expand import opened
from rotordyn.case.faults import Faults
from rotordyn.case.forms import reading_of
from rotordyn.case.library import is_path
from rotordyn.case.node import Node
from rotordyn.case.paths import found_at
from rotordyn.case.read import load
from rotordyn.case.reading import Reading
from rotordyn.case.study import ABSENT, BOUNDS, SPACINGS, OptimumFile, SpanEntry, StudyFile
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.parameter import Span, given_twice, kind_of_model, parameter

if TYPE_CHECKING:
    from rotordyn.study.optimum.problem import Problem
    from rotordyn.study.point import Study


def read_study(path: str | Path) -> Study:
    """Read the study in a YAML file.

    Raises
    ------
    InvalidInput : faults of the file, each with its line; or those of its case
    """
    read = _opened(path, StudyFile)
    from rotordyn.study.solve import study_of  # a slow import, not needed for a file with faults

    settings = {
        name: read.asked[name] for name in ("sampling", "samples", "seed", "analyses", "results")
    }
    try:
        return study_of(read.case, read.varied, **settings)
    except InvalidInput as refusal:
        raise read.refused_at_its_word(refusal) from None


def read_optimum(path: str | Path) -> tuple[Problem, dict[str, Any]]:
    """Read the problem in a YAML file, and the settings of its search.

    Raises
    ------
    InvalidInput : faults of the file, each with its line; or those of its case
    NoSolution : the case itself has no solution
    """
    read = _opened(path, OptimumFile)
    from rotordyn.study.optimum.goals import Goal, Limit
    from rotordyn.study.optimum.problem import as_it_stands
    from rotordyn.study.optimum.solve import problem_of

    wishes: dict[str, list[Any]] = {"goals": [], "limits": []}
    for key, kind in (("goals", Goal), ("limits", Limit)):
        node = read.root.child(key)
        for k, item in enumerate(node.value if node is not None else ()):
            given = item.plain()
            if "absent" in given:
                given["absent"] = given["absent"] == ABSENT[1]
            for bound in BOUNDS & given.keys():
                given[bound] = _in_words(given[bound])
            try:
                wishes[key].append(kind(**given))
            except InvalidInput as refusal:
                raise read.refused((key, k), str(refusal)) from None
    try:  # a sentence on a goal or limit quotes its number, by which its line is found
        problem = problem_of(read.case, read.varied, wishes["goals"], wishes["limits"])
        as_it_stands(problem)
    except InvalidInput as refusal:
        limits_alone = str(refusal).startswith("limit of")
        places = [
            (key, k)
            for key, entries in wishes.items()
            for k, each in enumerate(entries)
            if shown(each.criterion.of) in str(refusal) and not (limits_alone and key == "goals")
        ]
        if places:
            raise read.refused(places[0], str(refusal)) from None
        raise read.refused_at_its_word(refusal) from None
    return problem, {name: read.asked[name] for name in ("trials", "seed")}


def _in_words(bound: Any) -> Any:
    """Turn numbers of a file into text, so that they need a unit where the quantity has one."""
    if isinstance(bound, list):
        return [_in_words(each) for each in bound]
    return str(bound) if isinstance(bound, float | int) else bound


@dataclass(frozen=True)
class _Opened:
    """File of a study or an optimum that has passed the first checks."""

    root: Node
    asked: dict[str, Any]
    case: Case
    varied: dict[str, object]

    def refused(self, at: tuple[Any, ...], why: str) -> InvalidInput:
        """Return the error for a fault at a place of the file."""
        faults = Faults()
        faults.at(self.root.at(*at), why)
        return InvalidInput(faults.reported)

    def refused_at_its_word(self, refusal: InvalidInput) -> InvalidInput:
        """Return the error at the key or path with which the sentence begins, if it does."""
        word = str(refusal).partition(":")[0]
        at: tuple[str, ...] = ("vary", word) if word in self.varied else ()
        if self.root.child(word):
            at = (word,)
        return self.refused(at, str(refusal).removeprefix(f"{word}: " if at else ""))


def _opened(path: str | Path, kind: type) -> _Opened:
    file = Path(path).expanduser()
    root, reader = opened(file)
    reading = reading_of(reader)
    asked = reading.fields(kind, root, annotations={"vary": Any})
    reader.faults.require_none(root.file)
    case = case_of(asked["case"], root)
    case = replace(case, name=file.stem, title=asked["title"] or case.title)
    varied = _varied(reading, case, root.at("vary"))
    reader.faults.require_none(root.file)
    return _Opened(root, asked, case, varied)


def case_of(reference: str, root: Node) -> Case:
    """Load the case that a file names: a file next to it, or one shipped with rotordyn.

    Raises
    ------
    InvalidInput : no such case (reported at its key), or faults of the case
    """
    folder = Path(root.file).parent
    location = folder / Path(reference).expanduser() if is_path(reference) else reference
    try:
        return load(location)
    except InvalidInput as refusal:
        head = f"{location}:1:1: "
        if (reason := str(refusal).removeprefix(head)).startswith("no such file"):
            faults = Faults()
            faults.at(root.at("case"), f"{reason.rstrip()}: given '{reference}'")
            raise InvalidInput(faults.reported) from None
        raise


def _varied(reading: Reading, case: Case, node: Node) -> dict[str, object]:
    """Read values or span of every path; faults are collected with their lines."""
    if not isinstance(node.value, dict) or not node.value:
        reading.faults.at(node, "nothing is varied: map at least one dotted path to values")
        return {}
    for path, why in given_twice(case, node.value):
        reading.faults.at_key(node.at(path), why)
    return {path: _asked(reading, case, path, child) for path, child in node.value.items()}


def _asked(reading: Reading, case: Case, path: str, node: Node) -> object:
    """Read values or span of one path; numbers take the dimension of the field of the case."""
    faults_before = reading.faults.count
    asked: Any = None
    if isinstance(node.value, dict):
        entry = reading.fields(SpanEntry, node, annotations={"start": Any, "to": Any})
        low, high = (value_at(reading, case, path, node.at(key)) for key in ("from", "to"))
        log = entry["spacing"] == SPACINGS[1]
        if reading.faults.count == faults_before:
            asked = Span(low, high, entry["points"], log)
    elif isinstance(node.value, list):
        asked = [value_at(reading, case, path, item) for item in node.value]
        if kind_of_model(case, path):  # model files are relative to the file of the study
            beside = Path(node.file).parent
            asked = [
                str(beside / Path(v).expanduser()) if isinstance(v, str) and is_path(v) else v
                for v in asked
            ]
    else:
        reading.faults.at(node, "a list of values is needed, or a span: {from: …, to: …}")
    if reading.faults.count == faults_before:
        try:
            parameter(case, path, asked)
        except InvalidInput as refusal:
            reading.faults.at_key(node, str(refusal).removeprefix(f"{path}: "))
    return asked


def value_at(reading: Reading, case: Case, path: str, node: Node) -> Any:
    """Read a value of a file: numbers with a dimension need a unit."""
    places = found_at(case, path, absent=True)
    quantity = next((quantity_of(declared) for _, declared in places), None)
    if quantity is None or isinstance(node.value, dict | list):
        return node.plain()
    try:
        return quantity.read(node.value)
    except InvalidInput as refusal:
        reading.faults.at(node, str(refusal))
        return None
