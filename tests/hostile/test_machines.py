"""A share of the extreme machines; more of them: python -m tests.hostile --machines 1000."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.hostile.interrupts import MOST, stopped
from tests.hostile.judged import BUSY, command, judged, loaded
from tests.hostile.kills import kills
from tests.hostile.machines import machine, written
from tests.hostile.numbers import words_of_nan


@pytest.fixture(scope="module", autouse=True)
def _loaded() -> None:
    loaded()


@pytest.mark.few(2)
@pytest.mark.parametrize(
    "number", [0, 26, 75, 110, 203, pytest.param(309, marks=pytest.mark.long), 400]
)
def test_an_extreme_machine_is_solved_or_refused(number: int, tmp_path: Path) -> None:
    assert machine(number) == machine(number)
    case, out = written(number, tmp_path), tmp_path / "out"
    words = ("run", case, "-o", out, "--no-figures", "--quiet", "--longest", 5)
    assert judged(command(*words, then=lambda: words_of_nan(out)), 2.0 * BUSY).faults == []


def test_killed_runs_leave_whole_results(tmp_path: Path) -> None:
    assert kills(tmp_path, 5) == []


@pytest.mark.parametrize("name", ["frf", "stability_lobes"])
def test_a_long_run_ends_soon_after_ctrl_c(name: str, tmp_path: Path) -> None:
    found = stopped(name, tmp_path, 1.0, "--no-figures")
    assert found.code == 130
    assert found.after <= MOST
