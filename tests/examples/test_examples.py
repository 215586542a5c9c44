"""Every example runs as its reader would run it, without a warning, and leaves its figure."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from docs.site.runs import example_run

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(example: Path, runs: Path) -> None:
    figure = example_run(example, runs) / "figure.png"
    assert figure.read_bytes().startswith(b"\x89PNG")


def test_five_springs_are_compared_in_about_twenty_lines() -> None:
    text = (ROOT / "docs/examples/preload_springs.py").read_text(encoding="utf-8")
    doc = ast.parse(text).body[0]
    assert isinstance(doc, ast.Expr)
    assert doc.end_lineno is not None
    code = [line for line in text.splitlines()[doc.end_lineno :] if line.strip()]
    assert len(code) <= 24


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_says_how_it_is_run(example: Path) -> None:
    doc = ast.get_docstring(ast.parse(example.read_text(encoding="utf-8"))) or ""
    assert f"python docs/examples/{example.name} [FIGURE]" in doc
