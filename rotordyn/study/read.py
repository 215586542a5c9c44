"""The door for files of studies and optima: held against their case, or every fault of the file."""

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
from rotordyn.case.read import load
from rotordyn.case.reading import Reading
from rotordyn.case.study import ABSENT, BOUNDS, SPACINGS, OptimumFile, SpanEntry, StudyFile
from rotordyn.case.varied import found_at
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.parameter import Span, kind_of_model, parameter

if TYPE_CHECKING:
    from rotordyn.study.optimum.problem import Problem
    from rotordyn.study.point import Study


def read_study(path: str | Path) -> Study:
    """The study in a YAML file.

    Raises
    ------
    InvalidInput : faults of the file, each with its line; or those of its case
    """
    read = _opened(path, StudyFile)
    from rotordyn.study.solve import study_of  # what a file with faults does not wait for

    how = {
        name: read.asked[name] for name in ("sampling", "samples", "seed", "analyses", "results")
    }
    try:
        return study_of(read.case, read.varied, **how)
    except InvalidInput as refusal:
        raise read.refused_at_its_word(refusal) from None


def read_optimum(path: str | Path) -> tuple[Problem, dict[str, Any]]:
    """The problem in a YAML file, and how it is searched.

    Raises
    ------
    InvalidInput : faults of the file, each with its line; or those of its case
    NoSolution : the case as it stands has none
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
    try:  # sentences on a goal or limit quote what it reads, which finds its line
        problem = problem_of(read.case, read.varied, wishes["goals"], wishes["limits"])
        as_it_stands(problem)
    except InvalidInput as refusal:
        limits_alone = str(refusal).startswith("limit of")
        places = [
            (key, k)
            for key, found in wishes.items()
            for k, each in enumerate(found)
            if shown(each.criterion.of) in str(refusal) and not (limits_alone and key == "goals")
        ]
        if places:
            raise read.refused(places[0], str(refusal)) from None
        raise read.refused_at_its_word(refusal) from None
    return problem, {name: read.asked[name] for name in ("trials", "seed")}


def _in_words(bound: Any) -> Any:
    """A number of a file as text, which needs a unit where what is read has one."""
    if isinstance(bound, list):
        return [_in_words(each) for each in bound]
    return str(bound) if isinstance(bound, float | int) else bound


@dataclass(frozen=True)
class _Opened:
    """A file of a study or an optimum without faults so far."""

    root: Node
    asked: dict[str, Any]
    case: Case
    varied: dict[str, object]

    def refused(self, at: tuple[Any, ...], why: str) -> InvalidInput:
        """A fault at a place of the file."""
        faults = Faults()
        faults.at(self.root.at(*at), why)
        return InvalidInput(faults.reported)

    def refused_at_its_word(self, refusal: InvalidInput) -> InvalidInput:
        """The same at the key or path with which a sentence begins, if it does."""
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
    """The case that a file names: another file beside it, or one that comes with rotordyn.

    Raises
    ------
    InvalidInput : there is none, at its key; or its own faults
    """
    beside = Path(root.file).parent
    named = beside / Path(reference).expanduser() if is_path(reference) else reference
    try:
        return load(named)
    except InvalidInput as refusal:
        none = f"{named}:1:1: "
        if (why := str(refusal).removeprefix(none)).startswith("no such file"):
            faults = Faults()
            faults.at(root.at("case"), f"{why.rstrip()}: given '{reference}'")
            raise InvalidInput(faults.reported) from None
        raise


def _varied(reading: Reading, case: Case, node: Node) -> dict[str, object]:
    """Values or span of every path; faults are reported at their lines."""
    if not isinstance(node.value, dict) or not node.value:
        reading.faults.at(node, "nothing is varied: map at least one dotted path to values")
        return {}
    return {path: _asked(reading, case, path, child) for path, child in node.value.items()}


def _asked(reading: Reading, case: Case, path: str, node: Node) -> object:
    """Values or span of one path, whose ends have the unit of what stands there in the case."""
    before = reading.faults.count
    asked: Any = None
    if isinstance(node.value, dict):
        found = reading.fields(SpanEntry, node, annotations={"start": Any, "to": Any})
        low, high = (value_at(reading, case, path, node.at(key)) for key in ("from", "to"))
        log = found["spacing"] == SPACINGS[1]
        if reading.faults.count == before:
            asked = Span(low, high, found["points"], log)
    elif isinstance(node.value, list):
        asked = [value_at(reading, case, path, item) for item in node.value]
        if kind_of_model(case, path):  # their files stand beside that of the study
            beside = Path(node.file).parent
            asked = [
                str(beside / Path(v).expanduser()) if isinstance(v, str) and is_path(v) else v
                for v in asked
            ]
    else:
        reading.faults.at(node, "a list of values is needed, or a span: {from: …, to: …}")
    if reading.faults.count == before:
        try:
            parameter(case, path, asked)
        except InvalidInput as refusal:
            reading.faults.at_key(node, str(refusal).removeprefix(f"{path}: "))
    return asked


def value_at(reading: Reading, case: Case, path: str, node: Node) -> Any:
    """A value as a file writes it: numbers that have a dimension with their unit."""
    found = found_at(case, path, absent=True)
    quantity = next((quantity_of(declared) for _, declared in found), None)
    if quantity is None or isinstance(node.value, dict | list):
        return node.plain()
    try:
        return quantity.read(node.value)
    except InvalidInput as refusal:
        reading.faults.at(node, str(refusal))
        return None
