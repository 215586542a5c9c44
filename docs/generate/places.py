"""Where the documents are."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
DOCS = ROOT / "docs"
THEORY = DOCS / "theory"
FIGURES = DOCS / "figures"
MEASURED = ROOT / "benchmarks" / "results.json"
