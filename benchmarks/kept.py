"""Measurements kept in ``benchmarks/results.json``."""

from __future__ import annotations

import json
from typing import Any

from benchmarks.processes import ROOT

RESULTS = ROOT / "benchmarks" / "results.json"


def keep(group: str | None = None, **found: Any) -> None:
    """Replace each part, with four significant digits; leave the other parts unchanged.

    ``group``: the part that they are parts of.
    """
    results = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}
    whole = results if group is None else results.setdefault(group, {})
    whole |= rounded(found)
    text = json.dumps(results, indent=1, ensure_ascii=False) + "\n"
    RESULTS.write_text(text, encoding="utf-8")


def rounded(value: Any) -> Any:
    """Numbers with four significant digits."""
    if isinstance(value, dict):
        return {key: rounded(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [rounded(inner) for inner in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value
