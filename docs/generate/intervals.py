"""Ranges over tolerances and those of random machines; time of hypotheses; as measured last."""

from __future__ import annotations

from typing import Any

from docs.generate.marked import table

LIMIT = 0.05  # of the width of the range: allowed difference of few runs


def interval_parts(found: dict[str, Any]) -> dict[str, str]:
    """The tables on the page of times."""
    return {"intervals": _ranges(found), "interval-costs": _costs(found["costs"])}


def _ranges(found: dict[str, Any]) -> str:
    head = ("case", "quantity", "nominal:", "from few runs:", "random machines:", "difference:", "")
    rows = []
    for name, each in found.items():
        if name == "costs":
            continue
        count = f"{each['count']:,}".replace(",", " ")
        runs = f"`{name}`, {each['runs']} runs, {count} machines"
        for place, line in enumerate(each["lines"]):
            few, drawn = (f"{a:.4g} to {b:.4g}" for a, b in (line["few"], line["random"]))
            apart, far = f"{100.0 * line['error']:.1f} %", line["error"] > LIMIT
            none = f"{100.0 * line['without']:.0f} % without a solution" if line["without"] else ""
            words = ", ".join(filter(None, (_far(line) if far else "", none)))
            nominal = f"{line['nominal']:.4g}"
            rows.append(("" if place else runs, line["number"], nominal, few, drawn, apart, words))
    return table(head, rows)


def _far(line: dict[str, float]) -> str:
    """Words on a large difference of few runs, relative to the error of the sample."""
    times, sampling = line["error"] / line["sampling"], 100.0 * line["sampling"]
    return f"**more than 5 %**, {times:.1f} times the sampling error of {sampling:.1f} %"


def _costs(lines: list[dict[str, float]]) -> str:
    head = ("combinations:", "one run [s]:", "interval [s]:", "run with interval over one run:")
    rows = [
        (
            str(round(line["combinations"])),
            f"{line['run']:.2f}",
            f"{line['interval']:.2f}",
            f"{1.0 + line['interval'] / line['run']:.1f}",
        )
        for line in lines
    ]
    return table(head, rows)
