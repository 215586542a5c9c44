"""Hostile files are read or refused in a sentence, soon and in little memory."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.hostile.files import FILES
from tests.hostile.judged import BUSY, Verdict, command, judged, loaded


@pytest.fixture(scope="module", autouse=True)
def _loaded() -> None:
    loaded()


@pytest.mark.few(40)
@pytest.mark.parametrize("name", sorted(FILES))
def test_a_hostile_file_is_checked(name: str, tmp_path: Path) -> None:
    FILES[name](tmp_path)
    assert judged(command("check", tmp_path / "case.yaml"), BUSY).faults == []


def test_what_must_not_be_is_noticed() -> None:
    def slow() -> int:
        sum(k * k for k in range(10**9))
        return 0

    assert "killed by signal" in judged(slow, 0.25).said
    assert "exit code 1" in Verdict(1, "Traceback\n" * 40, 9.0, 900.0).faults
    assert len(Verdict(1, "Traceback\n" * 40, 9.0, 900.0).faults) == 5
