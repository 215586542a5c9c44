"""A note names hypotheses on the balls that a fast spindle leaves to their defaults."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import rotordyn
from rotordyn.analyses import Conditions
from rotordyn.case.case import Case
from rotordyn.case.doubts import unstated_hypotheses

BOTH = "conditions.kinematics and conditions.moment_sharing are not stated: the defaults hybrid"


def written(folder: Path, conditions: str, rpm: int = 12000) -> Case:
    path = folder / "case.yaml"
    path.write_text(
        f"title: t\nspindle: grinding_spindle\nspeeds: [{rpm} rpm]\nanalyses: {{preload: }}\n"
        f"{conditions}",
        encoding="utf-8",
    )
    return rotordyn.load(path)


@pytest.mark.parametrize(
    ("conditions", "rpm", "said"),
    [
        ("", 12000, BOTH),
        ("conditions: {friction: 0.1}\n", 12000, BOTH),
        ("", 5000, ""),
        ("conditions: {kinematics: hybrid, moment_sharing: equal}\n", 12000, ""),
        ("conditions: {kinematics: hybrid}\n", 12000, "conditions.moment_sharing is not stated"),
        ("conditions: {moment_sharing: inner}\n", 12000, "conditions.kinematics is not stated"),
        ("conditions: {bearings: static}\n", 12000, ""),
        ("conditions: {dynamics: frozen}\n", 12000, ""),
        ("conditions: {dynamics: centrifugal}\n", 12000, "conditions.kinematics is not stated"),
        ("uncertain: as usual\n", 12000, ""),
        ("uncertain: {hypotheses: {kinematics: all}}\n", 12000, "conditions.moment_sharing is"),
    ],
)
def test_hypotheses_that_a_file_leaves_open(
    tmp_path: Path, conditions: str, rpm: int, said: str
) -> None:
    """Stated ones may be the defaults; slow balls have hardly a gyroscopic moment."""
    note = unstated_hypotheses(written(tmp_path, conditions, rpm))
    assert note.startswith(said)
    assert bool(note) == bool(said)


def test_in_python_the_defaults_are_not_stated() -> None:
    case = rotordyn.load("grinding_spindle")
    assert unstated_hypotheses(case) == ""
    silent = replace(case, conditions=Conditions())
    assert BOTH in unstated_hypotheses(silent)
    assert "moment_sharing is not" in unstated_hypotheses(
        replace(case, conditions=Conditions(kinematics="outer"))
    )
    assert case.spindle is not None
    seats = [replace(seat, kinematics="outer") for seat in case.spindle.seats]
    there = replace(silent, spindle=replace(case.spindle, seats=tuple(seats)))
    assert "conditions.moment_sharing is not stated" in unstated_hypotheses(there)


def test_the_note_stands_in_summary_and_notes(tmp_path: Path) -> None:
    """Of variants it names those that leave them open; an interval has their range."""
    case = written(tmp_path, "compare: {a: {}, b: {conditions: {kinematics: outer}}}\n")
    results = rotordyn.run(case)
    assert any(note.startswith(f"a: {BOTH}") for note in results.notes)
    assert any(note.startswith("b: conditions.moment_sharing is") for note in results.notes)
    assert "note       a: conditions.kinematics and" in results.summary
    assert not any("not stated" in warning for warning in results.warnings)


def test_flagship_states_its_hypotheses() -> None:
    assert unstated_hypotheses(rotordyn.load("mfw2310")) == ""


def test_hypotheses_that_vary_gives_are_stated(tmp_path: Path) -> None:
    case = written(tmp_path, "")
    assert BOTH in unstated_hypotheses(case)
    one = rotordyn.vary(case, {"conditions.kinematics": "hybrid"})
    assert "conditions.moment_sharing is not stated" in unstated_hypotheses(one)
    assert not unstated_hypotheses(rotordyn.vary(one, {"conditions.moment_sharing": "equal"}))
