"""Texts of a case file are inert in every file and page that carries them (docs/security.md)."""

from __future__ import annotations

import csv
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest
import pyuff

import rotordyn
from rotordyn.case.model import model
from rotordyn.cli import main

HOSTILE = "</text><script>alert(\"1\")</script>' onload='x' & $\\frac{1}{2}$ µ\n    -1\n    58\n]]>"
SPINDLE = """
title: {title}
note: {title}
sources: [{title}]
shaft:
  start: 0 mm
  material: steel_rotor
  sections: [{{name: shaft, length: 300 mm, outer_diameter: 30 mm}}]
supports:
  - name: a
    x: 30 mm
    rigid: [x]
    stiffness: &stiff {{yy: 50 N/um, zz: 50 N/um}}
    damping: &damper {{yy: 1 kN s/m, zz: 1 kN s/m}}
  - {{name: b, x: 270 mm, stiffness: *stiff, damping: *damper}}
points: {{{point}: 300 mm}}
"""
CASE = """
title: {title}
note: {title}
spindle: spindle.yaml
speeds: [0 rpm, 9000 rpm]
analyses:
  campbell: {{max_frequency: 2 kHz}}
  frf:
    frequencies: {{from: 10 Hz, to: 2 kHz, count: 40}}
    pairs: [{{response: tip.y, excitation: tip.y}}]
  unbalance: {{points: [tip], unbalances: [{{name: u, at: tip, unbalance: 1 g mm}}]}}
references:
  - quantity: bending_frequency
    subject: {title}
    kind: published
    source: {title}
    speeds: [0 rpm]
    values: [500 Hz]
    remark: {title}
"""


def written(folder: Path, title: str = "plain", point: str = "tip") -> Path:
    """A case whose file has an odd name too."""
    quoted = '"' + title.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'
    for name, text in (("spindle.yaml", SPINDLE), ('it\'s <b> "1".yaml', CASE)):
        (folder / name).write_text(text.format(title=quoted, point=point), encoding="utf-8")
    return folder / 'it\'s <b> "1".yaml'


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("hostile"), HOSTILE)


@pytest.fixture(scope="module")
def folder(case: Path) -> Path:
    target = case.parent / "results"
    assert main(["run", str(case), "-o", str(target), "--quiet", "--format", "svg"]) == 0
    return target


class Tags(HTMLParser):
    """Elements and the names of their attributes."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.attributes: set[str] = set()
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.add(tag)
        self.attributes |= {name for name, _ in attrs}

    def handle_data(self, data: str) -> None:
        self.text += data


def test_pages_of_notebooks(case: Path, folder: Path) -> None:
    read = rotordyn.load(case)
    assert read.spindle is not None
    for shown in (read, read.spindle, rotordyn.open(folder)):
        page = Tags(shown._repr_html_())
        assert page.names <= {
            "table",
            "caption",
            "b",
            "tr",
            "th",
            "td",
            "details",
            "summary",
            "pre",
        }
        assert page.attributes <= {"style"}
        assert "<script>" in page.text, "shown as text"


def test_drawings(folder: Path) -> None:
    drawings = sorted(folder.glob("*.svg"))
    assert len(drawings) >= 5
    titled = 0
    for drawing in drawings:
        root = ET.parse(drawing).getroot()
        for element in root.iter():
            assert element.tag.rpartition("}")[2] not in {"script", "foreignObject", "a"}
            assert not [name for name in element.attrib if name.lower().startswith("on")]
        titled += "<script>" in "".join(root.itertext())
    assert titled == len(drawings), "the title stands on every figure as text"


def test_stored_numbers(folder: Path) -> None:
    """The title is an attribute and nothing else: no name of a group or variable."""
    names: list[str] = []
    with h5py.File(folder / "results.nc") as file:
        file.visit(names.append)
        assert file.attrs["title"] == HOSTILE
    assert not [name for name in names if "script" in name or "<" in name]
    assert rotordyn.open(folder).case.title == HOSTILE


def test_universal_file(folder: Path) -> None:
    """No line of a title begins a data set of its own."""
    records = pyuff.UFF(str(folder / "frf.uff"))
    assert [int(kind) for kind in records.get_set_types()] == [164, 2411, 58, 58]
    for kind, record in zip(records.get_set_types(), records.read_sets(), strict=True):
        lines = [record[f"id{k}"] for k in range(1, 6)] if kind == 58 else []
        assert all(len(line) <= 80 and "\n" not in line and line.isascii() for line in lines)


def test_tables(folder: Path) -> None:
    """No cell begins a formula, and rows are whole."""
    for table in folder.glob("*.csv"):
        with table.open(encoding="utf-8-sig", newline="") as file:
            rows = [row for row in csv.reader(file) if row]
        assert len({len(row) for row in rows}) == 1, table.name
        assert not [cell for row in rows for cell in row if cell[:1] in ("=", "@", "\t", "\r")]


@pytest.mark.parametrize("point", ["'<script>'", "'a\"b'", '"a\\nb"', "'-1'", "'=1+1'"])
def test_names_are_refused(point: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(written(tmp_path, point=point))]) == 2
    assert "not a name: given" in capsys.readouterr().err


def test_library_text_is_read_unchanged(case: Path) -> None:
    assert model("spindles", case.parent / "spindle.yaml").title == HOSTILE
