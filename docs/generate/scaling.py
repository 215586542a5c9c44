"""Computing time over the size of machine and analyses, as measured last."""

from __future__ import annotations

from typing import Any

import numpy as np

from docs.generate.marked import table

Lines = list[dict[str, Any]]
MOST_SECONDS, MOST_MEGABYTES, SECTIONS = 1.0, 300.0, 10_000
WORDS = {
    "sections": "sections of a shaft, its modes at one speed",
    "speeds": "speeds of the flagship's Campbell diagram",
    "frequencies": "frequencies of its receptances at 7 speeds",
    "bearings": "bearings of a shaft, all different: preload and modes at 25 speeds",
    "balls": "balls of a bearing under thrust, radial load and moment, one state",
}


def scaling_parts(found: dict[str, Lines]) -> dict[str, str]:
    """The tables on the page of times."""
    return {"scaling-sections": _sections(found["sections"]), "scaling": _sweeps(found)}


def _sections(lines: Lines) -> str:
    """Computing time of a shaft of many sections."""
    head = (
        "sections:",
        "modes:",
        "reported error:",
        "first call [s]:",
        "call [s]:",
        "peak memory of the process [MB]:",
    )
    rows = [
        (
            f"{line['size']:,}".replace(",", " "),
            str(line["modes"]),
            f"{line['reported']:.0e}",
            f"{line['first']:.2f}",
            f"{line['seconds']:.3f}",
            f"{line['memory']:.0f}",
        )
        for line in lines
    ]
    long = next(line for line in lines if line["size"] == SECTIONS)
    held = long["seconds"] <= MOST_SECONDS and long["memory"] <= MOST_MEGABYTES
    verdict = "met" if held else "**missed**"
    target = f"{MOST_SECONDS:g} s of call and {MOST_MEGABYTES:g} MB"
    return f"{table(head, rows)}\n\nTarget at 10 000 sections, {target}: {verdict}."


def _sweeps(found: dict[str, Lines]) -> str:
    """Smallest and largest size of each sweep, and the growth of time at the end."""
    head = (
        "varied size",
        "from:",
        "to:",
        "time, first:",
        "time, last:",
        "exponent of the time:",
    )
    rows = []
    for name, words in WORDS.items():
        lines = found[name]
        first, last = lines[0], lines[-1]
        rows.append(
            (
                words,
                *(f"{line['size']}" for line in (first, last)),
                *(_seconds(line["seconds"]) for line in (first, last)),
                f"{power(lines):.2f}",
            )
        )
    return table(head, rows)


def power(lines: Lines) -> float:
    """Exponent of the time over the last three sizes."""
    size, seconds = (np.log([line[key] for line in lines[-3:]]) for key in ("size", "seconds"))
    return float(np.polyfit(size, seconds, 1)[0])


def _seconds(value: float) -> str:
    if value < 1e-3:
        return f"{1e6 * value:.3g} µs"
    return f"{1e3 * value:.3g} ms" if value < 1.0 else f"{value:.3g} s"
