"""Results folders that are damaged, or made to do harm: one sentence, and never a wait."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

import rotordyn
from rotordyn.cli import main
from rotordyn.errors import InvalidInput
from tests.rotordyn.test_surroundings import CASE

RECORD, STORED, NUMBERS = "run.json", "case.json", "results.nc"
Damage = Callable[[Path], object]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("whole")
    (place / "case.yaml").write_text(CASE, encoding="utf-8")
    return rotordyn.run(rotordyn.load(place / "case.yaml")).save(place / "out")


def written(name: str, content: bytes) -> Damage:
    return lambda folder: (folder / name).write_bytes(content)


def recorded(**changes: object) -> Damage:
    def write(folder: Path) -> None:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        (folder / RECORD).write_text(json.dumps(record | changes), encoding="utf-8")

    return write


def flipped(folder: Path) -> None:
    """Bits of the groups of the file."""
    raw = bytearray((folder / NUMBERS).read_bytes())
    for place in range(200, len(raw), 97):
        raw[place] ^= 4
    (folder / NUMBERS).write_bytes(raw)


@pytest.mark.parametrize(
    ("damage", "said"),
    [
        (written(RECORD, b"[" * 100_000), "is no results folder"),
        (recorded(rotordyn_results="x", versions=5), "of another version"),
        (recorded(versions={}), "run.json is damaged"),
        (recorded(warnings=5), "run.json is damaged"),
        (recorded(title=None), "run.json is damaged"),
        (written(STORED, b"[" * 100_000), "the case in .* cannot be read"),
        (written(STORED, b"null"), "the case in .* cannot be read"),
        (written("summary.txt", b"\xff"), "is incomplete"),
        (written(NUMBERS, b""), "is incomplete"),
        (flipped, "results.nc is damaged|is incomplete"),
    ],
)
def test_a_damaged_folder_is_a_sentence(
    damage: Damage, said: str, folder: Path, tmp_path: Path
) -> None:
    damage(shutil.copytree(folder, tmp_path / "out"))
    with pytest.raises(InvalidInput, match=said):
        rotordyn.write_report(tmp_path / "out", tmp_path / "page.html")
    assert not (tmp_path / "page.html").exists()


@pytest.mark.skipif(os.name != "posix", reason="Windows has no pipes among files")
@pytest.mark.parametrize("name", [RECORD, STORED, NUMBERS, "summary.txt"])
def test_a_pipe_is_not_read(name: str, folder: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(folder, tmp_path / "out")
    (copy / name).unlink()
    os.mkfifo(copy / name)
    with pytest.raises(InvalidInput):
        rotordyn.open(copy)
    with pytest.raises(InvalidInput, match="not a regular file"):
        rotordyn.write_report(copy, tmp_path / "page.html")


@pytest.mark.parametrize("name", ["case.yaml", "x" * 300])
def test_a_study_finds_at_once_where_it_cannot_write(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    study = tmp_path / "study.yaml"
    vary = "{bearing.ball_diameter: {from: 7 mm, to: 8 mm, points: 2}}"
    study.write_text(f"case: case.yaml\nvary: {vary}\n", encoding="utf-8")
    assert main(["sweep", str(study), "-o", str(tmp_path / name), "--quiet"]) == 2
    assert "cannot be " in capsys.readouterr().err


def test_a_folder_of_odd_bytes_is_written_and_read(tmp_path: Path) -> None:
    place = tmp_path / os.fsdecode(b"\xff\n")
    try:
        place.mkdir()
    except OSError:
        pytest.skip("this disk has no such names")
    (place / "case.yaml").write_text(CASE, encoding="utf-8")
    case = rotordyn.load(place / "case.yaml")
    results = rotordyn.open(rotordyn.run(case).save(place / "out"))
    assert replace(results.case, files=()) == replace(case, files=())
    assert results.origin.inputs[0].endswith("/case.yaml")
