"""Walks the broken cases: each must be refused with exactly the faults it expects."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest

import rotordyn
from rotordyn.errors import Fault, exit_code

FOLDER = Path(__file__).parents[2] / "cases" / "broken"
_EXPECT = re.compile(r"# expect: (?:(\S+\.yaml):)?(\d+): (\S*?): (.+)")


def faults_of(path: Path | str) -> tuple[Fault, ...]:
    with pytest.raises(rotordyn.InvalidInput) as caught:
        rotordyn.load(path)
    assert exit_code(caught.value) == 2
    assert str(caught.value).splitlines() == [str(fault) for fault in caught.value.faults]
    return caught.value.faults


def expected(path: Path) -> list[tuple[str, int, str, str]]:
    lines = path.read_text().splitlines()
    marks = [line for line in lines if line.startswith("# expect:")]
    found = [_EXPECT.fullmatch(mark) for mark in marks]
    assert found, f"{path.name}: no expectation"
    assert all(found), f"{path.name}: an expectation cannot be read"
    return [(m[1] or path.name, int(m[2]), m[3], m[4]) for m in found if m]


@pytest.mark.parametrize("name", sorted(path.name for path in FOLDER.glob("*.yaml")))
def test_broken_case(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER)
    wanted = expected(FOLDER / name)
    faults = faults_of(name)
    for fault, (file, line, path, text) in zip(faults, wanted, strict=False):
        assert (fault.file, fault.line, fault.path) == (file, line, path), str(fault)
        pattern = ".*".join(re.escape(fragment) for fragment in text.split(" … "))
        assert re.search(pattern, fault.message), str(fault)
    assert len(faults) == len(wanted), "\n".join(map(str, faults))


def test_missing_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mfw2310.yaml").write_text("title: x\n")
    (fault,) = faults_of("mfw231.yaml")
    assert str(fault) == "mfw231.yaml:1:1: no such file (did you mean mfw2310.yaml?)"


def test_a_file_of_another_name_is_not_suggested(tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    Path("optimum.yaml").write_text("title: x\n")
    (fault,) = faults_of("nothere.yaml")
    assert str(fault) == "nothere.yaml:1:1: no such file"


@pytest.mark.parametrize(
    ("text", "place", "key"),
    [
        ("analyses:\n  preload:{}\n  campbell: {}\n", "2:10", "preload"),
        ("analyses: {preload:{}}\n", "1:19", "preload"),
        ("speeds:[0 rpm]\nanalyses: {preload: {}}\n", "1:7", "speeds"),
        ("spindle: mfw2310\nspeeds: [0 rpm]\nanalyses:\n  preload:{}\n", "4:3", "preload"),
    ],
)
def test_a_space_that_lacks_after_a_colon(text: str, place: str, key: str, tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(text)
    (fault,) = faults_of(path)
    assert f":{place}: " in str(fault)
    assert f"put a space after the colon of '{key}:'" in fault.message


def test_materials_by_other_words(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: mfw2310\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n"
        "override: {bearing_override.ball_material: ceramic}\n"
    )
    assert all("did you mean silicon_nitride?" in each.message for each in faults_of(path))


def test_a_housing_along_the_axis_is_named_at_its_stiffness(tmp_path: Path) -> None:
    spindle = rotordyn.models("spindles")[0].name
    path = tmp_path / "case.yaml"
    path.write_text(
        f"spindle: {spindle}\nspeeds: [0 rpm]\nanalyses: {{preload: {{}}}}\noverride:\n"
        "  housings:\n"
        "    - {name: body, carries: [a], x: 0 mm, mass: 9 kg,\n"
        "       stiffness: {yy: 1 N/um, xx: 1 N/um}}\n"
    )
    found = [each for each in faults_of(path) if "leave x out" in each.message]
    assert [(each.line, each.path.rpartition(".")[2]) for each in found] == [(7, "xx")]


def test_directory(tmp_path: Path) -> None:
    (fault,) = faults_of(tmp_path)
    assert "is a directory" in fault.message


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_named_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "case.yaml")
    (fault,) = faults_of(tmp_path / "case.yaml")
    assert "not a regular file" in fault.message


@pytest.mark.parametrize("content", [b"\x89PNG\r\n\x1a\n\0\0", b"title: caf\xe9\n"])
def test_not_utf8(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "case.yaml"
    path.write_bytes(content)
    (fault,) = faults_of(path)
    assert fault.line == 1
    assert "not text in UTF-8" in fault.message


@pytest.mark.parametrize("code", ["utf-16", "utf-16-be"])
def test_utf16_is_called_so(tmp_path: Path, code: str) -> None:
    path = tmp_path / "case.yaml"
    path.write_bytes("\ufeff".encode("utf-16-be") * (code != "utf-16") + "title: a\n".encode(code))
    (fault,) = faults_of(path)
    assert fault.message == "is text in UTF-16: save it as UTF-8"


def test_merge_keys_are_called_so(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    given = "spindle: grinding_spindle\nspeeds: [0 rpm]\nanalyses: {preload: {<<: {}}}\n"
    path.write_text(given, encoding="utf-8")
    (fault,) = faults_of(path)
    assert (fault.line, fault.column) == (3, 22)
    assert fault.message == "merge keys (<<) are not read: write the keys themselves"


def test_binary(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_bytes(b"title: a\0b\n")
    (fault,) = faults_of(path)
    assert "binary" in fault.message


@pytest.mark.parametrize("content", ["", "\n\n", "---\n", "~\n"])
def test_empty(tmp_path: Path, content: str) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(content)
    (fault,) = faults_of(path)
    assert "the file is empty" in fault.message


def test_too_long(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text("# filler\n" * 500_000)
    (fault,) = faults_of(path)
    assert "bytes" in fault.message


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("a\0b.yaml", "control characters, or bytes that are not text, in its name: rename it"),
        ("\x1b[31m.yaml", "in its name: rename it"),
        ("\udcff.yaml", "in its name: rename it"),
        ("x" * 5000 + ".yaml", "cannot be read"),
    ],
)
def test_impossible_file_name(name: str, said: str) -> None:
    (fault,) = faults_of(name)
    assert said in fault.message
    assert str(fault).isprintable()


def test_message_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text('bearing: vex70\nspeeds: ["1\\n2 rpm"]\nanalyses: {bearing: {loads: [1 N]}}\n')
    (fault,) = faults_of(path)
    assert "\n" not in str(fault)
