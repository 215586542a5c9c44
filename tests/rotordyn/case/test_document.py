"""YAML as it is read here: the core schema of YAML 1.2, and places that hold."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rotordyn.case.document import read_document, resolve
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node


def read(tmp_path: Path, text: str) -> Node:
    path = tmp_path / "file.yaml"
    path.write_text(text)
    faults = Faults()
    root = read_document(path, faults, {})
    assert not faults.reported
    assert root is not None
    return root


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 1e-3),
        ("2.1e11", 2.1e11),
        (".5", 0.5),
        ("5.", 5.0),
        ("12", 12),
        ("-3", -3),
        ("0x1F", 31),
        ("0o17", 15),
        ("012", 12),
        ("true", True),
        ("False", False),
        ("off", "off"),
        ("no", "no"),
        ("y", "y"),
        ("12:30", "12:30"),
        ("1_000", "1_000"),
        ("2020-01-01", "2020-01-01"),
        ("+x", "+x"),
        ("~", None),
        ("", None),
        ("-.inf", -math.inf),
        ("9" * 400, math.inf),
    ],
)
def test_plain_scalars(text: str, value: object) -> None:
    found = resolve(text)
    assert found == value
    assert type(found) is type(value)


def test_not_a_number() -> None:
    found = resolve(".nan")
    assert isinstance(found, float)
    assert math.isnan(found)


def test_quoted_scalars_stay_text(tmp_path: Path) -> None:
    assert read(tmp_path, "a: '1'\nb: \"true\"\n").plain() == {"a": "1", "b": "true"}


def test_places(tmp_path: Path) -> None:
    root = read(tmp_path, "a:\n  - {name: front, x: 3}\n  - [1, 2]\n")
    x = root.at("a", 0, "x")
    assert (x.line, x.column, x.path, x.key) == (2, 22, "a.front.x", (2, 19))
    assert root.at("a", 1, 1).path == "a.2.2"


def test_alias_is_a_copy(tmp_path: Path) -> None:
    root = read(tmp_path, "a: &x {v: 1}\nb: *x\n")
    root.at("b").value["v"].value = 2
    assert root.plain() == {"a": {"v": 1}, "b": {"v": 2}}


@pytest.mark.parametrize("text", ["[" * 100_000, "a: " + "{a: " * 5000, "- " * 5000])
def test_depth_is_bounded(tmp_path: Path, text: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_text(text)
    faults = Faults()
    assert read_document(path, faults, {}) is None
    assert "nested deeper" in faults.reported[0].message


def test_pure_python_parser_agrees(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import yaml

    from rotordyn.case import document

    text = "a: &x {v: 1e-3, w: [1, '2']}\nb: *x\nc: +x\n"
    fast = read(tmp_path, text)
    monkeypatch.setattr(document, "_LOADER", yaml.SafeLoader)
    slow = read(tmp_path, text)
    assert slow == fast
