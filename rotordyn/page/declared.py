"""Blocks of a page for any result: its declared quantities over speed, and single values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.page.blocks import Block, Chart, Table
from rotordyn.page.curves import curve_charts
from rotordyn.results.declaration import declared
from rotordyn.results.described import Shown
from rotordyn.results.display import number
from rotordyn.results.headline import Curve, curves_of

MOST_LINES = 12


def declared_blocks(variants: Sequence[Shown]) -> Iterator[Block]:
    """Yield charts of quantities over speed with few lines each, and a table of single values."""
    yield from (chart for chart in curve_charts(_curves, None, variants) if _finite(chart))
    rows = [row for variant in variants for row in _single(variant)]
    if rows:
        yield Table("Values", ("", "value"), list(dict.fromkeys(rows)))


def _curves(_: Any, variant: Shown) -> Iterator[Curve]:
    result = variant.result
    for name, field in declared(result).items():
        info, values = field.metadata, np.asarray(getattr(result, name))
        if info["role"] != "quantity" or "speed" not in info["dims"] or values.dtype.kind != "f":
            continue
        if 0 < values.size <= MOST_LINES * len(result.speed):
            others = " ".join(dim for dim in info["dims"] if dim != "speed")
            yield from curves_of(result, name, series=others, figure=name)


def _finite(chart: Chart) -> bool:
    return any(np.isfinite(trace["y"]).any() for trace in chart.traces)


def _single(variant: Shown) -> Iterator[tuple[str, str]]:
    for name, field in declared(variant.result).items():
        info, value = field.metadata, getattr(variant.result, name)
        if info["role"] == "quantity" and not info["dims"]:
            to = info["printed"]
            label = f"{info['label']} [{to.unit}]" if to.unit else info["label"]
            yield label, value if isinstance(value, str) else number(float(value) * to.factor, 3)
