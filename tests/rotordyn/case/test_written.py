"""A case written as a file with other values."""

from __future__ import annotations

from pathlib import Path

import rotordyn
from rotordyn.case.written import write_changed


def test_text_of_the_file_is_read_as_that_of_the_case(tmp_path: Path) -> None:
    """Words that other versions of YAML take for true, false or a time stay text."""
    text = "spindle: grinding_spindle\nspeeds: [3000 rpm]\nanalyses: {preload: }\nnote: off\n"
    (tmp_path / "case.yaml").write_text(text, encoding="utf-8")
    case = rotordyn.load(tmp_path / "case.yaml")
    changes = {"spindle.sleeves.rear.spring.preload": "2000 N"}
    write_changed(case, changes, tmp_path / "best.yaml", title="12:30")
    best = rotordyn.load(tmp_path / "best.yaml")
    assert best.title == "12:30"
    assert best == rotordyn.vary(case, {**changes, "name": "best", "title": "12:30"})
