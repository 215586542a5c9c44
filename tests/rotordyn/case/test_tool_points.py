"""Points of a tool: its front end moves with the lengths of its sections."""

from __future__ import annotations

import json

import pytest

import rotordyn
from rotordyn.case.archive import archived, restored
from rotordyn.case.case import Case
from rotordyn.machine.plausibility import implausible


def clamped() -> Case:
    return rotordyn.load("mfw2310_tools").variants["hsk63_end_mill_10"]


@pytest.mark.parametrize("length", [0.01, 0.04])
def test_the_tip_of_a_tool_follows_its_sections(length: float) -> None:
    case = clamped()
    flutes = next(s for s in case.spindle.shaft.sections if s.name == "flutes")
    other = rotordyn.vary(case, {"tool.sections.flutes.length": length})
    assert other.spindle.points["tip"] == pytest.approx(
        case.spindle.points["tip"] - (length - flutes.length), abs=1e-12
    )
    assert other.spindle.points["tip"] == other.spindle.shaft.start
    assert other.spindle.points["O1"] == case.spindle.points["O1"]
    again = rotordyn.vary(other, {"tool.sections.flutes.length": flutes.length})
    assert again.spindle.points == case.spindle.points
    kept = restored(json.loads(json.dumps(archived(other))))
    assert (kept.spindle, kept.tool) == (other.spindle, other.tool)


def test_a_tip_given_by_its_station_stays_and_is_reported() -> None:
    case = clamped()
    there = case.spindle.points["tip"]
    fixed = rotordyn.vary(case, {"tool.points.tip": there})
    assert not [said for said in implausible(fixed.spindle, 0.0) if "point tip" in said]
    longer = rotordyn.vary(fixed, {"tool.sections.flutes.length": "33 mm"})
    assert longer.spindle.points["tip"] == there
    (said,) = [said for said in implausible(longer.spindle, 0.0) if "point tip" in said]
    assert "11 mm behind the front end" in said
