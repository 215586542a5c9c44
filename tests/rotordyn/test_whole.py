"""Files that replace others: whole, or those before."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rotordyn.whole import ABANDONED, whole_files


def test_files_appear_together_at_the_end(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("before")
    with whole_files(tmp_path) as place:
        (place / "a").write_text("after")
        (place / "b").write_text("new")
        assert (tmp_path / "a").read_text() == "before"
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {
        "a": "after",
        "b": "new",
    }


def test_an_interruption_leaves_the_files_before(tmp_path: Path) -> None:
    def interrupted() -> None:
        with whole_files(tmp_path) as place:
            (place / "a").write_text("aft")
            raise KeyboardInterrupt

    (tmp_path / "a").write_text("before")
    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert [path.read_text() for path in tmp_path.iterdir()] == ["before"]


def test_what_killed_runs_left_is_removed_after_a_day(tmp_path: Path) -> None:
    old, young = tmp_path / ".unfinished.old", tmp_path / ".unfinished.young"
    for path in (old, young):
        path.mkdir()
    before = old.stat().st_mtime - 2.0 * ABANDONED
    os.utime(old, (before, before))
    with whole_files(tmp_path):
        pass
    assert [*tmp_path.iterdir()] == [young]
