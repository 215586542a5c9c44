"""Every example runs as its reader would run it, without a warning, and leaves its figure."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "docs" / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(example: Path, tmp_path: Path) -> None:
    figure = tmp_path / "figure.png"
    env = os.environ | {"PYTHONPATH": str(ROOT), "MPLBACKEND": "Agg", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-W", "error", str(example), str(figure)],
        cwd=tmp_path, env=env, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
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
