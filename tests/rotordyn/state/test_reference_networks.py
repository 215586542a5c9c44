"""Paths of axial networks that an event-driven code solved before, confirmed by minimisation."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from rotordyn.state import follow

CASES: list[dict[str, Any]] = json.loads(
    (Path(__file__).parent / "network_cases.json").read_text(encoding="utf-8")
)["cases"]
POSITION = 1e-10  # m
FORCE = 1e-6  # relative


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_positions_forces_and_events_are_the_known_ones(case: dict[str, Any]) -> None:
    answers = follow(case)
    assert len(answers) == len(case["answers"])
    for answer, known in zip(answers, case["answers"], strict=True):
        assert answer["x"] == pytest.approx(known["x"], abs=POSITION, rel=0.0)
        assert answer["deflection"] == pytest.approx(known["deflection"], abs=POSITION, rel=0.0)
        assert answer["mode"] == known["mode"]
        for key in ("load", "friction", "stop", "rigid"):
            assert answer[key] == pytest.approx(known[key], rel=FORCE, abs=1e-6)
    events = [event for answer in answers for event in answer["events"]]
    for event, known in zip(events, case["events"], strict=True):
        assert event == {**known, "at": pytest.approx(known["at"], abs=1e-9)}
