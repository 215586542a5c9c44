"""``rotordyn new``: files that ``check`` takes and ``run`` solves; nothing is overwritten."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn.case.starter import START, write_starter
from rotordyn.cli import main
from rotordyn.report.summary import called


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_new_files_are_checked_and_solved(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "grinder"]) == 0
    assert "grinder.yaml and grinder_spindle.yaml" in capsys.readouterr().out
    assert main(["check", "grinder.yaml"]) == 0
    assert main(["run", "grinder.yaml", "--no-figures", "--quiet"]) == 0
    assert (Path("out") / "grinder" / "summary.txt").exists()


def test_the_spindle_is_the_one_of_the_new_file() -> None:
    """A change of the new spindle file changes what the new case computes."""
    assert main(["new", "grinder"]) == 0
    file = Path("grinder_spindle.yaml")
    text = file.read_text(encoding="utf-8")
    assert text.count("preload: 1200 N") == 1
    file.write_text(text.replace("preload: 1200 N", "preload: 900 N"), encoding="utf-8")
    case = rotordyn.load("grinder.yaml")
    assert case.spindle is not None
    assert case.spindle.sleeves[0].spring.preload == 900.0


def test_the_new_files_describe_the_shipped_spindle() -> None:
    assert main(["new", "grinder"]) == 0
    ours, shipped = rotordyn.load("grinder.yaml"), rotordyn.load(START)
    assert np.array_equal(ours.speeds, shipped.speeds)
    assert ours.spindle is not None
    assert shipped.spindle is not None
    assert ours.spindle.shaft == shipped.spindle.shaft
    assert ours.spindle.seats == shipped.spindle.seats


def test_every_key_of_the_starting_files_is_beside_a_comment() -> None:
    assert main(["new", "grinder"]) == 0
    for name in ("grinder.yaml", "grinder_spindle.yaml"):
        lines = Path(name).read_text(encoding="utf-8").splitlines()
        assert sum("#" in line for line in lines) >= 8, name


@pytest.mark.parametrize("there", ["grinder.yaml", "grinder_spindle.yaml"])
def test_nothing_is_overwritten(there: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path(there).write_text("mine", encoding="utf-8")
    assert main(["new", "grinder"]) == 2
    assert f"{there} exists" in capsys.readouterr().err
    assert [p.name for p in Path().iterdir()] == [there]
    assert Path(there).read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("name", ["", "a/b", "../up", "a b", "a:b", ".hidden", "-"])
def test_names_that_are_no_words_are_refused(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "--", name]) == 2
    assert "not a name" in capsys.readouterr().err
    assert list(Path().iterdir()) == []


@pytest.mark.parametrize("name", ["con", "NUL", "Aux.yaml", "com1", "LPT9"])
def test_names_of_devices_are_refused(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Windows opens no files of these names, whatever their suffix."""
    assert main(["new", name]) == 2
    said = capsys.readouterr().err
    assert f"{name.removesuffix('.yaml')} is the name of a device on Windows" in said
    assert list(Path().iterdir()) == []


def test_the_title_has_the_name() -> None:
    for name in ("grinder", "7014", "console"):
        assert main(["new", name]) == 0
        title = rotordyn.load(f"{name}.yaml").title
        assert title == f"{name}, a grinding spindle to start from"
    assert called(rotordyn.load("grinder.yaml")) == "grinder, a grinding spindle to start from"
    assert called(rotordyn.load(START)) == f"{START}: A grinding spindle, to start from"


@pytest.mark.parametrize("name", ["7014", "true", "grinder.yaml"])
def test_names_that_look_like_values_serve(name: str) -> None:
    assert main(["new", name]) == 0
    stem = name.removesuffix(".yaml")
    assert main(["check", f"{stem}.yaml"]) == 0


def test_a_folder_that_is_gone_is_named(tmp_path: Path) -> None:
    with pytest.raises(rotordyn.InvalidInput, match=r"grinder_spindle\.yaml cannot be written: No"):
        write_starter("grinder", tmp_path / "gone")
