"""The results folder: whole or not at all, and never over what is not ours."""

from __future__ import annotations

import json
import os
import stat
from concurrent.futures import ThreadPoolExecutor

import pytest

from rotordyn.errors import InvalidInput, OutputRefused
from rotordyn.report.folder import MARKER, RECORD, results_folder


def _fill(folder, word="new"):
    (folder / "data.txt").write_text(word)
    (folder / RECORD).write_text(json.dumps({MARKER: 1}))


def _break(target):
    with results_folder(target) as place:
        _fill(place.folder)
        raise ZeroDivisionError


def _write(target, word="new"):
    with results_folder(target) as place:
        _fill(place.folder, word)


def test_nothing_is_there_before_the_end(tmp_path):
    target = tmp_path / "deep" / "er" / "out"
    with results_folder(target) as place:
        _fill(place.folder)
        assert not target.exists()
    assert sorted(p.name for p in target.iterdir()) == ["data.txt", RECORD]
    assert [p.name for p in target.parent.iterdir()] == ["out"]
    assert stat.S_IMODE(target.stat().st_mode) & 0o500 == 0o500


def test_own_results_are_replaced_whole(tmp_path):
    target = tmp_path / "out"
    _write(target, "old")
    (target / "left over.csv").write_text("1")
    _write(target)
    assert sorted(p.name for p in target.iterdir()) == ["data.txt", RECORD]
    assert (target / "data.txt").read_text() == "new"
    assert os.listdir(tmp_path) == ["out"]


def test_empty_folder_is_taken(tmp_path):
    (tmp_path / "out").mkdir()
    _write(tmp_path / "out")
    assert (tmp_path / "out" / "data.txt").exists()


@pytest.mark.parametrize("record", [None, "{}", "not json", '["rotordyn_results"]'])
def test_foreign_folder_is_refused_and_untouched(tmp_path, record):
    target = tmp_path / "out"
    target.mkdir()
    (target / "thesis.tex").write_text("years of work")
    if record:
        (target / RECORD).write_text(record)
    with pytest.raises(OutputRefused, match="not empty"):
        _write(target)
    assert (target / "thesis.tex").read_text() == "years of work"
    assert os.listdir(tmp_path) == ["out"]


def test_file_is_refused(tmp_path):
    (tmp_path / "out").write_text("x")
    with pytest.raises(OutputRefused, match="is a file"):
        _write(tmp_path / "out")


def test_an_error_leaves_no_trace(tmp_path):
    _write(tmp_path / "kept", "old")
    for target in (tmp_path / "kept", tmp_path / "a" / "b" / "c"):
        with pytest.raises(ZeroDivisionError):
            _break(target)
    assert os.listdir(tmp_path) == ["kept"]
    assert (tmp_path / "kept" / "data.txt").read_text() == "old"


def test_parent_that_is_a_file(tmp_path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(InvalidInput):
        _write(tmp_path / "file" / "out")


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write anywhere")
def test_parent_that_cannot_be_written(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(InvalidInput, match="cannot be written"):
        _write(tmp_path / "out")


def test_read_only_file_system_is_a_sentence(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.mkdtemp", refuse)
    with pytest.raises(InvalidInput, match=r"cannot be written to: Permission denied; give"):
        _write(tmp_path / "out")


def test_a_link_keeps_pointing(tmp_path):
    _write(tmp_path / "real", "old")
    (tmp_path / "link").symlink_to(tmp_path / "real")
    _write(tmp_path / "link")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real" / "data.txt").read_text() == "new"


def test_runs_at_the_same_moment_leave_one_whole_result(tmp_path):
    target = tmp_path / "out"
    words = [str(k) for k in range(12)]
    with ThreadPoolExecutor(6) as pool:
        list(pool.map(lambda word: _write(target, word), words))
    assert (target / "data.txt").read_text() in words
    assert os.listdir(tmp_path) == ["out"]
