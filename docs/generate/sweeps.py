"""Time against true error of a preload sweep and an FRF map, as measured last."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table

Lines = list[dict[str, Any]]


def sweep_parts(found: dict[str, Lines]) -> dict[str, str]:
    """The tables of the page on computing time."""
    head = ("tolerance of forces:", "true error:", "time [ms]:")
    rows = [
        (f"{r['tolerance']:.0e}", f"{r['error']:.0e}", _milliseconds(r)) for r in found["preload"]
    ]
    wide = ("elements", "requested:", "true error:", "reported error:", "time [ms]:")
    lines = [
        (r["way"], r["setting"], f"{r['error']:.1e}", f"{r['reported']:.1e}", _milliseconds(r))
        for r in found["map"]
    ]
    return {"precision-preload": table(head, rows), "precision-map": table(wide, lines)}


def _milliseconds(line: dict[str, Any]) -> str:
    return f"{1e3 * line['seconds']:.0f}"
