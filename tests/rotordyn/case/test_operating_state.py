"""Sets, fits, temperatures and histories that cannot be used: one sentence each, at its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.rotordyn.case.test_broken import faults_of

SET = """sleeves: []
  bearings:
    - {{name: front, model: {model}, x: 51 mm{front}}}
    - {{name: rear, model: {model}, x: 269 mm{rear}}}
  arrangement: {{set: {name}, bearings: [front, rear], preload: {preload}}}"""


def pair(
    name: str, preload: str = "{force: 600 N}", front: str = "", rear: str = "", model: str = ""
) -> str:
    thrusts = [f", thrust: {way}" if way else "" for way in (front, rear)]
    model = model or "kh6014e"
    return SET.format(name=name, preload=preload, front=thrusts[0], rear=thrusts[1], model=model)


FITTED = "bearings.*.model: kh6014e\n  growth: {static: 0 um}\n  fits: "
WARM, PAST = "sleeves: []\nconditions:\n  temperatures: ", "sleeves: []\nconditions:\n  history: "


@pytest.mark.parametrize(
    ("override", "place", "words"),
    [
        (pair("DX"), "arrangement.set", "allowed: DB, DF, DT"),
        (pair("TBT"), "arrangement.bearings", "a set TBT has 3 bearings: given 2"),
        (pair("DB", front="-x"), "arrangement.set", "from front to rear are --"),
        (pair("DF", front="+x", rear="-x"), "arrangement.set", "or name the set DB"),
        (
            "bearings.a.thrust: +x\n  bearings.b.thrust: -x\n  bearings.c.thrust: +x\n"
            "  sleeves: []\n"
            "  arrangement: {set: QBC, bearings: [a, b, c, d], preload: {force: 600 N}}",
            "arrangement.set",
            "turn bearings, or give sleeves in the place of a set",
        ),
        (pair("DB", "{class: extra}"), "preload.class", "given 'extra'; allowed: light, medium"),
        (pair("DB", "{class: light}", model="qj218"), "preload.class", "give class_force: FORCE"),
        (pair("DB", "{force: 1 N, class: light}"), "preload", "allowed: one of force, class"),
        (pair("DB", "{force: .nan N}"), "preload.force", "not a finite number"),
        ("fits: {shaft: k5}\n  bearings.*.model: kh6014e", "fits", "contradict a given growth"),
        (FITTED + "{shaft: k5, under_balls: true}", "fits.housing", "such as JS5, or leave"),
        ("sleeves.rear.stop_travel: -5 um", "stop_travel", "allowed: from 0 um"),
        ("sleeves.rear.spring: {preload: 9 N, stiffness: 0 N/m}", "spring.stiffness", "above 0"),
        (WARM + "{}", "temperatures", "no temperature is given"),
        (WARM + "{shaft: .nan degC}", "temperatures.shaft", "not a finite number"),
        (WARM + "30 degC", "temperatures", "wrong shape"),
        (PAST + "[{axialforce: 9 N}]", "axialforce", "did you mean axial_force"),
        (PAST + "[{axial_force: .nan N}]", "axial_force", "not a finite number"),
        (PAST + "[{speed: 400000 rpm}]", "history.1.speed", "mm/min: given 400000 rpm"),
    ],
)
def test_it_is_one_sentence_at_its_place(
    override: str, place: str, words: str, tmp_path: Path
) -> None:
    file = tmp_path / "case.yaml"
    head = "spindle: grinding_spindle\nspeeds: [0 rpm]\nanalyses: {preload: {}}\noverride:\n  "
    file.write_text(head + override + "\n")
    (fault,) = faults_of(file)
    assert fault.path.endswith(place), str(fault)
    assert words in fault.message, str(fault)
