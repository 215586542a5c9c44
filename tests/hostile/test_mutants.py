"""A few mutants of every shipped file; all of them: python -m tests.hostile --mutants 100."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.hostile.judged import BUSY, command, judged, loaded
from tests.hostile.mutants import ROOT, files, mutant, written


@pytest.fixture(scope="module", autouse=True)
def _loaded() -> None:
    loaded()


@pytest.mark.few(45)
@pytest.mark.parametrize("path", files(), ids=lambda path: str(path.relative_to(ROOT)))
def test_a_mutant_is_taken_or_refused(path: Path, tmp_path: Path) -> None:
    assert mutant(path, 0) == mutant(path, 0)
    assert judged(command("check", written(path, 0, tmp_path)), BUSY).faults == []


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("cases/grinding_spindle_fits.yaml", 16),  # of a fit, an unknown word
        ("cases/preload_concepts.yaml", 16),  # a set of no name
        ("cases/mfw2310_measured_spindle.yaml", 13),  # no point for a tool on a measured spindle
        ("models/bearings/thrust_50x78x22.yaml", 59),  # a kind that is a mapping
    ],
)
def test_mutants_that_were_no_sentence_once(name: str, number: int, tmp_path: Path) -> None:
    assert judged(command("check", written(ROOT / name, number, tmp_path)), BUSY).faults == []
