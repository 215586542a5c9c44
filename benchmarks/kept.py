"""Measurements kept in ``benchmarks/results.json``."""

from __future__ import annotations

import json
from typing import Any

from benchmarks.processes import ROOT

RESULTS = ROOT / "benchmarks" / "results.json"


def keep(**found: Any) -> None:
    """Write each part anew, with four digits that count; leave the others as they are."""
    results = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}
    results |= rounded(found)
    text = json.dumps(results, indent=1, ensure_ascii=False) + "\n"
    RESULTS.write_text(text, encoding="utf-8")


def rounded(value: Any) -> Any:
    """Numbers with four digits that count."""
    if isinstance(value, dict):
        return {key: rounded(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [rounded(inner) for inner in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value
