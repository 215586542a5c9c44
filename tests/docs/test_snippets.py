"""Every command and every block of code of the pages runs, and prints what the page shows."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

import rotordyn
from docs.generate.marked import parts
from docs.generate.places import DOCS, FIGURES, ROOT
from docs.generate.snippets import PICTURES, blocks, run_page, snippet_pages
from rotordyn.case.starter import START

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
# How many machines a search solves hangs on the last digit of the processor's arithmetic.
EFFORT = re.compile(r"\d+ machines solved")
PAGES = snippet_pages()
YAML = re.compile(r"^```yaml\n(.*?)^```", re.MULTILINE | re.DOTALL)
KEYS = ("speeds", "conditions", "analyses", "override")  # of a case; others are of a spindle
EXPLAINING = [
    page
    for page in sorted([*DOCS.glob("*.md"), *(DOCS / "theory").glob("*.md")])
    if YAML.search(page.read_text(encoding="utf-8"))
]
SEARCHES = ("identification", "intervals", "optimum", "rotor_from_responses")  # take long
NAMED = [
    pytest.param(
        page,
        id=page.relative_to(ROOT).as_posix(),
        marks=[pytest.mark.long] if page.stem in SEARCHES else [],
    )
    for page in PAGES
]


@pytest.mark.parametrize("page", NAMED)
def test_blocks_of_a_page_run_and_print_what_it_shows(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In this process alone: other tests start workers, and what they print is the same."""
    for room in ("study.solve", "study.optimum.solve", "study.identification.solve"):
        monkeypatch.setattr(f"rotordyn.{room}.processors", lambda: 1)
    printed = run_page(page, tmp_path, draw=False)
    shown = parts(page.read_text(encoding="utf-8"))
    for name, printed_now in printed.items():
        now, before = (EFFORT.sub("machines solved", text) for text in (printed_now, shown[name]))
        assert NUMBER.sub("#", before) == NUMBER.sub("#", now), name
        old, new = ([float(n) for n in NUMBER.findall(text)] for text in (before, now))
        assert old == pytest.approx(new, rel=2e-3, abs=1e-4), name


@pytest.mark.parametrize("page", EXPLAINING, ids=lambda page: page.stem)
def test_yaml_of_the_pages_that_explain_is_taken(page: Path, tmp_path: Path) -> None:
    """All blocks of a page together, as parts of a case or of a spindle."""
    given: dict[str, Any] = {"speeds": ["0 rpm"], "analyses": {"campbell": {}}}
    material = {"name": "steel", "young_modulus": "210 GPa", "poisson_ratio": 0.3}
    section = {"length": "1 m", "outer_diameter": "50 mm"}
    shaft = {"start": "0 m", "material": {**material, "density": "7800 kg/m^3"}}
    parts: dict[str, Any] = {}
    for code in YAML.findall(page.read_text(encoding="utf-8")):
        block = yaml.safe_load(code)
        for key, value in block.items():
            into = given if key in KEYS else parts
            both = isinstance(value, dict) and isinstance(into.get(key), dict)
            into[key] = merged(into[key], value) if both else value
    machine: dict[str, Any] = {"spindle": "mfw2310", "tool": "mfw2310_exciter"}
    if parts:
        machine = {"spindle": {"shaft": {**shaft, "sections": [section]}, **parts}}
    (tmp_path / "case.yaml").write_text(yaml.safe_dump({**machine, **given}, allow_unicode=True))
    rotordyn.load(tmp_path / "case.yaml")


def merged(old: dict[str, Any], new: dict[str, Any]) -> dict[str, Any]:
    """Mappings of mappings."""
    both = {k: merged(old[k], v) for k, v in new.items() if isinstance(old.get(k), dict)}
    return {**old, **new, **both}


def test_the_tutorial_builds_the_spindle_that_new_writes(
    tmp_path: Path,
) -> None:
    page = (DOCS / "tutorial" / "own_spindle.md").read_text(encoding="utf-8")
    built = "".join(b.code for b in blocks(page) if b.file.lstrip("+") == "spindle.yaml")
    (tmp_path / "spindle.yaml").write_text(built, encoding="utf-8")
    mine = rotordyn.model("spindles", tmp_path / "spindle.yaml")
    assert replace(mine, name="", title="", note="") == replace(
        rotordyn.model("spindles", START), name="", title="", note=""
    )


def test_pages_show_what_a_run_prints() -> None:
    """The engine reads the pages: there are blocks, files and outputs in all of the tutorial."""
    for page in PAGES:
        if page.parent.name == "tutorial":
            found = list(blocks(page.read_text(encoding="utf-8")))
            assert any(block.output for block in found), page.name


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("```sh\nrotordyn check nothing_there.yaml\n```\n", "exit code 2"),
        ("```sh\nscripts/nothing_there\n```\n", "no such script"),
        ("```sh\nmake all\n```\n", "no command of rotordyn"),
        ("```yaml\na: 1\n```\n", "a block of unknown kind"),
    ],
)
def test_a_page_that_is_wrong_is_named(code: str, words: str, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(code, encoding="utf-8")
    with pytest.raises(RuntimeError, match=words):
        run_page(page, tmp_path)


def test_figures_of_the_pages_are_kept() -> None:
    assert all((FIGURES / name).is_file() for name in PICTURES)
