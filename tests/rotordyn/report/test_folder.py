"""The results folder: whole or not at all, and never over what is not ours."""

from __future__ import annotations

import errno
import json
import os
import stat
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from rotordyn.errors import InvalidInput, OutputRefused
from rotordyn.report import folder
from rotordyn.report.folder import MARKER, RECORD, results_folder
from rotordyn.report.manifest import read_record


def _fill(into, word="new"):
    (into / "data.txt").write_text(word)
    (into / RECORD).write_text(json.dumps({MARKER: 1}))


def _break(target):
    with results_folder(target) as place:
        _fill(place.folder)
        raise ZeroDivisionError


def _write(target, word="new", error=lambda: None):
    with results_folder(target) as place:
        _fill(place.folder, word)
        error()


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


def test_a_record_that_may_not_be_read_is_called_so(tmp_path, monkeypatch):
    """It is not another's folder; its contents stay."""
    _write(tmp_path / "out", "old")

    def refuse(path, *_, **__):
        raise PermissionError(13, "Permission denied")

    with monkeypatch.context() as patch:
        patch.setattr(Path, "read_text", refuse)
        for attempt in (_write, read_record):
            with pytest.raises(InvalidInput, match=r"run\.json cannot be read: Permission denied"):
                attempt(tmp_path / "out")
    assert (tmp_path / "out" / "data.txt").read_text() == "old"


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


def _refusing(times, where):
    """``os.rename`` that Windows refuses so many times for paths that ``where`` chooses."""
    left, rename = [times], os.rename

    def refused(source, target):
        if where(str(source), str(target)) and left[0] > 0:
            left[0] -= 1
            raise PermissionError(13, "Access is denied")
        rename(source, target)

    return refused


def test_a_file_in_use_for_a_moment_is_waited_for(tmp_path, monkeypatch):
    target = tmp_path / "out"
    _write(target, "old")
    monkeypatch.setattr(folder, "PATIENCE", (0.0, 0.0))
    monkeypatch.setattr(os, "rename", _refusing(2, lambda source, _: source == str(target)))
    _write(target)
    assert (target / "data.txt").read_text() == "new"
    assert os.listdir(tmp_path) == ["out"]


def test_results_go_beside_a_folder_in_use(tmp_path, monkeypatch):
    target = tmp_path / "out"
    _write(target, "old")
    (tmp_path / "out_2").mkdir()
    (tmp_path / "out_2" / "thesis.tex").write_text("years of work")
    monkeypatch.setattr(folder, "PATIENCE", ())
    monkeypatch.setattr(os, "rename", _refusing(99, lambda source, _: source == str(target)))
    with results_folder(target) as place:
        _fill(place.folder)
    assert (place.moved, place.target) == (True, tmp_path / "out_3")
    assert (place.target / "data.txt").read_text() == "new"
    assert (target / "data.txt").read_text() == "old"
    assert sorted(os.listdir(tmp_path)) == ["out", "out_2", "out_3"]


def test_no_new_results_no_old_ones_lost(tmp_path, monkeypatch):
    target = tmp_path / "out"
    _write(target, "old")
    monkeypatch.setattr(folder, "PATIENCE", ())
    refused = _refusing(99, lambda source, _: source.endswith(folder.NEW))
    monkeypatch.setattr(os, "rename", refused)
    with pytest.raises(InvalidInput, match="cannot be made: Access is denied"):
        _write(target)
    assert (target / "data.txt").read_text() == "old"
    assert os.listdir(tmp_path) == ["out"]


def test_results_that_a_killed_run_had_set_aside_come_back(tmp_path):
    target = tmp_path / "out"
    workshop = tmp_path / ".out.rotordyn.abcd1234"
    for name, word in ((folder.OLD, "old"), (folder.NEW, "new")):
        (workshop / name).mkdir(parents=True)
        _fill(workshop / name, word)
    os.utime(workshop, (0, 0))  # long ago, for systems without locks
    (tmp_path / ".out.backup").mkdir()
    with pytest.raises(ZeroDivisionError):
        _break(target)
    assert (target / "data.txt").read_text() == "old"
    assert sorted(os.listdir(tmp_path)) == [".out.backup", "out"]


def test_the_workshop_of_a_living_run_is_left_alone(tmp_path):
    with results_folder(tmp_path / "out") as first:
        _fill(first.folder, "first")
        _write(tmp_path / "out", "second")
        assert first.folder.exists()
    assert (tmp_path / "out" / "data.txt").read_text() == "first"


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EFBIG, errno.EROFS])
def test_a_full_disk_is_a_sentence(tmp_path, number):
    def refuse(*_):
        raise OSError(number, os.strerror(number))

    _write(tmp_path / "out", "old")
    with pytest.raises(InvalidInput, match=r"cannot be written to: .*; give another folder"):
        _write(tmp_path / "out", error=refuse)
    assert (tmp_path / "out" / "data.txt").read_text() == "old"
    assert os.listdir(tmp_path) == ["out"]


def test_a_place_that_takes_nothing_is_refused_before_anything_is_solved(tmp_path, monkeypatch):
    with pytest.raises(InvalidInput, match="cannot be written to: File name too long; give"):
        folder.check_target(tmp_path / ("x" * 250))
    folder.check_target(tmp_path / "deep" / "out")
    assert os.listdir(tmp_path) == []

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.mkdtemp", refuse)
    with pytest.raises(InvalidInput, match="cannot be written to: Permission denied; give"):
        folder.check_target(tmp_path / "deep" / "out")


@pytest.mark.skipif(os.name != "posix", reason="Windows has no pipes among files")
def test_a_pipe_or_endless_nesting_is_no_record(tmp_path):
    os.mkfifo(tmp_path / folder.RECORD)
    with pytest.raises(OutputRefused, match=r"holds no run\.json"):
        folder.check_target(tmp_path)
    (tmp_path / folder.RECORD).unlink()
    (tmp_path / folder.RECORD).write_text("[" * 100_000)
    with pytest.raises(OutputRefused, match=r"holds no run\.json"):
        folder.check_target(tmp_path)


def test_a_mount_is_refused_before_anything_is_solved(tmp_path, monkeypatch):
    monkeypatch.setattr(os.path, "ismount", lambda path: path == tmp_path)
    with pytest.raises(OutputRefused, match="give a folder in it"):
        folder.check_target(tmp_path)
