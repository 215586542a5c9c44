"""What a page shows of any result: its declared quantities over speed, and single values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np

from rotordyn.page.blocks import Block, Chart, Shown, Table
from rotordyn.page.curves import curve_charts
from rotordyn.results.declaration import declared
from rotordyn.results.display import number
from rotordyn.results.headline import Curve

MOST_LINES = 12


def declared_blocks(variants: Sequence[Shown]) -> Iterator[Block]:
    """Charts of quantities over speed, of few lines each; a table of single values."""
    yield from (chart for chart in curve_charts(_curves, None, variants) if _finite(chart))
    rows = [row for variant in variants for row in _single(variant)]
    if rows:
        yield Table("Values", ("", "value"), list(dict.fromkeys(rows)))


def _curves(_: Any, variant: Shown) -> Iterator[Curve]:
    result = variant.result
    fields = {name: field.metadata for name, field in declared(result).items()}
    rpm = fields["speed"]["printed"]
    sizes = {m["dims"][0]: name for name, m in fields.items() if m["role"] == "coordinate"}
    for name, info in fields.items():
        values = np.asarray(getattr(result, name))
        if info["role"] != "quantity" or "speed" not in info["dims"] or values.dtype.kind != "f":
            continue
        others = [d for d in info["dims"] if d != "speed"]
        lines = np.moveaxis(values, info["dims"].index("speed"), -1)
        if lines.size == 0 or lines.size // lines.shape[-1] > MOST_LINES:
            continue
        for index in product(*map(range, lines.shape[:-1])):
            words = [str(getattr(result, sizes[d])[k]) for d, k in zip(others, index, strict=True)]
            yield Curve(
                figure=name,
                label=info["label"],
                unit=info["printed"].unit,
                x=result.speed * rpm.factor,
                y=lines[index] * info["printed"].factor,
                series=", ".join(words),
            )


def _finite(chart: Chart) -> bool:
    return any(np.isfinite(trace["y"]).any() for trace in chart.traces)


def _single(variant: Shown) -> Iterator[tuple[str, str]]:
    for name, field in declared(variant.result).items():
        info, value = field.metadata, getattr(variant.result, name)
        if info["role"] == "quantity" and not info["dims"]:
            to = info["printed"]
            label = f"{info['label']} [{to.unit}]" if to.unit else info["label"]
            yield label, value if isinstance(value, str) else number(float(value) * to.factor, 3)
