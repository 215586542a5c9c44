"""The run record is valid JSON and tells what a later reader needs."""

from __future__ import annotations

import json
import platform
from dataclasses import replace

import numpy as np

import rotordyn
from rotordyn.report.folder import record_in
from rotordyn.report.manifest import RunRecord, outcomes, write_record
from tests.rotordyn.figures import samples


def _record(**changes):
    return replace(RunRecord(case="sample", digest="ab12"), **changes)


def test_record_marks_the_folder_and_lists_its_files(tmp_path):
    (tmp_path / "figures").mkdir()
    (tmp_path / "figures" / "campbell.png").write_bytes(b"")
    assert record_in(tmp_path) is None
    write_record(tmp_path, _record(stages={"preload": np.float64(0.1234567)}))
    assert record_in(tmp_path) is not None
    held = json.loads((tmp_path / "run.json").read_text(encoding="utf-8"))
    assert held["files"] == ["figures/campbell.png", "run.json"]
    assert held["stages"] == {"preload": 0.123457}
    assert held["digest"] == "ab12"


def test_versions_name_what_took_part(tmp_path):
    write_record(tmp_path, _record())
    held = json.loads((tmp_path / "run.json").read_text(encoding="utf-8"))["versions"]
    assert held["python"] == platform.python_version()
    assert held["rotordyn"] == rotordyn.__version__
    assert held["numpy"] == np.__version__


def test_numbers_that_are_not_finite_stay_readable(tmp_path):
    write_record(tmp_path, _record(tolerances={"worst": float("nan")}, skipped={"uff": "no pyuff"}))
    held = json.loads((tmp_path / "run.json").read_text(encoding="utf-8"))
    assert held["tolerances"] == {"worst": "nan"}
    assert held["skipped"] == {"uff": "no pyuff"}


def test_outcomes_are_gathered_by_word():
    result = samples.stiffness(3)
    result = replace(result, outcome=("solved", "solved", "unloaded"))
    grid = samples.bearing(3)
    words = grid.outcome.astype("U20")
    words[2, 0] = "no equilibrium"
    found = outcomes({"stiffness": result, "bearing": replace(grid, outcome=words)})
    assert found["stiffness"] == {"solved": [0.0, 12000.0], "unloaded": [24000.0]}
    assert found["bearing"]["no equilibrium"] == [24000.0]
